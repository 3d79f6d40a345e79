//! An allowed error on the device: pictures by the accurate kernel with a plan's cuts, against its own without them and
//! against the reference.

use crate::budget::random_scene;
use crate::common::TestDevice;
use crate::random::Random;
use crate::scenes::picture;
use crate::tracers::Tracers;
use glam::DVec3;
use zerkalo::measure::{Difference, tolerances};
use zerkalo::plan::{Limits, Plan, Precision};
use zerkalo::scene::Scene;
use zerkalo::settings::RenderSettings;
use zerkalo::tracer::{Kernel, Settings};

const SCENES: u64 = 120;
const SIZE: [u32; 2] = [24, 16];

/// A [random scene](random_scene) of which some solids are glass, some highlights have exponents of their own and some
/// lights fade: of each at least one, so that few pipelines draw them all.
fn random_glass_scene(seed: u64) -> Scene {
    let mut random = Random(seed ^ 0x61a55);
    let mut scene = random_scene(seed);
    scene.max_depth = 6;
    for (index, primitive) in scene.primitives.iter_mut().enumerate() {
        let material = &mut primitive.material;
        if index == 0 || random.chance(0.6) {
            material.transmission = random.uniform(0.01, 0.7);
            material.refractive_index = random.uniform(0.7, 2.0);
            // Now below 1 together with the mirrored ray, and now above.
            material.reflection = Some(random.uniform(0.0, 0.5));
        }
        if index == 0 || random.chance(0.5) {
            material.specular = material.specular.max(0.01);
            material.shininess = random.uniform(1.0, 200.0);
        }
    }
    for (index, light) in scene.lights.iter_mut().enumerate() {
        light.distance_constant = (index == 0 || random.chance(0.5)).then(|| random.magnitude(-1.0, 1.0));
    }
    scene.ambient_light = DVec3::new(0.5, 2.0, random.uniform(0.0, 2.0));
    scene
}

fn plan(scene: &Scene, precision: Precision, error: f64) -> Plan {
    let limits = Limits { float64: true, ..Limits::PROMISED };
    let settings = RenderSettings { precision: Some(precision), error, ..RenderSettings::default() };
    let plan = Plan::for_scene(scene, &settings, [SIZE[0], SIZE[1]], &limits).unwrap();
    assert!(plan.bounds.total() <= error);
    plan
}

fn draw_planned(tracers: &mut Tracers, scene: &Scene, plan: &Plan) -> Vec<DVec3> {
    tracers.draw_f64(scene, &Settings::planned(plan))
}

/// In proportion to the scene's light, for one lit by 1e38 has nothing to cut for 1/510.
fn relative_error(scene: &Scene, seed: u64) -> f64 {
    let lights: DVec3 = scene.lights.iter().map(|light| light.intensity).sum();
    Random(seed ^ 0xb0d6e7).magnitude(-5.0, 0.0) * (lights + scene.background).max_element()
}

/// What rounding makes of two sums of which one lacks some terms: each term and each sum is rounded, and of what is
/// summed nothing is negative.
fn rounding(scene: &Scene, precision: Precision, color: DVec3) -> f64 {
    let branches = scene.primitives.iter().any(|primitive| primitive.material.transmission > 0.0);
    let hits = if branches { 2f64.powi(scene.max_depth as i32) } else { f64::from(scene.max_depth) };
    // An exponent multiplies what rounding does to the cosine that it is of.
    let exponent = scene.primitives.iter().map(|primitive| primitive.material.shininess).fold(5.0, f64::max);
    let terms = hits * (scene.lights.len() as f64 + 3.0 + exponent);
    let stored = 2f64.powi(-47);
    (2.0 * terms * precision.unit_roundoff() + stored) * color.max_element()
}

