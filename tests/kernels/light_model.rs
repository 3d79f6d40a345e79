//! The light model beyond the course work's against the reference: refraction, exponents, attenuation, ambient light.

use crate::common::TestDevice;
use crate::random::Random;
use crate::scenes::{picture, primitive};
use crate::tracers::Tracers;
use glam::DVec3;
use zerkalo::measure::{Difference, tolerances};
use zerkalo::scene::{Camera, Light, Material, Primitive, Scene, Solid};
use zerkalo::tracer::{Kernel, Precision, Settings};

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
