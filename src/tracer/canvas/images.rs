//! What a [`Canvas`](super::Canvas) is traced on.

use std::sync::Arc;

use super::super::enlarge::Enlarger;
use crate::gpu::{BindingSet, Device, GpuError, Recorder, Resource, StorageImage};

pub struct Image {
    pub resource: Resource,
    /// Once the kernel can be bound.
    pub set: Option<Arc<BindingSet>>,
    pub is_cleared: bool,
}

/// The picture shown, made from the smaller image shown.
pub struct Enlarging {
    enlarger: Enlarger,
    pub picture: Resource,
    /// For each image.
    sets: [Arc<BindingSet>; 2],
    /// Whether it is made from all that the image has.
    pub is_current: bool,
}

impl Enlarging {
    pub fn new(
        device: &Arc<Device>,
        size: [u32; 2],
        traced_size: [u32; 2],
        [first, second]: &[Image; 2],
    ) -> Result<Self, GpuError> {
        let enlarger = Enlarger::new(device, size, traced_size)?;
        let picture = Resource::from(&Arc::new(StorageImage::new(device, "picture", size[0], size[1])?));
        let sets = [enlarger.bind(&picture, &first.resource)?, enlarger.bind(&picture, &second.resource)?];
        Ok(Self { enlarger, picture, sets, is_current: false })
    }

    /// Makes the picture from the image shown, where that has got more since.
    pub fn bring_up_to_date(&mut self, recorder: &mut Recorder, images: &[Image; 2], shown: usize) {
        if !self.is_current {
            let whole = self.enlarger.whole();
            self.enlarger.record(recorder, &self.sets[shown], [&self.picture, &images[shown].resource], whole);
            self.is_current = true;
        }
    }
}

/// Of this size, pixels.
pub fn images(device: &Arc<Device>, [width, height]: [u32; 2]) -> Result<[Image; 2], GpuError> {
    let image = |name| {
        let resource = Resource::from(&Arc::new(StorageImage::new(device, name, width, height)?));
        Ok(Image { set: None, resource, is_cleared: false })
    };
    Ok([image("picture 0")?, image("picture 1")?])
}
