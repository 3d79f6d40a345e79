use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// The random numbers that path tracing decides by (`glsl/path/numbers.glsl`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Numbers {
    /// Sobol's sequence, scrambled anew for each pixel and decision: spread evenly, so that the noise falls faster.
    #[default]
    Sobol,
    /// Numbers that know nothing of each other, for comparison.
    Independent,
}
