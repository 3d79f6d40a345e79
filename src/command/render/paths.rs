//! What `zerkalo render` does by path tracing alone: samples until there are enough.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use anyhow::Result;
use clap::Args;

use crate::algorithm::Algorithm;
use crate::command::drawing::DrawingArgs;
use crate::command::interrupt::Listener;
use crate::command::options::parse_positive;
use crate::command::progress_bar;
use crate::settings::sampling::MAX_PATH_SAMPLES;
use crate::tracer::{Progressive, TracerError};

/// Options of path tracing.
#[derive(Debug, Clone, Args)]
pub struct PathArgs {
    /// By path: until the estimated standard error of 99 % of the pixels is at most E
    #[arg(long, value_name = "E", value_parser = parse_positive, allow_hyphen_values = true)]
    pub until_error: Option<f64>,
    /// By path: until so many seconds have passed
    #[arg(long, value_name = "T", value_parser = parse_positive, allow_hyphen_values = true)]
    pub seconds: Option<f64>,
    /// By path: write the picture as far as it has come when Ctrl-C ends it
    #[arg(long)]
    pub keep_partial: bool,
}

impl PathArgs {
    /// # Errors
    /// An option that is not for the algorithm.
    pub(super) fn check(&self, algorithm: Algorithm, repeat: Option<u32>) -> Result<(), TracerError> {
        let is_statistical = algorithm.description().is_statistical;
        let given = [
            ("--until-error", self.until_error.is_some()),
            ("--seconds", self.seconds.is_some()),
            ("--keep-partial", self.keep_partial),
        ];
        if let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given && !is_statistical) {
            let others = Algorithm::names(|row| row.is_statistical);
            return Err(TracerError::Refused(format!("{option} is for the {others} algorithm")));
        }
        if repeat.is_some() && is_statistical {
            let what = "--repeat is not for path tracing, whose every run over the picture is timed";
            return Err(TracerError::Refused(what.to_owned()));
        }
        Ok(())
    }

    /// Samples of a pixel, at most, where none are asked for.
    pub(super) fn usual_samples(&self) -> u32 {
        let has_end = self.until_error.is_some() || self.seconds.is_some();
        if has_end { MAX_PATH_SAMPLES } else { DrawingArgs::USUAL_PATH_SAMPLES }
    }

    /// Takes samples of each pixel until there are enough, or Ctrl-C; returns the GPU time of each run, nanoseconds.
    ///
    /// # Errors
    /// A failing device; or stopped, and nothing is to be kept.
    pub(super) fn add_runs(&self, tracer: &mut Progressive, most: u32, listener: &Listener) -> Result<Vec<u64>> {
        let begun = Instant::now();
        let allowed = self.seconds.map(Duration::from_secs_f64);
        let is_late = || allowed.is_some_and(|allowed| begun.elapsed() >= allowed);
        let bar = progress_bar(self.units(most));
        let mut times_ns = Vec::new();
        while tracer.samples() < most {
            // What is to be kept is at least one run, however late.
            let is_owed = self.keep_partial && tracer.samples() == 0;
            let drawn = tracer.add_run(most - tracer.samples(), &mut |_| {
                let is_stopped = listener.stop_requested() && !is_owed;
                if is_stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            match drawn {
                Ok(time_ns) => times_ns.extend(time_ns),
                Err(TracerError::Stopped) if self.keep_partial => break,
                Err(error) => return Err(error.into()),
            }
            bar.set_position(match allowed {
                Some(_) => begun.elapsed().as_millis() as u64,
                None => tracer.samples().into(),
            });
            let is_good = |error: f64| tracer.error().is_some_and(|now| now.of_99_percent <= error);
            if is_late() || self.until_error.is_some_and(is_good) {
                break;
            }
        }
        bar.finish_and_clear();
        Ok(times_ns)
    }

    /// What progress counts: milliseconds where time is given, else samples.
    fn units(&self, most: u32) -> u64 {
        self.seconds.map_or(most.into(), |seconds| (seconds * 1e3) as u64)
    }
}
