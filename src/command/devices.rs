//! `zerkalo devices`: what the machine has, and what each device lacks.

use anyhow::Result;
use clap::Args;

use super::{print_json, print_line};
use crate::gpu::{self, Arithmetic, DeviceDescription};

/// List the Vulkan devices
#[derive(Debug, Clone, Args)]
pub struct DevicesArgs {
    /// Print a JSON array
    #[arg(long)]
    pub json: bool,
}

pub fn run(args: &DevicesArgs) -> Result<()> {
    let tried = gpu::tried_devices()?;
    if args.json {
        return print_json(&tried);
    }

    let descriptions: Vec<_> = tried.iter().map(|device| device.description.clone()).collect();
    let default = gpu::choose(&descriptions, None);
    for device in &tried {
        let is_default = default.as_ref().is_ok_and(|&index| index == device.description.index);
        print_line(&line(&device.description, is_default))?;
        if !device.description.lacks.is_empty() {
            continue;
        }
        for (name, arithmetic) in [("f32", &device.f32_arithmetic), ("f64", &device.f64_arithmetic)] {
            let line = arithmetic.as_ref().map_or("none (it lacks shaderFloat64)".to_owned(), arithmetic_line);
            print_line(&format!("   {name}: {line}"))?;
        }
        print_line(&format!("   {}", limits_line(&device.description)))?;
    }
    Ok(())
}

fn limits_line(device: &DeviceDescription) -> String {
    let timestamps = if device.timestamps { "GPU time is measured" } else { "no timestamps: no GPU time" };
    let storage_mib = device.max_storage_bytes >> 20;
    format!("limits: tiles of {0}x{0} pixels, arrays of {storage_mib} MiB; {timestamps}", device.max_image_side)
}

fn arithmetic_line(arithmetic: &Arithmetic) -> String {
    let &Arithmetic {
        exact_sums,
        fused_fma,
        keeps_nan,
        keeps_infinity,
        division_error_ulp,
        square_root_error_ulp,
        round_to_nearest_declared,
        nan_preserve_declared,
    } = arithmetic;
    let word = |is: bool, yes: &'static str, no: &'static str| if is { yes } else { no };
    let words = [
        word(exact_sums, "sums and products exact", "SUMS AND PRODUCTS NOT EXACT: no error bound holds"),
        word(fused_fma, "fma fused", "fma not fused (Dekker's products)"),
        word(keeps_nan, "NaN kept", "NaN lost"),
        word(keeps_infinity, "infinities kept", "infinities lost"),
    ];
    let promised = match (round_to_nearest_declared, nan_preserve_declared) {
        (true, true) => "rounding to nearest, NaN and infinities",
        (true, false) => "rounding to nearest",
        (false, true) => "NaN and infinities",
        (false, false) => "nothing",
    };
    format!(
        "{}, division {division_error_ulp:.2} ulp, square root {square_root_error_ulp:.2} ulp; promised by the driver: \
         {promised}",
        words.join(", ")
    )
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
