//! The window's picture and widgets on the device: everything that is lost with it, and nothing else.

use std::io;
use std::ops::Range;
use std::sync::Arc;

use egui::epaint::ImageDelta;
use egui::{ClippedPrimitive, TextureId};
use egui_ash_renderer::{Options, RenderMode, Renderer, RendererError};

use crate::frame::Frame;
use crate::gpu::{
    Builds, Device, Fit, GpuError, InFlight, Instance, Semaphores, Surface, SurfaceTarget, Swapchain, WidgetMemory,
};
use crate::tracer::{Canvas, Kernel, Precision, TracerError};

/// Why the window cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum ScreenError {
    /// Failure of the device, or of what traces on it.
    #[error(transparent)]
    Tracer(#[from] TracerError),
    /// Failure of the library that draws the widgets on the device.
    #[error("could not draw the widgets: {0}")]
    Widgets(#[from] RendererError),
    /// Failure to write what scripts read.
    #[error("could not write to standard output")]
    Observer(#[from] io::Error),
}

impl From<GpuError> for ScreenError {
    fn from(error: GpuError) -> Self {
        Self::Tracer(error.into())
    }
}

impl ScreenError {
    /// Whether the device is gone, which opening one anew may mend.
    pub fn is_device_lost(&self) -> bool {
        match self {
            Self::Tracer(TracerError::Gpu(error)) => error.is_device_lost(),
            Self::Widgets(RendererError::Vulkan(result)) => *result == ash::vk::Result::ERROR_DEVICE_LOST,
            _ => false,
        }
    }
}

/// The widgets of one frame, ready to be drawn.
pub struct Widgets {
    /// New and changed ones.
    pub textures: Vec<(TextureId, ImageDelta)>,
    pub freed_textures: Vec<TextureId>,
    pub primitives: Vec<ClippedPrimitive>,
    pub pixels_per_point: f32,
}

/// A device with a window's swapchain, what draws the widgets, and the canvases.
///
/// The fields are dropped in this order.
pub struct Screen {
    /// One of the whole picture, or one of each of its sides, from the left; never empty.
    pub canvases: Vec<Canvas>,
    painter: Option<Painter>,
    swapchain: Option<Swapchain>,
    pub in_flight: InFlight,
    is_outdated: bool,
    waits_for_display: bool,
    /// `None` while suspended.
    surface: Option<Arc<Surface>>,
    target: Arc<dyn SurfaceTarget>,
    device: Arc<Device>,
}

/// What draws the widgets into one swapchain's render pass.
struct Painter {
    renderer: Renderer<WidgetMemory>,
    /// No longer used by new frames, but perhaps by one in flight.
    freed: Vec<TextureId>,
}

impl Screen {
    /// On the device `wanted`, or the best one that can show pictures in the window `target`.
    pub fn new(
        instance: &Arc<Instance>,
        target: Arc<dyn SurfaceTarget>,
        wanted: Option<&str>,
        builds: &Builds,
        waits_for_display: bool,
    ) -> Result<Self, ScreenError> {
        let surface = Arc::new(Surface::new(instance, &target)?);
        let device = Device::open_for(&surface, wanted)?;
        Ok(Self {
            canvases: vec![Canvas::new(&device, FIRST_KERNEL, builds, [1, 1])?],
            painter: None,
            swapchain: None,
            in_flight: InFlight::new(&device, "window")?,
            is_outdated: true,
            waits_for_display,
            surface: Some(surface),
            target,
            device,
        })
    }

    pub fn device(&self) -> &Device {
        &self.device
    }

    /// What the kernels are made from.
    pub fn builds(&self) -> Builds {
        self.canvases.first().map(|canvas| canvas.builds().clone()).unwrap_or_default()
    }

    /// So many canvases, one at least.
    pub fn set_sides(&mut self, count: usize) -> Result<(), TracerError> {
        while self.canvases.len() > count.max(1)
            && let Some(canvas) = self.canvases.pop()
        {
            canvas.retire(&mut self.in_flight)?;
        }
        while self.canvases.len() < count {
            self.canvases.push(Canvas::new(&self.device, FIRST_KERNEL, &self.builds(), [1, 1])?);
        }
        Ok(())
    }

    /// Whether submissions are still needed for what is asked for.
    pub fn is_tracing(&self) -> bool {
        self.canvases.iter().any(Canvas::is_tracing)
    }

    /// The picture of a side, as it is now.
    pub fn read_back(&mut self, side: usize) -> Result<Frame, TracerError> {
        self.canvases.iter_mut().try_for_each(|canvas| canvas.collect_all(&mut self.in_flight))?;
        self.canvases[side].read_back(&mut self.in_flight)
    }

    /// Shows a picture traced elsewhere on a side.
    pub fn put(&mut self, side: usize, frame: &Frame) -> Result<(), TracerError> {
        self.canvases.iter_mut().try_for_each(|canvas| canvas.collect_all(&mut self.in_flight))?;
        self.canvases[side].put(&mut self.in_flight, frame)
    }

    /// Before the next frame the swapchain is made anew: the window has another size, or shows pictures otherwise.
    pub fn set_outdated(&mut self, waits_for_display: bool) {
        self.is_outdated = true;
        self.waits_for_display = waits_for_display;
    }

    /// Makes the swapchain go with a window of `size` pixels; `false` while nothing of it is to be seen.
    pub fn prepare(&mut self, size: [u32; 2]) -> Result<bool, ScreenError> {
        let Some(surface) = &self.surface else { return Ok(false) };
        if self.is_outdated {
            self.in_flight.wait_for_all()?;
            // The window cannot serve two at a time.
            self.swapchain = None;
            self.swapchain = Swapchain::new(&self.device, surface, size, self.waits_for_display)?;
            let Some(swapchain) = &self.swapchain else { return Ok(false) };
            self.is_outdated = false;
            let render_mode = RenderMode::RenderPass(swapchain.render_pass());
            match &mut self.painter {
                Some(painter) => painter.renderer.set_render_mode(render_mode)?,
                None => {
                    let options = Options { in_flight_frames: InFlight::COUNT, ..Options::default() };
                    let memory = WidgetMemory::new(&self.device);
                    let renderer = Renderer::with_allocator(memory, self.device.raw.clone(), render_mode, options)?;
                    self.painter = Some(Painter { renderer, freed: Vec::new() });
                }
            }
        }
        Ok(self.swapchain.is_some())
    }

    /// Traces a chunk, if there is one, and shows nothing.
    pub fn trace(&mut self) -> Result<(), ScreenError> {
        let place = ready_place(&mut self.canvases, &mut self.in_flight)?;
        let canvas = next_to_trace(&mut self.canvases);
        Ok(self.in_flight.submit(Semaphores::default(), |recorder| canvas.record(recorder, place))?)
    }

    /// Traces a chunk, if there is one, and shows picture and widgets; `false` where the window had no image for them.
    /// The picture's corner is at `corner`, pixels; `columns` of it are each canvas's. [`Screen::prepare`] must have said
    /// that there is something to be seen.
    pub fn show(
        &mut self,
        widgets: &mut Widgets,
        background: [f32; 4],
        corner: [u32; 2],
        columns: &[Range<u32>],
    ) -> Result<bool, ScreenError> {
        let (Some(swapchain), Some(painter)) = (&mut self.swapchain, &mut self.painter) else { return Ok(false) };
        painter.take_textures(&self.device, &mut self.in_flight, widgets)?;
        let place = ready_place(&mut self.canvases, &mut self.in_flight)?;
        let image = match swapchain.acquire(&mut self.in_flight)? {
            Ok(image) => image,
            Err(fit) => {
                self.mend(fit)?;
                return Ok(false);
            }
        };
        let mut failed = None;
        let extent = swapchain.extent();
        let canvases = &mut self.canvases;
        let presented = swapchain.show(&mut self.in_flight, image, |recorder, image| {
            next_to_trace(canvases).record(recorder, place)?;
            canvases.iter_mut().for_each(|canvas| canvas.make_visible(recorder));
            let pictures = canvases.iter().map(Canvas::picture).zip(columns.iter().cloned());
            image.fill(recorder, background, &pictures.collect::<Vec<_>>(), corner, |commands| {
                let drawn = painter.renderer.cmd_draw(commands, extent, widgets.pixels_per_point, &widgets.primitives);
                failed = drawn.err();
            })
        })?;
        let (Ok(fit) | Err(fit)) = presented;
        self.mend(fit)?;
        failed.map_or(Ok(presented.is_ok()), |error| Err(error.into()))
    }

    fn mend(&mut self, fit: Fit) -> Result<(), ScreenError> {
        match fit {
            Fit::Good => {}
            Fit::Outdated => self.is_outdated = true,
            Fit::SurfaceLost => self.replace_surface()?,
        }
        Ok(())
    }

    /// The window has another surface, as after the program was suspended.
    pub fn replace_surface(&mut self) -> Result<(), ScreenError> {
        self.in_flight.wait_for_all()?;
        self.swapchain = None;
        self.surface = None;
        self.surface = Some(Arc::new(Surface::new(self.device.instance(), &self.target)?));
        self.is_outdated = true;
        Ok(())
    }

    /// The window loses its surface until [`Screen::replace_surface`].
    pub fn suspend(&mut self) -> Result<(), ScreenError> {
        self.in_flight.wait_for_all()?;
        self.swapchain = None;
        self.surface = None;
        self.is_outdated = true;
        Ok(())
    }
}

/// Nothing is compiled for it before a picture is asked for, which may be by another.
const FIRST_KERNEL: Kernel = Kernel::Whitted(Precision::F32);

/// A slot of the ring that is free, and what was submitted from it collected.
fn ready_place(canvases: &mut [Canvas], in_flight: &mut InFlight) -> Result<usize, GpuError> {
    let place = in_flight.wait_for_place()?;
    for canvas in canvases {
        canvas.collect(place)?;
        canvas.forget_dropped(in_flight);
    }
    Ok(place)
}

/// The canvas whose chunk is due: every side is to be whole before any is refined, and then none is to wait for the
/// many samples of another.
fn next_to_trace(canvases: &mut [Canvas]) -> &mut Canvas {
    let unfinished = canvases.iter().enumerate().filter(|(_, canvas)| !canvas.is_finished());
    let next = unfinished.min_by_key(|(_, canvas)| (canvas.is_whole(), canvas.samples())).map(|(index, _)| index);
    // invariant: there is one at least.
    &mut canvases[next.unwrap_or(0)]
}

impl Drop for Screen {
    fn drop(&mut self) {
        // What the frames in flight use goes with the fields; on a lost device nothing runs any more.
        let _ = self.in_flight.wait_for_all();
    }
}

impl Painter {
    /// New and freed textures of the widgets: letters, mostly. Rare enough for waiting until the device is idle, which
    /// the renderer does in any case.
    fn take_textures(
        &mut self,
        device: &Device,
        in_flight: &mut InFlight,
        widgets: &mut Widgets,
    ) -> Result<(), ScreenError> {
        let (textures, freed) = (std::mem::take(&mut widgets.textures), std::mem::take(&mut widgets.freed_textures));
        if textures.is_empty() && freed.is_empty() && self.freed.is_empty() {
            return Ok(());
        }
        let pool = in_flight.idle_pool()?;
        for id in std::mem::replace(&mut self.freed, freed) {
            self.renderer.free_texture(id)?;
        }
        for (id, delta) in textures {
            device.with_queue(|queue| self.renderer.set_texture(queue, pool, id, &delta))?;
        }
        Ok(())
    }
}
