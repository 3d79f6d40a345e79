use ash::vk;

/// What went wrong between the program and a Vulkan device. Each is one line.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// The loader's library is not there or cannot be loaded.
    #[error(
        "no Vulkan loader found ({0}); install it (Debian, Ubuntu: libvulkan1) with a driver (mesa-vulkan-drivers)"
    )]
    NoLoader(ash::LoadingError),

    /// The loader lists no device, or its driver answers that it has no hardware.
    #[error(
        "no Vulkan driver found; install one (Debian, Ubuntu: mesa-vulkan-drivers, which also serves machines without a GPU), or do without: zerkalo render SCENE --output OUT.png --algorithm reference"
    )]
    NoDriver,

    /// With the version that the loader has.
    #[error("the Vulkan loader offers only version {0}, and 1.2 is needed; update it (Debian, Ubuntu: libvulkan1)")]
    OldLoader(String),

    /// Validation was asked for where the layer is not installed.
    #[error(
        "validation was asked for, but the layer VK_LAYER_KHRONOS_validation is not installed (Debian, Ubuntu: vulkan-validationlayers)"
    )]
    NoValidationLayer,

    /// With the instance extension that is missing: for messages, or for setting the layer's checks.
    #[error("validation was asked for, but the Vulkan loader and its layer do not offer {0}")]
    NoValidationExtension(&'static str),

    /// With the reason, which lies in the platform, the display or the window.
    #[error("no picture can be shown in a window here: {0}")]
    NoWindow(String),

    /// No device has all that is needed; each is listed with all that it lacks.
    #[error("no suitable Vulkan device: {0}")]
    NoSuitableDevice(String),

    /// The device asked for by name or number does not exist or lacks something.
    #[error("device '{wanted}' cannot be used: {reason}; devices here: {listed}")]
    WantedDevice {
        /// As the user wrote it.
        wanted: String,
        /// Half a sentence.
        reason: String,
        /// Every device, with its number, name, kind and all that it lacks.
        listed: String,
    },

    /// A Vulkan call failed; `operation` names what was attempted and on which object.
    #[error("could not {operation}: {result:?}{}", hint(*.result))]
    Call {
        /// Follows "could not".
        operation: String,
        /// What Vulkan answered.
        result: vk::Result,
    },

    /// The allocator of an opened device could not be set up.
    #[error("could not manage the memory of device '{device}': {source}")]
    Allocator {
        /// The device's name.
        device: String,
        /// The allocator's own error.
        source: gpu_allocator::AllocationError,
    },

    /// There is no memory for a buffer or an image, or none of its kind.
    #[error("could not allocate {bytes} B of device memory for {object}: {source}")]
    Allocation {
        /// Its kind and name, as in `buffer 'pixels'`.
        object: String,
        /// As the driver asked for, so alignment is in it.
        bytes: u64,
        /// The allocator's own error.
        source: gpu_allocator::AllocationError,
    },

    /// The host wanted to see into memory that is the device's alone, as of [pixels](super::BufferKind::Pixels).
    #[error("{object} cannot be mapped for reading or writing by the host")]
    NotMapped {
        /// Its kind and name, as in `buffer 'pixels'`.
        object: String,
    },
}

impl GpuError {
    /// For `map_err`: `.map_err(GpuError::call(|| format!("create buffer '{name}'")))`.
    pub fn call<S: Into<String>>(operation: impl FnOnce() -> S) -> impl FnOnce(vk::Result) -> GpuError {
        move |result| GpuError::Call { operation: operation().into(), result }
    }

    /// Whether the device is gone, which a new one may mend.
    pub fn is_device_lost(&self) -> bool {
        matches!(self, Self::Call { result: vk::Result::ERROR_DEVICE_LOST, .. })
    }

    /// Whether the user's choice is at fault rather than the machine.
    pub fn is_input_error(&self) -> bool {
        matches!(self, GpuError::WantedDevice { .. })
    }
}

fn hint(result: vk::Result) -> &'static str {
    match result {
        vk::Result::ERROR_DEVICE_LOST => " (the device was reset or removed; see the system's log, and try again)",
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY => " (the device's memory is full)",
        vk::Result::ERROR_OUT_OF_HOST_MEMORY => " (the machine's memory is full)",
        _ => "",
    }
}
