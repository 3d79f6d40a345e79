//! The devices of the machine, tested.

use serde::Serialize;

use super::{Arithmetic, Device, DeviceDescription, FloatWidth, GpuError, Validation, arithmetic, devices};

/// A device with what its arithmetic was found to be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TriedDevice {
    /// Also of a device that cannot be used.
    #[serde(flatten)]
    pub description: DeviceDescription,
    /// `None` where the device cannot be used, or has no such numbers.
    pub f32_arithmetic: Option<Arithmetic>,
    /// As of `f32_arithmetic`.
    pub f64_arithmetic: Option<Arithmetic>,
}

/// Every device of the machine, in the loader's order; those that can be used are opened for it.
///
/// # Errors
/// There is none, or one that can be used fails.
pub fn tried_devices() -> Result<Vec<TriedDevice>, GpuError> {
    let devices = devices()?;
    if devices.is_empty() {
        return Err(GpuError::NoDriver);
    }
    devices.into_iter().map(tried).collect()
}

fn tried(description: DeviceDescription) -> Result<TriedDevice, GpuError> {
    let (mut f32_arithmetic, mut f64_arithmetic) = (None, None);
    if description.lacks.is_empty() {
        let device = Device::open(Some(&description.index.to_string()), Validation::Off)?;
        f32_arithmetic = Some(arithmetic(&device, FloatWidth::F32)?);
        if description.float64 {
            f64_arithmetic = Some(arithmetic(&device, FloatWidth::F64)?);
        }
    }
    Ok(TriedDevice { description, f32_arithmetic, f64_arithmetic })
}
