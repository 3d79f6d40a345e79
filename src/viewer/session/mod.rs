//! One run of the window: what it knows, and what happens to it; [`picture`] has it traced, [`paint`] shows it.

mod noise;
mod paint;
mod picture;
mod precision;
mod side;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use glam::{DVec2, DVec3};
use winit::event::{ElementState, MouseScrollDelta, WindowEvent};
use winit::event_loop::EventLoopProxy;
use winit::keyboard::PhysicalKey;
use winit::window::Window;

use self::side::Side;
use super::action::{Action, Effect};
use super::frame_times::FrameTimes;
use super::observer::Observer;
use super::options::{Options, Wake};
use super::panel::Panel;
use super::picture_input::PictureInput;
use super::recovery::Recovery;
use super::screen::{Screen, ScreenError};
#[cfg(any(debug_assertions, test))]
use super::shader_watch::ShaderWatch;
use super::state::State;
use super::{camera_motion, pick};
use crate::gpu::{Builds, Instance, Messages, SurfaceTarget};
use crate::scene::Scene;

/// Pixels of a touchpad that count as one notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 50.0;

/// A window with a scene in it.
pub(super) struct Session {
    options: Options,
    pub state: State,
    panel: Panel,
    input: PictureInput,
    context: egui::Context,
    egui: egui_winit::State,
    /// `None` only while a lost device is being replaced.
    screen: Option<Screen>,
    /// Messages of every device that was.
    messages: Messages,
    picture: egui::Rect,
    frame_times: FrameTimes,
    /// When the widgets are to be drawn again.
    widgets_due: Option<Instant>,
    /// As many as there are kernels that draw, once a picture was asked for.
    sides: Vec<Side>,
    shader_error: Option<String>,
    #[cfg(any(debug_assertions, test))]
    shader_watch: Option<ShaderWatch>,
    screenshots: Vec<Screenshot>,
    observer: Option<Observer>,
    last_frame: Instant,
    /// When time last went on, while it is played.
    played_at: Option<Instant>,
    /// Whether the keys were flying in the last frame.
    is_flying: bool,
    recovery: Recovery,
    losses: Losses,
    latency: Latency,
    pictures_traced: u64,
    frames: u64,
    /// Nothing of the window is to be seen.
    is_occluded: bool,
    is_quitting: bool,
    title: String,
    proxy: EventLoopProxy<Wake>,
    window: Arc<Window>,
}

/// A screenshot that waits for the picture to be whole.
struct Screenshot {
    path: PathBuf,
    /// As each side drew it when it was asked for.
    scenes: Vec<Scene>,
}

/// How often the device was lost.
#[derive(Debug, Default)]
struct Losses {
    count: u32,
    /// Whether no whole picture has been shown since.
    is_fresh: bool,
}

/// From a change of the scene to the first whole picture of it.
#[derive(Debug, Default)]
struct Latency {
    input_at: Option<Instant>,
    changed_at: Option<Instant>,
    last_ms: Option<f64>,
}

/// When the next frame is due.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NextFrame {
    AtOnce,
    At(Instant),
    /// When something happens.
    Whenever,
}

impl Session {
    pub fn new(
        window: Arc<Window>,
        state: State,
        recovery: Recovery,
        options: Options,
        messages: Messages,
        proxy: EventLoopProxy<Wake>,
    ) -> Result<Self, ScreenError> {
        let screen = open_screen(&window, &state, &options, &Builds::default(), &messages)?;
        let (context, egui) = new_egui(&window, options.is_observed);
        Ok(Self {
            messages,
            screen: Some(screen),
            panel: Panel::default(),
            input: PictureInput::default(),
            context,
            egui,
            picture: egui::Rect::ZERO,
            frame_times: FrameTimes::default(),
            widgets_due: Some(Instant::now()),
            sides: Vec::new(),
            shader_error: None,
            #[cfg(any(debug_assertions, test))]
            shader_watch: watch(&options, &proxy),
            screenshots: Vec::new(),
            observer: options.is_observed.then(Observer::default),
            last_frame: Instant::now(),
            played_at: None,
            is_flying: false,
            recovery,
            losses: Losses::default(),
            latency: Latency::default(),
            pictures_traced: 0,
            frames: 0,
            is_occluded: false,
            is_quitting: false,
            title: String::new(),
            proxy,
            options,
            state,
            window,
        })
    }

