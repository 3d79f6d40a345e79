//! `zerkalo plan SCENE`: what a kernel will do for a scene, what is left out, and why.

use anyhow::Result;
use clap::Args;
use serde::Serialize;

use super::options::{parse_algorithm, parse_depth, parse_error, parse_size};
use super::{DeviceArgs, ReadingArgs, print_json, print_line, size_or_offered};
use crate::algorithm::{Algorithm, Description, Precision};
use crate::gpu::{self, CompiledKernel, Device, DeviceDescription, GpuError, Statistic};
use crate::plan::{Approximations, Bounds, Limits, Line, Plan};
use crate::scene::Scene;
use crate::scene::format::Reading;
use crate::settings::{RenderSettings, Shading};
use crate::tracer::{Settings, compile, limits_of};

/// Tell what will run for a scene, what is left out and why, and what that saves
#[derive(Debug, Clone, Args)]
pub struct PlanArgs {
    /// A scene file (.toml, .json, .zscene, .nff) or a name of `zerkalo gallery`
    pub scene: String,
    #[command(flatten)]
    pub reading: ReadingArgs,
    /// Largest allowed change of any linear channel, such as 0.002 or 1/510; 0 is exact
    #[arg(long, value_name = "E", default_value = "0", value_parser = parse_error, allow_hyphen_values = true)]
    pub error: f64,
    /// Which algorithm is to draw
    #[arg(long, value_parser = parse_algorithm(Description::is_on_device), default_value = "whitted")]
    pub algorithm: Algorithm,
    /// What the kernel calculates in, in place of what the plan chooses
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Generations of a ray, in place of the scene's
    #[arg(long, value_name = "N", value_parser = parse_depth())]
    pub max_depth: Option<u32>,
    /// How much of the light model is drawn
    #[arg(long, value_enum, default_value_t)]
    pub shading: Shading,
    /// Pixels, each side 1 to 16384 [default: what the scene's file says, else 1621x701]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Plan for what every Vulkan 1.2 device has, whatever there is here
    #[arg(long, conflicts_with = "device")]
    pub no_device: bool,
    /// Compile what draws the scene, and tell what the device's compiler made of it, such as registers and spills.
    /// Nothing is run, so that the device need not have hardware
    #[arg(long, conflicts_with = "no_device")]
    pub compile: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report<'a> {
    scene: &'a str,
    width: u32,
    height: u32,
    /// Null where the plan is for what every Vulkan device has.
    device: Option<&'a str>,
    /// The allowed change of a linear channel, and the bound on it that the plan relies on.
    error: f64,
    bound: f64,
    bounds: Bounds,
    #[serde(rename = "cuts")]
    approximations: Approximations,
    decisions: Vec<Line>,
    /// Why the picture will not be right; null where it will.
    warning: Option<String>,
    /// What the device's compiler made of what draws; null where that is not asked for.
    compiled: Option<Vec<CompiledKernel>>,
}

pub fn run(args: &PlanArgs) -> Result<()> {
    let Reading { scene, size, .. } = args.reading.read(&args.scene)?;
    let device = device(args)?;
    let limits = device.as_ref().map_or(Limits::PROMISED, limits_of);
    let [width, height] = size_or_offered(args.size, size);
    let settings = RenderSettings {
        algorithm: args.algorithm,
        precision: args.precision,
        max_depth: args.max_depth,
        error: args.error,
        shading: args.shading,
        ..RenderSettings::default()
    };
    let scene = args.shading.applied(&scene);
    let plan = Plan::for_scene(&scene, &settings, [width, height], &limits)?.with_f32_tried(&scene);
    let compiled = match &device {
        Some(device) if args.compile => Some(compiled(device.index, &scene, &plan)?),
        None if args.compile => return Err(GpuError::NoDriver.into()),
        _ => None,
    };
    let device = device.as_ref().map(|device| device.name.as_str());
    if args.json {
        return print_json(&Report {
            scene: &args.scene,
            width,
            height,
            device,
            error: plan.settings.error,
            bound: plan.bounds.total(),
            bounds: plan.bounds,
            approximations: plan.approximations,
            decisions: plan.lines(),
            warning: plan.warning(),
            compiled,
        });
    }
    let device = device.unwrap_or("any Vulkan 1.2 device (none is at hand)");
    print_line(&format!("{} at {width}x{height} on {device}", args.scene.escape_debug()))?;
    plan.lines().iter().try_for_each(|Line { what, choice, why, saves }| {
        let saves = saves.as_ref().map(|saves| format!("; saves {saves}")).unwrap_or_default();
        print_line(&format!("  {what:<14} {choice:<11} {why}{saves}"))
    })?;
    plan.warning().iter().try_for_each(|warning| print_line(&format!("warning: {warning}")))?;
    compiled.iter().flatten().try_for_each(print_compiled)
}

fn compiled(device_index: usize, scene: &Scene, plan: &Plan) -> Result<Vec<CompiledKernel>> {
    let device = Device::open_to_compile(Some(&device_index.to_string()))?;
    Ok(compile(&device, scene, &Settings::planned(plan))?)
}

fn print_compiled(CompiledKernel { kernel, executables }: &CompiledKernel) -> Result<()> {
    if executables.is_empty() {
        return print_line(&format!(
            "compiled {kernel}: this driver tells nothing of it (no VK_KHR_pipeline_executable_properties)"
        ));
    }
    for executable in executables {
        let gpu::Executable { name, subgroup_size, statistics } = executable;
        print_line(&format!("compiled {kernel}: {name}, {subgroup_size} invocations together"))?;
        statistics.iter().try_for_each(|Statistic { name, value, .. }| print_line(&format!("  {name:<30} {value}")))?;
    }
    Ok(())
}

/// The device that `render` would take; none where there is no Vulkan, for a plan needs only its limits.
fn device(args: &PlanArgs) -> Result<Option<DeviceDescription>, GpuError> {
    if args.no_device {
        return Ok(None);
    }
    let wanted = args.device.device.as_deref();
    let found = gpu::devices().and_then(|mut devices| {
        let index = gpu::choose(&devices, wanted)?;
        Ok(devices.swap_remove(index))
    });
    match found {
        Ok(device) => Ok(Some(device)),
        Err(error) if wanted.is_some() => Err(error),
        Err(GpuError::NoLoader(_) | GpuError::NoDriver | GpuError::OldLoader(_) | GpuError::NoSuitableDevice(_)) => {
            Ok(None)
        }
        Err(error) => Err(error),
    }
}
