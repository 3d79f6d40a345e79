//! `zerkalo stability`: the catalogue of extremes, tried on every kernel.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Result;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::interrupt::Listener;
use super::render::Precision;
use super::{DeviceArgs, print_json, print_line, refuse_messages};
use crate::frame::Frame;
use crate::gpu::{Device, DeviceDescription, Validation};
use crate::measure::stability::{Case, Subject, Verdict, catalogue, error_sheet};
use crate::tracer::{self, TracerError};

/// Kernels on a Vulkan device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Kernel {
    /// The course work's
    Course,
    /// The accurate model by textbook quadratics in f32
    Plain,
    /// The accurate model
    Whitted,
}

/// Try the kernels on the catalogue of numerical extremes
///
/// Exits with 1 where a case fails on the whitted kernel; what the others get wrong is the table.
#[derive(Debug, Clone, Args)]
pub struct StabilityArgs {
    /// Only this kernel [default: all]
    #[arg(long, value_enum)]
    pub kernel: Option<Kernel>,
    /// Only this precision of the whitted kernel [default: both, where the device has f64]
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Fewer rays and smaller pictures: about a minute
    #[arg(long)]
    pub quick: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Draw the error maps worth looking at into a PNG file
    #[arg(short, long, value_name = "SHEET")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Run under core, synchronization and GPU-assisted validation; any message is a failure
    #[arg(long)]
    pub validate: bool,
}

/// A row of `--json`.
#[derive(Debug, Serialize)]
struct Row {
    id: String,
    /// `scene` where the loader is tried, before any kernel.
    kernel: &'static str,
    /// Null for the loader.
    precision: Option<&'static str>,
    pass: bool,
    /// Of all that was measured, what comes nearest to its bound or is farthest beyond.
    what: &'static str,
    /// Null where it is not a number.
    measured: f64,
    bound: f64,
}

#[derive(Debug, Serialize)]
struct Report<'a> {
    device: &'a str,
    driver: &'a str,
    quick: bool,
    /// False after Ctrl-C.
    complete: bool,
    cases: &'a [Row],
}

/// Cases failed on the accurate kernel, or before any kernel.
#[derive(Debug, thiserror::Error)]
#[error("{count} case(s) failed: {ids}")]
pub struct CasesFailed {
    count: usize,
    ids: String,
}

pub fn run(args: &StabilityArgs) -> Result<()> {
    let validation = if args.validate { Validation::GpuAssisted } else { Validation::Off };
    if let Some(output) = &args.output {
        Frame::check_output_path(output)?;
    }
    let device = Device::open(args.device.device.as_deref(), validation)?;
    let kernels = kernels(args, device.description())?;
    let messages = device.messages().clone();
    let DeviceDescription { name, driver, .. } = device.description().clone();

    let listener = Listener::start();
    let (rows, is_complete) = tried(&device, &kernels, args.quick, &listener)?;
    if let Some(output) = args.output.as_ref().filter(|_| is_complete) {
        sheet(&device, &listener)?.save(output)?;
    }
    drop(device);
    if args.json {
        let (device, driver) = (name.as_str(), driver.as_str());
        print_json(&Report { device, driver, quick: args.quick, complete: is_complete, cases: &rows })?;
    } else {
        print_line(&format!("{name} ({driver})"))?;
        rows.iter().try_for_each(|row| print_line(&line(row)))?;
        print_line("")?;
        summary(&rows).iter().try_for_each(|line| print_line(line))?;
    }
    if !is_complete {
        return Err(TracerError::Stopped.into());
    }
    refuse_messages(&messages.to_vec())?;
    let failed: Vec<_> = rows.iter().filter(|row| !row.pass && matches!(row.kernel, "whitted" | "scene")).collect();
    if failed.is_empty() {
        return Ok(());
    }
    let name = |row: &&Row| format!("{} {}", row.id, row.precision.unwrap_or(row.kernel));
    let ids = failed.iter().map(name).collect::<Vec<_>>().join(", ");
    Err(CasesFailed { count: failed.len(), ids }.into())
}

fn kernels(args: &StabilityArgs, device: &DeviceDescription) -> Result<Vec<tracer::Kernel>, TracerError> {
    use tracer::Kernel::{Course, Plain, Whitted};
    if let (Some(kernel @ (Kernel::Course | Kernel::Plain)), Some(Precision::F64)) = (args.kernel, args.precision) {
        let name = if kernel == Kernel::Course { "course" } else { "plain" };
        return Err(TracerError::Refused(format!(
            "the {name} kernel calculates in f32 only; --kernel whitted has f64"
        )));
    }
    let precisions: &[tracer::Precision] = match args.precision {
        Some(Precision::F32) => &[tracer::Precision::F32],
        Some(Precision::F64) => &[tracer::Precision::F64],
        None if device.float64 => &[tracer::Precision::F32, tracer::Precision::F64],
        None => &[tracer::Precision::F32],
    };
    let whitted = precisions.iter().map(|&precision| Whitted(precision));
    Ok(match args.kernel {
        Some(Kernel::Course) => vec![Course],
        Some(Kernel::Plain) => vec![Plain],
        Some(Kernel::Whitted) => whitted.collect(),
        None => [Course, Plain].into_iter().chain(whitted).collect(),
    })
}

