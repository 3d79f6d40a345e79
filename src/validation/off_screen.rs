//! Runs without a window, by as many threads as the machine has cores: most of the work is compiling, which takes one.

use std::iter;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use super::selection::by_shader;
use super::{Findings, Pass, Run, TriedCheck};
use crate::gpu::{Device, Messages, Validation, try_checks};
use crate::tracer::{Tracer, TracerError};

/// A kind of validation with the runs that are drawn under it.
pub struct Program {
    /// What the layer checks.
    pub validation: Validation,
    /// Those of one shader in a row, which one thread draws.
    pub runs: Vec<Run>,
}

/// What came of a [`Program`], up to its end or the first failure.
pub struct OffScreen {
    /// Those of the program's kind of validation.
    pub checks: Vec<TriedCheck>,
    /// How many runs there were, and were begun.
    pub pass: Pass,
    /// What the layer and the recorder said, with the runs that brought it.
    pub found: Findings,
    /// The first failure, where there was one.
    pub drawn: Result<(), TracerError>,
}

/// Hears of a run before it, and often in between without one; can stop the work.
pub type Observe<'a> = &'a (dyn Fn(Option<&Run>) -> ControlFlow<()> + Sync);

/// A part of a program that one thread does on a device of its own.
struct Task<'a> {
    /// Index of the program.
    program: usize,
    validation: Validation,
    work: Work<'a>,
}

enum Work<'a> {
    TryChecks,
    Draw(&'a [Run]),
}

struct Done {
    program: usize,
    checks: Vec<TriedCheck>,
    begun: usize,
    found: Findings,
    drawn: Result<(), TracerError>,
}

/// Draws all programs on the device `wanted`, or the best one; the first are begun first.
pub fn draw_off_screen(wanted: Option<&str>, programs: &[Program], observe: Observe<'_>) -> Vec<OffScreen> {
    let tasks: Vec<_> = programs.iter().enumerate().flat_map(tasks_of).collect();

    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    let work = || {
        while let Some(task) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
            let ended = task.run(wanted, observe);
            if ended.drawn.is_err() {
                next.store(tasks.len(), Ordering::Relaxed);
            }
            done.lock().unwrap_or_else(PoisonError::into_inner).push(ended);
        }
    };
    thread::scope(|scope| {
        // Two at least: one of them waits for its device now and then.
        for _ in 0..thread::available_parallelism().map_or(2, |cores| cores.get().max(2)) {
            scope.spawn(work);
        }
    });

    let begin = |program: &Program| OffScreen {
        checks: Vec::new(),
        pass: Pass::new(program.validation, false, program.runs.len()),
        found: Findings::default(),
        drawn: Ok(()),
    };
    let mut outcomes: Vec<_> = programs.iter().map(begin).collect();
    for Done { program, checks, begun, found, drawn } in done.into_inner().unwrap_or_else(PoisonError::into_inner) {
        let outcome = &mut outcomes[program];
        outcome.checks.extend(checks);
        outcome.pass.begun += begun;
        outcome.found.add(found);
        let before = std::mem::replace(&mut outcome.drawn, Ok(()));
        outcome.drawn = before.and(drawn);
    }
    outcomes
}

fn tasks_of((index, program): (usize, &Program)) -> impl Iterator<Item = Task<'_>> {
    let works = iter::once(Work::TryChecks).chain(by_shader(&program.runs).map(Work::Draw));
    works.map(move |work| Task { program: index, validation: program.validation, work })
}

impl Task<'_> {
    fn run(&self, wanted: Option<&str>, observe: Observe<'_>) -> Done {
        let &Self { program, validation, ref work } = self;
        let mut done = Done { program, checks: Vec::new(), begun: 0, found: Findings::default(), drawn: Ok(()) };
        done.drawn = match work {
            Work::TryChecks => try_checks(wanted, validation)
                .map(|tried| {
                    let tried = tried.into_iter();
                    let named = |(check, works)| TriedCheck { validation: validation.name(), check, works };
                    done.checks = tried.map(named).collect();
                })
                .map_err(TracerError::from),
            Work::Draw(runs) => survey(wanted, validation, runs, &mut done, observe),
        };
        done
    }
}

/// Draws runs on one device, opened and closed for them.
fn survey(
    wanted: Option<&str>,
    validation: Validation,
    runs: &[Run],
    done: &mut Done,
    observe: Observe<'_>,
) -> Result<(), TracerError> {
    let device = Device::open(wanted, validation)?;
    let messages = device.messages().clone();
    done.found.note("opening the device", &messages, 0);
    let drawn = draw_all(&device, runs, &messages, done, observe);
    let before = messages.count();
    drop(device);
    done.found.note("closing the device", &messages, before);
    done.found.note_remarks(&messages);
    drawn
}

fn draw_all(
    device: &Arc<Device>,
    runs: &[Run],
    messages: &Messages,
    done: &mut Done,
    observe: Observe<'_>,
) -> Result<(), TracerError> {
    let mut tracer = None;
    for run in runs {
        if observe(Some(run)).is_break() {
            return Err(TracerError::Stopped);
        }
        done.begun += 1;
        let before = messages.count();
        let drawn = draw(device, &mut tracer, run, &mut || observe(None));
        done.found.note(&run.name, messages, before);
        drawn?;
    }
    Ok(())
}

/// Keeps the pipeline of the run before where it fits.
fn draw(
    device: &Arc<Device>,
    tracer: &mut Option<Tracer>,
    run: &Run,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<(), TracerError> {
    let tracer = match tracer {
        Some(tracer) => {
            tracer.set_scene(&run.scene, &run.settings)?;
            tracer
        }
        None => tracer.insert(Tracer::new(device, &run.scene, &run.settings)?),
    };
    let mut frame = tracer.frame()?;
    tracer.render(&mut frame, &mut |_| keep_going())?;
    Ok(())
}
