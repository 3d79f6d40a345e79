//! What a command buffer is filled with.

use std::any::Any;
use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::GpuError;
use super::hazards::{Hazards, Use};
use super::memory::{COLOR, PIXEL_BYTES};
use super::messages::{Message, Severity};
use super::pipeline::{BindingSet, ComputePipeline, Resource};
use super::timer::Timer;

/// Workgroups of a grid that a pipeline runs.
#[derive(Clone, Copy)]
pub struct Dispatch<'p> {
    pub pipeline: &'p Arc<ComputePipeline>,
    /// The first, as the kernel counts them.
    pub first: [u32; 3],
    pub groups: [u32; 3],
}

impl<'p> Dispatch<'p> {
    /// Dispatch of a grid of two dimensions.
    pub fn flat(pipeline: &'p Arc<ComputePipeline>, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> Self {
        Self { pipeline, first: [x, y, 0], groups: [width, height, 1] }
    }
}

/// A command buffer being recorded.
///
/// A barrier is a call of its own, [`Recorder::make_ready`], so that the recorded text shows it; a missing one becomes
/// a message like those of the validation layer.
///
/// What it records is kept alive until the device is done with it.
pub struct Recorder<'h> {
    pub(crate) buffer: vk::CommandBuffer,
    device: Arc<Device>,
    hazards: &'h mut Hazards,
    read_back: Vec<Resource>,
    kept: Vec<Arc<dyn Any>>,
}

impl<'h> Recorder<'h> {
    pub(super) fn new(buffer: vk::CommandBuffer, device: &Arc<Device>, hazards: &'h mut Hazards) -> Self {
        Self { buffer, device: device.clone(), hazards, read_back: Vec::new(), kept: Vec::new() }
    }

