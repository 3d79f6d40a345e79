use std::ffi::CString;
use std::sync::{Arc, Mutex, OnceLock};

use ash::{ext, khr, vk};
use gpu_allocator::AllocationSizes;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};

use super::arithmetic::Arithmetic;
use super::compiled::{ASSUMED, Capture};
use super::error::GpuError;
use super::float_controls::FloatControls;
use super::instance::Instance;
use super::loader::with_device_list;
use super::physical::{Candidate, DeviceDescription, tells_of_kernels};
use super::pipeline_cache::PipelineCache;
use super::surface::Surface;

/// Device memory is taken in blocks that grow from the first to the second size: the usual blocks of 256 MiB are as
/// large as all memory that a card without resizable BAR shares with the host.
const MEMORY_BLOCK_BYTES: u64 = 4 << 20;
const MAX_MEMORY_BLOCK_BYTES: u64 = 64 << 20;

/// What a device is opened for.
#[derive(Clone, Copy)]
pub(super) enum Purpose<'a> {
    /// Pictures in memory.
    Draw,
    /// Pictures on a surface, with a swapchain.
    Show(&'a Surface),
    /// Kernels that never run.
    Compile,
}

impl<'a> Purpose<'a> {
    pub fn surface(self) -> Option<&'a Surface> {
        match self {
            Self::Show(surface) => Some(surface),
            Self::Draw | Self::Compile => None,
        }
    }
}

/// A logical device with its one queue, its memory and its pipeline cache.
///
/// Every object made from it holds it by `Arc`, so it is destroyed last.
pub struct Device {
    pub(crate) raw: ash::Device,
    /// Used by one thread at a time: the lock is the specification's external synchronization.
    queue: Mutex<vk::Queue>,
    pub(super) queue_family: u32,
    pub(super) timestamp_valid_bits: u32,
    pub(super) timestamp_period_ns: f32,
    pub(super) description: DeviceDescription,
    pub(super) float_controls: [FloatControls; 2],
    /// Arithmetic of `f32` and `f64`, once they have been tested.
    pub(super) arithmetic: [OnceLock<Arithmetic>; 2],
    pub(super) cache: PipelineCache,
    /// What its kernels are compiled to, where that is what it was opened for.
    pub(super) capture: Option<Capture>,
    names: Option<ext::debug_utils::Device>,
    // Always there until `drop` takes it: it must go before the device itself.
    allocator: Option<Arc<Mutex<Allocator>>>,
    pub(super) physical: vk::PhysicalDevice,
    pub(super) instance: Arc<Instance>,
}

impl Device {
    pub(super) fn new(
        instance: Arc<Instance>,
        candidate: Candidate,
        purpose: Purpose<'_>,
    ) -> Result<Arc<Self>, GpuError> {
        let name = candidate.description.name.clone();
        let queue_info =
            vk::DeviceQueueCreateInfo::default().queue_family_index(candidate.queue_family).queue_priorities(&[1.0]);
        let queue_infos = [queue_info];
        let is_told_of_kernels = matches!(purpose, Purpose::Compile) && tells_of_kernels(&instance, candidate.raw);
        let mut extensions = Vec::new();
        extensions.extend(purpose.surface().map(|_| khr::swapchain::NAME.as_ptr()));
        extensions.extend(is_told_of_kernels.then(|| khr::pipeline_executable_properties::NAME.as_ptr()));
        let mut of_kernels_told =
            vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default().pipeline_executable_info(true);
        let mut features = match instance.validation.is_gpu_assisted() {
            true => candidate.features.of_instrumented_kernels(),
            false => candidate.features.of_kernels(),
        };
        // Chained: of `pEnabledFeatures`, layer 1.4.309 says that it was not asked for what there is, which it was.
        let mut of_1_0 = vk::PhysicalDeviceFeatures2::default().features(features.of_1_0);
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queue_infos)
            .enabled_extension_names(&extensions)
            .push_next(&mut of_1_0)
            .push_next(&mut features.of_1_2);
        let info = if is_told_of_kernels { info.push_next(&mut of_kernels_told) } else { info };
        // SAFETY: `candidate` was listed by this instance and has the queue family; `info` lives through the call.
        let raw = with_device_list(|| unsafe { instance.raw.create_device(candidate.raw, &info, None) })
            .map_err(GpuError::call(|| format!("open device '{name}'")))?;
        // SAFETY: the device was just created with one queue of that family.
        let queue = unsafe { raw.get_device_queue(candidate.queue_family, 0) };

