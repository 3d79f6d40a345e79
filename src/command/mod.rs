//! One file a subcommand, each a few lines over the library.

mod algorithms;
mod animate;
pub mod compare;
mod convert;
mod devices;
mod drawing;
mod fps;
mod gallery;
pub mod interrupt;
mod options;
mod plan;
mod render;
mod report;
mod second_opinion;
mod stability;
mod streams;
mod trade;
mod validate;
mod view;

use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use anyhow::Context;
use clap::{Args, Subcommand, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::frame::FrameError;
use crate::gpu::{GpuError, Message, Messages, Validation};
use crate::measure::fps_table::FpsTableError;
use crate::measure::output::{OutputError, ReportFormat, check_output_path};
use crate::plan::PlanError;
use crate::scene::format::{Note, NoteKind, Reading};
use crate::scene::{Scene, SceneError, gallery as ready};
use crate::settings::SettingsError;
use crate::tracer::TracerError;
use crate::viewer::ViewerError;

/// What the program is asked to do.
#[allow(missing_docs, reason = "clap puts a variant's doc in place of its arguments' help")]
#[derive(Debug, Subcommand)]
pub enum Command {
    View(view::ViewArgs),
    Render(render::RenderArgs),
    Animate(animate::AnimateArgs),
    Plan(plan::PlanArgs),
    Compare(compare::CompareArgs),
    Stability(stability::StabilityArgs),
    Fps(fps::FpsArgs),
    Trade(trade::TradeArgs),
    Algorithms(algorithms::AlgorithmsArgs),
    Validate(validate::ValidateArgs),
    Report(report::ReportArgs),
    Devices(devices::DevicesArgs),
    Gallery(gallery::GalleryArgs),
    Convert(convert::ConvertArgs),
    SecondOpinion(second_opinion::SecondOpinionArgs),
}

impl Command {
    /// Does it to its end; [`exit_code`] is what a failure ends the program with.
    pub fn run(&self) -> anyhow::Result<()> {
        match self {
            Self::View(args) => view::run(args),
            Self::Render(args) => render::run(args),
            Self::Animate(args) => animate::run(args),
            Self::Plan(args) => plan::run(args),
            Self::Compare(args) => Ok(compare::run(args)?),
            Self::Stability(args) => stability::run(args),
            Self::Fps(args) => fps::run(args),
            Self::Trade(args) => trade::run(args),
            Self::Algorithms(args) => algorithms::run(args),
            Self::Validate(args) => validate::run(args),
            Self::Report(args) => report::run(args),
            Self::Devices(args) => devices::run(args),
            Self::Gallery(args) => gallery::run(args),
            Self::Convert(args) => convert::run(args),
            Self::SecondOpinion(args) => second_opinion::run(args),
        }
    }
}

/// Which Vulkan device to use.
#[derive(Debug, Clone, Default, Args)]
pub struct DeviceArgs {
    /// Number or part of the name of a device, see `zerkalo devices`
    #[arg(long, value_name = "NAME|INDEX", env = "ZERKALO_DEVICE")]
    pub device: Option<String>,
}

/// What Vulkan's validation layer checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Checks {
    /// Calls against the specification, and synchronization
    Core,
    /// Accesses of kernels beyond what is bound; kernels compile ten times as long
    GpuAssisted,
    /// What is allowed and unwise
    BestPractices,
    /// All of these
    All,
}

impl Checks {
    fn validation(self) -> Validation {
        match self {
            Self::Core => Validation::Core,
            Self::GpuAssisted => Validation::GpuAssisted,
            Self::BestPractices => Validation::BestPractices,
            Self::All => Validation::All,
        }
    }
}

/// Whether to run under validation.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct ValidationArgs {
    /// Run under Vulkan's validation layer, by core and synchronization checks or by those that are named; any message
    /// about what the program does is a failure
    #[arg(long, value_enum, value_name = "CHECKS", num_args = 0..=1, require_equals = true, default_missing_value = "core")]
    pub validate: Option<Checks>,
}

