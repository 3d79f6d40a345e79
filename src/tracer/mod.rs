//! From a scene to a frame on a device.

mod canvas;
mod chunks;
mod compile;
pub mod course;
mod parts;
mod pixels;
pub mod probe;
mod progressive;
mod renderer;
mod settings;
mod ssr;
mod target;
mod tiles;
mod upscale;
pub mod whitted;

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;

pub use canvas::Canvas;
pub use compile::compile;
pub use progressive::{ErrorEstimate, Progressive};
pub use settings::Settings;

pub use crate::algorithm::{Kernel, Precision};
use crate::frame::{Frame, FrameError};
use crate::gpu::{BindingSet, Builds, Commands, Device, DeviceDescription, GpuError, Recorder, Texel, Timer, Use};
use crate::plan::Limits;
use crate::scene::Scene;
use crate::settings::sampling::most_samples;
use renderer::{MadeFor, Renderer, Run, Sample, renderer};
use target::Target;
use tiles::Tile;

/// Why there is no frame. Each is one line.
#[derive(Debug, thiserror::Error)]
pub enum TracerError {
    /// The scene or the settings are not for this kernel.
    #[error("{0}")]
    Refused(String),
    /// The caller broke the work off.
    #[error("stopped")]
    Stopped,
    /// A driver that runs on the CPU ended loops early: pixels would be wrong.
    #[error(
        "device '{device}' gave up on {pixels} pixels, as Mesa's CPU drivers do where a pixel takes more than 65535 \
         iterations of loops; fewer primitives or generations, or a larger --error, are needed there"
    )]
    LoopLimitReached {
        /// Name of the device.
        device: String,
        /// Number of pixels without a colour.
        pixels: usize,
    },
    /// A call of Vulkan failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A frame of a size that cannot be, or no memory for it.
    #[error(transparent)]
    Frame(#[from] FrameError),
}

impl TracerError {
    /// Whether the scene or the settings are at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        match self {
            Self::Refused(_) => true,
            Self::Stopped | Self::LoopLimitReached { .. } => false,
            Self::Gpu(error) => error.is_input_error(),
            Self::Frame(error) => error.is_input_error(),
        }
    }
}

/// What a plan needs to know of a device.
pub fn limits_of(device: &DeviceDescription) -> Limits {
    let &DeviceDescription { float64, max_texels, max_image_side, packets, .. } = device;
    Limits { float64, max_array_bytes: max_texels * Texel::BYTES, max_image_side, packets }
}

/// A scene on a device, ready to be drawn again and again.
pub struct Tracer {
    renderer: Box<dyn Renderer>,
    set: Arc<BindingSet>,
    width: u32,
    height: u32,
    samples: u32,
    target: Target,
    timer: Option<Arc<Timer>>,
    commands: Commands,
    device: Arc<Device>,
}

