//! One progress bar for all sections, and Ctrl-C.

use std::cell::Cell;
use std::ops::ControlFlow;

use indicatif::ProgressBar;

use crate::command::interrupt::Listener;
use crate::command::progress_bar;

/// Steps of the bar.
const STEPS: u64 = 10_000;

pub struct Watch {
    pub listener: Listener,
    bar: ProgressBar,
    /// Weights of the sections before.
    before: Cell<f64>,
}

/// All weights together.
const ALL: f64 = 258.0;

impl Watch {
    pub fn start() -> Self {
        Self { listener: Listener::start(), bar: progress_bar(STEPS), before: Cell::new(0.0) }
    }

    /// Progress of the next section. `weight`: the share of the whole that it takes, in any unit that is the same for
    /// all.
    pub fn progress(&self, name: &'static str, weight: f64) -> Progress<'_> {
        let before = self.before.replace(self.before.get() + weight);
        Progress { listener: &self.listener, bar: &self.bar, name, before, weight }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Progress of one section.
pub struct Progress<'a> {
    listener: &'a Listener,
    bar: &'a ProgressBar,
    name: &'static str,
    before: f64,
    weight: f64,
}

impl Progress<'_> {
    /// `share`: of the section that is done, 0 to 1. `what` is next. Breaks after Ctrl-C.
    pub fn at(&self, share: f64, what: &str) -> ControlFlow<()> {
        self.bar.set_position(((self.before + self.weight * share) / ALL * STEPS as f64) as u64);
        self.bar.set_message(format!("{} {what}", self.name));
        self.go_on()
    }

    /// Breaks after Ctrl-C.
    pub fn go_on(&self) -> ControlFlow<()> {
        self.listener.keep_going()
    }
}
