//! Path tracing against what is known in closed form, and against itself.

use std::ops::ControlFlow;

use crate::common::TestDevice;
use crate::scenes::{cube, primitive, sphere};
use glam::{DVec3, dvec3};
use zerkalo::algorithm::Algorithm;
use zerkalo::plan::{Limits, Plan};
use zerkalo::reference::path_trace;
use zerkalo::scene::{Camera, Light, Material, Scene, Solid, gallery};
use zerkalo::settings::{Numbers, RenderSettings};
use zerkalo::tracer::{Precision, Progressive, Settings};

const PATH: RenderSettings =
    RenderSettings { algorithm: Algorithm::Path, precision: Some(Precision::F32), ..RenderSettings::DEFAULT };

fn planned(device: &TestDevice, scene: &Scene, settings: &RenderSettings, size: [u32; 2]) -> Settings {
    let limits = Limits { float64: true, packets: device.description().packets, ..Limits::PROMISED };
    Settings::planned(&Plan::for_scene(scene, settings, size, &limits).unwrap())
}

fn take(picture: &mut Progressive, samples: u32) {
    while picture.samples() < samples {
        picture.add_run(samples - picture.samples(), &mut |_| ControlFlow::Continue(())).unwrap();
    }
}

fn drawn(device: &TestDevice, scene: &Scene, settings: &RenderSettings, size: [u32; 2], samples: u32) -> Progressive {
    let mut picture = Progressive::new(device, scene, &planned(device, scene, settings, size)).unwrap();
    take(&mut picture, samples);
    picture
}

fn matt(albedo: f64) -> Material {
    Material::of_course(DVec3::ONE, 0.0, albedo, 0.0)
}

/// The picture's mean, and the standard error of that.
fn mean_of(picture: &Progressive) -> (f64, f64) {
    let means: Vec<f64> = picture.means().map(|mean| mean.x).collect();
    let count = means.len() as f64;
    let errors = picture.standard_errors().unwrap();
    let error = errors.iter().map(|error| error * error).sum::<f64>().sqrt() / count;
    (means.iter().sum::<f64>() / count, error)
}

/// Rounding of a path's weight and sums in `f32`: some operations a generation, of a unit each.
fn rounding(generations: u32) -> f64 {
    8.0 * f64::from(generations.min(200)) * Precision::F32.unit_roundoff()
}

fn in_a_sphere(albedo: f64, reflection: f64) -> Scene {
    let material = Material { reflection: Some(reflection), ..matt(albedo) };
    Scene {
        camera: Camera { position: dvec3(0.4, -0.3, 0.2), ..Camera::default() },
        primitives: vec![primitive(sphere(DVec3::ZERO, 1.0), material)],
        lights: vec![Light { radius: 0.0, ..Light::default() }],
        ..Scene::default()
    }
}

#[test]
fn inside_a_lit_sphere_each_generation_adds_its_share() {
    let device = TestDevice::open();
    for (albedo, generations, samples) in
        [(0.1, 5, 64), (0.5, 1, 64), (0.5, 3, 64), (0.5, 20, 256), (0.9, 50, 512), (0.99, 500, 256)]
    {
        let settings = RenderSettings { max_depth: Some(generations), ..PATH };
        let picture = drawn(&device, &in_a_sphere(albedo, 0.0), &settings, [16, 16], samples);
        let (mean, error) = mean_of(&picture);
        let exact = albedo * (1.0 - albedo.powi(generations as i32)) / (1.0 - albedo);
        assert!(error <= 1e-3 * exact, "{albedo}, {generations}: standard error {error} of {exact}");
        let allowed = 4.0 * error + rounding(generations) * exact;
        assert!((mean - exact).abs() <= allowed, "{albedo}, {generations}: {mean} is not {exact} to {allowed}");
    }
}

