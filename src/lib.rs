//! A low-level Vulkan ray tracer for simple solids with adjustable reflection.
//!
//! The modules stand in the order the data takes: a [`scene`] is read or edited, becomes a [`frame`], which is
//! [measured](measure); each [`command`] goes that way or a part of it.

pub mod scene;

pub mod frame;

pub mod measure;

pub mod command;
