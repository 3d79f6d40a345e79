//! `zerkalo report -o DIR`: all that can be measured of a device, on one page.

mod parts;
mod watch;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args;
use jiff::Timestamp;

use super::{DeviceArgs, print_line};
use crate::gpu::{Device, Validation};
use crate::measure::Machine;
use crate::measure::output::{check_writable, write_text};
use crate::report::{Ending, Report, Section};
use crate::tracer::TracerError;
use parts::{Parts, algorithms, devices, fps, maps, stability, trade, validation};
use watch::{Progress, Watch};

/// Measure all that can be measured of a device, and write one page about it, in English and Russian
///
/// The page needs no other file and no network: tables, charts, pictures, error maps, what it was measured on and the
/// commands that repeat each part. It is written after every part; Ctrl-C keeps what is measured, and the page says so.
#[derive(Debug, Clone, Args)]
pub struct ReportArgs {
    /// The folder for the page, which is called report.html
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Fewer scenes and smaller pictures: minutes on a CPU device. Without it, the whole gallery and table 4.1 as they
    /// are
    #[arg(long)]
    pub quick: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// Ctrl-C before the page was whole.
#[derive(Debug, thiserror::Error)]
#[error("stopped; {path:?} has what was measured, and says that it is partial")]
pub struct Stopped {
    path: PathBuf,
}

/// Not all of it could be measured, or what was is not as it must be.
#[derive(Debug, thiserror::Error)]
#[error("{path:?} is written, but {what}")]
pub struct Faulty {
    path: PathBuf,
    what: String,
}

pub fn run(args: &ReportArgs) -> Result<()> {
    fs::create_dir_all(&args.output).with_context(|| format!("could not create folder {:?}", args.output))?;
    let path = args.output.join("report.html");
    check_writable(&path)?;
    // From before the driver's threads compile anything until they are gone: a program that ends in their midst may
    // crash.
    let watch = Watch::start();
    let device = Device::open(args.device.device.as_deref(), Validation::Off)?;
    let parts = Parts::new(args.quick, &args.device)?;
    let mut report = parts.report(Machine::of(device.description()), Timestamp::now());

    // Weights: seconds of a quick report on a device with two cores.
    fill(&mut report.devices, watch.progress("devices", 1.0), |content, _| devices(content));
    save(&report, &path)?;
    fill(&mut report.maps, watch.progress("gallery", 12.0), |content, progress| {
        maps(content, &parts, &device, progress)
    });
    save(&report, &path)?;
    fill(&mut report.validation, watch.progress("validation", 60.0), |content, progress| {
        validation(content, &parts, progress)
    });
    save(&report, &path)?;
    fill(&mut report.stability, watch.progress("stability", 30.0), |content, progress| {
        stability(content, &parts, &device, progress)
    });
    save(&report, &path)?;
    fill(&mut report.fps, watch.progress("fps", 20.0), |table, progress| fps(table, &device, progress));
    save(&report, &path)?;
    fill(&mut report.algorithms, watch.progress("algorithms", 15.0), |comparison, progress| {
        algorithms(comparison, &parts, &device, progress)
    });
    save(&report, &path)?;
    fill(&mut report.trade, watch.progress("trade", 120.0), |trade_so_far, progress| {
        trade(trade_so_far, &parts, &device, progress)
    });
    save(&report, &path)?;
    drop(device);
    let is_stopped = watch.listener.stop_requested();
    drop(watch);
    conclude(&report, path, is_stopped)
}

/// Measures a section, unless Ctrl-C came before. A failure is shown in the page, and the next section is measured.
fn fill<T>(section: &mut Section<T>, progress: Progress, measure: impl FnOnce(&mut T, &Progress) -> Result<()>) {
    if progress.at(0.0, "").is_break() {
        return;
    }
    let start = Instant::now();
    let measured = measure(&mut section.content, &progress);
    section.time = start.elapsed();
    section.ending = match measured {
        Ok(()) => Ending::Complete,
        Err(error) if error.chain().any(|cause| matches!(cause.downcast_ref(), Some(TracerError::Stopped))) => {
            Ending::Stopped
        }
        Err(error) => Ending::Failed(format!("{error:#}")),
    };
}

fn save(report: &Report, path: &Path) -> Result<()> {
    Ok(write_text(path, &report.to_html()?)?)
}

/// Where the page is, or what is wrong with it.
fn conclude(report: &Report, path: PathBuf, is_stopped: bool) -> Result<()> {
    if is_stopped && !report.is_complete() {
        return Err(Stopped { path }.into());
    }
    let failed = report.endings().into_iter().find_map(|ending| match ending {
        Ending::Failed(reason) => Some(format!("not all could be measured: {reason}")),
        _ => None,
    });
    let messages = report.validation.content.as_ref().map_or(0, |outcome| outcome.message_count);
    let messages = (messages > 0).then(|| format!("validation had {messages} message(s)"));
    let faults = report.stability.content.rows.iter().filter(|row| row.is_fault()).count();
    let faults = (faults > 0).then(|| format!("{faults} case(s) failed that must be passed"));
    match failed.or(messages).or(faults) {
        Some(what) => Err(Faulty { path, what }.into()),
        None => print_line(&format!("wrote {}", path.display().to_string().escape_debug())),
    }
}
