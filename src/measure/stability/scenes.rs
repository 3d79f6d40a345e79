//! The scenes of the cases of pictures.

use glam::DVec3;

use super::solids::direction;
use crate::scene::{Camera, Light, Material, Primitive, Scene, Solid, SolidKind};

fn material(ambient: f64, diffuse: f64, specular: f64) -> Material {
    Material::of_course(DVec3::new(0.3, 0.5, 0.7), ambient, diffuse, specular)
}

fn primitive(solid: Solid, material: Material) -> Primitive {
    Primitive { name: None, solid, material }
}

fn cube(center: DVec3, half_size: f64) -> Solid {
    Solid::Box { center, half_size: DVec3::splat(half_size), rotation_degrees: DVec3::ZERO }
}

fn light(x: f64, y: f64, z: f64) -> Light {
    Light { position: DVec3::new(x, y, z), intensity: DVec3::ONE, ..Light::default() }
}

/// One of each kind side by side, mirrors of each other.
pub(super) fn mixed() -> Scene {
    let placed = |(place, kind): (usize, SolidKind)| {
        let center = DVec3::new(2.5 * place as f64 - 3.75, 0.0, 0.3 * place as f64);
        let axis = DVec3::new(0.48, -0.6, 0.64);
        let solid = match kind {
            SolidKind::Sphere => Solid::Sphere { center, radius: 1.0 },
            SolidKind::Box => Solid::Box {
                center,
                half_size: DVec3::new(0.8, 0.7, 0.6),
                rotation_degrees: DVec3::new(20.0, 35.0, 50.0),
            },
            SolidKind::Cylinder => Solid::Cylinder { ends: [center - axis, center + axis], radius: 0.7 },
            SolidKind::Cone => Solid::Cone { apex: center - axis, axis, height: 1.5, half_angle_degrees: 30.0 },
        };
        primitive(solid, material(0.1, 0.5, 0.4))
    };
    Scene {
        camera: Camera { position: DVec3::NEG_Z * 12.0, ..Camera::default() },
        lights: vec![light(5.0, 8.0, -30.0)],
        primitives: SolidKind::ALL.into_iter().enumerate().map(placed).collect(),
        ..Scene::default()
    }
}

/// Unit spheres at spacing 2, seen from above.
pub(super) fn balls_in_contact() -> Scene {
    let place = |index: usize| DVec3::new(2.0 * (index % 3) as f64 - 2.0, 2.0 * (index / 3) as f64 - 2.0, 0.0);
    let ball = |index| primitive(Solid::Sphere { center: place(index), radius: 1.0 }, material(0.1, 0.6, 0.3));
    Scene {
        camera: Camera { position: DVec3::NEG_Z * 14.0, ..Camera::default() },
        lights: vec![light(10.0, 10.0, -10.0)],
        primitives: (0..9).map(ball).collect(),
        ..Scene::default()
    }
}

/// Cubes that share faces, and one that overlaps two of them with its top in the plane of theirs, in other colours: all
/// in numbers that every precision stores.
pub(super) fn sharing_cubes() -> Scene {
    let colored =
        |center: DVec3, color: DVec3| primitive(cube(center, 1.0), Material { color, ..material(0.4, 0.6, 0.0) });
    Scene {
        camera: Camera {
            position: DVec3::new(1.0, 8.0, -8.0),
            direction: DVec3::new(0.0, -1.0, 1.0).normalize(),
            ..Camera::default()
        },
        lights: vec![light(4.0, 16.0, -8.0)],
        primitives: vec![
            colored(DVec3::new(-1.0, 0.0, 0.0), DVec3::X),
            colored(DVec3::new(1.0, 0.0, 0.0), DVec3::Y),
            colored(DVec3::new(0.0, 0.0, 0.5), DVec3::Z),
            colored(DVec3::new(3.0, 0.0, 0.0), DVec3::ONE),
        ],
        ..Scene::default()
    }
}

/// A cube of half size 1 at the origin, looked at along z, with one light.
pub(super) fn lit_cube(light_position: DVec3) -> Scene {
    Scene {
        camera: Camera { position: DVec3::NEG_Z * 6.0, ..Camera::default() },
        lights: vec![Light { position: light_position, intensity: DVec3::ONE, ..Light::default() }],
        primitives: vec![primitive(cube(DVec3::ZERO, 1.0), material(0.1, 0.5, 0.5))],
        ..Scene::default()
    }
}

/// The camera in a mirror of every kind, with a mirror ball, no light, and a white background that must not be seen.
pub(super) fn rooms(max_depth: u32) -> Vec<Scene> {
    let slanted = DVec3::new(0.48, 0.6, 0.64);
    let solids = [
        Solid::Box {
            center: DVec3::ZERO,
            half_size: DVec3::splat(3.0),
            rotation_degrees: DVec3::new(10.0, 20.0, 30.0),
        },
        Solid::Sphere { center: DVec3::new(0.1, 0.2, 0.3), radius: 3.0 },
        Solid::Cylinder { ends: [-3.0 * slanted, 3.0 * slanted], radius: 3.0 },
        Solid::Cone { apex: -3.0 * slanted, axis: slanted, height: 8.0, half_angle_degrees: 50.0 },
    ];
    let mirror = material(0.0, 0.0, 1.0);
    let room = |solid| Scene {
        camera: Camera { position: DVec3::new(0.1, 0.2, 0.3), vertical_fov_degrees: 120.0, ..Camera::default() },
        background: DVec3::ONE,
        ambient_light: DVec3::ONE,
        // Dark: the course kernel needs one.
        lights: vec![Light { position: DVec3::new(0.0, 1000.0, 0.0), intensity: DVec3::ZERO, ..Light::default() }],
        max_depth,
        primitives: vec![
            primitive(solid, mirror.clone()),
            primitive(Solid::Sphere { center: DVec3::X, radius: 0.3 }, mirror.clone()),
        ],
        ..Scene::default()
    };
    solids.map(room).to_vec()
}

