//! Compute pipelines and what is bound to them.

use std::any::Any;
use std::sync::Arc;

use ash::vk;

use super::compiled::Capture;
use super::device::Device;
use super::error::GpuError;
use super::float_controls;
use super::hazards::{ResourceId, Use};
use super::memory::{Buffer, BufferKind, StorageImage, Texel};
use super::shaders::Shader;

/// How a kernel uses one binding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BindingKind {
    /// A uniform block.
    Uniform,
    /// A storage buffer that is read, written or both.
    Storage,
    /// A storage buffer that is only read.
    Records,
    /// A buffer that is read texel by texel.
    Texels(Texel),
    /// A storage buffer of pixels that is written, or read and written.
    Pixels,
    /// The same, if it is only read.
    PixelsRead,
    /// A storage image that is written, or read and written.
    Picture,
    /// A storage image that is only read.
    PictureRead,
}

impl BindingKind {
    fn descriptor_type(self) -> vk::DescriptorType {
        match self {
            Self::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
            Self::Storage | Self::Records | Self::Pixels | Self::PixelsRead => vk::DescriptorType::STORAGE_BUFFER,
            Self::Texels(_) => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
            Self::Picture | Self::PictureRead => vk::DescriptorType::STORAGE_IMAGE,
        }
    }

    fn use_(self) -> Use {
        match self {
            Self::Uniform | Self::Records | Self::Texels(_) | Self::PixelsRead | Self::PictureRead => Use::ShaderRead,
            Self::Storage | Self::Pixels | Self::Picture => Use::ShaderWrite,
        }
    }
}

/// What a pipeline is made from.
pub struct PipelineDescription<'a> {
    /// The kernel, whose entry point is `main`.
    pub shader: &'a Shader,
    /// Binding `i` of set 0.
    pub bindings: &'a [BindingKind],
    /// None is 0.
    pub push_constant_bytes: u32,
    /// Specialization constant `i`; every one is 4 bytes wide.
    pub constants: &'a [u32],
}

/// A compute pipeline with its layout.
pub struct ComputePipeline {
    pub(super) raw: vk::Pipeline,
    pub(super) layout: Arc<Layout>,
    pub(super) name: &'static str,
    device: Arc<Device>,
}

impl ComputePipeline {
    /// Compiles the kernel, or finds it in the device's pipeline cache, which is saved.
    pub fn new(device: &Arc<Device>, description: &PipelineDescription) -> Result<Arc<Self>, GpuError> {
        let layout = Layout::new(device, description)?;
        Self::with_layout(layout, description)
    }

    /// Another one, that binding sets of this one serve too.
    ///
    /// # Panics
    /// It binds other resources, or its push constants are of another length.
    pub fn sibling(&self, description: &PipelineDescription) -> Result<Arc<Self>, GpuError> {
        let Layout { bindings, push_constant_bytes, .. } = &*self.layout;
        let same = (&bindings[..], *push_constant_bytes) == (description.bindings, description.push_constant_bytes);
        assert!(same, "kernel '{}' binds other resources than '{}'", description.shader.name, self.name);
        Self::with_layout(self.layout.clone(), description)
    }

    fn with_layout(layout: Arc<Layout>, description: &PipelineDescription) -> Result<Arc<Self>, GpuError> {
        let (device, name) = (layout.device.clone(), description.shader.name);
        let raw = compile(&device, description, layout.raw)?;
        let pipeline = Self { raw, layout, name, device };
        let device = &pipeline.device;
        if let Some(capture) = &device.capture {
            // SAFETY: it was just compiled on this device, to be told of.
            unsafe { capture.add(name, raw) }.map_err(GpuError::call(|| format!("ask about kernel '{name}'")))?;
        }
        device.set_name(pipeline.raw, name);
        if device.capture.is_none() {
            device.cache.save(&device.raw);
        }
        Ok(Arc::new(pipeline))
    }
}

impl Drop for ComputePipeline {
    fn drop(&mut self) {
        // SAFETY: submissions are waited for before a pipeline can be dropped.
        unsafe { self.device.raw.destroy_pipeline(self.raw, None) };
    }
}

/// What kernels bind, and how long their push constants are.
pub(super) struct Layout {
    pub raw: vk::PipelineLayout,
    set: vk::DescriptorSetLayout,
    bindings: Vec<BindingKind>,
    pub push_constant_bytes: u32,
    device: Arc<Device>,
}

