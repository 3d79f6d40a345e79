//! Recording, submitting and waiting.

use std::marker::PhantomData;
use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::GpuError;
use super::hazards::{Hazards, Use};
use super::memory::{COLOR, StorageImage};
use super::messages::Message;
use super::pipeline::{BindingSet, ComputePipeline, Resource};
use super::timer::Timer;

/// One command buffer, recorded anew for every run.
pub struct Commands {
    pool: vk::CommandPool,
    buffer: vk::CommandBuffer,
    fence: vk::Fence,
    name: String,
    device: Arc<Device>,
}

impl Commands {
    pub fn new(device: &Arc<Device>, name: &str) -> Result<Self, GpuError> {
        let failed = |what| GpuError::call(move || format!("create the {what} '{name}'"));
        // Null handles until made; `Drop` ignores them, so a failure on the way leaks nothing.
        let mut commands = Self {
            pool: vk::CommandPool::null(),
            buffer: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            name: name.to_owned(),
            device: device.clone(),
        };
        let info = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::TRANSIENT)
            .queue_family_index(device.queue_family);
        // SAFETY: the device is alive and has the queue family.
        commands.pool = unsafe { device.raw.create_command_pool(&info, None) }.map_err(failed("command pool"))?;
        device.set_name(commands.pool, name);
        let info = vk::CommandBufferAllocateInfo::default().command_pool(commands.pool).command_buffer_count(1);
        // SAFETY: the pool is alive.
        commands.buffer = unsafe { device.raw.allocate_command_buffers(&info) }.map_err(failed("command buffer"))?[0];
        device.set_name(commands.buffer, name);
        // SAFETY: the device is alive.
        commands.fence =
            unsafe { device.raw.create_fence(&vk::FenceCreateInfo::default(), None) }.map_err(failed("fence"))?;
        device.set_name(commands.fence, name);
        Ok(commands)
    }

    /// Records, submits, and waits until the device is done.
    ///
    /// `'a` outlives the call, so whatever was recorded is alive until then.
    pub fn run<'a>(&mut self, record: impl FnOnce(&mut Recorder<'a>) -> Result<(), GpuError>) -> Result<(), GpuError> {
        let raw = &self.device.raw;
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the last run was waited for, so the pool is free to reset.
        unsafe {
            raw.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty())
                .and_then(|()| raw.begin_command_buffer(self.buffer, &begin))
        }
        .map_err(GpuError::call(|| format!("begin recording '{}'", self.name)))?;

        let mut recorder = Recorder {
            buffer: self.buffer,
            device: self.device.clone(),
            hazards: Hazards::default(),
            read_back: Vec::new(),
            recorded: PhantomData,
        };
        record(&mut recorder)?;
        recorder.check_read_back();

        let buffers = [self.buffer];
        let submit = [vk::SubmitInfo::default().command_buffers(&buffers)];
        // SAFETY: everything recorded is alive until the wait ends; no submission is using the fence.
        unsafe {
            raw.end_command_buffer(self.buffer)
                .and_then(|()| raw.reset_fences(&[self.fence]))
                .and_then(|()| raw.queue_submit(self.device.queue, &submit, self.fence))
                .and_then(|()| raw.wait_for_fences(&[self.fence], true, u64::MAX))
                .inspect_err(|_| {
                    // A wait that failed may have left work in flight, which must not outlive its resources. On a
                    // lost device there is none, and this fails too.
                    let _ = raw.device_wait_idle();
                })
        }
        .map_err(GpuError::call(|| format!("run '{}'", self.name)))
    }
}

impl Drop for Commands {
    fn drop(&mut self) {
        // SAFETY: `run` waits, so nothing is in flight, and a lost device runs nothing; null handles are ignored.
        unsafe {
            self.device.raw.destroy_fence(self.fence, None);
            self.device.raw.destroy_command_pool(self.pool, None);
        }
    }
}

/// A command buffer being recorded.
///
/// A barrier is a call of its own, [`Recorder::make_ready`], so that the recorded text shows it; a missing one becomes
/// a message like those of the validation layer.
pub struct Recorder<'a> {
    buffer: vk::CommandBuffer,
    device: Arc<Device>,
    hazards: Hazards,
    read_back: Vec<Resource>,
    recorded: PhantomData<&'a ()>,
}

