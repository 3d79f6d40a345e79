//! Image errors with known answers, and what cannot be compared.

use std::path::PathBuf;

use tempfile::TempDir;
use zerkalo::command::compare::{CompareArgs, CompareError, run};
use zerkalo::frame::{Frame, display_value};
use zerkalo::measure::{ComparisonError, ErrorDomain, ImageError, Mask, image_error};

fn constant(width: u32, height: u32, value: f32) -> Frame {
    let mut frame = Frame::new(width, height).unwrap();
    frame.pixels_mut().fill([value; 3]);
    frame
}

/// A pattern without symmetry in [0, 1], fine enough that FLIP sees edges everywhere.
fn pattern(width: u32, height: u32, seed: f32) -> Frame {
    let mut frame = Frame::new(width, height).unwrap();
    for (index, pixel) in frame.pixels_mut().iter_mut().enumerate() {
        *pixel = [0.37, 0.71, 0.13].map(|step| ((index as f32 * step + seed).sin() + 1.0) / 2.0);
    }
    frame
}

fn linear(a: &Frame, b: &Frame) -> ImageError {
    image_error(a, b, ErrorDomain::Linear, None).unwrap()
}

fn assert_close(actual: Option<f64>, expected: f64) {
    assert!((actual.unwrap() - expected).abs() < 1e-9, "{actual:?} is not {expected}");
}

#[test]
fn a_constant_difference_is_the_rmse() {
    let error = linear(&constant(4, 3, 0.25), &constant(4, 3, 0.75));
    assert_close(error.rmse, 0.5);
    assert_close(error.max_abs, 0.5);
    assert_close(error.psnr_db, 6.020599913279624);
    assert_eq!((error.differing_pixels, error.non_finite_pixels, error.pixels), (12, 0, 12));
    assert!(error.flip_mean > 0.1, "{}", error.flip_mean);
}

#[test]
fn one_channel_of_one_pixel_is_averaged_over_all() {
    let a = constant(5, 2, 1.0);
    let mut b = a.clone();
    b.pixels_mut()[7][1] = 4.0;
    let error = linear(&a, &b);
    assert_close(error.rmse, (9.0_f64 / 30.0).sqrt());
    assert_close(error.max_abs, 3.0);
    assert_eq!(error.differing_pixels, 1);
    // The screen shows no difference beyond white.
    assert_eq!(error.flip_mean, 0.0);
}

#[test]
fn a_frame_equals_itself_and_zero_equals_minus_zero() {
    let mut a = pattern(16, 16, 0.0);
    a.pixels_mut()[3] = [0.0, f32::NAN, f32::INFINITY];
    let mut b = a.clone();
    b.pixels_mut()[3][0] = -0.0;
    let error = linear(&a, &b);
    assert_eq!((error.rmse, error.max_abs, error.psnr_db), (Some(0.0), Some(0.0), None));
    assert_eq!((error.flip_mean, error.differing_pixels, error.non_finite_pixels), (0.0, 0, 0));
}

#[test]
fn values_that_are_not_finite_are_counted_apart() {
    let a = constant(2, 2, 0.5);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut b = constant(2, 2, 0.75);
        b.pixels_mut()[0][2] = bad;
        let error = linear(&a, &b);
        assert_close(error.rmse, 0.25);
        assert_eq!((error.differing_pixels, error.non_finite_pixels, error.pixels), (4, 1, 4));
    }
    let error = linear(&a, &constant(2, 2, f32::NAN));
    assert_eq!((error.rmse, error.max_abs, error.psnr_db), (None, None, None));
    assert_eq!(error.non_finite_pixels, 4);
}

#[test]
fn huge_differences_do_not_overflow() {
    let error = linear(&constant(2, 2, f32::MAX), &constant(2, 2, f32::MIN));
    assert_close(error.rmse.map(|rmse| rmse / f64::from(f32::MAX)), 2.0);
}

#[test]
fn display_values_are_those_of_a_png() {
    let a = constant(2, 2, 7.0);
    let b = constant(2, 2, 0.998_5);
    let error = image_error(&a, &b, ErrorDomain::Display, None).unwrap();
    assert_eq!((error.differing_pixels, error.rmse), (0, Some(0.0)));
    let c = constant(2, 2, 100.4 / 255.0);
    let error = image_error(&a, &c, ErrorDomain::Display, None).unwrap();
    assert_close(error.rmse, 155.0 / 255.0);
}

