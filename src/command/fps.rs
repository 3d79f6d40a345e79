//! `zerkalo fps`: table 4.1 of the course work, measured here.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Duration;

use anyhow::Result;
use clap::Args;

use super::interrupt::Listener;
use super::options::{parse_algorithm, parse_size};
use super::{MeasuringArgs, parse_seconds, print_line, progress_bar, refuse_messages, report_files};
use crate::algorithm::{Algorithm, Description};
use crate::gpu::{Device, Messages, Validation};
use crate::measure::fps_table::{self, FpsTable, OffScreen, Plan, Stage, no_scene, settings_of};
use crate::measure::output::{Document, OutputError, ReportFormat, check_output_path};
use crate::measure::{Budget, FrameTime, Machine};
use crate::scene::{Scene, SolidKind};
use crate::tracer::{Settings, TracerError};
use crate::viewer::{Display, PictureWindow, Shown};

/// Measure frames a second by kind and number of solids, as in table 4.1 of the course work, beside its figures
///
/// Kernels take turns within a cell, so that what else the machine does meets them alike; the first frame of each is
/// left out. Ctrl-C keeps what is measured, where -o names a file for it.
#[derive(Debug, Clone, Args)]
pub struct FpsArgs {
    /// Measure each kernel so long in a cell, seconds [default: 3 s or 5 frames, whichever is first, but 2 frames and
    /// 0.25 s at least]
    #[arg(long, value_name = "S", value_parser = parse_seconds)]
    pub seconds: Option<Duration>,
    /// As the course work did: 30 s in a cell
    #[arg(long, conflicts_with = "seconds")]
    pub full: bool,
    /// Only these algorithms, a column each; path tracing with one path a pixel [default: course,whitted]
    #[arg(long, alias = "kernel", value_name = "NAME,NAME", value_delimiter = ',')]
    #[arg(value_parser = parse_algorithm(Description::is_on_device))]
    pub algorithm: Vec<Algorithm>,
    /// Numbers of solids, of 10, 20 and so on to 100 [default: all]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = parse_count)]
    pub counts: Vec<usize>,
    /// Pixels, each side 1 to 16384 [default: 1621x701]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Where to write the table: a file (.json with every sample, .csv, .md; .png, .svg: its chart), or a folder for
    /// one of each, called fps; may be repeated
    #[arg(short, long, value_name = "DIR|FILE")]
    pub output: Vec<PathBuf>,
    /// Go on with a table that was interrupted, on the same device and as it was begun; repeated, the cells of the other
    /// tables, of machines of the same kind, are taken into the first
    #[arg(long, value_name = "JSON")]
    pub resume: Vec<PathBuf>,
    /// Show every frame in a window of the picture's size, without waiting for the display, and count the frames shown,
    /// as the course work did
    #[arg(long)]
    pub in_window: bool,
    #[command(flatten)]
    pub measuring: MeasuringArgs,
}

/// Ctrl-C before the table was whole.
#[derive(Debug, thiserror::Error)]
#[error("stopped, {measured} of {all} places of the table measured; {advice}")]
pub struct Stopped {
    measured: usize,
    all: usize,
    advice: String,
}

fn parse_count(text: &str) -> Result<usize, String> {
    let count = text.trim().parse().ok().filter(|count| Plan::course_counts().contains(count));
    count.ok_or("table 4.1 has 10, 20 and so on to 100 solids".to_owned())
}

pub fn run(args: &FpsArgs) -> Result<()> {
    let begun = merged(&args.resume)?;
    let plan = plan(args, begun.as_ref().map(|table| &table.plan));
    let validation = args.measuring.validation.validation();
    let mut display = args.in_window.then(|| Display::open(WITHOUT_WINDOW)).transpose()?;
    let Scaffold { mut stage, machine, messages } = match &mut display {
        Some(display) => in_window(display, args, &plan, validation)?,
        None => off_screen(args, validation)?,
    };
    let mut table = match (args.resume.first(), begun) {
        (Some(path), Some(begun)) => {
            begun.check_goes_on(path, &machine, &plan)?;
            begun
        }
        _ => FpsTable::new(machine, plan),
    };
    let mut outputs = report_files(&args.output, "fps")?;
    if let Some(path) = args.resume.first().filter(|path| !outputs.contains(path)) {
        check_output_path(path)?;
        outputs.push(path.clone());
    }

    let is_complete = fill(&mut table, &mut *stage, &outputs)?;
    drop(stage);
    save(&table, &outputs, |_| true)?;
    print_line(if args.measuring.json { table.to_json() } else { table.to_markdown() }.trim_end())?;
    warn_of_outliers(&table);
    if !is_complete {
        return Err(stopped(&table, args, &outputs).into());
    }
    refuse_messages(&messages)
}

/// The first table, with the cells of all others.
fn merged(paths: &[PathBuf]) -> Result<Option<FpsTable>> {
    let Some((first, others)) = paths.split_first() else { return Ok(None) };
    let mut table = FpsTable::load(first)?;
    for path in others {
        table.merge(path, FpsTable::load(path)?)?;
    }
    Ok(Some(table))
}

/// Where the frames are drawn, by what, and what validation says of it.
struct Scaffold<'d> {
    stage: Box<dyn Stage + 'd>,
    machine: Machine,
    messages: Messages,
}

const WITHOUT_WINDOW: &str = "without --in-window nothing need be shown";

fn off_screen(args: &FpsArgs, validation: Validation) -> Result<Scaffold<'static>> {
    let device = Device::open(args.measuring.device.device.as_deref(), validation)?;
    Ok(Scaffold {
        machine: Machine::of(device.description()),
        messages: device.messages().clone(),
        stage: Box::new(OffScreen::new(&device)),
    })
}

