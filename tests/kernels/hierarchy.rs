//! The boxes over the solids: what they promise by themselves, and that they change nothing that is seen.

use crate::common::{TestDevice, render};
use crate::scenes::{cube, light, material, picture, primitive, sphere};
use crate::tracers::Tracers;
use glam::DVec3;
use rayon::prelude::*;
use zerkalo::frame::Frame;
use zerkalo::reference::{BACKGROUND, LIGHT_SPHERE};
use zerkalo::scene::{Bounds, Camera, Light, Material, Primitive, Scene, SceneSpace, Solid, SolidKind, gallery};
use zerkalo::tracer::whitted::{
    WhittedRecords,
    hierarchy::{GROUP, level_count, levels, order},
};
use zerkalo::tracer::{Kernel, Precision, Settings};

fn made(name: &str) -> Scene {
    gallery::scene(name).unwrap_or_else(|| panic!("no scene {name}"))
}

/// World frame.
fn bounds_of(scene: &Scene) -> Vec<Bounds> {
    scene.primitives.iter().map(|primitive| Bounds::of(&primitive.solid, SceneSpace::world(1e6))).collect()
}

fn ordered(bounds: &[Bounds]) -> Vec<Bounds> {
    order(bounds).into_iter().map(|place| bounds[place as usize]).collect()
}

fn half_area(bounds: Bounds) -> f64 {
    let side = bounds.high - bounds.low;
    side.x * side.y + side.y * side.z + side.z * side.x
}

#[test]
fn an_order_has_every_solid_once_however_many_there_are() {
    let all = bounds_of(&made("cloud-5000"));
    for count in (0..140).chain([511, 512, 513, 4095, 4096, 4097, 5000]) {
        let mut places = order(&all[..count]);
        places.sort_unstable();
        assert!(places.into_iter().eq(0..count as u32), "{count}");
    }
}

#[test]
fn solids_of_one_place_keep_the_order_of_the_scene() {
    let same = vec![bounds_of(&made("cloud-1"))[0]; 3000];
    let mut places = order(&same);
    places.chunks_mut(GROUP).for_each(<[u32]>::sort_unstable);
    assert!(places.into_iter().eq(0..3000));
}

#[test]
fn boxes_hold_what_is_below_them_and_a_level_has_an_eighth_of_it() {
    for count in [33, 64, 65, 257, 4097, 5000] {
        let solids = ordered(&bounds_of(&made(&format!("cloud-{count}"))));
        let levels = levels(&solids);
        assert_eq!(levels.len(), level_count(count));
        let mut below = &solids;
        for level in &levels {
            assert_eq!(level.boxes.len(), below.len().div_ceil(GROUP));
            assert_eq!(level.orders.len(), level.boxes.len().div_ceil(GROUP));
            for (index, inner) in below.iter().enumerate() {
                let outer = level.boxes[index / GROUP];
                assert!(outer.low.cmple(inner.low).all() && outer.high.cmpge(inner.high).all(), "{count}: {index}");
            }
            below = &level.boxes;
        }
    }
}

/// What the search skips boxes by: rows of a box hold those of all boxes in it, and more by what an entry may be off.
#[test]
fn rows_of_boxes_hold_those_below_them_by_four_place_errors() {
    let scene = made("cloud-sphere-5000");
    let records = WhittedRecords::of(&scene, SceneSpace::of(&scene), Precision::F32, [1, 1]);
    let solids = &records.solids;
    let faces = |rows: &[[f32; 4]]| {
        let [middle, half] = [rows[0], rows[1]].map(|[x, y, z, _]| DVec3::new(x.into(), y.into(), z.into()));
        (middle - half, middle + half)
    };
    let place_error = f64::from(8.0 * f32::EPSILON * solids.frame.reach);
    let mut first = solids.counts[0].next_multiple_of(8) as usize;
    let mut count = solids.counts[0].div_ceil(8) as usize;
    assert_eq!(solids.levels[0], 3);
    for _ in 1..solids.levels[0] {
        let above = first + 2 * count.next_multiple_of(8);
        for index in 0..count {
            let (low, high) = faces(&solids.proxies[first + 2 * index..]);
            let (outer_low, outer_high) = faces(&solids.proxies[above + 2 * (index / 8)..]);
            let margin = (low - outer_low).min(outer_high - high).min_element();
            assert!(margin > 3.5 * place_error, "box {index}: {} place errors", margin / place_error);
        }
        (first, count) = (above, count.div_ceil(8));
    }
}

/// Where Mesa's CPU drivers allow a pixel no more than so many turns of its loops.
#[test]
fn a_million_solids_are_drawn_whole() {
    let device = TestDevice::open();
    for name in ["squares-1000000", "cloud-1000000"] {
        let settings = Settings { kernel: Kernel::Whitted(Precision::F32), ..Settings::new(96, 41) };
        assert!(colors(&render(&device, &made(name), &settings)) > 200, "{name}: little is seen");
    }
}