    pub fn window(&self) -> &Window {
        &self.window
    }

    // ---- Events.

    /// Takes in what happens to the window; whether a frame is to follow.
    pub fn on_event(&mut self, event: &WindowEvent) -> bool {
        let response = self.egui.on_window_event(&self.window, event);
        self.latency.input_at.get_or_insert_with(Instant::now);
        let is_taken = self.on_picture_event(event);
        let is_of_interest = response.repaint || is_taken;
        if is_of_interest {
            self.wake();
        }
        is_of_interest
    }

    fn on_picture_event(&mut self, event: &WindowEvent) -> bool {
        let is_over_picture = self.is_over_picture();
        match event {
            WindowEvent::Resized(_) => {
                if let Some(screen) = &mut self.screen {
                    screen.set_outdated(self.state.preferences.waits_for_display);
                }
                true
            }
            WindowEvent::Occluded(is_occluded) => {
                self.is_occluded = *is_occluded;
                true
            }
            WindowEvent::Focused(false) => {
                self.input.let_go();
                true
            }
            WindowEvent::CursorMoved { position, .. } => {
                let is_inverted = self.state.preferences.is_mouse_inverted;
                let document = &mut self.state.document;
                self.input.move_to(DVec2::new(position.x, position.y), || document.camera_mut(), is_inverted);
                self.input.is_busy()
            }
            WindowEvent::MouseInput { state: ElementState::Pressed, button, .. } if is_over_picture => {
                // A field that was being filled in gives its value up.
                self.context
                    .memory_mut(|memory| memory.focused().into_iter().for_each(|id| memory.surrender_focus(id)));
                let pivot = self.pivot();
                self.input.press(*button, pivot);
                true
            }
            WindowEvent::MouseInput { state: ElementState::Released, button, .. } => {
                if let Some(at) = self.input.release(*button) {
                    let chosen = self.pick(at);
                    self.apply(Action::Select(chosen));
                }
                true
            }
            WindowEvent::MouseWheel { delta, .. } if is_over_picture => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(*lines),
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_NOTCH,
                };
                let pivot = self.pivot();
                camera_motion::zoom(self.state.document.camera_mut(), pivot, notches);
                true
            }
            WindowEvent::ModifiersChanged(modifiers) => {
                self.input.set_alt_held(modifiers.state().alt_key());
                false
            }
            WindowEvent::KeyboardInput { event, .. } => {
                if let PhysicalKey::Code(key) = event.physical_key {
                    self.input.key(key, event.state.is_pressed());
                }
                self.input.flight().is_some()
            }
            WindowEvent::DroppedFile(path) => {
                self.apply(Action::OpenFile(path.clone()));
                true
            }
            WindowEvent::CloseRequested => {
                self.apply(Action::Quit);
                true
            }
            _ => false,
        }
    }

    /// Whether the cursor is over the picture, with nothing upon it. By the cursor as it is now: what egui says of the
    /// pointer is of the last frame.
    fn is_over_picture(&self) -> bool {
        let cursor = self.input.cursor() / f64::from(self.context.pixels_per_point());
        let cursor = egui::pos2(cursor.x as f32, cursor.y as f32);
        let layer = self.context.layer_id_at(cursor);
        // The panel's edge can be taken hold of from a little outside it; a click beside an open menu closes that.
        let edge = self.context.global_style().interaction.resize_grab_radius_side;
        self.state.dialog.is_none()
            && self.picture.shrink(edge).contains(cursor)
            && layer.is_none_or(|layer| layer.order == egui::Order::Background)
            && !egui::Popup::is_any_open(&self.context)
    }

    /// What the mouse goes around: the selected primitive, or what is seen in the picture's centre, or else the origin.
    fn pivot(&self) -> DVec3 {
        let scene = self.state.document.shown_scene();
        let center = self.picture.center().to_vec2() * self.context.pixels_per_point();
        let at = |index: usize| scene.primitives[index].solid.position();
        let seen = || self.pick(DVec2::new(center.x.into(), center.y.into()));
        self.state.document.selection().or_else(seen).map_or(DVec3::ZERO, at)
    }

    /// Which primitive is seen at a position of the window, pixels.
    fn pick(&self, at: DVec2) -> Option<usize> {
        let (corner, [width, height]) = self.picture_pixels();
        let (x, y) = (at.x - f64::from(corner[0]), at.y - f64::from(corner[1]));
        let is_inside = x >= 0.0 && y >= 0.0 && x < width.into() && y < height.into();
        is_inside.then(|| pick::pick(&self.state.document.shown_scene(), width, height, x as u32, y as u32)).flatten()
    }

    /// The picture's corner and size on the window, pixels.
    fn picture_pixels(&self) -> ([u32; 2], [u32; 2]) {
        let scale = self.context.pixels_per_point();
        let (low, high) = (self.picture.min * scale, self.picture.max * scale);
        let round = |side: f32| side.round().max(0.0) as u32;
        let corner = [round(low.x), round(low.y)];
        (corner, [round(high.x).saturating_sub(corner[0]).max(1), round(high.y).saturating_sub(corner[1]).max(1)])
    }

    /// Does what is asked; quitting is for the caller, by [`Session::is_quitting`].
    fn apply(&mut self, action: Action) {
        let preferences = self.state.preferences.clone();
        let (kernel, is_continuous) = (self.state.kernel, self.state.is_continuous);
        for effect in self.state.apply(action) {
            match effect {
                Effect::Quit => self.is_quitting = true,
                Effect::SaveScreenshot(path) => {
                    self.screenshots.push(Screenshot { path, scenes: self.drawn_scenes() });
                }
            }
        }
        if (kernel, is_continuous) != (self.state.kernel, self.state.is_continuous) {
            self.frame_times.clear();
        }
        if self.state.preferences.waits_for_display != preferences.waits_for_display
            && let Some(screen) = &mut self.screen
        {
            screen.set_outdated(self.state.preferences.waits_for_display);
        }
    }

    /// Whether the window is to be closed; not before the screenshots asked for are taken.
    pub fn is_quitting(&self) -> bool {
        self.is_quitting && self.screenshots.is_empty()
    }

    pub fn suspend(&mut self) -> Result<(), ScreenError> {
        self.screen.as_mut().map_or(Ok(()), Screen::suspend)
    }

    pub fn resume(&mut self) -> Result<(), ScreenError> {
        self.screen.as_mut().map_or(Ok(()), Screen::replace_surface)
    }
}