        // From here on `Drop` frees what is there when a later step fails.
        let functions = || with_device_list(|| ext::debug_utils::Device::new(&instance.raw, &raw));
        let names = instance.has_debug_utils.then(functions);
        let is_to_compile = matches!(purpose, Purpose::Compile);
        let capture = is_to_compile.then(|| Capture::new(&instance.raw, &raw, is_told_of_kernels));
        let mut device = Self {
            cache: PipelineCache::new(&raw, candidate.cache_identity),
            capture,
            raw,
            queue: Mutex::new(queue),
            queue_family: candidate.queue_family,
            timestamp_valid_bits: candidate.timestamp_valid_bits,
            timestamp_period_ns: candidate.timestamp_period_ns,
            description: candidate.description,
            float_controls: candidate.float_controls,
            arithmetic: [0, 1].map(|_| if is_to_compile { OnceLock::from(ASSUMED) } else { OnceLock::new() }),
            names,
            allocator: None,
            physical: candidate.raw,
            instance,
        };
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: device.instance.raw.clone(),
            device: device.raw.clone(),
            physical_device: candidate.raw,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: AllocationSizes::new(MEMORY_BLOCK_BYTES, MEMORY_BLOCK_BYTES)
                .with_max_device_memblock_size(MAX_MEMORY_BLOCK_BYTES)
                .with_max_host_memblock_size(MAX_MEMORY_BLOCK_BYTES),
        })
        .map_err(|source| GpuError::Allocator { device: name, source })?;
        device.allocator = Some(Arc::new(Mutex::new(allocator)));
        device.set_name(queue, "queue");
        Ok(Arc::new(device))
    }

    /// The name that validation messages, RenderDoc and profilers show. A failure only costs the name.
    pub(crate) fn set_name<T: vk::Handle>(&self, object: T, name: &str) {
        let (Some(names), Ok(name)) = (&self.names, CString::new(name)) else { return };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(&name);
        // SAFETY: `object` is alive and was made from this device.
        let _ = with_device_list(|| unsafe { names.set_debug_utils_object_name(&info) });
    }

    /// Debug-label functions, where the loader offers them.
    pub(super) fn labels(&self) -> Option<&ext::debug_utils::Device> {
        self.names.as_ref()
    }

    pub(super) fn with_allocator<R>(&self, work: impl FnOnce(&mut Allocator) -> R) -> R {
        work(&mut self.allocator().lock().unwrap_or_else(std::sync::PoisonError::into_inner))
    }

    /// The queue, for as long as `work` takes.
    pub(crate) fn with_queue<R>(&self, work: impl FnOnce(vk::Queue) -> R) -> R {
        work(*self.queue.lock().unwrap_or_else(std::sync::PoisonError::into_inner))
    }

    /// Whether the layer instruments kernels.
    pub(super) fn is_gpu_assisted(&self) -> bool {
        self.instance.validation.is_gpu_assisted()
    }

    /// For a renderer that allocates for itself; it must not outlive the device.
    pub(super) fn allocator(&self) -> &Arc<Mutex<Allocator>> {
        // invariant: `new` sets it before the device is shared, and only `drop` takes it.
        self.allocator.as_ref().expect("the allocator lives as long as the device")
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: every object holds the device alive, so none is left, and waiting ends all work.
        unsafe {
            // A lost device cannot be waited for; destroying it is still right. One without hardware has nothing to
            // wait for, and RADV of Mesa 22.3 crashes waiting.
            if self.capture.is_none() {
                let _ = self.raw.device_wait_idle();
            }
            self.cache.destroy(&self.raw);
            drop(self.allocator.take());
            with_device_list(|| self.raw.destroy_device(None));
        }
    }
}
