//! How pictures are drawn: the options of every command that writes some.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::options::{parse_depth, parse_error, parse_samples, parse_scale, parse_size};
use crate::algorithm::{Algorithm, Precision};
use crate::settings::{Contradiction, Numbers, RenderSettings, Shading};
use crate::tracer::TracerError;

/// Algorithm and accuracy.
#[derive(Debug, Clone, Args)]
pub struct DrawingArgs {
    /// Pixels, each side 1 to 16384 [default: what the scene's file says, else 1621x701]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Which algorithm draws
    #[arg(long, alias = "kernel", value_enum, default_value_t)]
    pub algorithm: Algorithm,
    /// What whitted calculates in [default: f32, where the picture is right in it]
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Generations of a ray, in place of the scene's
    #[arg(long, value_name = "N", value_parser = parse_depth())]
    pub max_depth: Option<u32>,
    /// Largest change of any linear channel by what whitted or plain leaves out, such as 0.002 or 1/510;
    /// 0 is exact
    #[arg(long, value_name = "E", default_value = "0", value_parser = parse_error, allow_hyphen_values = true)]
    pub error: f64,
    /// Anti-aliasing by whitted: a pixel is the mean of so many rays through fixed places in it, 1 to 64 [default: 1];
    /// by path: of so many random paths, at most, 1 to 2^30 [default: 64]
    #[arg(long, value_name = "N", value_parser = parse_samples())]
    pub samples: Option<u32>,
    /// Size of the picture that whitted traces against that of OUT, to which it is brought bilinearly: 1/4 to 1
    #[arg(long, value_name = "S", default_value = "1", value_parser = parse_scale)]
    pub scale: f64,
    /// By path: another picture of the same scene, by other random numbers
    #[arg(long, value_name = "S", default_value = "0")]
    pub seed: u32,
    /// By path: what random numbers; independent ones are for comparison
    #[arg(long, value_enum, default_value_t)]
    pub numbers: Numbers,
    /// How much of the light model is drawn, by whitted, plain or reference
    #[arg(long, value_enum, default_value_t)]
    pub shading: Shading,
    /// Draw as a file of `zerkalo trade --save-settings` says
    #[arg(long, value_name = "FILE", conflicts_with_all = ["algorithm", "precision", "max_depth", "error", "samples", "scale", "seed", "numbers", "shading"])]
    pub settings: Option<PathBuf>,
}

impl DrawingArgs {
    /// Of path tracing, where none are asked for.
    pub const USUAL_PATH_SAMPLES: u32 = 64;

    /// As asked, by the algorithm of the file where there is one.
    ///
    /// # Errors
    /// Options that make no sense together, or no such file.
    pub fn setting(&self, usual_path_samples: u32) -> Result<RenderSettings> {
        if let Some(path) = &self.settings {
            return Ok(RenderSettings::load(path)?);
        }
        let usual_samples = if self.algorithm.description().is_statistical { usual_path_samples } else { 1 };
        let setting = RenderSettings {
            algorithm: self.algorithm,
            precision: self.precision,
            error: self.error,
            max_depth: self.max_depth,
            samples: self.samples.unwrap_or(usual_samples),
            scale: self.scale,
            seed: self.seed,
            numbers: self.numbers,
            shading: self.shading,
            ..RenderSettings::default()
        };
        setting.check().map_err(|Contradiction { field, what }| {
            let option = field.replace('_', "-");
            TracerError::Refused(format!("--{option}: {what}"))
        })?;
        Ok(setting)
    }
}
