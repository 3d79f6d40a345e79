//! `zerkalo devices`: what the machine has, and what each device lacks.

use anyhow::Result;
use clap::Args;

use super::{print_json, print_line};
use crate::gpu::{self, DeviceDescription, GpuError};

/// List the Vulkan devices
#[derive(Debug, Clone, Args)]
pub struct DevicesArgs {
    /// Print a JSON array
    #[arg(long)]
    pub json: bool,
}

pub fn run(args: &DevicesArgs) -> Result<()> {
    let devices = gpu::devices()?;
    if devices.is_empty() {
        return Err(GpuError::NoDriver.into());
    }
    if args.json {
        return print_json(&devices);
    }

    let default = gpu::choose(&devices, None);
    devices.iter().try_for_each(|device| print_line(&line(device, default.as_ref().is_ok_and(|&i| i == device.index))))
}

fn line(device: &DeviceDescription, is_default: bool) -> String {
    let state = match (device.lacks.as_slice(), is_default) {
        ([], true) => "usable, the default".to_owned(),
        ([], false) => "usable".to_owned(),
        (lacks, _) => format!("lacks {}", lacks.join(", ")),
    };
    let DeviceDescription { index, name, kind, driver, api_version, .. } = device;
    format!("{index}  {name} ({}, Vulkan {api_version}, {driver}): {state}", kind.name())
}