fn in_window<'d>(
    display: &'d mut Display,
    args: &FpsArgs,
    plan: &Plan,
    validation: Validation,
) -> Result<Scaffold<'d>> {
    let messages = Messages::default();
    let (wanted, size) = (args.measuring.device.device.as_deref(), [plan.width, plan.height]);
    let window = PictureWindow::open(display, size, wanted, validation, &messages)?;
    let present_mode = window.present_mode().map(str::to_owned);
    let machine = Machine { present_mode, ..Machine::of(window.device().description()) };
    Ok(Scaffold {
        stage: Box::new(InWindow { window, scene: Scene::default(), settings: Vec::new() }),
        machine,
        messages,
    })
}

/// Frames that are shown.
struct InWindow<'d> {
    window: PictureWindow<'d>,
    scene: Scene,
    settings: Vec<(Algorithm, Settings)>,
}

impl Stage for InWindow<'_> {
    fn set_scene(&mut self, scene: &Scene, plan: &Plan) -> Result<(), TracerError> {
        let device = self.window.device().description();
        let settings = |&algorithm: &Algorithm| Ok((algorithm, settings_of(algorithm, scene, plan, device)?));
        self.settings = plan.algorithms.iter().map(settings).collect::<Result<_, TracerError>>()?;
        self.scene = scene.clone();
        Ok(())
    }

    fn draw(
        &mut self,
        algorithm: Algorithm,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<FrameTime, TracerError> {
        let settings = self.settings.iter().find(|(known, _)| *known == algorithm);
        let (_, settings) = settings.ok_or_else(|| no_scene(algorithm))?;
        let Shown { gpu_time_ns, wall_time } = self.window.show(settings, &self.scene, keep_going)?;
        Ok(FrameTime { gpu_time_ns, wall_time })
    }
}

/// As asked, else as begun, else as the course work's table with little time.
pub(super) fn plan(args: &FpsArgs, begun: Option<&Plan>) -> Plan {
    let base = begun.cloned().unwrap_or_else(Plan::of_course);
    let (width, height) = args.size.unwrap_or((base.width, base.height));
    let asked = args.algorithm.iter().enumerate();
    let asked = asked.filter(|(place, algorithm)| !args.algorithm[..*place].contains(algorithm));
    let asked: Vec<_> = asked.map(|(_, &algorithm)| algorithm).collect();
    let mut counts = if args.counts.is_empty() { base.counts } else { args.counts.clone() };
    counts.sort_unstable();
    counts.dedup();
    let time = if args.full { Some(Duration::from_secs(30)) } else { args.seconds };
    Plan {
        width,
        height,
        generations: base.generations,
        algorithms: if asked.is_empty() { base.algorithms } else { asked },
        counts,
        budget: time.map_or(base.budget, Budget::lasting),
        validation: args.measuring.validation.is_on(),
        in_window: args.in_window,
    }
}

/// Measures what is missing, and writes the table after every cell of it; false after Ctrl-C.
fn fill(table: &mut FpsTable, stage: &mut dyn Stage, outputs: &[PathBuf]) -> Result<bool> {
    let missing = table.missing();
    // The more solids, the longer.
    let bar = progress_bar(missing.iter().map(|(_, count)| *count as u64).sum());
    let listener = Listener::start();
    for (kind, count) in missing {
        bar.set_message(format!("{count} of the kind {}", kind.name()));
        let measured = fps_table::measure(stage, &table.plan, kind, count, &mut || {
            bar.tick();
            listener.keep_going()
        });
        match measured {
            Ok(cells) => table.put(cells),
            Err(TracerError::Stopped) => {
                bar.finish_and_clear();
                return Ok(false);
            }
            Err(error) => return Err(error.into()),
        }
        // A chart of half a table is drawn at the end only.
        save(table, outputs, |format| !format.is_chart())?;
        bar.inc(count as u64);
    }
    bar.finish_and_clear();
    Ok(true)
}

fn save(table: &FpsTable, outputs: &[PathBuf], wanted: impl Fn(ReportFormat) -> bool) -> Result<(), OutputError> {
    for path in outputs {
        if wanted(ReportFormat::of(path)?) {
            table.save(path)?;
        }
    }
    Ok(())
}

fn warn_of_outliers(table: &FpsTable) {
    let outliers = table.outliers();
    if outliers.is_empty() {
        return;
    }
    eprintln!("zerkalo: frames beyond three interquartile ranges from the quartiles:");
    outliers.iter().for_each(|line| eprintln!("  {line}"));
    eprintln!(
        "zerkalo: something else ran then, or the clock changed; medians hardly move, but for a better table close other \
         programs, fix the clock, or measure longer (--seconds)"
    );
}

fn stopped(table: &FpsTable, args: &FpsArgs, outputs: &[PathBuf]) -> Stopped {
    let all = table.plan.counts.len() * SolidKind::ALL.len();
    let json = outputs.iter().find(|path| matches!(ReportFormat::of(path), Ok(ReportFormat::Json)));
    let advice = match json {
        Some(json) => {
            let more = args.output.iter().filter(|path| *path != json).map(|path| format!(" -o {path:?}"));
            let validate = args.measuring.validation.option();
            let in_window = if args.in_window { " --in-window" } else { "" };
            format!("to go on: zerkalo fps --resume {json:?}{}{validate}{in_window}", more.collect::<String>())
        }
        None => "no file keeps their samples: name one by -o to go on from it".to_owned(),
    };
    Stopped { measured: all - table.missing().len(), all, advice }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_the_table() {
        assert_eq!((parse_count("10"), parse_count("100")), (Ok(10), Ok(100)));
        assert!(["0", "5", "110", "-10", "ten", ""].iter().all(|bad| parse_count(bad).is_err()));
    }
}
