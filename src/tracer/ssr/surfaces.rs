//! What the light pass leaves for the reflections, `glsl/ssr/surfaces.glsl`.

use std::sync::Arc;

use super::super::TracerError;
use super::super::pixels::pixel_buffer;
use crate::gpu::{Buffer, BufferKind, Device, DeviceDescription, GpuError, PIXEL_BYTES, Resource};

/// Of a picture, pixel by pixel, and the depth pyramid over it.
pub(super) struct Surfaces {
    /// Pixels.
    pub size: [u32; 2],
    pub radiances: Resource,
    pub points: Resource,
    pub normals: Resource,
    /// One level behind the other.
    pub depths: Resource,
}

/// Bytes of the nearest and the farthest depth of a cell.
const DEPTH_BYTES: u64 = 8;

impl Surfaces {
    pub fn new(device: &Arc<Device>, size: [u32; 2]) -> Result<Self, GpuError> {
        let cells: u64 = levels(size).map(area).sum();
        let depths = Buffer::new(device, "depths", BufferKind::Pixels, cells * DEPTH_BYTES)?;
        Ok(Self {
            size,
            radiances: pixel_buffer(device, "radiances", size)?,
            points: pixel_buffer(device, "points", size)?,
            normals: pixel_buffer(device, "normals", size)?,
            depths: Resource::from(&Arc::new(depths)),
        })
    }

    /// Bindings 8 to 10.
    pub fn geometry(&self) -> [Resource; 3] {
        [&self.points, &self.normals, &self.depths].map(Resource::clone)
    }

    pub fn resources(&self) -> [Resource; 4] {
        [&self.radiances, &self.points, &self.normals, &self.depths].map(Resource::clone)
    }
}

fn area([width, height]: [u32; 2]) -> u64 {
    u64::from(width) * u64::from(height)
}

/// Sizes of the pyramid's levels, from that of the picture to a single cell.
pub(super) fn levels(size: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    std::iter::successors(Some(size), |&size| (size != [1, 1]).then(|| size.map(|side| side.div_ceil(2))))
}

/// Refuses a picture that the device lets no kernel see whole.
pub(super) fn check_picture(device: &DeviceDescription, size: [u32; 2]) -> Result<(), TracerError> {
    check(&device.name, device.max_storage_bytes, size)
}

fn check(device: &str, limit: u64, [width, height]: [u32; 2]) -> Result<(), TracerError> {
    // The pyramid takes less.
    let bytes = area([width, height]) * PIXEL_BYTES;
    if bytes > limit {
        return Err(TracerError::Refused(format!(
            "a picture of {width}x{height} pixels is too large for the ssr algorithm on device '{device}', which draws \
             it whole: it takes {bytes} B, and a kernel sees {limit} B there"
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pyramid_ends_in_one_cell_and_takes_less_than_the_pixels() {
        assert_eq!(levels([1, 1]).collect::<Vec<_>>(), [[1, 1]]);
        assert_eq!(levels([5, 2]).collect::<Vec<_>>(), [[5, 2], [3, 1], [2, 1], [1, 1]]);
        for size in [[1, 1], [1, 7], [405, 175], [16384, 16384]] {
            let cells: u64 = levels(size).map(area).sum();
            assert!(cells * DEPTH_BYTES <= area(size) * PIXEL_BYTES + 16 * DEPTH_BYTES, "{size:?}");
        }
    }

    #[test]
    fn a_picture_that_no_kernel_sees_whole_is_refused_in_one_line() {
        assert!(check("small", 1 << 27, [3840, 2160]).is_ok());
        let error = check("small", 1 << 27, [5120, 2880]).unwrap_err();
        assert!(error.is_input_error());
        let line = error.to_string();
        assert!(!line.contains('\n'), "{line}");
        for part in ["5120x2880", "'small'", "ssr", "235929600 B", "134217728 B"] {
            assert!(line.contains(part), "{part} is missing in: {line}");
        }
    }
}
