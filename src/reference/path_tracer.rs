//! The light model with the light that surfaces send each other: in place of ambient light, a surface's diffuse part
//! gathers what comes from everywhere, the background included.
//!
//! One path a sample: where Whitted's rays branch, a path goes one of the ways at random.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use glam::{DVec2, DVec3};

use super::camera::unit;
use super::path::Path;
use super::random::Random;
use super::ray::{Hit, OriginSurface, Ray};
use super::shade::{Leg, finite};
use super::{PrimaryRays, RenderError, World, by_rows};
use crate::scene::Scene;

/// From this generation on (0 is the primary ray) a path may end by chance: the generations before it, which bring most
/// of the light, are spared that noise.
const FIRST_AT_RISK: u32 = 4;

/// The least chance of going on: what goes on is divided by it, and a smaller one would leave so much to so few paths
/// that the estimated variance could miss them all.
const LEAST_SURVIVAL: f64 = 0.2;

/// What is known of a pixel after some samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Linear RGB, not limited to 1, but finite.
    pub mean: DVec3,
    /// How far `mean` is expected to be from the truth, squared: the samples' variance divided by their number, as
    /// estimated from the samples themselves. Finite: the largest number where a single sample tells nothing of it.
    pub variance_of_mean: DVec3,
}

/// Estimates a scene's pixels, row by row, the top row first, in parallel over rows on rayon's current pool.
///
/// Each pixel is its square's average. The estimate has no bias: its expected value is the light model's truncated
/// after `max_depth` generations, without ambient light and with
///
/// k_d·C·(1/π)·∫ L·cos θ dω
///
/// in its place, L being what comes from a direction of the hemisphere on the ray's side of the surface. Light spheres
/// are seen by primary rays alone.
///
/// A seed gives the same numbers on every number of threads. `progress` is that of [`render`](super::render).
///
/// # Errors
///
/// [`RenderError`]: a side or `samples` is 0, the pixels do not fit in memory, or `progress` answered with a break.
pub fn path_trace(
    scene: &Scene,
    width: u32,
    height: u32,
    samples: u32,
    seed: u64,
    progress: &(dyn Fn(u32) -> ControlFlow<()> + Sync),
) -> Result<Vec<Estimate>, RenderError> {
    if samples == 0 {
        return Err(RenderError::NoSamples);
    }
    let world = World::new(scene);
    let primary_rays = PrimaryRays::new(&scene.camera, width, height);
    let draw = |column: u32, row: u32| {
        let pixel = u64::from(row) * u64::from(width) + u64::from(column);
        let corner = DVec2::new(column.into(), row.into());
        let mut moments = Moments::default();
        for sample in 0..samples {
            let mut random = Random::of_sample(seed, pixel, sample);
            let point = corner + DVec2::new(random.number(), random.number());
            moments.add(world.sample(primary_rays.through_point(point), &mut random));
        }
        moments.estimate()
    };
    by_rows(width, height, Moments::default().estimate(), draw, progress)
}

