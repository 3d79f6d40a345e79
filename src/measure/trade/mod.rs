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
mod sweep;
mod tables;
mod truth;

use serde::Serialize;

pub(crate) use chart::chart;
pub use choice::Question;
pub(crate) use choice::{Candidate, contenders, front};
pub(crate) use figures::{Answer, Figures, answers, figures};
pub use measuring::{Step, measure};
pub use sweep::{Axes, Planned, Sweep};
pub(crate) use tables::{asked, settings};
pub use truth::{Truth, TruthError, truth};

use super::{Budget, Clock, ImageError, Machine, median, quartiles};
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// Which picture is the true one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Target {
    /// Colours at the centres of the pixels.
    #[default]
    Point,
    /// Colours of the pixels' areas: the mean of 8x8 points on a grid in each.
    Area,
}

/// Which pixels' largest error is the error of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Counted {
    /// Discontinuities count, too.
    #[default]
    AllPixels,
    /// Without discontinuities: pixels beside one whose ray goes another way.
    OffDiscontinuities,
}

/// What is the same for all scenes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Conditions {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// What errors are measured against.
    pub target: Target,
    /// Which pixels decide.
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
    /// Largest error of a channel off discontinuities; `None` where it is not finite.
    pub max_abs_off_discontinuities: Option<f64>,
    /// Number of pixels beside one whose ray takes another path.
    pub discontinuity_pixels: usize,
    /// Those that are more than 1/510 off.
    pub differing_discontinuity_pixels: usize,
}

impl PictureError {
    /// The largest of the pixels that count; infinite where a channel is.
    pub fn largest(&self, counted: Counted) -> f64 {
        let largest = match counted {
            Counted::AllPixels => self.image.max_abs.filter(|_| self.image.non_finite_pixels == 0),
            Counted::OffDiscontinuities => self.max_abs_off_discontinuities,
        };
        largest.unwrap_or(f64::INFINITY)
    }

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
    /// Against the target.
    pub error: PictureError,
    /// Times of pairs of frames, in order: the baseline's and the setting's.
    pub baseline_samples_ns: Vec<u64>,
    /// GPU or wall time of the setting's frames, by the scene's clock.
    pub samples_ns: Vec<u64>,
}

impl Point {
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
            error: point.error.largest(counted),
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