fn open_screen(
    window: &Arc<Window>,
    state: &State,
    options: &Options,
    builds: &Builds,
    messages: &Messages,
) -> Result<Screen, ScreenError> {
    let target: Arc<dyn SurfaceTarget> = window.clone();
    let waits_for_display = state.preferences.waits_for_display;
    let instance = Instance::for_window(options.validation, &*target, messages)?;
    Screen::new(&instance, target, options.device.as_deref(), builds, waits_for_display)
}

#[cfg(any(debug_assertions, test))]
fn watch(options: &Options, proxy: &EventLoopProxy<Wake>) -> Option<ShaderWatch> {
    let (sources, proxy) = (options.watched_sources.clone()?, proxy.clone());
    Some(ShaderWatch::start(sources, move || {
        // A loop that has ended needs no waking.
        let _ = proxy.send_event(Wake::News);
    }))
}

/// `is_observed`: with a tree of the widgets.
fn new_egui(window: &Window, is_observed: bool) -> (egui::Context, egui_winit::State) {
    let context = egui::Context::default();
    if is_observed {
        context.enable_accesskit();
    }
    let id = egui::ViewportId::ROOT;
    let scale = Some(window.scale_factor() as f32);
    let egui = egui_winit::State::new(context.clone(), id, &window, scale, window.theme(), None);
    (context, egui)
}
