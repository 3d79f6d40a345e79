//! The validation layer: what it is asked to check, and by which extension.

use std::ffi::{CStr, c_char};
use std::fmt;

use ash::{ext, vk};
use serde::Serialize;

use super::error::GpuError;
use super::instance::version_text;

/// What the validation layer checks in a run.
///
/// The kinds are apart because the layer's own advice is so: together they are slow, and current layers say that as a
/// warning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Validation {
    /// Without the layer; only the recorder's own book of hazards is kept.
    #[default]
    Off,
    /// Calls against the specification, and synchronization.
    Core,
    /// Accesses of kernels beyond what is bound: the layer instruments the kernels, which compile many times as long.
    GpuAssisted,
    /// What is allowed and unwise.
    BestPractices,
    /// Everything at once, for runs that cannot be repeated.
    All,
}

impl Validation {
    /// As reports and messages have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Core => "core",
            Self::GpuAssisted => "GPU-assisted",
            Self::BestPractices => "best practices",
            Self::All => "all",
        }
    }

    pub(super) fn is_gpu_assisted(self) -> bool {
        matches!(self, Self::GpuAssisted | Self::All)
    }

    /// What is on besides that which the layer does unasked, and what of the latter is off.
    fn switches(self) -> (&'static [Switch], &'static [Switch]) {
        match self {
            Self::Off => (&[], &[]),
            Self::Core => (&[SYNCHRONIZATION], &[]),
            Self::GpuAssisted => (&[GPU_ASSISTED, RESERVE_BINDING_SLOT], &[CORE_CHECKS]),
            Self::BestPractices => (&[BEST_PRACTICES], &[CORE_CHECKS]),
            Self::All => (&[SYNCHRONIZATION, GPU_ASSISTED, RESERVE_BINDING_SLOT, BEST_PRACTICES], &[]),
        }
    }
}

/// A check by its number in `VK_EXT_validation_features` and its name in `VK_EXT_layer_settings`: of the lists
/// `enables` and `disables`, which every layer since 1.3.268 knows, while the names of single settings have changed.
#[derive(Clone, Copy)]
struct Switch {
    feature: i32,
    setting: &'static CStr,
}

const SYNCHRONIZATION: Switch = Switch {
    feature: vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION.as_raw(),
    setting: c"VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT",
};
const GPU_ASSISTED: Switch = Switch {
    feature: vk::ValidationFeatureEnableEXT::GPU_ASSISTED.as_raw(),
    setting: c"VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT",
};
const RESERVE_BINDING_SLOT: Switch = Switch {
    feature: vk::ValidationFeatureEnableEXT::GPU_ASSISTED_RESERVE_BINDING_SLOT.as_raw(),
    setting: c"VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT",
};
const BEST_PRACTICES: Switch = Switch {
    feature: vk::ValidationFeatureEnableEXT::BEST_PRACTICES.as_raw(),
    setting: c"VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT",
};
const CORE_CHECKS: Switch = Switch {
    feature: vk::ValidationFeatureDisableEXT::CORE_CHECKS.as_raw(),
    setting: c"VK_VALIDATION_FEATURE_DISABLE_CORE_CHECKS_EXT",
};

/// The extension that sets the layer's checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum SetUpBy {
    /// Takes single settings as well as lists of checks; preferred where the layer offers both.
    #[serde(rename = "VK_EXT_layer_settings")]
    LayerSettings,
    /// Takes nothing but lists of checks.
    #[serde(rename = "VK_EXT_validation_features")]
    ValidationFeatures,
}

impl SetUpBy {
    pub(super) fn extension(self) -> &'static CStr {
        match self {
            Self::LayerSettings => ext::layer_settings::NAME,
            Self::ValidationFeatures => ext::validation_features::NAME,
        }
    }

    /// The extension's, as Vulkan writes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::LayerSettings => "VK_EXT_layer_settings",
            Self::ValidationFeatures => "VK_EXT_validation_features",
        }
    }
}

/// The validation layer as it is installed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Layer {
    /// As the loader lists it, `VK_LAYER_KHRONOS_validation`.
    pub name: String,
    /// Version of the Vulkan specification that it checks against.
    pub version: String,
    /// Its own number.
    pub implementation: u32,
    /// The first of both extensions that the layer offers.
    pub set_up_by: SetUpBy,
    /// `version` as Vulkan encodes it.
    #[serde(skip)]
    pub(super) spec_version: u32,
}

pub(super) const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

