//! Buffers and images with their memory.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};

use super::commands::Idle;
use super::device::Device;
use super::error::GpuError;
use super::hazards::ResourceId;

/// What a buffer is for; decides its usage flags and its memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BufferKind {
    /// Written by the host before the first use and by [`Recorder::update`](super::Recorder::update) after, read by
    /// shaders as a uniform block.
    Uniform,
    /// Written by the host before, by shaders after; read back by the host.
    Storage,
    /// Written by the host before the first use, read by shaders; of any length that the device allows.
    Records,
    /// As [`BufferKind::Uniform`], read by shaders as texels of four numbers; of any length that the device allows.
    Texels(Texel),
    /// Written by shaders and read again by them and by copies: a picture, pixels of four `f32`.
    Pixels,
    /// Written by copies, read by the host.
    Readback,
    /// Written by the host, read by copies.
    Upload,
}

/// What a texel of 16 bytes holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Texel {
    /// Four `f32`.
    Floats,
    /// Four `u32`, or the bits of two `f64`.
    Bits,
}

impl Texel {
    /// Bytes of one texel, whichever it holds.
    pub const BYTES: u64 = 16;

    /// Every Vulkan device must offer both for texel buffers.
    fn format(self) -> vk::Format {
        match self {
            Self::Floats => vk::Format::R32G32B32A32_SFLOAT,
            Self::Bits => vk::Format::R32G32B32A32_UINT,
        }
    }
}

impl BufferKind {
    fn usage(self) -> vk::BufferUsageFlags {
        match self {
            Self::Uniform => vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
            Self::Storage | Self::Records => vk::BufferUsageFlags::STORAGE_BUFFER,
            Self::Texels(_) => vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
            Self::Pixels => {
                vk::BufferUsageFlags::STORAGE_BUFFER
                    | vk::BufferUsageFlags::TRANSFER_SRC
                    | vk::BufferUsageFlags::TRANSFER_DST
            }
            Self::Readback => vk::BufferUsageFlags::TRANSFER_DST,
            Self::Upload => vk::BufferUsageFlags::TRANSFER_SRC,
        }
    }

    fn location(self) -> MemoryLocation {
        match self {
            Self::Uniform | Self::Records | Self::Texels(_) | Self::Upload => MemoryLocation::CpuToGpu,
            Self::Storage | Self::Readback => MemoryLocation::GpuToCpu,
            Self::Pixels => MemoryLocation::GpuOnly,
        }
    }

    /// Whether the host reads what the device wrote.
    pub(super) fn is_read_by_host(self) -> bool {
        matches!(self, Self::Storage | Self::Readback)
    }
}

/// A buffer; the host has mapped it, unless it is of [`BufferKind::Pixels`].
pub struct Buffer {
    pub(super) raw: vk::Buffer,
    /// View of [`BufferKind::Texels`]; else null.
    pub(super) view: vk::BufferView,
    pub(super) name: String,
    pub(super) kind: BufferKind,
    pub(super) id: ResourceId,
    /// Bytes.
    size: u64,
    allocation: Option<Allocation>,
    pub(super) device: Arc<Device>,
}

impl Buffer {
    /// A buffer of `size` bytes, at least one.
    pub fn new(device: &Arc<Device>, name: &str, kind: BufferKind, size: u64) -> Result<Self, GpuError> {
        let info = vk::BufferCreateInfo::default().size(size.max(1)).usage(kind.usage());
        // SAFETY: the device is alive.
        let raw = unsafe { device.raw.create_buffer(&info, None) }
            .map_err(GpuError::call(|| format!("create buffer '{name}' ({size} B)")))?;
        // Dropped, and so freed, by any failure below.
        let mut buffer = Self {
            raw,
            view: vk::BufferView::null(),
            name: name.to_owned(),
            kind,
            id: ResourceId::fresh(),
            size,
            allocation: None,
            device: device.clone(),
        };
        device.set_name(raw, name);
        // SAFETY: the buffer was made from this device.
        let requirements = unsafe { device.raw.get_buffer_memory_requirements(raw) };
        let object = format!("buffer '{name}'");
        let allocation = buffer.allocation.insert(allocate(device, &object, requirements, kind.location(), true)?);
        // SAFETY: the memory is fresh, large enough by its requirements, and lives until the buffer is destroyed.
        unsafe { device.raw.bind_buffer_memory(raw, allocation.memory(), allocation.offset()) }
            .map_err(GpuError::call(|| format!("bind the memory of buffer '{name}'")))?;

        if let BufferKind::Texels(texel) = kind {
            let info =
                vk::BufferViewCreateInfo::default().buffer(raw).format(texel.format()).offset(0).range(vk::WHOLE_SIZE);
            // SAFETY: the buffer is bound to memory.
            buffer.view = unsafe { device.raw.create_buffer_view(&info, None) }
                .map_err(GpuError::call(|| format!("create the view of buffer '{name}'")))?;
            device.set_name(buffer.view, name);
        }
        Ok(buffer)
    }

