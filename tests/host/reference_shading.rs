//! The accurate model, equation 1.19, and the camera on pictures whose values are known.

use std::ops::ControlFlow;

use crate::reference_pictures::look;
use crate::scenes::{cube, light, material, mixed_scene, picture, primitive, sphere};
use glam::DVec3;
use zerkalo::reference::{
    BACKGROUND, LIGHT_SPHERE, OriginSurface, Pixel, PrimaryRays, Ray, RenderError, World, render,
};
use zerkalo::scene::{Camera, Light, Projection, Scene};

#[test]
fn n_0_a_scene_without_primitives_is_background_and_light_balls() {
    let picture = picture(&Scene::default(), 101, 101);
    let background = Pixel { color: DVec3::new(0.1, 0.2, 0.3), ..picture.pixels[0] };
    let (seen, balls): (Vec<Pixel>, Vec<Pixel>) =
        picture.pixels.iter().partition(|pixel| pixel.first_hit == BACKGROUND);
    assert!(seen.iter().all(|pixel| *pixel == background));
    assert!(
        !balls.is_empty() && balls.iter().all(|pixel| (pixel.first_hit, pixel.color) == (LIGHT_SPHERE, DVec3::ONE))
    );
}

#[test]
fn fv_the_narrowest_and_the_widest_lens_give_finite_pictures() {
    for vertical_fov_degrees in [1e-6f64.to_degrees(), 179.999] {
        for projection in [Projection::Centered, Projection::Course] {
            let mut scene = mixed_scene();
            scene.camera.vertical_fov_degrees = vertical_fov_degrees;
            scene.camera.projection = projection;
            let rays = PrimaryRays::new(&scene.camera, 8, 8);
            assert_ne!(rays.through(3, 4).direction, rays.through(4, 4).direction);
            assert!(picture(&scene, 8, 8).pixels.iter().all(|pixel| pixel.color.is_finite()));
        }
    }
}

#[test]
fn im_one_pixel_looks_along_the_axis_and_a_long_row_keeps_its_rays() {
    let camera = Camera { direction: DVec3::new(1.0, 2.0, 3.0), ..Camera::default() };
    let middle = PrimaryRays::new(&camera, 1, 1).through(0, 0).direction;
    assert!((middle - camera.direction.normalize()).length() < 1e-15);
    let row = picture(&mixed_scene(), 16_384, 1);
    assert_eq!((row.pixels.len(), row.width, row.height), (16_384, 16_384, 1));
    let world_scene = mixed_scene();
    let rays = PrimaryRays::new(&world_scene.camera, 16_384, 1);
    assert_eq!(World::new(&world_scene).look_along(rays.through(8_000, 0)), row.pixels[8_000]);
}

#[test]
fn the_course_window_is_off_its_axis_by_a_quarter_of_the_picture() {
    let camera = Camera { projection: Projection::Course, ..Camera::default() };
    // The axis meets the picture at 75 % of the width and 25 % of the height from the top: a corner of four pixels.
    let rays = PrimaryRays::new(&camera, 8, 8);
    let around_axis: DVec3 =
        [(5, 1), (6, 1), (5, 2), (6, 2)].map(|(x, y)| rays.through(x, y).direction).into_iter().sum();
    assert!((around_axis.normalize() - DVec3::Z).length() < 1e-15);
    // Half extent tan(0.25): the window's left edge is at three times that, and left is +x when looking along +z.
    let left = PrimaryRays::new(&camera, 2, 2).through(0, 0).direction;
    assert!((left.x / left.z - 2.0 * 0.25f64.tan()).abs() < 1e-15);
    assert!((left.y / left.z - 0.0).abs() < 1e-15);
}

