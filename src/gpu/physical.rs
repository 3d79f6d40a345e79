//! The devices of the machine, what each lacks, and which one is taken.

use std::ffi::CStr;

use ash::{khr, vk};
use serde::Serialize;

use super::error::GpuError;
use super::float_controls::FloatControls;
use super::instance::{API_VERSION, Instance, version_text};
use super::loader::with_device_list;
use super::surface::Surface;

/// Kind of device, best first: the order in which one is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum DeviceKind {
    /// A GPU apart from the host, usually with memory of its own.
    Discrete,
    /// A GPU that is a part of the host.
    Integrated,
    /// A GPU of a virtual machine.
    Virtual,
    /// The host's own processor, by a driver such as Mesa's lavapipe.
    Cpu,
    /// Any that Vulkan has no kind for.
    Other,
}

impl DeviceKind {
    fn from_vulkan(kind: vk::PhysicalDeviceType) -> Self {
        match kind {
            vk::PhysicalDeviceType::DISCRETE_GPU => Self::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => Self::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => Self::Virtual,
            vk::PhysicalDeviceType::CPU => Self::Cpu,
            _ => Self::Other,
        }
    }

    /// As JSON and lists of devices have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Cpu => "cpu",
            Self::Other => "other",
        }
    }
}

/// A device as people and programs see it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DeviceDescription {
    /// Index in the loader's list; what `--device INDEX` takes.
    pub index: usize,
    /// As the driver gives it; two devices may share one.
    pub name: String,
    /// As the driver classes it.
    pub kind: DeviceKind,
    /// Driver name and version text, as the driver gives them.
    pub driver: String,
    /// Vulkan's version that the device offers, as `1.3.239`.
    pub api_version: String,
    /// Whether GPU time can be measured.
    pub timestamps: bool,
    /// Largest picture side in one tile, pixels.
    pub max_image_side: u32,
    /// Largest storage buffer that a kernel can see, bytes.
    pub max_storage_bytes: u64,
    /// Texels of the largest texel buffer.
    pub max_texels: u64,
    /// Whether kernels can calculate in `f64`.
    pub float64: bool,
    /// Whether a kernel's invocations come by eights that can hand each other numbers, as on a CPU driver with AVX.
    pub packets: bool,
    /// All that it lacks; empty when it can be used.
    pub lacks: Vec<String>,
}

/// A physical device with the queue family to use.
#[derive(Clone)]
pub(super) struct Candidate {
    pub raw: vk::PhysicalDevice,
    pub description: DeviceDescription,
    pub features: Features,
    pub float_controls: [FloatControls; 2],
    pub queue_family: u32,
    pub timestamp_valid_bits: u32,
    pub timestamp_period_ns: f32,
    /// vendorID, deviceID, pipelineCacheUUID: what a pipeline cache is good for.
    pub cache_identity: ([u32; 2], [u8; vk::UUID_SIZE]),
}

/// What a device offers, or is asked for, beyond what every one has.
#[derive(Clone, Copy, Default)]
pub(super) struct Features {
    pub of_1_0: vk::PhysicalDeviceFeatures,
    /// It chains no other.
    pub of_1_2: vk::PhysicalDeviceVulkan12Features<'static>,
}

impl Features {
    /// # Safety
    /// `raw` comes from the instance, and is of Vulkan 1.2.
    unsafe fn offered(instance: &Instance, raw: vk::PhysicalDevice) -> Self {
        let mut of_1_2 = vk::PhysicalDeviceVulkan12Features::default();
        let mut offered = vk::PhysicalDeviceFeatures2::default().push_next(&mut of_1_2);
        // SAFETY: as promised; the structures live through the call.
        unsafe { instance.raw.get_physical_device_features2(raw, &mut offered) };
        Self { of_1_0: offered.features, of_1_2 }
    }

