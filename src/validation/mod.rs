//! Every kernel, precision and variant of a plan drawn under the validation layers, and what they have to say.

mod findings;
mod outcome;
mod runs;

use std::ops::ControlFlow;
use std::sync::Arc;

pub use findings::{Findings, Group};
pub use outcome::{Allowed, Outcome, Pass, TriedCheck};
pub use runs::{PICTURE, Run, Scope, Switch, runs, switches};

use crate::gpu::{Device, Validation};
use crate::tracer::{Tracer, TracerError};

/// Draws all runs on one device, opened and closed for them under `validation`; `findings` gets what that brought, up to
/// the end or an error.
///
/// `observe` hears of every run, by its place, before it and after each of its tiles, and can stop the work there.
///
/// # Errors
/// As of [`Device::open`]; the device fails, or `observe` breaks.
pub fn survey(
    wanted: Option<&str>,
    validation: Validation,
    runs: &[Run],
    findings: &mut Findings,
    observe: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<(), TracerError> {
    let device = Device::open(wanted, validation)?;
    let messages = device.messages().clone();
    findings.note("opening the device", &messages, 0);
    let drawn = draw_all(&device, runs, findings, observe);
    let before = messages.count();
    drop(device);
    findings.note("closing the device", &messages, before);
    findings.note_allowed(&messages);
    drawn
}

fn draw_all(
    device: &Arc<Device>,
    runs: &[Run],
    findings: &mut Findings,
    observe: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<(), TracerError> {
    let mut tracer = None;
    for (place, run) in runs.iter().enumerate() {
        let before = device.messages().count();
        let drawn = draw(device, &mut tracer, run, &mut || observe(place));
        findings.note(&run.name, device.messages(), before);
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
    if keep_going().is_break() {
        return Err(TracerError::Stopped);
    }
    let tracer = match tracer {
        Some(tracer) => {
            tracer.take_up(&run.scene, &run.settings)?;
            tracer
        }
        None => tracer.insert(Tracer::new(device, &run.scene, &run.settings)?),
    };
    let mut frame = tracer.frame()?;
    tracer.render(&mut frame, &mut |_| keep_going())?;
    Ok(())
}
