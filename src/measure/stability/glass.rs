//! Cases of the light model: refraction (RF), highlights' exponents (EX) and lights that fade (AT).

use glam::DVec3;

use super::pictures::{compared, like_reference, picture, size};
use super::scenes::{balls_in_contact, mixed, sharing_cubes};
use super::{Case, Measured};
use crate::scene::{Camera, Light, Material, Primitive, Scene, Solid};
use crate::tracer::Precision;

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (index, beyond) in [1e-3, -1e-3, 1e-5, -1e-5, 1e-7, -1e-7].into_iter().enumerate() {
        cases.push(critical_angle(format!("RF-{}", index + 1), beyond));
    }
    for (index, refractive_index) in [1.0 + 1e-7, 1.001, 0.5, 3.0, 10.0].into_iter().enumerate() {
        let scene = move || all_glass(mixed(), refractive_index);
        cases.push(like_reference(&format!("RF-{}", index + 7), scene));
    }
    cases.push(like_reference("RF-12", || nested(DVec3::NEG_Z * 24.0)));
    // Between the spheres 10 and 11, of radii 5 and 5.5.
    cases.push(like_reference("RF-13", || nested(DVec3::new(0.0, 0.2, -5.25))));
    cases.push(like_reference("RF-14", || all_glass(balls_in_contact(), 1.5)));
    cases.push(like_reference("RF-15", || all_glass(sharing_cubes(), 1.5)));
    cases.push(like_reference("RF-16", light_in_glass));
    cases.push(Case::of_kernel("RF-17", |subject| {
        let scene = gaining();
        let Some(pixels) = picture(subject, &scene, size(subject))? else { return Ok(Vec::new()) };
        let mut measured = compared(subject, &scene, size(subject), 100)?;
        let not_finite = pixels.iter().filter(|pixel| !pixel.is_finite()).count();
        measured.push(Measured::none_of("pixels with NaN or infinity after 200 generations", not_finite));
        Ok(measured)
    }));
    for (index, constant) in [1e-30, 1e-6, 1.0, 1e30].into_iter().enumerate() {
        cases.push(like_reference(&format!("AT-{}", index + 1), move || fading(constant)));
    }
    for (index, shininess) in [1.0, 5.00390625, 1024.0].into_iter().enumerate() {
        cases.push(like_reference(&format!("EX-{}", index + 1), move || shining(shininess)));
    }
    cases
}

fn glass(refractive_index: f64) -> Material {
    Material {
        reflection: Some(0.2),
        transmission: 0.75,
        refractive_index,
        ..Material::of_course(DVec3::new(0.3, 0.5, 0.7), 0.1, 0.2, 0.3)
    }
}

fn all_glass(scene: Scene, refractive_index: f64) -> Scene {
    let primitives = scene.primitives.into_iter();
    let primitives = primitives.map(|primitive| Primitive { material: glass(refractive_index), ..primitive });
    Scene { max_depth: 6, primitives: primitives.collect(), ..scene }
}

/// From within a block of glass at its face, by so much beyond the critical angle (rad), through a lens so narrow that
/// the whole picture is. At 10⁻⁷ that is a unit in the last place of an `f32`, which then need only be finite.
fn critical_angle(id: String, beyond: f64) -> Case {
    const REFRACTIVE_INDEX: f64 = 1.5;
    let scene = move || {
        let angle = (1.0 / REFRACTIVE_INDEX).asin() + beyond;
        let block =
            Solid::Box { center: DVec3::ZERO, half_size: DVec3::new(50.0, 1.0, 50.0), rotation_degrees: DVec3::ZERO };
        let floor = Solid::Box {
            center: DVec3::NEG_Y * 3.0,
            half_size: DVec3::new(1e4, 1.0, 1e4),
            rotation_degrees: DVec3::ZERO,
        };
        let matt = Material::of_course(DVec3::new(0.8, 0.4, 0.2), 1.0, 0.0, 0.0);
        Scene {
            camera: Camera {
                direction: DVec3::new(angle.sin(), -angle.cos(), 0.0),
                vertical_fov_degrees: beyond.abs().to_degrees(),
                ..Camera::default()
            },
            max_depth: 3,
            lights: Vec::new(),
            primitives: [(block, glass(REFRACTIVE_INDEX)), (floor, matt)]
                .map(|(solid, material)| Primitive { name: None, solid, material })
                .into(),
            ..Scene::default()
        }
    };
    Case::of_kernel(id, move |subject| {
        let (scene, size) = (scene(), size(subject));
        let Some(pixels) = picture(subject, &scene, size)? else { return Ok(Vec::new()) };
        let not_finite = pixels.iter().filter(|pixel| !pixel.is_finite()).count();
        let mut measured = vec![Measured::none_of("pixels with NaN or infinity", not_finite)];
        if subject.kernel.precision() == Precision::F64 || beyond.abs() > 1e-6 {
            measured.extend(compared(subject, &scene, size, 100)?);
        }
        Ok(measured)
    })
}

/// Twenty spheres in each other, of glass that is now denser and now thinner than the next.
fn nested(camera: DVec3) -> Scene {
    let sphere = |index: u32| {
        let solid = Solid::Sphere { center: DVec3::ZERO, radius: 0.5 * f64::from(index) };
        let material = Material {
            reflection: Some(0.0),
            transmission: 0.97,
            refractive_index: if index.is_multiple_of(2) { 1.3 } else { 1.1 },
            ..Material::of_course(DVec3::new(0.3, 0.5, 0.7), 0.02, 0.0, 0.0)
        };
        Primitive { name: None, solid, material }
    };
    Scene {
        camera: Camera { position: camera, ..Camera::default() },
        max_depth: 60,
        lights: Vec::new(),
        primitives: (1..=20).map(sphere).collect(),
        ..Scene::default()
    }
}

fn light_in_glass() -> Scene {
    let scene = all_glass(mixed(), 1.4);
    let inside = |primitive: &Primitive| Light {
        position: primitive.solid.position() + DVec3::new(0.05, 0.1, 0.15),
        intensity: DVec3::splat(0.5),
        radius: 0.0,
        ..Light::default()
    };
    Scene { lights: scene.primitives.iter().map(inside).collect(), ..scene }
}

/// Glass that sends on more than it gets.
fn gaining() -> Scene {
    let ball = Material { reflection: Some(0.6), transmission: 0.6, ..glass(1.2) };
    let solid = Solid::Sphere { center: DVec3::ZERO, radius: 1.5 };
    Scene {
        camera: Camera { position: DVec3::NEG_Z * 6.0, ..Camera::default() },
        max_depth: 200,
        primitives: vec![Primitive { name: None, solid, material: ball }],
        ..Scene::default()
    }
}

/// So bright that what arrives is about 1.
fn fading(constant: f64) -> Scene {
    let mut scene = mixed();
    for light in &mut scene.lights {
        light.distance_constant = Some(constant);
        light.intensity = DVec3::splat(30.0 + constant);
    }
    scene
}

fn shining(shininess: f64) -> Scene {
    let mut scene = mixed();
    scene.primitives.iter_mut().for_each(|primitive| primitive.material.shininess = shininess);
    scene
}
