//! What a frame is worth: how far it is from another, and what it costs.

pub mod algorithms;
mod discontinuity;
mod error_map;
pub mod fps_table;
mod gallery_maps;
mod image_error;
mod machine;
mod mask;
pub(crate) mod output;
pub mod stability;
mod statistics;
mod timing;
pub mod trade;

pub use discontinuity::{Difference, tolerances};
pub use error_map::error_scale;
pub(crate) use error_map::{LARGEST_ERROR, SMALLEST_ERROR, error_color, error_map};
pub use gallery_maps::{Drawn, KernelMap, SceneMaps, SceneMapsError, scene_maps};
pub(crate) use image_error::rmse;
pub use image_error::{ComparisonError, ErrorDomain, ImageError, image_error};
pub use machine::Machine;
pub use mask::Mask;
pub use statistics::quartiles;
pub(crate) use statistics::{Summary, median, prediction_limit};
pub use timing::{Budget, Clock};
pub(crate) use timing::{FrameTime, TimedTracer};