impl Layout {
    fn new(device: &Arc<Device>, description: &PipelineDescription) -> Result<Arc<Self>, GpuError> {
        let name = description.shader.name;
        // Null handles until made; `Drop` ignores them, so a failure on the way leaks nothing.
        let mut layout = Self {
            raw: vk::PipelineLayout::null(),
            set: vk::DescriptorSetLayout::null(),
            bindings: description.bindings.to_vec(),
            push_constant_bytes: description.push_constant_bytes,
            device: device.clone(),
        };

        let set_bindings: Vec<_> = (0..)
            .zip(description.bindings)
            .map(|(binding, kind)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(kind.descriptor_type())
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&set_bindings);
        // SAFETY: the device is alive; `info` lives through the call.
        layout.set = unsafe { device.raw.create_descriptor_set_layout(&info, None) }
            .map_err(GpuError::call(|| format!("create the set layout of kernel '{name}'")))?;
        device.set_name(layout.set, name);

        let set_layouts = [layout.set];
        let push_constants = [vk::PushConstantRange::default()
            .stage_flags(vk::ShaderStageFlags::COMPUTE)
            .size(description.push_constant_bytes)];
        let mut info = vk::PipelineLayoutCreateInfo::default().set_layouts(&set_layouts);
        if description.push_constant_bytes > 0 {
            info = info.push_constant_ranges(&push_constants);
        }
        // SAFETY: as above.
        layout.raw = unsafe { device.raw.create_pipeline_layout(&info, None) }
            .map_err(GpuError::call(|| format!("create the layout of kernel '{name}'")))?;
        device.set_name(layout.raw, name);
        Ok(Arc::new(layout))
    }
}

impl Drop for Layout {
    fn drop(&mut self) {
        // SAFETY: pipelines and sets of it hold it, and recorders hold those until their submissions are over; null
        // handles are ignored.
        unsafe {
            self.device.raw.destroy_pipeline_layout(self.raw, None);
            self.device.raw.destroy_descriptor_set_layout(self.set, None);
        }
    }
}

const NO_FLAGS: vk::PipelineCreateFlags = vk::PipelineCreateFlags::empty();

fn compile(
    device: &Device,
    description: &PipelineDescription,
    layout: vk::PipelineLayout,
) -> Result<vk::Pipeline, GpuError> {
    let name = description.shader.name;
    let mut code = description.shader.words();
    if description.shader.asks_for_float_controls {
        code = float_controls::declare(&code, &device.float_controls);
    }
    let info = vk::ShaderModuleCreateInfo::default().code(&code);
    // SAFETY: the code is what the shader compiler made of a kernel with these bindings and constants.
    let module = unsafe { device.raw.create_shader_module(&info, None) }
        .map_err(GpuError::call(|| format!("load the code of kernel '{name}'")))?;
    device.set_name(module, name);

    let entries: Vec<_> = (0..)
        .zip(description.constants)
        .map(|(id, _)| vk::SpecializationMapEntry { constant_id: id, offset: id * 4, size: 4 })
        .collect();
    let specialization =
        vk::SpecializationInfo::default().map_entries(&entries).data(bytemuck::cast_slice(description.constants));
    let stage = vk::PipelineShaderStageCreateInfo::default()
        .stage(vk::ShaderStageFlags::COMPUTE)
        .module(module)
        .name(c"main")
        .specialization_info(&specialization);
    let info = vk::ComputePipelineCreateInfo::default()
        // For `Recorder::dispatch_parts`.
        .flags(vk::PipelineCreateFlags::DISPATCH_BASE | device.capture.as_ref().map_or(NO_FLAGS, Capture::flags))
        .stage(stage)
        .layout(layout);
    // What comes from a cache may have been compiled without being told of.
    let cache = if device.capture.is_some() { vk::PipelineCache::null() } else { device.cache.raw };
    // SAFETY: module and layout are alive; the module may go once the pipeline stands.
    let made = unsafe {
        let made = device.raw.create_compute_pipelines(cache, &[info], None);
        device.raw.destroy_shader_module(module, None);
        made
    };
    match made {
        Ok(pipelines) => Ok(pipelines[0]),
        Err((_, result)) => Err(GpuError::Call { operation: format!("compile kernel '{name}'"), result }),
    }
}

/// A resource that can be bound.
#[derive(Clone)]
pub enum Resource {
    /// Buffer of any [`BufferKind`].
    Buffer(Arc<Buffer>),
    /// For [`BindingKind::Picture`] and [`BindingKind::PictureRead`].
    Image(Arc<StorageImage>),
}

impl Resource {
    pub(crate) fn image(&self) -> Option<&StorageImage> {
        match self {
            Self::Buffer(_) => None,
            Self::Image(image) => Some(image),
        }
    }

    /// What keeps it alive.
    pub(super) fn kept(&self) -> Arc<dyn Any> {
        match self {
            Self::Buffer(buffer) => buffer.clone(),
            Self::Image(image) => image.clone(),
        }
    }

    pub(super) fn id(&self) -> ResourceId {
        match self {
            Self::Buffer(buffer) => buffer.id,
            Self::Image(image) => image.id,
        }
    }

