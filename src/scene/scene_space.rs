//! The frame that the accurate kernel calculates in: chosen from the primitives, so that a camera that moves among them
//! leaves their records as they are.

use glam::DVec3;

use super::{BoundingSphere, Light, Primitive, Scene, farthest_coordinate};

/// Lights farther than this many times the largest primitive are moved here along their direction: parallel light to
/// the last bit of an `f64`, and no square of their distance overflows an `f32`.
const FARTHEST_LIGHT: f64 = (1_u64 << 60) as f64;

/// From the world frame to the kernel's: (world − origin)·scale, rounded once where `scale` is a power of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneSpace {
    /// World frame.
    pub origin: DVec3,
    /// Kernel lengths in a world unit.
    pub scale: f64,
    /// Half of the largest coordinate of a solid or of a ray's origin, kernel lengths.
    pub reach: f32,
    /// The origin is the camera, and solids are relative to their points nearest to it.
    pub is_close_up: bool,
}

impl Default for SceneSpace {
    fn default() -> Self {
        Self::world(1.0)
    }
}

impl SceneSpace {
    /// The world frame itself, where no coordinate is larger than twice `reach`.
    pub fn world(reach: f32) -> Self {
        Self { origin: DVec3::ZERO, scale: 1.0, reach, is_close_up: false }
    }

    /// The frame of a scene: the same on every host and in every session, so that a picture's bits are, too.
    pub fn of(scene: &Scene) -> Self {
        Extent::of(&scene.primitives).frame(scene.camera.position)
    }

    /// The space of a close-up: rounding errors scale with the distance from the camera.
    pub fn close_up(scene: &Scene) -> Self {
        let origin = scene.camera.position;
        let extent = Extent { origin, farthest: farthest_coordinate(&scene.primitives, origin) };
        Self { is_close_up: true, ..extent.frame(origin) }
    }

    pub(crate) fn point(&self, world: DVec3) -> DVec3 {
        (world - self.origin) * self.scale
    }

    /// Where a light is, and the radius of its sphere; scene space.
    pub(crate) fn light(&self, light: &Light) -> (DVec3, f64) {
        let position = self.point(light.position);
        let nearer = (FARTHEST_LIGHT / position.abs().max_element()).min(1.0);
        // The sphere keeps the angle under which the camera sees it.
        (position * nearer, light.radius * self.scale * nearer)
    }

    /// A point and what its rounding lost.
    pub(crate) fn exact_point(&self, world: DVec3) -> (DVec3, DVec3) {
        let (value, error) = two_sum(world, -self.origin);
        (value * self.scale, error * self.scale)
    }
}

/// Where the primitives are, world frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    origin: DVec3,
    /// The largest coordinate of a solid, from there.
    farthest: f64,
}

/// Solids that the origin is chosen from: as good a choice as from a million, and sooner made.
const SAMPLE: usize = 4096;

/// Coordinates are rounded up where this would make a whole step of what is left: scenes are symmetric about halves and
/// tenths, and a mean right where rounding turns would turn with every edit.
const ROUND_UP: f64 = 0.618;

impl Extent {
    /// The origin is where solids are small and many, since that is where what rounding a coordinate loses would show:
    /// the mean of the centres weighed by 1/size, without the outer quarters, to whole steps of a few sizes. One solid
    /// edited among many hardly ever moves it, nor does a ground a million times as large as all that stands on it.
    pub fn of(primitives: &[Primitive]) -> Self {
        let stride = primitives.len().div_ceil(SAMPLE).max(1);
        let sample: Vec<_> =
            primitives.iter().step_by(stride).map(|primitive| BoundingSphere::of(&primitive.solid)).collect();
        let mean = |number: &dyn Fn(&BoundingSphere) -> f64| {
            interquartile_mean(sample.iter().map(|reach| (number(reach), 1.0 / reach.radius)).collect())
        };
        let size = mean(&|reach| reach.radius);
        let step = if size > 0.0 { 4.0 * power_of_two_below(size) } else { 1.0 };
        let middle =
            DVec3::new(mean(&|reach| reach.center.x), mean(&|reach| reach.center.y), mean(&|reach| reach.center.z));
        // Beyond all numbers, a coordinate is left as it is.
        let whole_steps = |coordinate: f64| {
            let rounded = (coordinate / step + ROUND_UP).floor() * step;
            if rounded.is_finite() { rounded } else { coordinate }
        };
        let origin = middle.map(whole_steps);
        Self { origin, farthest: farthest_coordinate(primitives, origin) }
    }

