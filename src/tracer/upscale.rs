//! `glsl/upscale.comp`: the pass that brings a picture traced at a smaller size to the size asked for.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};

use super::tiles::Tile;
use crate::gpu::{
    BindingKind, BindingSet, ComputePipeline, Device, GpuError, PipelineDescription, Recorder, Resource, StorageImage,
    Use, shaders,
};
use crate::plan::WORKGROUP;

/// `Push` of the kernel; pixels.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct UpscalePushConstants {
    size: [u32; 2],
    traced_size: [u32; 2],
    origin: [u32; 2],
    traced_origin: [u32; 2],
}

/// The kernel for pictures of one size.
pub(super) struct Upscaler {
    pipeline: Arc<ComputePipeline>,
    size: [u32; 2],
    traced_size: [u32; 2],
}

impl Upscaler {
    pub fn new(device: &Arc<Device>, size: [u32; 2], traced_size: [u32; 2]) -> Result<Self, GpuError> {
        let description = PipelineDescription {
            shader: &shaders::UPSCALE,
            bindings: &[BindingKind::Picture, BindingKind::PictureRead],
            push_constant_bytes: size_of::<UpscalePushConstants>() as u32,
            constants: &WORKGROUP,
        };
        Ok(Self { pipeline: ComputePipeline::new(device, &description)?, size, traced_size })
    }

    /// From the picture `traced` into `picture`, or from tiles into tiles.
    fn bind(&self, picture: &Resource, traced: &Resource) -> Result<Arc<BindingSet>, GpuError> {
        BindingSet::new(&self.pipeline, &[picture.clone(), traced.clone()])
    }

    /// The part of the smaller picture that a tile is made from.
    pub fn traced_tile(&self, tile: Tile) -> Tile {
        let [(x, width), (y, height)] = [(tile.x, tile.width, 0), (tile.y, tile.height, 1)]
            .map(|(first, count, axis)| traced_range(first, count, self.size[axis], self.traced_size[axis]));
        Tile { x, y, width, height }
    }

    /// No such part of a tile of at most this size is larger.
    pub fn most_traced(&self, tile: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| most_traced(tile[axis], self.size[axis], self.traced_size[axis]))
    }

    /// Makes a tile from its [part](Upscaler::traced_tile) of the smaller picture, whose top left pixel lies in
    /// that of the image `traced`.
    fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, [picture, traced]: [&Resource; 2], tile: Tile) {
        let part = self.traced_tile(tile);
        let frame = UpscalePushConstants {
            size: self.size,
            traced_size: self.traced_size,
            origin: [tile.x, tile.y],
            traced_origin: [part.x, part.y],
        };
        recorder.make_ready(traced, Use::ShaderRead);
        recorder.make_ready(picture, Use::ShaderWrite);
        let groups = [tile.width.div_ceil(WORKGROUP[0]), tile.height.div_ceil(WORKGROUP[1]), 1];
        recorder.dispatch(&self.pipeline, set, bytemuck::bytes_of(&frame), groups);
    }
}

/// A picture, or a tile of one, and the smaller images that it can be made from.
pub(super) struct Upscaling {
    pub upscaler: Upscaler,
    pub picture: Resource,
    sources: Vec<(Resource, Arc<BindingSet>)>,
}

impl Upscaling {
    /// `size` of `picture` or of its largest tile, pixels.
    pub fn new(
        device: &Arc<Device>,
        upscaler: Upscaler,
        [width, height]: [u32; 2],
        sources: impl IntoIterator<Item = Resource>,
    ) -> Result<Self, GpuError> {
        let picture = Resource::from(&Arc::new(StorageImage::new(device, "picture", width, height)?));
        let bound = |source: Resource| Ok((source.clone(), upscaler.bind(&picture, &source)?));
        let sources = sources.into_iter().map(bound).collect::<Result<_, GpuError>>()?;
        Ok(Self { upscaler, picture, sources })
    }

    /// Makes a tile of the picture from the source with this index, which holds the
    /// [part](Upscaler::traced_tile) needed for it.
    pub fn record(&self, recorder: &mut Recorder, source: usize, tile: Tile) {
        let (source, set) = &self.sources[source];
        self.upscaler.record(recorder, set, [&self.picture, source], tile);
    }
}

/// Along one axis, the traced pixels between which these of the picture lie: the first, and how many.
fn traced_range(first: u32, count: u32, size: u32, traced_size: u32) -> (u32, u32) {
    // As the kernel has it: a centre among the traced ones, in 1 / (2 * size).
    let before = |pixel: u32| {
        let place = ((2 * u64::from(pixel) + 1) * u64::from(traced_size)).saturating_sub(u64::from(size));
        (place / (2 * u64::from(size))).min(u64::from(traced_size - 1)) as u32
    };
    let last = (before(first + count - 1) + 1).min(traced_size - 1);
    (before(first), last - before(first) + 1)
}

/// No range of up to `count` pixels is longer: rounding down makes it one longer than the distance between its ends,
/// and both ends are in it, with what is beyond the last.
fn most_traced(count: u32, size: u32, traced_size: u32) -> u32 {
    let between = u64::from(count - 1) * u64::from(traced_size) / u64::from(size);
    (between as u32 + 3).min(traced_size)
}

#[cfg(test)]
mod tests {
    use super::{most_traced, traced_range};

    #[test]
    fn a_tile_is_made_from_the_pixels_around_it() {
        assert_eq!(traced_range(0, 8, 8, 4), (0, 4), "the whole");
        // Centres of a picture of half the size lie at 0.5, 2.5, 4.5 and 6.5 of the larger one's pixels.
        assert_eq!(traced_range(0, 1, 8, 4), (0, 2));
        assert_eq!(traced_range(2, 1, 8, 4), (0, 2));
        assert_eq!(traced_range(3, 2, 8, 4), (1, 2));
        assert_eq!(traced_range(7, 1, 8, 4), (3, 1));
        assert_eq!(traced_range(5, 3, 16384, 1), (0, 1));
    }

    #[test]
    fn every_traced_pixel_is_seen_and_tiles_together_see_the_whole() {
        for (size, traced_size) in [(1, 1), (7, 2), (100, 99), (1621, 811), (16384, 4097)] {
            assert_eq!(traced_range(0, size, size, traced_size), (0, traced_size), "{size} from {traced_size}");
            let mut seen_to = 0;
            for first in (0..size).step_by(64) {
                let (low, count) = traced_range(first, (size - first).min(64), size, traced_size);
                assert!(low <= seen_to && low + count <= traced_size);
                assert!(count <= most_traced(64, size, traced_size));
                seen_to = low + count;
            }
            assert_eq!(seen_to, traced_size);
        }
    }
}
