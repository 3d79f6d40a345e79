//! What `zerkalo render` does by screen-space reflections alone.

use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, ValueEnum};

use crate::algorithm::Algorithm;
use crate::frame::Frame;
use crate::tracer::TracerError;

/// What only screen-space reflections have.
#[derive(Debug, Clone, Args)]
pub struct SsrArgs {
    /// Of ssr: whether shadow rays are cast
    #[arg(long, value_enum, default_value_t)]
    pub ssr_shadows: SsrShadows,
    /// Of ssr: write another picture, of why reflections may be wrong; docs/screen-space.md has its colours
    #[arg(long, value_name = "OUT")]
    pub ssr_reasons: Option<PathBuf>,
}

/// Whether screen-space reflections cast shadow rays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum SsrShadows {
    /// To every light
    #[default]
    Rays,
    /// No surface hides a light
    None,
}

impl SsrArgs {
    /// # Errors
    /// They are for another algorithm.
    pub(super) fn check(&self, algorithm: Algorithm) -> Result<()> {
        let is_given = self.ssr_shadows != SsrShadows::default() || self.ssr_reasons.is_some();
        if is_given && algorithm != Algorithm::Ssr {
            let what =
                format!("--ssr-shadows and --ssr-reasons are for the ssr algorithm, not for {}", algorithm.name());
            return Err(TracerError::Refused(what).into());
        }
        self.ssr_reasons.iter().try_for_each(|path| Ok(Frame::check_output_path(path)?))
    }
}
