//! A window of a picture's size with the picture and nothing else, shown as soon as it is traced.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::error::OsError;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::platform::pump_events::EventLoopExtPumpEvents;
use winit::window::{Window, WindowAttributes, WindowId};

use super::app::ViewerError;
use super::screen::ScreenError;
use crate::gpu::{
    Builds, Device, Fit, GpuError, InFlight, Instance, Messages, Semaphores, Surface, SurfaceTarget, Swapchain,
    Validation,
};
use crate::scene::Scene;
use crate::tracer::{Canvas, Kernel, Settings, TracerError};

/// Where windows are opened. There is one in a program, on its first thread.
pub struct Display {
    event_loop: EventLoop<()>,
    events: Events,
}

/// What has happened since it was last asked for.
#[derive(Default)]
struct Events {
    wanted: Option<WindowAttributes>,
    opened: Option<Result<Window, OsError>>,
    is_resized: bool,
    is_closed: bool,
}

impl Display {
    /// # Errors
    /// There is none; the message says what works `instead`.
    pub fn open(instead: &'static str) -> Result<Self, ViewerError> {
        let event_loop = EventLoop::new().map_err(|reason| ViewerError::NoDisplay { reason, instead })?;
        Ok(Self { event_loop, events: Events::default() })
    }

    /// A window of so many pixels that the user cannot resize.
    fn open_window(&mut self, [width, height]: [u32; 2]) -> Result<Arc<Window>, ViewerError> {
        let attributes = Window::default_attributes()
            .with_title("zerkalo")
            .with_inner_size(PhysicalSize::new(width, height))
            .with_resizable(false);
        self.events = Events { wanted: Some(attributes), ..Events::default() };
        loop {
            self.pump();
            if let Some(opened) = self.events.opened.take() {
                return Ok(Arc::new(opened?));
            }
        }
    }

    /// Answers what has happened, without waiting for more.
    fn pump(&mut self) {
        // Nothing here makes the loop exit.
        let _ = self.event_loop.pump_app_events(Some(Duration::ZERO), &mut self.events);
    }
}

impl ApplicationHandler for Events {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        self.about_to_wait(event_loop);
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(attributes) = self.wanted.take() {
            self.opened = Some(event_loop.create_window(attributes));
        }
    }

    fn window_event(&mut self, _event_loop: &ActiveEventLoop, _window: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => self.is_closed = true,
            WindowEvent::Resized(_) => self.is_resized = true,
            _ => {}
        }
    }
}

/// What a picture took.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    /// Time of its tracing; `None` where the device has no timestamps.
    pub gpu_time_ns: Option<u64>,
    /// From the picture before to this one, traced and given to the window system.
    pub wall_time: Duration,
}

/// A window with a device that traces into it.
///
/// The fields are dropped in this order.
pub struct PictureWindow<'d> {
    /// By the kernels that were asked for.
    canvases: Vec<(Kernel, Canvas)>,
    swapchain: Option<Swapchain>,
    in_flight: InFlight,
    surface: Arc<Surface>,
    device: Arc<Device>,
    target: Arc<dyn SurfaceTarget>,
    /// Pixels.
    size: [u32; 2],
    display: &'d mut Display,
}

impl<'d> PictureWindow<'d> {
    /// A window of so many pixels on the device `wanted`, or the best one that can show pictures in it; `messages` gets
    /// what validation has to say.
    ///
    /// # Errors
    /// The display opens no such window, or there is no such device.
    pub fn open(
        display: &'d mut Display,
        size: [u32; 2],
        wanted: Option<&str>,
        validation: Validation,
        messages: &Messages,
    ) -> Result<Self, ViewerError> {
        let target: Arc<dyn SurfaceTarget> = display.open_window(size)?;
        let on_screen = || -> Result<Self, GpuError> {
            let instance = Instance::for_window(validation, &*target, messages)?;
            let surface = Arc::new(Surface::new(&instance, &target)?);
            let device = Device::open_for(&surface, wanted)?;
            let in_flight = InFlight::new(&device, "window")?;
            let mut window =
                Self { canvases: Vec::new(), swapchain: None, in_flight, surface, device, target, size, display };
            window.prepare()?;
            Ok(window)
        };
        on_screen().map_err(|error| ScreenError::from(error).into())
    }

