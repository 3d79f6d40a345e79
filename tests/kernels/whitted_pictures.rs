//! The accurate kernel's pictures against the reference's, by the tolerances of docs/numerics.md.

use std::fs;
use std::path::Path;

use crate::budget;
use crate::common::TestDevice;
use crate::scenes::{mixed_scene, moved_and_scaled, picture};
use crate::tracers::Tracers;
use glam::DVec3;
use zerkalo::measure::{Difference, tolerances};
use zerkalo::plan::{Limits, Plan};
use zerkalo::reference::LIGHT_SPHERE;
use zerkalo::scene::{Light, Projection, Scene, gallery};
use zerkalo::settings::RenderSettings;
use zerkalo::tracer::{Kernel, Precision, Settings};

const SIZE: [u32; 2] = [88, 38];

/// Linear RGB in `f64`.
fn kernel_picture(tracers: &mut Tracers, scene: &Scene, precision: Precision, [width, height]: [u32; 2]) -> Vec<DVec3> {
    tracers.draw_f64(scene, &Settings { kernel: Kernel::Whitted(precision), ..Settings::new(width, height) })
}

fn golden_scenes() -> Vec<(String, Scene)> {
    let goldens = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/goldens");
    let mut folders: Vec<_> = fs::read_dir(goldens).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    let scene = |folder: &Path| Scene::load(&folder.join("scene.json")).unwrap();
    folders.iter().map(|folder| (folder.file_name().unwrap().to_string_lossy().into_owned(), scene(folder))).collect()
}

fn gallery_scenes() -> Vec<(String, Scene)> {
    let scene = |name: String| (name.clone(), gallery::scene(&name).unwrap());
    gallery::entries().iter().map(|entry| scene(entry.name.clone())).collect()
}

fn every_picture_is_the_references(scenes: Vec<(String, Scene)>) {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    for projection in Projection::ALL {
        let mut totals = [Difference::default(); 2];
        for (name, scene) in &scenes {
            let mut scene = scene.clone();
            scene.camera.projection = projection;
            let truth = picture(&scene, SIZE[0], SIZE[1]);
            for (total, precision) in totals.iter_mut().zip([Precision::F32, Precision::F64]) {
                let (tolerance, _) = tolerances(precision);
                let ours = kernel_picture(&mut tracers, &scene, precision, SIZE);
                let difference = Difference::between(&truth, &ours, tolerance, |_| true);
                if difference.largest > tolerance || difference.differing > 0 {
                    println!("{name}, {}, {}: {difference:?}", projection.name(), precision.name());
                }
                *total = total.plus(difference);
            }
        }
        for (total, precision) in totals.into_iter().zip([Precision::F32, Precision::F64]) {
            println!("{} scenes, {}, {}: {total:?}", scenes.len(), projection.name(), precision.name());
            let (largest, share) = tolerances(precision);
            assert_eq!(total.not_finite, 0);
            assert!(total.largest <= largest);
            assert!(total.differing as f64 <= share * total.discontinuities as f64);
            assert!(total.discontinuities > 5_000 && total.smooth > 20_000 && total.solid > 10_000);
        }
    }
}

#[test]
fn every_gallery_scene_looks_as_the_reference_sees_it() {
    every_picture_is_the_references(gallery_scenes());
}

#[test]
fn every_goldens_scene_looks_as_the_reference_sees_it() {
    every_picture_is_the_references(golden_scenes());
}