impl<'a> Recorder<'a> {
    /// Gives the commands that `work` records a name in debuggers and profilers.
    pub fn labelled(
        &mut self,
        name: &str,
        work: impl FnOnce(&mut Self) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        let device = self.device.clone();
        let (Some(labels), Ok(name)) = (device.labels(), std::ffi::CString::new(name)) else { return work(self) };
        let label = vk::DebugUtilsLabelEXT::default().label_name(&name);
        // SAFETY: the command buffer is being recorded; every begin has its end.
        unsafe { labels.cmd_begin_debug_utils_label(self.buffer, &label) };
        let result = work(self);
        // SAFETY: as above.
        unsafe { labels.cmd_end_debug_utils_label(self.buffer) };
        result
    }

    /// A barrier: what was done to `resource` so far is done, and seen, before its `next` use.
    ///
    /// An image touched for the first time in this recording loses what it held.
    pub fn make_ready(&mut self, resource: &'a Resource, next: Use) {
        let old_layout = self.hazards.ready(resource.id()).map_or(vk::ImageLayout::UNDEFINED, image_layout);
        let before = self.hazards.note_barrier(resource.id(), next);
        let (source_stage, source_access) = before
            .into_iter()
            .map(scope)
            .fold((vk::PipelineStageFlags::empty(), NO_ACCESS), |all, one| (all.0 | one.0, all.1 | one.1));
        // A barrier that waits for nothing has to say so.
        let source_stage = if source_stage.is_empty() { vk::PipelineStageFlags::TOP_OF_PIPE } else { source_stage };
        let (target_stage, target_access) = scope(next);
        let mut buffers = Vec::new();
        let mut images = Vec::new();
        match resource {
            Resource::Buffer(buffer) => buffers.push(
                vk::BufferMemoryBarrier::default()
                    .src_access_mask(source_access)
                    .dst_access_mask(target_access)
                    .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .buffer(buffer.raw)
                    .size(vk::WHOLE_SIZE),
            ),
            Resource::Image(image) => images.push(
                vk::ImageMemoryBarrier::default()
                    .src_access_mask(source_access)
                    .dst_access_mask(target_access)
                    .old_layout(old_layout)
                    .new_layout(image_layout(next))
                    .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .image(image.raw)
                    .subresource_range(COLOR),
            ),
        }
        // SAFETY: the command buffer is being recorded and the resource is alive.
        unsafe {
            self.device.raw.cmd_pipeline_barrier(
                self.buffer,
                source_stage,
                target_stage,
                vk::DependencyFlags::empty(),
                &[],
                &buffers,
                &images,
            );
        }
    }

    /// Runs `groups` workgroups of `pipeline` on what `set` binds.
    ///
    /// # Panics
    /// The set was made for another pipeline, or the push constants are not as long as the pipeline's.
    pub fn dispatch(
        &mut self,
        pipeline: &'a ComputePipeline,
        set: &'a BindingSet,
        push_constants: &[u8],
        groups: [u32; 3],
    ) {
        assert_eq!(set.set_layout, pipeline.set_layout, "the set was made for another kernel than '{}'", pipeline.name);
        assert_eq!(push_constants.len(), pipeline.push_constant_bytes as usize, "kernel '{}'", pipeline.name);
        for (resource, as_) in &set.uses {
            self.note_use(resource, pipeline.name, *as_);
        }
        let raw = &self.device.raw;
        // SAFETY: the command buffer is being recorded; the set was made for this pipeline's layout.
        unsafe {
            raw.cmd_bind_pipeline(self.buffer, vk::PipelineBindPoint::COMPUTE, pipeline.raw);
            raw.cmd_bind_descriptor_sets(
                self.buffer,
                vk::PipelineBindPoint::COMPUTE,
                pipeline.layout,
                0,
                &[set.set],
                &[],
            );
            if !push_constants.is_empty() {
                let stages = vk::ShaderStageFlags::COMPUTE;
                raw.cmd_push_constants(self.buffer, pipeline.layout, stages, 0, push_constants);
            }
            raw.cmd_dispatch(self.buffer, groups[0], groups[1], groups[2]);
        }
    }