impl Tracer {
    /// # Errors
    /// A picture or a scene that the kernel cannot take, or a failing device.
    pub fn new(device: &Arc<Device>, scene: &Scene, settings: &Settings) -> Result<Self, TracerError> {
        let &Settings { width, height, kernel, .. } = settings;
        Frame::check_size(width, height)?;
        let mut commands = Commands::new(device, "trace")?;
        let mut renderer = renderer(device, kernel, &Builds::default(), MadeFor::Headless)?;
        bring(&mut commands, &mut *renderer, scene, settings)?;
        let target = Target::new(device, renderer.target(), scene, settings)?;
        Ok(Self {
            set: bind(&*renderer, &target)?,
            renderer,
            width,
            height,
            samples: settings.samples,
            target,
            timer: Timer::new(device, "trace")?,
            commands,
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
    pub fn set_scene(&mut self, scene: &Scene, settings: &Settings) -> Result<(), TracerError> {
        let &Settings { width, height, kernel, .. } = settings;
        assert_eq!((width, height), (self.width, self.height), "the settings are of another size");
        if kernel == self.renderer.kernel() {
            bring(&mut self.commands, &mut *self.renderer, scene, settings)?;
        } else {
            let mut other = renderer(&self.device, kernel, &Builds::default(), MadeFor::Headless)?;
            bring(&mut self.commands, &mut *other, scene, settings)?;
            self.renderer = other;
        }
        self.target.set_scene(&self.device, self.renderer.target(), scene, settings)?;
        self.set = bind(&*self.renderer, &self.target)?;
        self.samples = settings.samples;
        Ok(())
    }

    /// An empty frame of the right size for [`Tracer::render`].
    pub fn frame(&self) -> Result<Frame, FrameError> {
        Frame::new(self.width, self.height)
    }

    /// Draws the picture into `frame` and returns the GPU time of all its tiles, copies to the host left out, in
    /// nanoseconds; `None` where the device has no timestamps.
    ///
    /// `progress` hears of the pixels done after each sample of each tile and can stop the work there.
    pub fn render(
        &mut self,
        frame: &mut Frame,
        progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Option<u64>, TracerError> {
        assert_eq!((frame.width(), frame.height()), (self.width, self.height), "the frame is of another size");
        let mut gpu_time_ns = self.timer.as_ref().map(|_| 0);
        let mut pixels_done = 0;
        for index in 0..self.target.tiles.len() {
            let tile = self.target.tiles[index];
            let tile_pixels = u64::from(tile.width) * u64::from(tile.height);
            let samples = u64::from(self.samples);
            let mut progress = |done| progress(pixels_done + tile_pixels * u64::from(done) / samples);
            let time_ns = match self.draw_tile(tile, frame, &mut progress) {
                // How long pixels take in company is an estimate.
                Err(TracerError::LoopLimitReached { .. }) if self.trace_one_by_one()? => {
                    self.draw_tile(tile, frame, &mut progress)?
                }
                drawn => drawn?,
            };
            gpu_time_ns = gpu_time_ns.zip(time_ns).map(|(sum, time)| sum + time);
            pixels_done += tile_pixels;
        }
        Ok(gpu_time_ns)
    }

    /// Draws a tile and returns its GPU time; `progress` hears of each sample.
    fn draw_tile(
        &mut self,
        tile: Tile,
        frame: &mut Frame,
        progress: &mut dyn FnMut(u32) -> ControlFlow<()>,
    ) -> Result<Option<u64>, TracerError> {
        let mut gpu_time_ns = self.timer.as_ref().map(|_| 0);
        for sample in 0..self.samples {
            let time_ns = self.trace(tile, sample)?;
            gpu_time_ns = gpu_time_ns.zip(time_ns).map(|(sum, time)| sum + time);
            if sample + 1 == self.samples {
                self.take_pixels(tile, frame)?;
            }
            if progress(sample + 1).is_break() {
                return Err(TracerError::Stopped);
            }
        }
        Ok(gpu_time_ns)
    }

    /// Returns whether pixels were traced otherwise before.
    fn trace_one_by_one(&mut self) -> Result<bool, TracerError> {
        let is_other = self.renderer.trace_one_by_one()?;
        if is_other {
            self.set = bind(&*self.renderer, &self.target)?;
        }
        Ok(is_other)
    }

    /// What was read back of a tile, into its position in `frame`.
    fn take_pixels(&mut self, tile: Tile, frame: &mut Frame) -> Result<(), TracerError> {
        let idle = self.commands.idle()?;
        let pixels: &[[f32; 4]] = bytemuck::cast_slice(self.target.pixels.bytes(&idle)?);
        let written = &pixels[..(tile.width * tile.height) as usize];
        // Alpha counts the samples that came to their end.
        let all = self.renderer.ended_samples().unwrap_or(self.samples) as f32;
        let given_up = written.iter().filter(|[.., alpha]| *alpha != all).count();
        if given_up > 0 {
            let device = self.device.description().name.clone();
            return Err(TracerError::LoopLimitReached { device, pixels: given_up });
        }
        tile.copy_pixels(pixels, frame);
        Ok(())
    }

    /// From now on [`Tracer::render`] draws what each colour of an `f64` kernel loses by rounding to `f32`, or the
    /// colours again: the picture is the sum of the two, good to 48 bits. Other kernels lose nothing.
    ///
    /// # Panics
    /// The picture is not of one sample a pixel at scale 1: means and what lies between pixels are rounded besides.
    pub fn draw_remainder(&mut self, remainder: bool) {
        assert!(self.samples == 1 && self.target.upscaling.is_none(), "only of one sample a pixel at scale 1");
        self.renderer.write_remainder(remainder);
    }

    /// Which samples of each pixel [`Tracer::render`] draws the mean of by path tracing; others draw what they did.
    fn set_run(&mut self, run: Run) {
        self.renderer.set_run(run);
    }

    /// Linear RGB, row by row from the top: of the `f64` kernel good to 48 bits, the colours and what they lose.
    ///
    /// # Panics
    /// As of [`Tracer::draw_remainder`].
    pub fn render_f64(&mut self) -> Result<Vec<DVec3>, TracerError> {
        let mut frame = self.frame()?;
        let mut sum = vec![DVec3::ZERO; frame.pixels().len()];
        for remainder in [false, true] {
            self.draw_remainder(remainder);
            self.render(&mut frame, &mut |_| ControlFlow::Continue(()))?;
            for (sum, pixel) in sum.iter_mut().zip(frame.pixels()) {
                *sum += DVec3::from_array(pixel.map(f64::from));
            }
            if !self.renderer.has_remainder() {
                break;
            }
        }
        self.draw_remainder(false);
        Ok(sum)
    }

    /// Traces one sample of each pixel of a tile and, with the last one, copies the tile to where the host reads it;
    /// returns the GPU time of the tracing, and of the upscaling where there is any.
    fn trace(&mut self, tile: Tile, sample: u32) -> Result<Option<u64>, GpuError> {
        let Self { renderer, set, target, timer, commands, samples, .. } = self;
        let Target { traced, upscaling, read_back, .. } = target;
        let traced_tile = upscaling.as_ref().map_or(tile, |(upscaling, _)| upscaling.upscaler.traced_tile(tile));
        let is_last = sample + 1 == *samples;
        let record = |recorder: &mut Recorder| {
            if sample == 0 {
                // Kernels count in alpha the samples that come to their end.
                recorder.make_ready(traced, Use::CopyTarget);
                recorder.zero(traced);
            }
            recorder.labelled("trace", |recorder| {
                recorder.make_ready(traced, Use::ShaderWrite);
                timer.iter().for_each(|timer| recorder.start(timer));
                let parts = [Tile { x: 0, y: 0, ..traced_tile }];
                renderer.record(recorder, set, Sample { index: sample, tile: traced_tile, parts: &parts });
                if let Some((upscaling, copy)) = upscaling.as_ref().filter(|_| is_last) {
                    recorder.make_ready(traced, Use::CopySource);
                    recorder.make_ready(copy, Use::CopyTarget);
                    recorder.copy_to_image(traced, copy, traced_tile.width, traced_tile.height);
                    upscaling.record(recorder, 0, tile);
                }
                timer.iter().for_each(|timer| recorder.stop(timer));
                Ok(())
            })?;
            if !is_last {
                return Ok(());
            }
            let picture = upscaling.as_ref().map_or(&*traced, |(upscaling, _)| &upscaling.picture);
            recorder.labelled("read back", |recorder| {
                recorder.make_ready(picture, Use::CopySource);
                recorder.make_ready(read_back, Use::CopyTarget);
                recorder.copy_to_buffer(picture, read_back, tile.width, tile.height);
                recorder.make_ready(read_back, Use::HostRead);
                Ok(())
            })
        };
        if sample == 0 {
            commands.run(record)?;
        } else {
            commands.go_on(record)?;
        }
        timer.as_deref().map(Timer::elapsed_ns).transpose()
    }
}

/// Brings a scene to the device, and waits until it is there.
fn bring(
    commands: &mut Commands,
    renderer: &mut dyn Renderer,
    scene: &Scene,
    settings: &Settings,
) -> Result<(), TracerError> {
    let most_samples = most_samples(settings.kernel.description());
    settings.sampling().check(most_samples).map_err(TracerError::Refused)?;
    renderer.prepare(scene, settings, true)?;
    Ok(commands.run(|recorder| renderer.take_up(recorder).map(drop))?)
}

/// The renderer drawing a tile.
fn bind(renderer: &dyn Renderer, target: &Target) -> Result<Arc<BindingSet>, TracerError> {
    let set = renderer.bind(&target.traced)?;
    set.ok_or_else(|| TracerError::Refused("no scene was brought to the device".to_owned()))
}
