//! What the accurate kernel takes, refuses and survives.

use std::ops::ControlFlow;

use crate::common::{TestDevice, render};
use crate::scenes::{light, material, mirror, mixed_scene, picture, primitive, scene_of_a_light, sphere};
use crate::tracers::Tracers;
use glam::DVec3;
use zerkalo::frame::Frame;
use zerkalo::gpu::DeviceKind;
use zerkalo::plan::{Approximations, TraversalCost};
use zerkalo::reference::LIGHT_SPHERE;
use zerkalo::scene::{Camera, LIGHT_LIMIT, Light, Scene, Solid, gallery};
use zerkalo::tracer::{Kernel, Precision, Settings, Tracer, TracerError};

const PRECISIONS: [Precision; 2] = [Precision::F32, Precision::F64];

fn settings(precision: Precision, width: u32, height: u32) -> Settings {
    Settings { kernel: Kernel::Whitted(precision), ..Settings::new(width, height) }
}

fn is_finite(frame: &Frame) -> bool {
    frame.pixels().iter().flatten().all(|channel| channel.is_finite())
}

#[test]
fn tiles_workgroups_and_pixels_in_turn_change_no_bit() {
    let device = TestDevice::open();
    for precision in PRECISIONS {
        let usual = settings(precision, 151, 67);
        let whole = render(&device, &mixed_scene(), &usual);
        for (max_tile_side, workgroup) in [(64, [8, 8]), (33, [3, 5])] {
            let other = render(&device, &mixed_scene(), &Settings { max_tile_side, workgroup, ..usual.clone() });
            assert!(other == whole, "tiles of {max_tile_side}, workgroups of {workgroup:?}");
        }
        for pixels in [1, 2, 4, 8] {
            let other = render(&device, &mixed_scene(), &Settings { pixels: Some(pixels), ..usual.clone() });
            assert!(other == whole, "{pixels} pixels per invocation");
        }
    }
}

/// Light spheres are looked for in a part of the picture only: in all that shows them.
#[test]
fn the_balls_of_lights_are_drawn_wherever_they_are_seen() {
    let device = TestDevice::open();
    let usual = settings(Precision::F64, 130, 150);
    let mut tracer = Tracer::new(&device, &scene_of_a_light(0), &usual).unwrap();
    let mut frame = tracer.frame().unwrap();
    let mut shown = 0;
    for (are_two, pixels) in [(false, 1), (false, 8), (true, 8)] {
        for index in 0..50 {
            let mut scene = scene_of_a_light(3 * index + pixels % 3);
            let in_sight = scene.camera.position + scene.camera.direction.normalize() * 3.0;
            scene.lights.extend(are_two.then(|| Light { position: in_sight, ..Light::default() }));
            let max_tile_side = [33, 1024][index as usize / 2 % 2];
            let settings = Settings { max_tile_side, pixels: Some(pixels), ..usual.clone() };
            tracer.set_scene(&scene, &settings).unwrap();
            tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
            let truth = picture(&scene, 130, 150);
            for (pixel, truth) in frame.pixels().iter().zip(&truth.pixels) {
                assert_eq!(*pixel, truth.color.as_vec3().to_array(), "{settings:?}: {scene:?}");
            }
            shown += usize::from(truth.pixels.iter().any(|pixel| pixel.first_hit == LIGHT_SPHERE));
        }
    }
    assert!((40..140).contains(&shown), "{shown} of 150 are a poor choice");
}

/// What an invocation cannot end for eight pixels it can end for one.
#[test]
fn pixels_that_took_too_long_in_company_are_traced_alone() {
    let device = TestDevice::open();
    let on_one_place = Scene {
        primitives: vec![primitive(sphere(DVec3::Z * 5.0, 1.0), material(0.2, 0.5, 0.3)); 250],
        ..Scene::default()
    };
    let alone = Settings { pixels: Some(1), ..settings(Precision::F32, 96, 64) };
    let in_company = Settings { pixels: Some(8), ..alone.clone() };
    assert!(render(&device, &on_one_place, &in_company) == render(&device, &on_one_place, &alone));
    let Scene { primitives, lights, max_depth, .. } = &on_one_place;
    assert_eq!(TraversalCost::of(primitives).pixels_per_invocation(lights.len(), *max_depth, 8), 1, "and is not tried");
}

