//! The picture that all others are measured against.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::DVec3;
use rayon::prelude::*;

use super::{Radiance, Target};
use crate::frame::{Frame, FrameError};
use crate::reference::{self, Image64, PrimaryRays, RenderError, World};
use crate::scene::Scene;

/// Points along each side of a pixel that stand for its area.
const AREA_SIDE: u32 = 8;

/// A true picture.
pub struct Truth {
    /// Its colours are the target's; hits and paths are those of the pixels' centres for either target.
    pub image: Image64,
    /// The same as the kernels' frames are stored.
    pub frame: Frame,
}

/// What pictures are measured against.
pub enum TruePicture {
    /// By the reference.
    Reference(Truth),
    /// By path tracing.
    Radiance(Radiance),
}

impl TruePicture {
    /// As the kernels' frames are stored.
    pub fn frame(&self) -> &Frame {
        match self {
            Self::Reference(truth) => &truth.frame,
            Self::Radiance(radiance) => &radiance.frame,
        }
    }
}

/// Why there is none.
#[derive(Debug, thiserror::Error)]
pub enum TruthError {
    /// The reference could not render the scene, or was stopped.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A frame of a size that cannot be, or no memory for it.
    #[error(transparent)]
    Frame(#[from] FrameError),
}

/// The true picture of a scene, in parallel over rows; radiance is not for the reference, which gives what is at the
/// pixels' centres for it, see [`radiance`](super::radiance). `progress` hears of the share that is done.
pub fn truth(
    scene: &Scene,
    [width, height]: [u32; 2],
    target: Target,
    progress: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Truth, TruthError> {
    // Rows of points, those in the centres first.
    let passes = match target {
        Target::Point | Target::Radiance { .. } => 1,
        Target::Area => 1 + AREA_SIDE * AREA_SIDE,
    };
    let share = |points: f64| points / f64::from(passes * height);
    let mut image = reference::render(scene, width, height, &|rows| progress(share(rows.into())))?;
    if target == Target::Area {
        let rows_before = f64::from(height);
        average(scene, &mut image, &|rows| {
            progress(share(rows_before + f64::from(rows) * f64::from(AREA_SIDE * AREA_SIDE)))
        })?;
    }
    let mut frame = Frame::new(width, height)?;
    frame.pixels_mut().copy_from_slice(&image.to_f32());
    Ok(Truth { image, frame })
}

/// Puts the mean over each pixel's area in place of its colour.
fn average(
    scene: &Scene,
    image: &mut Image64,
    progress: &(dyn Fn(u32) -> ControlFlow<()> + Sync),
) -> Result<(), RenderError> {
    let world = World::new(scene);
    // The centres of the pixels of a picture so many times as fine.
    let rays = PrimaryRays::new(&scene.camera, AREA_SIDE * image.width, AREA_SIDE * image.height);
    let color = |column: u32, row: u32| world.look_along(rays.through(column, row)).color;
    let mean = |column: u32, row: u32| {
        let rows = AREA_SIDE * row..AREA_SIDE * (row + 1);
        let points = rows.flat_map(|row| (AREA_SIDE * column..AREA_SIDE * (column + 1)).map(move |c| (c, row)));
        // Divided first: channels may be as large as there are numbers.
        points.map(|(column, row)| color(column, row) / f64::from(AREA_SIDE * AREA_SIDE)).sum::<DVec3>()
    };
    let rows_done = AtomicU32::new(0);
    let width = image.width as usize;
    image.pixels.par_chunks_mut(width).zip(0..image.height).try_for_each(|(pixels, row)| {
        for (pixel, column) in pixels.iter_mut().zip(0..) {
            pixel.color = mean(column, row);
        }
        match progress(rows_done.fetch_add(1, Ordering::Relaxed) + 1) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(RenderError::Cancelled),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::gallery;

    #[test]
    fn an_area_is_the_mean_of_its_points_and_keeps_the_middles_paths() {
        let scene = gallery::scene("showcase").unwrap();
        let of = |size, target| truth(&scene, size, target, &|_| ControlFlow::Continue(())).unwrap();
        let (point, area) = (of([12, 5], Target::Point), of([12, 5], Target::Area));
        let fine = of([96, 40], Target::Point);
        for (index, (point, area)) in point.image.pixels.iter().zip(&area.image.pixels).enumerate() {
            let (column, row) = (index % 12 * 8, index / 12 * 8);
            let points = (0..64).map(|place| fine.image.pixels[(row + place / 8) * 96 + column + place % 8].color);
            let mean = points.sum::<DVec3>() / 64.0;
            // Sums of 64 numbers of about 1, in another order.
            assert!((area.color - mean).abs().max_element() < 64.0 * f64::EPSILON * 64.0);
            assert_eq!((area.path, area.first_hit), (point.path, point.first_hit));
        }
        assert_ne!(point.frame, area.frame);
    }

    #[test]
    fn progress_goes_from_0_to_1_and_can_stop_the_work() {
        let scene = gallery::scene("start").unwrap();
        for target in [Target::Point, Target::Area] {
            let largest = std::sync::Mutex::new(0.0_f64);
            let note = |share: f64| {
                let mut largest = largest.lock().unwrap();
                *largest = largest.max(share);
                ControlFlow::Continue(())
            };
            truth(&scene, [8, 8], target, &note).unwrap();
            assert!((*largest.lock().unwrap() - 1.0).abs() < 1e-12);
            let stopped = truth(&scene, [8, 8], target, &|_| ControlFlow::Break(()));
            assert!(matches!(stopped, Err(TruthError::Render(RenderError::Cancelled))));
        }
    }
}
