use std::sync::Arc;

use super::course::{CourseKernel, CourseScene};
use super::parts::Part;
use super::pixels::pixel_buffer;
use super::records::CoursePushConstants;
use super::tiles::Tile;
use super::whitted::{ViewUniforms, WhittedScene};
use super::whitted_pipeline::WhittedPipeline;
use super::whitted_records::WhittedPushConstants;
use super::{Kernel, Settings, TracerError};
use crate::gpu::{BindingSet, Builds, Device, GpuError, Recorder, Resource, StorageImage, shaders};
use crate::plan::{MOST_PIXELS, TraversalCost};
use crate::scene::Scene;

/// A kernel with the scene that it draws.
pub(super) enum SceneKernel {
    /// The frame is of the whole picture.
    Course { kernel: CourseKernel, frame: Box<CoursePushConstants> },
    /// The view uniforms are of the whole picture.
    Whitted { pipeline: WhittedPipeline, arrays: Vec<Resource>, view_uniforms: ViewUniforms },
}

impl SceneKernel {
    /// # Errors
    /// The kernel cannot take the scene on this device.
    pub fn new(device: &Arc<Device>, scene: &Scene, settings: &Settings, max_depth: u32) -> Result<Self, TracerError> {
        let workgroup = settings.workgroup;
        Ok(match settings.kernel {
            Kernel::Course => {
                let CourseScene { frame, primitives } = course_scene(scene, settings, max_depth)?;
                let kernel = CourseKernel::new(device, &shaders::COURSE, primitives, max_depth, workgroup)?;
                Self::Course { kernel, frame: Box::new(frame) }
            }
            Kernel::Plain | Kernel::Whitted(_) => {
                let scene = whitted_scene(device, scene, settings, max_depth)?;
                let pipeline = WhittedPipeline::new(device, &Builds::default(), &scene, workgroup)?;
                Self::Whitted { pipeline, arrays: scene.upload(device)?, view_uniforms: scene.view_uniforms }
            }
        })
    }

    /// Another scene in the place of the last one. The pipeline stays where it fits.
    ///
    /// # Errors
    /// As of [`SceneKernel::new`]; the last scene stays.
    pub fn set_scene(
        &mut self,
        device: &Arc<Device>,
        scene: &Scene,
        settings: &Settings,
        max_depth: u32,
    ) -> Result<(), TracerError> {
        let &Settings { kernel, workgroup, .. } = settings;
        match self {
            Self::Whitted { pipeline, arrays, view_uniforms } if kernel != Kernel::Course => {
                let scene = whitted_scene(device, scene, settings, max_depth)?;
                let new_arrays = scene.upload(device)?;
                if !pipeline.fits(&scene, workgroup) {
                    *pipeline = pipeline.replaced(device, &scene, workgroup)?;
                }
                (*arrays, *view_uniforms) = (new_arrays, scene.view_uniforms);
            }
            Self::Course { kernel: made, frame } if kernel == Kernel::Course && made.fits(max_depth, workgroup) => {
                let scene = course_scene(scene, settings, max_depth)?;
                *made = made.with(device, scene.primitives)?;
                **frame = scene.frame;
            }
            Self::Whitted { .. } | Self::Course { .. } => *self = Self::new(device, scene, settings, max_depth)?,
        }
        Ok(())
    }

    /// From now on each pixel is traced by itself; tells whether that is another way than before.
    pub fn trace_one_by_one(&mut self, device: &Arc<Device>) -> Result<bool, GpuError> {
        match self {
            Self::Whitted { pipeline, .. } if pipeline.pixels > 1 => {
                *pipeline = pipeline.one_by_one(device)?;
                Ok(true)
            }
            Self::Whitted { .. } | Self::Course { .. } => Ok(false),
        }
    }

    /// Where it draws a tile of so many pixels.
    pub fn picture(&self, device: &Arc<Device>, name: &str, [width, height]: [u32; 2]) -> Result<Resource, GpuError> {
        Ok(match self {
            Self::Course { .. } => Resource::from(&Arc::new(StorageImage::new(device, name, width, height)?)),
            Self::Whitted { .. } => pixel_buffer(device, name, [width, height])?,
        })
    }

    /// Whether a picture is of the sort that it draws.
    pub fn draws_into(&self, picture: &Resource) -> bool {
        match self {
            Self::Course { .. } => matches!(picture, Resource::Image(_)),
            Self::Whitted { .. } => matches!(picture, Resource::Buffer(_)),
        }
    }

    /// The kernel writing into `picture`.
    pub fn bind(&self, picture: &Resource) -> Result<Arc<BindingSet>, GpuError> {
        match self {
            Self::Course { kernel, .. } => kernel.bind(picture),
            Self::Whitted { pipeline, arrays, .. } => pipeline.bind(picture, arrays),
        }
    }

    /// The workgroups that cover so many pixels.
    fn groups(&self, size: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Course { kernel, .. } => kernel.groups(size),
            Self::Whitted { pipeline, .. } => pipeline.groups(size),
        }
    }

    /// See [`Tracer::draw_remainder`](super::Tracer::draw_remainder).
    pub fn write_remainder(&mut self, remainder: bool) {
        if let Self::Whitted { view_uniforms, .. } = self {
            view_uniforms.frame.writes_remainder = u32::from(remainder);
        }
    }

    /// Whether colours lose anything by rounding to `f32`.
    pub fn has_remainder(&self) -> bool {
        matches!(self, Self::Whitted { .. })
    }

    /// Traces a tile of the picture: the sample with this index of each pixel, the ones before being there.
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, tile: Tile, sample: u32) {
        let Tile { x, y, width, height } = tile;
        let part = Part { first: [0, 0], groups: self.groups([width, height]) };
        match self {
            Self::Course { kernel, frame } => kernel.record(recorder, set, &frame.at_tile(x, y), &[part]),
            Self::Whitted { pipeline, view_uniforms, .. } => {
                let frame = WhittedPushConstants {
                    tile_origin: x | y << 16,
                    tile_size: width | height << 16,
                    ..view_uniforms.frame
                };
                pipeline.record(recorder, set, &ViewUniforms { frame, ..*view_uniforms }, sample, &[part]);
            }
        }
    }
}

fn course_scene(scene: &Scene, settings: &Settings, max_depth: u32) -> Result<CourseScene, TracerError> {
    settings.sampling().check_plain().map_err(TracerError::Refused)?;
    CourseScene::new(scene, max_depth, [settings.width, settings.height])
}

fn whitted_scene(
    device: &Device,
    scene: &Scene,
    settings: &Settings,
    max_depth: u32,
) -> Result<WhittedScene, TracerError> {
    let &Settings { width, height, kernel, approximations, without_boxes, pixels, .. } = settings;
    let size = [width, height];
    // Without boxes, a search among more solids than are looked at is long.
    let unknown = if without_boxes { 1 } else { MOST_PIXELS };
    let with_pixels_per_invocation =
        || TraversalCost::of(&scene.primitives).pixels_per_invocation(scene.lights.len(), max_depth, unknown);
    let pixels = pixels.unwrap_or_else(with_pixels_per_invocation);
    let scene = WhittedScene::new(device, scene, kernel, approximations, max_depth, size)?;
    let scene = scene.sampled(settings.sampling(), size).with_pixels_per_invocation(pixels);
    Ok(if without_boxes { scene.without_boxes() } else { scene })
}
