//! What a [`Canvas`](super::Canvas) is traced on.

use std::sync::Arc;

use super::super::live_kernel::BLOCK;
use super::super::parts::Part;
use super::super::upscale::Upscaler;
use crate::gpu::{BindingSet, Device, GpuError, Recorder, Resource, StorageImage, Use};

pub struct Image {
    pub resource: Resource,
    /// Once the kernel can be bound.
    pub set: Option<Arc<BindingSet>>,
    pub is_cleared: bool,
    size: [u32; 2],
}

impl Image {
    /// Copies blocks from the buffer that they were drawn into.
    pub fn take_blocks(&self, recorder: &mut Recorder, pixels: &Resource, blocks: &[Part]) {
        recorder.make_ready(pixels, Use::CopySource);
        recorder.make_ready(&self.resource, Use::CopyTarget);
        recorder.copy_parts_to_image(pixels, &self.resource, self.size[0], blocks.iter().map(|part| self.area(part)));
    }

    /// First pixel and size of what the blocks have of the image.
    fn area(&self, blocks: &Part) -> ([u32; 2], [u32; 2]) {
        let first = [0, 1].map(|axis| blocks.first[axis] * BLOCK[axis]);
        let size = [0, 1].map(|axis| (blocks.groups[axis] * BLOCK[axis]).min(self.size[axis] - first[axis]));
        (first, size)
    }
}

/// The picture shown, made from the smaller image shown.
pub struct Upscaling {
    upscaler: Upscaler,
    pub picture: Resource,
    /// For each image.
    sets: [Arc<BindingSet>; 2],
    /// Whether it is made from all that the image has.
    pub is_current: bool,
}

impl Upscaling {
    pub fn new(
        device: &Arc<Device>,
        size: [u32; 2],
        traced_size: [u32; 2],
        [first, second]: &[Image; 2],
    ) -> Result<Self, GpuError> {
        let upscaler = Upscaler::new(device, size, traced_size)?;
        let picture = Resource::from(&Arc::new(StorageImage::new(device, "picture", size[0], size[1])?));
        let sets = [upscaler.bind(&picture, &first.resource)?, upscaler.bind(&picture, &second.resource)?];
        Ok(Self { upscaler, picture, sets, is_current: false })
    }

    /// Makes the picture from the image shown, where that has got more since.
    pub fn bring_up_to_date(&mut self, recorder: &mut Recorder, images: &[Image; 2], shown: usize) {
        if !self.is_current {
            let whole = self.upscaler.whole();
            self.upscaler.record(recorder, &self.sets[shown], [&self.picture, &images[shown].resource], whole);
            self.is_current = true;
        }
    }
}

/// Of this size, pixels.
pub fn images(device: &Arc<Device>, [width, height]: [u32; 2]) -> Result<[Image; 2], GpuError> {
    let image = |name| {
        let resource = Resource::from(&Arc::new(StorageImage::new(device, name, width, height)?));
        Ok(Image { resource, set: None, is_cleared: false, size: [width, height] })
    };
    Ok([image("picture 0")?, image("picture 1")?])
}
