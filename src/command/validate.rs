//! `zerkalo validate`: everything that can be drawn, under the validation layers.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::thread;

use anyhow::Result;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::interrupt::Listener;
use super::{DeviceArgs, ValidationFailed, print_json, print_line};
use crate::gpu::{self, Allowance, Check, Device, DeviceDescription, Layer, Messages, Validation};
use crate::tracer::{TracerError, limits_of};
use crate::validation::{Findings, Group, PICTURE, Run, Scope, Switch, runs, survey, switches};
use crate::viewer::{Display, PictureWindow};

/// Draw the gallery by every kernel, precision and variant of a plan under the validation layers
///
/// First under core, synchronization and GPU-assisted checks, then under core, synchronization and best-practices checks.
/// Which of them the layer at hand does is found out by a mistake of each kind made on purpose. Exits with 1 if there is
/// any message; Ctrl-C tells what was found so far.
#[derive(Debug, Clone, Args)]
pub struct ValidateArgs {
    /// For every kernel only as many scenes as turn on and off all that a plan can: about a minute
    #[arg(long)]
    pub quick: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// The layer does not do all at once.
const KINDS: [Validation; 2] = [Validation::GpuAssisted, Validation::BestPractices];

#[derive(Debug, Serialize)]
struct Report {
    device: String,
    driver: String,
    layer: Layer,
    quick: bool,
    /// Pixels.
    width: u32,
    height: u32,
    /// False after Ctrl-C or a failure.
    complete: bool,
    checks: Vec<TriedCheck>,
    passes: Vec<Pass>,
    /// Why nothing was drawn in a window; null where it was.
    no_window: Option<String>,
    /// What plans turn on or off, with the runs of a pass that have it so.
    switches: Vec<Switch>,
    /// Of all groups.
    message_count: usize,
    messages: Vec<Group>,
    allowed: Vec<Allowed>,
}

#[derive(Debug, Serialize)]
struct TriedCheck {
    validation: &'static str,
    check: Check,
    /// Whether a mistake made on purpose was told.
    works: bool,
}

/// Runs under one kind of validation.
#[derive(Debug, Serialize)]
struct Pass {
    validation: &'static str,
    in_window: bool,
    runs: usize,
    /// How many of them were begun.
    begun: usize,
}

#[derive(Debug, Serialize)]
struct Allowed {
    count: usize,
    #[serde(flatten)]
    allowance: Allowance,
}

pub fn run(args: &ValidateArgs) -> Result<()> {
    let wanted = args.device.device.as_deref();
    let layer = gpu::validation_layer()?;
    let device = Device::open(wanted, Validation::Off)?.description().clone();
    let scope = if args.quick { Scope::EverySwitch } else { Scope::Whole };
    let runs = runs(&device, &limits_of(&device), scope)?;
    let mut report = Report::new(&device, layer, args.quick, &runs);
    let mut findings = Findings::default();
    let drawn = draw(wanted, &runs, &mut report, &mut findings);
    report.complete = drawn.is_ok();
    report.take_in(findings);
    if args.json {
        print_json(&report)?;
    } else {
        report.lines().iter().try_for_each(|line| print_line(line))?;
    }
    drawn?;
    match report.message_count {
        0 => Ok(()),
        count => Err(ValidationFailed { count }.into()),
    }
}

/// All passes, off-screen and in the window, up to the first failure.
fn draw(wanted: Option<&str>, runs: &[Run], report: &mut Report, findings: &mut Findings) -> Result<()> {
    let shown: Vec<&Run> = runs.iter().filter(|run| run.is_as_in_window).collect();
    let watch = Watch::start((runs.len() + shown.len()) * KINDS.len());
    // At the same time: most of it is compiling, which takes one core.
    let passes = thread::scope(|scope| {
        let watch = &watch;
        let threads = KINDS.map(|validation| scope.spawn(move || draw_off_screen(wanted, validation, runs, watch)));
        threads.map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)))
    });
    let mut failure = Ok(());
    for OffScreen { checks, pass, found, drawn } in passes {
        report.checks.extend(checks);
        report.passes.push(pass);
        findings.add(found);
        failure = failure.and(drawn);
    }
    failure?;

    let mut display = match Display::open("all else was drawn") {
        Ok(display) => display,
        Err(error) => {
            report.no_window = Some(error.to_string());
            return Ok(());
        }
    };
    for validation in KINDS {
        let messages = Messages::default();
        let window = PictureWindow::open(&mut display, PICTURE, wanted, validation, &messages);
        findings.note("opening the window", &messages, 0);
        let mut window = match window {
            Ok(window) => window,
            Err(error) => {
                report.no_window = Some(error.to_string());
                return Ok(());
            }
        };
        let mut pass = Pass::new(validation, true, shown.len());
        let drawn = show_all(&mut window, &shown, &messages, findings, &mut |place| {
            watch.is_at(shown[place], place, &mut pass)
        });
        report.passes.push(pass);
        let before = messages.count();
        drop(window);
        findings.note("closing the window", &messages, before);
        findings.note_allowed(&messages);
        drawn?;
    }
    Ok(())
}

/// A pass without a window, as far as it came.
struct OffScreen {
    checks: Vec<TriedCheck>,
    pass: Pass,
    found: Findings,
    drawn: Result<(), TracerError>,
}