impl ValidationArgs {
    fn validation(self) -> Validation {
        self.validate.map_or(Validation::Off, Checks::validation)
    }

    fn is_on(self) -> bool {
        self.validate.is_some()
    }

    /// As it is to be written after other options.
    fn option(self) -> String {
        let name = self.validate.and_then(|checks| checks.to_possible_value());
        name.map_or_else(String::new, |name| format!(" --validate={}", name.get_name()))
    }
}

/// What commands that measure have in common.
#[derive(Debug, Clone, Args)]
pub struct MeasuringArgs {
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub(crate) device: DeviceArgs,
    #[command(flatten)]
    pub(crate) validation: ValidationArgs,
}

/// The validation layers had something to say.
#[derive(Debug, thiserror::Error)]
#[error("validation: {count} message(s)")]
pub struct ValidationFailed {
    count: usize,
}

/// How scene files of other programs are taken.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct ReadingArgs {
    /// Refuse a scene file of which anything is lost or changed, in place of a warning
    #[arg(long)]
    pub strict: bool,
}

impl ReadingArgs {
    /// A ready scene by its name, else a scene from a file; what that has of no place in a scene is told.
    fn read(self, name: &str) -> Result<Reading, SceneError> {
        self.told(name, reading_named(name)?)
    }

    /// Tells what there is to be told of a file.
    fn told(self, name: &str, reading: Reading) -> Result<Reading, SceneError> {
        let in_file = |mut error: SceneError| {
            error.path = Some(name.into());
            error
        };
        let reading = if self.strict { reading.strict().map_err(in_file)? } else { reading };
        for Note { line, what, kind } in &reading.notes {
            let line = line.map(|line| format!(":{line}")).unwrap_or_default();
            let word = match kind {
                NoteKind::Assumed => "note",
                NoteKind::Lost => "warning",
            };
            eprintln!("{word}: {}{line}: {what}", name.escape_debug());
        }
        Ok(reading)
    }
}

/// Pixels of a picture: what was asked for, else what the scene's file offers, else the course work's.
fn size_or_offered(asked: Option<(u32, u32)>, offered: Option<[u32; 2]>) -> [u32; 2] {
    asked.map(|(width, height)| [width, height]).or(offered).unwrap_or([1621, 701])
}

/// A ready scene by its name, else a scene from a file.
fn scene_named(name: &str) -> Result<Scene, SceneError> {
    Ok(ReadingArgs::default().read(name)?.scene)
}

fn reading_named(name: &str) -> Result<Reading, SceneError> {
    match ready::scene(name) {
        Some(scene) => Ok(scene.into()),
        None => Scene::read(Path::new(name)).map_err(|mut error| {
            if !Path::new(name).exists() {
                error.what.push_str("; nor is it a name of `zerkalo gallery`");
                error.what.extend(nearest_ready(name).map(|near| format!(": did you mean {near}?")));
            }
            error
        }),
    }
}

/// The ready scene that a mistyped name may mean.
fn nearest_ready(name: &str) -> Option<String> {
    // What has an ending is a file's name, and what has a folder too.
    if Path::new(name).extension().is_some() || name.contains('/') {
        return None;
    }
    // Most of the letters are as they should be.
    const LIKE: f64 = 0.6;
    let likeness = |entry: &str| strsim::normalized_damerau_levenshtein(entry, &name.to_lowercase());
    let entries = ready::entries().into_iter().map(|entry| entry.name);
    let nearest = entries.max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(&nearest) >= LIKE).then_some(nearest)
}

/// Every file that `-o` asks for, each known to be writable; a name without an extension is a
/// folder's for one of each form, called `stem`.
fn report_files(paths: &[PathBuf], stem: &str) -> anyhow::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() || path.extension().is_none() {
            fs::create_dir_all(path).with_context(|| format!("could not create folder {path:?}"))?;
            files.extend(ReportFormat::ALL.map(|format| path.join(stem).with_extension(format.extension())));
        } else {
            files.push(path.clone());
        }
    }
    files.iter().try_for_each(|path| check_output_path(path))?;
    Ok(files)
}

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| (0.001..=3600.0).contains(seconds));
    seconds.map(Duration::from_secs_f64).ok_or("it must be a number of seconds, 0.001 to 3600".to_owned())
}

