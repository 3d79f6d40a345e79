//! `zerkalo validate`: everything that can be drawn, under the validation layers.

use std::ops::ControlFlow;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::interrupt::Listener;
use super::{Checks, DeviceArgs, ValidationFailed, print_line, progress_bar};
use crate::gpu::{self, Device, Messages, Validation};
use crate::measure::output::{Document, check_table_path};
use crate::tracer::{Kernel, Settings, TracerError, limits_of};
use crate::validation::{
    Findings, OffScreen, Outcome, PICTURE, Pass, Program, Run, Scope, TriedCheck, draw_off_screen, instrumented, runs,
};
use crate::viewer::{Display, PictureWindow};

/// Draw the gallery by every kernel, precision and variant of a plan under Vulkan's validation layer
///
/// Under core and synchronization checks, then once more under GPU-assisted ones (every variant of a kernel once, as
/// the layer's own code makes them compile long), then under best-practices ones. Which of them the layer at hand does
/// is found out by a mistake of each kind made on purpose. Exits with 1 if there is any message, or a check that was
/// asked for is not done; Ctrl-C tells what was found so far.
#[derive(Debug, Clone, Args)]
pub struct ValidateArgs {
    /// For every kernel only as many scenes as turn on and off all that a plan can
    #[arg(long)]
    pub quick: bool,
    /// What to check, one after the other
    #[arg(long, value_enum, value_name = "CHECKS", default_value_t = Checks::All)]
    pub validate: Checks,
    /// Where to write what was found: a file (.json with every run, .csv of the messages, .md); may be repeated
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// Those that take longest come first.
fn kinds(checks: Checks) -> Vec<Validation> {
    match checks {
        Checks::All => vec![Validation::GpuAssisted, Validation::Core, Validation::BestPractices],
        one => vec![one.validation()],
    }
}

/// A run that is next, and how many there are in all passes.
pub(super) struct Next<'a> {
    pub name: &'a str,
    pub all: usize,
}

/// Hears of every run before it, often in between, and can stop the work.
pub(super) type Watch<'a> = &'a (dyn Fn(Option<Next<'_>>) -> ControlFlow<()> + Sync);

pub fn run(args: &ValidateArgs) -> Result<()> {
    args.output.iter().try_for_each(|path| check_table_path(path))?;
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
    args.output.iter().try_for_each(|path| outcome.save(path))?;
    print_line(if args.json { outcome.to_json() } else { outcome.to_markdown() }.trim_end())?;
    drawn?;
    if outcome.message_count > 0 {
        return Err(ValidationFailed { count: outcome.message_count }.into());
    }
    match silent(&outcome.checks) {
        checks if checks.is_empty() => Ok(()),
        checks => Err(ChecksNotDone { checks }.into()),
    }
}

/// Such as `GPU-assisted, synchronization (core)`: those that reported nothing of the mistakes that they are there for.
fn silent(checks: &[TriedCheck]) -> String {
    let named = |&TriedCheck { validation, check, .. }: &TriedCheck| match check.name() {
        name if name == validation => name.to_owned(),
        name => format!("{name} ({validation})"),
    };
    checks.iter().filter(|tried| !tried.works).map(named).collect::<Vec<_>>().join(", ")
}

/// No message means nothing of what these are for.
#[derive(Debug, thiserror::Error)]
#[error("this layer does not do what it was asked for: {checks}; --validate=CHECKS asks for one kind")]
struct ChecksNotDone {
    checks: String,
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
    let program = |validation| {
        let runs = if validation == Validation::GpuAssisted { instrumented(&runs, scope) } else { runs.clone() };
        Program { validation, runs }
    };
    let programs: Vec<_> = kinds(args.validate).into_iter().map(program).collect();
    let mut findings = Findings::default();
    let drawn = draw(wanted, &programs, &mut outcome, &mut findings, watch);
    outcome.complete = drawn.is_ok();
    outcome.take_in(findings);
    Ok((outcome, drawn))
}

/// What the window draws: what differs from the runs off-screen is behind the tracing, and the same for all kernels. So
/// of instrumented ones the course's is enough, which compiles fastest.
fn shown(program: &Program) -> Vec<&Run> {
    let is_shown = |run: &&Run| {
        run.is_as_in_window && (program.validation != Validation::GpuAssisted || run.settings.kernel == Kernel::Course)
    };
    program.runs.iter().filter(is_shown).collect()
}

/// All programs, off-screen and in the window, up to the first failure.
fn draw(
    wanted: Option<&str>,
    programs: &[Program],
    outcome: &mut Outcome,
    findings: &mut Findings,
    watch: Watch<'_>,
) -> Result<()> {
    let all = programs.iter().map(|program| program.runs.len() + shown(program).len()).sum();
    let observe = |run: Option<&Run>| watch(run.map(|Run { name, .. }| Next { name, all }));
    let mut failure = Ok(());
    for OffScreen { checks, pass, found, drawn } in draw_off_screen(wanted, programs, &observe) {
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
    for program in programs {
        let messages = Messages::default();
        let window = PictureWindow::open(&mut display, PICTURE, wanted, program.validation, &messages);
        findings.note("opening the window", &messages, 0);
        let mut window = match window {
            Ok(window) => window,
            Err(error) => {
                outcome.no_window = Some(error.to_string());
                return Ok(());
            }
        };
        let shown = shown(program);
        let mut pass = Pass::new(program.validation, true, shown.len());
        let drawn = show_all(&mut window, &shown, &messages, findings, &mut |place| {
            is_at(shown[place], place, &mut pass, all, watch)
        });
        outcome.passes.push(pass);
        let before = messages.count();
        drop(window);
        findings.note("closing the window", &messages, before);
        findings.note_remarks(&messages);
        drawn?;
    }
    Ok(())
}

/// `observe` gets every run with its index, and can stop the work there.
fn show_all(
    window: &mut PictureWindow,
    runs: &[&Run],
    messages: &Messages,
    findings: &mut Findings,
    observe: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<(), TracerError> {
    for (place, run) in runs.iter().enumerate() {
        let before = messages.count();
        let Settings { kernel, width, height, .. } = run.settings;
        let as_in_window = Settings { kernel, ..Settings::new(width, height) };
        let shown = window.show(&as_in_window, &run.scene, &mut || observe(place));
        findings.note(&format!("in a window: {}", run.name), messages, before);
        shown?;
    }
    Ok(())
}

/// At the run with index `place` in its pass.
fn is_at(run: &Run, place: usize, pass: &mut Pass, all: usize, watch: Watch<'_>) -> ControlFlow<()> {
    let is_new = pass.begun == place;
    watch(is_new.then_some(Next { name: &run.name, all }))?;
    pass.begun += usize::from(is_new);
    ControlFlow::Continue(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::Check;

    #[test]
    fn a_check_that_is_not_done_is_named() {
        let tried = |validation: Validation, check, works| TriedCheck { validation: validation.name(), check, works };
        let checks = vec![
            tried(Validation::GpuAssisted, Check::GpuAssisted, false),
            tried(Validation::Core, Check::Core, true),
            tried(Validation::Core, Check::Synchronization, false),
        ];
        assert_eq!(silent(&checks), "GPU-assisted, synchronization (core)");
        assert_eq!(silent(&checks[1..2]), "");
    }
}