    /// The farthest coordinate of a solid or of the camera is brought below 2 by a power of two: squares stay far from
    /// the ends of `f32` whatever the scene's unit. The camera's distance counts only where it is the larger, and then
    /// by its power of two.
    pub fn frame(&self, camera: DVec3) -> SceneSpace {
        let farthest = self.farthest.max((camera - self.origin).abs().max_element());
        let scale = if farthest > 0.0 { 1.0 / power_of_two_below(farthest) } else { 1.0 };
        SceneSpace { origin: self.origin, scale, reach: 1.0, is_close_up: false }
    }
}

/// From 2⁻¹⁰²² to 2¹⁰²²: it and its reciprocal are normal numbers.
fn power_of_two_below(number: f64) -> f64 {
    number.log2().floor().clamp(-1022.0, 1022.0).exp2()
}

/// Interquartile mean of pairs of a number and its weight; 0 of none.
fn interquartile_mean(mut weighted: Vec<(f64, f64)>) -> f64 {
    weighted.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    // Relative to the largest, so that their sum is a number.
    let largest = weighted.iter().map(|(_, weight)| *weight).fold(f64::MIN_POSITIVE, f64::max).min(f64::MAX);
    weighted.iter_mut().for_each(|(_, weight)| *weight = weight.min(f64::MAX) / largest);
    let whole: f64 = weighted.iter().map(|(_, weight)| *weight).sum();
    let mut before = 0.0;
    let terms = weighted.iter().map(|(number, weight)| {
        let (low, high) = (before, before + weight);
        before = high;
        let inside = high.min(0.75 * whole) - low.max(0.25 * whole);
        // The shares add up to 1.
        number * (inside.max(0.0) / (0.5 * whole))
    });
    terms.sum()
}

/// a + b and what its rounding lost (Knuth's TwoSum).
pub(crate) fn two_sum(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Material, Solid};

    fn balls(balls: impl IntoIterator<Item = (DVec3, f64)>) -> Vec<Primitive> {
        let ball = |(center, radius)| Primitive {
            name: None,
            solid: Solid::Sphere { center, radius },
            material: Material::default(),
        };
        balls.into_iter().map(ball).collect()
    }

    #[test]
    fn a_ground_of_any_size_leaves_the_origin_among_what_stands_on_it() {
        let mut scene = balls((0..5).map(|i| (DVec3::new(f64::from(i), 1.0, 7.0), 0.75)));
        let alone = Extent::of(&scene).origin;
        scene.extend(balls([(DVec3::new(0.0, -1e6, 0.0), 1e6)]));
        assert_eq!(Extent::of(&scene).origin, alone);
        assert!((alone - DVec3::new(2.0, 1.0, 7.0)).abs().max_element() < 2.0, "{alone}");
    }

    #[test]
    fn a_camera_changes_the_frame_only_far_outside_and_by_powers_of_two() {
        let extent = Extent::of(&balls([(DVec3::X * -10.0, 1.0), (DVec3::X * 10.0, 1.0)]));
        assert_eq!(extent.origin, DVec3::ZERO);
        let frame = |distance: f64| extent.frame(DVec3::Z * distance);
        assert_eq!(frame(0.0), frame(11.0));
        assert_eq!((frame(100.0).scale, frame(127.0).scale, frame(128.0).scale), (1.0 / 64.0, 1.0 / 64.0, 1.0 / 128.0));
        assert_eq!(frame(1e9).origin, frame(0.0).origin);
    }

    #[test]
    fn no_scene_s_frame_is_without_a_number() {
        for (center, radius) in [(0.0, 1e-310), (1e300, 1e300), (-1e308, 1e-308), (1e-320, 1e308)] {
            let frame = Extent::of(&balls([(DVec3::splat(center), radius)])).frame(DVec3::ZERO);
            assert!(frame.origin.is_finite() && frame.scale.is_normal(), "{center} {radius}: {frame:?}");
        }
        assert_eq!(Extent::of(&[]).frame(DVec3::ZERO), SceneSpace::world(1.0));
    }
}
