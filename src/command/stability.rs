//! `zerkalo stability`: the catalogue of extremes, tested on every kernel.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Result;
use clap::Args;
use serde::Serialize;
use serde_json::json;

use super::interrupt::Listener;
use super::options::parse_algorithm;
use super::{DeviceArgs, ValidationArgs, print_line, progress_bar, refuse_messages};
use crate::algorithm::{ALGORITHMS, Algorithm, Description, Kernel, Precision};
use crate::frame::Frame;
use crate::gpu::{Device, DeviceDescription};
use crate::measure::output::{Document, ReportFormat, Table, check_table_path};
use crate::measure::stability::{Row, error_sheet, summary, trials, try_all};
use crate::settings::RenderSettings;
use crate::tracer::TracerError;

/// Try the kernels on the catalogue of numerical extremes
///
/// Exits with 1 where a case fails on another kernel than course and plain; what those get wrong is the table. ssr and path
/// have the cases that are for every algorithm: pictures of numbers at any size, tiling, place and field of view.
#[derive(Debug, Clone, Args)]
pub struct StabilityArgs {
    /// Only this algorithm [default: all]
    #[arg(long, alias = "kernel", value_parser = parse_algorithm(Description::is_on_device))]
    pub algorithm: Option<Algorithm>,
    /// Only this precision, of what has several [default: both, where the device has f64]
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Fewer rays and smaller pictures: about a minute
    #[arg(long)]
    pub quick: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Where to write the table (.json, .csv, .md), or the error maps worth looking at (.png, .exr); may be repeated
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    #[command(flatten)]
    pub device: DeviceArgs,
    #[command(flatten)]
    pub validation: ValidationArgs,
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

impl Document for Report<'_> {
    fn data(&self) -> impl Serialize {
        self
    }

    fn records(&self) -> Table {
        let columns = "case=id,kernel,precision,pass,what,measured,bound,quick,device,driver";
        let conditions = json!({ "quick": self.quick, "device": self.device, "driver": self.driver });
        Table::of_records(columns, self.cases.iter().map(|row| (row, &conditions)))
    }

    fn blocks(&self) -> Vec<String> {
        let mut told = vec![format!("- device: {} ({})", self.device, self.driver)];
        told.extend(self.quick.then(|| "- fewer rays and smaller pictures".to_owned()));
        told.extend((!self.complete).then(|| "- not complete: these are the trials before Ctrl-C".to_owned()));
        let (trials, summary) = (trials(self.cases).to_markdown(), summary(self.cases).to_markdown());
        vec!["# The catalogue of numerical extremes".to_owned(), told.join("\n"), trials, summary]
    }
}

/// Cases failed on kernels that must pass them, or before any kernel.
#[derive(Debug, thiserror::Error)]
#[error("{count} case(s) failed: {ids}")]
pub struct CasesFailed {
    count: usize,
    ids: String,
}

pub fn run(args: &StabilityArgs) -> Result<()> {
    let (tables, sheets): (Vec<_>, Vec<_>) =
        args.output.iter().partition(|path| ReportFormat::of(path).is_ok_and(|format| !format.is_chart()));
    tables.iter().try_for_each(|path| check_table_path(path))?;
    sheets.iter().try_for_each(|path| Frame::check_output_path(path))?;
    let device = Device::open(args.device.device.as_deref(), args.validation.validation())?;
    let kernels = kernels(args, device.description())?;
    let messages = device.messages().clone();
    let DeviceDescription { name, driver, .. } = device.description().clone();

    let listener = Listener::start();
    let mut rows = Vec::new();
    let is_complete = try_all_watched(&device, &kernels, args.quick, &mut rows, &listener)?;
    if is_complete && !sheets.is_empty() {
        let sheet = sheet(&device, &listener)?;
        sheets.iter().try_for_each(|path| sheet.save(path))?;
    }
    drop(device);
    let report = Report { device: &name, driver: &driver, quick: args.quick, complete: is_complete, cases: &rows };
    tables.iter().try_for_each(|path| report.save(path))?;
    print_line(if args.json { report.to_json() } else { report.to_markdown() }.trim_end())?;
    if !is_complete {
        return Err(TracerError::Stopped.into());
    }
    refuse_messages(&messages)?;
    let failed: Vec<_> = rows.iter().filter(|row| row.is_fault()).collect();
    if failed.is_empty() {
        return Ok(());
    }
    let name = |row: &&Row| format!("{} {}", row.id, row.subject());
    let ids = failed.iter().map(name).collect::<Vec<_>>().join(", ");
    Err(CasesFailed { count: failed.len(), ids }.into())
}

pub(super) fn kernels(args: &StabilityArgs, device: &DeviceDescription) -> Result<Vec<Kernel>, TracerError> {
    if let Some(algorithm) = args.algorithm {
        let settings = RenderSettings { algorithm, precision: args.precision, ..RenderSettings::default() };
        settings.check().map_err(|contradiction| TracerError::Refused(contradiction.what))?;
    }
    let rows = ALGORITHMS.iter().filter(|row| row.is_on_device());
    let rows = rows.filter(|row| args.algorithm.is_none_or(|algorithm| algorithm == row.algorithm));
    let kernels = rows.flat_map(|row| {
        // Where there is no choice, none is asked for.
        let is_asked =
            |kernel: Kernel| !row.has_precisions() || args.precision.is_none_or(|asked| asked == kernel.precision());
        let is_had =
            |kernel: Kernel| args.precision.is_some() || device.float64 || kernel.precision() == Precision::F32;
        row.kernels.iter().copied().filter(move |&kernel| is_asked(kernel) && is_had(kernel))
    });
    Ok(kernels.collect())
}

/// False after Ctrl-C.
fn try_all_watched(
    device: &Arc<Device>,
    kernels: &[Kernel],
    is_quick: bool,
    rows: &mut Vec<Row>,
    listener: &Listener,
) -> Result<bool, TracerError> {
    let bar = progress_bar(0);
    let tried = try_all(device, kernels, is_quick, rows, &mut |progress| {
        bar.set_length(progress.all as u64);
        bar.set_position(progress.done as u64);
        bar.set_message(progress.id.to_owned());
        listener.keep_going()
    });
    bar.finish_and_clear();
    match tried {
        Err(TracerError::Stopped) => Ok(false),
        tried => tried.map(|()| true),
    }
}

fn sheet(device: &Arc<Device>, listener: &Listener) -> Result<Frame, TracerError> {
    let bar = progress_bar(0);
    bar.set_message("error maps");
    let sheet = error_sheet(device, &mut |done, total| {
        bar.set_length(total as u64);
        bar.set_position(done as u64);
        listener.keep_going()
    });
    bar.finish_and_clear();
    sheet
}
