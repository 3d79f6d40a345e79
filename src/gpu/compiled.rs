//! What a driver's compiler made of kernels: VK_KHR_pipeline_executable_properties. A device opened for that runs nothing,
//! so that it need not have hardware.

use std::ffi::CStr;
use std::sync::{Mutex, PoisonError};

use ash::{khr, vk};
use serde::Serialize;

use super::arithmetic::Arithmetic;
use super::loader::with_device_list;

/// What a kernel's arithmetic is taken for where it cannot be tried, as GPUs have it.
pub(super) const ASSUMED: Arithmetic = Arithmetic {
    exact_sums: true,
    fused_fma: true,
    keeps_nan: true,
    keeps_infinity: true,
    division_error_ulp: 0.5,
    square_root_error_ulp: 0.5,
    round_to_nearest_declared: false,
    nan_preserve_declared: false,
};

/// A kernel as a driver compiled it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CompiledKernel {
    /// Of the shader.
    pub kernel: &'static str,
    /// Empty where the driver tells nothing.
    pub executables: Vec<Executable>,
}

/// A program for the device's processors.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Executable {
    /// As the driver calls it.
    pub name: String,
    /// Invocations that go together; 0 where the driver does not say.
    pub subgroup_size: u32,
    /// In the driver's order.
    pub statistics: Vec<Statistic>,
}

/// A figure of the compiler's.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Statistic {
    /// As the driver calls it: "VGPRs".
    pub name: String,
    /// What it means, in the driver's words.
    pub description: String,
    /// In the unit that the driver's words say.
    pub value: StatisticValue,
}

/// In the driver's format.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
#[allow(missing_docs, reason = "the types say all")]
pub enum StatisticValue {
    Bool(bool),
    Integer(i64),
    Unsigned(u64),
    Float(f64),
}

impl std::fmt::Display for StatisticValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bool(value) => value.fmt(f),
            Self::Integer(value) => value.fmt(f),
            Self::Unsigned(value) => value.fmt(f),
            Self::Float(value) => value.fmt(f),
        }
    }
}

/// Collects what is told of a device's pipelines.
pub(super) struct Capture {
    /// `None`: the driver tells nothing.
    functions: Option<khr::pipeline_executable_properties::Device>,
    made: Mutex<Vec<CompiledKernel>>,
}

impl Capture {
    /// `tells`: the device was created with the extension and its feature.
    pub fn new(instance: &ash::Instance, device: &ash::Device, tells: bool) -> Self {
        let functions = || with_device_list(|| khr::pipeline_executable_properties::Device::new(instance, device));
        Self { functions: tells.then(functions), made: Mutex::default() }
    }

    /// What a pipeline must be created with to be told of.
    pub fn flags(&self) -> vk::PipelineCreateFlags {
        match self.functions {
            Some(_) => vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR,
            None => vk::PipelineCreateFlags::empty(),
        }
    }

    /// Adds a pipeline.
    ///
    /// # Safety
    /// It is alive, of this device and was created with [`Capture::flags`].
    pub unsafe fn add(&self, kernel: &'static str, pipeline: vk::Pipeline) -> Result<(), vk::Result> {
        let Some(functions) = &self.functions else {
            self.put(CompiledKernel { kernel, executables: Vec::new() });
            return Ok(());
        };
        let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
        // SAFETY: the caller's word; the feature is on.
        let properties = unsafe { functions.get_pipeline_executable_properties(&info) }?;
        let mut executables = Vec::new();
        for (index, properties) in (0..).zip(&properties) {
            let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline).executable_index(index);
            // SAFETY: as above; the pipeline was created to be told of and has an executable of that index.
            let statistics = unsafe { functions.get_pipeline_executable_statistics(&info) }?;
            executables.push(Executable {
                name: text(properties.name_as_c_str()),
                subgroup_size: properties.subgroup_size,
                statistics: statistics.iter().map(statistic).collect(),
            });
        }
        self.put(CompiledKernel { kernel, executables });
        Ok(())
    }

    fn put(&self, kernel: CompiledKernel) {
        self.made.lock().unwrap_or_else(PoisonError::into_inner).push(kernel);
    }

    /// What was added since the last call.
    pub fn take(&self) -> Vec<CompiledKernel> {
        std::mem::take(&mut *self.made.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

fn statistic(told: &vk::PipelineExecutableStatisticKHR<'_>) -> Statistic {
    use vk::PipelineExecutableStatisticFormatKHR as Format;
    // SAFETY: the driver filled the member that the format names; all of them are plain bits.
    let value = unsafe {
        match told.format {
            Format::BOOL32 => StatisticValue::Bool(told.value.b32 != vk::FALSE),
            Format::INT64 => StatisticValue::Integer(told.value.i64),
            Format::FLOAT64 => StatisticValue::Float(told.value.f64),
            _ => StatisticValue::Unsigned(told.value.u64),
        }
    };
    Statistic { name: text(told.name_as_c_str()), description: text(told.description_as_c_str()), value }
}

fn text<E>(name: Result<&CStr, E>) -> String {
    name.map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}
