//! Table 4.1 of the course work measured anew: frames a second by kind of solids, their number and the kernel that
//! draws them, beside the published ones.

mod agreement;
mod chart;
mod figures;
mod file;
mod measuring;
mod published;
mod speeds;
mod tables;

use serde::{Deserialize, Serialize};

pub(crate) use agreement::Agreement;
pub(crate) use chart::chart;
pub(crate) use file::FpsTableError;
pub(crate) use measuring::{OffScreen, Stage, measure, no_scene, settings_of};
pub(crate) use published::{CLAIMED_OF_SPHERES, published};
pub(crate) use speeds::Speeds;
pub(crate) use tables::{agreement, spreads};

use super::{Budget, Clock, Machine, Summary};
use crate::algorithm::{Algorithm, Kernel, Precision};
use crate::frame::Frame;
use crate::scene::{DEPTH_LIMIT, SolidKind};
use crate::tracer::TracerError;

/// What draws the table's cells by an algorithm: in `f32`.
///
/// # Errors
/// The CPU does its work.
fn kernel_of(algorithm: Algorithm) -> Result<Kernel, TracerError> {
    let kernel = algorithm.kernel(Precision::F32);
    kernel.ok_or_else(|| TracerError::Refused(format!("table 4.1 is not measured with {}", algorithm.name())))
}

/// What is measured, and how long.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plan {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Generations of a ray.
    pub generations: u32,
    /// Kernels, each once.
    #[serde(rename = "kernels")]
    pub algorithms: Vec<Algorithm>,
    /// Numbers of solids, ascending.
    pub counts: Vec<usize>,
    /// Budget of each kernel in each cell.
    pub budget: Budget,
    /// Whether the validation layers watch, which takes its time.
    pub validation: bool,
    /// Whether every frame is shown in a window, as in the course work.
    pub in_window: bool,
}

impl Plan {
    /// The course work's table, by both kernels and with little time.
    pub fn of_course() -> Self {
        Self {
            width: 1621,
            height: 701,
            generations: 20,
            algorithms: Algorithm::in_fps_table().collect(),
            counts: Self::course_counts(),
            budget: Budget::QUICK,
            validation: false,
            in_window: false,
        }
    }

    /// The numbers of solids that table 4.1 has.
    pub fn course_counts() -> Vec<usize> {
        (10..=100).step_by(10).collect()
    }

    /// Smallest number of solids.
    pub fn fewest(&self) -> usize {
        self.counts.first().copied().unwrap_or_default()
    }

    /// Refuses, in a sentence, what cannot be measured.
    pub fn check(&self) -> Result<(), String> {
        let Self { width, height, generations, algorithms, counts, budget, validation: _, in_window: _ } = self;
        Frame::check_size(*width, *height).map_err(|error| error.to_string())?;
        if !(1..=DEPTH_LIMIT).contains(generations) {
            return Err(format!("{generations} generations are impossible: 1 to {DEPTH_LIMIT}"));
        }
        if algorithms.is_empty() || (1..algorithms.len()).any(|place| algorithms[..place].contains(&algorithms[place]))
        {
            return Err("an algorithm must be named, and each once".to_owned());
        }
        let is_of_table = |count: &usize| Self::course_counts().contains(count);
        if counts.is_empty() || !counts.iter().all(is_of_table) || !counts.is_sorted_by(|a, b| a < b) {
            return Err("numbers of solids are those of table 4.1, 10, 20 and so on to 100, each once".to_owned());
        }
        if budget.time_ms == 0 || budget.frames == 0 {
            return Err("a cell must be given some time and a frame".to_owned());
        }
        Ok(())
    }
}

/// What one kernel makes of one number of one kind of solids.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cell {
    /// Kind of the solids.
    pub kind: SolidKind,
    /// Number of solids.
    pub count: usize,
    /// Kernel that drew it.
    #[serde(rename = "kernel")]
    pub algorithm: Algorithm,
    /// GPU time of every frame but the first, in order; `None` where the device has no timestamps.
    pub gpu_samples_ns: Option<Vec<u64>>,
    /// Wall time of the same frames.
    pub wall_samples_ns: Vec<u64>,
}

impl Cell {
    /// `None` where that clock measured nothing.
    pub fn summary(&self, clock: Clock) -> Option<Summary> {
        match clock {
            Clock::Gpu => self.gpu_samples_ns.as_deref().and_then(Summary::of),
            Clock::Wall => Summary::of(&self.wall_samples_ns),
        }
    }

    /// Where in the table it is, for messages.
    fn name(&self) -> String {
        format!("{} of the kind {}, {} kernel", self.count, self.kind.name(), self.algorithm.name())
    }
}

/// Frames a second of so long a frame.
pub fn frames_per_second(frame_time_ns: f64) -> f64 {
    1e9 / frame_time_ns.max(1.0)
}

/// What was measured, whole or in part.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FpsTable {
    /// Where it was measured.
    pub machine: Machine,
    /// What belongs in the table.
    pub plan: Plan,
    /// In the order of measuring.
    pub cells: Vec<Cell>,
}

impl FpsTable {
    /// Nothing measured yet.
    pub fn new(machine: Machine, plan: Plan) -> Self {
        Self { machine, plan, cells: Vec::new() }
    }

    /// Positions in the table that lack a kernel, row after row: an interrupted table has whole rows.
    pub fn missing(&self) -> Vec<(SolidKind, usize)> {
        let places = self.plan.counts.iter().flat_map(|&count| SolidKind::ALL.map(|kind| (kind, count)));
        places
            .filter(|&(kind, count)| self.plan.algorithms.iter().any(|&k| self.cell(kind, count, k).is_none()))
            .collect()
    }