#[test]
fn bounds_hold_every_point_of_a_surface() {
    for kind in SolidKind::ALL {
        for primitive in made(&format!("cloud-{}-300", kind.name())).primitives {
            let Bounds { low, high } = Bounds::of(&primitive.solid, SceneSpace::world(1e6));
            for point in surface_points(&primitive.solid) {
                let outside = (low - point).max(point - high).max_element();
                assert!(outside < 1e-12, "{:?}: {point} is {outside:e} outside", primitive.solid);
            }
            // And no more than that: each side of the box is touched.
            let extremes = surface_points(&primitive.solid).into_iter();
            let (least, most) =
                extremes.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(least, most), p| (least.min(p), most.max(p)));
            assert!((least - low).max_element() < 0.02 && (high - most).max_element() < 0.02, "{:?}", primitive.solid);
        }
    }
}

/// Enough of them to come near every extreme.
fn surface_points(solid: &Solid) -> Vec<DVec3> {
    let turn = |step: usize| (step as f64 / 64.0 * std::f64::consts::TAU).sin_cos();
    let circle = |center: DVec3, axis: DVec3, radius: f64| {
        let (u, v) = axis.any_orthonormal_pair();
        (0..64).map(move |step| {
            let (sine, cosine) = turn(step);
            center + radius * (u * sine + v * cosine)
        })
    };
    match *solid {
        Solid::Sphere { center, radius } => {
            [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| circle(center, axis, radius)).collect()
        }
        Solid::Box { center, half_size, rotation_degrees } => {
            let axes = zerkalo::scene::world_from_box(rotation_degrees);
            let signs = |corner: usize| DVec3::from_array([0, 1, 2].map(|bit| ((corner >> bit & 1) * 2) as f64 - 1.0));
            (0..8).map(|corner| center + axes * (half_size * signs(corner))).collect()
        }
        Solid::Cylinder { ends: [a, b], radius } => {
            let axis = (b - a).normalize();
            circle(a, axis, radius).chain(circle(b, axis, radius)).collect()
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let radius = height * half_angle_degrees.to_radians().tan();
            circle(apex + axis * height, axis, radius).chain([apex]).collect()
        }
    }
}

#[test]
fn a_group_is_no_larger_than_its_share_of_a_uniform_cloud() {
    let cloud = bounds_of(&made("cloud-sphere-32768"));
    let mean = |boxes: &[Bounds]| boxes.iter().copied().map(half_area).sum::<f64>() / boxes.len() as f64;
    for (height, level) in (1..).zip(levels(&ordered(&cloud))) {
        // A cube of 8ʰ times 8 cubic units, and the radii that stand out of it.
        let side = 2.0 * 2_f64.powi(height) + 2.0 * 0.8;
        assert!(mean(&level.boxes) < 3.0 * side * side, "level {height}");
    }
}

#[test]
fn any_number_of_threads_makes_the_same_structure() {
    let cloud = bounds_of(&made("cloud-20000"));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| (order(&cloud), levels(&ordered(&cloud))))
    };
    let alone = on(1);
    for threads in [2, 3, 7] {
        assert!(on(threads) == alone, "{threads} threads");
    }
}

fn settings(precision: Precision) -> Settings {
    Settings { kernel: Kernel::Whitted(precision), max_depth: Some(4), ..Settings::new(96, 64) }
}

/// Against pictures whose rays search each for itself, down the boxes as GPUs have it, and looking at every solid.
fn assert_boxes_change_nothing(device: &TestDevice, scene: &Scene, about: &str) {
    // Packets are of eight invocations in a row.
    let alone = [4, 16];
    for precision in [Precision::F32, Precision::F64] {
        let with = render(device, scene, &settings(precision));
        for without_boxes in [false, true] {
            let other = render(device, scene, &Settings { without_boxes, workgroup: alone, ..settings(precision) });
            let differing = with.pixels().iter().zip(other.pixels()).filter(|(a, b)| a != b).count();
            assert_eq!(differing, 0, "{about} in {}, without boxes: {without_boxes}: pixels", precision.name());
        }
        assert!(colors(&with) > 200, "{about} in {}: little is seen", precision.name());
    }
}

fn colors(frame: &Frame) -> usize {
    let bits: std::collections::HashSet<_> = frame.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect();
    bits.len()
}

#[test]
fn boxes_change_no_bit_of_a_cloud_of_any_kind() {
    let device = TestDevice::open();
    assert_boxes_change_nothing(&device, &made("cloud-2000"), "cloud-2000");
    for kind in SolidKind::ALL {
        let name = format!("cloud-{}-700", kind.name());
        assert_boxes_change_nothing(&device, &made(&name), &name);
    }
}

