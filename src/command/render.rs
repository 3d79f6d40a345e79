//! `zerkalo render SCENE -o OUT`: one picture into a file, timed.

mod paths;
mod ssr;

use std::io::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use serde::Serialize;

use super::drawing::DrawingArgs;
use super::interrupt::Listener;
use super::streams::{PictureFormat, STANDARD_INPUT, STREAM, StreamArgs, read_scene};
use super::{DeviceArgs, ReadingArgs, ValidationArgs, print_line, progress_bar, refuse_messages, size_or_offered};
use crate::algorithm::{Algorithm, Precision};
use crate::frame::Frame;
use crate::gpu::{Device, DeviceDescription, Messages};
use crate::measure::median;
use crate::plan::Plan;
use crate::reference::{self, RenderError};
use crate::scene::Scene;
use crate::scene::format::{FORMATS, Reading};
use crate::settings::RenderSettings;
use crate::settings::sampling::Sampling;
use crate::tracer::{ErrorEstimate, Progressive, Settings, Tracer, TracerError, limits_of};
use crate::validation::Remarked;
use paths::PathArgs;
use ssr::{SsrArgs, SsrShadows};

/// Render a scene into a PNG (display values) or EXR (linear values) file
#[derive(Debug, Clone, Args)]
pub struct RenderArgs {
    /// A scene file (.toml, .json, .zscene, .nff), a name of `zerkalo gallery`, or - for standard input
    pub scene: String,
    #[command(flatten)]
    pub reading: ReadingArgs,
    #[command(flatten)]
    pub streams: StreamArgs,
    /// The picture to write: .png or .exr, or - for standard output
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    #[command(flatten)]
    pub drawing: DrawingArgs,
    #[command(flatten)]
    pub paths: PathArgs,
    #[command(flatten)]
    pub ssr: SsrArgs,
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Render once to warm up, then N times, and report the median GPU time
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: Option<u32>,
    #[command(flatten)]
    pub validation: ValidationArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report<'a> {
    width: u32,
    height: u32,
    #[serde(rename = "kernel")]
    algorithm: Algorithm,
    /// What it calculated in.
    precision: Precision,
    /// No linear channel is changed more by what was left out.
    error_bound: f64,
    /// Why the picture is not right; null where it is.
    warning: &'a Option<String>,
    /// What the algorithm leaves out whatever the scene; null where it is nothing.
    note: &'a Option<String>,
    samples_per_pixel: u32,
    /// Of pixels by path tracing, estimated; null of others, and of too few samples.
    standard_error: Option<ErrorEstimate>,
    /// Size of the traced picture against this one.
    scale: f64,
    device: &'a str,
    driver: &'a str,
    /// Median of `samples_ns`, or of path tracing their sum; null where there is none: no timestamps, or no Vulkan
    /// device.
    gpu_time_ns: Option<u64>,
    /// GPU time of each repeat, in order; without `--repeat` of the one, cold, render; of path tracing, of each run over
    /// the picture.
    samples_ns: &'a [u64],
    validation_messages: usize,
    /// What the layer said that is no fault.
    validation_remarks: Vec<Remarked>,
}

/// A picture, what drew it, and what is to be reported of that.
struct Rendered {
    frame: Frame,
    algorithm: Algorithm,
    precision: Precision,
    sampling: Sampling,
    standard_error: Option<ErrorEstimate>,
    error_bound: f64,
    warning: Option<String>,
    note: Option<String>,
    device: String,
    driver: String,
    samples_ns: Vec<u64>,
    messages: Messages,
    /// Ctrl-C ended it early, and it was wanted as far as it had come.
    is_partial: bool,
}

/// Renders, saves, reports. Fails after saving when validation had anything to say.
pub fn run(args: &RenderArgs) -> Result<()> {
    let (is_from_stream, is_into_stream) = (args.scene == STREAM, args.output.as_os_str() == STREAM);
    args.streams.check(is_from_stream, is_into_stream)?;
    if is_into_stream {
        PictureFormat::check_output()?;
    } else {
        Frame::check_output_path(&args.output)?;
    }
    let Reading { scene, size, .. } = if is_from_stream {
        args.reading.told(STANDARD_INPUT, read_scene(args.streams.format.unwrap_or(&FORMATS[0]))?)?
    } else {
        args.reading.read(&args.scene)?
    };
    let size = size_or_offered(args.drawing.size, size);
    let setting = args.drawing.setting(args.paths.usual_samples())?;
    args.paths.check(setting.algorithm, args.repeat)?;
    args.ssr.check(setting.algorithm)?;
    let scene = setting.shading.applied(&scene);
    let rendered = if setting.algorithm.description().is_on_device() {
        on_device(args, size, &scene, &setting)?
    } else {
        on_cpu(args, size, scene.into_owned(), setting.max_depth)?
    };
    let told = told(args, &rendered)?;
    if is_into_stream {
        args.streams.output_format.unwrap_or_default().write(&rendered.frame)?;
        // The picture has standard output to itself.
        writeln!(io::stderr(), "{told}").context("could not write to standard error")?;
    } else {
        rendered.frame.save(&args.output)?;
        print_line(&told)?;
    }
    refuse_messages(&rendered.messages)?;
    if rendered.is_partial { Err(TracerError::Stopped.into()) } else { Ok(()) }
}

