//! How long a kernel is measured, and by which clock.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::frame::Frame;
use crate::gpu::Device;
use crate::scene::Scene;
use crate::tracer::{Progressive, Settings, Tracer, TracerError};

/// When a kernel has been measured enough: after its time or after its frames, whichever is first, but never
/// after fewer frames than [`Budget::MIN_FRAMES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Budget {
    /// Wall time of the kernel's frames, milliseconds.
    pub time_ms: u64,
    /// Number of frames.
    pub frames: usize,
    /// Frames are not enough before so much time, milliseconds: a fast device raises its clock under load only.
    pub least_ms: u64,
}

impl Budget {
    /// One frame has no spread.
    pub const MIN_FRAMES: usize = 2;
    /// Figures in minutes on a slow device, in half a minute on a fast one.
    pub const QUICK: Self = Self { time_ms: 3000, frames: 5, least_ms: 250 };

    /// As long as asked; a device that is through with ten thousand frames before has shown what it can, and its file
    /// shall be of a size to be opened.
    pub fn lasting(time: Duration) -> Self {
        Self { time_ms: time.as_millis() as u64, frames: 10_000, least_ms: 0 }
    }

    /// How much of the measuring is done, 1 or more where all is.
    pub fn share_done(self, frames: usize, time: Duration) -> f64 {
        let of_frames = |all: usize| frames as f64 / all as f64;
        // Nothing of nothing is all of it.
        let of_time = |all_ms: u64| if all_ms == 0 { 1.0 } else { time.as_secs_f64() * 1e3 / all_ms as f64 };
        let by_frames = of_frames(self.frames).min(of_time(self.least_ms));
        by_frames.max(of_time(self.time_ms)).min(of_frames(Self::MIN_FRAMES))
    }
}

/// Which of its two times counts for a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Clock {
    /// Time of the tracing alone, by the device's timestamps.
    Gpu,
    /// Time from the call to the picture in the host's memory: submission, tracing and the copy.
    Wall,
}

/// What one frame took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameTime {
    /// Time of the tracing alone; `None` where the device has no timestamps.
    pub gpu_time_ns: Option<u64>,
    pub wall_time: Duration,
}

/// A kernel that draws a frame again and again.
pub struct TimedTracer {
    drawing: Drawing,
    pub frame: Frame,
}

enum Drawing {
    /// The same every time.
    Frame(Tracer),
    /// A picture of so many samples a pixel, every time by another seed.
    Paths { picture: Progressive, samples: u32, next_seed: u32 },
}

impl TimedTracer {
    /// # Errors
    /// As of [`Tracer::new`].
    pub fn new(device: &Arc<Device>, scene: &Scene, settings: &Settings) -> Result<Self, TracerError> {
        let tracer = Tracer::new(device, scene, settings)?;
        Ok(Self { frame: tracer.frame()?, drawing: Drawing::Frame(tracer) })
    }

    /// Pictures by path tracing, of so many samples a pixel each; the first by the settings' seed, then by those that
    /// follow.
    ///
    /// # Errors
    /// As of [`Tracer::new`].
    pub fn of_paths(
        device: &Arc<Device>,
        scene: &Scene,
        settings: &Settings,
        samples: u32,
    ) -> Result<Self, TracerError> {
        let picture = Progressive::new(device, scene, settings)?;
        Ok(Self { frame: picture.frame()?, drawing: Drawing::Paths { picture, samples, next_seed: settings.seed } })
    }

    /// Another scene, drawn at the same size; paths begin with the settings' seed again.
    ///
    /// # Errors
    /// As of [`Tracer::new`].
    pub fn set_scene(&mut self, scene: &Scene, settings: &Settings) -> Result<(), TracerError> {
        match &mut self.drawing {
            Drawing::Frame(tracer) => tracer.set_scene(scene, settings),
            Drawing::Paths { picture, next_seed, .. } => {
                *next_seed = settings.seed;
                picture.restart(scene, settings)
            }
        }
    }

    /// `keep_going` is asked after every tile and can stop the work there.
    pub fn draw(&mut self, keep_going: &mut dyn FnMut() -> ControlFlow<()>) -> Result<FrameTime, TracerError> {
        let start = Instant::now();
        let gpu_time_ns = match &mut self.drawing {
            Drawing::Frame(tracer) => tracer.render(&mut self.frame, &mut |_| keep_going())?,
            Drawing::Paths { picture, samples, next_seed } => {
                picture.restart_by_seed(*next_seed);
                *next_seed = next_seed.wrapping_add(1);
                let gpu_time_ns = picture.add(*samples, keep_going)?;
                picture.show_in(&mut self.frame);
                gpu_time_ns
            }
        };
        Ok(FrameTime { gpu_time_ns, wall_time: start.elapsed() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measuring_is_done_after_its_frames_or_its_time_but_not_before_two_frames() {
        let done = |budget: Budget, frames, ms| budget.share_done(frames, Duration::from_millis(ms)) >= 1.0;
        let quick = Budget::QUICK;
        assert!(!done(quick, 1, 60_000) && done(quick, 2, 60_000));
        assert!(!done(quick, 4, 2999) && done(quick, 4, 3000));
        assert!(!done(quick, 5, 249) && done(quick, 5, 250) && !done(quick, 100, 249));
        let full = Budget::lasting(Duration::from_secs(30));
        assert!(!done(full, 500, 29_999) && done(full, 500, 30_000) && done(full, 10_000, 1000));
    }
}
