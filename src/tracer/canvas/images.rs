//! What a [`Canvas`](super::Canvas) is traced on.

use std::sync::Arc;

use super::super::tiles::Tile;
use crate::gpu::{BindingSet, Device, GpuError, Recorder, Resource, StorageImage, Use};

pub struct Image {
    pub resource: Resource,
    /// Once the kernel can be bound.
    pub set: Option<Arc<BindingSet>>,
    pub is_cleared: bool,
    /// Pixels.
    width: u32,
}

impl Image {
    /// Copies parts from the buffer that they were drawn into.
    pub fn take(&self, recorder: &mut Recorder, pixels: &Resource, parts: &[Tile]) {
        recorder.make_ready(pixels, Use::CopySource);
        recorder.make_ready(&self.resource, Use::CopyTarget);
        let areas = parts.iter().map(|&Tile { x, y, width, height }| ([x, y], [width, height]));
        recorder.copy_parts_to_image(pixels, &self.resource, self.width, areas);
    }
}

/// Both images, of this size in pixels.
pub fn images(device: &Arc<Device>, [width, height]: [u32; 2]) -> Result<[Image; 2], GpuError> {
    let image = |name| {
        let resource = Resource::from(&Arc::new(StorageImage::new(device, name, width, height)?));
        Ok(Image { resource, set: None, is_cleared: false, width })
    };
    Ok([image("picture 0")?, image("picture 1")?])
}
