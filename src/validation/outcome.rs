use serde::Serialize;

use super::{Findings, Group, PICTURE, Run, Switch, switches};
use crate::gpu::{Check, DeviceDescription, Layer, Remark, Validation};

/// What was drawn under validation, and what was said of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Outcome {
    /// Its name, as the driver gives it.
    pub device: String,
    /// Its name and version, as the driver gives them.
    pub driver: String,
    /// The layer that checked.
    pub layer: Layer,
    /// Whether the runs are those of [`Scope::EverySwitch`](super::Scope::EverySwitch).
    pub quick: bool,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// False after Ctrl-C or a failure.
    pub complete: bool,
    /// Checks of every kind of validation that was asked for.
    pub checks: Vec<TriedCheck>,
    /// First those off screen, then those in a window.
    pub passes: Vec<Pass>,
    /// Why nothing was drawn in a window; `None` where it was.
    pub no_window: Option<String>,
    /// What plans turn on or off, with the runs of a pass that have it so.
    pub switches: Vec<Switch>,
    /// Number of messages in all groups.
    pub message_count: usize,
    /// What is at fault, in the order of their first messages.
    pub messages: Vec<Group>,
    /// What is not at fault.
    pub remarks: Vec<Remarked>,
}

/// A check that was tested before it was relied on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct TriedCheck {
    /// Name of the kind that asks for it.
    pub validation: &'static str,
    /// Which should have reported the mistake.
    pub check: Check,
    /// Whether a mistake made on purpose was reported.
    pub works: bool,
}

/// Runs under one kind of validation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Pass {
    /// Name of that kind.
    pub validation: &'static str,
    /// Whether they are drawn in a window, rather than off screen.
    pub in_window: bool,
    /// How many there are to be drawn.
    pub runs: usize,
    /// How many of them were begun.
    pub begun: usize,
}

/// What a layer said that is no fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Remarked {
    /// How often it was said.
    pub count: usize,
    /// In JSON its fields stand beside `count`.
    #[serde(flatten)]
    pub remark: Remark,
}

impl Remarked {
    /// Of an entry of [`Findings::remarks`].
    pub fn of((remark, count): (Remark, usize)) -> Self {
        Self { count, remark }
    }
}

impl Outcome {
    /// Nothing drawn yet.
    pub fn new(device: &DeviceDescription, layer: Layer, quick: bool, runs: &[Run]) -> Self {
        let [width, height] = PICTURE;
        Self {
            device: device.name.clone(),
            driver: device.driver.clone(),
            layer,
            quick,
            width,
            height,
            complete: false,
            checks: Vec::new(),
            passes: Vec::new(),
            no_window: None,
            switches: switches(runs),
            message_count: 0,
            messages: Vec::new(),
            remarks: Vec::new(),
        }
    }

    /// In place of what was taken in before.
    pub fn take_in(&mut self, findings: Findings) {
        self.message_count = findings.count();
        let Findings { groups, remarks } = findings;
        self.messages = groups;
        self.remarks = remarks.into_iter().map(Remarked::of).collect();
    }
}

impl Pass {
    /// With none of the `runs` begun.
    pub fn new(validation: Validation, in_window: bool, runs: usize) -> Self {
        Self { validation: validation.name(), in_window, runs, begun: 0 }
    }
}