#[test]
fn a_mirrored_share_of_a_lit_sphere_is_light_of_the_sphere_too() {
    // Every ray inside meets the wall, whichever way it goes: L = k_d * I + (k_d + reflection) * L.
    let device = TestDevice::open();
    let (albedo, reflection, generations) = (0.4_f64, 0.3, 30);
    let settings = RenderSettings { max_depth: Some(generations), ..PATH };
    let (mean, error) = mean_of(&drawn(&device, &in_a_sphere(albedo, reflection), &settings, [16, 16], 512));
    let all = albedo + reflection;
    let exact = albedo * (1.0 - all.powi(generations as i32)) / (1.0 - all);
    assert!(error <= 1e-3 * exact, "standard error {error} of {exact}");
    assert!((mean - exact).abs() <= 4.0 * error + rounding(generations) * exact, "{mean} is not {exact}");
}

/// One of each kind, or all of them.
fn solids() -> Vec<Vec<Solid>> {
    let kinds = [
        sphere(dvec3(-1.2, 0.0, 5.0), 1.0),
        Solid::Box {
            center: dvec3(1.2, 0.0, 5.0),
            half_size: dvec3(0.8, 0.9, 0.7),
            rotation_degrees: dvec3(20.0, 30.0, 0.0),
        },
        Solid::Cylinder { ends: [dvec3(-1.0, 2.0, 6.0), dvec3(1.0, 2.5, 5.0)], radius: 0.7 },
        Solid::Cone { apex: dvec3(0.0, -1.0, 5.0), axis: dvec3(0.2, -1.0, 0.1), height: 2.0, half_angle_degrees: 35.0 },
    ];
    let each = kinds.iter().map(|solid| vec![solid.clone()]);
    each.chain([kinds.to_vec()]).collect()
}

#[test]
fn in_a_white_furnace_nothing_is_seen() {
    let device = TestDevice::open();
    for (diffuse, reflection, transmission) in [(1.0, 0.0, 0.0), (0.7, 0.3, 0.0), (0.0, 0.2, 0.8), (0.3, 0.3, 0.4)] {
        for solids in solids() {
            let material =
                Material { reflection: Some(reflection), transmission, refractive_index: 1.5, ..matt(diffuse) };
            let primitives = solids.into_iter().map(|solid| primitive(solid, material.clone())).collect();
            let scene = Scene {
                camera: Camera { vertical_fov_degrees: 60.0, ..Camera::default() },
                background: DVec3::ONE,
                max_depth: 1000,
                lights: Vec::new(),
                primitives,
                ..Scene::default()
            };
            let picture = drawn(&device, &scene, &PATH, [48, 32], 16);
            let what = || format!("{diffuse} {reflection} {transmission}: {:?}", scene.primitives);
            let worst = picture.means().map(|mean| (mean - 1.0).abs().max_element()).fold(0.0, f64::max);
            assert!(worst <= 1e-3, "{worst}: {}", what());
        }
    }
}

#[test]
fn a_plate_at_the_foot_of_a_black_wall_gets_half_of_the_sky() {
    let device = TestDevice::open();
    // Of the half of the hemisphere behind its plane, the wall of length 2L leaves at a distance d what passes its ends:
    // 2 * atan(d / L) of the 2 pi around, and above it as little again as (d / H)^2 / 4. At d < 0.15 that is 0.8 times
    // 5e-5 at most.
    let floor =
        Solid::Box { center: dvec3(0.0, -1.0, 0.0), half_size: dvec3(1e3, 1.0, 1e3), rotation_degrees: DVec3::ZERO };
    let wall =
        Solid::Box { center: dvec3(0.0, 500.0, 1.0), half_size: dvec3(1e3, 500.0, 0.5), rotation_degrees: DVec3::ZERO };
    let scene = Scene {
        camera: Camera {
            position: dvec3(0.0, 0.5, 0.4),
            direction: dvec3(0.0, -1.0, 0.1),
            vertical_fov_degrees: 4.0,
            ..Camera::default()
        },
        background: DVec3::ONE,
        lights: Vec::new(),
        primitives: vec![primitive(floor, matt(0.8)), primitive(wall, matt(0.0))],
        ..Scene::default()
    };
    let picture = drawn(&device, &scene, &PATH, [32, 32], 1024);
    let (mean, error) = mean_of(&picture);
    assert!(error <= 1e-3 * 0.4, "standard error {error}");
    assert!((mean - 0.4).abs() <= 4.0 * error + 4e-5, "{mean}");
}