    /// Puts in what was measured, in place of what the table had there.
    pub fn put(&mut self, cells: Vec<Cell>) {
        let place = |cell: &Cell| (cell.kind, cell.count, cell.algorithm);
        self.cells.retain(|old| !cells.iter().any(|new| place(new) == place(old)));
        self.cells.extend(cells);
    }

    /// What is known of a cell; `None`: not measured yet.
    pub(crate) fn cell(&self, kind: SolidKind, count: usize, algorithm: Algorithm) -> Option<&Cell> {
        self.cells.iter().find(|cell| (cell.kind, cell.count, cell.algorithm) == (kind, count, algorithm))
    }

    /// By GPU time where the device has it; in a window by the frames that it took, as in the course work.
    pub fn clock(&self) -> Clock {
        let has_gpu_times = self.cells.iter().all(|cell| cell.gpu_samples_ns.is_some());
        if has_gpu_times && !self.plan.in_window { Clock::Gpu } else { Clock::Wall }
    }

    /// Speeds by the median frames of a kernel.
    pub fn speeds(&self, algorithm: Algorithm, clock: Clock) -> Speeds {
        let mut speeds = Speeds::default();
        for cell in self.cells.iter().filter(|cell| cell.algorithm == algorithm) {
            if let Some(summary) = cell.summary(clock) {
                speeds.set(cell.kind, cell.count, frames_per_second(summary.median_ns as f64));
            }
        }
        speeds
    }

    /// One line for every cell with outliers, such as a warning wants.
    pub fn outliers(&self) -> Vec<String> {
        let clock = self.clock();
        let line = |cell: &Cell| {
            let summary = cell.summary(clock)?;
            (!summary.outliers.is_empty()).then(|| {
                format!(
                    "{}: {} of {} frames (median {:.3} ms, {:.3} to {:.3} ms)",
                    cell.name(),
                    summary.outliers.len(),
                    summary.count,
                    summary.median_ns as f64 / 1e6,
                    summary.min_ns as f64 / 1e6,
                    summary.max_ns as f64 / 1e6,
                )
            })
        };
        self.cells.iter().filter_map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table whose cell of `count` solids takes `count` ms a frame with spheres and one more for every kind after.
    /// That the table is of.
    pub(in crate::measure) const BOTH: [Algorithm; 2] = [Algorithm::Course, Algorithm::Whitted];

    pub(super) fn example(counts: &[usize], algorithms: &[Algorithm]) -> FpsTable {
        let machine = Machine {
            device: "a device, of \"two\" cores".into(),
            driver: "driver 1".into(),
            program: "z 1".into(),
            present_mode: None,
        };
        let plan = Plan {
            width: 160,
            height: 70,
            generations: 20,
            algorithms: algorithms.to_vec(),
            counts: counts.to_vec(),
            budget: Budget::QUICK,
            validation: false,
            in_window: false,
        };
        let mut table = FpsTable::new(machine, plan);
        for (kind, count) in table.missing() {
            for &algorithm in algorithms {
                let time_ns =
                    (count as u64 + kind as u64) * 1_000_000 / if algorithm == Algorithm::Course { 1 } else { 2 };
                let wall_samples_ns = [1, 2, 0, 1, 1].map(|more| time_ns + more * 50_000).to_vec();
                let gpu_samples_ns = Some([0, 0, 0, 0, 0].map(|more| time_ns + more).to_vec());
                table.cells.push(Cell { kind, count, algorithm, gpu_samples_ns, wall_samples_ns });
            }
        }
        table
    }

    #[test]
    fn names_are_those_of_json() {
        for kind in SolidKind::ALL {
            assert_eq!(serde_json::to_value(kind).unwrap(), kind.name());
        }
        for algorithm in BOTH {
            assert_eq!(serde_json::to_value(algorithm).unwrap(), algorithm.name());
        }
    }

    #[test]
    fn what_is_missing_comes_row_after_row_and_where_any_kernel_lacks() {
        let mut table = example(&[10, 20], &BOTH);
        assert_eq!(table.missing(), []);
        table.cells.retain(|cell| cell.count == 10);
        assert_eq!(table.missing(), SolidKind::ALL.map(|kind| (kind, 20)));
        table.cells.remove(1);
        assert_eq!(table.missing()[0], (SolidKind::Sphere, 10));
    }

    #[test]
    fn speeds_are_of_the_median_frame_by_either_clock() {
        let mut table = example(&[10], &BOTH);
        assert_eq!(table.clock(), Clock::Gpu);
        assert_eq!(table.speeds(Algorithm::Course, Clock::Gpu).get(SolidKind::Sphere, 10), Some(100.0));
        assert_eq!(table.speeds(Algorithm::Whitted, Clock::Gpu).get(SolidKind::Sphere, 10), Some(200.0));
        let wall = table.speeds(Algorithm::Course, Clock::Wall).get(SolidKind::Sphere, 10);
        assert_eq!(wall, Some(1e9 / 10_050_000.0));
        table.plan.in_window = true;
        assert_eq!(table.clock(), Clock::Wall);
        table.plan.in_window = false;
        table.cells[3].gpu_samples_ns = None;
        assert_eq!(table.clock(), Clock::Wall);
    }

    #[test]
    fn outliers_are_told_by_cell() {
        let mut table = example(&[10], &[Algorithm::Course]);
        assert_eq!(table.outliers(), Vec::<String>::new());
        table.cells[1].gpu_samples_ns = Some(vec![1_000_000, 1_000_000, 9_000_000, 1_000_000, 1_000_000]);
        let [line] = &table.outliers()[..] else { panic!("one cell has outliers") };
        assert_eq!(line, "10 of the kind box, course kernel: 1 of 5 frames (median 1.000 ms, 1.000 to 9.000 ms)");
    }
}
