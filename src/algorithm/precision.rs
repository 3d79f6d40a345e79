//! What kernels calculate in.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// What a kernel calculates in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// What every device has
    #[default]
    F32,
    /// Only where the device has it
    F64,
}

impl Precision {
    /// Half the distance from 1 to the next number.
    pub fn unit_roundoff(self) -> f64 {
        match self {
            Self::F32 => f64::from(f32::EPSILON) / 2.0,
            Self::F64 => f64::EPSILON / 2.0,
        }
    }

    /// Smallest length of a solid, in scene space: the rounding errors of its squares are still normal numbers.
    pub(crate) fn smallest_length(self) -> f64 {
        match self {
            Self::F32 => 2f64.powi(-50),
            Self::F64 => 2f64.powi(-480),
        }
    }

    /// The word of the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }

    /// The release tolerance of docs/numerics.md: how far rounding may take a linear channel off discontinuities, in a
    /// picture whose light is about 1. It is tested over catalogues of scenes, not proven.
    pub fn rounding_tolerance(self) -> f64 {
        match self {
            Self::F32 => 1.0 / 510.0,
            Self::F64 => 1e-9,
        }
    }
}