    /// Those of them that kernels use.
    ///
    /// Reads beyond buffers are kept harmless in debug builds, where `view --watch` runs kernels that nobody has
    /// tested. The program's own are tested by GPU-assisted validation; theirs it would cost 0.2 to 0.8 % of a frame
    /// (lavapipe of Mesa 22.3, medians of five pairs: showcase 1.002, 100 boxes 1.008, 10000 solids 1.006).
    pub fn of_kernels(&self) -> Self {
        let of_1_0 = vk::PhysicalDeviceFeatures::default()
            .shader_float64(self.of_1_0.shader_float64 == vk::TRUE)
            .robust_buffer_access(cfg!(debug_assertions));
        Self { of_1_0, ..Self::default() }
    }

    /// Those, and what the layer's code in instrumented kernels uses: it would force them on by itself, and warn of
    /// that.
    pub fn of_instrumented_kernels(&self) -> Self {
        let mut features = self.of_kernels();
        let (of_1_0, of_1_2) = (&mut features.of_1_0, &mut features.of_1_2);
        of_1_0.fragment_stores_and_atomics = self.of_1_0.fragment_stores_and_atomics;
        of_1_0.vertex_pipeline_stores_and_atomics = self.of_1_0.vertex_pipeline_stores_and_atomics;
        of_1_0.shader_int64 = self.of_1_0.shader_int64;
        of_1_2.timeline_semaphore = self.of_1_2.timeline_semaphore;
        of_1_2.vulkan_memory_model = self.of_1_2.vulkan_memory_model;
        of_1_2.vulkan_memory_model_device_scope = self.of_1_2.vulkan_memory_model_device_scope;
        of_1_2.buffer_device_address = self.of_1_2.buffer_device_address;
        of_1_2.storage_buffer8_bit_access = self.of_1_2.storage_buffer8_bit_access;
        of_1_2.uniform_and_storage_buffer8_bit_access = self.of_1_2.uniform_and_storage_buffer8_bit_access;
        features
    }
}

/// With a surface, what a device lacks for showing pictures in that window counts too.
pub(super) fn list(instance: &Instance, surface: Option<&Surface>) -> Result<Vec<Candidate>, GpuError> {
    // SAFETY: the instance is alive.
    let devices =
        with_device_list(|| unsafe { instance.raw.enumerate_physical_devices() }).map_err(|result| match result {
            // What a driver without its hardware answers.
            vk::Result::ERROR_INITIALIZATION_FAILED => GpuError::NoDriver,
            result => GpuError::Call { operation: "list the Vulkan devices".into(), result },
        })?;
    Ok(devices.into_iter().enumerate().map(|(index, raw)| inspect(instance, surface, index, raw)).collect())
}

