//! A picture that is traced while others look at it: a chunk with each submission, anew when its scene changes.

mod host;
mod images;
mod kernels;
mod recording;
mod timing;

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::chunks::{Pace, Sweep};
use super::pixels::check_picture;
use super::renderer::{MadeFor, Renderer, TargetKind, renderer};
use super::upscale::{Upscaler, Upscaling};
use super::{Kernel, Settings, TracerError};
use crate::gpu::{Builds, Device, GpuError, InFlight, Resource};
use crate::plan::WORKGROUP;
use crate::scene::Scene;
use crate::settings::sampling::{Sampling, most_samples};
use images::{Image, images};
pub use timing::Finished;
use timing::Timing;

/// Pictures that take longer are seen while they come into being; shorter ones only whole, lest a moving one fall
/// apart.
const LONG: Duration = Duration::from_millis(500);

/// A kernel's picture of a changing scene, on submissions of an [`InFlight`].
///
/// A picture is of one state of the scene: what changes meanwhile is for the next. Two images take turns, one shown
/// and one traced; only where a picture takes longer than half a second is the shown one traced in place, and
/// taken up anew at every change.
///
/// Where pixels have several samples, a picture has one of each at first; the others are added to it one after another
/// while nothing changes.
pub struct Canvas {
    renderer: Box<dyn Renderer>,
    builds: Builds,
    images: [Image; 2],
    /// Where a kernel draws that does not draw into an image: the picture begun last, which goes on from there into its
    /// image.
    pixels: Option<Resource>,
    shown: usize,
    /// Where the images are smaller than the picture.
    upscaling: Option<Upscaling>,
    /// Whether the picture is made from all that the image shown has.
    is_upscaled: bool,
    size: [u32; 2],
    sampling: Sampling,
    settings: Settings,
    /// Index of the sample being traced, or else of the last one.
    sample: u32,
    sweep: Sweep,
    is_in_place: bool,
    timing: Timing,
    /// Pictures begun so far; every sample of each pixel counts as one.
    begun: u64,
    begun_at: Instant,
    uploaded_bytes: u64,
    /// Resources that are used no more.
    dropped: Vec<Resource>,
    device: Arc<Device>,
}

impl Canvas {
    /// By a kernel, made from these builds.
    pub fn new(device: &Arc<Device>, kernel: Kernel, builds: &Builds, size: [u32; 2]) -> Result<Self, TracerError> {
        Ok(Self {
            images: images(device, size)?,
            pixels: None,
            sweep: Sweep::new(size),
            renderer: renderer(device, kernel, builds, MadeFor::Live)?,
            builds: builds.clone(),
            shown: 0,
            upscaling: None,
            is_upscaled: false,
            size,
            sampling: Sampling::PLAIN,
            settings: Settings::new(size[0], size[1]),
            sample: 0,
            is_in_place: true,
            timing: Timing::new(device)?,
            begun: 0,
            begun_at: Instant::now(),
            uploaded_bytes: 0,
            dropped: Vec::new(),
            device: device.clone(),
        })
    }

    /// Where it is traced.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The picture to look at, once it is [made visible](Canvas::make_visible).
    pub fn picture(&self) -> &Resource {
        self.upscaling.as_ref().map_or(&self.images[self.shown].resource, |upscaling| &upscaling.picture)
    }

    /// Nothing of the kernel before is of use.
    fn begin_anew(&mut self) {
        self.images.iter_mut().for_each(|image| image.set = None);
        self.timing.pace = Pace::new();
        self.forget_scene();
    }

    /// Strikes what is used no more from the book of the submissions.
    pub fn forget_dropped(&mut self, in_flight: &mut InFlight) {
        self.dropped.drain(..).for_each(|dropped| in_flight.forget(&dropped));
    }

    /// Another size, pixels; the picture is to be [asked for](Canvas::show) again.
    pub fn resize(&mut self, in_flight: &mut InFlight, size: [u32; 2]) -> Result<(), TracerError> {
        if size == self.size {
            return Ok(());
        }
        self.remake(in_flight, size, self.sampling)
    }

    /// Other samples a pixel or another scale; returns whether they are others; then the picture is to be
    /// [asked for](Canvas::show) again.
    ///
    /// # Errors
    /// They are not within the kernel's limits.
    pub fn set_sampling(&mut self, in_flight: &mut InFlight, sampling: Sampling) -> Result<bool, TracerError> {
        let most_samples = most_samples(self.renderer.kernel().description());
        sampling.check(most_samples).map_err(TracerError::Refused)?;
        if sampling == self.sampling {
            return Ok(false);
        }
        if sampling.scale == self.sampling.scale {
            self.sampling = sampling;
        } else {
            self.remake(in_flight, self.size, sampling)?;
        }
        Ok(true)
    }

    /// The images anew.
    fn remake(&mut self, in_flight: &mut InFlight, size: [u32; 2], sampling: Sampling) -> Result<(), TracerError> {
        let traced_size = sampling.traced_size(size);
        let images = images(&self.device, traced_size)?;
        let upscaling = if sampling.scale < 1.0 {
            let upscaler = Upscaler::new(&self.device, size, traced_size)?;
            let sources = images.iter().map(|image| image.resource.clone());
            Some(Upscaling::new(&self.device, upscaler, size, sources)?)
        } else {
            None
        };
        for old in std::mem::replace(&mut self.images, images) {
            in_flight.forget(&old.resource);
        }
        if let Some(old) = self.pixels.take() {
            in_flight.forget(&old);
        }
        if let Some(old) = std::mem::replace(&mut self.upscaling, upscaling) {
            in_flight.forget(&old.picture);
        }
        (self.size, self.sampling, self.is_upscaled) = (size, sampling, false);
        self.forget_scene();
        Ok(())
    }

