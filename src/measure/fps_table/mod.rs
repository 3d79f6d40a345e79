//! Table 4.1 of the course work measured anew: frames a second by kind of solids, their number and the kernel that draws
//! them, beside the published ones.

mod agreement;
mod chart;
mod csv;
mod figures;
mod file;
mod markdown;
mod measuring;
mod published;
mod speeds;

use std::time::Duration;

use serde::{Deserialize, Serialize};

pub use agreement::{Agreement, Bend, Ratio};
pub use figures::{Figures, figures};
pub use file::{FpsTableError, ReportFormat};
pub use measuring::{FrameTime, OffScreen, Stage, measure};
pub use published::{CLAIMED_OF_SPHERES, CLAIMED_ORDER, published};
pub use speeds::Speeds;

use super::Summary;
use crate::frame::Frame;
use crate::gpu::DeviceDescription;
use crate::scene::{DEPTH_LIMIT, SolidKind};
use crate::tracer::{self, Precision};

/// The kernels that the table is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kernel {
    /// The course work's.
    Course,
    /// The accurate model in `f32`.
    Whitted,
}

impl Kernel {
    pub const ALL: [Self; 2] = [Self::Course, Self::Whitted];

    pub fn name(self) -> &'static str {
        match self {
            Self::Course => "course",
            Self::Whitted => "whitted",
        }
    }

    /// As the tracer calls it.
    pub fn in_tracer(self) -> tracer::Kernel {
        match self {
            Self::Course => tracer::Kernel::Course,
            Self::Whitted => tracer::Kernel::Whitted(Precision::F32),
        }
    }
}

/// What measured.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    pub device: String,
    /// Name and version.
    pub driver: String,
    /// This program, its version and, where it was built in a clone, the commit that it was built on: edits since are
    /// not told.
    pub program: String,
    /// How frames were shown in a window, by Vulkan's word, such as `mailbox`; `None` where none was.
    pub present_mode: Option<String>,
}

impl Machine {
    /// This program on a device, nothing shown.
    pub fn of(device: &DeviceDescription) -> Self {
        let version = concat!("zerkalo ", env!("CARGO_PKG_VERSION"));
        let program = option_env!("ZERKALO_COMMIT")
            .map_or(version.to_owned(), |commit| format!("{version} (on commit {commit})"));
        Self { device: device.name.clone(), driver: device.driver.clone(), program, present_mode: None }
    }
}

/// What is measured, and how long.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plan {
    /// Pixels.
    pub width: u32,
    pub height: u32,
    /// Of a ray.
    pub generations: u32,
    pub kernels: Vec<Kernel>,
    /// Numbers of solids, ascending.
    pub counts: Vec<usize>,
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
            kernels: Kernel::ALL.into(),
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

    /// Of solids.
    pub fn fewest(&self) -> usize {
        self.counts.first().copied().unwrap_or_default()
    }

    /// Refuses, in a sentence, what cannot be measured.
    pub fn check(&self) -> Result<(), String> {
        let Self { width, height, generations, kernels, counts, budget, validation: _, in_window: _ } = self;
        Frame::check_size(*width, *height).map_err(|error| error.to_string())?;
        if !(1..=DEPTH_LIMIT).contains(generations) {
            return Err(format!("{generations} generations are impossible: 1 to {DEPTH_LIMIT}"));
        }
        if kernels.is_empty() || (1..kernels.len()).any(|place| kernels[..place].contains(&kernels[place])) {
            return Err("a kernel must be named, and each once".to_owned());
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

/// When a kernel has been measured enough in a cell: after its time or after its frames, whichever is first, but never
/// after fewer frames than [`Budget::MIN_FRAMES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Budget {
    /// Wall time of the kernel's frames, milliseconds.
    pub time_ms: u64,
    pub frames: usize,
    /// Frames are not enough before so much time, milliseconds: a fast device raises its clock under load only.
    pub least_ms: u64,
}

impl Budget {
    /// One frame has no spread.
    pub const MIN_FRAMES: usize = 2;
    /// Figures in minutes on a slow device, in half a minute on a fast one.
    pub const QUICK: Self = Self { time_ms: 3000, frames: 5, least_ms: 250 };

    /// As long as told; a device that is through with ten thousand frames before has shown what it can, and its file
    /// shall be of a size to be opened.
    pub fn lasting(time: Duration) -> Self {
        Self { time_ms: time.as_millis() as u64, frames: 10_000, least_ms: 0 }
    }

    /// How much of the measuring is done, 1 or more where all is.
    fn share_done(self, frames: usize, time: Duration) -> f64 {
        let of_frames = |all: usize| frames as f64 / all as f64;
        // Nothing of nothing is all of it.
        let of_time = |all_ms: u64| if all_ms == 0 { 1.0 } else { time.as_secs_f64() * 1e3 / all_ms as f64 };
        let by_frames = of_frames(self.frames).min(of_time(self.least_ms));
        by_frames.max(of_time(self.time_ms)).min(of_frames(Self::MIN_FRAMES))
    }
}

/// Which of its two times a frame is judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Clock {
    /// Of the tracing alone, by the device's timestamps.
    Gpu,
    /// From the call to the picture in the host's memory: submission, tracing and the copy. In a window, from one frame
    /// given to the window system to the next.
    Wall,
}