    /// Ends the book of this recording; what was recorded must live until the submission has ended.
    pub(super) fn finish(mut self) -> Vec<Arc<dyn Any>> {
        self.check_read_back();
        self.kept
    }

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
    /// An image touched for the first time in these recordings loses what it held.
    pub fn make_ready(&mut self, resource: &Resource, next: Use) {
        self.kept.push(resource.kept());
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
    /// The set was made for a pipeline that is no sibling, or the push constants are not as long as the pipeline's.
    pub fn dispatch(
        &mut self,
        pipeline: &Arc<ComputePipeline>,
        set: &Arc<BindingSet>,
        push_constants: &[u8],
        groups: [u32; 3],
    ) {
        self.dispatch_parts(set, push_constants, &[Dispatch { pipeline, first: [0; 3], groups }]);
    }

    /// Runs parts of one grid of workgroups, each by its own of some sibling pipelines. No barrier stands between them,
    /// so they must not touch the same data.
    ///
    /// # Panics
    /// The set was made for a pipeline that is no sibling, or the push constants are not as long as theirs.
    pub(crate) fn dispatch_parts(&mut self, set: &Arc<BindingSet>, push_constants: &[u8], parts: &[Dispatch]) {
        let Some(Dispatch { pipeline: first, .. }) = parts.first() else { return };
        for Dispatch { pipeline, .. } in parts {
            assert!(
                Arc::ptr_eq(&set.layout, &pipeline.layout),
                "the set was made for another kernel than '{}'",
                pipeline.name
            );
        }
        assert_eq!(push_constants.len(), set.layout.push_constant_bytes as usize, "kernel '{}'", first.name);
        for (resource, as_) in &set.uses {
            self.note_use(resource, first.name, *as_);
        }
        self.kept.push(set.clone());
        let (raw, layout) = (&self.device.raw, set.layout.raw);
        let (point, stages) = (vk::PipelineBindPoint::COMPUTE, vk::ShaderStageFlags::COMPUTE);
        // SAFETY: the command buffer is being recorded; the set and the constants are of that layout.
        unsafe {
            raw.cmd_bind_descriptor_sets(self.buffer, point, layout, 0, &[set.set], &[]);
            if !push_constants.is_empty() {
                raw.cmd_push_constants(self.buffer, layout, stages, 0, push_constants);
            }
        }
        let mut bound = vk::Pipeline::null();
        for &Dispatch { pipeline, first: [x, y, z], groups: [width, height, depth] } in parts {
            // SAFETY: the command buffer is being recorded; what is bound is of the pipeline's layout.
            unsafe {
                if bound != pipeline.raw {
                    raw.cmd_bind_pipeline(self.buffer, point, pipeline.raw);
                    self.kept.push(pipeline.clone());
                    bound = pipeline.raw;
                }
                raw.cmd_dispatch_base(self.buffer, x, y, z, width, height, depth);
            }
        }
    }

    /// Copies `width`×`height` pixels to the buffer, rows one after another: the top left ones of an image, or the
    /// first of a buffer.
    ///
    /// # Panics
    /// One of them has no room for that.
    pub fn copy_to_buffer(&mut self, from: &Resource, to: &Resource, width: u32, height: u32) {
        let Resource::Buffer(target) = to else {
            return self.report(format!("cannot copy '{}' to '{}': that is no buffer", from.name(), to.name()));
        };
        let bytes = u64::from(width) * u64::from(height) * PIXEL_BYTES;
        assert!(bytes <= target.size());
        self.note_use(from, "copy", Use::CopySource);
        self.note_use(to, "copy", Use::CopyTarget);
        let raw = &self.device.raw;
        match from {
            Resource::Image(image) => {
                assert!(width <= image.width() && height <= image.height());
                let (layout, region) = (image_layout(Use::CopySource), image_region(width, [0, 0], [width, height]));
                // SAFETY: the command buffer is being recorded; the region lies within both.
                unsafe { raw.cmd_copy_image_to_buffer(self.buffer, image.raw, layout, target.raw, &[region]) };
            }
            Resource::Buffer(buffer) => {
                assert!(bytes <= buffer.size());
                let region = vk::BufferCopy::default().size(bytes);
                // SAFETY: as above.
                unsafe { raw.cmd_copy_buffer(self.buffer, buffer.raw, target.raw, &[region]) };
            }
        }
    }

    /// Copies the buffer, rows one after another, to the image's top left `width`×`height` pixels.
    ///
    /// # Panics
    /// One of them has no room for that.
    pub fn copy_to_image(&mut self, from: &Resource, to: &Resource, width: u32, height: u32) {
        self.copy_parts_to_image(from, to, width, [([0, 0], [width, height])]);
    }

    /// Copies parts of a picture, each its first pixel and its size, from the buffer, which holds the picture in rows
    /// of `width` pixels, to their positions in the image. No barrier stands between them, so they must not overlap.
    ///
    /// # Panics
    /// One of the two has no room for a part.
    pub fn copy_parts_to_image(
        &mut self,
        from: &Resource,
        to: &Resource,
        width: u32,
        parts: impl IntoIterator<Item = ([u32; 2], [u32; 2])>,
    ) {
        let (Resource::Buffer(buffer), Resource::Image(image)) = (from, to) else {
            return self.report(format!("cannot copy '{}' to '{}': not a buffer and an image", from.name(), to.name()));
        };
        let region = |([x, y], [part_width, part_height]): ([u32; 2], [u32; 2])| {
            let (right, bottom) = (x + part_width, y + part_height);
            assert!(right <= width.min(image.width()) && bottom <= image.height());
            assert!(u64::from(width) * u64::from(bottom) * PIXEL_BYTES <= buffer.size());
            image_region(width, [x, y], [part_width, part_height])
        };
        let regions: Vec<_> = parts.into_iter().map(region).collect();
        self.note_use(from, "copy", Use::CopySource);
        self.note_use(to, "copy", Use::CopyTarget);
        let layout = image_layout(Use::CopyTarget);
        // SAFETY: the command buffer is being recorded; the regions lie within both.
        unsafe { self.device.raw.cmd_copy_buffer_to_image(self.buffer, buffer.raw, image.raw, layout, &regions) };
    }

    /// Writes parts of the buffer, each its offset and its bytes, in their turn among the commands. No barrier stands
    /// between them, so they must not overlap.
    ///
    /// # Panics
    /// A part of more than 65536 bytes, not in fours (Vulkan's rules), or beyond the buffer's end.
    pub fn update<'b>(&mut self, target: &Resource, parts: impl IntoIterator<Item = (u64, &'b [u8])>) {
        let Resource::Buffer(buffer) = target else {
            return self.report(format!("cannot update '{}': not a buffer", target.name()));
        };
        self.note_use(target, "update", Use::CopyTarget);
        for (offset, bytes) in parts {
            let is_in_fours = bytes.len().is_multiple_of(4) && offset.is_multiple_of(4);
            assert!(bytes.len() <= 65536 && is_in_fours, "buffer '{}'", buffer.name);
            assert!(offset + bytes.len() as u64 <= buffer.size(), "buffer '{}'", buffer.name);
            // SAFETY: the command buffer is being recorded; the range lies within the buffer.
            unsafe { self.device.raw.cmd_update_buffer(self.buffer, buffer.raw, offset, bytes) };
        }
    }

    /// Fills the image with one colour.
    pub fn clear(&mut self, target: &Resource, color: [f32; 4]) {
        let Resource::Image(image) = target else {
            return self.report(format!("cannot clear '{}': not an image", target.name()));
        };
        self.note_use(target, "clear", Use::CopyTarget);
        let color = vk::ClearColorValue { float32: color };
        let layout = image_layout(Use::CopyTarget);
        // SAFETY: the command buffer is being recorded.
        unsafe { self.device.raw.cmd_clear_color_image(self.buffer, image.raw, layout, &color, &[COLOR]) };
    }

    /// Sets every bit of the image or the buffer to 0.
    pub fn zero(&mut self, target: &Resource) {
        match target {
            Resource::Image(_) => self.clear(target, [0.0; 4]),
            Resource::Buffer(buffer) => {
                self.note_use(target, "fill", Use::CopyTarget);
                // SAFETY: the command buffer is being recorded.
                unsafe { self.device.raw.cmd_fill_buffer(self.buffer, buffer.raw, 0, vk::WHOLE_SIZE, 0) };
            }
        }
    }

    /// The time of what is recorded between this and [`Recorder::stop`] is the timer's.
    pub fn start(&mut self, timer: &Arc<Timer>) {
        self.kept.push(timer.clone());
        // SAFETY: the command buffer is being recorded outside a render pass; the pool has two queries.
        unsafe {
            self.device.raw.cmd_reset_query_pool(self.buffer, timer.pool, 0, 2);
            // Not before all earlier work is done: its end is no part of the time.
            self.device.raw.cmd_write_timestamp(self.buffer, vk::PipelineStageFlags::BOTTOM_OF_PIPE, timer.pool, 0);
        }
    }

    /// Ends what [`Recorder::start`] began; [`Timer::elapsed_ns`] is the time once the submission has ended.
    pub fn stop(&mut self, timer: &Arc<Timer>) {
        // SAFETY: as for `start`.
        unsafe {
            self.device.raw.cmd_write_timestamp(self.buffer, vk::PipelineStageFlags::BOTTOM_OF_PIPE, timer.pool, 1);
        }
    }

    /// Enters a command's use of a resource into the book.
    pub(crate) fn note_use(&mut self, resource: &Resource, command: &str, as_: Use) {
        let needs_layout = matches!(resource, Resource::Image(_));
        if let Some(hazard) = self.hazards.note_use(resource.id(), resource.name(), command, as_, needs_layout) {
            self.report(hazard);
        }
        self.kept.push(resource.kept());
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
        self.device.instance.messages.push(Message {
            severity: Severity::Error,
            id: "zerkalo-hazard".to_owned(),
            text,
        });
    }
}

/// A part of the image, and the same of a buffer with rows of `row` pixels.
fn image_region(row: u32, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> vk::BufferImageCopy {
    vk::BufferImageCopy::default()
        .buffer_offset((u64::from(y) * u64::from(row) + u64::from(x)) * PIXEL_BYTES)
        .buffer_row_length(row)
        .image_offset(vk::Offset3D { x: x as i32, y: y as i32, z: 0 })
        .image_subresource(vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        })
        .image_extent(vk::Extent3D { width, height, depth: 1 })
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
