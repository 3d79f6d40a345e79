//! The whole catalogue on several kernels: a row a trial.

use std::ops::ControlFlow;
use std::sync::Arc;

use serde::Serialize;

use super::{Case, Subject, Verdict, catalogue};
use crate::gpu::Device;
use crate::tracer::{Kernel, TracerError};

/// What came of a case on a kernel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Name of the case, such as `SC-1`.
    pub id: String,
    /// `scene` where the loader is tested, before any kernel.
    pub kernel: &'static str,
    /// Null for the loader.
    pub precision: Option<&'static str>,
    /// Whether all measurements of the case passed.
    pub pass: bool,
    /// Name of the measurement that comes nearest to its bound or is farthest beyond.
    pub what: &'static str,
    /// Null where it is not a number.
    pub measured: f64,
    /// Largest `measured` that passes.
    pub bound: f64,
}

impl Row {
    fn new(case: &Case, kernel: Option<Kernel>, verdict: &Verdict) -> Self {
        let (kernel, precision) =
            kernel.map_or(("scene", None), |kernel| (kernel.algorithm().name(), Some(kernel.precision().name())));
        let worst = verdict.worst;
        let (what, measured, bound) = (worst.what, worst.measured, worst.bound);
        Self { id: case.id.clone(), kernel, precision, pass: verdict.passes(), what, measured, bound }
    }

    /// A fault: all must pass what is for them, but those that are there to compare.
    pub fn is_fault(&self) -> bool {
        !self.pass && !matches!(self.kernel, "course" | "plain")
    }

    /// Kernel and precision.
    pub fn subject(&self) -> String {
        [Some(self.kernel), self.precision].into_iter().flatten().collect::<Vec<_>>().join(" ")
    }
}

/// How far it is.
#[derive(Debug, Clone, Copy)]
pub struct Progress<'a> {
    /// Trials.
    pub done: usize,
    pub all: usize,
    /// Name of the case that is next.
    pub id: &'a str,
}

/// Tests all cases on all kernels. Adds to `rows` as it goes, so that what is tested is there after a failure or a
/// stop.
///
/// # Errors
/// The device fails, or `watch` breaks.
pub fn try_all(
    device: &Arc<Device>,
    kernels: &[Kernel],
    is_quick: bool,
    rows: &mut Vec<Row>,
    watch: &mut dyn FnMut(Progress<'_>) -> ControlFlow<()>,
) -> Result<(), TracerError> {
    let cases = catalogue();
    let subjects: Vec<_> = kernels.iter().map(|&kernel| Subject::new(device, kernel, is_quick)).collect();
    let all = cases.len() * subjects.len();
    let mut done = 0;
    for case in &cases {
        rows.extend(case.try_loader().map(|verdict| Row::new(case, None, &verdict)));
        for subject in &subjects {
            if watch(Progress { done, all, id: &case.id }).is_break() {
                return Err(TracerError::Stopped);
            }
            let verdict = case.try_kernel(subject)?;
            rows.extend(verdict.map(|verdict| Row::new(case, Some(subject.kernel), &verdict)));
            done += 1;
        }
    }
    Ok(())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub fn row(id: &str, kernel: &'static str, pass: bool) -> Row {
        let precision = Some("f32").filter(|_| kernel != "scene");
        Row { id: id.to_owned(), kernel, precision, pass, what: "wrong faces", measured: 0.0, bound: 0.0 }
    }

    #[test]
    fn all_must_pass_but_those_that_are_there_to_compare() {
        assert!(!row("SC-1", "course", false).is_fault() && !row("SC-1", "whitted", true).is_fault());
        assert!(!row("SC-1", "plain", false).is_fault());
        for kernel in ["whitted", "scene", "ssr", "path"] {
            assert!(row("SC-1", kernel, false).is_fault(), "{kernel}");
        }
    }
}
