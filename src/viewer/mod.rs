//! The window: the course's program alive, a scene edited by hand and traced as it changes.
//!
//! Events go into a [`state::State`] as [`action::Action`]s, which the [`panel`], the mouse in the picture and the
//! keyboard all speak; what a state looks like is drawn by the panel and traced by a tracer. All of it but the window
//! and the swapchain is plain data and pure functions, tested without either.

pub mod action;
mod camera_frame;
pub mod camera_motion;
pub mod document;
mod edits;
pub mod frame_times;
mod history;
pub mod outline;
pub mod panel;
pub mod pick;
pub mod preferences;
pub mod recovery_file;
pub mod state;
pub mod text;

pub use document::Document;
pub use preferences::config_folder;
