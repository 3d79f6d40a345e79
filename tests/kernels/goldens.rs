//! The course's pictures, pixel by pixel. tests/goldens/NAME holds the scene, the picture that a GL driver rendered
//! from the listings, and a mask of the pixels that a camera shift of 2e-5 leaves alone; only those are compared.

use std::fs;
use std::path::Path;

use crate::common::{TestDevice, render};
use zerkalo::frame::Frame;
use zerkalo::measure::Mask;
use zerkalo::scene::Scene;
use zerkalo::tracer::Settings;

/// The tolerance of the port: 99.9 % of the stable pixels are this near, relative to values above 1 ...
const NEAR: f32 = 1e-3;
const NEAR_SHARE: f64 = 0.999;
/// ... and none is farther than this.
const FAR: f32 = 2e-2;

/// The largest |ours − theirs| / max(1, |theirs|) over the channels.
fn error(ours: [f32; 3], theirs: [f32; 3]) -> f32 {
    let channel = |i: usize| (ours[i] - theirs[i]).abs() / theirs[i].abs().max(1.0);
    // A NaN on either side is as far as can be: `f32::max` would pass over it.
    (0..3).map(channel).map(|error| if error.is_nan() { f32::INFINITY } else { error }).fold(0.0, f32::max)
}

fn compare(device: &TestDevice, folder: &Path) -> Result<(), String> {
    let scene = Scene::load(&folder.join("scene.json")).unwrap();
    let golden = Frame::load(&folder.join("course.exr")).unwrap();
    let mask_path = folder.join("stable.png");
    let mask = mask_path.exists().then(|| Mask::load(&mask_path).unwrap());
    let ours = render(device, &scene, &Settings::new(golden.width(), golden.height()));

    let mut errors: Vec<f32> = (0..)
        .zip(ours.pixels().iter().zip(golden.pixels()))
        .filter(|&(index, _)| mask.as_ref().is_none_or(|mask| mask.counted()[index]))
        .map(|(_, (&ours, &theirs))| error(ours, theirs))
        .collect();
    errors.sort_by(f32::total_cmp);
    let near = errors.iter().filter(|&&error| error <= NEAR).count();
    let largest = *errors.last().expect("a mask leaves pixels to compare");
    let share = near as f64 / errors.len() as f64;
    println!("{}: {near} of {} pixels within {NEAR}, the farthest {largest:e}", folder.display(), errors.len());
    if share >= NEAR_SHARE && largest <= FAR {
        Ok(())
    } else {
        Err(format!("{}: only {share} within {NEAR}, the farthest {largest}", folder.display()))
    }
}

#[test]
fn every_golden_is_matched_pixel_by_pixel() {
    let device = TestDevice::open();
    let goldens = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/goldens");
    let mut folders: Vec<_> = fs::read_dir(goldens).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    assert!(folders.len() >= 16, "goldens are missing");
    let failures: Vec<_> = folders.iter().filter_map(|folder| compare(&device, folder).err()).collect();
    assert!(failures.is_empty(), "{failures:#?}");
}
