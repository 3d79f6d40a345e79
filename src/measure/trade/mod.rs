//! The price of accuracy: what every setting of a sweep takes and how far its picture is from ground truth, on one
//! device
//! and one scene.
//!
//! Ground truth is the reference's, of one of two pictures ([`Target`]). Times are GPU times of pairs of frames, one by
//! the baseline and one by the setting, so that whatever slows the machine down slows both: settings are compared by
//! the ratio of a pair.

mod chart;
mod choice;
#[cfg(test)]
mod example;
mod figures;
mod file;
mod measuring;
mod radiance;
mod sweep;
mod tables;
mod truth;

use serde::Serialize;

pub(crate) use chart::chart;
pub use choice::Question;
pub(crate) use choice::{Candidate, contenders, front};
pub(crate) use figures::{Answer, Figures, answers, figures};
pub use measuring::{Step, measure};
pub use radiance::{Radiance, radiance};
pub use sweep::{Axes, Planned, Sweep};
pub(crate) use tables::{asked, settings, truth_told};
pub use truth::{TruePicture, Truth, TruthError, truth};

use super::{Budget, Clock, ImageError, Machine, median, prediction_limit, quartiles};
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// Which picture is the true one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(tag = "target", rename_all = "lowercase")]
pub enum Target {
    /// Colours at the centres of the pixels.
    #[default]
    Point,
    /// Colours of the pixels' areas: the mean of 8x8 points on a grid in each.
    Area,
    /// All light there is over the pixels' areas, by path tracing.
    Radiance {
        /// Of each pixel.
        truth_samples: u32,
    },
}

/// What the error of a picture is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Counted {
    /// The largest of a channel, discontinuities too.
    #[default]
    AllPixels,
    /// The largest of a channel without discontinuities: pixels beside one whose ray goes another way.
    OffDiscontinuities,
    /// Root of the mean square over all channels: the largest of a noisy picture says more of its size than of its noise.
    RootMeanSquare,
}

/// What is the same for all scenes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Conditions {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// What errors are measured against.
    #[serde(flatten)]
    pub target: Target,
    /// Which error decides.
    pub counted: Counted,
    /// Budget of a setting's pairs.
    pub budget: Budget,
    /// Whether the validation layers watch, which takes its time.
    pub validation: bool,
    /// Answered for every scene.
    pub questions: Vec<Question>,
}

/// How far a picture is from ground truth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PictureError {
    /// Error of linear values over all pixels, as `zerkalo compare` reports it.
    #[serde(flatten)]
    pub image: ImageError,
    /// `None` where the truth is path-traced: there many paths go through a pixel.
    #[serde(flatten)]
    pub edges: Option<EdgeError>,
}

/// Error on discontinuities and off them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EdgeError {
    /// Largest error of a channel off discontinuities; `None` where it is not finite.
    pub max_abs_off_discontinuities: Option<f64>,
    /// Number of pixels beside one whose ray takes another path.
    pub discontinuity_pixels: usize,
    /// Those that are more than 1/510 off.
    pub differing_discontinuity_pixels: usize,
}

impl EdgeError {
    /// Share of the discontinuity pixels that differ; 0 where there are none.
    pub fn differing_share(&self) -> f64 {
        self.differing_discontinuity_pixels as f64 / self.discontinuity_pixels.max(1) as f64
    }
}

/// A setting, measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Point {
    /// What was asked for.
    pub setting: RenderSettings,
    /// What it leaves out changes no linear channel by more: proven, rounding not in it. `None` where nothing is
    /// proven.
    pub bound: Option<f64>,
    /// Of its picture, of path tracing the first, against the target.
    pub error: PictureError,
    /// RMSE of each picture, where chance makes them differ and the RMSE counts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rmse_of_pictures: Vec<f64>,
    /// Times of pairs of frames, in order: the baseline's and the setting's.
    pub baseline_samples_ns: Vec<u64>,
    /// GPU or wall time of the setting's frames, by the scene's clock.
    pub samples_ns: Vec<u64>,
}

