//! Kernels compiled for a scene and never run.

use std::sync::Arc;

use super::renderer::{MadeFor, renderer};
use super::{Settings, TracerError};
use crate::gpu::{Builds, CompiledKernel, Device};
use crate::scene::Scene;

/// What the compiler of a device that was [opened for that](Device::open_to_compile) makes of all kernels that draw a
/// scene; nothing is submitted.
///
/// # Errors
/// A picture or a scene that the kernel cannot take, or a driver that cannot compile it.
pub fn compile(device: &Arc<Device>, scene: &Scene, settings: &Settings) -> Result<Vec<CompiledKernel>, TracerError> {
    let mut renderer = renderer(device, settings.kernel, &Builds::default(), MadeFor::Headless)?;
    renderer.prepare(scene, settings, true)?;
    renderer.compile_next()?;
    Ok(device.compiled())
}
