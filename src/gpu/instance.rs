use std::ffi::c_char;
use std::sync::Arc;

use ash::{ext, vk};

use super::error::GpuError;
use super::layer::{Layer, LayerSetUp, SetUpBy, VALIDATION_LAYER, Validation, offers_extension};
use super::loader::with_device_list;
use super::messages::Messages;
use super::surface::SurfaceTarget;

/// # Errors
/// No loader, no such layer, or one whose checks cannot be set.
pub fn validation_layer() -> Result<Layer, GpuError> {
    // SAFETY: the loader library's initialisers are trusted like any system library's.
    let entry = unsafe { ash::Entry::load() }.map_err(GpuError::NoLoader)?;
    Layer::find(&entry)
}

/// The version asked for; build.rs says why.
pub(super) const API_VERSION: u32 = vk::API_VERSION_1_2;

/// A Vulkan instance with, where validation is on, a messenger that fills `messages`.
pub struct Instance {
    pub(super) raw: ash::Instance,
    pub(super) messages: Messages,
    pub(super) validation: Validation,
    pub(super) has_debug_utils: bool,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    // Holds the loader's library: dropped last.
    entry: ash::Entry,
}

impl Instance {
    /// # Errors
    /// No loader, no driver, a loader older than 1.2, or validation asked for without its layer.
    pub fn new(validation: Validation) -> Result<Arc<Self>, GpuError> {
        Self::with_extensions(validation, &[], Messages::default())
    }

    /// An instance that can show pictures in windows like `target`; it adds to `messages`.
    pub fn for_window(
        validation: Validation,
        target: &dyn SurfaceTarget,
        messages: &Messages,
    ) -> Result<Arc<Self>, GpuError> {
        let display = target.display_handle().map_err(|error| GpuError::NoWindow(error.to_string()))?;
        let extensions = ash_window::enumerate_required_extensions(display.as_raw())
            .map_err(GpuError::call(|| "find out how this platform shows pictures in windows"))?;
        Self::with_extensions(validation, extensions, messages.clone())
    }

    fn with_extensions(
        validation: Validation,
        extensions: &[*const c_char],
        messages: Messages,
    ) -> Result<Arc<Self>, GpuError> {
        // SAFETY: the loader library's initialisers are trusted like any system library's.
        let entry = unsafe { ash::Entry::load() }.map_err(GpuError::NoLoader)?;
        check_loader_version(&entry)?;
        let has_debug_utils = offers_extension(&entry, None, ext::debug_utils::NAME)?;
        let layer = match validation {
            Validation::Off => None,
            _ if !has_debug_utils => return Err(GpuError::NoValidationExtension("VK_EXT_debug_utils")),
            _ => Some(Layer::find(&entry)?),
        };
        if let Some(layer) = &layer {
            messages.set_layer_version(layer.spec_version);
        }

        let raw = create(&entry, layer.as_ref(), validation, has_debug_utils, extensions, &messages)?;
        let mut instance = Self { raw, messages, validation, has_debug_utils, messenger: None, entry };
        if validation != Validation::Off {
            let debug_utils = ext::debug_utils::Instance::new(&instance.entry, &instance.raw);
            // SAFETY: the list behind the messenger lives in `instance`, which destroys the messenger first.
            let messenger =
                unsafe { debug_utils.create_debug_utils_messenger(&instance.messages.messenger_info(), None) }
                    .map_err(GpuError::call(|| "create the debug messenger"))?;
            instance.messenger = Some((debug_utils, messenger));
        }
        Ok(Arc::new(instance))
    }

    pub(super) fn entry(&self) -> &ash::Entry {
        &self.entry
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: every device holds the instance alive, so nothing made from it is left.
        unsafe {
            if let Some((debug_utils, messenger)) = self.messenger.take() {
                debug_utils.destroy_debug_utils_messenger(messenger, None);
            }
            with_device_list(|| self.raw.destroy_instance(None));
        }
    }
}

fn check_loader_version(entry: &ash::Entry) -> Result<(), GpuError> {
    // SAFETY: the entry is loaded.
    let version = unsafe { entry.try_enumerate_instance_version() }
        .map_err(GpuError::call(|| "ask the Vulkan loader for its version"))?
        .unwrap_or(vk::API_VERSION_1_0);
    if version < API_VERSION { Err(GpuError::OldLoader(version_text(version))) } else { Ok(()) }
}

fn create(
    entry: &ash::Entry,
    layer: Option<&Layer>,
    validation: Validation,
    has_debug_utils: bool,
    extensions: &[*const c_char],
    messages: &Messages,
) -> Result<ash::Instance, GpuError> {
    let application =
        vk::ApplicationInfo::default().application_name(c"zerkalo").engine_name(c"zerkalo").api_version(API_VERSION);
    let mut extensions = extensions.to_vec();
    let mut layers = Vec::new();
    if has_debug_utils {
        extensions.push(ext::debug_utils::NAME.as_ptr());
    }
    if let Some(layer) = layer {
        extensions.push(layer.set_up_by.extension().as_ptr());
        layers.push(VALIDATION_LAYER.as_ptr());
    }

    let set_up = layer.map(|layer| LayerSetUp::new(layer, validation));
    let settings = set_up.as_ref().map(LayerSetUp::settings).unwrap_or_default();
    let mut settings = vk::LayerSettingsCreateInfoEXT::default().settings(&settings);
    let mut features = set_up.as_ref().map(LayerSetUp::features).unwrap_or_default();
    // Chained here as well, so that creating and destroying the instance are under validation too.
    let mut messenger = messages.messenger_info();

    let mut info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_extension_names(&extensions)
        .enabled_layer_names(&layers);
    if let Some(layer) = layer {
        info = match layer.set_up_by {
            SetUpBy::LayerSettings => info.push_next(&mut settings),
            SetUpBy::ValidationFeatures => info.push_next(&mut features),
        };
        info = info.push_next(&mut messenger);
    }
    // SAFETY: all that `info` points to lives until the call returns.
    with_device_list(|| unsafe { entry.create_instance(&info, None) }).map_err(|result| match result {
        vk::Result::ERROR_INCOMPATIBLE_DRIVER => GpuError::NoDriver,
        vk::Result::ERROR_EXTENSION_NOT_PRESENT => {
            GpuError::NoWindow("the Vulkan loader and its drivers know no windows of this platform".to_owned())
        }
        result => GpuError::Call { operation: "create the Vulkan instance".into(), result },
    })
}

pub(super) fn version_text(version: u32) -> String {
    format!("{}.{}.{}", vk::api_version_major(version), vk::api_version_minor(version), vk::api_version_patch(version))
}
