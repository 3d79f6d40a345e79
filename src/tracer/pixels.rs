//! The buffer that the accurate kernel draws a picture into, pixel by pixel.

use std::sync::Arc;

use super::TracerError;
use crate::gpu::{Buffer, BufferKind, Device, DeviceDescription, GpuError, PIXEL_BYTES, Resource};

/// For a picture of `width`×`height` pixels, row by row.
pub(super) fn pixel_buffer(device: &Arc<Device>, name: &str, [width, height]: [u32; 2]) -> Result<Resource, GpuError> {
    let bytes = u64::from(width) * u64::from(height) * PIXEL_BYTES;
    Ok(Resource::from(&Arc::new(Buffer::new(device, name, BufferKind::Pixels, bytes)?)))
}

/// Of a square picture that fits, pixels.
pub(super) fn largest_side(device: &DeviceDescription) -> u32 {
    let most_pixels = device.max_storage_bytes / PIXEL_BYTES;
    device.max_image_side.min(u32::try_from(most_pixels.isqrt()).unwrap_or(u32::MAX))
}

/// Refuses a picture that the device lets no kernel draw whole.
pub(super) fn check_picture(device: &DeviceDescription, [width, height]: [u32; 2]) -> Result<(), TracerError> {
    let bytes = u64::from(width) * u64::from(height) * PIXEL_BYTES;
    let limit = device.max_storage_bytes;
    if bytes > limit {
        return Err(TracerError::Refused(format!(
            "a picture of {width}x{height} pixels is too large for device '{}' in one piece: it takes {bytes} B, and a \
             kernel sees {limit} B there; a smaller scale works",
            device.name
        )));
    }
    Ok(())
}
