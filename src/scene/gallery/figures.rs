//! The course work's figures and the scenes of its table 4.1. The cameras were fitted to its pictures, or chosen to
//! show the same where there was nothing to fit.

use glam::DVec3;

use crate::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid, SolidKind};

/// The course's start state with its own off-axis picture window.
pub(super) fn start() -> Scene {
    Scene { camera: course_camera(Camera::default().position, DVec3::Z), ..Scene::default() }
}

pub(super) fn sphere() -> Scene {
    let camera = course_camera(DVec3::new(-2.0, 1.0, -5.0), DVec3::Z);
    course_scene(camera, DVec3::new(0.0, 2.0, -2.0), vec![Primitive::course_default(SolidKind::Sphere)])
}

pub(super) fn rotated_box() -> Scene {
    let mut cube = Primitive::course_default(SolidKind::Box);
    cube.solid.rotate(DVec3::new(30.0, 40.0, 50.0));
    let camera = course_camera(DVec3::new(-2.0, 1.0, -5.5), DVec3::Z);
    course_scene(camera, DVec3::new(-1.0, 2.0, -3.0), vec![cube])
}

pub(super) fn cylinder() -> Scene {
    let camera = course_camera(DVec3::new(-2.5, 1.5, -6.0), DVec3::new(0.0, -0.05, 1.0));
    course_scene(camera, DVec3::new(-1.5, 2.0, -3.0), vec![Primitive::course_default(SolidKind::Cylinder)])
}

pub(super) fn cone() -> Scene {
    let camera = course_camera(DVec3::new(-1.0, 0.2, -3.0), DVec3::Z);
    course_scene(camera, DVec3::new(-1.0, 1.0, -2.0), vec![Primitive::course_default(SolidKind::Cone)])
}

/// Figure 3.5.
pub(super) fn four() -> Scene {
    let placed = |kind, position, degrees| {
        let mut primitive = Primitive::course_default(kind);
        primitive.solid.move_to(position);
        primitive.solid.rotate(degrees);
        primitive
    };
    let primitives = vec![
        placed(SolidKind::Sphere, DVec3::new(4.2, 0.0, 0.0), DVec3::ZERO),
        placed(SolidKind::Box, DVec3::new(0.6, 0.2, 0.5), DVec3::new(5.0, 10.0, 3.0)),
        placed(SolidKind::Cylinder, DVec3::new(-3.0, 0.0, 1.0), DVec3::new(0.0, 30.0, 10.0)),
        placed(SolidKind::Cone, DVec3::new(1.9, -0.5, -2.0), DVec3::new(10.0, 0.0, 15.0)),
    ];
    let camera = course_camera(DVec3::new(-2.5, 0.8, -7.5), DVec3::new(-0.1, -0.02, 1.0));
    course_scene(camera, DVec3::new(0.0, 0.5, -2.5), primitives)
}

/// Figure 3.6.
pub(super) fn light() -> Scene {
    let mut sphere = Primitive::course_default(SolidKind::Sphere);
    sphere.material = Material { diffuse: 0.5, specular: 0.4, ..Material::default() };
    let camera = course_camera(DVec3::new(-2.0, 1.0, -5.0), DVec3::Z);
    let mut scene = course_scene(camera, DVec3::new(-1.0, 1.5, -2.5), vec![sphere]);
    scene.lights[0].intensity = DVec3::new(1.0, 0.2, 0.2);
    scene
}

/// Figure 3.7: five generations, as in the course work.
pub(super) fn corridor() -> Scene {
    let material = |color, diffuse| Material::of_course(color, 0.1, diffuse, 0.5);
    let primitives = vec![
        Primitive {
            name: None,
            solid: Solid::Sphere { center: DVec3::new(-1.3, 0.0, 0.0), radius: 1.2 },
            material: material(DVec3::new(0.2, 1.0, 0.0), 0.5),
        },
        Primitive {
            name: None,
            solid: Solid::Box {
                center: DVec3::new(2.2, 0.0, 0.0),
                half_size: DVec3::new(1.0, 1.6, 1.6),
                rotation_degrees: DVec3::new(0.0, 20.0, 0.0),
            },
            material: material(DVec3::new(1.0, 0.0, 0.0), 0.5),
        },
        Primitive {
            name: None,
            solid: Solid::Cylinder { ends: [DVec3::new(3.2, 0.0, 2.2), DVec3::new(1.8, 0.0, 3.2)], radius: 0.8 },
            material: material(DVec3::new(0.3, 0.5, 0.7), 0.4),
        },
    ];
    let camera = course_camera(DVec3::new(-0.6, 0.9, -5.0), DVec3::new(0.05, -0.08, 1.0));
    Scene { max_depth: 5, ..course_scene(camera, DVec3::new(0.0, 1.1, -1.6), primitives) }
}

/// Figure 3.8: a box and a cone mirrored in the sphere between them.
pub(super) fn several() -> Scene {
    let material = |color, diffuse, specular| Material::of_course(color, 0.1, diffuse, specular);
    let primitives = vec![
        Primitive {
            name: Some("mirror".into()),
            solid: Solid::Sphere { center: DVec3::new(0.3, 0.0, 1.5), radius: 1.5 },
            material: material(DVec3::new(0.6, 0.7, 0.8), 0.1, 0.8),
        },
        Primitive {
            name: None,
            solid: Solid::Box {
                center: DVec3::new(2.7, -0.4, -0.6),
                half_size: DVec3::splat(0.7),
                rotation_degrees: DVec3::new(0.0, 25.0, 0.0),
            },
            material: material(DVec3::new(1.0, 0.1, 0.0), 0.6, 0.2),
        },
        Primitive {
            name: None,
            solid: Solid::Cone {
                apex: DVec3::new(-2.0, 0.7, -0.4),
                axis: DVec3::NEG_Y,
                height: 1.6,
                half_angle_degrees: 25.0,
            },
            material: material(DVec3::new(0.2, 0.9, 0.1), 0.6, 0.2),
        },
    ];
    let camera = course_camera(DVec3::new(-3.2, 1.6, -6.0), DVec3::Z);
    course_scene(camera, DVec3::new(0.3, 2.5, -3.0), primitives)
}

/// Table 4.1: rows of ten.
pub(super) fn grid(kind: SolidKind, count: usize) -> Scene {
    rows(kind, count, 10)
}

/// Solids in rows of so many, as table 4.1 has them: the camera was fitted to figure 4.1, which shows 90 spheres.
pub(super) fn rows(kind: SolidKind, count: usize, row: usize) -> Scene {
    let camera = course_camera(
        DVec3::new(2.7252345224208216, 4.0987636075718665, -4.858739727979396),
        DVec3::new(0.03923503759629459, -0.1632759938225424, 0.9857999602688561),
    );
    let primitives = (0..count).map(|i| {
        let mut primitive = Primitive::course_default(kind);
        primitive.solid.move_to(2.0 * DVec3::new((i / row) as f64, 0.0, (i % row) as f64));
        primitive
    });
    course_scene(camera, DVec3::new(1.0, 2.0, 0.0), primitives.collect())
}

fn course_camera(position: DVec3, direction: DVec3) -> Camera {
    Camera { position, direction, projection: Projection::Course, ..Camera::default() }
}

fn course_scene(camera: Camera, light: DVec3, primitives: Vec<Primitive>) -> Scene {
    let lights = vec![Light { position: light, ..Light::default() }];
    Scene { camera, lights, primitives, ..Scene::default() }
}
