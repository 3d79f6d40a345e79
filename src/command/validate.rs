//! `zerkalo validate`: everything that can be drawn, under the validation layers.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::thread;

use anyhow::Result;
use clap::Args;

use super::interrupt::Listener;
use super::{DeviceArgs, ValidationFailed, print_json, print_line, progress_bar};
use crate::gpu::{self, Allowance, Device, Messages, Validation};
use crate::tracer::{TracerError, limits_of};
use crate::validation::{
    Allowed, Findings, Group, Outcome, PICTURE, Pass, Run, Scope, Switch, TriedCheck, runs, survey,
};
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

/// A run that is next, and how many there are in all passes.
pub(super) struct Next<'a> {
    pub name: &'a str,
    pub all: usize,
}

/// Hears of every run before it, often in between, and can stop the work.
pub(super) type Watch<'a> = &'a (dyn Fn(Option<Next<'_>>) -> ControlFlow<()> + Sync);

pub fn run(args: &ValidateArgs) -> Result<()> {
    let (listener, bar) = (Listener::start(), progress_bar(0));
    let watch = |next: Option<Next<'_>>| {
        if listener.stop_requested() {
            return ControlFlow::Break(());
        }
        if let Some(Next { name, all }) = next {
            bar.set_length(all as u64);
            bar.inc(1);
            bar.set_message(name.to_owned());
        }
        ControlFlow::Continue(())
    };
    let (outcome, drawn) = validated(args, &watch)?;
    bar.finish_and_clear();
    if args.json {
        print_json(&outcome)?;
    } else {
        lines(&outcome).iter().try_for_each(|line| print_line(line))?;
    }
    drawn?;
    match outcome.message_count {
        0 => Ok(()),
        count => Err(ValidationFailed { count }.into()),
    }
}

/// All that the arguments ask for, or what came of it up to a failure or a stop, which is the second.
///
/// # Errors
/// There is no layer, or no device.
pub(super) fn validated(args: &ValidateArgs, watch: Watch<'_>) -> Result<(Outcome, Result<()>)> {
    let wanted = args.device.device.as_deref();
    let layer = gpu::validation_layer()?;
    let device = Device::open(wanted, Validation::Off)?.description().clone();
    let scope = if args.quick { Scope::EverySwitch } else { Scope::Whole };
    let runs = runs(&device, &limits_of(&device), scope)?;
    let mut outcome = Outcome::new(&device, layer, args.quick, &runs);
    let mut findings = Findings::default();
    let drawn = draw(wanted, &runs, &mut outcome, &mut findings, watch);
    outcome.complete = drawn.is_ok();
    outcome.take_in(findings);
    Ok((outcome, drawn))
}

/// All passes, off-screen and in the window, up to the first failure.
fn draw(
    wanted: Option<&str>,
    runs: &[Run],
    outcome: &mut Outcome,
    findings: &mut Findings,
    watch: Watch<'_>,
) -> Result<()> {
    let shown: Vec<&Run> = runs.iter().filter(|run| run.is_as_in_window).collect();
    let all = (runs.len() + shown.len()) * KINDS.len();
    // At the same time: most of it is compiling, which takes one core.
    let passes = thread::scope(|scope| {
        let threads =
            KINDS.map(|validation| scope.spawn(move || draw_off_screen(wanted, validation, runs, all, watch)));
        threads.map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)))
    });
    let mut failure = Ok(());
    for OffScreen { checks, pass, found, drawn } in passes {
        outcome.checks.extend(checks);
        outcome.passes.push(pass);
        findings.add(found);
        failure = failure.and(drawn);
    }
    failure?;

    let mut display = match Display::open("all else was drawn") {
        Ok(display) => display,
        Err(error) => {
            outcome.no_window = Some(error.to_string());
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
                outcome.no_window = Some(error.to_string());
                return Ok(());
            }
        };
        let mut pass = Pass::new(validation, true, shown.len());
        let drawn = show_all(&mut window, &shown, &messages, findings, &mut |place| {
            is_at(shown[place], place, &mut pass, all, watch)
        });
        outcome.passes.push(pass);
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

fn draw_off_screen(
    wanted: Option<&str>,
    validation: Validation,
    runs: &[Run],
    all: usize,
    watch: Watch<'_>,
) -> OffScreen {
    let (mut checks, mut found) = (Vec::new(), Findings::default());
    let mut pass = Pass::new(validation, false, runs.len());
    let mut draw = || {
        for (check, works) in gpu::try_checks(wanted, validation)? {
            checks.push(TriedCheck { validation: validation.name(), check, works });
        }
        survey(wanted, validation, runs, &mut found, &mut |place| is_at(&runs[place], place, &mut pass, all, watch))
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

/// At the run in the `place` of its pass.
fn is_at(run: &Run, place: usize, pass: &mut Pass, all: usize, watch: Watch<'_>) -> ControlFlow<()> {
    let is_new = pass.begun == place;
    watch(is_new.then_some(Next { name: &run.name, all }))?;
    pass.begun += usize::from(is_new);
    ControlFlow::Continue(())
}

fn lines(outcome: &Outcome) -> Vec<String> {
    let Outcome { device, driver, layer, width, height, .. } = outcome;
    let mut lines = vec![
        format!("{device} ({driver})"),
        format!("{} {}, implementation {}", layer.name, layer.version, layer.implementation),
        String::new(),
        "checks, each tried by a mistake made on purpose:".to_owned(),
    ];
    lines.extend(outcome.checks.chunk_by(|a, b| a.validation == b.validation).map(line_of_checks));
    lines.extend([
        "  synchronization is the layer's, which passes over dispatches; hazards are in this program's own book"
            .to_owned(),
        String::new(),
        format!("pictures of {width}x{height} pixels:"),
    ]);
    lines.extend(outcome.passes.iter().map(line_of_pass));
    lines.extend(outcome.no_window.iter().map(|reason| format!("  none in a window: {reason}")));
    lines.push("  not covered: the panel beside the window's picture".to_owned());
    let switches = outcome.switches.iter().map(|Switch { name, on, off }| format!("{name} {on}/{off}"));
    lines.push(format!("  on/off in the plans of a pass: {}", switches.collect::<Vec<_>>().join(", ")));
    lines.push(String::new());
    lines.push(format!("messages: {}", outcome.message_count));
    lines.extend(outcome.messages.iter().flat_map(lines_of_group));
    lines.extend(outcome.allowed.iter().map(|Allowed { count, allowance: Allowance { id_part, why } }| {
        format!("allowed: {count} of *{id_part}*: {why}")
    }));
    lines
}

fn line_of_checks(checks: &[TriedCheck]) -> String {
    let word =
        |tried: &TriedCheck| format!("{} {}", tried.check.name(), if tried.works { "works" } else { "IS NOT DONE" });
    let validation = checks.first().map_or("", |tried| tried.validation);
    format!("  {validation:<15} {}", checks.iter().map(word).collect::<Vec<_>>().join(", "))
}

fn line_of_pass(pass: &Pass) -> String {
    let Pass { validation, in_window, runs, begun } = pass;
    let place = if *in_window { " in a window, without waiting for the display" } else { "" };
    let stopped = if begun < runs { format!("; {begun} of them were begun") } else { String::new() };
    format!("  {validation:<15} {runs} runs{place}{stopped}")
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
