//! `zerkalo render SCENE -o OUT`: one picture into a file, timed.

use std::ops::ControlFlow;
use std::path::PathBuf;

use anyhow::Result;
use clap::builder::RangedI64ValueParser;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::interrupt::Listener;
use super::plan::{limits_of, parse_error};
use super::{DeviceArgs, print_json, refuse_messages, scene_named};
use crate::frame::Frame;
use crate::gpu::{Device, DeviceDescription, Message, Validation};
use crate::measure::median;
use crate::plan::{Plan, Wishes};
use crate::reference::{self, RenderError};
use crate::scene::{DEPTH_LIMIT, Scene};
use crate::tracer::sampling::{MAX_SAMPLES, Sampling};
use crate::tracer::{self, Settings, Tracer, TracerError};

/// Which of the program's tracers draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kernel {
    /// The course work's, quirks and all
    Course,
    /// The accurate model by textbook quadratics in f32: what accuracy costs and gains is measured against it
    Plain,
    /// The accurate model
    #[default]
    Whitted,
    /// The accurate model in f64 on the CPU, without Vulkan: the truth, slowly
    Reference,
}

/// What the accurate kernel calculates in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    #[default]
    F32,
    /// Only where the device has it
    F64,
}

/// Render a scene into a PNG (display values) or EXR (linear values) file
#[derive(Debug, Clone, Args)]
pub struct RenderArgs {
    /// A scene file (.toml, .json, .zscene) or a name of `zerkalo gallery`
    pub scene: String,
    /// The picture to write: .png or .exr
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Pixels, each side 1 to 16384
    #[arg(long, value_name = "WxH", default_value = "1621x701", value_parser = parse_size)]
    pub size: (u32, u32),
    /// Which tracer draws
    #[arg(long, value_enum, default_value_t)]
    pub kernel: Kernel,
    /// What the whitted kernel calculates in [default: f32, where it is known to keep the error]
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Generations of a ray, in place of the scene's
    #[arg(long, value_name = "N", value_parser = parse_depth())]
    pub max_depth: Option<u32>,
    /// Largest change of any linear channel by what the whitted kernel leaves out, such as 0.002 or 1/510; 0 is exact
    #[arg(long, value_name = "E", default_value = "0", value_parser = parse_error)]
    pub error: f64,
    /// Anti-aliasing by the whitted kernel: a pixel is the mean of so many rays through fixed places in it, 1 to 64
    #[arg(long, value_name = "N", default_value = "1", value_parser = parse_samples())]
    pub samples: u32,
    /// Size of the picture that the whitted kernel traces against that of OUT, to which it is brought bilinearly: 1/4 to 1
    #[arg(long, value_name = "S", default_value = "1", value_parser = parse_scale)]
    pub scale: f64,
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Render once to warm up, then N times, and report the median GPU time
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: Option<u32>,
    /// Run under core, synchronization and GPU-assisted validation; any message is a failure
    #[arg(long)]
    pub validate: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

impl Precision {
    /// As the library calls it.
    pub(super) fn in_library(self) -> tracer::Precision {
        match self {
            Self::F32 => tracer::Precision::F32,
            Self::F64 => tracer::Precision::F64,
        }
    }

    fn of_library(precision: tracer::Precision) -> Self {
        match precision {
            tracer::Precision::F32 => Self::F32,
            tracer::Precision::F64 => Self::F64,
        }
    }
}

pub(super) fn parse_depth() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(DEPTH_LIMIT))
}

fn parse_samples() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES))
}

/// Such as 0.5 or 1/2.
fn parse_scale(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let scale = match text.split_once('/') {
        Some((above, below)) => number(above).zip(number(below)).map(|(above, below)| above / below),
        None => number(text),
    };
    let scale = scale.ok_or("it must be a number or a fraction, such as 0.5 or 1/2")?;
    Sampling { scale, ..Sampling::PLAIN }.check().map_err(|error| error.to_string())?;
    Ok(scale)
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X', '×']);
    let size = sides.and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height) = size.ok_or("it must be WIDTHxHEIGHT in pixels, such as 1621x701")?;
    Frame::check_size(width, height).map_err(|error| error.to_string())?;
    Ok((width, height))
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report<'a> {
    width: u32,
    height: u32,
    kernel: Kernel,
    /// What the kernel calculated in.
    precision: Precision,
    /// No linear channel is changed more by what was left out.
    error_bound: f64,
    samples_per_pixel: u32,
    /// Size of the traced picture against this one.
    scale: f64,
    device: &'a str,
    driver: &'a str,
    /// Median of `samples_ns`; null where there is none: no timestamps, or no Vulkan device.
    gpu_time_ns: Option<u64>,
    /// GPU time of each repeat, in order; without `--repeat` of the one, cold, render.
    samples_ns: &'a [u64],
    validation_messages: usize,
}

