//! How far the lengths of a scene are apart, and the space that a kernel calculates it in because of that.

use std::cell::OnceCell;

use glam::DVec3;
use rayon::prelude::*;

use super::solids::outside_by;
use crate::algorithm::{Kernel, Precision};
use crate::scene::{BoundingSphere, Extent, Primitive, Scene, SceneSpace};

/// In scenes whose lengths differ by less than that, a surface moves by at most 8u of that, four thousandths of the
/// smallest solid.
pub(super) const MILD_RATIO: f64 = 8192.0;

/// Solids of a scene that close-ups are made of, at most: they are computed anew for each position of the camera.
const MOST_SOLIDS_NEARBY: usize = 4096;

/// A scene's lengths, measured when they are asked for.
pub(super) struct Lengths<'a> {
    pub scene: &'a Scene,
    /// The scene's, where it is no close-up.
    space: SceneSpace,
    ratio: OnceCell<f64>,
}

impl<'a> Lengths<'a> {
    pub fn of(scene: &'a Scene) -> Self {
        Self::within(scene, &Extent::of(&scene.primitives))
    }

    /// With the extent of the scene's primitives.
    fn within(scene: &'a Scene, extent: &Extent) -> Self {
        Self { scene, space: extent.frame(scene.camera.position), ratio: OnceCell::new() }
    }

    /// No coordinate is larger, nor a size, seen from where the kernel does.
    pub fn extent(&self) -> f64 {
        2.0 / self.space.scale
    }

    /// How many times the smallest solid, or the distance of the camera or a light from one, the whole scene is.
    pub fn ratio(&self) -> f64 {
        *self.ratio.get_or_init(|| self.extent() / smallest(self.scene))
    }

    /// The ratio, where the kernel draws the scene as a close-up for that: where `f32` would else lose the small in the
    /// large. The kernels that are there to compare with know no close-ups.
    pub fn close_up(&self, kernel: Kernel) -> Option<f64> {
        let is_short = (1..=MOST_SOLIDS_NEARBY).contains(&self.scene.primitives.len());
        let has_close_ups = kernel.description().has_close_ups && kernel.precision() == Precision::F32;
        (has_close_ups && is_short && self.ratio() > MILD_RATIO).then(|| self.ratio())
    }

    /// Where the kernel calculates.
    pub fn space(&self, kernel: Kernel) -> SceneSpace {
        if self.close_up(kernel).is_some() { SceneSpace::close_up(self.scene) } else { self.space }
    }
}

/// The space that a kernel calculates a scene's picture in.
pub fn scene_space(scene: &Scene, kernel: Kernel) -> SceneSpace {
    Lengths::of(scene).space(kernel)
}

/// The same, with the extent of the scene's primitives.
pub(crate) fn scene_space_within(scene: &Scene, extent: &Extent, kernel: Kernel) -> SceneSpace {
    Lengths::within(scene, extent).space(kernel)
}

/// The smallest solid, or the distance of the camera or a light from one.
fn smallest(scene: &Scene) -> f64 {
    let nearest = |place: DVec3| {
        let distance = |primitive: &Primitive| outside_by(&primitive.solid, place).abs();
        scene.primitives.par_iter().map(distance).reduce(|| f64::INFINITY, f64::min)
    };
    let smallest = scene.primitives.par_iter().map(|primitive| BoundingSphere::of(&primitive.solid).radius);
    let smallest = smallest.reduce(|| f64::INFINITY, f64::min);
    let eyes = std::iter::once(scene.camera.position).chain(scene.lights.iter().map(|light| light.position));
    eyes.map(nearest).fold(smallest, f64::min)
}