impl World<'_> {
    /// What one path that begins with a primary ray of unit direction brings back.
    fn sample(&self, primary: Ray, random: &mut Random) -> DVec3 {
        let ray = self.relative(&primary);
        let mut nearest = self.solids.nearest(&ray, OriginSurface::Free);
        if let Some(light) = self.light_sphere_before(&ray, nearest.as_ref()) {
            return finite(self.scene.lights[light as usize].intensity);
        }
        let mut leg = self.first_leg(ray);
        let mut throughput = DVec3::ONE;
        let mut radiance = DVec3::ZERO;
        while leg.generation < self.scene.max_depth {
            let Some(hit) = nearest else { return finite(radiance + finite(throughput * self.scene.background)) };
            let material = &self.scene.primitives[hit.primitive as usize].material;
            let direct = self.with_direct_light(DVec3::ZERO, &hit, leg.ray.direction, material, &mut Path::default());
            radiance = finite(radiance + finite(throughput * direct));
            if leg.generation + 1 == self.scene.max_depth {
                break;
            }
            let Some(next) = self.successor(&leg, &hit, throughput, random) else { break };
            (leg, throughput) = next;
            nearest = self.solids.nearest(&leg.ray, leg.origin_surface);
        }
        radiance
    }

    /// The one way on from a hit, and the throughput there; `None` where the path ends.
    ///
    /// A way's chance is as the largest channel of the throughput that it would have: the throughput's largest channel
    /// is then, whichever way is taken, the sum of those of all, so that no way's luck makes a pixel bright.
    fn successor(&self, leg: &Leg, hit: &Hit, throughput: DVec3, random: &mut Random) -> Option<(Leg, DVec3)> {
        let largest = throughput.max_element();
        if largest == 0.0 {
            return None;
        }
        // With 1 as its largest channel, so that only one factor of the new throughput can overflow.
        let tint = throughput / largest;
        let material = &self.scene.primitives[hit.primitive as usize].material;
        let [first, second] = self.onward(&Leg { weight: 1.0, ..*leg }, hit, &mut Path::default());
        let ray = Ray { origin: hit.point, direction: cosine_distributed(hit.normal, random) };
        let generation = leg.generation + 1;
        let diffuse = Leg { ray, origin_surface: hit.origin_surface(), generation, ..*leg };
        let branches = [first, second].into_iter().flatten().map(|leg| (leg, tint * leg.weight));
        let ways = std::iter::once((diffuse, tint * (material.diffuse * material.color))).chain(branches);
        let ways: Vec<_> = ways.filter(|(_, weight)| weight.max_element() > 0.0).collect();
        let total: f64 = ways.iter().map(|(_, weight)| weight.max_element()).sum();
        let mut mark = random.number() * total;
        let chosen = ways.iter().find(|(_, weight)| {
            mark -= weight.max_element();
            mark < 0.0
        });
        // Rounding may leave the mark at the end of the last one.
        let (next, weight) = *chosen.or(ways.last())?;
        let throughput = weight / weight.max_element() * (largest * total).min(f64::MAX);
        if generation < FIRST_AT_RISK {
            return Some((next, throughput));
        }
        let survival = throughput.max_element().clamp(LEAST_SURVIVAL, 1.0);
        (random.number() < survival).then(|| (next, finite(throughput / survival)))
    }
}

/// A unit direction on a unit normal's side, its density as the cosine of the angle between them, which is never 0.
fn cosine_distributed(normal: DVec3, random: &mut Random) -> DVec3 {
    // Over the unit disk all alike, then straight up to the hemisphere.
    let radius_squared = random.number();
    let (sin, cos) = (TAU * random.number()).sin_cos();
    let (x, y) = normal.any_orthonormal_pair();
    unit(radius_squared.sqrt() * (cos * x + sin * y) + (1.0 - radius_squared).sqrt() * normal)
}

/// Mean and variance of numbers one by one, by Welford's recurrence: no sum of squares that cancels.
#[derive(Debug, Clone, Copy, Default)]
struct Moments {
    count: u32,
    mean: DVec3,
    squared_differences: DVec3,
}

impl Moments {
    fn add(&mut self, sample: DVec3) {
        self.count += 1;
        let before = sample - self.mean;
        self.mean += before / f64::from(self.count);
        self.squared_differences = finite(self.squared_differences + finite(before * (sample - self.mean)));
    }

    fn estimate(&self) -> Estimate {
        let variance_of_mean = match self.count {
            0 | 1 => DVec3::MAX,
            count => self.squared_differences / f64::from(count - 1) / f64::from(count),
        };
        Estimate { mean: self.mean, variance_of_mean }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Light, Material, Primitive, Solid, SolidKind, gallery};

    /// Relative, where the samples do not differ.
    const ROUNDING: f64 = 1e-12;

    fn estimates(scene: &Scene, [width, height]: [u32; 2], samples: u32, seed: u64) -> Vec<Estimate> {
        path_trace(scene, width, height, samples, seed, &|_| ControlFlow::Continue(())).expect("a small picture")
    }

