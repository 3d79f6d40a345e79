//! Drives the window from outside, as a hand and an eye would: X events go in through xdotool, and lines of
//! `view --observe`, files and screenshots come out.

mod desk;
mod display;
mod hands;
mod observation;
mod window;

pub use desk::{Desk, Locale};
pub use observation::Observation;
pub use window::Window;
