//! The buffer that the accurate kernel draws a picture into, pixel by pixel.

use std::sync::Arc;

use super::TracerError;
use crate::gpu::{Buffer, BufferKind, Device, DeviceDescription, GpuError, PIXEL_BYTES, Resource};

/// For a picture of `width`×`height` pixels, row by row.
pub(super) fn pixel_buffer(device: &Arc<Device>, name: &str, [width, height]: [u32; 2]) -> Result<Resource, GpuError> {
    let bytes = u64::from(width) * u64::from(height) * PIXEL_BYTES;
    Ok(Resource::from(&Arc::new(Buffer::new(device, name, BufferKind::Pixels, bytes)?)))
}

/// Side of the largest square picture that fits, pixels.
pub(super) fn largest_side(device: &DeviceDescription) -> u32 {
    let most_pixels = device.max_storage_bytes / PIXEL_BYTES;
    device.max_image_side.min(u32::try_from(most_pixels.isqrt()).unwrap_or(u32::MAX))
}

/// Refuses a picture that the device lets no kernel draw whole; `advice`: why it must, or what helps.
pub(super) fn check_picture(device: &DeviceDescription, size: [u32; 2], advice: &str) -> Result<(), TracerError> {
    check(&device.name, device.max_storage_bytes, size, advice)
}

fn check(device: &str, limit: u64, [width, height]: [u32; 2], advice: &str) -> Result<(), TracerError> {
    let bytes = u64::from(width) * u64::from(height) * PIXEL_BYTES;
    if bytes > limit {
        return Err(TracerError::Refused(format!(
            "a picture of {width}x{height} pixels is too large for device '{device}' in one piece: it takes {bytes} B, \
             and a kernel sees {limit} B there; {advice}"
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::check;

    #[test]
    fn a_picture_that_no_kernel_sees_whole_is_refused_in_one_line() {
        assert!(check("small", 1 << 27, [3840, 2160], "").is_ok());
        let line = check("small", 1 << 27, [5120, 2880], "a smaller scale works").unwrap_err().to_string();
        assert!(!line.contains('\n'), "{line}");
        for part in ["5120x2880", "'small'", "235929600 B", "134217728 B", "scale"] {
            assert!(line.contains(part), "{part} is missing in: {line}");
        }
    }
}
