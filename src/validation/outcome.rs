use serde::Serialize;

use super::{Findings, Group, PICTURE, Run, Switch, switches};
use crate::gpu::{Check, DeviceDescription, Layer, Remark, Validation};

/// What was drawn under validation, and what was said of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Outcome {
    pub device: String,
    pub driver: String,
    pub layer: Layer,
    pub quick: bool,
    /// Pixels.
    pub width: u32,
    pub height: u32,
    /// False after Ctrl-C or a failure.
    pub complete: bool,
    pub checks: Vec<TriedCheck>,
    pub passes: Vec<Pass>,
    /// Why nothing was drawn in a window; `None` where it was.
    pub no_window: Option<String>,
    /// What plans turn on or off, with the runs of a pass that have it so.
    pub switches: Vec<Switch>,
    /// Of all groups.
    pub message_count: usize,
    pub messages: Vec<Group>,
    pub remarks: Vec<Remarked>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct TriedCheck {
    pub validation: &'static str,
    pub check: Check,
    /// Whether a mistake made on purpose was told.
    pub works: bool,
}

/// Runs under one kind of validation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Pass {
    pub validation: &'static str,
    pub in_window: bool,
    pub runs: usize,
    /// How many of them were begun.
    pub begun: usize,
}

/// What a layer said that is no fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Remarked {
    pub count: usize,
    #[serde(flatten)]
    pub remark: Remark,
}

impl Remarked {
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

    pub fn take_in(&mut self, findings: Findings) {
        self.message_count = findings.count();
        let Findings { groups, remarks } = findings;
        self.messages = groups;
        self.remarks = remarks.into_iter().map(Remarked::of).collect();
    }
}

impl Pass {
    pub fn new(validation: Validation, in_window: bool, runs: usize) -> Self {
        Self { validation: validation.name(), in_window, runs, begun: 0 }
    }
}