#[test]
fn one_sphere_is_shaded_by_equation_1_19() {
    let specular = 0.25;
    let scene = Scene {
        lights: vec![
            light(0.0, 3.0, -4.0),
            Light { position: DVec3::new(0.0, 0.0, -9.0), intensity: DVec3::splat(2.0), ..Light::default() },
        ],
        primitives: vec![primitive(sphere(DVec3::ZERO, 1.0), material(0.1, 0.5, specular))],
        ..Scene::default()
    };
    // The point (0, 0, −1) with normal −z: the first light at 45°, mirrored to 45° on the other side; the second along
    // the normal. The reflected ray meets the background.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let color = DVec3::new(0.3, 0.5, 0.7);
    let first = 0.5 * color * half + specular * half.powi(5);
    let second = 2.0 * (0.5 * color + specular);
    let expected = 0.1 * color + first + second + specular * scene.background;
    let seen = look(&scene, DVec3::Z * -5.0, DVec3::Z);
    assert!((seen.color - expected).length() < 1e-15, "{seen:?} instead of {expected}");
}

#[test]
fn a_shadow_leaves_the_ambient_light_alone() {
    let scene = Scene {
        lights: vec![light(0.0, 0.0, -9.0)],
        max_depth: 1,
        primitives: vec![
            primitive(sphere(DVec3::ZERO, 1.0), material(0.1, 0.5, 0.3)),
            primitive(cube(DVec3::Z * -4.0, 0.5), material(0.1, 0.5, 0.3)),
        ],
        ..Scene::default()
    };
    let seen = look(&scene, DVec3::new(0.0, 0.0, -2.0), DVec3::Z);
    assert_eq!((seen.first_hit, seen.color), (0, 0.1 * DVec3::new(0.3, 0.5, 0.7)));
}

#[test]
fn a_light_ball_is_seen_by_primary_rays_only_and_blocks_nothing() {
    let ball = light(0.0, 0.0, -3.0);
    let scene = Scene {
        lights: vec![ball, light(0.0, 0.0, -9.0)],
        max_depth: 2,
        primitives: vec![primitive(sphere(DVec3::ZERO, 1.0), material(0.0, 1.0, 1.0))],
        ..Scene::default()
    };
    assert_eq!(look(&scene, DVec3::Z * -5.0, DVec3::Z).first_hit, LIGHT_SPHERE);
    // From between ball and sphere: both lights arrive, and the reflected ray passes through the ball to the
    // background.
    let seen = look(&scene, DVec3::Z * -2.0, DVec3::Z);
    let expected = 2.0 * (DVec3::new(0.3, 0.5, 0.7) + 1.0) + scene.background;
    assert!((seen.color - expected).length() < 1e-15, "{seen:?}");
}

#[test]
fn max_depth_counts_generations() {
    let mut scene = Scene {
        lights: vec![],
        primitives: vec![
            primitive(sphere(DVec3::X * 3.0, 1.0), material(1.0, 0.0, 0.5)),
            primitive(sphere(DVec3::X * -3.0, 1.0), material(1.0, 0.0, 0.5)),
        ],
        ..Scene::default()
    };
    for (max_depth, weights) in [(0, 0.0), (1, 1.0), (2, 1.5), (3, 1.75)] {
        scene.max_depth = max_depth;
        let seen = look(&scene, DVec3::ZERO, DVec3::X).color;
        assert!((seen - weights * DVec3::new(0.3, 0.5, 0.7)).length() < 1e-15, "{seen} at depth {max_depth}");
    }
}

#[test]
fn an_empty_picture_and_a_cancelled_one_are_errors() {
    let scene = mixed_scene();
    assert_eq!(render(&scene, 0, 5, &|_| ControlFlow::Continue(())), Err(RenderError::Empty { width: 0, height: 5 }));
    assert_eq!(render(&scene, 8, 8, &|_| ControlFlow::Break(())), Err(RenderError::Cancelled));
    let rows = std::sync::atomic::AtomicU32::new(0);
    let count = |done| {
        rows.fetch_max(done, std::sync::atomic::Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    assert!(render(&scene, 8, 9, &count).is_ok());
    assert_eq!(rows.into_inner(), 9);
}

#[test]
fn a_hit_knows_its_place_in_the_scene() {
    let scene = mixed_scene();
    let towards_second = Ray { origin: DVec3::new(-3.75, 1.25, -14.0), direction: DVec3::Z };
    let hit = World::new(&scene).nearest(&towards_second, OriginSurface::Free).expect("a hit");
    assert_eq!(hit.primitive, 1);
    assert!((hit.t - 13.3).abs() < 1e-14 && (hit.normal - DVec3::NEG_Z).length() < 1e-15);
}
