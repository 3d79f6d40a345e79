//! The whole catalogue on several kernels: a row a trial, and how many passed.

use std::ops::ControlFlow;
use std::sync::Arc;

use serde::Serialize;

use super::{Case, Subject, Verdict, catalogue};
use crate::gpu::Device;
use crate::tracer::{Kernel, TracerError};

/// What came of a case on a kernel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    pub id: String,
    /// `scene` where the loader is tried, before any kernel.
    pub kernel: &'static str,
    /// Null for the loader.
    pub precision: Option<&'static str>,
    pub pass: bool,
    /// Of all that was measured, what comes nearest to its bound or is farthest beyond.
    pub what: &'static str,
    /// Null where it is not a number.
    pub measured: f64,
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

    /// A fault: the accurate kernel and the loader must pass all.
    pub fn is_fault(&self) -> bool {
        !self.pass && matches!(self.kernel, "whitted" | "scene")
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
    /// Of the case that is next.
    pub id: &'a str,
}

/// Tries all cases on all kernels. Adds to `rows` as it goes, so that what is tried is there after a failure or a stop.
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

/// How many passed of how many were tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Passed {
    pub passed: usize,
    pub tried: usize,
}

/// A line a group of cases, a column a kernel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Summary {
    /// The columns' kernels and precisions.
    pub subjects: Vec<String>,
    /// `None` where no case of the group is for that kernel.
    pub groups: Vec<(String, Vec<Option<Passed>>)>,
    /// Of all groups.
    pub all: Vec<Passed>,
}

impl Summary {
    /// Groups and kernels in the rows' order.
    pub fn of(rows: &[Row]) -> Self {
        let (mut subjects, mut names): (Vec<String>, Vec<&str>) = (Vec::new(), Vec::new());
        for row in rows {
            if !subjects.contains(&row.subject()) {
                subjects.push(row.subject());
            }
            if !names.contains(&group(row)) {
                names.push(group(row));
            }
        }
        let passed = |is_wanted: &dyn Fn(&Row) -> bool| {
            let wanted = || rows.iter().filter(|row| is_wanted(row));
            Passed { passed: wanted().filter(|row| row.pass).count(), tried: wanted().count() }
        };
        let of_group = |name: &&str| {
            let cell = |subject: &String| {
                let cell = passed(&|row| group(row) == *name && row.subject() == *subject);
                (cell.tried > 0).then_some(cell)
            };
            ((*name).to_owned(), subjects.iter().map(cell).collect())
        };
        Self {
            groups: names.iter().map(of_group).collect(),
            all: subjects.iter().map(|subject| passed(&|row| row.subject() == *subject)).collect(),
            subjects,
        }
    }
}

/// Letters before the number.
fn group(row: &Row) -> &str {
    row.id.split('-').next().unwrap_or(&row.id)
}

/// Counts whole, the rest to three digits.
pub fn short(value: f64) -> String {
    match value {
        _ if !value.is_finite() => value.to_string(),
        _ if value.fract() == 0.0 && value.abs() < 1e6 => format!("{value:.0}"),
        _ if (1e-3..1e4).contains(&value.abs()) => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(id: &str, kernel: &'static str, pass: bool) -> Row {
        let precision = Some("f32").filter(|_| kernel != "scene");
        Row { id: id.to_owned(), kernel, precision, pass, what: "wrong faces", measured: 0.0, bound: 0.0 }
    }

    #[test]
    fn passes_are_counted_by_group_and_kernel() {
        let rows = [
            row("SC-1", "course", false),
            row("SC-1", "whitted", true),
            row("SC-2", "course", true),
            row("N-0", "scene", true),
        ];
        let summary = Summary::of(&rows);
        assert_eq!(summary.subjects, ["course f32", "whitted f32", "scene"]);
        let cell = |passed, tried| Some(Passed { passed, tried });
        assert_eq!(
            summary.groups,
            [("SC".to_owned(), vec![cell(1, 2), cell(1, 1), None]), ("N".to_owned(), vec![None, None, cell(1, 1)])]
        );
        assert_eq!(summary.all.iter().map(|all| (all.passed, all.tried)).collect::<Vec<_>>(), [(1, 2), (1, 1), (1, 1)]);
        assert_eq!(Summary::of(&[]).groups, []);
    }

    #[test]
    fn only_the_accurate_kernel_and_the_loader_must_pass() {
        assert!(!row("SC-1", "course", false).is_fault() && !row("SC-1", "whitted", true).is_fault());
        assert!(row("SC-1", "whitted", false).is_fault() && row("N-0", "scene", false).is_fault());
    }
}
