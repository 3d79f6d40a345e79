//! A low-level Vulkan ray tracer for simple solids with adjustable reflection.
//!
//! The modules stand in the order the data takes: a [`scene`] is read or edited.

pub mod scene;