    /// Copies the image's top left `width`×`height` pixels to the buffer, rows one after another.
    ///
    /// # Panics
    /// One of them has no room for that.
    pub fn copy_to_buffer(&mut self, from: &'a Resource, to: &'a Resource, width: u32, height: u32) {
        let (Resource::Image(image), Resource::Buffer(buffer)) = (from, to) else {
            return self.report(format!("cannot copy '{}' to '{}': not an image and a buffer", from.name(), to.name()));
        };
        assert!(width <= image.width() && height <= image.height());
        assert!(u64::from(width) * u64::from(height) * StorageImage::PIXEL_BYTES <= buffer.size());
        self.note_use(from, "copy", Use::CopySource);
        self.note_use(to, "copy", Use::CopyTarget);
        let region = vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_extent(vk::Extent3D { width, height, depth: 1 });
        // SAFETY: the command buffer is being recorded; the region lies within both.
        unsafe {
            self.device.raw.cmd_copy_image_to_buffer(
                self.buffer,
                image.raw,
                image_layout(Use::CopySource),
                buffer.raw,
                &[region],
            );
        }
    }

    /// The time of what is recorded between this and [`Recorder::stop`] is the timer's.
    pub fn start(&mut self, timer: &'a Timer) {
        // SAFETY: the command buffer is being recorded outside a render pass; the pool has two queries.
        unsafe {
            self.device.raw.cmd_reset_query_pool(self.buffer, timer.pool, 0, 2);
            self.device.raw.cmd_write_timestamp(self.buffer, vk::PipelineStageFlags::TOP_OF_PIPE, timer.pool, 0);
        }
    }

    pub fn stop(&mut self, timer: &'a Timer) {
        // SAFETY: as for `start`.
        unsafe {
            self.device.raw.cmd_write_timestamp(self.buffer, vk::PipelineStageFlags::BOTTOM_OF_PIPE, timer.pool, 1);
        }
    }

    fn note_use(&mut self, resource: &Resource, command: &str, as_: Use) {
        let needs_layout = matches!(resource, Resource::Image(_));
        if let Some(hazard) = self.hazards.note_use(resource.id(), resource.name(), command, as_, needs_layout) {
            self.report(hazard);
        }
        if matches!(resource, Resource::Buffer(buffer) if buffer.kind.is_read_by_host()) {
            self.read_back.push(resource.clone());
        }
    }

    fn check_read_back(&mut self) {
        for resource in std::mem::take(&mut self.read_back) {
            if self.hazards.is_hidden_from_host(resource.id()) {
                self.report(format!("'{}' was written without a barrier for the host that reads it", resource.name()));
            }
        }
    }

    fn report(&self, text: String) {
        self.device.instance.messages.push(Message { id: "zerkalo-hazard".to_owned(), text });
    }
}

const NO_ACCESS: vk::AccessFlags = vk::AccessFlags::empty();

/// The layout that an image is in for a use.
fn image_layout(use_: Use) -> vk::ImageLayout {
    match use_ {
        Use::CopySource => vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
        Use::CopyTarget => vk::ImageLayout::TRANSFER_DST_OPTIMAL,
        Use::ShaderRead | Use::ShaderWrite | Use::HostRead => vk::ImageLayout::GENERAL,
    }
}

/// Pipeline stage and memory accesses of a use.
fn scope(use_: Use) -> (vk::PipelineStageFlags, vk::AccessFlags) {
    use vk::{AccessFlags as Access, PipelineStageFlags as Stage};
    match use_ {
        Use::ShaderRead => (Stage::COMPUTE_SHADER, Access::SHADER_READ | Access::UNIFORM_READ),
        Use::ShaderWrite => (Stage::COMPUTE_SHADER, Access::SHADER_READ | Access::SHADER_WRITE),
        Use::CopySource => (Stage::TRANSFER, Access::TRANSFER_READ),
        Use::CopyTarget => (Stage::TRANSFER, Access::TRANSFER_WRITE),
        Use::HostRead => (Stage::HOST, Access::HOST_READ),
    }
}
