//! From a scene to a frame on a device.

mod canvas;
mod chunks;
mod course;
pub mod hierarchy;
mod kernel_frame;
mod live_kernel;
mod live_whitted;
mod outlines;
pub mod probe;
mod records;
mod scene_kernel;
mod tiles;
mod whitted;
mod whitted_records;

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;

pub use canvas::Canvas;
pub use course::{BINDINGS, MAX_PRIMITIVES, WORKGROUP, upload};
pub use kernel_frame::KernelFrame;
pub use outlines::bounds;
pub use records::{
    BoxRecord, ConeRecord, CylinderRecord, FrameRecord, LightRecord, MaterialRecord, PrimitiveRecords, SphereRecord,
};

pub use crate::plan::Precision;
pub use whitted::{Requirements, check_precision, scene_bindings, upload_scene};
pub use whitted_records::{SolidRecords, WhittedFrame, WhittedRecords};

use crate::frame::{Frame, FrameError};
use crate::gpu::{BindingSet, Buffer, BufferKind, Commands, Device, GpuError, Resource, StorageImage, Timer, Use};
use crate::plan::{Cuts, Plan, tile_side};
use crate::scene::Scene;
use chunks::Part;
use scene_kernel::SceneKernel;
use tiles::{Tile, tiles};

/// Why there is no frame. Each is one line.
#[derive(Debug, thiserror::Error)]
pub enum TracerError {
    /// The scene or the settings are not for this kernel.
    #[error("{0}")]
    Refused(String),
    #[error("stopped")]
    Stopped,
    #[error(
        "device '{device}' gave up on {pixels} pixels, as Mesa's CPU drivers do where a pixel takes more than 65535 turns \
         of loops; fewer primitives or generations are needed there"
    )]
    GaveUp { device: String, pixels: usize },
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Frame(#[from] FrameError),
}

impl TracerError {
    /// Whether the scene or the settings are at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        match self {
            Self::Refused(_) => true,
            Self::Stopped | Self::GaveUp { .. } => false,
            Self::Gpu(error) => error.is_input_error(),
            Self::Frame(error) => error.is_input_error(),
        }
    }
}

/// Which kernel draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// The course work's.
    Course,
    /// The accurate model by textbook quadratics in plain `f32`: what accuracy costs is measured against it.
    Plain,
    /// The accurate one.
    Whitted(Precision),
}

impl Kernel {
    /// What it calculates in.
    pub fn precision(self) -> Precision {
        match self {
            Self::Course | Self::Plain => Precision::F32,
            Self::Whitted(precision) => precision,
        }
    }
}

/// How to render, apart from the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Pixels.
    pub width: u32,
    pub height: u32,
    /// In place of the scene's.
    pub max_depth: Option<u32>,
    /// Largest side of what one submission traces, pixels; heavy scenes take smaller tiles, see [`tile_side`].
    pub max_tile_side: u32,
    /// Pixels of a workgroup along x and y.
    pub workgroup: [u32; 2],
    pub kernel: Kernel,
    /// What is left out; the course kernel leaves out nothing.
    pub cuts: Cuts,
    /// The accurate kernel goes down no boxes: each ray looks at every solid. Slow; what the boxes may not change is
    /// tested against it.
    pub without_boxes: bool,
}

impl Settings {
    /// By the course kernel, exactly.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            max_depth: None,
            max_tile_side: 1024,
            workgroup: WORKGROUP,
            kernel: Kernel::Course,
            cuts: Cuts::NONE,
            without_boxes: false,
        }
    }

    /// By the accurate kernel, as a plan has it.
    pub fn planned(plan: &Plan, width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            max_depth: Some(plan.generations.choice),
            max_tile_side: plan.tile_side.choice,
            workgroup: plan.workgroup.choice,
            kernel: Kernel::Whitted(plan.precision.choice),
            cuts: plan.cuts,
            without_boxes: false,
        }
    }
}

/// A scene on a device, ready to be drawn again and again.
pub struct Tracer {
    kernel: SceneKernel,
    set: Arc<BindingSet>,
    tiles: Vec<Tile>,
    /// Of the largest tile that `picture` holds, pixels.
    tile_side: u32,
    width: u32,
    height: u32,
    picture: Resource,
    pixels: Arc<Buffer>,
    read_back: Resource,
    timer: Option<Arc<Timer>>,
    commands: Commands,
    device: Arc<Device>,
}

impl Tracer {
    /// # Errors
    /// A picture or a scene that the kernel cannot take, or a failing device.
    pub fn new(device: &Arc<Device>, scene: &Scene, settings: &Settings) -> Result<Self, TracerError> {
        let &Settings { width, height, max_depth, max_tile_side, .. } = settings;
        Frame::check_size(width, height)?;
        let max_depth = max_depth.unwrap_or(scene.max_depth);
        let kernel = SceneKernel::new(device, scene, settings, max_depth)?;
        let max_tile_side = max_tile_side.clamp(1, device.description().max_image_side);
        let tile_side = tile_side(max_tile_side, scene.primitives.len(), scene.lights.len(), max_depth);
        let (tile_width, tile_height) = (width.min(tile_side), height.min(tile_side));

        let picture = Arc::new(StorageImage::new(device, "picture", tile_width, tile_height)?);
        let tile_bytes = u64::from(tile_width) * u64::from(tile_height) * StorageImage::PIXEL_BYTES;
        let pixels = Arc::new(Buffer::new(device, "pixels", BufferKind::Readback, tile_bytes)?);
        let picture = Resource::from(&picture);
        Ok(Self {
            set: kernel.bind(&picture)?,
            kernel,
            tiles: tiles(width, height, tile_side),
            tile_side,
            width,
            height,
            picture,
            read_back: Resource::from(&pixels),
            pixels,
            timer: Timer::new(device, "trace")?,
            commands: Commands::new(device, "trace")?,
            device: device.clone(),
        })
    }

