//! What the program draws when nothing else is asked for: the four solids between two mirrors, lit from the side.
//!
//! One light, since the course's kernel knows only one; and mirrors that the camera sees at a slant, since that
//! kernel's highlight is a headlight spot, which a mirror facing the camera would show as one white sheet.

use glam::DVec3;

use crate::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid};

pub(super) fn scene() -> Scene {
    Scene {
        camera: Camera {
            position: DVec3::new(0.0, 2.7, -9.5),
            direction: DVec3::new(0.0, -0.15, 1.0),
            up: DVec3::Y,
            vertical_fov_degrees: 36.0,
            projection: Projection::Centered,
        },
        background: DVec3::new(0.06, 0.09, 0.14),
        ambient_light: DVec3::ONE,
        max_depth: 8,
        lights: vec![Light {
            position: DVec3::new(7.0, 6.5, -5.0),
            intensity: DVec3::new(1.0, 0.97, 0.9),
            ..Light::default()
        }],
        primitives: vec![
            named(
                "floor",
                Solid::Box {
                    center: DVec3::new(0.0, -0.1, 1.0),
                    half_size: DVec3::new(16.0, 0.1, 10.0),
                    rotation_degrees: DVec3::ZERO,
                },
                Material::of_course(DVec3::new(0.5, 0.52, 0.56), 0.1, 0.6, 0.25),
            ),
            named("left mirror", mirror_wall(4.9, -62.0), MIRROR),
            named("right mirror", mirror_wall(-4.9, 62.0), MIRROR),
            named(
                "mirror ball",
                Solid::Sphere { center: DVec3::new(0.0, 1.35, 2.4), radius: 1.35 },
                Material::of_course(DVec3::new(0.9, 0.9, 0.95), 0.03, 0.15, 0.6),
            ),
            named(
                "blue ball",
                Solid::Sphere { center: DVec3::new(-1.5, 0.55, -1.9), radius: 0.55 },
                painted(DVec3::new(0.12, 0.3, 0.95)),
            ),
            named(
                "red cube",
                Solid::Box {
                    center: DVec3::new(-3.5, 0.9, 0.4),
                    half_size: DVec3::splat(0.9),
                    rotation_degrees: DVec3::new(0.0, 30.0, 0.0),
                },
                painted(DVec3::new(0.9, 0.14, 0.1)),
            ),
            named(
                "yellow roller",
                Solid::Cylinder { ends: [DVec3::new(2.3, 0.7, -0.6), DVec3::new(4.6, 0.7, 0.7)], radius: 0.7 },
                painted(DVec3::new(1.0, 0.68, 0.1)),
            ),
            named(
                "green cone",
                Solid::Cone {
                    apex: DVec3::new(0.8, 1.9, -1.5),
                    axis: DVec3::NEG_Y,
                    height: 1.9,
                    half_angle_degrees: 24.0,
                },
                painted(DVec3::new(0.1, 0.65, 0.35)),
            ),
        ],
        animation: Vec::new(),
    }
}

const MIRROR: Material = Material::of_course(DVec3::new(0.8, 0.85, 0.9), 0.03, 0.06, 0.65);

fn mirror_wall(x: f64, turn_degrees: f64) -> Solid {
    Solid::Box {
        center: DVec3::new(x, 2.3, 3.6),
        half_size: DVec3::new(3.4, 2.3, 0.05),
        rotation_degrees: DVec3::new(0.0, turn_degrees, 0.0),
    }
}

fn painted(color: DVec3) -> Material {
    Material::of_course(color, 0.12, 0.8, 0.2)
}

fn named(name: &str, solid: Solid, material: Material) -> Primitive {
    Primitive { name: Some(name.to_owned()), solid, material }
}