/// A scene without mirrors, in which light goes from wall to wall.
fn matt_scene() -> Scene {
    let mut scene = gallery::scene("four").unwrap();
    for primitive in &mut scene.primitives {
        primitive.material = matt(0.7);
    }
    let floor = cube(dvec3(0.0, -102.0, 0.0), 100.0);
    scene.primitives.push(primitive(floor, matt(0.6)));
    scene.background = DVec3::splat(0.4);
    scene.max_depth = 6;
    scene
}

/// Where a shadow ray goes to one of the lights: unequal ones, of which one fades, one is dark and one within a solid.
fn many_lights() -> Scene {
    let mut scene = matt_scene();
    scene.background = DVec3::splat(0.05);
    scene.primitives[0].material.specular = 0.4;
    scene.primitives[2].material.color = DVec3::X;
    scene.primitives[3].material.color = dvec3(0.0, 0.8, 0.1);
    let place = |index: usize| dvec3(index as f64 * 1.3 - 4.0, 1.0 + (index % 3) as f64, -3.0 + (index % 4) as f64);
    let light = |index: usize| Light {
        position: place(index),
        // Of all colours, so that what a coloured surface sends back of one may be nothing.
        intensity: [DVec3::X, DVec3::Y, dvec3(0.5, 0.7, 0.4)][index % 3] * (0.2 + 0.2 * (index % 5) as f64),
        ..Light::default()
    };
    scene.lights = (0..8).map(light).collect();
    scene.lights[2].intensity = DVec3::ZERO;
    scene.lights[4].distance_constant = Some(0.5);
    scene.lights[6].position = scene.primitives[1].solid.position();
    scene
}

const SMALL: [u32; 2] = [36, 24];

fn rms_difference(picture: &Progressive, truth: &[DVec3]) -> f64 {
    let squares: f64 = picture.means().zip(truth).map(|(mean, truth)| (mean - truth).length_squared() / 3.0).sum();
    (squares / truth.len() as f64).sqrt()
}

#[test]
fn noise_falls_with_the_root_of_the_samples_and_faster_by_sobols() {
    let device = TestDevice::open();
    let scene = matt_scene();
    let counts = [16, 64, 256, 1024];
    let mut picture = drawn(&device, &scene, &RenderSettings { seed: 1000, ..PATH }, SMALL, 1 << 14);
    let truth: Vec<DVec3> = picture.means().collect();
    let mut errors = |numbers| {
        let mut squares = [0.0; 4];
        for seed in 1..=4 {
            let settings = planned(&device, &scene, &RenderSettings { numbers, seed, ..PATH }, SMALL);
            picture.restart(&scene, &settings).unwrap();
            for (squares, samples) in squares.iter_mut().zip(counts) {
                take(&mut picture, samples);
                *squares += rms_difference(&picture, &truth).powi(2) / 4.0;
            }
        }
        squares.map(f64::sqrt)
    };
    let (random, sobol) = (errors(Numbers::Independent), errors(Numbers::Sobol));
    let slope = |errors: [f64; 4]| {
        // Least squares of the logarithms.
        let points = counts.map(f64::from).map(f64::ln).into_iter().zip(errors.map(f64::ln));
        let [x, y] = [0, 1].map(|axis| points.clone().map(|(x, y)| [x, y][axis]).sum::<f64>() / 4.0);
        points.clone().map(|(px, py)| (px - x) * (py - y)).sum::<f64>()
            / points.map(|(px, _)| (px - x).powi(2)).sum::<f64>()
    };
    println!("independent {random:?}, slope {}; Sobol {sobol:?}, slope {}", slope(random), slope(sobol));
    assert!((slope(random) + 0.5).abs() <= 0.03, "{random:?}: slope {}", slope(random));
    assert!(slope(sobol) <= -0.5, "{sobol:?}: slope {}", slope(sobol));
    assert!(sobol[2] <= 0.7 * random[2], "at 256 samples: {} and {}", sobol[2], random[2]);
}

