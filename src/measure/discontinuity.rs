//! Pictures against the reference's, discontinuities apart: means hide missing objects, and one pixel on a silhouette
//! says nothing of the rest.

use glam::DVec3;

use crate::reference::{Image64, LIGHT_SPHERE};
use crate::tracer::Precision;

/// How far a picture is from the reference.
#[derive(Debug, Default, Clone, Copy)]
pub struct Difference {
    /// Largest difference of a linear channel off discontinuities.
    pub largest: f64,
    /// Pixels off discontinuities.
    pub smooth: usize,
    /// Pixels beside a pixel whose ray went another way, corners included.
    pub discontinuities: usize,
    /// Pixels off discontinuities that differ by more than the tolerance.
    pub differing_smooth: usize,
    /// Discontinuity pixels that differ by more than the tolerance.
    pub differing: usize,
    /// Pixels with NaN or infinity.
    pub not_finite: usize,
    /// Pixels that show a solid.
    pub solid: usize,
}

impl Difference {
    /// Over the pixels that `is_counted`, by their number; `tolerance`: linear. `ours` in the reference's order.
    pub fn between(truth: &Image64, ours: &[DVec3], tolerance: f64, is_counted: impl Fn(usize) -> bool) -> Self {
        let mut difference = Self::default();
        let discontinuities = discontinuities(truth);
        let pixels = truth.pixels.iter().zip(ours).enumerate();
        for (index, (pixel, &color)) in pixels.filter(|&(index, _)| is_counted(index)) {
            // A NaN would be passed over.
            let error = (pixel.color - color).abs().max_element();
            let error = if error.is_nan() { f64::INFINITY } else { error };
            difference.not_finite += usize::from(!color.is_finite());
            difference.solid += usize::from(pixel.first_hit < LIGHT_SPHERE);
            if discontinuities[index] {
                difference.discontinuities += 1;
                difference.differing += usize::from(error > tolerance);
            } else {
                difference.smooth += 1;
                difference.differing_smooth += usize::from(error > tolerance);
                difference.largest = difference.largest.max(error);
            }
        }
        difference
    }

    /// Both differences together.
    pub fn plus(self, other: Self) -> Self {
        Self {
            largest: self.largest.max(other.largest),
            smooth: self.smooth + other.smooth,
            discontinuities: self.discontinuities + other.discontinuities,
            differing: self.differing + other.differing,
            differing_smooth: self.differing_smooth + other.differing_smooth,
            not_finite: self.not_finite + other.not_finite,
            solid: self.solid + other.solid,
        }
    }

    /// Discontinuity pixels that differ, as a share of all; 0 where there are none.
    pub fn differing_share(&self) -> f64 {
        self.differing as f64 / self.discontinuities.max(1) as f64
    }
}

/// The release tolerances of docs/numerics.md: largest difference of a channel off discontinuities, and the share of
/// discontinuity
/// pixels that may differ by more than that.
pub fn tolerances(precision: Precision) -> (f64, f64) {
    let share = match precision {
        Precision::F32 => 1e-3,
        Precision::F64 => 1e-6,
    };
    (precision.rounding_tolerance(), share)
}

/// Where the reference's path differs from a neighbour's.
fn discontinuities(image: &Image64) -> Vec<bool> {
    let (width, height) = (image.width as usize, image.height as usize);
    let differs = |index: usize| {
        let (x, y) = (index % width, index / width);
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let mut around = rows.flat_map(|row| {
            let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
            columns.map(move |column| row * width + column)
        });
        around.any(|neighbour| image.pixels[neighbour].path != image.pixels[index].path)
    };
    (0..image.pixels.len()).map(differs).collect()
}
