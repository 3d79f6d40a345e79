//! Scenes for comparing algorithms (docs/light-model.md, "One light for all algorithms"): in each something else decides
//! which of them is near the truth.

use glam::DVec3;

use crate::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid};

const RED: DVec3 = DVec3::new(0.8, 0.15, 0.1);
const GREEN: DVec3 = DVec3::new(0.15, 0.65, 0.2);
const WHITE: DVec3 = DVec3::new(0.85, 0.83, 0.78);
const BLUE: DVec3 = DVec3::new(0.2, 0.35, 0.75);

/// A room whose coloured walls shine on each other and on what stands between them.
pub(super) fn room() -> Scene {
    let wall =
        |name: &str, center: DVec3, half_size: DVec3, color| named(name, upright(center, half_size), matt(color));
    let primitives = vec![
        wall("floor", DVec3::new(0.0, -0.1, 0.0), DVec3::new(2.2, 0.1, 2.2), WHITE),
        wall("ceiling", DVec3::new(0.0, 4.1, 0.0), DVec3::new(2.2, 0.1, 2.2), WHITE),
        wall("back", DVec3::new(0.0, 2.0, 2.1), DVec3::new(2.2, 2.2, 0.1), WHITE),
        wall("red wall", DVec3::new(2.1, 2.0, 0.0), DVec3::new(0.1, 2.2, 2.2), RED),
        wall("green wall", DVec3::new(-2.1, 2.0, 0.0), DVec3::new(0.1, 2.2, 2.2), GREEN),
        named("ball", Solid::Sphere { center: DVec3::new(-0.8, 0.7, 0.2), radius: 0.7 }, matt(WHITE)),
        named(
            "block",
            Solid::Box {
                center: DVec3::new(0.8, 1.0, 0.7),
                half_size: DVec3::new(0.55, 1.0, 0.55),
                rotation_degrees: DVec3::new(0.0, 20.0, 0.0),
            },
            matt(WHITE),
        ),
    ];
    Scene {
        camera: towards(DVec3::new(0.0, 2.0, -6.6), DVec3::new(0.0, 2.0, 0.0), 42.0),
        lights: vec![lamp(DVec3::new(0.0, 3.6, 0.0), 0.7)],
        background: DVec3::ZERO,
        max_depth: 12,
        primitives,
        ..Scene::default()
    }
}

/// Figure 1.7: a mirror shows a ball that stands behind the camera, and the back of one before it.
pub(super) fn behind() -> Scene {
    let mirror = Material { reflection: Some(0.9), ..Material::of_course(WHITE, 0.02, 0.05, 0.3) };
    let primitives = vec![
        named("floor", upright(DVec3::new(0.0, -0.1, 0.0), DVec3::new(8.0, 0.1, 8.0)), matt(WHITE)),
        named("mirror", upright(DVec3::new(0.0, 1.6, 4.0), DVec3::new(3.0, 1.6, 0.1)), mirror),
        named("before the camera", Solid::Sphere { center: DVec3::new(0.9, 0.6, 1.8), radius: 0.6 }, matt(RED)),
        named(
            "seen in the mirror alone",
            Solid::Cone {
                apex: DVec3::new(-0.6, 1.8, -5.0),
                axis: DVec3::NEG_Y,
                height: 1.8,
                half_angle_degrees: 25.0,
            },
            matt(GREEN),
        ),
        named(
            "half hidden",
            Solid::Cylinder { ends: [DVec3::new(-1.3, 0.0, 2.6), DVec3::new(-1.3, 1.2, 2.6)], radius: 0.45 },
            matt(BLUE),
        ),
    ];
    Scene {
        camera: towards(DVec3::new(0.0, 1.5, -3.0), DVec3::new(0.0, 1.1, 3.0), 45.0),
        lights: vec![lamp(DVec3::new(2.5, 5.0, -3.0), 0.8)],
        background: DVec3::new(0.25, 0.32, 0.4),
        max_depth: 6,
        primitives,
        ..Scene::default()
    }
}

/// Matt solids so dark and so far from each other that next to no light goes from one to another: where ambient light
/// stands for the sky alone, all algorithms should agree.
pub(super) fn matt_still_life() -> Scene {
    // Of a sky of 0.3 all that a surface gets comes back as albedo * 0.3, which ambient light is made to give.
    let dark = |color: DVec3| Material::of_course(color, 0.3 * 0.25, 0.25, 0.0);
    let primitives = vec![
        named("ball", Solid::Sphere { center: DVec3::new(-3.2, 1.0, 1.0), radius: 1.0 }, dark(RED)),
        named(
            "block",
            Solid::Box {
                center: DVec3::new(0.8, 0.9, 2.6),
                half_size: DVec3::splat(0.9),
                rotation_degrees: DVec3::new(0.0, 30.0, 0.0),
            },
            dark(WHITE),
        ),
        named(
            "drum",
            Solid::Cylinder { ends: [DVec3::new(4.4, 0.1, 0.2), DVec3::new(4.4, 1.9, 0.2)], radius: 0.7 },
            dark(BLUE),
        ),
        named(
            "cone",
            Solid::Cone {
                apex: DVec3::new(-0.4, 1.5, -2.0),
                axis: DVec3::NEG_Y,
                height: 1.5,
                half_angle_degrees: 26.0,
            },
            dark(GREEN),
        ),
    ];
    Scene {
        camera: towards(DVec3::new(0.0, 3.4, -9.0), DVec3::new(0.4, 0.9, 0.5), 38.0),
        lights: vec![lamp(DVec3::new(-6.0, 9.0, -8.0), 1.0)],
        background: DVec3::splat(0.3),
        max_depth: 6,
        primitives,
        ..Scene::default()
    }
}

fn upright(center: DVec3, half_size: DVec3) -> Solid {
    Solid::Box { center, half_size, rotation_degrees: DVec3::ZERO }
}

/// Most of the light that comes to it goes on; ambient light stands for what other surfaces send.
fn matt(color: DVec3) -> Material {
    Material::of_course(color, 0.12, 0.75, 0.0)
}

fn named(name: &str, solid: Solid, material: Material) -> Primitive {
    Primitive { name: Some(name.to_owned()), solid, material }
}

fn lamp(position: DVec3, intensity: f64) -> Light {
    Light { position, intensity: DVec3::splat(intensity), radius: 0.0, ..Light::default() }
}

fn towards(position: DVec3, target: DVec3, vertical_fov_degrees: f64) -> Camera {
    Camera {
        position,
        direction: target - position,
        vertical_fov_degrees,
        projection: Projection::Centered,
        ..Camera::default()
    }
}
