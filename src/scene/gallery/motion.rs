//! Scenes that move: each four seconds, the first and the last without a seam from its end to its start.

use glam::DVec3;

use super::showcase;
use crate::scene::{
    Camera, Interpolation, Keyframe, Light, Material, Part, Primitive, Projection, Scene, Solid, Track, Value,
};

const SECONDS: f64 = 4.0;

/// Once around the showcase's solids.
pub(super) fn orbit() -> Scene {
    const VIEWS: u32 = 12;
    let mut scene = showcase::scene();
    // The walls would stand in the way.
    scene.primitives.retain(|primitive| !primitive.name.as_ref().is_some_and(|name| name.ends_with("mirror")));
    let view = |index: u32| {
        let angle = f64::from(index % VIEWS) / f64::from(VIEWS) * std::f64::consts::TAU;
        let (sin, cos) = angle.sin_cos();
        keyframe(
            f64::from(index) / f64::from(VIEWS) * SECONDS,
            Value::Vector(DVec3::new(0.4 + 9.0 * sin, 3.0 + 1.2 * sin, 0.2 - 9.0 * cos)),
        )
    };
    scene.animation = vec![
        smooth(Part::Scene, "camera.position", (0..=VIEWS).map(view).collect()),
        smooth(Part::Scene, "camera.look_at", vec![keyframe(0.0, Value::Vector(DVec3::new(0.4, 0.7, 0.2)))]),
    ];
    scene
}

/// Between two mirrors that face each other, past balls and columns. What stands on the floor goes a little into it: of
/// faces that are one, rounding decides which is seen.
pub(super) fn dolly() -> Scene {
    let mirror = Material::of_course(DVec3::new(0.8, 0.85, 0.9), 0.02, 0.05, 0.8);
    let painted = |color| Material::of_course(color, 0.12, 0.75, 0.2);
    let plain = |solid, material| Primitive { name: None, solid, material };
    let slab = |x, half_x| Solid::Box {
        center: DVec3::new(x, 1.45, 8.1),
        half_size: DVec3::new(half_x, 1.55, 11.7),
        rotation_degrees: DVec3::ZERO,
    };
    let floor = Solid::Box {
        center: DVec3::new(0.0, -0.1, 8.0),
        half_size: DVec3::new(3.0, 0.1, 12.0),
        rotation_degrees: DVec3::ZERO,
    };
    let mut primitives = vec![
        plain(floor, Material::of_course(DVec3::new(0.55, 0.5, 0.45), 0.15, 0.6, 0.1)),
        plain(slab(-2.2, 0.05), mirror.clone()),
        plain(slab(2.2, 0.05), mirror),
    ];
    let colors = [DVec3::new(0.9, 0.2, 0.1), DVec3::new(0.1, 0.6, 0.9), DVec3::new(0.95, 0.75, 0.1)];
    for index in 0..6_u32 {
        let side = if index % 2 == 0 { 1.2 } else { -1.2 };
        let (place, color) =
            (DVec3::new(side, -0.02, 2.0 + 2.5 * f64::from(index)), colors[index as usize % colors.len()]);
        let solid = if index % 3 == 2 {
            Solid::Cylinder { ends: [place, place + 2.2 * DVec3::Y], radius: 0.3 }
        } else {
            Solid::Sphere { center: place + 0.6 * DVec3::Y, radius: 0.6 }
        };
        primitives.push(plain(solid, painted(color)));
    }
    let light = |z: f64| Light {
        position: DVec3::new(0.0, 2.8, z),
        intensity: DVec3::splat(2.5),
        distance_constant: Some(1.0),
        ..Light::default()
    };
    let through =
        [(0.0, DVec3::new(-0.1, 1.3, -4.0)), (2.0, DVec3::new(0.5, 1.1, 4.0)), (SECONDS, DVec3::new(-0.1, 1.3, 12.0))];
    Scene {
        camera: Camera {
            position: through[0].1,
            direction: DVec3::new(0.03, -0.04, 1.0),
            up: DVec3::Y,
            vertical_fov_degrees: 50.0,
            projection: Projection::Centered,
        },
        background: DVec3::new(0.05, 0.07, 0.1),
        ambient_light: DVec3::splat(0.8),
        max_depth: 8,
        lights: vec![light(1.0), light(9.0)],
        primitives,
        animation: vec![smooth(
            Part::Scene,
            "camera.position",
            through.map(|(seconds, place)| keyframe(seconds, Value::Vector(place))).to_vec(),
        )],
    }
}

/// The adjustable reflection of the course work's title: every surface of the showcase from none to all and back.
pub(super) fn reflection() -> Scene {
    let mut scene = showcase::scene();
    let risen = |index| {
        let values = [(0.0, 0.0), (SECONDS / 2.0, 1.0), (SECONDS, 0.0)];
        let keyframes = values.map(|(seconds, value)| keyframe(seconds, Value::Number(value))).to_vec();
        smooth(Part::Primitive(index), "material.reflection", keyframes)
    };
    scene.animation = (0..scene.primitives.len()).map(risen).collect();
    scene
}

fn keyframe(seconds: f64, value: Value) -> Keyframe {
    Keyframe { seconds, value }
}

fn smooth(part: Part, field: &'static str, keyframes: Vec<Keyframe>) -> Track {
    Track { part, field, interpolation: Interpolation::CatmullRom, keyframes }
}
