//! How far a picture is from a reference: per-pixel errors and the difference an eye would see.

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8, flip};
use serde::Serialize;
use thiserror::Error;

use super::Mask;
use crate::frame::{Frame, display_value};

/// Which values of two frames are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorDomain {
    /// The pixels as they are: linear, not limited.
    Linear,
    /// What a screen shows: [`display_value`] / 255. Always finite, so a picture agrees with its own PNG.
    Display,
}

/// The difference between two frames over the counted pixels. Errors are in the values' own unit, 1 is full white.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ImageError {
    /// Root of the mean squared difference over pixels and channels; `None` if no pixel is finite in both frames.
    pub rmse: Option<f64>,
    /// Largest absolute difference of a channel; `None` if no pixel is finite in both frames.
    pub max_abs: Option<f64>,
    /// Peak signal-to-noise ratio for a peak of 1, in dB; `None` where it is infinite (no error) or undefined.
    pub psnr_db: Option<f64>,
    /// Mean FLIP error in [0, 1] of the display values at 67 pixels per degree: Andersson et al., "FLIP: A Difference
    /// Evaluator for Alternating Images", HPG 2020.
    pub flip_mean: f64,
    /// Pixels with an unequal channel; NaN equals NaN, 0 equals -0.
    pub differing_pixels: u64,
    /// Pixels with a channel that is not finite in one frame and something else in the other. They count as differing
    /// and are left out of `rmse`, `max_abs` and `psnr_db`, which one infinity would make meaningless.
    pub non_finite_pixels: u64,
    /// Counted pixels.
    pub pixels: u64,
}

/// Why two frames cannot be compared: always the input's fault.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ComparisonError {
    /// Two frames of different sizes.
    #[error("the images differ in size: {}x{} and {}x{}", a.0, a.1, b.0, b.1)]
    SizesDiffer {
        /// Width and height of the reference, pixels.
        a: (u32, u32),
        /// Width and height of the tested frame, pixels.
        b: (u32, u32),
    },
    /// A mask that is not of the frames' size.
    #[error("the mask is {}x{}, the images are {}x{}", mask.0, mask.1, image.0, image.1)]
    MaskSizeDiffers {
        /// Width and height of the mask, pixels.
        mask: (u32, u32),
        /// Width and height of the frames, pixels.
        image: (u32, u32),
    },
    /// A mask without a pixel to count.
    #[error("the mask selects no pixel (none is 128 or brighter)")]
    EmptyMask,
}

/// Compares `test` with `reference` in `domain`, over all pixels or those that `mask` selects.
pub fn image_error(
    reference: &Frame,
    test: &Frame,
    domain: ErrorDomain,
    mask: Option<&Mask>,
) -> Result<ImageError, ComparisonError> {
    check_sizes(reference, test, mask)?;
    let is_counted = |index: usize| mask.is_none_or(|mask| mask.counted()[index]);

    let mut sums = PixelSums::default();
    for (index, (&a, &b)) in reference.pixels().iter().zip(test.pixels()).enumerate() {
        if is_counted(index) {
            match domain {
                ErrorDomain::Linear => sums.add(a.map(f64::from), b.map(f64::from)),
                ErrorDomain::Display => sums.add(a.map(displayed), b.map(displayed)),
            }
        }
    }
    if sums.pixels == 0 {
        return Err(ComparisonError::EmptyMask);
    }
    let flip_mean = flip_sum(reference, test, is_counted) / sums.pixels as f64;
    Ok(sums.into_error(flip_mean))
}

/// [`ImageError::rmse`] of linear values over all pixels alone; infinite where a pixel is finite in one of the frames only.
///
/// # Errors
/// As of [`image_error`].
pub(crate) fn rmse(reference: &Frame, test: &Frame) -> Result<f64, ComparisonError> {
    check_sizes(reference, test, None)?;
    let mut sums = PixelSums::default();
    reference.pixels().iter().zip(test.pixels()).for_each(|(a, b)| sums.add(a.map(f64::from), b.map(f64::from)));
    Ok(sums.rmse().filter(|_| sums.non_finite_pixels == 0).unwrap_or(f64::INFINITY))
}

