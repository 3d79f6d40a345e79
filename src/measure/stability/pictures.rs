//! Cases of whole scenes, as pictures.

use std::ops::ControlFlow;

use glam::DVec3;

use super::scenes::{balls_in_contact, cloud, facing_mirrors, lit_cube, mixed, moved_and_scaled, rooms, sharing_cubes};
use super::{Case, Measured, Subject};
use crate::frame::Frame;
use crate::measure::{Difference, tolerances};
use crate::reference::{self, Image64, LIGHT_SPHERE, RenderError};
use crate::scene::{Scene, gallery};
use crate::tracer::{Precision, Settings, Tracer, TracerError};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![
        Case::of_kernel("SC-picture", |subject| moved(subject, &[(1e-6, DVec3::ZERO), (1e6, DVec3::ZERO)])),
        // The scene's size is about 10.
        Case::of_kernel("TR-picture", |subject| moved(subject, &[(1.0, DVec3::new(1e6, -1e6, 1e6))])),
        like_reference("TG-1", balls_in_contact),
        like_reference("CF-1", sharing_cubes),
    ];
    // Inside a solid, on its surface, and where the centre of the picture meets it.
    for (index, z) in [0.0, -1.0, -1.0 - 1e-9].into_iter().enumerate() {
        cases.push(like_reference(&format!("LT-{}", index + 1), move || lit_cube(DVec3::new(0.0, 0.0, z))));
    }
    cases.push(Case::of_kernel("MR-1", closed_rooms).for_chance_too());
    cases.push(Case::of_kernel("MR-2", facing));
    cases.push(Case::of_kernel("IT-1", dazzling));
    cases.push(Case::of_kernel("N-0", empty).for_every_algorithm());
    cases.push(Case::of_kernel("N-5", many));
    cases.push(Case::of_kernel("IM-1", |subject| compared(subject, &mixed(), [1, 1], 0)));
    cases.push(Case::of_kernel("IM-2", one_row));
    cases.push(Case::of_kernel("IM-3", tiled).for_every_algorithm());
    cases.push(field_of_view(1, 1e-6_f64.to_degrees()).for_every_algorithm());
    cases.push(field_of_view(2, 179.999).for_every_algorithm());
    cases
}

/// Pixels.
pub(super) fn size(subject: &Subject) -> [u32; 2] {
    if subject.is_quick { [96, 60] } else { [320, 200] }
}

/// Linear RGB; `None` where the kernel does not take such scenes.
pub(super) fn picture(
    subject: &Subject,
    scene: &Scene,
    [width, height]: [u32; 2],
) -> Result<Option<Vec<DVec3>>, TracerError> {
    let settings = Settings { kernel: subject.kernel, ..Settings::new(width, height) };
    let last = subject.tracer.take().filter(|(size, _)| *size == [width, height]);
    let tracer = match last {
        Some((_, mut tracer)) => tracer.set_scene(scene, &settings).map(|()| tracer),
        None => Tracer::new(&subject.device, scene, &settings),
    };
    match tracer {
        Ok(mut tracer) => {
            let picture = tracer.render_f64()?;
            subject.tracer.replace(Some(([width, height], tracer)));
            Ok(Some(picture))
        }
        Err(TracerError::Refused(_)) if !subject.kernel.description().is_of_accurate_model => Ok(None),
        Err(error) => Err(error),
    }
}

pub(super) fn truth(scene: &Scene, [width, height]: [u32; 2]) -> Result<Image64, TracerError> {
    reference::render(scene, width, height, &|_| ControlFlow::Continue(())).map_err(|error| match error {
        RenderError::Cancelled => TracerError::Stopped,
        error => TracerError::Refused(error.to_string()),
    })
}

fn measured(difference: &Difference, precision: Precision, least_solid: usize) -> Vec<Measured> {
    let (largest, share) = tolerances(precision);
    vec![
        Measured { what: "largest difference off discontinuities", measured: difference.largest, bound: largest },
        Measured {
            what: "share of discontinuity pixels that differ",
            measured: difference.differing_share(),
            bound: share,
        },
        Measured::none_of("pixels with NaN or infinity", difference.not_finite),
        Measured::none_of("pixels of solids too few to prove anything", least_solid.saturating_sub(difference.solid)),
    ]
}