    /// What the pictures are traced on.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// How pictures are shown, by Vulkan's word, such as `mailbox`; `None` while nothing of the window is to be seen.
    pub fn present_mode(&self) -> Option<&'static str> {
        self.swapchain.as_ref().map(Swapchain::present_mode)
    }

    /// Traces the scene's picture and shows it once it is whole. Both are waited for, so that pictures by several
    /// kernels can take turns and none pays for another.
    ///
    /// `keep_going` is asked before every submission and can stop the work there.
    ///
    /// # Errors
    /// The kernel cannot take the scene, the device fails, `keep_going` breaks, the window is closed, or it is not of
    /// the picture's size any more.
    pub fn show(
        &mut self,
        settings: &Settings,
        scene: &Scene,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Shown, TracerError> {
        let place = self.canvas_by(settings.kernel)?;
        self.canvases[place].1.set_settings(settings.clone());
        loop {
            // A picture that had to wait for the window to be seen is no measure of anything: once more.
            if let Some(shown) = self.try_to_show(place, scene, keep_going)? {
                return Ok(shown);
            }
        }
    }

    fn canvas_by(&mut self, kernel: Kernel) -> Result<usize, TracerError> {
        if let Some(place) = self.canvases.iter().position(|(known, _)| *known == kernel) {
            return Ok(place);
        }
        let canvas = Canvas::new(&self.device, kernel, &Builds::default(), self.size)?;
        self.canvases.push((kernel, canvas));
        Ok(self.canvases.len() - 1)
    }

    /// `None` where the window has no image for the picture.
    fn try_to_show(
        &mut self,
        canvas: usize,
        scene: &Scene,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Shown>, TracerError> {
        let start = Instant::now();
        self.canvases[canvas].1.trace_again(scene)?;
        while !self.canvases[canvas].1.is_whole() {
            self.answer(keep_going)?;
            self.submit_chunk(canvas)?;
        }
        self.answer(keep_going)?;
        let is_shown = self.present(canvas)?;
        self.in_flight.wait_for_all()?;
        let canvas = &mut self.canvases[canvas].1;
        self.in_flight.places().into_iter().try_for_each(|place| canvas.collect(place))?;
        let gpu_time_ns = canvas.take_finished().last().map(|finished| finished.gpu_time_ns);
        Ok(is_shown.then(|| Shown { gpu_time_ns, wall_time: start.elapsed() }))
    }

    fn answer(&mut self, keep_going: &mut dyn FnMut() -> ControlFlow<()>) -> Result<(), TracerError> {
        self.display.pump();
        if keep_going().is_break() || self.display.events.is_closed { Err(TracerError::Stopped) } else { Ok(()) }
    }

    fn submit_chunk(&mut self, canvas: usize) -> Result<(), GpuError> {
        let Self { canvases, in_flight, .. } = self;
        let canvas = &mut canvases[canvas].1;
        let place = in_flight.wait_for_place()?;
        canvas.collect(place)?;
        canvas.forget_dropped(in_flight);
        in_flight.submit(Semaphores::default(), |recorder| canvas.record(recorder, place))
    }

    /// Whether the window took the picture.
    fn present(&mut self, canvas: usize) -> Result<bool, GpuError> {
        self.prepare()?;
        let Self { canvases, swapchain: Some(swapchain), in_flight, .. } = self else { return Ok(false) };
        let canvas = &mut canvases[canvas].1;
        let place = in_flight.wait_for_place()?;
        canvas.collect(place)?;
        let fit = match swapchain.acquire(in_flight)? {
            Ok(image) => swapchain.show(in_flight, image, |recorder, image| {
                image.fill(recorder, [0.0; 4], &[(canvas.picture(), 0..u32::MAX)], [0, 0], |_| {})
            })?,
            Err(fit) => Err(fit),
        };
        let (Ok(mends) | Err(mends)) = fit;
        match mends {
            Fit::Good => {}
            Fit::Outdated => self.display.events.is_resized = true,
            Fit::SurfaceLost => {
                in_flight.wait_for_all()?;
                self.swapchain = None;
                self.surface = Arc::new(Surface::new(self.device.instance(), &self.target)?);
            }
        }
        Ok(fit.is_ok())
    }

    /// Makes the swapchain go with the window, which must be of the picture's size.
    fn prepare(&mut self) -> Result<(), GpuError> {
        if self.swapchain.is_some() && !std::mem::take(&mut self.display.events.is_resized) {
            return Ok(());
        }
        self.in_flight.wait_for_all()?;
        // The window cannot serve two at a time.
        self.swapchain = None;
        self.swapchain = Swapchain::new(&self.device, &self.surface, self.size, false)?;
        let extent = self.swapchain.as_ref().map(|swapchain| swapchain.extent());
        match extent.map(|extent| [extent.width, extent.height]).filter(|extent| *extent != self.size) {
            None => Ok(()),
            Some([width, height]) => {
                let [wanted_width, wanted_height] = self.size;
                Err(GpuError::NoWindow(format!(
                    "the window system makes the window {width}x{height} pixels large, and the picture has \
                     {wanted_width}x{wanted_height}"
                )))
            }
        }
    }
}

impl Drop for PictureWindow<'_> {
    fn drop(&mut self) {
        // What the submissions use goes with the fields; on a lost device nothing runs any more.
        let _ = self.in_flight.wait_for_all();
    }
}