#[test]
fn only_masked_pixels_count() {
    let a = constant(3, 1, 0.0);
    let mut b = constant(3, 1, 0.0);
    b.pixels_mut()[0] = [1.0; 3];
    b.pixels_mut()[1] = [0.5; 3];
    let mut shade = constant(3, 1, 0.0);
    shade.pixels_mut()[0] = [127.0 / 255.0; 3];
    shade.pixels_mut()[1] = [128.0 / 255.0; 3];
    shade.pixels_mut()[2] = [0.0, 0.0, 1.0];
    let mask = Mask::from_frame(&shade);
    assert_eq!(mask.counted(), [false, true, true]);
    let error = image_error(&a, &b, ErrorDomain::Linear, Some(&mask)).unwrap();
    assert_close(error.rmse, (0.125_f64).sqrt());
    assert_eq!((error.differing_pixels, error.pixels), (1, 2));
}

#[test]
fn other_sizes_and_empty_masks_are_refused() {
    let a = constant(3, 2, 0.0);
    let compare = |b: &Frame, mask: Option<&Mask>| image_error(&a, b, ErrorDomain::Linear, mask).unwrap_err();
    let error = compare(&constant(2, 3, 0.0), None);
    assert_eq!(error, ComparisonError::SizesDiffer { a: (3, 2), b: (2, 3) });
    assert_eq!(error.to_string(), "the images differ in size: 3x2 and 2x3");
    let small = Mask::from_frame(&constant(1, 1, 1.0));
    assert_eq!(compare(&a, Some(&small)), ComparisonError::MaskSizeDiffers { mask: (1, 1), image: (3, 2) });
    let empty = Mask::from_frame(&constant(3, 2, 0.5));
    assert_eq!(compare(&a, Some(&empty)), ComparisonError::EmptyMask);
}

#[test]
fn flip_in_bands_is_flip_of_the_whole() {
    let (a, b) = (pattern(31, 600, 0.0), pattern(31, 600, 0.6));
    let image = |frame: &Frame| {
        let bytes: Vec<u8> = frame.pixels().iter().flatten().map(|&value| display_value(value)).collect();
        nv_flip::FlipImageRgb8::with_data(frame.width(), frame.height(), &bytes)
    };
    let whole = nv_flip::flip(image(&a), image(&b), nv_flip::DEFAULT_PIXELS_PER_DEGREE).to_vec();
    let mean = whole.iter().map(|&error| f64::from(error)).sum::<f64>() / whole.len() as f64;
    assert!(mean > 0.01, "{mean}");
    assert_close(Some(linear(&a, &b).flip_mean / mean), 1.0);
}

#[test]
fn json_has_the_promised_keys() {
    let error = linear(&constant(2, 2, 0.0), &constant(2, 2, 0.0));
    let json = serde_json::to_value(error).unwrap();
    let mut keys: Vec<_> = json.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    let promised = ["differing_pixels", "flip_mean", "max_abs", "non_finite_pixels", "pixels", "psnr_db", "rmse"];
    assert_eq!(keys, promised);
    assert!(json["psnr_db"].is_null());
}

#[test]
fn the_command_reports_bad_input_as_such() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name);
    constant(3, 2, 0.5).save(&path("a.exr")).unwrap();
    constant(3, 2, 0.5).save(&path("a.png")).unwrap();
    constant(2, 3, 0.5).save(&path("turned.png")).unwrap();
    constant(3, 2, 0.1).save(&path("dark.png")).unwrap();
    let args = |b: PathBuf, mask: Option<&str>| CompareArgs { a: path("a.exr"), b, mask: mask.map(path), json: true };

    run(&args(path("a.png"), Some("a.png"))).unwrap();
    for bad in [
        args(path("turned.png"), None),
        args(path("missing.png"), None),
        args(path("a.txt"), None),
        args(path("a.png"), Some("dark.png")),
        args(path("a.png"), Some("turned.png")),
    ] {
        let error: CompareError = run(&bad).unwrap_err();
        assert!(error.is_input_error(), "{error}");
        assert!(!error.to_string().contains('\n'), "{error}");
    }
}
