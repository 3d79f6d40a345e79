//! The catalogue's rows about whole scenes: scales, contacts, lights, mirrors; each on the rendered picture.

use crate::scenes::{cube, light, material, mirror, mixed_scene, moved_and_scaled, picture, primitive, sphere};
use glam::DVec3;
use zerkalo::reference::{BACKGROUND, Image64, LIGHT_SPHERE, Pixel, Ray, World};
use zerkalo::scene::{Camera, Light, Scene, Solid};

pub fn look(scene: &Scene, origin: DVec3, direction: DVec3) -> Pixel {
    World::new(scene).look_along(Ray { origin, direction: direction.normalize() })
}

/// Among the pixels of `a` that show a solid: (largest colour difference where the paths agree, number of pixels whose
/// paths differ). The others may show a light's ball, whose radius is absolute.
fn difference(a: &Image64, b: &Image64) -> (f64, usize) {
    let mut largest = 0.0f64;
    let mut differing_paths = 0;
    for (a, b) in a.pixels.iter().zip(&b.pixels).filter(|(a, _)| a.first_hit < LIGHT_SPHERE) {
        if a.path == b.path {
            largest = largest.max((a.color - b.color).abs().max_element());
        } else {
            differing_paths += 1;
        }
    }
    (largest, differing_paths)
}

#[test]
fn sc_a_scene_scaled_by_powers_of_ten_gives_the_same_picture() {
    let scene = mixed_scene();
    let original = picture(&scene, 96, 64);
    let seen = original.pixels.iter().filter(|pixel| pixel.first_hit < LIGHT_SPHERE).count();
    assert!(seen > 1_200, "only {seen} pixels show a solid");
    for exponent in -6..=6 {
        let scaled = picture(&moved_and_scaled(&scene, DVec3::ZERO, 10f64.powi(exponent)), 96, 64);
        let (largest, differing_paths) = difference(&original, &scaled);
        println!("SC 1e{exponent}: {largest:e}, {differing_paths} paths differ");
        assert!(largest <= 1e-9 && differing_paths == 0);
    }
}

#[test]
fn sc_a_scene_scaled_by_powers_of_two_gives_the_same_bits() {
    let scene = mixed_scene();
    let original = picture(&scene, 48, 32);
    for exponent in [-20, -1, 1, 20] {
        let scaled = picture(&moved_and_scaled(&scene, DVec3::ZERO, 2f64.powi(exponent)), 48, 32);
        assert_eq!(difference(&original, &scaled), (0.0, 0), "2^{exponent}");
    }
}

#[test]
fn tr_a_scene_moved_by_1e5_of_its_size_gives_the_same_picture() {
    // The scene's numbers are rounded by 1e-11 of its size on the way, which mirrors multiply.
    let scene = mixed_scene();
    let original = picture(&scene, 96, 64);
    let moved = picture(&moved_and_scaled(&scene, DVec3::new(1e6, -1e6, 1e6), 1.0), 96, 64);
    let (largest, differing_paths) = difference(&original, &moved);
    println!("TR 1e6: {largest:e}, {differing_paths} paths differ");
    assert!(largest <= 1e-6 && differing_paths <= 2);
}

#[test]
fn tg_no_background_and_no_shadow_ring_where_two_spheres_touch() {
    let mut scene = Scene {
        background: DVec3::splat(1e6),
        lights: vec![light(0.0, 0.0, -60.0)],
        max_depth: 1,
        primitives: [-1.0, 1.0].map(|x| primitive(sphere(DVec3::X * x, 1.0), material(0.0, 1.0, 0.0))).to_vec(),
        ..Scene::default()
    };
    for step in 1..=1_000 {
        // From the contact outwards by ever larger steps: every point faces the camera's light, none is in shadow.
        let target = DVec3::new(10f64.powf(-12.0 * f64::from(step) / 1_000.0), 0.0, 0.0);
        let pixel = look(&scene, DVec3::Z * -50.0, target + DVec3::Z * 50.0);
        assert_eq!(pixel.first_hit, 1);
        assert!(pixel.color.max_element() > 0.0 && pixel.color.max_element() < 1.0, "{target}: {pixel:?}");
    }
    scene.max_depth = 20;
    let pixel = look(&scene, DVec3::Z * -50.0, DVec3::Z);
    assert_ne!(pixel.first_hit, BACKGROUND);
}