#[test]
fn boxes_change_no_bit_of_what_is_seen_from_within_a_cloud() {
    let device = TestDevice::open();
    let mut scene = made("cloud-1500");
    scene.camera = Camera { vertical_fov_degrees: 100.0, ..Camera::default() };
    scene.camera.position = DVec3::new(0.3, 0.2, -0.1);
    scene.lights.push(light(1.0, 2.0, 1.5));
    // From inside a solid nothing else is seen.
    scene.primitives.retain(|primitive| primitive.solid.position().distance(scene.camera.position) > 3.0);
    assert_boxes_change_nothing(&device, &scene, "inside");
}

#[test]
fn boxes_change_no_bit_where_solids_touch_or_coincide() {
    let device = TestDevice::open();
    assert_boxes_change_nothing(&device, &made("squares-600"), "balls in contact");
    for kind in [SolidKind::Sphere, SolidKind::Box, SolidKind::Cylinder, SolidKind::Cone] {
        assert_boxes_change_nothing(&device, &doubled(kind), &format!("{kind:?} twice"));
    }
    assert_boxes_change_nothing(&device, &wall_of_cubes(), "cubes that share faces");
}

/// Each solid twice, in two colours, the second ones in the opposite order: every hit is a tie.
fn doubled(kind: SolidKind) -> Scene {
    let mut scene = made(&format!("cloud-{}-150", kind.name()));
    let again: Vec<_> = scene.primitives.iter().rev().cloned().collect();
    scene.primitives.extend(again);
    recolor(&mut scene.primitives);
    scene
}

/// In numbers that every precision stores.
fn wall_of_cubes() -> Scene {
    let place =
        |index: usize| DVec3::new((index % 20) as f64 - 9.5, (index / 20 % 10) as f64 - 4.5, (index / 200) as f64);
    let mut primitives: Vec<_> =
        (0..600).map(|index| primitive(cube(place(index), 0.5), material(0.2, 0.5, 0.3))).collect();
    recolor(&mut primitives);
    Scene {
        camera: Camera {
            position: DVec3::new(-6.0, 5.0, -28.0),
            direction: DVec3::new(0.2, -0.15, 1.0),
            ..Camera::default()
        },
        lights: vec![light(-4.0, 8.0, -16.0)],
        primitives,
        ..Scene::default()
    }
}

fn recolor(primitives: &mut [Primitive]) {
    for (index, primitive) in primitives.iter_mut().enumerate() {
        primitive.material.color = color_of(index);
    }
}

/// From an index up to 4095, in numbers that an `f32` holds.
fn color_of(index: usize) -> DVec3 {
    DVec3::new((index + 1) as f64 / 4096.0, 1.0, 0.0)
}

fn index_of([red, green, _]: [f32; 3]) -> Option<usize> {
    (green == 1.0).then(|| (red * 4096.0) as usize - 1)
}

/// Every pixel has the colour of the solid that it shows.
fn labelled(mut scene: Scene) -> Scene {
    recolor(&mut scene.primitives);
    let paint = Material { ambient: 1.0, diffuse: 0.0, specular: 0.0, ..Material::default() };
    for primitive in &mut scene.primitives {
        primitive.material = Material { color: primitive.material.color, ..paint.clone() };
    }
    Scene { background: DVec3::ZERO, max_depth: 1, lights: Vec::<Light>::new(), ..scene }
}

#[test]
fn solids_seen_first_are_those_of_the_reference_ties_included() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let clouds = ["cloud-3000", "cloud-sphere-400", "cloud-box-400", "cloud-cylinder-400", "cloud-cone-400"].map(made);
    let mut scenes: Vec<Scene> = clouds.into_iter().chain(SolidKind::ALL.map(doubled)).collect();
    scenes.push(made("squares-900"));
    scenes.push(wall_of_cubes());
    scenes.push(Scene {
        primitives: vec![primitive(sphere(DVec3::Z * 5.0, 1.0), material(0.2, 0.5, 0.3)); 500],
        ..Scene::default()
    });
    for (number, scene) in scenes.into_iter().map(labelled).enumerate() {
        let (width, height) = (160, 96);
        let settings = Settings { kernel: Kernel::Whitted(Precision::F64), ..Settings::new(width, height) };
        let frame = tracers.draw(&scene, &settings);
        let truth = picture(&scene, width, height);
        let pairs: Vec<_> = (frame.pixels().par_iter().map(|&pixel| index_of(pixel)))
            .zip(truth.pixels.par_iter().map(|pixel| match pixel.first_hit {
                BACKGROUND | LIGHT_SPHERE => None,
                index => Some(index as usize),
            }))
            .collect();
        assert!(pairs.iter().filter(|(_, truth)| truth.is_some()).count() > 500, "scene {number}: little is seen");
        let wrong: Vec<_> = pairs.iter().filter(|(seen, truth)| seen != truth).collect();
        assert!(wrong.is_empty(), "scene {number}: {} pixels, such as {:?}", wrong.len(), wrong[0]);
    }
}
