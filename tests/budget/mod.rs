//! Random scenes for what an allowed error may change: mirrors up to specular 1, several lights, huge intensities,
//! closed rooms, faint gloss.

use glam::DVec3;
use zerkalo::scene::{Camera, Light, Material, Primitive, Scene, Solid, SolidKind};

use crate::random::Random;

/// The camera looks at the origin from 6 away at solids of all kinds; every second scene is a closed room around both.
pub fn random_scene(seed: u64) -> Scene {
    let mut random = Random(seed);
    let camera_place = 6.0 * random.unit_vector();
    let finish = if random.chance(0.2) { faint_gloss } else { any_gloss };
    let kinds = SolidKind::ALL.into_iter().cycle().take(4 + seed as usize % 3);
    let mut primitives: Vec<Primitive> = kinds.map(|kind| random_primitive(&mut random, kind, finish)).collect();
    if seed.is_multiple_of(2) {
        let half_size = random.vector(|random| random.uniform(7.0, 12.0));
        let room = Solid::Box { center: DVec3::ZERO, half_size, rotation_degrees: DVec3::ZERO };
        primitives.push(Primitive { name: None, solid: room, material: random_material(&mut random, finish) });
    }
    // Unit, faint, coloured, up to the largest.
    let (low, high) = [(0.0, 0.0), (-4.0, 0.0), (-1.0, 1.0), (-1.0, 0.0), (0.0, 38.0)][seed as usize % 5];
    let lights = (0..random.uniform(0.0, 5.0) as usize).map(|_| Light {
        position: 5.0 * random.vector(|random| random.uniform(-1.0, 1.0)),
        intensity: random.vector(|random| random.magnitude(low, high)),
        ..Light::default()
    });
    Scene {
        lights: lights.collect(),
        camera: Camera {
            position: camera_place,
            direction: -camera_place,
            up: random.unit_vector(),
            vertical_fov_degrees: 60.0,
            ..Camera::default()
        },
        ambient_light: DVec3::ONE,
        background: random.vector(|random| random.uniform(0.0, 1.0)),
        max_depth: [1, 4, 20, 60][random.uniform(0.0, 4.0) as usize],
        primitives,
        animation: Vec::new(),
    }
}

/// A random specular.
type Finish = fn(&mut Random) -> f64;

fn random_primitive(random: &mut Random, kind: SolidKind, finish: Finish) -> Primitive {
    let place = 3.0 * random.vector(|random| random.uniform(-1.0, 1.0));
    let size = random.uniform(0.5, 1.5);
    let axis = random.unit_vector();
    let solid = match kind {
        SolidKind::Sphere => Solid::Sphere { center: place, radius: size },
        SolidKind::Box => Solid::Box {
            center: place,
            half_size: size * random.vector(|random| random.uniform(0.3, 1.0)),
            rotation_degrees: random.vector(|random| random.uniform(0.0, 360.0)),
        },
        SolidKind::Cylinder => Solid::Cylinder { ends: [place, place + 2.0 * size * axis], radius: 0.6 * size },
        SolidKind::Cone => Solid::Cone { apex: place, axis, height: 2.0 * size, half_angle_degrees: 30.0 },
    };
    Primitive { name: None, solid, material: random_material(random, finish) }
}

fn any_gloss(random: &mut Random) -> f64 {
    match random.uniform(0.0, 6.0) as u32 {
        0 => 0.0,
        1 => 1.0,
        2 => random.magnitude(-5.0, -1.0),
        3 => 1.0 - random.magnitude(-5.0, -1.0),
        _ => random.uniform(0.0, 1.0),
    }
}

fn faint_gloss(random: &mut Random) -> f64 {
    random.magnitude(-5.0, -3.0)
}

fn random_material(random: &mut Random, finish: Finish) -> Material {
    Material::of_course(
        random.vector(|random| random.uniform(0.0, 1.0)),
        random.uniform(0.0, 1.0),
        random.uniform(0.0, 1.0),
        finish(random),
    )
}
