//! Where a picture errs, in shades.

use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use plotters::style::{RED, RGBColor};

use crate::frame::{Frame, FrameError};

/// Errors between these, on a logarithmic scale, are told apart by their shade.
pub const SMALLEST_ERROR: f64 = 1e-9;
pub const LARGEST_ERROR: f64 = 1.0;

/// Colour of an error of a linear channel: from dark to light, evenly, so that it reads in grey too; infinities and
/// NaNs are red.
pub fn error_color(error: f64) -> RGBColor {
    if !error.is_finite() {
        return RED;
    }
    let share = (error / SMALLEST_ERROR).log10() / (LARGEST_ERROR / SMALLEST_ERROR).log10();
    ViridisRGB.get_color(share.clamp(0.0, 1.0))
}

/// A pixel's colour is that of the largest error of its channels. Equal channels, infinite ones too, have none.
///
/// # Errors
/// There is no memory for it.
///
/// # Panics
/// The frames differ in size.
pub fn error_map(reference: &Frame, picture: &Frame) -> Result<Frame, FrameError> {
    assert_eq!((reference.width(), reference.height()), (picture.width(), picture.height()), "the frames' sizes");
    let mut map = Frame::new(picture.width(), picture.height())?;
    let pairs = reference.pixels().iter().zip(picture.pixels());
    for (pixel, (truth, ours)) in map.pixels_mut().iter_mut().zip(pairs) {
        *pixel = shade(largest_difference(truth, ours));
    }
    Ok(map)
}

/// Shades of errors from `SMALLEST_ERROR` at the left to `LARGEST_ERROR` at the right, on a logarithmic scale.
///
/// # Errors
/// The size is impossible.
pub fn error_scale(width: u32, height: u32) -> Result<Frame, FrameError> {
    let mut scale = Frame::new(width, height)?;
    let decades = (LARGEST_ERROR / SMALLEST_ERROR).log10();
    for (index, pixel) in scale.pixels_mut().iter_mut().enumerate() {
        let share = (index as u32 % width) as f64 / f64::from(width);
        *pixel = shade(SMALLEST_ERROR * 10f64.powf(decades * share));
    }
    Ok(scale)
}

/// Infinite where a channel is no number.
fn largest_difference(a: &[f32; 3], b: &[f32; 3]) -> f64 {
    let differences = a.iter().zip(b).map(|(&a, &b)| {
        let difference = (f64::from(a) - f64::from(b)).abs();
        match difference {
            _ if a == b => 0.0,
            _ if difference.is_nan() => f64::INFINITY,
            _ => difference,
        }
    });
    differences.fold(0.0, f64::max)
}

/// As a frame has it.
fn shade(error: f64) -> [f32; 3] {
    let RGBColor(red, green, blue) = error_color(error);
    [red, green, blue].map(|value| f32::from(value) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luma(error: f64) -> f32 {
        let [red, green, blue] = shade(error);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    #[test]
    fn the_larger_the_error_the_lighter_its_shade() {
        let errors: Vec<f64> = (0..=9).map(|decade| 1e-9 * 10f64.powi(decade)).collect();
        assert!(errors.is_sorted_by(|&a, &b| luma(a) < luma(b)));
        assert_eq!(shade(0.0), shade(SMALLEST_ERROR));
        assert_eq!(shade(7.0), shade(LARGEST_ERROR));
        assert_eq!([shade(f64::NAN), shade(f64::INFINITY)], [[1.0, 0.0, 0.0]; 2]);
    }

    #[test]
    fn a_pixel_is_judged_by_its_worst_channel() {
        let mut truth = Frame::new(4, 1).unwrap();
        truth.pixels_mut().copy_from_slice(&[[0.5; 3], [0.5; 3], [f32::INFINITY; 3], [0.5; 3]]);
        let mut ours = truth.clone();
        ours.pixels_mut()[1] = [0.5, 0.5 + 1.0 / 64.0, 0.5 - 1.0 / 128.0];
        ours.pixels_mut()[3][2] = f32::NAN;
        let map = error_map(&truth, &ours).unwrap();
        assert_eq!(map.pixels(), [0.0, 1.0 / 64.0, 0.0, f64::INFINITY].map(shade));
    }

    #[test]
    fn the_scale_goes_from_dark_to_light() {
        let scale = error_scale(90, 2).unwrap();
        assert_eq!(scale.pixels()[0], shade(SMALLEST_ERROR));
        assert_eq!(scale.pixels()[90 + 40], shade(SMALLEST_ERROR * 10f64.powf(9.0 * 40.0 / 90.0)));
    }
}