/// Two large mirror balls beside each other before a background; nothing else shines.
pub(super) fn facing_mirrors(max_depth: u32) -> Scene {
    let ball =
        |x: f64| primitive(Solid::Sphere { center: DVec3::new(x, 0.0, 0.0), radius: 1.0 }, material(0.0, 0.0, 1.0));
    Scene {
        camera: Camera { position: DVec3::new(0.0, 0.5, -8.0), ..Camera::default() },
        lights: vec![Light { position: DVec3::new(0.0, 0.0, -100.0), intensity: DVec3::ZERO, ..Light::default() }],
        primitives: vec![ball(-1.25), ball(1.25)],
        max_depth,
        ..Scene::default()
    }
}

/// Small balls in a ball of radius 4.
pub(super) fn cloud(count: usize) -> Scene {
    let radius = 2.0 / (count as f64).cbrt();
    let ball = |index: usize| {
        let distance = 4.0 * ((index * 7919 % count) as f64 / count as f64).cbrt();
        primitive(Solid::Sphere { center: direction(index, count) * distance, radius }, material(0.2, 0.6, 0.0))
    };
    Scene {
        camera: Camera { position: DVec3::NEG_Z * 20.0, ..Camera::default() },
        lights: vec![light(20.0, 20.0, -20.0)],
        primitives: (0..count).map(ball).collect(),
        max_depth: 1,
        ..Scene::default()
    }
}

/// The scene `scale` times as large about the world's origin, then moved. A light sphere keeps its size.
pub(super) fn moved_and_scaled(scene: &Scene, shift: DVec3, scale: f64) -> Scene {
    let place = |point: DVec3| shift + point * scale;
    let mut scene = scene.clone();
    scene.camera.position = place(scene.camera.position);
    for light in &mut scene.lights {
        light.position = place(light.position);
    }
    for primitive in &mut scene.primitives {
        primitive.solid = super::solids::placed(&primitive.solid, scale, shift);
    }
    scene
}

/// Without highlights and reflections, so that errors are those of hits, normals and shadows.
fn matt() -> Material {
    material(0.2, 0.8, 0.0)
}

fn seen_from(position: DVec3, towards: DVec3, vertical_fov_degrees: f64) -> Camera {
    Camera { position, direction: (towards - position).normalize(), vertical_fov_degrees, ..Camera::default() }
}

/// A unit sphere as many radii away, filling the picture.
pub(super) fn sheet_far_ball(distance: f64) -> Scene {
    Scene {
        camera: seen_from(DVec3::NEG_Z * distance, DVec3::ZERO, 2.0 * (1.3 / distance).atan().to_degrees()),
        lights: vec![light(-2.0 * distance, 2.0 * distance, -2.0 * distance)],
        primitives: vec![primitive(Solid::Sphere { center: DVec3::ZERO, radius: 1.0 }, matt())],
        ..Scene::default()
    }
}

/// A part of a cylinder of length 1, 10⁻⁴ thick, seen obliquely from its own length.
pub(super) fn sheet_thin_cylinder() -> Scene {
    let half_axis = DVec3::new(0.24, 0.32, 0.3);
    let position = DVec3::new(0.2, 0.1, -1.0);
    Scene {
        camera: seen_from(position, DVec3::ZERO, (2e-4_f64 / position.length()).to_degrees()),
        lights: vec![light(-20.0, 20.0, -20.0)],
        primitives: vec![primitive(Solid::Cylinder { ends: [-half_axis, half_axis], radius: 5e-5 }, matt())],
        ..Scene::default()
    }
}

/// A sphere and a cone on a floor, with their shadows.
pub(super) fn sheet_ball_on_floor() -> Scene {
    let floor =
        Solid::Box { center: DVec3::NEG_Y, half_size: DVec3::new(6.0, 1.0, 6.0), rotation_degrees: DVec3::ZERO };
    let ball = Solid::Sphere { center: DVec3::new(-1.0, 1.0, 0.0), radius: 1.0 };
    let cone =
        Solid::Cone { apex: DVec3::new(1.5, 2.0, 0.5), axis: DVec3::NEG_Y, height: 2.0, half_angle_degrees: 25.0 };
    Scene {
        camera: seen_from(DVec3::new(0.0, 3.0, -9.0), DVec3::new(0.0, 0.8, 0.0), 32.0),
        // So far that its sphere, which has one size in every scene, is not in the picture.
        lights: vec![light(-60.0, 90.0, -60.0)],
        primitives: [floor, ball, cone].map(|solid| primitive(solid, matt())).to_vec(),
        ..Scene::default()
    }
}