/// Neighbours that are at different lights, at different generations: none may take what is another's. By packets of
/// eight rays, and by each ray for itself.
#[test]
fn pictures_lit_by_several_lights_are_the_references() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let [width, height] = [122, 53];
    let (mut smooth, mut lit) = (0, 0);
    let random = (100..106_u32).map(|seed| {
        let place = |turn: f64| 5.0 * DVec3::new(turn.sin(), (2.3 * turn).cos(), (turn * turn).cos());
        let light = |index: u32| Light { position: place(f64::from(index + seed)), ..Light::default() };
        Scene { lights: (0..2 + seed % 3).map(light).collect(), ..budget::random_scene(seed.into()) }
    });
    // Drawn wrong by Mesa 22.3 once.
    let three_lights = Scene::load(Path::new("tests/scenes/three_lights.toml")).unwrap();
    for (number, scene) in [three_lights].into_iter().chain(random).enumerate() {
        let scene = Scene { max_depth: 3, ..scene };
        let truth = picture(&scene, width, height);
        let settings = RenderSettings { precision: Some(Precision::F32), ..RenderSettings::default() };
        let plan = Plan::for_scene(&scene, &settings, [width, height], &Limits::PROMISED).unwrap();
        // Places are off by 32u of the scene's 10; two mirrors, round ones, multiply that by ten each, and a
        // highlight's slope by five. The third of a light that a picture must not be off by is thirty times that.
        let tolerance = 32.0 * 6e-8 * 10.0 * 100.0 * 5.0;
        for workgroup in [[8, 8], [4, 16]] {
            let settings = Settings { workgroup, ..Settings::planned(&plan) };
            let ours = tracers.draw_f64(&scene, &settings);
            let difference = Difference::between(&truth, &ours, tolerance, |_| true);
            let Difference { largest, not_finite, .. } = difference;
            assert!(largest <= tolerance && not_finite == 0, "scene {number}, {workgroup:?}: {difference:?}");
            smooth += difference.smooth;
            lit += difference.solid;
        }
    }
    assert!(smooth > 20_000 && lit > 20_000, "{smooth} smooth pixels, {lit} of solids");
}

/// Only pixels that show solids in both: the light's ball has one size in every scene.
#[test]
fn a_scene_scaled_by_a_million_or_moved_by_1e5_of_its_size_looks_the_same() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let scene = mixed_scene();
    let [width, height] = [160, 100];
    let original = picture(&scene, width, height);
    // The scene's size is about 10.
    let moves = [
        ("×1e-6", moved_and_scaled(&scene, DVec3::ZERO, 1e-6)),
        ("×1e6", moved_and_scaled(&scene, DVec3::ZERO, 1e6)),
        ("+1e6", moved_and_scaled(&scene, DVec3::new(1e6, -1e6, 1e6), 1.0)),
    ];
    for (name, moved) in &moves {
        let truth = picture(moved, width, height);
        for precision in [Precision::F32, Precision::F64] {
            let (largest, share) = tolerances(precision);
            let ours = kernel_picture(&mut tracers, moved, precision, [width, height]);
            let shows_solid = |index: usize| {
                truth.pixels[index].first_hit < LIGHT_SPHERE && original.pixels[index].first_hit < LIGHT_SPHERE
            };
            for (image, of) in [(&truth, "the same scene's reference"), (&original, "the original's")] {
                let difference = Difference::between(image, &ours, largest, shows_solid);
                println!("{name} {} against {of}: {difference:?}", precision.name());
                assert!(difference.solid > 3_500 && difference.discontinuities > 1_000);
                assert_eq!(difference.not_finite, 0);
                assert!(difference.largest <= largest);
                assert!(difference.differing as f64 <= share * difference.discontinuities as f64);
            }
        }
    }
}

#[test]
fn a_scene_scaled_by_a_power_of_two_gives_the_same_bits() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let mut scene = mixed_scene();
    // The camera stays outside of the balls, which have one size in every scene.
    scene.lights.iter_mut().for_each(|light| light.position *= 1e4);
    for precision in [Precision::F32, Precision::F64] {
        let original = kernel_picture(&mut tracers, &scene, precision, SIZE);
        for exponent in [-20, -1, 1, 20] {
            let scaled = moved_and_scaled(&scene, DVec3::ZERO, 2f64.powi(exponent));
            assert!(kernel_picture(&mut tracers, &scaled, precision, SIZE) == original, "2^{exponent}");
        }
    }
}