/// All cases on all kernels, or those that were tried before Ctrl-C.
fn tried(
    device: &Arc<Device>,
    kernels: &[tracer::Kernel],
    is_quick: bool,
    listener: &Listener,
) -> Result<(Vec<Row>, bool), TracerError> {
    let cases = catalogue();
    let bar = progress_bar((cases.len() * kernels.len()) as u64);
    let subjects: Vec<_> = kernels.iter().map(|&kernel| Subject::new(device, kernel, is_quick)).collect();
    let mut rows = Vec::new();
    for case in &cases {
        bar.set_message(case.id.clone());
        rows.extend(case.try_loader().map(|verdict| row(case, None, &verdict)));
        for subject in &subjects {
            if listener.stop_requested() {
                bar.finish_and_clear();
                return Ok((rows, false));
            }
            let verdict = case.try_kernel(subject)?;
            rows.extend(verdict.map(|verdict| row(case, Some(subject.kernel), &verdict)));
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok((rows, true))
}

fn sheet(device: &Arc<Device>, listener: &Listener) -> Result<Frame, TracerError> {
    let bar = progress_bar(0);
    bar.set_message("error maps");
    let sheet = error_sheet(device, &mut |done, total| {
        bar.set_length(total as u64);
        bar.set_position(done as u64);
        if listener.stop_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    bar.finish_and_clear();
    sheet
}

/// Drawn on a terminal only.
fn progress_bar(trials: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {percent}% {elapsed} (about {eta} left) {msg}");
    ProgressBar::new(trials).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn row(case: &Case, kernel: Option<tracer::Kernel>, verdict: &Verdict) -> Row {
    let (kernel, precision) = match kernel {
        None => ("scene", None),
        Some(tracer::Kernel::Course) => ("course", Some("f32")),
        Some(tracer::Kernel::Plain) => ("plain", Some("f32")),
        Some(tracer::Kernel::Whitted(precision)) => ("whitted", Some(precision.name())),
    };
    let worst = verdict.worst;
    let (what, measured, bound) = (worst.what, worst.measured, worst.bound);
    Row { id: case.id.clone(), kernel, precision, pass: verdict.passes(), what, measured, bound }
}

fn line(row: &Row) -> String {
    let Row { id, kernel, precision, pass, what, measured, bound } = row;
    let (precision, verdict) = (precision.unwrap_or(""), if *pass { "pass" } else { "FAIL" });
    format!("{id:<11} {kernel:<8} {precision:<4} {verdict}  {what}: {} (at most {})", short(*measured), short(*bound))
}

/// Counts whole, the rest to three digits.
fn short(value: f64) -> String {
    match value {
        _ if !value.is_finite() => value.to_string(),
        _ if value.fract() == 0.0 && value.abs() < 1e6 => format!("{value:.0}"),
        _ if (1e-3..1e4).contains(&value.abs()) => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

/// A line a group of cases, a column a kernel: how many passed of how many.
fn summary(rows: &[Row]) -> Vec<String> {
    let mut columns: Vec<(&str, Option<&str>)> = Vec::new();
    let mut groups: Vec<&str> = Vec::new();
    let mut counts: BTreeMap<(&str, usize), (usize, usize)> = BTreeMap::new();
    for row in rows {
        let group = row.id.split('-').next().unwrap_or(&row.id);
        if !groups.contains(&group) {
            groups.push(group);
        }
        let column = (row.kernel, row.precision);
        let place = columns.iter().position(|known| *known == column).unwrap_or_else(|| {
            columns.push(column);
            columns.len() - 1
        });
        let (passed, tried) = counts.entry((group, place)).or_default();
        *passed += usize::from(row.pass);
        *tried += 1;
    }
    let title = |(kernel, precision): &(&str, Option<&str>)| format!("{kernel} {}", precision.unwrap_or(""));
    let cells = |first: &str, cells: Vec<String>| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>13}")).collect();
        format!("{first:<7}{cells}").trim_end().to_owned()
    };
    let mut lines = vec![cells("passed", columns.iter().map(|column| title(column).trim().to_owned()).collect())];
    for group in groups {
        let cell = |place| {
            counts.get(&(group, place)).map_or("-".to_owned(), |(passed, tried)| format!("{passed} of {tried}"))
        };
        lines.push(cells(group, (0..columns.len()).map(cell).collect()));
    }
    let total = |place| {
        let of_column = counts.iter().filter(|((_, column), _)| *column == place).map(|(_, count)| count);
        let (passed, tried) = of_column.fold((0, 0), |(p, t), (passed, tried)| (p + passed, t + tried));
        format!("{passed} of {tried}")
    };
    lines.push(cells("all", (0..columns.len()).map(total).collect()));
    lines
}