/// Against the reference; nothing for the course kernel, which draws another model.
pub(super) fn compared(
    subject: &Subject,
    scene: &Scene,
    size: [u32; 2],
    least_solid: usize,
) -> Result<Vec<Measured>, TracerError> {
    let Some(ours) = picture(subject, scene, size)?.filter(|_| subject.kernel.description().is_of_accurate_model)
    else {
        return Ok(Vec::new());
    };
    let precision = subject.kernel.precision();
    let difference = Difference::between(&truth(scene, size)?, &ours, tolerances(precision).0, |_| true);
    Ok(measured(&difference, precision, least_solid))
}

pub(super) fn like_reference(id: &str, scene: impl Fn() -> Scene + 'static) -> Case {
    Case::of_kernel(id, move |subject| {
        let [width, height] = size(subject);
        compared(subject, &scene(), [width, height], (width * height / 20) as usize)
    })
}

/// The same scene at another scale or position is the same picture; of the course kernel too, against its own. Only
/// pixels that show solids in both count: the light sphere has one size in every scene.
fn moved(subject: &Subject, moves: &[(f64, DVec3)]) -> Result<Vec<Measured>, TracerError> {
    let scene = gallery::scene("four").unwrap_or_default();
    let (size, precision) = (size(subject), subject.kernel.precision());
    let original = truth(&scene, size)?;
    let own = match subject.kernel.description().is_of_accurate_model {
        true => None,
        false => picture(subject, &scene, size)?,
    };
    let mut total = Difference::default();
    for &(scale, shift) in moves {
        let moved = moved_and_scaled(&scene, shift, scale);
        let mut moved_truth = truth(&moved, size)?;
        let Some(ours) = picture(subject, &moved, size)? else { return Ok(Vec::new()) };
        let shows_solid: Vec<bool> = moved_truth
            .pixels
            .iter()
            .zip(&original.pixels)
            .map(|(moved, original)| moved.first_hit < LIGHT_SPHERE && original.first_hit < LIGHT_SPHERE)
            .collect();
        for (pixel, own) in moved_truth.pixels.iter_mut().zip(own.iter().flatten()) {
            pixel.color = *own;
        }
        total =
            total.plus(Difference::between(&moved_truth, &ours, tolerances(precision).0, |index| shows_solid[index]));
    }
    Ok(measured(&total, precision, (size[0] * size[1] / 20) as usize))
}

/// No ray escapes from a closed room of mirrors, at any depth.
fn closed_rooms(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let side = if subject.is_quick { 24 } else { 64 };
    let mut escaped = 0;
    for depth in [20, 50, 200] {
        for room in rooms(depth) {
            let Some(pixels) = picture(subject, &room, [side, side])? else { return Ok(Vec::new()) };
            // Nothing shines in there, and the background is white.
            escaped += pixels.iter().filter(|pixel| **pixel != DVec3::ZERO).count();
        }
    }
    Ok(vec![Measured::none_of("rays that escape from a closed room", escaped)])
}

/// Spheres that mirror each other multiply an angular error by about 5 a bounce (docs/numerics.md): a hit's of 8u is
/// still below the tolerance after 5 bounces in `f32`, 8u·5⁵ = 1.5e-3, and after 8 in `f64`. Deeper, it must stay
/// finite and within what shines.
fn facing(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let judged_depth = match subject.kernel.precision() {
        Precision::F32 => 5,
        Precision::F64 => 8,
    };
    let [width, height] = size(subject);
    let mut measured =
        compared(subject, &facing_mirrors(judged_depth), [width, height], (width * height / 20) as usize)?;
    let mut beyond = 0;
    for depth in [20, 50, 200] {
        let scene = facing_mirrors(depth);
        let Some(pixels) = picture(subject, &scene, [width, height])? else { return Ok(Vec::new()) };
        // The background is the brightest thing there is.
        let is_within =
            |pixel: &DVec3| pixel.is_finite() && pixel.max_element() <= scene.background.max_element() * (1.0 + 1e-5);
        beyond += pixels.iter().filter(|pixel| !is_within(pixel)).count();
    }
    measured.push(Measured::none_of("pixels brighter than all that shines, or not finite", beyond));
    Ok(measured)
}