#[test]
fn cf_of_coplanar_tops_the_lowest_index_is_seen_without_acne() {
    // Two cubes share a face, a third one's top lies in theirs and overlaps both.
    let primitives = [(-1.0, 1.0), (1.0, 1.0), (0.0, 0.5)]
        .map(|(x, half_size)| primitive(cube(DVec3::new(x, -half_size, 0.0), half_size), material(0.0, 1.0, 0.0)));
    let scene = Scene {
        camera: Camera { position: DVec3::Y * 3.0, direction: DVec3::NEG_Y, up: DVec3::Z, ..Camera::default() },
        lights: vec![light(0.3, 9.0, 0.2)],
        primitives: primitives.to_vec(),
        ..Scene::default()
    };
    let picture = picture(&scene, 64, 64);
    for pixel in &picture.pixels {
        assert!(pixel.first_hit <= 1, "{pixel:?}");
        assert!(pixel.color.z > 0.5, "{pixel:?} is in a shadow");
    }
    let paths: std::collections::HashSet<u64> = picture.pixels.iter().map(|pixel| pixel.path).collect();
    assert_eq!(paths.len(), 2, "the two tops and nothing else");
    let slanting = Scene { lights: vec![light(90.0, 1e-3, 0.0)], ..scene };
    assert!(self::picture(&slanting, 64, 64).pixels.iter().all(|pixel| pixel.color.z > 0.0));
}

#[test]
fn lt_a_light_inside_a_solid_on_its_surface_or_at_the_hit_point_stays_defined() {
    let seen_from = |distance: f64, position: DVec3| {
        let scene = Scene {
            lights: vec![Light { position, intensity: DVec3::ONE, ..Light::default() }],
            max_depth: 1,
            primitives: vec![primitive(cube(DVec3::ZERO, 1.0), material(0.0, 1.0, 1.0))],
            ..Scene::default()
        };
        look(&scene, DVec3::new(0.25, 0.25, -1.0 - distance), DVec3::Z).color
    };
    let lit_by = |position| seen_from(4.0, position);
    assert_eq!(lit_by(DVec3::ZERO), DVec3::ZERO, "inside");
    assert_eq!(lit_by(DVec3::new(0.5, 0.5, -1.0)), DVec3::ZERO, "on the surface");
    // From within the light's ball, which would hide the point.
    assert_eq!(seen_from(0.001, DVec3::new(0.25, 0.25, -1.0)), DVec3::ZERO, "at the hit point");
    assert!(lit_by(DVec3::new(0.5, 0.5, -1.5)).min_element() > 0.0, "before the surface");
}

#[test]
fn lt_a_light_on_a_solid_lights_what_its_side_faces() {
    // The light lies on the top of the box under the sphere, to rounding of 0.1 + 0.2.
    let under =
        Solid::Box { center: DVec3::Y * 0.1, half_size: DVec3::new(5.0, 0.2, 5.0), rotation_degrees: DVec3::ZERO };
    let scene = Scene {
        lights: vec![light(0.0, 0.3, -2.0)],
        max_depth: 1,
        primitives: vec![
            primitive(under, material(0.0, 1.0, 0.0)),
            primitive(sphere(DVec3::Y * 2.0, 1.0), material(0.0, 1.0, 0.0)),
        ],
        ..Scene::default()
    };
    let below_the_equator = look(&scene, DVec3::new(0.0, 1.5, -9.0), DVec3::Z);
    assert_eq!(below_the_equator.first_hit, 1);
    assert!(below_the_equator.color.z > 0.1);
    let behind = look(&scene, DVec3::new(0.0, 1.5, 9.0), DVec3::NEG_Z);
    assert_eq!((behind.first_hit, behind.color), (1, DVec3::ZERO));
}

#[test]
fn mr_no_ray_escapes_from_a_closed_room_of_mirrors() {
    let slanted = DVec3::new(0.48, 0.6, 0.64);
    let rooms = [
        cube(DVec3::new(0.1, 0.2, 0.3), 2.0),
        Solid::Box {
            center: DVec3::ZERO,
            half_size: DVec3::splat(3.0),
            rotation_degrees: DVec3::new(10.0, 20.0, 30.0),
        },
        sphere(DVec3::new(0.1, 0.2, 0.3), 3.0),
        Solid::Cylinder { ends: [-3.0 * slanted, 3.0 * slanted], radius: 3.0 },
        Solid::Cone { apex: -3.0 * slanted, axis: slanted, height: 8.0, half_angle_degrees: 50.0 },
    ];
    for room in rooms {
        for max_depth in [20, 50, 200] {
            let scene = Scene {
                camera: Camera {
                    vertical_fov_degrees: 120.0,
                    position: DVec3::new(0.1, 0.2, 0.3),
                    ..Camera::default()
                },
                ambient_light: DVec3::ONE,
                background: DVec3::ONE,
                lights: vec![],
                max_depth,
                primitives: vec![primitive(room.clone(), mirror()), primitive(sphere(DVec3::X, 0.3), mirror())],
                ..Scene::default()
            };
            let escaped = picture(&scene, 32, 32).pixels.iter().filter(|pixel| pixel.color != DVec3::ZERO).count();
            assert_eq!(escaped, 0, "of {room:?} at depth {max_depth}");
        }
    }
}

