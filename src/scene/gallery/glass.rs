//! Scenes of the light model beyond the course work's program: refraction, and lights that fade.

use glam::DVec3;

use crate::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid};

/// Four solids of glass before a wall of coloured panes, which each of them shows in its own way.
pub(super) fn scene() -> Scene {
    let mut primitives = vec![plain(
        Solid::Box {
            center: DVec3::new(0.0, -0.5, 4.0),
            half_size: DVec3::new(14.0, 0.5, 9.0),
            rotation_degrees: DVec3::ZERO,
        },
        painted(DVec3::new(0.55, 0.55, 0.5)),
    )];
    let colors = [
        DVec3::new(0.85, 0.2, 0.15),
        DVec3::new(0.95, 0.7, 0.15),
        DVec3::new(0.2, 0.55, 0.3),
        DVec3::new(0.15, 0.35, 0.8),
        DVec3::new(0.9, 0.88, 0.82),
    ];
    for column in 0..8 {
        for row in 0..3 {
            let center = DVec3::new(-7.0 + 2.0 * f64::from(column), 1.0 + 2.0 * f64::from(row), 7.0);
            let pane = Solid::Box { center, half_size: DVec3::new(0.97, 0.97, 0.2), rotation_degrees: DVec3::ZERO };
            primitives.push(plain(pane, painted(colors[(column + 3 * row) as usize % colors.len()])));
        }
    }
    let solids = [
        ("ball lens", Solid::Sphere { center: DVec3::new(2.6, 1.15, 0.6), radius: 1.15 }, 1.5),
        (
            "prism",
            Solid::Box {
                center: DVec3::new(-2.5, 0.95, 1.2),
                half_size: DVec3::new(0.75, 0.95, 0.75),
                rotation_degrees: DVec3::new(0.0, 33.0, 0.0),
            },
            1.5,
        ),
        (
            "water glass",
            Solid::Cylinder { ends: [DVec3::new(0.2, 0.0, 2.2), DVec3::new(0.2, 2.2, 2.2)], radius: 0.8 },
            1.33,
        ),
        (
            "glass cone",
            Solid::Cone {
                apex: DVec3::new(-0.7, 1.5, -0.9),
                axis: DVec3::NEG_Y,
                height: 1.5,
                half_angle_degrees: 24.0,
            },
            1.5,
        ),
    ];
    primitives.extend(solids.map(|(name, solid, refractive_index)| Primitive {
        name: Some(name.to_owned()),
        solid,
        material: Material {
            reflection: Some(0.1),
            shininess: 200.0,
            transmission: 0.88,
            refractive_index,
            ..Material::of_course(DVec3::new(0.9, 0.95, 1.0), 0.01, 0.02, 0.6)
        },
    }));
    Scene {
        camera: camera(DVec3::new(0.3, 2.4, -8.5), DVec3::new(0.0, -0.13, 1.0)),
        background: DVec3::new(0.25, 0.32, 0.42),
        max_depth: 10,
        lights: vec![Light {
            position: DVec3::new(6.0, 8.0, -6.0),
            intensity: DVec3::new(1.0, 0.98, 0.94),
            ..Light::default()
        }],
        primitives,
        ..Scene::default()
    }
}

/// A row of balls by a lamp that fades with distance (equation 1.16), in a weak ambient light.
pub(super) fn fading() -> Scene {
    let ball = |place: u32| {
        let center = DVec3::new(-2.0 + 0.9 * f64::from(place), 0.5, 1.6 * f64::from(place));
        let material = Material { shininess: 40.0, ..Material::of_course(DVec3::new(0.9, 0.55, 0.2), 0.3, 0.8, 0.2) };
        plain(Solid::Sphere { center, radius: 0.5 }, material)
    };
    let floor = Solid::Box {
        center: DVec3::new(0.0, -0.1, 6.0),
        half_size: DVec3::new(12.0, 0.1, 14.0),
        rotation_degrees: DVec3::ZERO,
    };
    let mut primitives = vec![plain(floor, Material::of_course(DVec3::new(0.5, 0.55, 0.65), 0.3, 0.8, 0.0))];
    primitives.extend((0..7).map(ball));
    Scene {
        camera: camera(DVec3::new(1.0, 2.2, -6.0), DVec3::new(0.0, -0.16, 1.0)),
        background: DVec3::new(0.02, 0.025, 0.04),
        ambient_light: DVec3::new(0.25, 0.28, 0.4),
        max_depth: 4,
        lights: vec![Light {
            position: DVec3::new(-2.6, 2.2, -1.2),
            intensity: DVec3::new(4.5, 4.0, 3.2),
            radius: 0.08,
            distance_constant: Some(0.5),
        }],
        primitives,
        ..Scene::default()
    }
}

fn camera(position: DVec3, direction: DVec3) -> Camera {
    Camera { position, direction, up: DVec3::Y, vertical_fov_degrees: 34.0, projection: Projection::Centered }
}

fn painted(color: DVec3) -> Material {
    Material::of_course(color, 0.15, 0.75, 0.0)
}

fn plain(solid: Solid, material: Material) -> Primitive {
    Primitive { name: None, solid, material }
}
