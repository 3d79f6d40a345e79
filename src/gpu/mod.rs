//! Vulkan, and nothing of rays: devices, memory, pipelines, commands, timers and validation messages.
//!
//! Every Vulkan object is made in one place, freed by its owner's `Drop`, and has a debug name.

mod arithmetic;
mod checks;
mod commands;
mod compiled;
mod device;
mod error;
mod float_controls;
mod hazards;
mod in_flight;
mod instance;
mod layer;
mod loader;
mod memory;
mod messages;
mod physical;
mod pipeline;
mod pipeline_cache;
mod recorder;
#[cfg(any(debug_assertions, test))]
mod shader_compiler;
pub mod shaders;
mod surface;
mod swapchain;
mod swapchain_choices;
mod timer;
mod tried;
mod widget_memory;

use std::sync::Arc;

pub use arithmetic::{Arithmetic, FloatWidth, arithmetic};
pub use checks::{Check, try_checks};
pub(crate) use commands::Semaphores;
pub use commands::{Commands, Idle};
pub use compiled::{CompiledKernel, Executable, Statistic, StatisticValue};
pub use device::Device;
use device::Purpose;
pub use error::GpuError;
pub use hazards::Use;
pub use in_flight::InFlight;
pub use instance::{Instance, validation_layer};
pub use layer::{Layer, SetUpBy, Validation};
use loader::with_device_list;
pub use memory::{Buffer, BufferKind, PIXEL_BYTES, StorageImage, Texel};
pub use messages::{Message, Messages, Remark, Severity};
pub use physical::{DeviceDescription, DeviceKind, choose};
pub use pipeline::{BindingKind, BindingSet, ComputePipeline, PipelineDescription, Resource};
pub(crate) use recorder::Dispatch;
pub use recorder::Recorder;
#[cfg(any(debug_assertions, test))]
pub(crate) use shader_compiler::{compile, kernel_name, variants};
pub use shaders::{Builds, Shader};
pub use surface::{Surface, SurfaceTarget};
pub(crate) use swapchain::Swapchain;
pub(crate) use swapchain_choices::Fit;
pub use timer::Timer;
pub use tried::{TriedDevice, tried_devices};
pub(crate) use widget_memory::WidgetMemory;

/// Every device of the machine, usable or not, in the loader's order.
pub fn devices() -> Result<Vec<DeviceDescription>, GpuError> {
    let instance = Instance::new(Validation::Off)?;
    Ok(physical::list(&instance, None)?.into_iter().map(|candidate| candidate.description).collect())
}

impl Device {
    /// Opens the device `wanted`, a number or part of a name, or the best one.
    ///
    /// # Errors
    /// No loader, driver, layer or suitable device; see [`choose`].
    pub fn open(wanted: Option<&str>, validation: Validation) -> Result<Arc<Self>, GpuError> {
        Self::open_on(&Instance::new(validation)?, wanted, Purpose::Draw)
    }

    /// As [`Device::open`], a device that can show pictures on the surface.
    pub fn open_for(surface: &Surface, wanted: Option<&str>) -> Result<Arc<Self>, GpuError> {
        Self::open_on(surface.instance(), wanted, Purpose::Show(surface))
    }

    /// As [`Device::open`], but to compile kernels only and be told of them, see [`Device::compiled`]: nothing may be
    /// submitted, for there may be no hardware. How kernels calculate is then taken for granted, not tried.
    pub fn open_to_compile(wanted: Option<&str>) -> Result<Arc<Self>, GpuError> {
        Self::open_on(&Instance::new(Validation::Off)?, wanted, Purpose::Compile)
    }

    fn open_on(instance: &Arc<Instance>, wanted: Option<&str>, purpose: Purpose<'_>) -> Result<Arc<Self>, GpuError> {
        let mut candidates = physical::list(instance, purpose.surface())?;
        let descriptions: Vec<_> = candidates.iter().map(|candidate| candidate.description.clone()).collect();
        let index = choose(&descriptions, wanted)?;
        Device::new(instance.clone(), candidates.swap_remove(index), purpose)
    }

    pub(crate) fn instance(&self) -> &Arc<Instance> {
        &self.instance
    }

    /// Every kernel compiled since the last call, of a device [opened for that](Device::open_to_compile); none of others.
    pub fn compiled(&self) -> Vec<CompiledKernel> {
        self.capture.as_ref().map_or_else(Vec::new, compiled::Capture::take)
    }

    /// As the device was listed before it was opened.
    pub fn description(&self) -> &DeviceDescription {
        &self.description
    }

    /// What the validation layer and the recorder's hazard check have said so far.
    pub fn messages(&self) -> &Messages {
        &self.instance.messages
    }
}
