//! Ctrl-C. While work listens, the first asks it to stop where it loses nothing; otherwise, and the second time, the
//! program ends at once. Neither leaves a half-written file.

use std::io::Write;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::whole_file;

/// Exit code of a program ended by SIGINT, as shells report it.
pub const EXIT_CODE: u8 = 130;

static LISTENED_TO: AtomicBool = AtomicBool::new(false);
static REQUESTED: AtomicBool = AtomicBool::new(false);
static WAKE: Mutex<Option<Box<dyn Fn() + Send>>> = Mutex::new(None);

/// To be called once, at the start.
pub fn handle() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        let is_second = REQUESTED.swap(true, Ordering::Relaxed);
        if is_second || !LISTENED_TO.load(Ordering::Relaxed) {
            whole_file::remove_unfinished();
            // The one line of every failed run; where it cannot be written, the exit code says as much.
            let _ = writeln!(std::io::stderr(), "zerkalo: stopped");
            std::process::exit(EXIT_CODE.into());
        }
        if let Some(wake) = &*WAKE.lock().unwrap_or_else(PoisonError::into_inner) {
            wake();
        }
    })
}

/// While it lives, Ctrl-C only sets what [`Listener::stop_requested`] returns.
pub struct Listener(());

impl Listener {
    /// For work that asks [`Listener::stop_requested`] now and then.
    pub fn start() -> Self {
        LISTENED_TO.store(true, Ordering::Relaxed);
        Self(())
    }

    /// For work that sleeps: Ctrl-C also calls `wake`, from another thread.
    pub fn waking(wake: impl Fn() + Send + 'static) -> Self {
        *WAKE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(wake));
        Self::start()
    }

    /// Whether Ctrl-C has come while this or an earlier one lived.
    pub fn stop_requested(&self) -> bool {
        REQUESTED.load(Ordering::Relaxed)
    }

    /// What work that asks whether to go on is told.
    pub fn keep_going(&self) -> ControlFlow<()> {
        if self.stop_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        LISTENED_TO.store(false, Ordering::Relaxed);
        *WAKE.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }
}