    fn fits(&self, binding: BindingKind) -> bool {
        match self {
            Self::Buffer(buffer) => match binding {
                BindingKind::Uniform => buffer.kind == BufferKind::Uniform,
                BindingKind::Storage => buffer.kind == BufferKind::Storage,
                BindingKind::Records => buffer.kind == BufferKind::Records,
                BindingKind::Pixels | BindingKind::PixelsRead => buffer.kind == BufferKind::Pixels,
                BindingKind::Texels(texel) => buffer.kind == BufferKind::Texels(texel),
                BindingKind::Picture | BindingKind::PictureRead => false,
            },
            Self::Image(_) => matches!(binding, BindingKind::Picture | BindingKind::PictureRead),
        }
    }

    fn device(&self) -> &Arc<Device> {
        match self {
            Self::Buffer(buffer) => &buffer.device,
            Self::Image(image) => &image.device,
        }
    }

    pub(super) fn name(&self) -> &str {
        match self {
            Self::Buffer(buffer) => &buffer.name,
            Self::Image(image) => &image.name,
        }
    }
}

impl From<&Arc<Buffer>> for Resource {
    fn from(buffer: &Arc<Buffer>) -> Self {
        Self::Buffer(buffer.clone())
    }
}

impl From<&Arc<StorageImage>> for Resource {
    fn from(image: &Arc<StorageImage>) -> Self {
        Self::Image(image.clone())
    }
}

/// A descriptor set: the resources of one pipeline and its siblings, kept alive with it.
pub struct BindingSet {
    pub(super) set: vk::DescriptorSet,
    /// Layout of the pipelines that it serves.
    pub(super) layout: Arc<Layout>,
    pub(super) uses: Vec<(Resource, Use)>,
    pool: vk::DescriptorPool,
    device: Arc<Device>,
}

impl BindingSet {
    /// Binds `resources[i]` to binding `i` of `pipeline`.
    ///
    /// # Panics
    /// The resources are not those that the pipeline binds, in number, kind or device.
    pub fn new(pipeline: &ComputePipeline, resources: &[Resource]) -> Result<Arc<Self>, GpuError> {
        assert_eq!(resources.len(), pipeline.layout.bindings.len(), "kernel '{}' binds other resources", pipeline.name);
        let device = &pipeline.device;
        let sizes: Vec<_> = pipeline
            .layout
            .bindings
            .iter()
            .map(|kind| vk::DescriptorPoolSize { ty: kind.descriptor_type(), descriptor_count: 1 })
            .collect();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: the device is alive.
        let pool = unsafe { device.raw.create_descriptor_pool(&info, None) }
            .map_err(GpuError::call(|| format!("create the descriptor pool of kernel '{}'", pipeline.name)))?;
        // Dropped, and so freed, by a failure below; a set dies with its pool.
        let mut binding_set = Self {
            set: vk::DescriptorSet::null(),
            layout: pipeline.layout.clone(),
            uses: Vec::new(),
            pool,
            device: device.clone(),
        };
        device.set_name(pool, pipeline.name);

        let set_layouts = [pipeline.layout.set];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&set_layouts);
        // SAFETY: the pool has room for exactly this set.
        let sets = unsafe { device.raw.allocate_descriptor_sets(&info) }
            .map_err(GpuError::call(|| format!("allocate the descriptor set of kernel '{}'", pipeline.name)))?;
        binding_set.set = sets[0];
        device.set_name(binding_set.set, pipeline.name);

        for ((binding, kind), resource) in (0..).zip(&pipeline.layout.bindings).zip(resources) {
            let write = vk::WriteDescriptorSet::default()
                .dst_set(binding_set.set)
                .dst_binding(binding)
                .descriptor_type(kind.descriptor_type());
            assert!(resource.fits(*kind), "'{}' cannot be bound as {kind:?}", resource.name());
            assert!(Arc::ptr_eq(resource.device(), device), "'{}' is another device's", resource.name());
            let (buffers, views, images);
            let write = match resource {
                Resource::Buffer(buffer) if buffer.view != vk::BufferView::null() => {
                    views = [buffer.view];
                    write.texel_buffer_view(&views)
                }
                Resource::Buffer(buffer) => {
                    buffers = [vk::DescriptorBufferInfo { buffer: buffer.raw, offset: 0, range: vk::WHOLE_SIZE }];
                    write.buffer_info(&buffers)
                }
                Resource::Image(image) => {
                    images = [vk::DescriptorImageInfo::default()
                        .image_view(image.view)
                        .image_layout(vk::ImageLayout::GENERAL)];
                    write.image_info(&images)
                }
            };
            // SAFETY: the set is not in use yet, and the set keeps every resource alive.
            unsafe { device.raw.update_descriptor_sets(&[write], &[]) };
            binding_set.uses.push((resource.clone(), kind.use_()));
        }
        Ok(Arc::new(binding_set))
    }
}

impl Drop for BindingSet {
    fn drop(&mut self) {
        // SAFETY: submissions are waited for before a set can be dropped.
        unsafe { self.device.raw.destroy_descriptor_pool(self.pool, None) };
    }
}