impl Layer {
    /// # Errors
    /// There is no such layer, or it takes settings by neither extension.
    pub(super) fn find(entry: &ash::Entry) -> Result<Self, GpuError> {
        // SAFETY: the entry is loaded.
        let layers = unsafe { entry.enumerate_instance_layer_properties() }
            .map_err(GpuError::call(|| "list the instance layers"))?;
        let layer = layers.iter().find(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
        let layer = layer.ok_or(GpuError::NoValidationLayer)?;
        let set_up_by = [SetUpBy::LayerSettings, SetUpBy::ValidationFeatures];
        for set_up_by in set_up_by {
            if offers_extension(entry, Some(VALIDATION_LAYER), set_up_by.extension())? {
                return Ok(Self {
                    name: VALIDATION_LAYER.to_string_lossy().into_owned(),
                    version: version_text(layer.spec_version),
                    implementation: layer.implementation_version,
                    set_up_by,
                    spec_version: layer.spec_version,
                });
            }
        }
        Err(GpuError::NoValidationExtension("VK_EXT_layer_settings or VK_EXT_validation_features"))
    }

    /// For tests and examples.
    pub fn named(name: &str, [major, minor, patch]: [u32; 3], set_up_by: SetUpBy) -> Self {
        let spec_version = vk::make_api_version(0, major, minor, patch);
        let version = version_text(spec_version);
        Self { name: name.to_owned(), version, implementation: 1, set_up_by, spec_version }
    }
}

impl fmt::Display for Layer {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, version, implementation, set_up_by, spec_version: _ } = self;
        write!(formatter, "{name} {version}, implementation {implementation}, set up by {}", set_up_by.name())
    }
}

/// Whether the loader, or a layer, has an instance extension.
pub(super) fn offers_extension(entry: &ash::Entry, layer: Option<&CStr>, wanted: &CStr) -> Result<bool, GpuError> {
    // SAFETY: the entry is loaded.
    let extensions = unsafe { entry.enumerate_instance_extension_properties(layer) }
        .map_err(GpuError::call(|| "list the instance extensions"))?;
    Ok(extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(wanted)))
}

/// Settings of the layer, in the arrays that the structures of either extension point to.
pub(super) struct LayerSetUp {
    enabled: Vec<vk::ValidationFeatureEnableEXT>,
    disabled: Vec<vk::ValidationFeatureDisableEXT>,
    enables: Vec<*const c_char>,
    disables: Vec<*const c_char>,
    off: vk::Bool32,
    has_ray_query_setting: bool,
}

/// Since when `gpuav_validate_ray_query` has that name, as far as was tested. The layer warns where it is on and the
/// device has no ray queries, which no kernel here makes.
const RAY_QUERY_SETTING_SINCE: u32 = vk::make_api_version(0, 1, 4, 309);

impl LayerSetUp {
    pub fn new(layer: &Layer, validation: Validation) -> Self {
        let (on, off) = validation.switches();
        Self {
            enabled: on.iter().map(|switch| vk::ValidationFeatureEnableEXT::from_raw(switch.feature)).collect(),
            disabled: off.iter().map(|switch| vk::ValidationFeatureDisableEXT::from_raw(switch.feature)).collect(),
            enables: on.iter().map(|switch| switch.setting.as_ptr()).collect(),
            disables: off.iter().map(|switch| switch.setting.as_ptr()).collect(),
            off: vk::FALSE,
            has_ray_query_setting: validation.is_gpu_assisted() && layer.spec_version >= RAY_QUERY_SETTING_SINCE,
        }
    }

    /// For [`SetUpBy::ValidationFeatures`].
    pub fn features(&self) -> vk::ValidationFeaturesEXT<'_> {
        vk::ValidationFeaturesEXT::default()
            .enabled_validation_features(&self.enabled)
            .disabled_validation_features(&self.disabled)
    }

    /// For [`SetUpBy::LayerSettings`].
    pub fn settings(&self) -> Vec<vk::LayerSettingEXT<'_>> {
        // By default the layer is silent after ten messages of one id, and so would be their count.
        let mut settings = vec![self.is_off(c"enable_message_limit")];
        // A list is replaced whole, and an empty one means nothing.
        for (name, values) in [(c"enables", &self.enables), (c"disables", &self.disables)] {
            if !values.is_empty() {
                settings.push(vk::LayerSettingEXT {
                    value_count: values.len() as u32,
                    p_values: values.as_ptr().cast(),
                    ..setting(name, vk::LayerSettingTypeEXT::STRING)
                });
            }
        }
        if self.has_ray_query_setting {
            settings.push(self.is_off(c"gpuav_validate_ray_query"));
        }
        settings
    }

    fn is_off(&self, name: &'static CStr) -> vk::LayerSettingEXT<'_> {
        vk::LayerSettingEXT {
            value_count: 1,
            p_values: (&raw const self.off).cast(),
            ..setting(name, vk::LayerSettingTypeEXT::BOOL32)
        }
    }
}

fn setting(name: &'static CStr, ty: vk::LayerSettingTypeEXT) -> vk::LayerSettingEXT<'static> {
    vk::LayerSettingEXT::default().layer_name(VALIDATION_LAYER).setting_name(name).ty(ty)
}
