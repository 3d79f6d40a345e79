//! What the light pass leaves for the reflections, `glsl/ssr/surfaces.glsl`.

use std::sync::Arc;

use super::super::pixels::pixel_buffer;
use crate::gpu::{Buffer, BufferKind, Device, GpuError, Resource};

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::PIXEL_BYTES;

    #[test]
    fn a_pyramid_ends_in_one_cell_and_takes_less_than_the_pixels() {
        assert_eq!(levels([1, 1]).collect::<Vec<_>>(), [[1, 1]]);
        assert_eq!(levels([5, 2]).collect::<Vec<_>>(), [[5, 2], [3, 1], [2, 1], [1, 1]]);
        for size in [[1, 1], [1, 7], [405, 175], [16384, 16384]] {
            let cells: u64 = levels(size).map(area).sum();
            assert!(cells * DEPTH_BYTES <= area(size) * PIXEL_BYTES + 16 * DEPTH_BYTES, "{size:?}");
        }
    }
}
