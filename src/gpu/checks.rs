//! Which checks of validation are on: silence means something only where a mistake made on purpose is reported.

use std::sync::Arc;

use ash::vk;
use serde::Serialize;

use super::commands::Commands;
use super::device::Device;
use super::error::GpuError;
use super::layer::Validation;
use super::memory::{Buffer, BufferKind, PIXEL_BYTES, StorageImage};
use super::messages::Message;
use super::pipeline::{BindingKind, BindingSet, ComputePipeline, PipelineDescription, Resource};
use super::{Use, shaders};

/// What is watched for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Check {
    /// Calls against the specification.
    Core,
    /// Commands that need a barrier between them, as far as the layer knows what they touch: copies, not dispatches.
    Synchronization,
    /// A missing barrier between any two uses of a resource, by the book that the [`Recorder`](super::Recorder) keeps.
    Hazards,
    /// Accesses of kernels beyond what is bound.
    GpuAssisted,
    /// What is allowed and unwise.
    BestPractices,
}

impl Check {
    /// As messages and reports have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Core => "core",
            Self::Synchronization => "synchronization",
            Self::Hazards => "hazards",
            Self::GpuAssisted => "GPU-assisted",
            Self::BestPractices => "best practices",
        }
    }

    /// Those that a kind of validation asks for.
    pub fn of(validation: Validation) -> &'static [Self] {
        match validation {
            Validation::Off => &[Self::Hazards],
            Validation::Core => &[Self::Core, Self::Synchronization, Self::Hazards],
            Validation::GpuAssisted => &[Self::GpuAssisted, Self::Hazards],
            Validation::BestPractices => &[Self::BestPractices, Self::Hazards],
            Validation::All => {
                &[Self::Core, Self::Synchronization, Self::GpuAssisted, Self::BestPractices, Self::Hazards]
            }
        }
    }

    /// Makes the mistake that the check is there for. None of them harms a device.
    fn provoke(self, device: &Arc<Device>) -> Result<(), GpuError> {
        match self {
            Self::Core => wait_for_what_the_stage_never_does(device),
            Self::Synchronization | Self::Hazards => copy_twice_to_one_buffer(device),
            Self::GpuAssisted => write_past_the_end(device),
            Self::BestPractices => ask_for_resets_one_by_one(device),
        }
    }

    /// Whether a message reports that mistake.
    fn is_told_by(self, message: &Message) -> bool {
        let Message { severity: _, id, text } = message;
        match self {
            Self::Core => id.contains("VUID-vkCmdPipelineBarrier"),
            Self::Synchronization => id.contains("SYNC-HAZARD"),
            Self::Hazards => id == "zerkalo-hazard",
            Self::GpuAssisted => text.contains("out of bounds"),
            Self::BestPractices => id.contains("BestPractices"),
        }
    }
}

/// Tests every check of a kind of validation on a device of its own; whether each was on.
///
/// # Errors
/// As of [`Device::open`], or the device fails.
pub fn try_checks(wanted: Option<&str>, validation: Validation) -> Result<Vec<(Check, bool)>, GpuError> {
    let device = Device::open(wanted, validation)?;
    let messages = device.messages().clone();
    Check::of(validation).iter().try_for_each(|check| check.provoke(&device))?;
    // What is said of its destruction belongs to it too.
    drop(device);
    let said = messages.to_vec();
    let is_told = |check: Check| said.iter().any(|message| check.is_told_by(message));
    Ok(Check::of(validation).iter().map(|&check| (check, is_told(check))).collect())
}

/// A barrier after what the host writes in the stage that copies, where the host writes nothing.
fn wait_for_what_the_stage_never_does(device: &Arc<Device>) -> Result<(), GpuError> {
    Commands::new(device, "mistake: barrier")?.run(|recorder| {
        let stage = vk::PipelineStageFlags::TRANSFER;
        let barrier = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::HOST_WRITE)
            .dst_access_mask(vk::AccessFlags::TRANSFER_READ);
        let none = vk::DependencyFlags::empty();
        // SAFETY: the command buffer is being recorded. Against the specification, as it is meant to be: a driver turns
        // the flags into waits and flushes, and these ask for one of no use.
        unsafe { device.raw.cmd_pipeline_barrier(recorder.buffer, stage, stage, none, &[barrier], &[], &[]) };
        Ok(())
    })
}

fn copy_twice_to_one_buffer(device: &Arc<Device>) -> Result<(), GpuError> {
    const SIDE: u32 = 8;
    let picture = Resource::from(&Arc::new(StorageImage::new(device, "mistake: picture", SIDE, SIDE)?));
    let bytes = u64::from(SIDE * SIDE) * PIXEL_BYTES;
    let pixels = Resource::from(&Arc::new(Buffer::new(device, "mistake: pixels", BufferKind::Readback, bytes)?));
    Commands::new(device, "mistake: two copies")?.run(|recorder| {
        recorder.make_ready(&picture, Use::CopySource);
        recorder.make_ready(&pixels, Use::CopyTarget);
        recorder.copy_to_buffer(&picture, &pixels, SIDE, SIDE);
        recorder.copy_to_buffer(&picture, &pixels, SIDE, SIDE);
        recorder.make_ready(&pixels, Use::HostRead);
        Ok(())
    })
}

/// The 64 invocations of `glsl/probe/sum.comp` take four bytes each, and there are half as many. What lies past the end
/// is the allocator's own block, which holds nothing else.
fn write_past_the_end(device: &Arc<Device>) -> Result<(), GpuError> {
    let description = PipelineDescription {
        shader: &shaders::PROBE_SUM,
        bindings: &[BindingKind::Storage],
        push_constant_bytes: 0,
        constants: &[],
    };
    let pipeline = ComputePipeline::new(device, &description)?;
    let half = Resource::from(&Arc::new(Buffer::new(device, "mistake: half", BufferKind::Storage, 32 * 4)?));
    let set = BindingSet::new(&pipeline, std::slice::from_ref(&half))?;
    Commands::new(device, "mistake: past the end")?.run(|recorder| {
        recorder.dispatch(&pipeline, &set, &[], [1, 1, 1]);
        recorder.make_ready(&half, Use::HostRead);
        Ok(())
    })
}

/// A pool whose command buffers can be reset each by itself, which costs memory.
fn ask_for_resets_one_by_one(device: &Arc<Device>) -> Result<(), GpuError> {
    let info = vk::CommandPoolCreateInfo::default()
        .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER)
        .queue_family_index(device.queue_family);
    // SAFETY: the device is alive and has the queue family; the pool is used for nothing.
    unsafe {
        let pool = device
            .raw
            .create_command_pool(&info, None)
            .map_err(GpuError::call(|| "create the command pool 'mistake: resets'"))?;
        device.raw.destroy_command_pool(pool, None);
    }
    Ok(())
}