impl Point {
    /// The error that counts; infinite where a channel's is. Of pictures that chance makes, what 19 of 20 of them do not
    /// exceed, see [`prediction_limit`].
    pub fn counted_error(&self, counted: Counted) -> f64 {
        let image = &self.error.image;
        let of_picture = match counted {
            Counted::AllPixels => image.max_abs,
            Counted::OffDiscontinuities => return self.off_discontinuities().unwrap_or(f64::INFINITY),
            Counted::RootMeanSquare if self.rmse_of_pictures.is_empty() => image.rmse,
            Counted::RootMeanSquare => prediction_limit(&self.rmse_of_pictures),
        };
        of_picture.filter(|_| image.non_finite_pixels == 0).unwrap_or(f64::INFINITY)
    }

    fn off_discontinuities(&self) -> Option<f64> {
        self.error.edges?.max_abs_off_discontinuities
    }

    /// The quartiles and the median of the setting's time in parts of the baseline's, pair by pair.
    pub fn ratios(&self) -> Option<[f64; 3]> {
        let pairs = self.samples_ns.iter().zip(&self.baseline_samples_ns);
        quartiles(&pairs.map(|(&ours, &baseline)| ours as f64 / baseline.max(1) as f64).collect::<Vec<_>>())
    }
}

/// A setting that was not measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOut {
    /// What was asked for.
    pub setting: RenderSettings,
    /// Why not, in one line.
    pub reason: String,
}

/// The sweep on one scene, whole or in part.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SceneTrade {
    /// Name or file.
    pub scene: String,
    /// Number of solids.
    pub solids: usize,
    /// Generations of a ray by the scene.
    pub max_depth: u32,
    /// Clock of the samples.
    pub clock: Clock,
    /// Where the truth is path-traced: root of the mean square of its own standard errors.
    pub truth_standard_error: Option<f64>,
    /// In the order of measuring; the baseline, measured against itself, is the first.
    pub points: Vec<Point>,
    /// Settings that were not measured.
    pub left_out: Vec<LeftOut>,
    /// False after Ctrl-C.
    pub complete: bool,
}

impl SceneTrade {
    /// Nothing measured yet; `left_out` as the sweep has it.
    pub fn new(name: &str, scene: &Scene, sweep: &Sweep) -> Self {
        Self {
            scene: name.to_owned(),
            solids: scene.primitives.len(),
            max_depth: scene.max_depth,
            clock: Clock::Gpu,
            truth_standard_error: None,
            points: Vec::new(),
            left_out: sweep.left_out.clone(),
            complete: false,
        }
    }

    /// Median of all the baseline's frames; `None` where nothing is measured.
    pub fn baseline_ns(&self) -> Option<u64> {
        median(&self.points.iter().flat_map(|point| point.baseline_samples_ns.iter().copied()).collect::<Vec<_>>())
    }

    /// For choosing, in the points' order.
    pub fn candidates(&self, counted: Counted) -> Vec<Candidate> {
        let baseline_ns = self.baseline_ns().unwrap_or_default() as f64;
        let candidate = |point: &Point| Candidate {
            error: point.counted_error(counted),
            time_ns: point.ratios().map_or(f64::INFINITY, |[_, ratio, _]| ratio * baseline_ns),
            bound: point.bound,
        };
        self.points.iter().map(candidate).collect()
    }

    /// The point that a question is answered with, if any is.
    pub fn answer(&self, question: Question, counted: Counted) -> Option<usize> {
        question.answer(&self.candidates(counted))
    }
}

/// What was measured, whole or in part.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trade {
    /// Where it was measured.
    pub machine: Machine,
    /// Same for all scenes.
    pub conditions: Conditions,
    /// In the order of measuring.
    pub scenes: Vec<SceneTrade>,
}