fn on_device(args: &RenderArgs, size: [u32; 2], scene: &Scene, setting: &RenderSettings) -> Result<Rendered> {
    // From before the driver's threads compile anything until they are gone: a program that ends in their midst may
    // crash.
    let listener = Listener::start();
    let device = Device::open(args.device.device.as_deref(), args.validation.validation())?;
    let DeviceDescription { name, driver, .. } = device.description().clone();
    let messages = device.messages().clone();

    let limits = limits_of(device.description());
    let plan = Plan::for_scene(scene, setting, size, &limits)?.with_f32_tried(scene);
    let (mut settings, error_bound, warning) = (Settings::planned(&plan), plan.bounds.total(), plan.warning());
    let note = plan.screen_space_line().map(|line| format!("{} {}: {}", line.what, line.choice, line.why));
    settings.approximations.shadows &= args.ssr.ssr_shadows == SsrShadows::Rays;
    if let Some(warning) = &warning {
        eprintln!("warning: {warning}");
    }
    let mut sampling = setting.sampling();
    let (frame, samples_ns, standard_error) = if setting.algorithm.description().is_statistical {
        let mut tracer = Progressive::new(&device, scene, &settings)?;
        let samples_ns = args.paths.add_runs(&mut tracer, setting.samples, &listener)?;
        sampling.samples = tracer.samples();
        (tracer.frame()?, samples_ns, tracer.error())
    } else {
        let mut tracer = Tracer::new(&device, scene, &settings)?;
        let (frame, samples_ns) = render(&mut tracer, args.repeat, &listener)?;
        if let Some(path) = &args.ssr.ssr_reasons {
            tracer.set_scene(scene, &Settings { shows_reasons: true, ..settings.clone() })?;
            render(&mut tracer, None, &listener)?.0.save(path)?;
        }
        (frame, samples_ns, None)
    };
    // Destroyed before the messages are counted: the layers check that too.
    drop(device);
    if listener.stop_requested() && !args.paths.keep_partial {
        return Err(TracerError::Stopped.into());
    }
    let precision = settings.kernel.precision();
    let algorithm = setting.algorithm;
    Ok(Rendered {
        frame,
        algorithm,
        precision,
        sampling,
        standard_error,
        error_bound,
        warning,
        note,
        device: name,
        driver,
        samples_ns,
        messages,
        is_partial: listener.stop_requested(),
    })
}

fn on_cpu(args: &RenderArgs, [width, height]: [u32; 2], mut scene: Scene, max_depth: Option<u32>) -> Result<Rendered> {
    for (option, is_given) in [("--repeat", args.repeat.is_some()), ("--validate", args.validation.is_on())] {
        if is_given {
            return Err(TracerError::Refused(format!("{option} is for kernels on a Vulkan device")).into());
        }
    }
    scene.max_depth = max_depth.unwrap_or(scene.max_depth);
    let mut frame = Frame::new(width, height)?;
    let bar = progress_bar(u64::from(height));
    let listener = Listener::start();
    let image = reference::render(&scene, width, height, &|rows_done| {
        bar.set_position(u64::from(rows_done));
        listener.keep_going()
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
        algorithm: Algorithm::Reference,
        precision: Precision::F64,
        sampling: Sampling::PLAIN,
        standard_error: None,
        error_bound: 0.0,
        warning: None,
        note: None,
        device: "CPU".to_owned(),
        driver,
        samples_ns: Vec::new(),
        messages: Messages::default(),
        is_partial: false,
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
            listener.keep_going()
        })?;
        if index >= warm_ups {
            samples_ns.extend(gpu_time_ns);
        }
    }
    bar.finish_and_clear();
    Ok((frame, samples_ns))
}

/// One line of what was done.
fn told(args: &RenderArgs, rendered: &Rendered) -> Result<String> {
    let Rendered {
        algorithm,
        precision,
        sampling,
        error_bound,
        warning,
        note,
        device,
        driver,
        samples_ns,
        messages,
        ..
    } = rendered;
    let is_statistical = algorithm.description().is_statistical;
    let Sampling { samples, scale } = *sampling;
    // Of path tracing each is a part of the picture.
    let gpu_time_ns =
        if is_statistical && !samples_ns.is_empty() { Some(samples_ns.iter().sum()) } else { median(samples_ns) };
    let [width, height] = [rendered.frame.width(), rendered.frame.height()];
    if args.json {
        return Ok(serde_json::to_string(&Report {
            width,
            height,
            algorithm: *algorithm,
            precision: *precision,
            error_bound: *error_bound,
            warning,
            note,
            samples_per_pixel: samples,
            standard_error: rendered.standard_error,
            scale,
            device,
            driver,
            gpu_time_ns,
            samples_ns,
            validation_messages: messages.count(),
            validation_remarks: messages.remarks().into_iter().map(Remarked::of).collect(),
        })?);
    }
    let time = gpu_time_ns.map_or("no GPU time".to_owned(), |time| format!("{:.2} ms GPU time", time as f64 / 1e6));
    let of = match args.repeat {
        Some(_) => format!(", median of {}", samples_ns.len()),
        None if samples_ns.is_empty() => String::new(),
        None => ", with the driver's warm-up".to_owned(),
    };
    let output =
        if args.output.as_os_str() == STREAM { "standard output".into() } else { args.output.display().to_string() };
    let bound = if *error_bound > 0.0 { format!(", at most {error_bound:.3e} off") } else { String::new() };
    let standard_error = rendered.standard_error.map_or_else(String::new, |error| {
        format!(", standard error {:.1e} (of 99 % of the pixels at most {:.1e})", error.rms, error.of_99_percent)
    });
    let samples = if samples > 1 { format!(", {samples} samples a pixel") } else { String::new() };
    let scale = if scale < 1.0 { format!(", traced at {scale:.4} of that") } else { String::new() };
    let picture = format!("{width}x{height}{scale}{samples}");
    let note = note.as_ref().map(|note| format!("\n{note}")).unwrap_or_default();
    Ok(format!("wrote {} ({picture}, {device}, {time}{of}{bound}{standard_error}){note}", output.escape_debug()))
}
