//! A low-level Vulkan ray tracer for simple solids with adjustable reflection.
//!
//! The modules stand in the order the data takes: a [`scene`] is read or edited, a [`plan`] states what it requires of
//! one of the [algorithms](algorithm), a [`tracer`] draws it, as [`settings`] say, on a device that [`gpu`] opened, or
//! the [`reference`](mod@reference) on the CPU, the picture is a [`frame`], which is saved and [measured](measure);
//! [`validation`] has all of it drawn under Vulkan's validation layers, and a [`report`] shows what came of it; each
//! [`command`] goes that way or a part of it.

pub mod scene;

pub mod algorithm;

pub mod plan;

pub mod reference;

#[allow(unsafe_code, reason = "Vulkan is called here, and nowhere else")]
pub mod gpu;

pub mod tracer;

pub mod settings;

pub mod frame;

pub mod measure;

pub mod validation;

pub mod report;

pub mod viewer;

pub mod command;

mod whole_file;