/// What the absolute value of Student's t of so many degrees of freedom is above by chance once in a hundred times in the
/// worst of so many pixels (Šidák), from the normal distribution's quantile (Abramowitz and Stegun 26.2.23, 26.7.5).
fn worst_t(degrees: f64, pixels: usize) -> f64 {
    let tail = (1.0 - 0.99_f64.powf(1.0 / pixels as f64)) / 2.0;
    let s = (-2.0 * tail.ln()).sqrt();
    let z = s - (2.515517 + s * (0.802853 + s * 0.010328)) / (1.0 + s * (1.432788 + s * (0.189269 + s * 0.001308)));
    z + (z.powi(3) + z) / (4.0 * degrees) + (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / (96.0 * degrees.powi(2))
}

#[test]
fn pictures_are_those_of_the_reference_on_the_cpu() {
    let device = TestDevice::open();
    const SEEDS: u32 = 64;
    let several = gallery::scene("several").unwrap();
    let scenes = ["showcase", "glass"].map(|name| gallery::scene(name).unwrap());
    for mut scene in scenes.into_iter().chain([matt_scene(), several, many_lights()]) {
        scene.max_depth = 6;
        let [width, height] = SMALL;
        let cpu = path_trace(&scene, width, height, 256, 1, &|_| ControlFlow::Continue(())).unwrap();
        let mut picture = drawn(&device, &scene, &PATH, SMALL, 1);
        let of_seed = |seed| {
            let settings = planned(&device, &scene, &RenderSettings { seed, ..PATH }, SMALL);
            picture.restart(&scene, &settings).unwrap();
            take(&mut picture, 8);
            picture.means().collect()
        };
        let pictures: Vec<Vec<DVec3>> = (0..SEEDS).map(of_seed).collect();
        let n = f64::from(SEEDS);
        // Rounding to f32 moves colours by up to 1.6e-5 (whitted in f32 against the reference, 300 random scenes of
        // glass): noise below that is none.
        let floor = DVec3::splat(1.6e-5_f64.powi(2));
        let mut worst = 0.0_f64;
        for (pixel, cpu) in cpu.iter().enumerate() {
            let mean = pictures.iter().map(|picture| picture[pixel]).sum::<DVec3>() / n;
            let squares = pictures.iter().map(|picture| (picture[pixel] - mean).powf(2.0)).sum::<DVec3>();
            let variance = squares / (n - 1.0) / n + cpu.variance_of_mean + floor;
            worst = worst.max(((mean - cpu.mean).abs() / variance.powf(0.5)).max_element());
        }
        // Three channels of each pixel.
        let limit = worst_t(n - 1.0, 3 * cpu.len());
        println!("t is {worst} at most, of {limit}");
        assert!(worst <= limit, "{worst} is above {limit}: {:?}", scene.primitives[0]);
    }
}

#[test]
fn estimated_errors_are_those_that_there_are() {
    let device = TestDevice::open();
    let scene = matt_scene();
    let truth: Vec<DVec3> =
        drawn(&device, &scene, &RenderSettings { seed: 77, ..PATH }, SMALL, 1 << 14).means().collect();
    // The root of the mean square of 864 independent pixels is off by 1 / sqrt(2 * 864) = 2.4 %: four times that, and of
    // Sobol's numbers, which spare each other more than runs can tell, no more than the estimate.
    for (numbers, low, high) in [(Numbers::Independent, 0.9, 1.1), (Numbers::Sobol, 0.0, 1.0)] {
        let picture = drawn(&device, &scene, &RenderSettings { numbers, ..PATH }, SMALL, 512);
        // All channels are one.
        let squares: f64 = picture.means().zip(&truth).map(|(mean, truth)| (mean.x - truth.x).powi(2)).sum();
        let found = (squares / truth.len() as f64).sqrt();
        let share = found / picture.error().unwrap().rms;
        println!("{numbers:?}: {share} of the estimate");
        assert!((low..=high).contains(&share), "{numbers:?}: {found} is {share} of the estimate");
    }
}

#[test]
fn a_seed_gives_the_same_picture_however_it_is_cut_and_another_seed_another() {
    let device = TestDevice::open();
    let scene = gallery::scene("showcase").unwrap();
    let limits = Limits { float64: true, packets: device.description().packets, ..Limits::PROMISED };
    let plan = Plan::for_scene(&scene, &PATH, [61, 35], &limits).unwrap();
    let draw = |settings: &Settings| {
        let mut picture = Progressive::new(&device, &scene, settings).unwrap();
        for samples in [8, 8] {
            picture.add_run(samples, &mut |_| ControlFlow::Continue(())).unwrap();
        }
        picture.means().collect::<Vec<_>>()
    };
    let planned = Settings::planned(&plan);
    let first = draw(&planned);
    assert_eq!(first, draw(&Settings { max_tile_side: 16, ..planned.clone() }), "in tiles");
    assert_eq!(first, draw(&Settings { workgroup: [4, 4], ..planned.clone() }), "in other workgroups");
    assert_eq!(first, draw(&Settings { without_boxes: true, ..planned.clone() }), "without boxes");
    assert_ne!(first, draw(&Settings { seed: 1, ..planned }));
}

#[test]
fn pictures_of_any_size_are_of_numbers_from_within_solids_too() {
    let device = TestDevice::open();
    let within_glass = {
        let mut scene = gallery::scene("glass").unwrap();
        let glass = scene.primitives.iter().find(|one| one.material.transmission > 0.0).unwrap();
        scene.camera.position = glass.solid.position();
        scene
    };
    for scene in [within_glass, in_a_sphere(0.5, 0.3), Scene { primitives: Vec::new(), ..matt_scene() }] {
        for size in [[1, 1], [1, 77], [16384, 1], [9, 17]] {
            let picture = drawn(&device, &scene, &PATH, size, 2);
            assert_eq!(picture.means().count() as u32, size[0] * size[1]);
            assert!(picture.means().all(|mean| mean.is_finite() && mean.min_element() >= 0.0), "{size:?}");
        }
    }
}

#[test]
fn many_lights_as_bright_as_numbers_go_or_next_to_none_give_numbers() {
    let device = TestDevice::open();
    for intensity in [3e38, 1e30, 1e-30, 1e-38] {
        let mut scene = many_lights();
        for light in &mut scene.lights {
            light.intensity = light.intensity.map(|channel| channel.min(1.0) * intensity);
        }
        let picture = drawn(&device, &scene, &PATH, SMALL, 8);
        assert!(picture.means().all(|mean| mean.is_finite() && mean.min_element() >= 0.0), "{intensity}");
    }
}

#[test]
fn f64_draws_the_same_light() {
    let device = TestDevice::open();
    let scene = matt_scene();
    let of = |precision| drawn(&device, &scene, &RenderSettings { precision: Some(precision), ..PATH }, SMALL, 64);
    let ((in_f32, error), (in_f64, _)) = (mean_of(&of(Precision::F32)), mean_of(&of(Precision::F64)));
    // The same random numbers: what differs are paths that rounding sends elsewhere.
    assert!((in_f32 - in_f64).abs() <= error, "{in_f32} and {in_f64}");
}