    /// Along one ray.
    fn estimate_along(world: &World, ray: Ray, samples: u32) -> Estimate {
        let mut moments = Moments::default();
        for sample in 0..samples {
            moments.add(world.sample(ray, &mut Random::of_sample(5, 0, sample)));
        }
        moments.estimate()
    }

    /// Of all pixels together.
    fn average(pixels: &[Estimate]) -> Estimate {
        let count = pixels.len() as f64;
        let mean = pixels.iter().map(|pixel| pixel.mean).sum::<DVec3>() / count;
        let variance = pixels.iter().map(|pixel| pixel.variance_of_mean).sum::<DVec3>() / (count * count);
        Estimate { mean, variance_of_mean: variance }
    }

    /// Within four standard errors, and these within a hundredth.
    fn assert_is(estimate: Estimate, expected: DVec3, about: &str) {
        let error = estimate.variance_of_mean.map(f64::sqrt);
        assert!(error.cmple(1e-2 * expected).all(), "{about}: {estimate:?} says too little");
        let off = (estimate.mean - expected).abs();
        assert!(off.cmple(4.0 * error + ROUNDING * expected).all(), "{about}: {estimate:?}, not {expected:?}");
    }

    fn matt(diffuse: f64, color: DVec3) -> Material {
        Material { reflection: Some(0.0), ..Material::of_course(color, 1.0, diffuse, 0.0) }
    }

    fn primitive(solid: Solid, material: Material) -> Primitive {
        Primitive { name: None, solid, material }
    }

    fn ball(center: DVec3, radius: f64, material: Material) -> Primitive {
        primitive(Solid::Sphere { center, radius }, material)
    }

    #[test]
    fn in_a_ball_lit_from_its_centre_light_is_a_geometric_series() {
        let intensity = DVec3::new(1.0, 2.0, 0.5);
        let grey = [0.1, 0.5, 0.9].map(|albedo| (matt(albedo, DVec3::ONE), DVec3::splat(albedo)));
        let color = DVec3::new(0.9, 0.5, 0.1);
        let mirror = Material { reflection: Some(0.5), ..matt(0.3, color) };
        let others = [(matt(1.0, color), color), (mirror, 0.3 * color + 0.5)];
        for (material, albedo) in grey.into_iter().chain(others) {
            for max_depth in [1, 2, 3, 5, 8, 50] {
                let scene = Scene {
                    camera: Camera { position: DVec3::new(0.2, -0.3, 0.1), ..Camera::default() },
                    // Must not be seen.
                    background: DVec3::splat(100.0),
                    max_depth,
                    lights: vec![Light { intensity, radius: 0.0, ..Light::default() }],
                    primitives: vec![ball(DVec3::ZERO, 1.0, material.clone())],
                    ..Scene::default()
                };
                let from_light = material.diffuse * material.color * intensity;
                let series = (1.0 - albedo.powf(max_depth.into())) / (1.0 - albedo);
                let seen = average(&estimates(&scene, [12, 12], 128, 1));
                assert_is(seen, from_light * series, &format!("{albedo} {max_depth}"));
            }
        }
    }

