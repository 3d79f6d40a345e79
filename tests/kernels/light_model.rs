//! The light model beyond the course work's against the reference: refraction, exponents, attenuation, ambient light.

use crate::common::TestDevice;
use crate::random::Random;
use crate::scenes::{picture, primitive};
use crate::tracers::Tracers;
use glam::DVec3;
use zerkalo::measure::{Difference, tolerances};
use zerkalo::plan::Approximations;
use zerkalo::scene::{Camera, Light, Material, Primitive, Scene, Solid};
use zerkalo::tracer::{Kernel, Precision, Settings, Tracer, TracerError};

const SIZE: [u32; 2] = [88, 50];

fn glass(random: &mut Random) -> Material {
    let transmission = if random.chance(0.7) { random.uniform(0.3, 0.9) } else { 0.0 };
    Material {
        reflection: random.chance(0.7).then(|| random.uniform(0.0, 0.6)),
        shininess: if random.chance(0.5) { random.uniform(1.0, 100.0) } else { random.magnitude(0.0, 3.0) },
        transmission,
        refractive_index: random.uniform(0.6, 2.4),
        ..Material::of_course(
            random.vector(|random| random.uniform(0.0, 1.0)),
            random.uniform(0.0, 0.3),
            random.uniform(0.0, 0.6),
            random.uniform(0.0, 0.6),
        )
    }
}

/// Solids of all kinds that overlap here and there, before a wall; some in a room of glass, in which the camera is, too.
fn random_scene(seed: u64) -> Scene {
    let mut random = Random(seed);
    let place = |random: &mut Random| 2.0 * random.vector(|random| random.uniform(-1.0, 1.0));
    let mut primitives: Vec<Primitive> = Vec::new();
    for _ in 0..2 {
        let (center, axis) = (place(&mut random), random.unit_vector());
        let size = random.uniform(0.4, 1.0);
        let solids = [
            Solid::Sphere { center, radius: size },
            Solid::Box {
                center: place(&mut random),
                half_size: size * random.vector(|random| random.uniform(0.3, 1.0)),
                rotation_degrees: random.vector(|random| random.uniform(0.0, 360.0)),
            },
            Solid::Cylinder { ends: [-center, -center + 2.0 * size * axis], radius: 0.5 * size },
            Solid::Cone { apex: place(&mut random), axis, height: 1.5 * size, half_angle_degrees: 30.0 },
        ];
        primitives.extend(solids.into_iter().map(|solid| primitive(solid, glass(&mut random))));
    }
    let wall =
        Solid::Box { center: DVec3::Z * 9.0, half_size: DVec3::new(20.0, 20.0, 1.0), rotation_degrees: DVec3::ZERO };
    primitives.push(primitive(wall, Material::of_course(DVec3::new(0.8, 0.6, 0.3), 0.3, 0.7, 0.0)));
    if seed.is_multiple_of(3) {
        let room = Solid::Sphere { center: DVec3::ZERO, radius: random.uniform(6.5, 7.5) };
        primitives.push(primitive(room, Material { transmission: 0.8, ..glass(&mut random) }));
    }
    let light = |random: &mut Random, distance_constant| Light {
        position: 5.0 * random.vector(|random| random.uniform(-1.0, 1.0)),
        intensity: random.vector(|random| random.uniform(0.2, 1.0)),
        radius: 0.0,
        distance_constant,
    };
    let fading = light(&mut random, Some(1.0));
    Scene {
        camera: Camera { position: DVec3::Z * -6.0, vertical_fov_degrees: 50.0, ..Camera::default() },
        background: DVec3::new(0.2, 0.3, 0.5),
        ambient_light: DVec3::new(0.9, 1.0, 0.5),
        max_depth: 6,
        lights: vec![fading, light(&mut random, None)],
        primitives,
        ..Scene::default()
    }
}

fn scenes_are_the_references(seeds: std::ops::Range<u64>) {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    for precision in [Precision::F64, Precision::F32] {
        let (largest, share) = tolerances(precision);
        let mut total = Difference::default();
        for seed in seeds.clone() {
            let scene = random_scene(seed);
            scene.validate().unwrap();
            let truth = picture(&scene, SIZE[0], SIZE[1]);
            let settings = Settings { kernel: Kernel::Whitted(precision), ..Settings::new(SIZE[0], SIZE[1]) };
            let difference = Difference::between(&truth, &tracers.draw_f64(&scene, &settings), largest, |_| true);
            if difference.largest > largest || difference.differing > 0 {
                println!("scene {seed}, {}: {difference:?}", precision.name());
            }
            total = total.plus(difference);
        }
        println!("{}: {total:?}", precision.name());
        assert_eq!(total.not_finite, 0);
        assert!(total.largest <= largest, "{}", precision.name());
        assert!(total.differing as f64 <= share * total.discontinuities as f64);
        assert!(total.smooth > 1000 * seeds.clone().count());
    }
}