#[test]
fn mr_a_ray_into_the_exact_edge_and_corner_of_a_mirror_room_stays_inside() {
    for (center, half_size) in [(DVec3::ZERO, 2.0), (DVec3::new(0.1, 0.7, 0.3), 0.3), (DVec3::splat(1e5), 0.7)] {
        let scene = Scene {
            background: DVec3::ONE,
            lights: vec![],
            max_depth: 200,
            primitives: vec![primitive(cube(center, half_size), mirror())],
            ..Scene::default()
        };
        for direction in
            [DVec3::ONE, DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 1e-17)]
        {
            assert_eq!(look(&scene, center, direction).color, DVec3::ZERO, "{direction} from {center}");
        }
    }
}

#[test]
fn mr_two_mirrors_face_to_face_stay_finite() {
    let primitives = [-2.0, 2.0].map(|x| primitive(sphere(DVec3::X * x, 1.0), material(0.1, 0.1, 1.0)));
    let scene = Scene { max_depth: 200, primitives: primitives.to_vec(), ..Scene::default() };
    // The light's ball is around the camera, and not seen.
    let within = look(&scene, DVec3::ZERO, DVec3::X);
    assert_eq!(within.first_hit, 1);
    let between = look(&scene, DVec3::new(0.1, 0.0, 0.0), DVec3::X);
    assert!(between.color.is_finite() && between.color.min_element() > 1.0, "{between:?}");
}

#[test]
fn it_intensities_up_to_the_largest_f64_stay_finite() {
    for intensity in [1e30, 3e38, f64::MAX] {
        let mut scene = mixed_scene();
        scene.background = DVec3::splat(intensity);
        for light in &mut scene.lights {
            light.intensity = DVec3::splat(intensity);
        }
        for primitive in &mut scene.primitives {
            primitive.material = material(1.0, 1.0, 1.0);
        }
        let picture = picture(&scene, 32, 24);
        assert!(picture.pixels.iter().all(|pixel| pixel.color.is_finite()));
        assert!(picture.to_f32().iter().flatten().all(|channel| channel.is_finite()));
        assert!(picture.pixels.iter().any(|pixel| pixel.color.x >= intensity));
    }
}

/// As small as the last places of the coordinates that far from the world's origin allow: the same picture as at the
/// origin.
#[test]
fn specks_far_from_the_world_s_origin_are_drawn_as_near_it() {
    let unit = 2f64.powi(-25);
    let scene_at = |place: DVec3| {
        let at = |x: f64, y: f64, z: f64| place + DVec3::new(x, y, z) * unit;
        let solids = [
            sphere(at(-1.0, 0.0, 6.0), unit),
            cube(at(1.5, -0.5, 6.0), unit),
            Solid::Cylinder { ends: [at(-1.0, 2.0, 6.0), at(1.0, 2.5, 7.0)], radius: 0.5 * unit },
            Solid::Cone { apex: at(0.0, -1.0, 5.0), axis: DVec3::NEG_Y, height: unit, half_angle_degrees: 30.0 },
        ];
        Scene {
            camera: Camera { position: place, direction: DVec3::Z, vertical_fov_degrees: 60.0, ..Camera::default() },
            lights: vec![Light { position: at(8.0, 16.0, -8.0), radius: 0.0, ..Light::default() }],
            primitives: solids.map(|solid| primitive(solid, material(0.1, 0.6, 0.3))).to_vec(),
            max_depth: 4,
            ..Scene::default()
        }
    };
    let near = picture(&scene_at(DVec3::ZERO), 64, 40);
    let far = picture(&scene_at(DVec3::new(2f64.powi(24), -2f64.powi(23), 2f64.powi(24))), 64, 40);
    let is_other = |(a, b): &(&Pixel, &Pixel)| (a.color - b.color).abs().max_element() > 1e-9;
    let differing = near.pixels.iter().zip(&far.pixels).filter(is_other).count();
    let solid = near.pixels.iter().filter(|pixel| pixel.first_hit < LIGHT_SPHERE).count();
    // Of edges that pass a pixel's very centre.
    assert!(differing <= 2 && solid > 300, "{differing} of {solid}");
}