/// A picture, what drew it, and what is to be told of that.
struct Rendered {
    frame: Frame,
    precision: Precision,
    error_bound: f64,
    device: String,
    driver: String,
    samples_ns: Vec<u64>,
    messages: Vec<Message>,
}

/// Renders, saves, reports. Fails after saving when validation had anything to say.
pub fn run(args: &RenderArgs) -> Result<()> {
    Frame::check_output_path(&args.output)?;
    let scene = scene_named(&args.scene)?;
    check_precision(args)?;
    if args.error > 0.0 && args.kernel != Kernel::Whitted {
        return Err(
            TracerError::Refused("only the whitted kernel leaves anything out: --error is for it".to_owned()).into()
        );
    }
    for (option, is_given) in [("--samples", args.samples > 1), ("--scale", args.scale < 1.0)] {
        if is_given && args.kernel != Kernel::Whitted {
            return Err(TracerError::Refused(format!("{option} is for the whitted kernel only")).into());
        }
    }
    let rendered = match args.kernel {
        Kernel::Course | Kernel::Plain | Kernel::Whitted => on_device(args, &scene)?,
        Kernel::Reference => on_cpu(args, scene)?,
    };
    rendered.frame.save(&args.output)?;
    report(args, &rendered)?;
    refuse_messages(&rendered.messages)
}

/// The other kernels know only one.
fn check_precision(args: &RenderArgs) -> Result<(), TracerError> {
    match (args.kernel, args.precision) {
        (Kernel::Course, Some(Precision::F64)) => {
            Err(TracerError::Refused("the course kernel calculates in f32 only; --kernel whitted has f64".to_owned()))
        }
        (Kernel::Plain, Some(Precision::F64)) => {
            Err(TracerError::Refused("the plain kernel calculates in f32 only; --kernel whitted has f64".to_owned()))
        }
        (Kernel::Reference, Some(Precision::F32)) => {
            Err(TracerError::Refused("the reference calculates in f64 only; --kernel whitted has f32".to_owned()))
        }
        _ => Ok(()),
    }
}

fn on_device(args: &RenderArgs, scene: &Scene) -> Result<Rendered> {
    let validation = if args.validate { Validation::GpuAssisted } else { Validation::Off };
    // From before the driver's threads compile anything until they are gone: a program that ends in their midst may crash.
    let listener = Listener::start();
    let device = Device::open(args.device.device.as_deref(), validation)?;
    let DeviceDescription { name, driver, .. } = device.description().clone();
    let messages = device.messages().clone();

    let (settings, error_bound) = settings(args, scene, device.description())?;
    let mut tracer = Tracer::new(&device, scene, &settings)?;
    let (frame, samples_ns) = render(&mut tracer, args.repeat, &listener)?;
    // Destroyed before the messages are counted: the layers check that too.
    drop((tracer, device));
    if listener.stop_requested() {
        return Err(TracerError::Stopped.into());
    }
    let precision = Precision::of_library(settings.kernel.precision());
    Ok(Rendered { frame, precision, error_bound, device: name, driver, samples_ns, messages: messages.to_vec() })
}

