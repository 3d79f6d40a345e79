//! Cases after bug reports of other ray tracers: scenes that are wrong in `f32`, and lights where a face sees them
//! neither from above nor from below.

use glam::DVec3;

use super::pictures::{picture, size, truth};
use super::{Case, Measured};
use crate::plan::Plan;
use crate::scene::{Camera, Light, Material, Primitive, Scene, Solid, world_from_box};
use crate::settings::RenderSettings;
use crate::tracer::{Precision, TracerError, limits_of};

pub(super) fn cases() -> Vec<Case> {
    vec![
        right_or_told("WD-1", planet),
        right_or_told("WD-2", sea),
        right_or_told("WD-3", || wide_disc(10.0)),
        right_or_told("WD-4", || wide_disc(1e7)),
        right_or_told("WD-5", || cone_of(1e7)),
        right_or_told("WD-6", || box_of(1e8)),
        right_or_told("MS-1", mixed_scales),
        right_or_told("LP-1", || lit_along(plate(DVec3::ZERO), DVec3::Z * 9.0)),
        right_or_told("LP-2", || {
            let turned = DVec3::new(0.0, 0.0, 30.0);
            // Along the plate's own x axis.
            lit_along(plate(turned), world_from_box(turned) * DVec3::X * 9.0)
        }),
        right_or_told("LP-3", || {
            lit_along(Solid::Cylinder { ends: [DVec3::NEG_Y, DVec3::ZERO], radius: 5.0 }, DVec3::Z * 9.0)
        }),
        right_or_told("LP-4", || {
            let (apex, axis) = (DVec3::NEG_Y * 4.0, DVec3::Y);
            lit_along(Solid::Cone { apex, axis, height: 4.0, half_angle_degrees: 50.0 }, DVec3::Z * 9.0)
        }),
        right_or_told("LR-1", tiny),
        right_or_told("ON-5", || on_a_face(DVec3::Y)),
        right_or_told("ON-6", || on_a_face(DVec3::new(1.0, 1.0, 1.0))),
    ]
}

/// Wrong pixels that a picture by default may have.
const FEW_WRONG: f64 = 0.005;

/// The accurate kernel is right, or `f32` is known not to be: then the plan takes `f64`, or says so.
fn right_or_told(id: &str, scene: impl Fn() -> Scene + 'static) -> Case {
    Case::of_kernel(id, move |subject| {
        if !subject.kernel.description().is_accurate {
            return Ok(Vec::new());
        }
        let precision = subject.kernel.precision();
        let (scene, [width, height]) = (scene(), size(subject));
        let settings = RenderSettings { precision: Some(precision), ..RenderSettings::default() };
        let limits = limits_of(subject.device.description());
        let plan = Plan::for_scene(&scene, &settings, [width, height], &limits);
        let plan = plan.map_err(|error| TracerError::Refused(error.to_string()))?;
        let is_told = plan.with_f32_tried(&scene).warning().is_some();
        let Some(ours) = picture(subject, &scene, [width, height])? else { return Ok(Vec::new()) };
        let tolerance = Precision::F32.rounding_tolerance();
        let is_wrong = |ours: &DVec3, right: DVec3| !(*ours - right).abs().cmple(DVec3::splat(tolerance)).all();
        let right = truth(&scene, [width, height])?.pixels;
        let wrong = ours.iter().zip(right).filter(|(ours, right)| is_wrong(ours, right.color)).count();
        let share = if is_told { 0.0 } else { wrong as f64 / ours.len() as f64 };
        Ok(vec![Measured { what: "share of pixels that are wrong without a word", measured: share, bound: FEW_WRONG }])
    })
}

fn matter(specular: f64) -> Material {
    Material::of_course(DVec3::splat(0.8), 0.1, 0.7, specular)
}

fn primitive(solid: Solid) -> Primitive {
    Primitive { name: None, solid, material: matter(0.2) }
}

fn scene(camera: Camera, light: DVec3, solids: impl IntoIterator<Item = Solid>) -> Scene {
    let lights = vec![Light { position: light, ..Light::default() }];
    Scene { camera, lights, primitives: solids.into_iter().map(primitive).collect(), max_depth: 5, ..Scene::default() }
}

fn camera(position: DVec3, direction: DVec3) -> Camera {
    Camera { position, direction, vertical_fov_degrees: 45.0, ..Camera::default() }
}

