//! Table 1.1 of the course work, measured: every algorithm draws one light model on one device, and how long a frame
//! takes, how far it is from the truth and how much chance is in it are told side by side.
//!
//! The truth is path tracing by all the seeds together, each of which is also judged for itself: then by those of the
//! others alone. Frames of all algorithms take turns, so that whatever slows the machine down slows them all.

mod chart;
mod file;
mod measuring;
mod ranks;
mod sheet;
mod tables;

use serde::Serialize;

pub(crate) use chart::chart;
pub use measuring::{Step, measure, pictures_of_a_seed};
pub(crate) use ranks::ranks;
pub(crate) use sheet::contact_sheet;
pub(crate) use tables::{figures, verdicts};

use super::{Machine, median};
use crate::algorithm::Algorithm;
use crate::frame::Frame;

/// What is the same for all scenes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Conditions {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Numbers of samples at which path tracing is looked at, from few to many.
    pub samples: Vec<u32>,
    /// Pictures of each algorithm; of path tracing by seeds from 0 on.
    pub seeds: u32,
    /// Whether the validation layers watch, which takes its time.
    pub validation: bool,
}

/// An algorithm at a number of samples, measured on a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measured {
    /// Which draws.
    pub algorithm: Algorithm,
    /// Of each pixel.
    pub samples: u32,
    /// GPU time of each picture, nanoseconds; wall time where the device has no timestamps.
    pub times_ns: Vec<u64>,
    /// Root of the mean square of a channel's error, linear.
    pub rmse: f64,
    /// Mean FLIP error of what a screen shows, 0 to 1.
    pub flip: f64,
    /// Largest error of a channel.
    pub largest: f64,
    /// Standard deviation of a channel between the pictures, root of the mean square over the picture.
    pub noise: f64,
    /// One of its pictures.
    #[serde(skip)]
    pub picture: Frame,
}

impl Measured {
    /// With the samples of a pixel: "whitted", "path 16".
    pub fn name(&self) -> String {
        if self.algorithm.description().is_statistical || self.samples > 1 {
            format!("{} {}", self.algorithm.name(), self.samples)
        } else {
            self.algorithm.name().to_owned()
        }
    }

    /// Milliseconds a picture: the median.
    pub fn time_ms(&self) -> Option<f64> {
        median(&self.times_ns).map(|time| time as f64 / 1e6)
    }
}

/// All algorithms on one scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SceneComparison {
    /// Name or file.
    pub scene: String,
    /// Number of solids.
    pub solids: usize,
    /// Generations of a ray.
    pub max_depth: u32,
    /// Samples of each pixel that the truth is the mean of.
    pub truth_samples: u64,
    /// Of the truth: root of the mean square over pixels and channels, linear.
    pub truth_standard_error: f64,
    /// From the quickest to path tracing by most samples.
    pub measured: Vec<Measured>,
    /// The truth.
    #[serde(skip)]
    pub truth: Frame,
}

/// What was measured, whole or in part.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Where it was measured.
    pub machine: Machine,
    /// Same for all scenes.
    pub conditions: Conditions,
    /// In the order of measuring.
    pub scenes: Vec<SceneComparison>,
}