/// At every pixel: cuts do not turn rays, so that edges are where they were.
fn no_pixel_changes_by_more_than_the_bound(scenes: u64, random_scene: fn(u64) -> Scene) {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let (mut changed_scenes, mut largest) = (0, 0.0_f64);
    for seed in 0..scenes {
        let scene = random_scene(seed);
        let precision = if seed % 3 == 0 { Precision::F64 } else { Precision::F32 };
        let exact = Settings { kernel: Kernel::Whitted(precision), ..Settings::new(SIZE[0], SIZE[1]) };
        let whole = tracers.draw_f64(&scene, &exact);
        let mut is_changed = false;
        for error in [1.0 / 510.0, 1.0 / 50.0, relative_error(&scene, seed)] {
            let plan = plan(&scene, precision, error);
            let bound = plan.bounds.total();
            let cut = draw_planned(&mut tracers, &scene, &plan);
            for (&whole, cut) in whole.iter().zip(cut) {
                let difference = (whole - cut).abs().max_element();
                let rounding = rounding(&scene, precision, whole);
                assert!(
                    difference <= bound + rounding,
                    "seed {seed}: {difference} above {bound}: {:?}",
                    plan.approximations
                );
                if bound > 0.0 && difference > rounding {
                    is_changed = true;
                    largest = largest.max((difference - rounding) / bound);
                }
            }
        }
        changed_scenes += u64::from(is_changed);
    }
    println!("{changed_scenes} of {scenes} scenes are changed; the largest change is {largest:.3} of its bound");
    assert!(changed_scenes > scenes / 3);
}

#[test]
fn what_the_kernel_leaves_out_changes_no_pixel_by_more_than_the_bound() {
    no_pixel_changes_by_more_than_the_bound(SCENES, random_scene);
}

#[test]
fn what_it_leaves_out_of_glass_changes_no_pixel_by_more_than_the_bound() {
    no_pixel_changes_by_more_than_the_bound(16, random_glass_scene);
}

#[test]
#[ignore = "takes a quarter of an hour"]
fn what_it_leaves_out_of_five_hundred_scenes_of_glass_changes_no_pixel_by_more_than_the_bound() {
    no_pixel_changes_by_more_than_the_bound(500, random_glass_scene);
}

/// Of scenes whose light is about 1, for which the kernel's own tolerances are set, and whose rays are not spent by
/// rounding.
#[test]
fn pictures_within_an_allowed_error_are_the_references_to_that_error() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let mut totals = [Difference::default(); 2];
    let mut bounded = 0;
    for seed in 0..SCENES {
        let mut scene = random_scene(seed);
        scene.max_depth = scene.max_depth.min(4);
        scene.lights.iter_mut().for_each(|light| light.intensity = light.intensity.min(DVec3::ONE));
        let truth = picture(&scene, SIZE[0], SIZE[1]);
        for (total, precision) in totals.iter_mut().zip([Precision::F32, Precision::F64]) {
            let error = if seed.is_multiple_of(2) { 1.0 / 510.0 } else { 1.0 / 50.0 };
            let plan = plan(&scene, precision, error);
            let ours = draw_planned(&mut tracers, &scene, &plan);
            let (tolerance, _) = tolerances(precision);
            let allowed = plan.bounds.total() + tolerance;
            let difference = Difference::between(&truth, &ours, allowed, |_| true);
            if difference.largest > allowed || difference.differing > 0 {
                println!("seed {seed}, {}, bound {}: {difference:?}", precision.name(), plan.bounds.total());
            }
            assert!(difference.largest <= allowed && difference.not_finite == 0, "seed {seed}: {difference:?}");
            bounded += u32::from(plan.bounds.total() > 0.0);
            *total = total.plus(difference);
        }
    }
    for (total, precision) in totals.into_iter().zip([Precision::F32, Precision::F64]) {
        println!("{SCENES} scenes, {}: {total:?}", precision.name());
        let (_, share) = tolerances(precision);
        assert!(total.differing as f64 <= share * total.discontinuities as f64);
        assert!(total.smooth > 10_000 && total.discontinuities > 10_000);
    }
    assert!(bounded > 100, "{bounded} pictures were cut");
}
