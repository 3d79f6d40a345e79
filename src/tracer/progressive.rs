//! A picture by path tracing, which every run over all its pixels makes better.
//!
//! The sums are kept in `f64` on the host, so that none of up to 2³⁰ samples is lost in rounding, and so that a picture
//! of any size comes into being as a whole. A run brings the mean of some samples of each pixel in `f32`, rounded by at
//! most some units of 2⁻²⁴ of it.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use super::{Run, Settings, Tracer, TracerError};
use crate::frame::Frame;
use crate::gpu::Device;
use crate::plan::SAMPLES_AT_ONCE;
use crate::scene::Scene;

/// Fewest runs before an estimate of the error is worth something: of k runs it is off by a part of about
/// √(1/(2·(k − 1))).
const FEWEST_RUNS: u32 = 8;

/// A picture by path tracing, as good as it is so far.
pub struct Progressive {
    tracer: Tracer,
    run: Frame,
    estimates: Vec<Estimate>,
    samples: u32,
    runs: u32,
    // Fewer where they take too many iterations.
    samples_at_once: u32,
    seed: u32,
}

/// What is known of a pixel.
#[derive(Debug, Clone, Copy, Default)]
struct Estimate {
    /// Linear RGB.
    mean: DVec3,
    /// Σ n·(x − mean)² of the runs' means x, each of n samples: of k runs, k − 1 times a sample's variance, where
    /// samples know nothing of each other.
    squares: DVec3,
}

/// Standard errors of a picture's pixels, each that of its worst channel, linear: estimates from the differences
/// between runs. What samples of one run spare each other is in them, what those of different runs do is not, so that
/// they are rather too large.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorEstimate {
    /// Root of the mean square of all pixels.
    pub rms: f64,
    /// That 99 % of the pixels are not above.
    pub of_99_percent: f64,
    /// Of the worst pixel.
    pub largest: f64,
}

impl Estimate {
    /// Takes in the mean of `n` samples after `before`.
    fn add(&mut self, mean: DVec3, n: f64, before: f64) {
        let difference = mean - self.mean;
        self.mean += difference * (n / (before + n));
        self.squares += n * difference * (mean - self.mean);
    }

    /// Of the mean of so many samples in so many runs, of the worst channel.
    fn standard_error(&self, samples: u32, runs: u32) -> f64 {
        (self.squares.max_element() / (f64::from(runs - 1) * f64::from(samples))).sqrt()
    }
}

impl Progressive {
    /// By the kernel of the settings, which is one of path tracing.
    ///
    /// # Errors
    /// As of [`Tracer::new`].
    pub fn new(device: &Arc<Device>, scene: &Scene, settings: &Settings) -> Result<Self, TracerError> {
        let tracer = Tracer::new(device, scene, settings)?;
        let run = tracer.frame()?;
        let estimates = vec![Estimate::default(); run.pixels().len()];
        Ok(Self { tracer, run, estimates, samples: 0, runs: 0, samples_at_once: SAMPLES_AT_ONCE, seed: settings.seed })
    }

    /// Begins anew with another scene, or by other settings of the same size; the pipeline is kept where it fits.
    ///
    /// # Errors
    /// As of [`Tracer::new`].
    pub fn restart(&mut self, scene: &Scene, settings: &Settings) -> Result<(), TracerError> {
        self.tracer.set_scene(scene, settings)?;
        self.restart_by_seed(settings.seed);
        Ok(())
    }

    /// Begins anew with other random numbers; nothing is brought to the device.
    pub fn restart_by_seed(&mut self, seed: u32) {
        self.estimates.fill(Estimate::default());
        (self.samples, self.runs, self.seed) = (0, 0, seed);
    }

