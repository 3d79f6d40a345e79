//! Cases for every algorithm, whatever light it draws: pictures are of numbers.

use super::pictures::{picture, size};
use super::scenes::mixed;
use super::{Case, Measured, Subject};
use crate::scene::Scene;
use crate::tracer::TracerError;

pub(super) fn cases() -> Vec<Case> {
    let cases = [
        Case::of_kernel("AL-1", |subject| of_numbers(subject, &[mixed()], [1, 1])),
        Case::of_kernel("AL-2", |subject| {
            let width = longest(subject);
            let mut scene = mixed();
            // So that the row spans 50°.
            scene.camera.vertical_fov_degrees = 50.0 / f64::from(width);
            of_numbers(subject, &[scene], [width, 1])
        }),
        Case::of_kernel("AL-3", |subject| of_numbers(subject, &[mixed()], [1, longest(subject)])),
        Case::of_kernel("AL-4", |subject| of_numbers(subject, &within_each(&mixed()), size(subject))),
    ];
    cases.into_iter().map(Case::for_every_algorithm).collect()
}

/// Pixels.
fn longest(subject: &Subject) -> u32 {
    if subject.is_quick { 4096 } else { 16384 }
}

/// The scene from the middle of each of its solids.
fn within_each(scene: &Scene) -> Vec<Scene> {
    let from_within = |place: usize| {
        let mut scene = scene.clone();
        scene.camera.position = scene.primitives[place].solid.position();
        scene
    };
    (0..scene.primitives.len()).map(from_within).collect()
}

fn of_numbers(subject: &Subject, scenes: &[Scene], size: [u32; 2]) -> Result<Vec<Measured>, TracerError> {
    let mut wrong = 0;
    for scene in scenes {
        let Some(pixels) = picture(subject, scene, size)? else { return Ok(Vec::new()) };
        wrong += pixels.iter().filter(|pixel| !pixel.is_finite() || pixel.min_element() < 0.0).count();
    }
    Ok(vec![Measured::none_of("pixels with NaN, infinity or less than no light", wrong)])
}
