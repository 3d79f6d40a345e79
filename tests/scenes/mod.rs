//! What the tests of whole pictures are made of.

use std::ops::ControlFlow;

use glam::DVec3;
use zerkalo::reference::{Image64, render};
use zerkalo::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid, SolidKind};

pub fn picture(scene: &Scene, width: u32, height: u32) -> Image64 {
    render(scene, width, height, &|_| ControlFlow::Continue(())).expect("a picture")
}

pub fn material(ambient: f64, diffuse: f64, specular: f64) -> Material {
    Material::of_course(DVec3::new(0.3, 0.5, 0.7), ambient, diffuse, specular)
}

pub fn mirror() -> Material {
    material(0.0, 0.0, 1.0)
}

pub fn primitive(solid: Solid, material: Material) -> Primitive {
    Primitive { name: None, solid, material }
}

pub fn sphere(center: DVec3, radius: f64) -> Solid {
    Solid::Sphere { center, radius }
}

pub fn cube(center: DVec3, half_size: f64) -> Solid {
    Solid::Box { center, half_size: DVec3::splat(half_size), rotation_degrees: DVec3::ZERO }
}

pub fn light(x: f64, y: f64, z: f64) -> Light {
    Light { position: DVec3::new(x, y, z), intensity: DVec3::ONE, ..Light::default() }
}

/// Nothing but a light, somewhere near a camera of any direction and window.
pub fn scene_of_a_light(index: u32) -> Scene {
    // Numbers in [-1, 1), spread evenly (Roberts' R sequence in so many dimensions is good enough).
    let number = |dimension: i32| (f64::from(index) * 1.1673f64.powi(-dimension)).fract() * 2.0 - 1.0;
    let camera = Camera {
        position: DVec3::new(number(1), number(2), number(3)) * 0.3,
        direction: DVec3::new(number(4), number(5), number(6) + 0.1),
        vertical_fov_degrees: 70.0 + 60.0 * number(7),
        projection: if index.is_multiple_of(2) { Projection::Centered } else { Projection::Course },
        ..Camera::default()
    };
    let lights = vec![Light { position: DVec3::new(number(8), number(9), number(10)) * 0.2, ..Light::default() }];
    Scene { camera, lights, ..Scene::default() }
}

/// Two of each kind around the origin, mirrors of each other, lit from two sides.
pub fn mixed_scene() -> Scene {
    let mut primitives = Vec::new();
    for (place, kind) in SolidKind::ALL.into_iter().enumerate() {
        for (row, &y) in [0.0, 2.5].iter().enumerate() {
            let center = DVec3::new(2.5 * place as f64 - 3.75, y - 1.25, 0.3 * row as f64);
            let solid = match kind {
                SolidKind::Sphere => sphere(center, 1.0),
                SolidKind::Box => Solid::Box {
                    center,
                    half_size: DVec3::new(0.8, 0.7, 0.6),
                    rotation_degrees: DVec3::new(20.0, 35.0, 50.0),
                },
                SolidKind::Cylinder => {
                    Solid::Cylinder { ends: [center, center + DVec3::new(0.5, 0.7, -0.4)], radius: 0.7 }
                }
                SolidKind::Cone => {
                    let axis = DVec3::new(0.48, -0.6, 0.64);
                    Solid::Cone { apex: center - axis, axis, height: 1.5, half_angle_degrees: 30.0 }
                }
            };
            primitives.push(primitive(solid, material(0.1, 0.5, 0.4)));
        }
    }
    Scene {
        camera: Camera { position: DVec3::new(0.0, 0.0, -14.0), ..Camera::default() },
        lights: vec![light(5.0, 8.0, -30.0), light(-40.0, 2.0, -25.0)],
        primitives,
        ..Scene::default()
    }
}

/// The scene `scale` times as large about the world's origin, then moved. A light's ball keeps its size.
pub fn moved_and_scaled(scene: &Scene, shift: DVec3, scale: f64) -> Scene {
    let place = |point: DVec3| shift + point * scale;
    let mut scene = scene.clone();
    scene.camera.position = place(scene.camera.position);
    for light in &mut scene.lights {
        light.position = place(light.position);
    }
    for primitive in &mut scene.primitives {
        match &mut primitive.solid {
            Solid::Sphere { center, radius } => (*center, *radius) = (place(*center), *radius * scale),
            Solid::Box { center, half_size, .. } => (*center, *half_size) = (place(*center), *half_size * scale),
            Solid::Cylinder { ends, radius } => (*ends, *radius) = (ends.map(place), *radius * scale),
            Solid::Cone { apex, height, .. } => (*apex, *height) = (place(*apex), *height * scale),
        }
    }
    scene
}