/// The earth in metres, and what lies on it.
fn planet() -> Scene {
    let top = DVec3::Y * 6_371_000.0;
    let ball = Solid::Sphere { center: top + DVec3::new(0.0, 1.0, 10.0), radius: 1.0 };
    let half_size = DVec3::splat(0.5);
    let rotation_degrees = DVec3::new(0.0, 30.0, 0.0);
    let cube = Solid::Box { center: top + DVec3::new(2.5, 0.5, 9.0), half_size, rotation_degrees };
    let ground = Solid::Sphere { center: DVec3::ZERO, radius: top.y };
    let eye = camera(top + DVec3::Y * 2.0, DVec3::new(0.0, -0.05, 1.0));
    scene(eye, top + DVec3::new(30.0, 40.0, -20.0), [ground, ball, cube])
}

/// A flat cylinder as wide as a sea, and a ball above it.
fn sea() -> Scene {
    let water = Solid::Cylinder { ends: [DVec3::NEG_Y, DVec3::ZERO], radius: 1e7 };
    let ball = Solid::Sphere { center: DVec3::new(0.0, 1.0, 20.0), radius: 1.0 };
    let eye = camera(DVec3::Y * 2.0, DVec3::new(0.0, -0.02, 1.0));
    scene(eye, DVec3::new(30.0, 40.0, -10.0), [water, ball])
}

/// From close above the end of a cylinder, lit from far up.
fn wide_disc(length: f64) -> Scene {
    let ground = Solid::Cylinder { ends: [DVec3::NEG_Y * length, DVec3::ZERO], radius: 1e7 };
    let eye = camera(DVec3::new(3.0, 2.0, 0.0), DVec3::new(0.0, -0.5, 1.0));
    scene(eye, DVec3::new(1e6, 1e6, 0.0), [ground])
}

/// From close above a cone's base.
fn cone_of(height: f64) -> Scene {
    let apex = DVec3::NEG_Y * height;
    let ground = Solid::Cone { apex, axis: DVec3::Y, height, half_angle_degrees: 45.0 };
    scene(camera(DVec3::Y * 2.0, DVec3::new(0.0, -0.5, 1.0)), DVec3::new(30.0, 40.0, -10.0), [ground])
}

/// From close above a box.
fn box_of(half_size: f64) -> Scene {
    let center = DVec3::NEG_Y * half_size;
    let ground = Solid::Box { center, half_size: DVec3::splat(half_size), rotation_degrees: DVec3::ZERO };
    let ball = Solid::Sphere { center: DVec3::new(0.0, 1.0, 8.0), radius: 1.0 };
    scene(camera(DVec3::Y * 2.0, DVec3::new(0.0, -0.2, 1.0)), DVec3::new(30.0, 40.0, -10.0), [ground, ball])
}

/// A speck before the camera, a ball behind it, and a star far beyond.
fn mixed_scales() -> Scene {
    let ball = |z: f64, radius: f64| Solid::Sphere { center: DVec3::Z * z, radius };
    let solids = [ball(0.0, 1.0), ball(-4.999, 1e-7), ball(1e9, 2e8)];
    scene(camera(DVec3::NEG_Z * 5.0, DVec3::Z), DVec3::new(3.0, 3.0, -4.0), solids)
}

fn plate(rotation_degrees: DVec3) -> Solid {
    Solid::Box { center: DVec3::ZERO, half_size: DVec3::new(5.0, 0.0, 5.0), rotation_degrees }
}

/// By a light in the plane of its face, and by another one from above, that there is something to see.
fn lit_along(solid: Solid, light: DVec3) -> Scene {
    let mut scene = scene(camera(DVec3::new(0.0, 6.0, -16.0), DVec3::new(0.0, -0.3, 1.0)), light, [solid]);
    let above = Light { position: DVec3::new(4.0, 5.0, -4.0), intensity: DVec3::splat(0.5), ..Light::default() };
    scene.lights.push(above);
    scene
}

/// All of it within the sphere of its light.
fn tiny() -> Scene {
    let ball = Solid::Sphere { center: DVec3::ZERO, radius: 1e-30 };
    let place = DVec3::X * 1.2e-30;
    let rod = Solid::Cylinder { ends: [place - DVec3::Y * 1e-30, place + DVec3::Y * 1e-30], radius: 3e-31 };
    scene(camera(DVec3::NEG_Z * 5e-30, DVec3::Z), DVec3::new(3.0, 3.0, -4.0) * 1e-30, [ball, rod])
}

/// The camera lies on a cube, and looks along the face at a ball on it.
fn on_a_face(place: DVec3) -> Scene {
    let cube = Solid::Box { center: DVec3::ZERO, half_size: DVec3::ONE, rotation_degrees: DVec3::ZERO };
    let ball = Solid::Sphere { center: place + DVec3::new(0.0, 0.5, 3.0), radius: 0.5 };
    scene(camera(place, DVec3::new(0.0, 0.1, 1.0)), DVec3::new(3.0, 6.0, -4.0), [cube, ball])
}
