//! What a window is opened with, and what wakes it.

use std::path::PathBuf;

use super::action::Kernel;
use crate::gpu::Validation;
use crate::settings::{RenderSettings, Shading};

/// How to open the window.
#[derive(Debug, Clone)]
pub struct Options {
    /// Number or part of the name of a device.
    pub device: Option<String>,
    /// What comes of it is returned by [`run`](super::run).
    pub validation: Validation,
    /// Prints a line of JSON for every frame that differs from the last.
    pub is_observed: bool,
    /// Sources of the kernels, compiled anew when they change; in debug builds only.
    pub watched_sources: Option<PathBuf>,
    /// What draws at first instead of the usual kernel.
    pub kernel: Option<Kernel>,
    /// How to draw, before that, and what the panel offers besides the kernels.
    pub setting: Option<RenderSettings>,
    /// How much of the light model is drawn at first.
    pub shading: Shading,
    /// Acts as if the device was lost after so many frames.
    pub lose_device_after: Option<u64>,
    /// Where preferences and unsaved work are kept.
    pub config_folder: Option<PathBuf>,
}

/// What other threads wake the window for.
#[derive(Debug, Clone, Copy)]
pub(super) enum Wake {
    /// The accurate picture has come on, or a kernel was compiled.
    News,
    /// The program is to end.
    Stop,
}
