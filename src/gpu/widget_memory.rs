//! The memory of what the widgets' renderer makes: vertices, indices, textures.

use std::sync::Arc;

use ash::vk;
use egui_ash_renderer::RendererResult;
use egui_ash_renderer::allocator::{Allocator, GpuAllocator};
use gpu_allocator::vulkan::Allocation;

use super::device::Device;

/// The renderer's own allocator, but for the end: that one (0.13) frees memory before it destroys what lies in it,
/// which the validation layer reports when the block of memory goes with it.
pub struct WidgetMemory {
    allocator: GpuAllocator,
    device: Arc<Device>,
}

impl WidgetMemory {
    pub fn new(device: &Arc<Device>) -> Self {
        Self { allocator: GpuAllocator::new(device.allocator().clone()), device: device.clone() }
    }

    fn free(&self, memory: Allocation) -> RendererResult<()> {
        Ok(self.device.with_allocator(|allocator| allocator.free(memory))?)
    }
}

impl Allocator for WidgetMemory {
    type Allocation = Allocation;

    fn create_buffer(
        &mut self,
        device: &ash::Device,
        size: usize,
        usage: vk::BufferUsageFlags,
    ) -> RendererResult<(vk::Buffer, Allocation)> {
        let (buffer, memory) = self.allocator.create_buffer(device, size, usage)?;
        self.device.set_name(buffer, "widgets");
        Ok((buffer, memory))
    }

    fn create_image(
        &mut self,
        device: &ash::Device,
        width: u32,
        height: u32,
    ) -> RendererResult<(vk::Image, Allocation)> {
        let (image, memory) = self.allocator.create_image(device, width, height)?;
        self.device.set_name(image, "widgets");
        Ok((image, memory))
    }

    fn destroy_buffer(&mut self, device: &ash::Device, buffer: vk::Buffer, memory: Allocation) -> RendererResult<()> {
        // SAFETY: the renderer gives up what no frame in flight uses.
        unsafe { device.destroy_buffer(buffer, None) };
        self.free(memory)
    }

    fn destroy_image(&mut self, device: &ash::Device, image: vk::Image, memory: Allocation) -> RendererResult<()> {
        // SAFETY: as above.
        unsafe { device.destroy_image(image, None) };
        self.free(memory)
    }

    fn update_buffer<T: Copy>(
        &mut self,
        device: &ash::Device,
        memory: &mut Allocation,
        data: &[T],
    ) -> RendererResult<()> {
        self.allocator.update_buffer(device, memory, data)
    }
}