/// Only primary rays look for the light spheres, or each ray's iterations would grow by the lights' number.
#[test]
fn a_room_of_mirrors_with_the_most_lights_ends() {
    let device = TestDevice::open();
    let lights = (0..LIGHT_LIMIT as u32).map(|i| light(f64::from(i % 8) - 3.5, 3.0, f64::from(i / 8) - 3.5));
    let room = Solid::Box { center: DVec3::ZERO, half_size: DVec3::splat(8.0), rotation_degrees: DVec3::ZERO };
    let primitives = vec![primitive(room, mirror()), primitive(sphere(DVec3::Y * -3.0, 1.0), mirror())];
    let scene = Scene { lights: lights.collect(), primitives, max_depth: 20, ..Scene::default() };
    for precision in PRECISIONS {
        let frame = render(&device, &scene, &settings(precision, 48, 32));
        assert!(is_finite(&frame), "{}", precision.name());
    }
}

#[test]
fn a_tracer_that_takes_up_another_scene_draws_what_a_new_one_does() {
    let device = TestDevice::open();
    let first = settings(Precision::F32, 48, 32);
    let mut tracer = Tracer::new(&device, &Scene::default(), &first).unwrap();
    let showcase = gallery::scene("showcase").unwrap();
    let approximations =
        Approximations { min_throughput: 0.1, min_shadowed: 0.1, highlights: false, ..Approximations::NONE };
    let course = Settings { kernel: Kernel::Course, ..first.clone() };
    let of_scenes = [
        (mixed_scene(), first.clone()),
        (mixed_scene(), Settings { approximations, ..first.clone() }),
        (showcase, Settings { kernel: Kernel::Whitted(Precision::F64), ..first.clone() }),
        (gallery::scene("four").unwrap(), course),
        (mixed_scene(), Settings { max_depth: Some(1), max_tile_side: 9, workgroup: [3, 5], ..first.clone() }),
    ];
    let mut frame = tracer.frame().unwrap();
    for (scene, settings) in of_scenes {
        tracer.set_scene(&scene, &settings).unwrap();
        tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
        assert!(frame == render(&device, &scene, &settings), "{settings:?}");
    }
}

#[test]
fn a_scene_of_nothing_is_its_background_and_a_thousand_spheres_are_drawn() {
    let device = TestDevice::open();
    for precision in PRECISIONS {
        let empty = Scene { lights: vec![], background: DVec3::new(0.1, 0.2, 0.3), ..Scene::default() };
        let frame = render(&device, &empty, &settings(precision, 16, 8));
        assert!(frame.pixels().iter().all(|&pixel| pixel == [0.1, 0.2, 0.3]));

        let mut many = Scene { background: DVec3::ZERO, ..gallery::scene("grid-sphere-100").unwrap() };
        let last = many.primitives.last().unwrap().clone();
        many.primitives.resize(10_000, last);
        assert!(render(&device, &many, &settings(precision, 32, 14)).pixels().iter().any(|&pixel| pixel != [0.0; 3]));
    }
}

#[test]
fn mr_no_ray_escapes_from_a_closed_room_of_mirrors() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let slanted = DVec3::new(0.48, 0.6, 0.64);
    let rooms = [
        Solid::Box {
            center: DVec3::ZERO,
            half_size: DVec3::splat(3.0),
            rotation_degrees: DVec3::new(10.0, 20.0, 30.0),
        },
        sphere(DVec3::new(0.1, 0.2, 0.3), 3.0),
        Solid::Cylinder { ends: [-3.0 * slanted, 3.0 * slanted], radius: 3.0 },
        Solid::Cone { apex: -3.0 * slanted, axis: slanted, height: 8.0, half_angle_degrees: 50.0 },
    ];
    for precision in PRECISIONS {
        for room in &rooms {
            let scene = Scene {
                camera: Camera {
                    vertical_fov_degrees: 120.0,
                    position: DVec3::new(0.1, 0.2, 0.3),
                    ..Camera::default()
                },
                background: DVec3::ONE,
                ambient_light: DVec3::ONE,
                lights: vec![],
                max_depth: 200,
                primitives: vec![primitive(room.clone(), mirror()), primitive(sphere(DVec3::X, 0.3), mirror())],
                ..Scene::default()
            };
            let frame = tracers.draw(&scene, &settings(precision, 48, 48));
            let escaped = frame.pixels().iter().filter(|&&pixel| pixel != [0.0; 3]).count();
            assert_eq!(escaped, 0, "{} of {room:?}", precision.name());
        }
    }
}

