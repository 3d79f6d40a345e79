//! The window and its events, from the first to the last.

use std::sync::Arc;

use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::error::{EventLoopError, OsError};
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Window, WindowId};

use super::document::Document;
use super::options::{Options, Wake};
use super::preferences::{self, Preferences};
use super::recovery::Recovery;
use super::screen::ScreenError;
use super::session::{NextFrame, Session};
use super::state::State;
use crate::gpu::Messages;

/// Why there is no window, or none any more.
#[derive(Debug, thiserror::Error)]
pub enum ViewerError {
    /// No display is found, or it cannot be connected to.
    #[error("no window can be opened here ({}); {instead}", without_place(.reason))]
    NoDisplay {
        /// The window library's.
        reason: EventLoopError,
        /// What works without a window: the end of a sentence.
        instead: &'static str,
    },
    /// There is a display, and it does not open the window.
    #[error("could not open the window: {0}")]
    Window(#[from] OsError),
    /// The device or what is drawn there failed, at the start or later.
    #[error(transparent)]
    Screen(#[from] ScreenError),
    /// Failure of the window library, while the window was open.
    #[error("the window's events came to an end: {0}")]
    Events(EventLoopError),
}

impl ViewerError {
    /// Whether the user's choice is at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        matches!(self, Self::Screen(ScreenError::Tracer(error)) if error.is_input_error())
    }
}

/// The reason alone: winit puts a line of its own source before it.
fn without_place(error: &EventLoopError) -> String {
    let text = error.to_string();
    text.rsplit_once(": ").map_or(text.as_str(), |(_, reason)| reason).trim_end_matches('.').to_owned()
}

/// Closes the window from another thread; unsaved work is kept for the next run.
#[derive(Debug, Clone)]
pub struct Stopper(EventLoopProxy<Wake>);

impl Stopper {
    /// Asks for it and does not wait; of a window that is closed already nothing is asked.
    pub fn stop(&self) {
        // A window that is closed already needs no closing.
        let _ = self.0.send_event(Wake::Stop);
    }
}

/// Opens the window on a document, and returns when it is closed, with what the validation layer said. `on_start` is
/// given what closes it.
pub fn run(document: Document, options: Options, on_start: impl FnOnce(Stopper)) -> Result<Messages, ViewerError> {
    let event_loop = EventLoop::<Wake>::with_user_event().build().map_err(|reason| {
        let instead = "without a display, draw into a file: zerkalo render SCENE --output OUT.png";
        ViewerError::NoDisplay { reason, instead }
    })?;
    let folder = options.config_folder.as_deref();
    let remembered = folder.map(|folder| Preferences::load(&preferences::file_in(folder)));
    let (recovery, recovered) = Recovery::new(folder);
    let state = State::new(document, remembered.unwrap_or_default(), recovered);
    let state = state.drawn_by(options.kernel, options.setting).shaded_by(options.shading);
    let proxy = event_loop.create_proxy();
    on_start(Stopper(proxy.clone()));
    let messages = Messages::default();
    let mut app = App {
        stage: Stage::Waiting(Some(Box::new((state, recovery)))),
        options,
        messages: messages.clone(),
        proxy,
        failure: None,
    };
    event_loop.run_app(&mut app).map_err(ViewerError::Events)?;
    // The session's device is destroyed before its messages are counted: the layers check that too.
    let App { stage, failure, .. } = app;
    drop(stage);
    failure.map_or(Ok(messages), Err)
}

struct App {
    stage: Stage,
    options: Options,
    messages: Messages,
    proxy: EventLoopProxy<Wake>,
    failure: Option<ViewerError>,
}

enum Stage {
    /// For the event loop to say that windows can be opened; empty once one could not.
    Waiting(Option<Box<(State, Recovery)>>),
    Open(Box<Session>),
}

impl App {
    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        match &mut self.stage {
            Stage::Open(session) => session.resume()?,
            Stage::Waiting(state) => {
                let Some((state, recovery)) = state.take().map(|waiting| *waiting) else { return Ok(()) };
                let [width, height] = state.preferences.window_size;
                let attributes =
                    Window::default_attributes().with_title("zerkalo").with_inner_size(LogicalSize::new(width, height));
                let window = Arc::new(event_loop.create_window(attributes)?);
                let (options, messages) = (self.options.clone(), self.messages.clone());
                let session = Session::new(window, state, recovery, options, messages, self.proxy.clone())?;
                session.window().request_redraw();
                self.stage = Stage::Open(Box::new(session));
            }
        }
        Ok(())
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, failure: ViewerError) {
        self.failure.get_or_insert(failure);
        event_loop.exit();
    }
}

impl ApplicationHandler<Wake> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if let Err(failure) = self.open(event_loop) {
            self.fail(event_loop, failure);
        }
    }

    fn suspended(&mut self, event_loop: &ActiveEventLoop) {
        if let Stage::Open(session) = &mut self.stage
            && let Err(failure) = session.suspend()
        {
            self.fail(event_loop, failure.into());
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _window: WindowId, event: WindowEvent) {
        let Stage::Open(session) = &mut self.stage else { return };
        if event == WindowEvent::RedrawRequested {
            match session.paint() {
                Ok(NextFrame::AtOnce) => session.window().request_redraw(),
                Ok(NextFrame::At(time)) => event_loop.set_control_flow(ControlFlow::WaitUntil(time)),
                Ok(NextFrame::Whenever) => event_loop.set_control_flow(ControlFlow::Wait),
                Err(failure) => return self.fail(event_loop, failure.into()),
            }
        } else if session.on_event(&event) {
            session.window().request_redraw();
        }
        if session.is_quitting() {
            event_loop.exit();
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: Wake) {
        match (event, &mut self.stage) {
            (Wake::News, Stage::Open(session)) => {
                session.wake();
                session.window().request_redraw();
            }
            (Wake::News, Stage::Waiting(_)) => {}
            (Wake::Stop, _) => event_loop.exit(),
        }
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: winit::event::StartCause) {
        if matches!(cause, winit::event::StartCause::ResumeTimeReached { .. })
            && let Stage::Open(session) = &self.stage
        {
            event_loop.set_control_flow(ControlFlow::Wait);
            session.window().request_redraw();
        }
    }

    fn exiting(&mut self, _event_loop: &ActiveEventLoop) {
        if let Stage::Open(session) = &mut self.stage {
            session.finish();
        }
    }
}
