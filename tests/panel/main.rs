//! The panel driven by its names, as a screen reader would drive it: a real state, no window, no device.

mod editing;
mod fields;
mod files;
mod hands;
mod primitives;
mod timeline;
mod widgets;
mod window;
