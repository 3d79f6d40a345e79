//! What measured.

use serde::{Deserialize, Serialize};

use crate::gpu::DeviceDescription;

/// What measured.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Name that the driver gives it.
    pub device: String,
    /// Name and version.
    pub driver: String,
    /// This program, its version and, where it was built in a clone, the commit that it was built on: edits since are
    /// not recorded.
    pub program: String,
    /// How frames were shown in a window, by Vulkan's word, such as `mailbox`; `None` where none was.
    pub present_mode: Option<String>,
}

impl Machine {
    /// One line for a chart: what measured, `picture`, and whether the validation layers watched.
    pub fn caption(&self, picture: &str, validation: bool) -> String {
        let watched = if validation { " · under validation" } else { "" };
        format!("{} ({}) · {picture} · {}{watched}", self.device, self.driver, self.program)
    }

    /// This program on a device, nothing shown.
    pub fn of(device: &DeviceDescription) -> Self {
        let version = concat!("zerkalo ", env!("CARGO_PKG_VERSION"));
        let program = option_env!("ZERKALO_COMMIT")
            .map_or(version.to_owned(), |commit| format!("{version} (on commit {commit})"));
        Self { device: device.name.clone(), driver: device.driver.clone(), program, present_mode: None }
    }
}
