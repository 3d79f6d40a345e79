//! What the program draws when nothing else is asked for: the four solids on a floor before a tall mirror, lit from
//! the side.

use glam::DVec3;

use crate::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid};

pub(super) fn scene() -> Scene {
    Scene {
        camera: Camera {
            position: DVec3::new(0.0, 2.6, -9.0),
            direction: DVec3::new(0.0, -0.16, 1.0),
            up: DVec3::Y,
            vertical_fov_degrees: 38.0,
            projection: Projection::Centered,
        },
        background: DVec3::new(0.06, 0.09, 0.14),
        max_depth: 8,
        lights: vec![
            Light { position: DVec3::new(-7.0, 5.0, -4.0), intensity: DVec3::new(0.9, 0.88, 0.82) },
            Light { position: DVec3::new(6.0, 7.0, -6.0), intensity: DVec3::new(0.2, 0.24, 0.32) },
        ],
        primitives: vec![
            Primitive {
                name: Some("floor".into()),
                solid: Solid::Box {
                    center: DVec3::new(0.0, -0.1, 2.0),
                    half_size: DVec3::new(14.0, 0.1, 9.0),
                    rotation_degrees: DVec3::ZERO,
                },
                material: solid_colour(DVec3::new(0.5, 0.52, 0.56), 0.15),
            },
            Primitive {
                name: Some("mirror wall".into()),
                solid: Solid::Box {
                    center: DVec3::new(0.0, 2.6, 6.0),
                    half_size: DVec3::new(5.5, 2.6, 0.05),
                    rotation_degrees: DVec3::new(0.0, 8.0, 0.0),
                },
                material: mirror(DVec3::new(0.8, 0.85, 0.9)),
            },
            Primitive {
                name: Some("mirror ball".into()),
                solid: Solid::Sphere { center: DVec3::new(-0.4, 1.3, 2.2), radius: 1.3 },
                material: mirror(DVec3::new(0.9, 0.9, 0.95)),
            },
            Primitive {
                name: Some("blue ball".into()),
                solid: Solid::Sphere { center: DVec3::new(-1.5, 0.45, -1.8), radius: 0.45 },
                material: solid_colour(DVec3::new(0.15, 0.3, 0.9), 0.3),
            },
            Primitive {
                name: Some("red cube".into()),
                solid: Solid::Box {
                    center: DVec3::new(-3.4, 0.9, 0.6),
                    half_size: DVec3::splat(0.9),
                    rotation_degrees: DVec3::new(0.0, 32.0, 0.0),
                },
                material: solid_colour(DVec3::new(0.85, 0.16, 0.12), 0.2),
            },
            Primitive {
                name: Some("yellow roller".into()),
                solid: Solid::Cylinder {
                    ends: [DVec3::new(2.1, 0.65, -0.3), DVec3::new(4.3, 0.65, 0.7)],
                    radius: 0.65,
                },
                material: solid_colour(DVec3::new(0.95, 0.65, 0.1), 0.2),
            },
            Primitive {
                name: Some("green cone".into()),
                solid: Solid::Cone {
                    apex: DVec3::new(0.9, 1.7, -1.6),
                    axis: DVec3::NEG_Y,
                    height: 1.7,
                    half_angle_degrees: 24.0,
                },
                material: solid_colour(DVec3::new(0.1, 0.6, 0.35), 0.2),
            },
        ],
    }
}

fn solid_colour(color: DVec3, specular: f64) -> Material {
    Material { color, ambient: 0.08, diffuse: 0.75, specular }
}

fn mirror(color: DVec3) -> Material {
    Material { color, ambient: 0.02, diffuse: 0.08, specular: 0.88 }
}
