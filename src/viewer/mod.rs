//! The window: the course's program alive, a scene edited by hand and traced as it changes.
//!
//! Events go into a [`state::State`] as [`action::Action`]s, which the [`panel`], the mouse in the picture and the
//! keyboard all speak; what a state looks like is drawn by the panel and traced by a tracer. All of it but the window
//! and the swapchain is plain data and pure functions, tested without either.

pub mod action;
mod app;
mod camera_frame;
pub mod camera_motion;
pub mod document;
mod edits;
pub mod frame_times;
mod highlight;
mod history;
mod observer;
mod options;
pub mod outline;
pub mod own_kernel;
pub mod panel;
pub mod pick;
mod picture_input;
mod picture_window;
pub mod preferences;
mod recovery;
pub mod recovery_file;
mod reference_worker;
mod screen;
mod session;
#[cfg(any(debug_assertions, test))]
mod shader_watch;
pub mod state;
pub mod text;
pub mod timeline;

pub use app::{Stopper, ViewerError, run};
pub use document::Document;
pub use options::Options;
pub use picture_window::{Display, PictureWindow, Shown};
pub use preferences::config_folder;
pub use screen::ScreenError;