fn draw_off_screen(wanted: Option<&str>, validation: Validation, runs: &[Run], watch: &Watch) -> OffScreen {
    let (mut checks, mut found) = (Vec::new(), Findings::default());
    let mut pass = Pass::new(validation, false, runs.len());
    let mut draw = || {
        for (check, works) in gpu::try_checks(wanted, validation)? {
            checks.push(TriedCheck { validation: validation.name(), check, works });
        }
        survey(wanted, validation, runs, &mut found, &mut |place| watch.is_at(&runs[place], place, &mut pass))
    };
    let drawn = draw();
    OffScreen { checks, pass, found, drawn }
}

/// `observe` hears of every run, by its place, and can stop the work there.
fn show_all(
    window: &mut PictureWindow,
    runs: &[&Run],
    messages: &Messages,
    findings: &mut Findings,
    observe: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<(), TracerError> {
    for (place, run) in runs.iter().enumerate() {
        let before = messages.count();
        let shown = window.show(run.settings.kernel, &run.scene, &mut || observe(place));
        findings.note(&format!("in a window: {}", run.name), messages, before);
        shown?;
    }
    Ok(())
}

/// Ctrl-C and the progress, which is drawn on a terminal only.
struct Watch {
    listener: Listener,
    bar: ProgressBar,
}

impl Watch {
    fn start(runs: usize) -> Self {
        let style = ProgressStyle::with_template("{bar:40} {percent}% {elapsed} (about {eta} left) {msg}");
        let bar = ProgressBar::new(runs as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { listener: Listener::start(), bar }
    }

    /// At the run in the `place` of its pass.
    fn is_at(&self, run: &Run, place: usize, pass: &mut Pass) -> ControlFlow<()> {
        if self.listener.stop_requested() {
            return ControlFlow::Break(());
        }
        if pass.begun == place {
            pass.begun += 1;
            self.bar.inc(1);
            self.bar.set_message(run.name.clone());
        }
        ControlFlow::Continue(())
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Report {
    fn new(device: &DeviceDescription, layer: Layer, quick: bool, runs: &[Run]) -> Self {
        let [width, height] = PICTURE;
        Self {
            device: device.name.clone(),
            driver: device.driver.clone(),
            layer,
            quick,
            width,
            height,
            complete: false,
            checks: Vec::new(),
            passes: Vec::new(),
            no_window: None,
            switches: switches(runs),
            message_count: 0,
            messages: Vec::new(),
            allowed: Vec::new(),
        }
    }

    fn take_in(&mut self, findings: Findings) {
        self.message_count = findings.count();
        let Findings { groups, allowed } = findings;
        self.messages = groups;
        self.allowed = allowed.into_iter().map(|(allowance, count)| Allowed { count, allowance }).collect();
    }

    fn lines(&self) -> Vec<String> {
        let Self { device, driver, layer, width, height, .. } = self;
        let mut lines = vec![
            format!("{device} ({driver})"),
            format!("{} {}, implementation {}", layer.name, layer.version, layer.implementation),
            String::new(),
            "checks, each tried by a mistake made on purpose:".to_owned(),
        ];
        lines.extend(self.checks.chunk_by(|a, b| a.validation == b.validation).map(line_of_checks));
        lines.extend([
            "  synchronization is the layer's, which passes over dispatches; hazards are in this program's own book"
                .to_owned(),
            String::new(),
            format!("pictures of {width}x{height} pixels:"),
        ]);
        lines.extend(self.passes.iter().map(Pass::line));
        lines.extend(self.no_window.iter().map(|reason| format!("  none in a window: {reason}")));
        lines.push("  not covered: the panel beside the window's picture".to_owned());
        let switches = self.switches.iter().map(|Switch { name, on, off }| format!("{name} {on}/{off}"));
        lines.push(format!("  on/off in the plans of a pass: {}", switches.collect::<Vec<_>>().join(", ")));
        lines.push(String::new());
        lines.push(format!("messages: {}", self.message_count));
        lines.extend(self.messages.iter().flat_map(lines_of_group));
        lines.extend(self.allowed.iter().map(|Allowed { count, allowance: Allowance { id_part, why } }| {
            format!("allowed: {count} of *{id_part}*: {why}")
        }));
        lines
    }
}

fn line_of_checks(checks: &[TriedCheck]) -> String {
    let word =
        |tried: &TriedCheck| format!("{} {}", tried.check.name(), if tried.works { "works" } else { "IS NOT DONE" });
    let validation = checks.first().map_or("", |tried| tried.validation);
    format!("  {validation:<15} {}", checks.iter().map(word).collect::<Vec<_>>().join(", "))
}

impl Pass {
    fn new(validation: Validation, in_window: bool, runs: usize) -> Self {
        Self { validation: validation.name(), in_window, runs, begun: 0 }
    }

    fn line(&self) -> String {
        let Self { validation, in_window, runs, begun } = self;
        let place = if *in_window { " in a window, without waiting for the display" } else { "" };
        let stopped = if begun < runs { format!("; {begun} of them were begun") } else { String::new() };
        format!("  {validation:<15} {runs} runs{place}{stopped}")
    }
}

/// Runs that a group is told with; JSON has all.
const RUNS_TOLD: usize = 3;

fn lines_of_group(group: &Group) -> Vec<String> {
    let Group { id, count, text, runs } = group;
    let more = runs.len().saturating_sub(RUNS_TOLD);
    let more = if more > 0 { format!("; and {more} more") } else { String::new() };
    let told = runs.iter().take(RUNS_TOLD).map(String::as_str).collect::<Vec<_>>().join("; ");
    vec![format!("{count} of {id}"), format!("  {}", text.trim()), format!("  met by: {told}{more}")]
}