/// Reports what validation had to say; a failure if it said anything about what the program does.
fn refuse_messages(messages: &Messages) -> anyhow::Result<()> {
    for (remark, count) in messages.remarks() {
        eprintln!("no fault: {count} of {remark}");
    }
    let messages = messages.to_vec();
    for Message { severity, id, text } in &messages {
        eprintln!("{id} ({}): {text}", severity.name());
    }
    if messages.is_empty() { Ok(()) } else { Err(ValidationFailed { count: messages.len() }.into()) }
}

/// Between lines about progress where there is no terminal.
const LINES_APART: Duration = Duration::from_secs(30);

/// A bar on a terminal, else a line to standard error now and then, until it is finished or dropped.
fn progress_bar(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {percent}% {elapsed} (about {eta} left) {msg}");
    let bar = ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    if !io::stderr().is_terminal() {
        let bar = bar.downgrade();
        thread::spawn(move || {
            loop {
                thread::sleep(LINES_APART);
                match bar.upgrade() {
                    Some(bar) if !bar.is_finished() => eprintln!("{}", progress_line(&bar)),
                    _ => break,
                }
            }
        });
    }
    bar
}

fn progress_line(bar: &ProgressBar) -> String {
    let all = bar.length().filter(|all| *all > 0);
    let share = all.map_or(0.0, |all| bar.position() as f64 / all as f64);
    format!("progress: {:.0}% after {} s {}", 100.0 * share, bar.elapsed().as_secs(), bar.message())
        .trim_end()
        .to_owned()
}

/// Printing that reports a closed pipe or a full disk instead of panicking.
fn print_line(line: &str) -> anyhow::Result<()> {
    writeln!(io::stdout(), "{line}").context("could not write to standard output")
}

fn print_json(value: &impl Serialize) -> anyhow::Result<()> {
    print_line(&serde_json::to_string(value)?)
}

/// Exit code of a program ended by SIGPIPE, as shells report it.
pub const READER_GONE: u8 = 141;

/// 2 where the input is at fault, 130 after Ctrl-C, [`READER_GONE`] where nobody reads standard output any more, of
/// which nothing is to be said; else 1.
pub fn exit_code(error: &anyhow::Error) -> u8 {
    // Only standard output is a pipe: files are written beside their names first.
    let is_reader_gone = error
        .chain()
        .any(|cause| cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe));
    let is_input_error = error.chain().any(|cause| {
        cause.downcast_ref().is_some_and(SceneError::is_input_error)
            || cause.downcast_ref().is_some_and(FrameError::is_input_error)
            || cause.downcast_ref().is_some_and(GpuError::is_input_error)
            || cause.downcast_ref().is_some_and(TracerError::is_input_error)
            || cause.downcast_ref().is_some_and(ViewerError::is_input_error)
            || cause.downcast_ref().is_some_and(FpsTableError::is_input_error)
            || cause.downcast_ref().is_some_and(OutputError::is_input_error)
            || cause.downcast_ref().is_some_and(SettingsError::is_input_error)
            || cause.is::<PlanError>()
            || cause.is::<options::Contradictory>()
            || cause.downcast_ref().is_some_and(compare::CompareError::is_input_error)
    });
    if is_reader_gone {
        READER_GONE
    } else if matches!(error.downcast_ref(), Some(TracerError::Stopped))
        || error.is::<animate::Stopped>()
        || error.is::<fps::Stopped>()
        || error.is::<report::Stopped>()
    {
        interrupt::EXIT_CODE
    } else if is_input_error {
        2
    } else {
        1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_within_their_limits() {
        assert_eq!(parse_seconds("0.5"), Ok(Duration::from_millis(500)));
        assert!(["0", "-1", "nan", "inf", "3601", "1e-9", "x", ""].iter().all(|bad| parse_seconds(bad).is_err()));
    }
}