fn check_sizes(reference: &Frame, test: &Frame, mask: Option<&Mask>) -> Result<(), ComparisonError> {
    let size = (reference.width(), reference.height());
    let test_size = (test.width(), test.height());
    if size != test_size {
        return Err(ComparisonError::SizesDiffer { a: size, b: test_size });
    }
    match mask.map(|mask| (mask.width(), mask.height())) {
        Some(mask) if mask != size => Err(ComparisonError::MaskSizeDiffers { mask, image: size }),
        _ => Ok(()),
    }
}

fn displayed(linear: f32) -> f64 {
    f64::from(display_value(linear)) / 255.0
}

#[derive(Default)]
struct PixelSums {
    pixels: u64,
    differing_pixels: u64,
    non_finite_pixels: u64,
    squared: f64,
    max_abs: f64,
}

impl PixelSums {
    fn add(&mut self, a: [f64; 3], b: [f64; 3]) {
        self.pixels += 1;
        let unequal = |(a, b): &(f64, f64)| a != b && !(a.is_nan() && b.is_nan());
        let channels = || a.into_iter().zip(b).filter(unequal);
        if channels().next().is_none() {
            return;
        }
        self.differing_pixels += 1;
        if channels().any(|(a, b)| !a.is_finite() || !b.is_finite()) {
            self.non_finite_pixels += 1;
            return;
        }
        for (a, b) in channels() {
            self.squared += (a - b) * (a - b);
            self.max_abs = self.max_abs.max((a - b).abs());
        }
    }

    fn rmse(&self) -> Option<f64> {
        let finite_pixels = self.pixels - self.non_finite_pixels;
        (finite_pixels > 0).then(|| (self.squared / (3 * finite_pixels) as f64).sqrt())
    }

    fn into_error(self, flip_mean: f64) -> ImageError {
        let rmse = self.rmse();
        ImageError {
            rmse,
            max_abs: rmse.map(|_| self.max_abs),
            psnr_db: rmse.filter(|&rmse| rmse > 0.0).map(|rmse| -20.0 * rmse.log10()),
            flip_mean,
            differing_pixels: self.differing_pixels,
            non_finite_pixels: self.non_finite_pixels,
            pixels: self.pixels,
        }
    }
}

/// Rows of FLIP computed at once: it keeps many floats a pixel, for the largest frame more than most machines have.
const BAND_ROWS: usize = 256;
/// Rows around a band that its own pixels' errors depend on; FLIP's widest filter at 67 pixels per degree reaches 10.
const BAND_MARGIN_ROWS: usize = 16;

/// The sum of the FLIP errors of the pixels for which `is_counted` holds.
fn flip_sum(reference: &Frame, test: &Frame, is_counted: impl Fn(usize) -> bool) -> f64 {
    let width = reference.width() as usize;
    let height = reference.height() as usize;
    let mut sum = 0.0;
    for first_row in (0..height).step_by(BAND_ROWS) {
        let end_row = (first_row + BAND_ROWS).min(height);
        let top = first_row.saturating_sub(BAND_MARGIN_ROWS);
        let bottom = (end_row + BAND_MARGIN_ROWS).min(height);
        // The values go to the screen without gamma, so to an eye they are the sRGB that FLIP expects.
        let band = |frame: &Frame| {
            let pixels = &frame.pixels()[top * width..bottom * width];
            let bytes: Vec<u8> = pixels.iter().flatten().map(|&value| display_value(value)).collect();
            FlipImageRgb8::with_data(frame.width(), (bottom - top) as u32, &bytes)
        };
        let errors = flip(band(reference), band(test), DEFAULT_PIXELS_PER_DEGREE).to_vec();
        let indices = first_row * width..end_row * width;
        sum +=
            indices.filter(|&index| is_counted(index)).map(|index| f64::from(errors[index - top * width])).sum::<f64>();
    }
    sum
}