fn inspect(instance: &Instance, surface: Option<&Surface>, index: usize, raw: vk::PhysicalDevice) -> Candidate {
    // SAFETY: `raw` comes from this instance. The 1.2 structure is only chained where the device knows it.
    let (properties, families, of_1_2) = unsafe {
        let properties = instance.raw.get_physical_device_properties(raw);
        let families = instance.raw.get_physical_device_queue_family_properties(raw);
        let of_1_2 = (properties.api_version >= vk::API_VERSION_1_2).then(|| {
            let mut driver = vk::PhysicalDeviceDriverProperties::default();
            let mut floats = vk::PhysicalDeviceFloatControlsProperties::default();
            let mut subgroups = vk::PhysicalDeviceSubgroupProperties::default();
            let mut properties2 = vk::PhysicalDeviceProperties2::default()
                .push_next(&mut driver)
                .push_next(&mut floats)
                .push_next(&mut subgroups);
            instance.raw.get_physical_device_properties2(raw, &mut properties2);
            let driver = format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str()));
            (driver, FloatControls::of(&floats), subgroups_are_packets(&subgroups), Features::offered(instance, raw))
        });
        (properties, families, of_1_2)
    };

    let mut lacks = Vec::new();
    if properties.api_version < API_VERSION {
        lacks.push(format!("Vulkan 1.2 (it offers {})", version_text(properties.api_version)));
    }
    let can = |&family: &usize, what| families[family].queue_flags.contains(what);
    let has_timestamps = |&family: &usize| families[family].timestamp_valid_bits > 0;
    let mut able: Vec<usize> = (0..families.len()).filter(|family| can(family, vk::QueueFlags::COMPUTE)).collect();
    if able.is_empty() {
        lacks.push("a queue that can compute".to_owned());
    }
    if let Some(surface) = surface {
        if !offers(instance, raw, khr::swapchain::NAME) {
            lacks.push("VK_KHR_swapchain".to_owned());
        }
        // The widgets are drawn by the graphics pipeline, in the queue that traces: one for all needs no hand-over.
        able.retain(|family| can(family, vk::QueueFlags::GRAPHICS) && surface.is_served_by(raw, *family));
        if able.is_empty() {
            lacks.push("a queue that can compute, draw and show pictures in this window".to_owned());
        }
    }
    let queue_family = able.iter().copied().find(has_timestamps).or(able.first().copied());

    let (driver, float_controls, has_packets, features) = match of_1_2 {
        Some((driver, controls, packets, features)) => (driver, controls, packets, features),
        None => (format!("version {:#x}", properties.driver_version), Default::default(), false, Features::default()),
    };
    let kind = DeviceKind::from_vulkan(properties.device_type);
    let timestamp_valid_bits = queue_family.map_or(0, |family| families[family].timestamp_valid_bits);
    Candidate {
        raw,
        description: DeviceDescription {
            index,
            name: text(properties.device_name_as_c_str()),
            kind,
            driver: driver.trim().to_owned(),
            api_version: version_text(properties.api_version),
            timestamps: timestamp_valid_bits > 0,
            max_image_side: properties.limits.max_image_dimension2_d,
            max_storage_bytes: properties.limits.max_storage_buffer_range.into(),
            max_texels: properties.limits.max_texel_buffer_elements.into(),
            float64: features.of_1_0.shader_float64 == vk::TRUE,
            // Elsewhere a subgroup of eight may be a part of what a GPU does at once, and not all of it there.
            packets: has_packets && kind == DeviceKind::Cpu,
            lacks,
        },
        features,
        float_controls,
        queue_family: queue_family.unwrap_or(0) as u32,
        timestamp_valid_bits,
        timestamp_period_ns: properties.limits.timestamp_period,
        cache_identity: ([properties.vendor_id, properties.device_id], properties.pipeline_cache_uuid),
    }
}

fn subgroups_are_packets(subgroups: &vk::PhysicalDeviceSubgroupProperties) -> bool {
    subgroups.subgroup_size == 8
        && subgroups.supported_stages.contains(vk::ShaderStageFlags::COMPUTE)
        && subgroups.supported_operations.contains(vk::SubgroupFeatureFlags::SHUFFLE)
}

fn offers(instance: &Instance, raw: vk::PhysicalDevice, name: &CStr) -> bool {
    // SAFETY: `raw` comes from this instance.
    let extensions = unsafe { instance.raw.enumerate_device_extension_properties(raw) }.unwrap_or_default();
    extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name))
}

/// Whether a device of this instance tells what it compiles kernels to.
pub(super) fn tells_of_kernels(instance: &Instance, raw: vk::PhysicalDevice) -> bool {
    if !offers(instance, raw, khr::pipeline_executable_properties::NAME) {
        return false;
    }
    let mut of_kernels = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default();
    let mut offered = vk::PhysicalDeviceFeatures2::default().push_next(&mut of_kernels);
    // SAFETY: `raw` comes from this instance; the structures live through the call.
    unsafe { instance.raw.get_physical_device_features2(raw, &mut offered) };
    of_kernels.pipeline_executable_info == vk::TRUE
}