    /// Another scene, drawn at the same size; the pipeline is kept where it fits.
    ///
    /// # Errors
    /// As of [`Tracer::new`].
    ///
    /// # Panics
    /// The settings have another size.
    pub fn take_up(&mut self, scene: &Scene, settings: &Settings) -> Result<(), TracerError> {
        let &Settings { width, height, max_depth, max_tile_side, .. } = settings;
        assert_eq!((width, height), (self.width, self.height), "the settings are of another size");
        let max_depth = max_depth.unwrap_or(scene.max_depth);
        self.kernel.take_up(&self.device, scene, settings, max_depth)?;
        self.set = self.kernel.bind(&self.picture)?;
        let max_tile_side = max_tile_side.clamp(1, self.tile_side);
        let tile_side = tile_side(max_tile_side, scene.primitives.len(), scene.lights.len(), max_depth);
        self.tiles = tiles(width, height, tile_side);
        Ok(())
    }

    /// An empty frame of the right size for [`Tracer::render`].
    pub fn frame(&self) -> Result<Frame, FrameError> {
        Frame::new(self.width, self.height)
    }

    /// Draws the picture into `frame` and returns the GPU time of all its tiles, copies left out, in nanoseconds;
    /// `None` where the device has no timestamps.
    ///
    /// `progress` hears of the pixels done after each tile and can stop the work there.
    pub fn render(
        &mut self,
        frame: &mut Frame,
        progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Option<u64>, TracerError> {
        assert_eq!((frame.width(), frame.height()), (self.width, self.height), "the frame is of another size");
        let mut gpu_time_ns = self.timer.as_ref().map(|_| 0);
        let mut pixels_done = 0;
        for index in 0..self.tiles.len() {
            let tile = self.tiles[index];
            let tile_time_ns = self.trace(tile)?;
            gpu_time_ns = gpu_time_ns.zip(tile_time_ns).map(|(sum, time)| sum + time);
            let pixels: &[[f32; 4]] = bytemuck::cast_slice(self.pixels.bytes()?);
            let written = &pixels[..(tile.width * tile.height) as usize];
            let given_up = written.iter().filter(|[.., alpha]| *alpha != 1.0).count();
            if given_up > 0 {
                let device = self.device.description().name.clone();
                return Err(TracerError::GaveUp { device, pixels: given_up });
            }
            tile.copy_pixels(pixels, frame);
            pixels_done += u64::from(tile.width) * u64::from(tile.height);
            if progress(pixels_done).is_break() {
                return Err(TracerError::Stopped);
            }
        }
        Ok(gpu_time_ns)
    }

    /// From now on [`Tracer::render`] draws what each colour of the accurate kernel loses by rounding to `f32`, or the
    /// colours again: an `f64` picture is the sum of the two, good to 48 bits. Other kernels lose nothing.
    pub fn draw_remainder(&mut self, remainder: bool) {
        self.kernel.write_remainder(remainder);
    }

    /// Linear RGB, row by row from the top: of the `f64` kernel good to 48 bits, the colours and what they lose.
    pub fn render_f64(&mut self) -> Result<Vec<DVec3>, TracerError> {
        let mut frame = self.frame()?;
        let mut sum = vec![DVec3::ZERO; frame.pixels().len()];
        for remainder in [false, true] {
            self.draw_remainder(remainder);
            self.render(&mut frame, &mut |_| ControlFlow::Continue(()))?;
            for (sum, pixel) in sum.iter_mut().zip(frame.pixels()) {
                *sum += DVec3::from_array(pixel.map(f64::from));
            }
            if !self.kernel.has_remainder() {
                break;
            }
        }
        self.draw_remainder(false);
        Ok(sum)
    }

    /// Traces one tile and copies it to where the host reads it; returns the GPU time of the tracing.
    fn trace(&mut self, tile: Tile) -> Result<Option<u64>, GpuError> {
        let Self { kernel, set, picture, read_back, timer, commands, .. } = self;
        let whole_tile = Part { first: [0, 0], groups: kernel.groups([tile.width, tile.height]) };
        commands.run(|recorder| {
            // Kernels write an alpha of 1 where they come to their end.
            recorder.make_ready(picture, Use::CopyTarget);
            recorder.clear(picture, [0.0; 4]);
            recorder.labelled("trace", |recorder| {
                recorder.make_ready(picture, Use::ShaderWrite);
                timer.iter().for_each(|timer| recorder.start(timer));
                kernel.record(recorder, set, [tile.x, tile.y], whole_tile);
                timer.iter().for_each(|timer| recorder.stop(timer));
                Ok(())
            })?;
            recorder.labelled("read back", |recorder| {
                recorder.make_ready(picture, Use::CopySource);
                recorder.make_ready(read_back, Use::CopyTarget);
                recorder.copy_to_buffer(picture, read_back, tile.width, tile.height);
                recorder.make_ready(read_back, Use::HostRead);
                Ok(())
            })
        })?;
        timer.as_deref().map(Timer::elapsed_ns).transpose()
    }
}