#[test]
fn glass_of_any_kind_looks_as_the_reference_sees_it() {
    scenes_are_the_references(0..24);
}

#[test]
#[ignore = "takes some minutes"]
fn three_hundred_scenes_of_glass_look_as_the_reference_sees_them() {
    scenes_are_the_references(100..400);
}

/// A lattice of spheres that mirror and let through a little: rays of 2^depth branches.
fn lattice(lights: Vec<Light>) -> Scene {
    let material = Material {
        reflection: Some(0.1),
        transmission: 0.1,
        refractive_index: 1.5,
        ..Material::of_course(DVec3::ONE, 0.0, 1.0, 0.0)
    };
    let mut primitives = Vec::new();
    for x in -2..3 {
        for y in -1..2 {
            for z in 0..2 {
                let center = 1.1 * DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                primitives.push(primitive(Solid::Sphere { center, radius: 0.5 }, material.clone()));
            }
        }
    }
    Scene {
        camera: Camera { position: DVec3::Z * -6.0, vertical_fov_degrees: 40.0, ..Camera::default() },
        background: DVec3::splat(100.0),
        max_depth: 8,
        lights,
        primitives,
        ..Scene::default()
    }
}

/// Nothing adds to a picture that its budget takes from.
#[test]
fn rays_that_weigh_too_little_are_gone() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let scene = lattice(Vec::new());
    for precision in [Precision::F64, Precision::F32] {
        let exact = Settings { kernel: Kernel::Whitted(precision), ..Settings::new(SIZE[0], SIZE[1]) };
        let all = tracers.draw_f64(&scene, &exact);
        // Among them those that are, but for rounding, the weight of a ray.
        for min_throughput in [0.0005, 0.001, 0.005, 0.01, 0.05, 0.1] {
            let approximations = Approximations { min_throughput, ..Approximations::NONE };
            let heavy = tracers.draw_f64(&scene, &Settings { approximations, ..exact.clone() });
            let brightest = all.iter().zip(&heavy).map(|(all, heavy)| (heavy - all).max_element());
            let brightest = brightest.fold(f64::NEG_INFINITY, f64::max);
            // Sums of fewer terms, none negative, in one order: rounding brings none of them above.
            assert!(brightest <= 0.0, "{}, {min_throughput}: {brightest}", precision.name());
            assert!(all != heavy, "{}, {min_throughput}: nothing is cut", precision.name());
        }
    }
}

/// A CPU driver that ends loops too early is found out, whatever loops there are.
#[test]
fn a_picture_of_many_branches_is_whole_or_refused() {
    let device = TestDevice::open();
    let light = |position, radius| Light { position, intensity: DVec3::ONE, radius, distance_constant: None };
    for radius in [0.0, 0.1] {
        let lights = vec![light(DVec3::Z * -6.0, radius), light(DVec3::splat(5.0), radius)];
        let scene = Scene { background: DVec3::ZERO, ..lattice(lights) };
        let mut truth = None;
        for depth in [10, 14, 15, 16] {
            let settings =
                Settings { kernel: Kernel::Whitted(Precision::F32), max_depth: Some(depth), ..Settings::new(60, 40) };
            let picture = match Tracer::new(&device, &scene, &settings).unwrap().render_f64() {
                Ok(picture) => picture,
                Err(TracerError::LoopLimitReached { .. }) => continue,
                Err(error) => panic!("{error}"),
            };
            // What is behind ten hits weighs at most 0.2^10, about 1e-7, and is at most 2 / (1 - 0.2) bright; the rest
            // is the rounding of sums of about 1 in f32.
            let truth = truth.get_or_insert_with(|| picture.clone());
            for (a, b) in truth.iter().zip(&picture) {
                assert!((a - b).abs().max_element() < 1e-6, "lights of radius {radius}, depth {depth}: {a} and {b}");
            }
        }
        assert!(truth.is_some());
    }
}