    /// Bytes that were asked for, which may be none.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Copies `bytes`, at most [`Buffer::size`] of them, to the buffer's start.
    ///
    /// # Panics
    /// There are more.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), GpuError> {
        assert!(bytes.len() as u64 <= self.size, "buffer '{}' has {} B", self.name, self.size);
        let mapped = self.allocation.as_mut().and_then(Allocation::mapped_slice_mut);
        let mapped = mapped.ok_or_else(|| GpuError::NotMapped { object: format!("buffer '{}'", self.name) })?;
        mapped[..bytes.len()].copy_from_slice(bytes);
        Ok(())
    }

    /// The buffer's bytes, for as long as what submits its writing is idle.
    pub fn bytes<'a>(&'a self, _: &'a Idle<'a>) -> Result<&'a [u8], GpuError> {
        let mapped = self.allocation.as_ref().and_then(Allocation::mapped_slice);
        let mapped = mapped.ok_or_else(|| GpuError::NotMapped { object: format!("buffer '{}'", self.name) })?;
        Ok(&mapped[..self.size as usize])
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: submissions are waited for before their resources can be dropped; a null view is ignored.
        unsafe {
            self.device.raw.destroy_buffer_view(self.view, None);
            self.device.raw.destroy_buffer(self.raw, None);
        }
        free(&self.device, self.allocation.take());
    }
}

/// Bytes of a pixel of four `f32`.
pub const PIXEL_BYTES: u64 = 16;

/// A two-dimensional `rgba32f` image that kernels write and read.
pub struct StorageImage {
    pub(super) raw: vk::Image,
    pub(super) view: vk::ImageView,
    pub(super) name: String,
    pub(super) id: ResourceId,
    pub(super) extent: vk::Extent2D,
    allocation: Option<Allocation>,
    pub(super) device: Arc<Device>,
}

impl StorageImage {
    /// Every Vulkan device must offer this format for storage images and as the source of blits.
    const FORMAT: vk::Format = vk::Format::R32G32B32A32_SFLOAT;

    /// `name` is what debuggers and failures show; the sides are in pixels, none of them set yet.
    pub fn new(device: &Arc<Device>, name: &str, width: u32, height: u32) -> Result<Self, GpuError> {
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(Self::FORMAT)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(
                vk::ImageUsageFlags::STORAGE | vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST,
            );
        // SAFETY: the device is alive.
        let raw = unsafe { device.raw.create_image(&info, None) }
            .map_err(GpuError::call(|| format!("create image '{name}' ({width}x{height})")))?;
        // Dropped, and so freed, by any failure below.
        let mut image = Self {
            raw,
            view: vk::ImageView::null(),
            name: name.to_owned(),
            id: ResourceId::fresh(),
            extent: vk::Extent2D { width, height },
            allocation: None,
            device: device.clone(),
        };
        device.set_name(raw, name);
        // SAFETY: the image was made from this device.
        let requirements = unsafe { device.raw.get_image_memory_requirements(raw) };
        let object = format!("image '{name}'");
        let allocation =
            image.allocation.insert(allocate(device, &object, requirements, MemoryLocation::GpuOnly, false)?);
        // SAFETY: as for a buffer.
        unsafe { device.raw.bind_image_memory(raw, allocation.memory(), allocation.offset()) }
            .map_err(GpuError::call(|| format!("bind the memory of image '{name}'")))?;

        let info = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(Self::FORMAT)
            .subresource_range(COLOR);
        // SAFETY: the image is bound to memory.
        image.view = unsafe { device.raw.create_image_view(&info, None) }
            .map_err(GpuError::call(|| format!("create the view of image '{name}'")))?;
        device.set_name(image.view, name);
        Ok(image)
    }

    pub(crate) fn raw(&self) -> vk::Image {
        self.raw
    }

    pub(crate) fn extent(&self) -> vk::Extent2D {
        self.extent
    }

    /// Pixels.
    pub fn width(&self) -> u32 {
        self.extent.width
    }

    /// Pixels.
    pub fn height(&self) -> u32 {
        self.extent.height
    }
}

impl Drop for StorageImage {
    fn drop(&mut self) {
        // SAFETY: as for a buffer; a null view is ignored.
        unsafe {
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_image(self.raw, None);
        }
        free(&self.device, self.allocation.take());
    }
}

pub(super) const COLOR: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

fn allocate(
    device: &Device,
    object: &str,
    requirements: vk::MemoryRequirements,
    location: MemoryLocation,
    linear: bool,
) -> Result<Allocation, GpuError> {
    let description = AllocationCreateDesc {
        name: object,
        requirements,
        location,
        linear,
        allocation_scheme: AllocationScheme::GpuAllocatorManaged,
    };
    device.with_allocator(|allocator| allocator.allocate(&description)).map_err(|source| GpuError::Allocation {
        object: object.to_owned(),
        bytes: requirements.size,
        source,
    })
}

fn free(device: &Device, allocation: Option<Allocation>) {
    if let Some(allocation) = allocation {
        // It fails only for an allocation of another allocator.
        let _ = device.with_allocator(|allocator| allocator.free(allocation));
    }
}
