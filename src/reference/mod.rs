//! Ground truth that the kernels are measured against: the accurate model (docs/light-model.md) in plain `f64` on the
//! CPU.
//!
//! Ray–solid intersections are solved in double-double and rounded once, so that a hit is that of the stored ray and
//! the stored solid; directions, normals and shading are `f64`. Nothing here is shared with the kernels.
//!
//! [`render`] draws Whitted's model; [`path_trace`] estimates the same with the light between surfaces.

mod angle;
mod camera;
mod double_double;
mod intersect;
mod nearest;
mod path;
mod path_tracer;
mod random;
mod ray;
mod shade;

pub use camera::PrimaryRays;
pub use nearest::Solids;
pub use path_tracer::{Estimate, path_trace};
pub use ray::{Face, Hit, OriginSurface, Ray, Side};
pub use shade::World;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::DVec3;
use rayon::prelude::*;
use thiserror::Error;

use crate::scene::Scene;

/// [`Pixel::first_hit`] of a primary ray that met nothing.
pub const BACKGROUND: u32 = u32::MAX;

/// [`Pixel::first_hit`] of a primary ray that saw a light sphere.
pub const LIGHT_SPHERE: u32 = u32::MAX - 1;

/// What one primary ray saw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pixel {
    /// Linear RGB, not limited to 1, but finite: what overflows an `f64` is clamped to its largest value.
    pub color: DVec3,
    /// Index into `Scene::primitives`, or [`BACKGROUND`], or [`LIGHT_SPHERE`].
    pub first_hit: u32,
    /// A hash of everything discrete on the ray's way through all generations: primitives, faces, sides, and the
    /// lights that reach them. Neighbours that differ in it lie across a discontinuity.
    pub path: u64,
}

/// A picture in linear `f64` RGB.
#[derive(Debug, Clone, PartialEq)]
pub struct Image64 {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width`·`height`, row by row, the top row first.
    pub pixels: Vec<Pixel>,
}

impl Image64 {
    /// The colours alone as `f32`, in the pixels' order; what overflows is clamped to the largest `f32`.
    pub fn to_f32(&self) -> Vec<[f32; 3]> {
        let narrow = |channel: f64| (channel as f32).clamp(f32::MIN, f32::MAX);
        self.pixels.iter().map(|pixel| pixel.color.to_array().map(narrow)).collect()
    }
}

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum RenderError {
    /// A side is 0.
    #[error("could not render a picture of {width}×{height} pixels: it has none")]
    Empty {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// There is no memory for the pixels, which are all held at once.
    #[error("could not render a picture of {width}×{height} pixels: not enough memory")]
    OutOfMemory {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// Pixels were to be estimated from 0 samples.
    #[error("could not estimate pixels from no samples")]
    NoSamples,
    /// `progress` answered with a break.
    #[error("rendering was cancelled")]
    Cancelled,
}

/// Renders a scene, in parallel over rows on rayon's current pool.
///
/// `progress` gets the number of rows done after each row, from any thread and not necessarily in order; its
/// [`ControlFlow::Break`] cancels.
pub fn render(
    scene: &Scene,
    width: u32,
    height: u32,
    progress: &(dyn Fn(u32) -> ControlFlow<()> + Sync),
) -> Result<Image64, RenderError> {
    let world = World::new(scene);
    let primary_rays = PrimaryRays::new(&scene.camera, width, height);
    let blank = Pixel { color: DVec3::ZERO, first_hit: BACKGROUND, path: 0 };
    let draw = |column, row| world.look_along(primary_rays.through(column, row));
    Ok(Image64 { width, height, pixels: by_rows(width, height, blank, draw, progress)? })
}

/// What `draw` makes of each column and row, row by row; `progress` as in [`render`].
fn by_rows<T: Clone + Send>(
    width: u32,
    height: u32,
    blank: T,
    draw: impl Fn(u32, u32) -> T + Sync,
    progress: &(dyn Fn(u32) -> ControlFlow<()> + Sync),
) -> Result<Vec<T>, RenderError> {
    if width == 0 || height == 0 {
        return Err(RenderError::Empty { width, height });
    }
    let mut pixels = filled(width, height, blank).ok_or(RenderError::OutOfMemory { width, height })?;
    let rows_done = AtomicU32::new(0);
    pixels.par_chunks_mut(width as usize).zip(0..height).try_for_each(|(pixels, row)| {
        for (pixel, column) in pixels.iter_mut().zip(0..width) {
            *pixel = draw(column, row);
        }
        match progress(rows_done.fetch_add(1, Ordering::Relaxed) + 1) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(RenderError::Cancelled),
        }
    })?;
    Ok(pixels)
}

/// None if they do not fit in memory.
fn filled<T: Clone>(width: u32, height: u32, blank: T) -> Option<Vec<T>> {
    let count = (width as usize).checked_mul(height as usize)?;
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(count).ok()?;
    pixels.resize(count, blank);
    Some(pixels)
}
