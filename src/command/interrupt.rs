//! Ctrl-C: the first asks the work to stop where it loses nothing, the second ends the program at once.

use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code of a program ended by SIGINT, as shells report it.
pub const EXIT_CODE: u8 = 130;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// To be called once, at the start.
pub fn listen() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT_CODE.into());
        }
    })
}

pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}