    #[test]
    fn what_absorbs_nothing_is_as_bright_as_the_sky_around_it() {
        let white = matt(1.0, DVec3::ONE);
        let mirror = Material { reflection: Some(0.3), ..matt(0.7, DVec3::ONE) };
        let transmitting = Material { reflection: Some(0.2), transmission: 0.4, ..matt(0.4, DVec3::ONE) };
        let glass = Material { refractive_index: 1.5, ..transmitting };
        for material in [white, mirror, glass] {
            let places = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y];
            let all = SolidKind::ALL.map(|kind| primitive(Solid::course_default(kind), material.clone()));
            let each = all.clone().map(|primitive| vec![primitive]);
            let apart = places.map(|place| ball(place, 0.9, material.clone())).to_vec();
            for primitives in each.into_iter().chain([all.to_vec(), apart]) {
                let camera =
                    Camera { position: DVec3::new(1.0, 2.0, -6.0), vertical_fov_degrees: 25.0, ..Camera::default() };
                let camera = Camera { direction: -camera.position, ..camera };
                let background = DVec3::ONE;
                let scene =
                    Scene { camera, background, max_depth: 1000, lights: vec![], primitives, ..Scene::default() };
                let world = World::new(&scene);
                let primary_rays = PrimaryRays::new(&scene.camera, 8, 8);
                let mut pixels = (0..8).flat_map(|row| (0..8).map(move |column| (column, row)));
                let is_solid =
                    |(column, row)| world.nearest(&primary_rays.through(column, row), OriginSurface::Free).is_some();
                assert!(pixels.any(is_solid), "{:?}", scene.primitives);
                for estimate in estimates(&scene, [8, 8], 16, 2) {
                    assert_is(estimate, background, &format!("{:?}", scene.primitives));
                }
            }
        }
    }

    #[test]
    fn a_black_ball_takes_its_solid_angle_from_a_floor_below_it() {
        let (center, radius) = (DVec3::new(0.5, 2.0, 0.3), 0.8);
        let (diffuse, color, background) = (0.8, DVec3::new(0.9, 0.5, 0.2), DVec3::new(1.0, 2.0, 0.5));
        let half_size = DVec3::new(100.0, 1.0, 100.0);
        let floor = Solid::Box { center: DVec3::NEG_Y, half_size, rotation_degrees: DVec3::ZERO };
        let primitives = vec![ball(center, radius, matt(0.0, DVec3::ONE)), primitive(floor, matt(diffuse, color))];
        for max_depth in [2, 7] {
            let scene =
                Scene { background, max_depth, lights: vec![], primitives: primitives.clone(), ..Scene::default() };
            let world = World::new(&scene);
            for place in [DVec3::ZERO, DVec3::new(1.5, 0.0, -1.0), DVec3::new(-3.0, 0.0, 2.0)] {
                let origin = place + DVec3::new(2.0, 0.5, -3.0);
                let ray = Ray { origin, direction: (place - origin).normalize() };
                let to_ball = center - place;
                let distance = to_ball.length();
                // All of it is above the floor: its form factor as seen from there.
                let hidden = (radius / distance).powi(2) * (to_ball.y / distance);
                let expected = diffuse * color * background * (1.0 - hidden);
                assert_is(estimate_along(&world, ray, 40_000), expected, &format!("{place}"));
            }
        }
    }

    #[test]
    fn a_pixel_is_the_average_over_its_square() {
        let (center, half_size) = (DVec3::new(-0.125, 0.3, 1.5), DVec3::new(0.375, 0.6, 0.5));
        let solid = Solid::Box { center, half_size, rotation_degrees: DVec3::ZERO };
        let camera = Camera { position: DVec3::ZERO, vertical_fov_degrees: 90.0, ..Camera::default() };
        let primitives = vec![primitive(solid, matt(0.0, DVec3::ONE))];
        let scene = Scene { camera, background: DVec3::ONE, lights: vec![], primitives, ..Scene::default() };
        const SAMPLES: u32 = 20_000;
        let seen = estimates(&scene, [1, 1], SAMPLES, 3)[0];
        // At the distance 1, where its front is, the picture is 2 wide and 2 high.
        let open = 1.0 - half_size.x * half_size.y;
        assert_is(seen, DVec3::splat(open), "the part beside the box");
        let expected = seen.mean * (1.0 - seen.mean) / f64::from(SAMPLES - 1);
        assert!((seen.variance_of_mean - expected).abs().max_element() < ROUNDING, "{seen:?}");
    }

    #[test]
    fn without_light_between_surfaces_it_is_whitted_s_model() {
        const WIDTH: u32 = 18;
        const HEIGHT: u32 = 12;
        for name in ["showcase", "glass"] {
            let gallery = gallery::scene(name).expect("a scene of the gallery");
            let scene = Scene { ambient_light: DVec3::ZERO, ..gallery };
            let pixels = || (0..HEIGHT).flat_map(|row| (0..WIDTH).map(move |column| (column, row)));
            let primary_rays = PrimaryRays::new(&scene.camera, WIDTH, HEIGHT);

            // Of one generation, whose samples are no matter of chance.
            let shallow = Scene { max_depth: 1, ..scene.clone() };
            let world = World::new(&shallow);
            for (column, row) in pixels() {
                let ray = primary_rays.through(column, row);
                let sample = world.sample(ray, &mut Random::of_sample(0, 0, 0));
                assert_eq!(sample, world.look_along(ray).color, "{name}: column {column}, row {row}");
            }

            // Of mirrors and glass, which go on as there, if by chance.
            let mut clear = scene;
            for primitive in &mut clear.primitives {
                primitive.material.diffuse = 0.0;
            }
            let world = World::new(&clear);
            let rays = || pixels().map(|(column, row)| primary_rays.through(column, row));
            let seen: Vec<Estimate> = rays().map(|ray| estimate_along(&world, ray, 1000)).collect();
            let expected: DVec3 = rays().map(|ray| world.look_along(ray).color).sum();
            assert_is(average(&seen), expected / seen.len() as f64, name);
        }
    }

    #[test]
    fn a_seed_decides_the_picture_and_other_seeds_agree_with_it() {
        let scene = gallery::scene("showcase").expect("a scene of the gallery");
        let draw = |seed| estimates(&scene, [18, 12], 32, seed);
        let first = draw(1);
        let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        assert_eq!(first, one_thread.install(|| draw(1)));
        let second = draw(2);
        assert_ne!(first, second);
        let expected = first.iter().chain(&second).map(|pixel| pixel.variance_of_mean).sum::<DVec3>();
        let squared = |(a, b): (&Estimate, &Estimate)| (a.mean - b.mean) * (a.mean - b.mean);
        let ratio = first.iter().zip(&second).map(squared).sum::<DVec3>() / expected;
        assert!(ratio.cmpgt(DVec3::splat(0.7)).all() && ratio.cmplt(DVec3::splat(1.4)).all(), "{ratio}");
    }

    #[test]
    fn estimates_are_finite_whatever_the_light() {
        let light = Light { intensity: DVec3::new(f64::MAX, 1.0, 0.0), radius: 0.0, ..Light::default() };
        let material = Material { reflection: Some(1.0), ..matt(1.0, DVec3::new(1.0, 1.0, 0.0)) };
        let scene = Scene {
            camera: Camera { position: DVec3::new(0.2, -0.3, 0.1), ..Camera::default() },
            max_depth: 1100,
            lights: vec![light; 2],
            primitives: vec![ball(DVec3::ZERO, 1.0, material)],
            ..Scene::default()
        };
        for samples in [1, 2, 5] {
            for Estimate { mean, variance_of_mean } in estimates(&scene, [2, 2], samples, 1) {
                assert!(mean.is_finite() && variance_of_mean.is_finite(), "{mean} {variance_of_mean}");
                // With a throughput that doubles in each generation even a light of 1 gets there.
                assert_eq!(mean, DVec3::new(f64::MAX, f64::MAX, 0.0));
            }
        }
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        let go_on: &(dyn Fn(u32) -> ControlFlow<()> + Sync) = &|_| ControlFlow::Continue(());
        let scene = Scene::default();
        assert_eq!(path_trace(&scene, 0, 5, 1, 0, go_on), Err(RenderError::Empty { width: 0, height: 5 }));
        assert_eq!(path_trace(&scene, 5, 5, 0, 0, go_on), Err(RenderError::NoSamples));
        assert_eq!(path_trace(&scene, 5, 5, 1, 0, &|_| ControlFlow::Break(())), Err(RenderError::Cancelled));
    }
}