/// What one kernel makes of one number of one kind of solids.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cell {
    pub kind: SolidKind,
    /// Of solids.
    pub count: usize,
    pub kernel: Kernel,
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
}

/// Frames a second of so long a frame.
pub fn frames_per_second(frame_time_ns: f64) -> f64 {
    1e9 / frame_time_ns.max(1.0)
}

/// What was measured, whole or in part.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FpsTable {
    pub machine: Machine,
    pub plan: Plan,
    /// In the order of measuring.
    pub cells: Vec<Cell>,
}

impl FpsTable {
    /// Nothing measured yet.
    pub fn new(machine: Machine, plan: Plan) -> Self {
        Self { machine, plan, cells: Vec::new() }
    }

    /// The places of the table that lack a kernel, row after row: an interrupted table has whole rows.
    pub fn missing(&self) -> Vec<(SolidKind, usize)> {
        let places = self.plan.counts.iter().flat_map(|&count| SolidKind::ALL.map(|kind| (kind, count)));
        places.filter(|&(kind, count)| self.plan.kernels.iter().any(|&k| self.cell(kind, count, k).is_none())).collect()
    }

    /// Puts in what was measured, in place of what the table had there.
    pub fn put(&mut self, cells: Vec<Cell>) {
        let place = |cell: &Cell| (cell.kind, cell.count, cell.kernel);
        self.cells.retain(|old| !cells.iter().any(|new| place(new) == place(old)));
        self.cells.extend(cells);
    }

    pub fn cell(&self, kind: SolidKind, count: usize, kernel: Kernel) -> Option<&Cell> {
        self.cells.iter().find(|cell| (cell.kind, cell.count, cell.kernel) == (kind, count, kernel))
    }

    /// By GPU time where the device has it; in a window by the frames that it took, as in the course work.
    pub fn clock(&self) -> Clock {
        let has_gpu_times = self.cells.iter().all(|cell| cell.gpu_samples_ns.is_some());
        if has_gpu_times && !self.plan.in_window { Clock::Gpu } else { Clock::Wall }
    }

