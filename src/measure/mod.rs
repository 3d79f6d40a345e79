//! What a frame is worth: how far it is from another, and what it costs.

mod discontinuity;
pub mod fps_table;
mod image_error;
mod mask;
pub mod stability;
mod statistics;

pub use discontinuity::{Difference, bars};
pub use image_error::{ComparisonError, ErrorDomain, ImageError, image_error};
pub use mask::Mask;
pub use statistics::{Summary, median};