fn text<E>(name: Result<&CStr, E>) -> String {
    name.map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Index of the device to use.
///
/// `wanted` is a number of the list or part of a name, upper and lower case alike; without it the best kind wins,
/// and the first of that kind.
///
/// # Errors
/// Nothing fits; the error lists every device and all that each lacks.
pub fn choose(devices: &[DeviceDescription], wanted: Option<&str>) -> Result<usize, GpuError> {
    if devices.is_empty() {
        return Err(GpuError::NoDriver);
    }
    let best = |fits: &dyn Fn(&DeviceDescription) -> bool| {
        let usable = devices.iter().filter(|device| fits(device) && device.lacks.is_empty());
        usable.min_by_key(|device| (device.kind, device.index)).map(|device| device.index)
    };

    let Some(wanted) = wanted else {
        return best(&|_| true).ok_or_else(|| GpuError::NoSuitableDevice(listed(devices)));
    };
    // A number too large for an index may be part of a name, such as "4070".
    let index = wanted.trim().parse().ok().filter(|&index: &usize| index < devices.len());
    let named = |device: &DeviceDescription| match index {
        Some(index) => device.index == index,
        None => device.name.to_lowercase().contains(&wanted.trim().to_lowercase()),
    };
    best(&named).ok_or_else(|| GpuError::WantedDevice {
        wanted: wanted.to_owned(),
        reason: if devices.iter().any(named) { "it lacks something" } else { "there is no such device" }.to_owned(),
        listed: listed(devices),
    })
}

fn listed(devices: &[DeviceDescription]) -> String {
    let line = |device: &DeviceDescription| {
        let state =
            if device.lacks.is_empty() { "usable".into() } else { format!("lacks {}", device.lacks.join(", ")) };
        format!("{} '{}' ({}): {state}", device.index, device.name, device.kind.name())
    };
    devices.iter().map(line).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device(index: usize, name: &str, kind: DeviceKind, lacks: &[&str]) -> DeviceDescription {
        DeviceDescription {
            index,
            name: name.to_owned(),
            kind,
            driver: String::new(),
            api_version: "1.2.0".to_owned(),
            timestamps: true,
            max_image_side: 16384,
            max_storage_bytes: 1 << 27,
            max_texels: 1 << 27,
            float64: true,
            packets: false,
            lacks: lacks.iter().map(|&lack| lack.to_owned()).collect(),
        }
    }

    fn machine() -> Vec<DeviceDescription> {
        vec![
            device(0, "llvmpipe", DeviceKind::Cpu, &[]),
            device(1, "Iris Xe", DeviceKind::Integrated, &[]),
            device(
                2,
                "GeForce Old",
                DeviceKind::Discrete,
                &["Vulkan 1.2 (it offers 1.1.0)", "a queue that can compute"],
            ),
            device(3, "Iris Pro", DeviceKind::Integrated, &[]),
        ]
    }

    #[test]
    fn best_usable_kind_wins_and_the_first_of_it() {
        assert_eq!(choose(&machine(), None).unwrap(), 1);
    }

    #[test]
    fn a_device_is_wanted_by_number_or_by_part_of_its_name() {
        assert_eq!(choose(&machine(), Some("0")).unwrap(), 0);
        assert_eq!(choose(&machine(), Some("LLVM")).unwrap(), 0);
        assert_eq!(choose(&machine(), Some("iris")).unwrap(), 1);
        assert_eq!(choose(&machine(), Some("iris pro")).unwrap(), 3);
    }

    #[test]
    fn a_number_too_large_for_an_index_is_part_of_a_name() {
        let devices = [device(0, "llvmpipe", DeviceKind::Cpu, &[]), device(1, "RTX 4070", DeviceKind::Discrete, &[])];
        assert_eq!(choose(&devices, Some("4070")).unwrap(), 1);
        assert_eq!(choose(&devices, Some("1")).unwrap(), 1);
    }

    #[test]
    fn a_refusal_lists_every_device_and_all_that_each_lacks() {
        for wanted in ["geforce", "2", "radeon", "9"] {
            let error = choose(&machine(), Some(wanted)).unwrap_err();
            assert!(error.is_input_error());
            let line = error.to_string();
            assert!(!line.contains('\n'));
            for part in ["'llvmpipe' (cpu): usable", "Iris Xe", "Iris Pro", "Vulkan 1.2 (it offers 1.1.0), a queue"] {
                assert!(line.contains(part), "{part} is missing in: {line}");
            }
        }
        let error = choose(&machine()[2..3], None).unwrap_err().to_string();
        assert!(error.contains("GeForce Old") && error.contains("a queue that can compute"), "{error}");
    }

    #[test]
    fn a_machine_without_devices_has_no_driver() {
        assert!(matches!(choose(&[], None), Err(GpuError::NoDriver)));
        assert!(matches!(choose(&[], Some("0")), Err(GpuError::NoDriver)));
    }
}
