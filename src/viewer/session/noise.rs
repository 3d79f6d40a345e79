//! How far a picture by path tracing may still be from the one that it tends to.

use rayon::prelude::*;

use crate::frame::Frame;

/// Samples of the first picture kept: fewer say little, and come too fast to be read.
const FEWEST: u32 = 8;

/// An estimate from the halves of all samples: with m₁ the mean of a pixel's first n and m₂ that of all 2n, the later n
/// have the mean 2·m₂ − m₁. Where the halves know nothing of each other, (m₂ − m₁)² is on average the variance of m₂;
/// with Sobol's numbers, whose later samples fill the gaps of the first, it is rather too large.
#[derive(Default)]
pub(super) struct Noise {
    /// The picture at a number of samples that is a power of two, and that number.
    kept: Option<(u32, Frame)>,
    /// At that number, where half as many were seen.
    error: Option<f64>,
}

impl Noise {
    /// Takes note that the picture has so many samples of each pixel; whether it is to be [kept](Noise::keep).
    pub fn see(&mut self, samples: u32) -> bool {
        if self.kept.as_ref().is_some_and(|(kept, _)| samples < *kept) {
            // Another picture.
            *self = Self::default();
        }
        let is_kept = self.kept.as_ref().is_some_and(|(kept, _)| *kept == samples);
        samples >= FEWEST && samples.is_power_of_two() && !is_kept
    }

    pub fn keep(&mut self, samples: u32, picture: Frame) {
        let half = self.kept.as_ref().filter(|(kept, half)| 2 * kept == samples && is_of_size(half, &picture));
        self.error = half.map(|(_, half)| rms_difference(half, &picture));
        self.kept = Some((samples, picture));
    }

    /// Root of the mean square of all pixels' standard errors, linear, over all channels, of a picture that has come to
    /// so many samples.
    pub fn error(&self, samples: u32) -> Option<f64> {
        self.error.filter(|_| self.kept.as_ref().is_some_and(|(kept, _)| *kept <= samples))
    }
}

fn is_of_size(one: &Frame, other: &Frame) -> bool {
    (one.width(), one.height()) == (other.width(), other.height())
}

fn rms_difference(one: &Frame, other: &Frame) -> f64 {
    let squares = one.pixels().par_iter().zip(other.pixels()).map(|(one, other)| {
        let difference = |channel: usize| f64::from(other[channel]) - f64::from(one[channel]);
        (0..3).map(|channel| difference(channel).powi(2)).sum::<f64>()
    });
    (squares.sum::<f64>() / (3 * one.pixels().len()) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means of so many numbers, even in [0, 1), in each channel of 64×64 pixels.
    fn picture(samples: u32) -> Frame {
        let mut frame = Frame::new(64, 64).unwrap();
        for (index, pixel) in frame.pixels_mut().iter_mut().enumerate() {
            let mut state = index as u64 + 1;
            let mut uniform = || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 40) as f32 / (1_u64 << 24) as f32
            };
            let mut sum = [0.0; 3];
            (0..samples).for_each(|_| sum.iter_mut().for_each(|channel| *channel += uniform()));
            *pixel = sum.map(|channel| channel / samples as f32);
        }
        frame
    }

    #[test]
    fn the_error_of_independent_numbers_is_the_one_there_is() {
        let mut noise = Noise::default();
        for samples in 1..=64 {
            if noise.see(samples) {
                noise.keep(samples, picture(samples));
            }
            assert_eq!(noise.error(samples).is_some(), samples >= 2 * FEWEST, "{samples}");
        }
        // A variance of 1/12; of 12288 squares the root is off by a part of √(1/(2·12288)) = 0.6 %, times 4.
        let expected = (1.0 / 12.0 / 64.0_f64).sqrt();
        assert!((noise.error(64).unwrap() / expected - 1.0).abs() < 0.026);
    }

    #[test]
    fn a_picture_that_begins_anew_is_estimated_anew() {
        let mut noise = Noise::default();
        for samples in [8, 16] {
            assert!(noise.see(samples));
            noise.keep(samples, picture(1));
        }
        assert!(!noise.see(16) && !noise.see(17) && noise.error(17).is_some());
        assert!(noise.error(1).is_none(), "what is not yet seen of the next is not told of the last");
        assert!(!noise.see(1) && noise.error(16).is_none());
    }
}