#[test]
fn it_intensities_up_to_the_largest_f32_stay_finite() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    for precision in PRECISIONS {
        for intensity in [1e30, 3e38, f64::from(f32::MAX)] {
            let mut scene = mixed_scene();
            scene.background = DVec3::splat(intensity);
            scene.lights.iter_mut().for_each(|light| light.intensity = DVec3::splat(intensity));
            scene.primitives.iter_mut().for_each(|primitive| primitive.material = material(1.0, 1.0, 1.0));
            let frame = tracers.draw(&scene, &settings(precision, 64, 48));
            assert!(is_finite(&frame), "{} at {intensity:e}", precision.name());
            assert!(frame.pixels().iter().any(|pixel| f64::from(pixel[0]) >= 0.99 * intensity));
        }
    }
}

#[test]
fn lt_a_light_inside_a_solid_or_on_a_surface_gives_finite_pixels() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let cube = Solid::Box { center: DVec3::ZERO, half_size: DVec3::ONE, rotation_degrees: DVec3::ZERO };
    for precision in PRECISIONS {
        for position in [DVec3::ZERO, DVec3::new(0.0, 0.0, -1.0), DVec3::new(0.2, 0.1, -1.0 - 1e-9)] {
            let scene = Scene {
                camera: Camera { position: DVec3::NEG_Z * 6.0, ..Camera::default() },
                lights: vec![Light { position, intensity: DVec3::ONE, ..Light::default() }, light(3.0, 3.0, -9.0)],
                primitives: vec![primitive(cube.clone(), material(0.1, 0.5, 0.5))],
                ..Scene::default()
            };
            assert!(is_finite(&tracers.draw(&scene, &settings(precision, 65, 65))), "{position}");
        }
    }
}

#[test]
fn fv_the_narrowest_and_the_widest_views_give_finite_pixels() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    for precision in PRECISIONS {
        for vertical_fov_degrees in [1e-6_f64.to_degrees(), 179.999] {
            let mut scene = mixed_scene();
            scene.camera.vertical_fov_degrees = vertical_fov_degrees;
            assert!(is_finite(&tracers.draw(&scene, &settings(precision, 33, 17))), "{vertical_fov_degrees}°");
        }
    }
}

#[test]
fn solids_too_small_for_the_precision_give_finite_pixels() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    for precision in PRECISIONS {
        for radius in [1e-12, 1e-30, f64::MIN_POSITIVE / 16.0] {
            let mut scene = mixed_scene();
            scene.primitives.push(primitive(sphere(DVec3::NEG_Z * 5.0, radius), mirror()));
            assert!(is_finite(&tracers.draw(&scene, &settings(precision, 33, 33))), "{radius:e}");
        }
    }
}

/// Mesa's CPU driver ends loops after so many turns; the picture would be wrong without a word.
#[test]
fn a_picture_that_the_device_gives_up_on_is_an_error() {
    let device = TestDevice::open();
    let behind = primitive(sphere(DVec3::NEG_Z * 50.0, 1.0), mirror());
    let scene = Scene { primitives: vec![behind; 700_000], background: DVec3::ONE, lights: vec![], ..Scene::default() };
    // Of so many, one by one, a ray takes more iterations than Mesa's CPU drivers grant.
    let plain = Settings { without_boxes: true, ..settings(Precision::F32, 8, 8) };
    let mut tracer = Tracer::new(&device, &scene, &plain).unwrap();
    let mut frame = tracer.frame().unwrap();
    for (samples, scale) in [(1, 1.0), (2, 0.5)] {
        tracer.set_scene(&scene, &Settings { samples, scale, ..plain.clone() }).unwrap();
        match tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())) {
            Ok(_) => {
                assert_ne!(device.description().kind, DeviceKind::Cpu, "such drivers end loops, and it was not seen");
                assert!(frame.pixels().iter().all(|&pixel| pixel == [1.0; 3]), "drawn, but not what is there");
            }
            Err(error) => {
                assert!(
                    matches!(error, TracerError::LoopLimitReached { pixels: 64, .. }) && !error.is_input_error(),
                    "{error}"
                );
                assert!(!error.to_string().contains('\n'));
            }
        }
    }
}