fn dazzling(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let (mut not_finite, mut bright) = (0, 0);
    for intensity in [1e30, 3e38] {
        let mut scene = gallery::scene("four").unwrap_or_default();
        scene.background = DVec3::splat(intensity);
        scene.lights.iter_mut().for_each(|light| light.intensity = DVec3::splat(intensity));
        for primitive in &mut scene.primitives {
            let material = &mut primitive.material;
            (material.ambient, material.diffuse, material.specular) = (1.0, 1.0, 1.0);
        }
        let Some(pixels) = picture(subject, &scene, size(subject))? else { return Ok(Vec::new()) };
        not_finite += pixels.iter().filter(|pixel| !pixel.is_finite()).count();
        bright += pixels.iter().filter(|pixel| pixel.max_element() >= 0.99 * intensity).count();
    }
    Ok(vec![
        Measured::none_of("pixels with NaN or infinity", not_finite),
        Measured::none_of("bright pixels too few to prove anything", 100_usize.saturating_sub(bright)),
    ])
}

fn empty(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let mut scene = Scene { background: DVec3::new(0.125, 0.25, 0.375), ..Scene::default() };
    // The camera must not look at the light sphere.
    scene.lights.iter_mut().for_each(|light| light.position = DVec3::new(0.0, 0.0, -100.0));
    let Some(pixels) = picture(subject, &scene, size(subject))? else { return Ok(Vec::new()) };
    Ok(vec![Measured::none_of(
        "pixels other than the background",
        pixels.iter().filter(|pixel| **pixel != scene.background).count(),
    )])
}

/// As by brute force: the reference tests each of them for every ray.
fn many(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let (count, size) = if subject.is_quick { (10_000, [24, 16]) } else { (100_000, [72, 48]) };
    compared(subject, &cloud(count), size, (size[0] * size[1] / 20) as usize)
}

/// The largest width there is, one row high.
fn one_row(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let width = if subject.is_quick { 4096 } else { 16384 };
    let mut scene = mixed();
    // So that the row spans 50°.
    scene.camera.vertical_fov_degrees = 50.0 / f64::from(width);
    compared(subject, &scene, [width, 1], 100)
}

/// A picture in small tiles is the picture in large ones. Of 16384² pixels, which take 3 GB, only the way into tiles is
/// shown: they are of the same code at any size.
fn tiled(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let side = if subject.is_quick { 200 } else { 1500 };
    let frame = |max_tile_side| -> Result<Frame, TracerError> {
        let scene = gallery::scene("four").unwrap_or_default();
        let settings = Settings { kernel: subject.kernel, max_tile_side, ..Settings::new(side, side) };
        let mut tracer = Tracer::new(&subject.device, &scene, &settings)?;
        let mut frame = tracer.frame()?;
        tracer.render(&mut frame, &mut |_| ControlFlow::Continue(()))?;
        Ok(frame)
    };
    let (whole, tiled) = (frame(u32::MAX)?, frame(side / 7)?);
    let differing = whole.pixels().iter().zip(tiled.pixels()).filter(|(a, b)| a != b).count();
    Ok(vec![Measured::none_of("pixels that depend on the tiling", differing)])
}

/// At 10⁻⁶ rad a pixel is narrower than a number's last place: only finite, not right. An `f64` is both.
fn field_of_view(number: usize, vertical_fov_degrees: f64) -> Case {
    Case::of_kernel(format!("FV-{number}"), move |subject| {
        let mut scene = gallery::scene("four").unwrap_or_default();
        scene.camera.vertical_fov_degrees = vertical_fov_degrees;
        let Some(pixels) = picture(subject, &scene, size(subject))? else { return Ok(Vec::new()) };
        let not_finite = pixels.iter().filter(|pixel| !pixel.is_finite()).count();
        let mut measured = vec![Measured::none_of("pixels with NaN or infinity", not_finite)];
        if subject.kernel.precision() == Precision::F64 && subject.kernel.description().is_accurate {
            measured.extend(compared(subject, &scene, size(subject), 0)?);
        }
        Ok(measured)
    })
}
