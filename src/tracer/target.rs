//! What a [`Tracer`](super::Tracer) draws into: pictures of one tile, and where the host reads it.

use std::sync::Arc;

use super::pixels::largest_side;
use super::renderer::TargetKind;
use super::tiles::{Tile, tiles};
use super::upscale::{Upscaler, Upscaling};
use super::{Settings, TracerError};
use crate::gpu::{Buffer, BufferKind, Device, PIXEL_BYTES, Resource};
use crate::plan::{rays_per_pixel, tile_side, tried_under_boxes};
use crate::scene::Scene;

pub(super) struct Target {
    /// Tiles of the picture asked for.
    pub tiles: Vec<Tile>,
    /// A tile as it is traced.
    pub traced: Resource,
    kind: TargetKind,
    /// Where that is smaller than the tile: from a copy of it.
    pub upscaling: Option<(Upscaling, Resource)>,
    pub pixels: Arc<Buffer>,
    /// The same.
    pub read_back: Resource,
    scale: f64,
    /// Side of the largest tile that they hold, pixels as traced.
    traced_side: u32,
}

impl Target {
    pub fn new(
        device: &Arc<Device>,
        kind: TargetKind,
        scene: &Scene,
        settings: &Settings,
    ) -> Result<Self, TracerError> {
        let &Settings { width, height, scale, .. } = settings;
        let size = [width, height];
        // A tile brought to its size may need the neighbours of its edge.
        let largest = largest_side(device.description()) - if scale < 1.0 { 2 } else { 0 };
        let traced_side = traced_side(scene, settings, largest);
        let tile_side = shown_side(traced_side, scale, device);
        let tile = size.map(|side| side.min(tile_side));
        let (traced, upscaling) = if scale < 1.0 {
            let upscaler = Upscaler::new(device, size, settings.sampling().traced_size(size))?;
            let traced_tile = upscaler.most_traced(tile);
            let copy = TargetKind::Image.make(device, "traced tile", traced_tile)?;
            let upscaling = Upscaling::new(device, upscaler, tile, [copy.clone()])?;
            (kind.make(device, "traced", traced_tile)?, Some((upscaling, copy)))
        } else {
            (kind.make(device, "picture", tile)?, None)
        };
        let tile_bytes = u64::from(tile[0]) * u64::from(tile[1]) * PIXEL_BYTES;
        let pixels = Arc::new(Buffer::new(device, "pixels", BufferKind::Readback, tile_bytes)?);
        let (tiles, read_back) = (tiles(width, height, tile_side), Resource::from(&pixels));
        Ok(Self { tiles, traced, kind, upscaling, pixels, read_back, scale, traced_side })
    }

    /// For another scene or other settings of the same size; what is there is kept where it fits.
    pub fn set_scene(
        &mut self,
        device: &Arc<Device>,
        kind: TargetKind,
        scene: &Scene,
        settings: &Settings,
    ) -> Result<(), TracerError> {
        let &Settings { width, height, scale, .. } = settings;
        if scale == self.scale && kind == self.kind {
            let traced_side = traced_side(scene, settings, self.traced_side);
            self.tiles = tiles(width, height, shown_side(traced_side, scale, device));
        } else {
            *self = Self::new(device, kind, scene, settings)?;
        }
        Ok(())
    }
}

/// Side of what one submission traces, pixels: at most `limit`, but of a picture that is drawn whole.
fn traced_side(scene: &Scene, settings: &Settings, limit: u32) -> u32 {
    if settings.kernel.draws_whole() {
        return settings.width.max(settings.height);
    }
    let max_tile_side = settings.max_tile_side.clamp(1, limit);
    let solids = scene.primitives.len();
    let has_boxes = settings.kernel.description().has_hierarchy && !settings.without_boxes;
    let tried = if has_boxes { tried_under_boxes(solids) } else { solids };
    let rays = rays_per_pixel(scene, settings.kernel.description(), settings.generations(scene));
    tile_side(max_tile_side, tried, scene.lights.len(), rays)
}

/// Side of the tile made from that, but for the neighbours that its edge needs.
fn shown_side(traced_side: u32, scale: f64, device: &Device) -> u32 {
    ((f64::from(traced_side) / scale) as u32).min(device.description().max_image_side)
}
