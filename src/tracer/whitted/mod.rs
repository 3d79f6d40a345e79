//! The accurate kernel and the plain one, `glsl/whitted.comp`: what a scene is to them, and how they draw it.

mod features;
pub mod hierarchy;
mod pipeline;
mod proxies;
mod records;
mod renderer;
mod rows;
mod scene;

pub(super) use pipeline::threads;
pub use records::{SolidRecords, WhittedPushConstants, WhittedRecords};
pub(super) use renderer::{WhittedRenderer, WhittedState};
pub use scene::{check_precision, scene_bindings, upload_scene};
