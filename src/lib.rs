//! A low-level Vulkan ray tracer for simple solids with adjustable reflection.
//!
//! The modules stand in the order the data takes: a [`scene`] is read or edited, becomes a [`frame`].

pub mod scene;

pub mod frame;