    /// Samples of each pixel so far.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Takes at most so many samples more of each pixel, in one run; returns the GPU time as [`Tracer::render`] does.
    ///
    /// # Errors
    /// A failing device, or `progress` stopped it; then the picture is what it was.
    pub fn add_run(
        &mut self,
        most: u32,
        progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Option<u64>, TracerError> {
        loop {
            let samples = self.samples_at_once.min(most);
            self.tracer.set_run(Run { first_sample: self.samples, samples, seed: self.seed });
            match self.tracer.render(&mut self.run, progress) {
                // How many iterations paths take is not known before.
                Err(TracerError::LoopLimitReached { .. }) if samples > 1 => self.samples_at_once = samples / 2,
                Err(error) => return Err(error),
                Ok(gpu_time_ns) => {
                    self.take_in(samples);
                    return Ok(gpu_time_ns);
                }
            }
        }
    }

    /// Takes so many samples more of each pixel, in as many runs as it takes; returns the GPU time of all.
    ///
    /// # Errors
    /// As of [`Progressive::add_run`], but the runs before a failure or a stop are kept.
    pub(crate) fn add(
        &mut self,
        samples: u32,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<u64>, TracerError> {
        let all = self.samples + samples;
        let mut gpu_time_ns = Some(0);
        while self.samples < all {
            let of_run = self.add_run(all - self.samples, &mut |_| keep_going())?;
            gpu_time_ns = gpu_time_ns.zip(of_run).map(|(sum, of_run)| sum + of_run);
        }
        Ok(gpu_time_ns)
    }

    fn take_in(&mut self, samples: u32) {
        let (n, before) = (f64::from(samples), f64::from(self.samples));
        self.estimates.par_iter_mut().zip(self.run.pixels()).for_each(|(estimate, pixel)| {
            estimate.add(DVec3::from_array(pixel.map(f64::from)), n, before);
        });
        (self.samples, self.runs) = (self.samples + samples, self.runs + 1);
    }

    /// Linear RGB of each pixel so far, row by row from the top.
    pub fn means(&self) -> impl Iterator<Item = DVec3> {
        self.estimates.iter().map(|estimate| estimate.mean)
    }

    /// Estimated standard error of each pixel's worst channel, row by row from the top; `None` before two runs.
    pub fn standard_errors(&self) -> Option<Vec<f64>> {
        let (samples, runs) = (self.samples, self.runs);
        (runs >= 2).then(|| self.estimates.par_iter().map(|one| one.standard_error(samples, runs)).collect())
    }

    /// `None` where there were too few runs for one that is worth something.
    pub fn error(&self) -> Option<ErrorEstimate> {
        let mut errors = self.standard_errors().filter(|_| self.runs >= FEWEST_RUNS)?;
        errors.par_sort_unstable_by(f64::total_cmp);
        let mean_square = errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64;
        let of_99_percent = errors[(errors.len() * 99).div_ceil(100) - 1];
        Some(ErrorEstimate { rms: mean_square.sqrt(), of_99_percent, largest: errors.last().copied()? })
    }

    /// The picture so far.
    ///
    /// # Errors
    /// No memory for it.
    pub fn frame(&self) -> Result<Frame, TracerError> {
        let mut frame = self.tracer.frame()?;
        self.show_in(&mut frame);
        Ok(frame)
    }

    /// Puts the picture so far into a frame of its size.
    pub(crate) fn show_in(&self, frame: &mut Frame) {
        let narrow = |mean: DVec3| mean.to_array().map(|channel| channel as f32);
        frame.pixels_mut().iter_mut().zip(self.means()).for_each(|(pixel, mean)| *pixel = narrow(mean));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_errors_are_those_of_all_samples_however_they_come() {
        // Runs of 1, 2, 3, … samples, each with the mean that they have.
        let sample = |index: u32| DVec3::splat(f64::from(index * 7919 % 1009) / 1009.0);
        let (mut estimate, mut before) = (Estimate::default(), 0);
        for n in 1..=140 {
            let mean = (before..before + n).map(sample).sum::<DVec3>() / f64::from(n);
            estimate.add(mean, n.into(), before.into());
            before += n;
        }
        let mean = (0..before).map(sample).sum::<DVec3>() / f64::from(before);
        assert!((estimate.mean - mean).abs().max_element() < 1e-14);
    }

    #[test]
    fn the_estimated_error_is_that_of_independent_samples() {
        // Uniform in [0, 1): a variance of 1/12. Of 4000 runs the estimate is off by a part of √(1/8000) ≈ 1.1 %.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut estimate = Estimate::default();
        for run in 0..4000 {
            let mean = (0..4).map(|_| uniform()).sum::<f64>() / 4.0;
            estimate.add(DVec3::splat(mean), 4.0, 4.0 * f64::from(run));
        }
        let expected = (1.0 / 12.0 / 16_000.0_f64).sqrt();
        assert!((estimate.standard_error(16_000, 4000) / expected - 1.0).abs() < 0.05);
    }
}