    fn forget_scene(&mut self) {
        self.renderer.forget();
        self.is_in_place = true;
        self.timing.last_took = None;
        self.sweep = Sweep::new(self.sampling.traced_size(self.size));
        self.timing.first_of_interest = self.begun + 1;
    }

    /// What is traced, and what is left out, from the next picture [asked for](Canvas::show) on. Kernel, size and
    /// sampling are the canvas's own.
    pub fn set_settings(&mut self, settings: Settings) {
        self.settings = settings;
    }

    /// Asks for a picture of the scene; of a scene unchanged, nothing is traced.
    ///
    /// # Errors
    /// The kernel cannot take the scene; the picture stays as it is.
    pub fn show(&mut self, scene: &Scene) -> Result<(), TracerError> {
        self.prepare(scene, false)
    }

    /// Asks for the same picture once more.
    pub fn trace_again(&mut self, scene: &Scene) -> Result<(), TracerError> {
        if self.is_whole() { self.prepare(scene, true) } else { Ok(()) }
    }

    fn prepare(&mut self, scene: &Scene, again: bool) -> Result<(), TracerError> {
        let &Sampling { samples, scale } = &self.sampling;
        let [width, height] = self.size;
        if self.renderer.target() == TargetKind::Pixels {
            check_picture(self.device.description(), self.sampling.traced_size(self.size), "a smaller scale works")?;
        }
        // Chunks are of whole workgroups.
        let settings = Settings {
            width,
            height,
            samples,
            scale,
            kernel: self.renderer.kernel(),
            workgroup: WORKGROUP,
            ..self.settings.clone()
        };
        self.renderer.prepare(scene, &settings, again)
    }

    /// Whether submissions are still needed for the picture asked for, or for the time that it took.
    pub fn is_tracing(&self) -> bool {
        !self.is_finished() || self.timing.has_chunks_in_flight()
    }

    /// Whether all of the picture shown is of the scene asked for last, by one sample a pixel at least.
    pub fn is_whole(&self) -> bool {
        !self.renderer.has_next() && (self.sweep.left() == 0 || self.sample > 0)
    }

    /// Whether it is [whole](Canvas::is_whole) and has all samples.
    pub fn is_finished(&self) -> bool {
        !self.renderer.has_next() && self.sweep.left() == 0 && !self.lacks_samples()
    }

    /// Samples of each pixel that are traced or being traced.
    pub fn samples(&self) -> u32 {
        if self.renderer.samples().is_some() { self.sample + 1 } else { 0 }
    }

    /// Samples that each pixel of the picture shown has, where all have as many.
    pub fn whole_samples(&self) -> Option<u32> {
        (!self.renderer.has_next() && self.sweep.left() == 0).then_some(self.sample + 1)
    }

    /// Whether samples are to come of the picture shown, after the one being traced.
    fn lacks_samples(&self) -> bool {
        self.renderer.samples().is_some_and(|samples| self.sample + 1 < samples)
    }

    /// Whether the picture is seen while it comes into being: looking at it again shows more of it.
    pub fn is_growing(&self) -> bool {
        self.is_in_place && self.sweep.left() > 0
    }

    /// Share of the picture that is traced, of all samples, while one is.
    pub fn progress(&self) -> Option<f32> {
        let samples = u64::from(self.renderer.samples().unwrap_or(1));
        let done = (u64::from(self.sample) + 1) * self.sweep.total() - self.sweep.left();
        let is_under_way = self.sweep.left() > 0 || self.lacks_samples();
        is_under_way.then(|| done as f32 / (samples * self.sweep.total()) as f32)
    }

    /// GPU times of the pictures that came to their end since the last call; nothing where the device has no
    /// timestamps.
    pub fn take_finished(&mut self) -> Vec<Finished> {
        self.timing.take_finished()
    }

    /// Bytes of primitives uploaded so far.
    pub fn uploaded_bytes(&self) -> u64 {
        self.uploaded_bytes
    }

    /// Reads the times of what was submitted from this slot of the ring and has ended.
    pub fn collect(&mut self, place: usize) -> Result<(), GpuError> {
        self.timing.collect(place)
    }

    /// Everything that it has on the device is used no more.
    pub fn retire(mut self, in_flight: &mut InFlight) -> Result<(), GpuError> {
        in_flight.wait_for_all()?;
        let images = self.images.iter().map(|image| image.resource.clone());
        self.dropped.extend(images.chain(self.pixels.take()).chain(self.upscaling.map(|upscaling| upscaling.picture)));
        self.dropped.iter().for_each(|dropped| in_flight.forget(dropped));
        Ok(())
    }

    /// Collects what is in flight, in its order, before a submission of another kind takes a slot of the ring.
    pub fn collect_all(&mut self, in_flight: &mut InFlight) -> Result<(), GpuError> {
        in_flight.wait_for_all()?;
        in_flight.places().into_iter().try_for_each(|place| self.collect(place))
    }
}