fn on_cpu(args: &RenderArgs, mut scene: Scene) -> Result<Rendered> {
    for (option, is_given) in [("--repeat", args.repeat.is_some()), ("--validate", args.validate)] {
        if is_given {
            return Err(TracerError::Refused(format!("{option} is for kernels on a Vulkan device")).into());
        }
    }
    scene.max_depth = args.max_depth.unwrap_or(scene.max_depth);
    let (width, height) = args.size;
    let mut frame = Frame::new(width, height)?;
    let bar = progress_bar(u64::from(height));
    let listener = Listener::start();
    let image = reference::render(&scene, width, height, &|rows_done| {
        bar.set_position(u64::from(rows_done));
        if listener.stop_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    bar.finish_and_clear();
    let image = image.map_err(|error| match error {
        RenderError::Cancelled => TracerError::Stopped.into(),
        error => anyhow::Error::from(error),
    })?;
    frame.pixels_mut().copy_from_slice(&image.to_f32());
    let driver = concat!("zerkalo ", env!("CARGO_PKG_VERSION"), ", f64").to_owned();
    Ok(Rendered {
        frame,
        precision: Precision::F64,
        error_bound: 0.0,
        device: "CPU".to_owned(),
        driver,
        samples_ns: Vec::new(),
        messages: Vec::new(),
    })
}

/// With the bound on the change by what is left out.
fn settings(args: &RenderArgs, scene: &Scene, device: &DeviceDescription) -> Result<(Settings, f64)> {
    let (width, height) = args.size;
    let settings = Settings { max_depth: args.max_depth, ..Settings::new(width, height) };
    Ok(match args.kernel {
        Kernel::Course | Kernel::Reference => (settings, 0.0),
        Kernel::Plain => (Settings { kernel: tracer::Kernel::Plain, ..settings }, 0.0),
        Kernel::Whitted => {
            let precision = args.precision.map(Precision::in_library);
            let wishes = Wishes { precision, max_depth: args.max_depth, error: args.error, width, height };
            let plan = Plan::for_scene(scene, &wishes, &limits_of(device))?;
            let &RenderArgs { samples, scale, .. } = args;
            (Settings { samples, scale, ..Settings::planned(&plan, width, height) }, plan.bounds.total())
        }
    })
}

/// The frame and the GPU time of every measured render.
fn render(tracer: &mut Tracer, repeat: Option<u32>, listener: &Listener) -> Result<(Frame, Vec<u64>)> {
    let warm_ups = u64::from(repeat.is_some());
    let measured = repeat.map_or(1, u64::from);
    let mut frame = tracer.frame()?;
    let frame_pixels = u64::from(frame.width()) * u64::from(frame.height());
    let bar = progress_bar(frame_pixels * (warm_ups + measured));

    let mut samples_ns = Vec::new();
    for index in 0..warm_ups + measured {
        let gpu_time_ns = tracer.render(&mut frame, &mut |pixels_done| {
            bar.set_position(index * frame_pixels + pixels_done);
            if listener.stop_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        if index >= warm_ups {
            samples_ns.extend(gpu_time_ns);
        }
    }
    bar.finish_and_clear();
    Ok((frame, samples_ns))
}

/// Drawn on a terminal only.
fn progress_bar(pixels: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {percent}% {elapsed} (about {eta} left)");
    let bar = ProgressBar::new(pixels).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.tick();
    bar
}

fn report(args: &RenderArgs, rendered: &Rendered) -> Result<()> {
    let Rendered { precision, error_bound, device, driver, samples_ns, messages, .. } = rendered;
    let gpu_time_ns = median(samples_ns);
    let (width, height) = args.size;
    if args.json {
        return print_json(&Report {
            width,
            height,
            kernel: args.kernel,
            precision: *precision,
            error_bound: *error_bound,
            samples_per_pixel: args.samples,
            scale: args.scale,
            device,
            driver,
            gpu_time_ns,
            samples_ns,
            validation_messages: messages.len(),
        });
    }
    let time = gpu_time_ns.map_or("no GPU time".to_owned(), |time| format!("{:.2} ms GPU time", time as f64 / 1e6));
    let of = match args.repeat {
        Some(_) => format!(", median of {}", samples_ns.len()),
        None if samples_ns.is_empty() => String::new(),
        None => ", with the driver's warm-up".to_owned(),
    };
    let output = args.output.display().to_string();
    let bound = if *error_bound > 0.0 { format!(", at most {error_bound:.3e} off") } else { String::new() };
    let samples = if args.samples > 1 { format!(", {} samples a pixel", args.samples) } else { String::new() };
    let scale = if args.scale < 1.0 { format!(", traced at {:.4} of that", args.scale) } else { String::new() };
    let picture = format!("{width}x{height}{scale}{samples}");
    super::print_line(&format!("wrote {} ({picture}, {device}, {time}{of}{bound})", output.escape_debug()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_decimals_and_fractions_within_the_limits() {
        for (text, scale) in [("1", 1.0), ("0.25", 0.25), ("1/2", 0.5), (" 3 / 4 ", 0.75)] {
            assert_eq!(parse_scale(text), Ok(scale), "{text}");
        }
        for bad in ["", "0", "-1", "1/5", "2", "1/0", "nan", "x", "1/2/3", "0.2499", "inf"] {
            assert!(parse_scale(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn sizes_are_two_sides_within_the_limits() {
        assert_eq!(parse_size("1621x701"), Ok((1621, 701)));
        assert_eq!(parse_size("1X16384"), Ok((1, 16384)));
        for bad in ["", "x", "10", "10x", "0x5", "5x0", "16385x1", "-1x5", "1.5x2", "99999999999x1", "1x2x3"] {
            assert!(parse_size(bad).is_err(), "{bad}");
        }
    }
}
