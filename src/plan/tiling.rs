//! How much of a picture one submission traces.

use super::{Decision, Kernel, Limits, MOST_PIXELS, Reason, Structure, WORKGROUP};
use crate::algorithm::Description;
use crate::scene::Scene;

/// Pixels: larger tiles save nothing more.
const LARGEST_SIDE: u32 = 1024;

/// Samples of each pixel that one submission of an algorithm that follows chance takes: enough that bringing them back
/// costs nothing beside, few enough for it to be short.
pub const SAMPLES_AT_ONCE: u32 = 8;

pub(super) fn decide(scene: &Scene, kernel: Kernel, generations: u32, limits: &Limits) -> Decision<u32> {
    let largest = LARGEST_SIDE.min(limits.max_image_side);
    let rays = rays_per_pixel(scene, kernel.description(), generations);
    let choice = tile_side(largest, tried_under_boxes(scene.primitives.len()), scene.lights.len(), rays);
    let reason = if choice < largest { Reason::HeavyTiles { largest } } else { Reason::LightTiles };
    Decision { choice, reason }
}

/// Of so many solids, those that a ray of the accurate kernel tests: as a rule no more than one level of boxes can
/// hold. Rays that go far among solids of all kinds, as in `cloud-10000`, take ten times that, and a tile there some 60
/// ms on two cores; those among a million spheres on a plane are as quick as among a hundred.
pub fn tried_under_boxes(solids: usize) -> usize {
    solids.min(Structure::MOST_ALONE * Structure::GROUP)
}

/// Rays that a pixel takes from surface to surface: one a generation, or, where they may be both mirrored and refracted,
/// as many as branches of all generations have; no more of these are counted than make a tile the smallest among a few
/// solids. A path by chance has no branches, and a pixel several paths.
pub fn rays_per_pixel(scene: &Scene, algorithm: &Description, generations: u32) -> u64 {
    const MOST_BRANCHES: u32 = 12;
    if algorithm.is_statistical {
        u64::from(SAMPLES_AT_ONCE) * u64::from(generations)
    } else if scene.has_transmission() {
        u64::from(generations).max((1 << generations.min(MOST_BRANCHES)) - 1)
    } else {
        generations.into()
    }
}

/// Side of a tile, pixels: at most `max`, and so small that one submission makes no more than about 2²⁸ intersection
/// tests, if that leaves it 64 pixels. Each of a pixel's rays is taken to come with a shadow ray a light, and to test so
/// many solids.
/// 2²⁸ tests take lavapipe on two cores a second or two: so long may Ctrl-C and the progress bar wait; on a small GPU
/// they stay far below the seconds after which a driver takes it for hung.
pub fn tile_side(max: u32, tried: usize, lights: usize, rays_per_pixel: u64) -> u32 {
    const TESTS: u64 = 1 << 28;
    let tests_per_pixel = rays_per_pixel * (1 + lights as u64) * (tried as u64 + 1);
    let side = (TESTS / tests_per_pixel).isqrt() as u32;
    // A multiple of what a workgroup traces, side by side and one after another, leaves no invocations idle at the
    // tile's edge.
    const TRACED: u32 = WORKGROUP[1] * MOST_PIXELS;
    max.min((side / TRACED * TRACED).max(TRACED))
}

#[cfg(test)]
mod tests {
    use super::{rays_per_pixel, tile_side, tried_under_boxes};
    use crate::algorithm::Algorithm;
    use crate::scene::gallery;

    #[test]
    fn heavy_scenes_take_small_tiles_and_light_ones_the_largest() {
        assert_eq!(tile_side(1024, 0, 1, 1), 1024);
        assert_eq!(tile_side(1024, 8, 1, 8), 1024);
        assert_eq!(tile_side(1024, 100, 1, 20), 256);
        assert_eq!(tile_side(1024, 100, 1, 1000), 64);
        assert_eq!(tile_side(7, 100, 1, 1000), 7);
        assert_eq!(tile_side(1024, 128, 1, 20), 192, "whole workgroups of eight pixels per invocation");
    }

    #[test]
    fn rays_branch_where_something_lets_light_through() {
        let by = |algorithm: Algorithm, name: &str, generations| {
            rays_per_pixel(&gallery::scene(name).unwrap(), algorithm.description(), generations)
        };
        let rays = |name: &str, generations| by(Algorithm::Whitted, name, generations);
        assert_eq!([1, 20].map(|generations| rays("showcase", generations)), [1, 20]);
        assert_eq!([1, 3, 20, 10_000].map(|generations| rays("glass", generations)), [1, 7, 4095, 10_000]);
        assert_eq!(["showcase", "glass"].map(|name| by(Algorithm::Path, name, 20)), [160, 160]);
    }

    #[test]
    fn under_boxes_many_solids_weigh_no_more_than_some() {
        assert_eq!([0, 100, 128, 129, 1_000_000].map(tried_under_boxes), [0, 100, 128, 128, 128]);
    }
}
