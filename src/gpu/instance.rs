use std::ffi::{CStr, c_char};
use std::sync::Arc;

use ash::{ext, vk};
use serde::Serialize;

use super::error::GpuError;
use super::messages::Messages;
use super::surface::SurfaceTarget;

/// How much the validation layer checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Validation {
    #[default]
    Off,
    /// Core and synchronization checks.
    Core,
    /// Core, synchronization and GPU-assisted checks; the last find out-of-bounds accesses and cost much time.
    GpuAssisted,
    /// Core, synchronization and best-practices checks.
    BestPractices,
}

impl Validation {
    /// What is watched besides core and synchronization.
    pub fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Core => "core",
            Self::GpuAssisted => "GPU-assisted",
            Self::BestPractices => "best practices",
        }
    }
}

/// The validation layer as it is installed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Layer {
    pub name: String,
    /// Of the Vulkan specification that it checks against.
    pub version: String,
    /// Its own number.
    pub implementation: u32,
}

/// # Errors
/// No loader, or no such layer.
pub fn validation_layer() -> Result<Layer, GpuError> {
    // SAFETY: the loader library's initialisers are trusted like any system library's.
    let entry = unsafe { ash::Entry::load() }.map_err(GpuError::NoLoader)?;
    find_validation_layer(&entry)
}

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// The version asked for; build.rs says why.
pub(super) const API_VERSION: u32 = vk::API_VERSION_1_2;

/// A Vulkan instance with, where validation is on, a messenger that fills `messages`.
pub struct Instance {
    pub(super) raw: ash::Instance,
    pub(super) messages: Messages,
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
        if validation != Validation::Off {
            check_validation(&entry, has_debug_utils)?;
        }

        let raw = create(&entry, validation, has_debug_utils, extensions, &messages)?;
        let mut instance = Self { raw, messages, has_debug_utils, messenger: None, entry };
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
            self.raw.destroy_instance(None);
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

fn offers_extension(entry: &ash::Entry, layer: Option<&CStr>, wanted: &CStr) -> Result<bool, GpuError> {
    // SAFETY: the entry is loaded.
    let extensions = unsafe { entry.enumerate_instance_extension_properties(layer) }
        .map_err(GpuError::call(|| "list the instance extensions"))?;
    Ok(extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(wanted)))
}

fn find_validation_layer(entry: &ash::Entry) -> Result<Layer, GpuError> {
    // SAFETY: the entry is loaded.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .map_err(GpuError::call(|| "list the instance layers"))?;
    let layer = layers.iter().find(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    let layer = layer.ok_or(GpuError::NoValidationLayer)?;
    Ok(Layer {
        name: VALIDATION_LAYER.to_string_lossy().into_owned(),
        version: version_text(layer.spec_version),
        implementation: layer.implementation_version,
    })
}

fn check_validation(entry: &ash::Entry, has_debug_utils: bool) -> Result<(), GpuError> {
    find_validation_layer(entry)?;
    if !has_debug_utils {
        return Err(GpuError::NoValidationExtension("VK_EXT_debug_utils"));
    }
    if !offers_extension(entry, Some(VALIDATION_LAYER), ext::validation_features::NAME)? {
        return Err(GpuError::NoValidationExtension("VK_EXT_validation_features"));
    }
    Ok(())
}

fn create(
    entry: &ash::Entry,
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
    if validation != Validation::Off {
        extensions.push(ext::validation_features::NAME.as_ptr());
        layers.push(VALIDATION_LAYER.as_ptr());
    }

    let mut checks = vec![vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    match validation {
        Validation::Off | Validation::Core => {}
        Validation::GpuAssisted => {
            checks.push(vk::ValidationFeatureEnableEXT::GPU_ASSISTED);
            checks.push(vk::ValidationFeatureEnableEXT::GPU_ASSISTED_RESERVE_BINDING_SLOT);
        }
        Validation::BestPractices => checks.push(vk::ValidationFeatureEnableEXT::BEST_PRACTICES),
    }
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&checks);
    // Chained here as well, so that creating and destroying the instance are under validation too.
    let mut messenger = messages.messenger_info();

    let mut info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_extension_names(&extensions)
        .enabled_layer_names(&layers);
    if validation != Validation::Off {
        info = info.push_next(&mut features).push_next(&mut messenger);
    }
    // SAFETY: all that `info` points to lives until the call returns.
    unsafe { entry.create_instance(&info, None) }.map_err(|result| match result {
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
