//! The kernels on a device, through the library.

#[path = "../budget/mod.rs"]
mod budget;
#[path = "../common/mod.rs"]
mod common;
#[expect(dead_code, reason = "the reference, which is judged by all of it, judges most of what the kernels do")]
#[path = "../oracle/mod.rs"]
mod oracle;
mod probe;
#[path = "../random/mod.rs"]
mod random;
#[path = "../scenes/mod.rs"]
mod scenes;
mod spirv_walk;
mod tracers;

mod absent_features;
mod barriers;
mod canvas;
mod devices;
mod error_budget;
mod goldens;
mod hierarchy;
mod light_model;
mod path_numbers;
mod path_tracing;
mod record_layout;
mod rendering;
mod right_by_default;
mod sampling;
mod sharing;
mod ssr;
mod stability;
mod validation;
mod whitted_arithmetic;
mod whitted_kernel;
mod whitted_pictures;
mod whitted_rays;
