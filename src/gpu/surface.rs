//! What a window offers for showing pictures in it.

use std::sync::Arc;

use ash::{khr, vk};
use raw_window_handle::{HasDisplayHandle, HasWindowHandle};

use super::device::Device;
use super::error::GpuError;
use super::instance::Instance;
use super::loader::with_device_list;

/// A window, by what the platform calls it.
pub trait SurfaceTarget: HasWindowHandle + HasDisplayHandle + Send + Sync {}

impl<T: HasWindowHandle + HasDisplayHandle + Send + Sync> SurfaceTarget for T {}

/// A window's surface; it keeps the window alive.
pub struct Surface {
    pub(crate) raw: vk::SurfaceKHR,
    functions: khr::surface::Instance,
    // Destroyed after the surface: the specification asks for both.
    instance: Arc<Instance>,
    _target: Arc<dyn SurfaceTarget>,
}

impl Surface {
    /// The instance must be [for such windows](Instance::for_window).
    pub fn new(instance: &Arc<Instance>, target: &Arc<dyn SurfaceTarget>) -> Result<Self, GpuError> {
        let no_handle = |error: raw_window_handle::HandleError| GpuError::NoWindow(error.to_string());
        let display = target.display_handle().map_err(no_handle)?.as_raw();
        let window = target.window_handle().map_err(no_handle)?.as_raw();
        // SAFETY: the surface keeps the instance and the window alive; the handles are one window's.
        let raw = unsafe { ash_window::create_surface(instance.entry(), &instance.raw, display, window, None) }
            .map_err(GpuError::call(|| "create the window's surface"))?;
        Ok(Self {
            raw,
            functions: khr::surface::Instance::new(instance.entry(), &instance.raw),
            instance: instance.clone(),
            _target: target.clone(),
        })
    }

    pub(super) fn is_served_by(&self, device: vk::PhysicalDevice, queue_family: usize) -> bool {
        // SAFETY: the device is of the surface's instance and has the family.
        let served =
            unsafe { self.functions.get_physical_device_surface_support(device, queue_family as u32, self.raw) };
        served.unwrap_or(false)
    }

    pub(super) fn instance(&self) -> &Arc<Instance> {
        &self.instance
    }
}

/// What the device and a window's surface offer each other.
impl Device {
    pub(crate) fn surface_capabilities(&self, surface: &Surface) -> Result<vk::SurfaceCapabilitiesKHR, GpuError> {
        // SAFETY: device and surface are of one instance.
        unsafe { surface.functions.get_physical_device_surface_capabilities(self.physical, surface.raw) }
            .map_err(GpuError::call(|| "ask for the window's capabilities"))
    }

    pub(crate) fn surface_formats(&self, surface: &Surface) -> Result<Vec<vk::SurfaceFormatKHR>, GpuError> {
        // SAFETY: as above.
        unsafe { surface.functions.get_physical_device_surface_formats(self.physical, surface.raw) }
            .map_err(GpuError::call(|| "list the window's formats"))
    }

    pub(crate) fn present_modes(&self, surface: &Surface) -> Result<Vec<vk::PresentModeKHR>, GpuError> {
        // SAFETY: as above.
        unsafe { surface.functions.get_physical_device_surface_present_modes(self.physical, surface.raw) }
            .map_err(GpuError::call(|| "list the window's ways of showing pictures"))
    }

    pub(crate) fn swapchain_functions(&self) -> khr::swapchain::Device {
        with_device_list(|| khr::swapchain::Device::new(&self.instance.raw, &self.raw))
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: its swapchains hold the surface alive, so none is left.
        unsafe { self.functions.destroy_surface(self.raw, None) };
    }
}
