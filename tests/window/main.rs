//! The window from end to end: the program under Xvfb, driven by mouse and keyboard, its device under validation. Every
//! window that is closed by its menu must have ended without a word of the validation layer.

mod camera;
mod course;
mod driver;
mod editing;
mod endings;
mod endurance;
mod files;
mod fps;
mod geometry;
mod pictures;
mod sizes;
mod timeline;
mod timing;
mod validation;
