//! How many pixels an invocation traces, one after another.

use super::solids::is_rotated;
use super::{Decision, Limits, Reason, Structure};
use crate::algorithm::Kernel;
use crate::scene::{BoundingSphere, Primitive, Scene, SolidKind};

/// Iterations of all its loops together that an invocation may take on a CPU driver. Mesa's leave a loop after 65535
/// without a word; this is below by more than a last search among all kinds takes to end.
pub const CPU_MAX_ITERATIONS: u32 = 60_000;

/// Where invocations come in packets, a packet that goes on to its next pixels spares the end of each what comes after
/// the search, and reads the camera once.
pub const MOST_PIXELS: u32 = 8;

/// More solids are not looked at: that takes time by the square of their number.
const MOST_SOLIDS: usize = 512;

/// Solids that a ray may have to solve exactly besides those that it may meet at one point: a proxy that it touches in
/// passing.
const TOUCHED: usize = 1;

/// Iterations that a search and an exact solve take by themselves.
const AROUND: u64 = 4;

/// What a ray may have to do among some primitives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TraversalCost {
    /// Iterations of one search and the solve after it, in half of the boxes, times how many of these at most; `None`
    /// among more primitives than are looked at,
    /// and where rays branch.
    iterations: Option<u64>,
}

impl TraversalCost {
    /// Takes time by the square of their number, up to 512 of them.
    pub fn of(primitives: &[Primitive]) -> Self {
        // What a ray that is both reflected and refracted costs is up to how often it is: between one path and 2^depth.
        let branches =
            |Primitive { material, .. }: &Primitive| material.transmission > 0.0 && material.reflection != Some(0.0);
        if primitives.len() > MOST_SOLIDS || primitives.iter().any(branches) {
            return Self { iterations: None };
        }
        let count = |kind: SolidKind| primitives.iter().filter(|primitive| primitive.solid.kind() == kind).count();
        // An iteration for each group of eight solids, or of eight boxes over them. That one of cylinders or cones may
        // take two or three is not counted.
        let groups = |solids: usize| solids.div_ceil(Structure::GROUP - 1).div_ceil(2) as u64;
        let search: u64 = SolidKind::ALL.into_iter().map(|kind| groups(count(kind))).sum();
        // A box that is rotated is tested by the axis-aligned box around it, which a ray may meet for nothing.
        let rotated_boxes = primitives.iter().filter(|primitive| is_rotated(&primitive.solid)).count();
        let solved = 1 + TOUCHED + most_in_one_place(primitives) + rotated_boxes;
        Self { iterations: Some((search + AROUND) * solved as u64) }
    }

    /// How many pixels each of a packet's invocations traces: eight, or the largest power of two so that the driver's
    /// loops have time for all of them. An estimate: what it is wrong about, a tracer traces once more, pixel by pixel,
    /// and a window shows black. `unknown`: that many where the cost is not known.
    pub fn pixels_per_invocation(self, lights: usize, generations: u32, unknown: u32) -> u32 {
        let Some(iterations) = self.iterations else { return unknown };
        let rays = u64::from(generations) * (1 + lights as u64);
        let iterations = iterations.saturating_mul(rays);
        let fits = |pixels: u32| iterations.saturating_mul(pixels.into()) <= CPU_MAX_ITERATIONS.into();
        let mut pixels = MOST_PIXELS;
        while pixels > 1 && !fits(pixels) {
            pixels /= 2;
        }
        pixels
    }
}

/// No more solids than that have a point in common: a ray may have to solve all that it meets at its first hit. Proxies
/// are larger than solids by some millionths; a thousandth is more than that by far, and counts hardly any more.
fn most_in_one_place(primitives: &[Primitive]) -> usize {
    let spheres: Vec<_> = primitives.iter().map(|primitive| BoundingSphere::of(&primitive.solid)).collect();
    let touch =
        |a: &BoundingSphere, b: &BoundingSphere| a.center.distance(b.center) <= (a.radius + b.radius) * (1.0 + 1e-3);
    spheres.iter().map(|a| spheres.iter().filter(|b| touch(a, b)).count()).max().unwrap_or_default()
}

pub(super) fn decide(scene: &Scene, kernel: Kernel, generations: u32, limits: &Limits) -> Decision<u32> {
    if kernel.description().is_statistical {
        return Decision { choice: 1, reason: Reason::SamplesInstead };
    }
    if !limits.packets {
        return Decision { choice: 1, reason: Reason::NoPackets };
    }
    // Of many solids the window takes one, since it traces nothing again.
    let choice =
        TraversalCost::of(&scene.primitives).pixels_per_invocation(scene.lights.len(), generations, MOST_PIXELS);
    Decision { choice, reason: if choice > 1 { Reason::ManyPixelsPerInvocation } else { Reason::LongPixels } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Light, gallery};

    fn scene(name: &str) -> Scene {
        gallery::scene(name).unwrap()
    }

    fn pixels_per_invocation(scene: &Scene, generations: u32) -> u32 {
        TraversalCost::of(&scene.primitives).pixels_per_invocation(scene.lights.len(), generations, 3)
    }

    #[test]
    fn light_pixels_are_traced_in_turn_and_heavy_ones_alone() {
        assert_eq!(pixels_per_invocation(&Scene::default(), 1), 8);
        for name in
            ["four", "showcase", "corridor", "grid-sphere-100", "grid-box-100", "grid-cylinder-100", "grid-cone-100"]
        {
            let scene = scene(name);
            assert_eq!(pixels_per_invocation(&scene, scene.max_depth), 8, "{name}");
        }
        assert_eq!(pixels_per_invocation(&scene("grid-sphere-100"), 1000), 1, "many generations");
        assert_eq!(pixels_per_invocation(&scene("cloud-10000"), 20), 3, "too many solids to tell");
        assert_eq!(pixels_per_invocation(&scene("glass"), 20), 3, "rays that branch");
        let lights = vec![Light::default(); 50];
        assert_eq!(pixels_per_invocation(&Scene { lights, ..scene("grid-sphere-100") }, 20), 1, "many lights");
    }

    #[test]
    fn solids_in_one_place_are_solved_one_after_another() {
        let sphere = scene("sphere").primitives[0].clone();
        let on_one_place = |count| Scene { primitives: vec![sphere.clone(); count], ..Scene::default() };
        assert_eq!(most_in_one_place(&on_one_place(100).primitives), 100);
        assert_eq!(pixels_per_invocation(&on_one_place(100), 20), 1);
        assert_eq!(pixels_per_invocation(&on_one_place(3), 20), 8);
        assert_eq!(pixels_per_invocation(&on_one_place(30), 20), 4, "fewer at a time");
    }
}