    /// Of the median frames of a kernel.
    pub fn speeds(&self, kernel: Kernel, clock: Clock) -> Speeds {
        let mut speeds = Speeds::default();
        for cell in self.cells.iter().filter(|cell| cell.kernel == kernel) {
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
            let Cell { kind, count, kernel, .. } = cell;
            (!summary.outliers.is_empty()).then(|| {
                format!(
                    "{count} of the kind {}, {} kernel: {} of {} frames (median {:.3} ms, {:.3} to {:.3} ms)",
                    kind.name(),
                    kernel.name(),
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
    pub(super) fn example(counts: &[usize], kernels: &[Kernel]) -> FpsTable {
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
            kernels: kernels.to_vec(),
            counts: counts.to_vec(),
            budget: Budget::QUICK,
            validation: false,
            in_window: false,
        };
        let mut table = FpsTable::new(machine, plan);
        for (kind, count) in table.missing() {
            for &kernel in kernels {
                let time_ns = (count as u64 + kind as u64) * 1_000_000 / (1 + kernel as u64);
                let wall_samples_ns = [1, 2, 0, 1, 1].map(|more| time_ns + more * 50_000).to_vec();
                let gpu_samples_ns = Some([0, 0, 0, 0, 0].map(|more| time_ns + more).to_vec());
                table.cells.push(Cell { kind, count, kernel, gpu_samples_ns, wall_samples_ns });
            }
        }
        table
    }

    #[test]
    fn names_are_those_of_json() {
        for kind in SolidKind::ALL {
            assert_eq!(serde_json::to_value(kind).unwrap(), kind.name());
        }
        for kernel in Kernel::ALL {
            assert_eq!(serde_json::to_value(kernel).unwrap(), kernel.name());
        }
    }

    #[test]
    fn a_cell_is_done_after_its_frames_or_its_time_but_not_before_two_frames() {
        let done = |budget: Budget, frames, ms| budget.share_done(frames, Duration::from_millis(ms)) >= 1.0;
        let quick = Budget::QUICK;
        assert!(!done(quick, 1, 60_000) && done(quick, 2, 60_000));
        assert!(!done(quick, 4, 2999) && done(quick, 4, 3000));
        assert!(!done(quick, 5, 249) && done(quick, 5, 250) && !done(quick, 100, 249));
        let full = Budget::lasting(Duration::from_secs(30));
        assert!(!done(full, 500, 29_999) && done(full, 500, 30_000) && done(full, 10_000, 1000));
    }

    #[test]
    fn what_is_missing_comes_row_after_row_and_where_any_kernel_lacks() {
        let mut table = example(&[10, 20], &Kernel::ALL);
        assert_eq!(table.missing(), []);
        table.cells.retain(|cell| cell.count == 10);
        assert_eq!(table.missing(), SolidKind::ALL.map(|kind| (kind, 20)));
        table.cells.remove(1);
        assert_eq!(table.missing()[0], (SolidKind::Sphere, 10));
    }

    #[test]
    fn speeds_are_of_the_median_frame_by_either_clock() {
        let mut table = example(&[10], &Kernel::ALL);
        assert_eq!(table.clock(), Clock::Gpu);
        assert_eq!(table.speeds(Kernel::Course, Clock::Gpu).get(SolidKind::Sphere, 10), Some(100.0));
        assert_eq!(table.speeds(Kernel::Whitted, Clock::Gpu).get(SolidKind::Sphere, 10), Some(200.0));
        let wall = table.speeds(Kernel::Course, Clock::Wall).get(SolidKind::Sphere, 10);
        assert_eq!(wall, Some(1e9 / 10_050_000.0));
        table.plan.in_window = true;
        assert_eq!(table.clock(), Clock::Wall);
        table.plan.in_window = false;
        table.cells[3].gpu_samples_ns = None;
        assert_eq!(table.clock(), Clock::Wall);
    }

    #[test]
    fn outliers_are_told_by_cell() {
        let mut table = example(&[10], &[Kernel::Course]);
        assert_eq!(table.outliers(), Vec::<String>::new());
        table.cells[1].gpu_samples_ns = Some(vec![1_000_000, 1_000_000, 9_000_000, 1_000_000, 1_000_000]);
        let [line] = &table.outliers()[..] else { panic!("one cell has outliers") };
        assert_eq!(line, "10 of the kind box, course kernel: 1 of 5 frames (median 1.000 ms, 1.000 to 9.000 ms)");
    }
}
