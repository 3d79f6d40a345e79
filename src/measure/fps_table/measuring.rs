use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::{Cell, Kernel, Plan};
use crate::frame::Frame;
use crate::gpu::Device;
use crate::scene::{SolidKind, gallery};
use crate::tracer::{Settings, Tracer, TracerError};

/// A kernel at work on one cell.
struct Run {
    kernel: Kernel,
    tracer: Tracer,
    frame: Frame,
    gpu_samples_ns: Option<Vec<u64>>,
    wall_samples_ns: Vec<u64>,
    time: Duration,
}

/// Measures all kernels of the plan on `count` solids of the kind, standing as in table 4.1. Their frames alternate, each
/// next one by the kernel that is least far in its budget, so that what else the machine does meets them alike. Every
/// kernel's first frame is left out: drivers compile, and caches fill.
///
/// `keep_going` is asked after every tile and can stop the work there; then there is no cell.
///
/// # Errors
/// There is no such grid in the gallery, the device fails, or `keep_going` breaks.
pub fn measure(
    device: &Arc<Device>,
    plan: &Plan,
    kind: SolidKind,
    count: usize,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Vec<Cell>, TracerError> {
    let name = format!("grid-{}-{count}", kind.name());
    let scene = gallery::scene(&name)
        .ok_or_else(|| TracerError::Refused(format!("the gallery has no scene '{name}' to measure")))?;
    let start = |&kernel: &Kernel| {
        let settings = Settings {
            kernel: kernel.of_tracer(),
            max_depth: Some(plan.generations),
            ..Settings::new(plan.width, plan.height)
        };
        Run::new(kernel, Tracer::new(device, &scene, &settings)?)
    };
    let mut runs: Vec<Run> = plan.kernels.iter().map(start).collect::<Result<_, _>>()?;
    for run in &mut runs {
        run.draw(keep_going)?;
    }
    let share_done = |run: &Run| plan.budget.share_done(run.wall_samples_ns.len(), run.time);
    while let Some(next) = runs.iter_mut().min_by(|a, b| share_done(a).total_cmp(&share_done(b))) {
        if share_done(next) >= 1.0 {
            break;
        }
        let (gpu_time_ns, wall_time) = next.draw(keep_going)?;
        next.note(gpu_time_ns, wall_time);
    }
    Ok(runs.into_iter().map(|run| run.cell(kind, count)).collect())
}

impl Run {
    fn new(kernel: Kernel, tracer: Tracer) -> Result<Self, TracerError> {
        Ok(Self {
            kernel,
            frame: tracer.frame()?,
            tracer,
            gpu_samples_ns: Some(Vec::new()),
            wall_samples_ns: Vec::new(),
            time: Duration::ZERO,
        })
    }

    /// The GPU time, where there is one, and the wall time of a frame.
    fn draw(
        &mut self,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<(Option<u64>, Duration), TracerError> {
        let start = Instant::now();
        let gpu_time_ns = self.tracer.render(&mut self.frame, &mut |_| keep_going())?;
        Ok((gpu_time_ns, start.elapsed()))
    }

    fn note(&mut self, gpu_time_ns: Option<u64>, wall_time: Duration) {
        match (&mut self.gpu_samples_ns, gpu_time_ns) {
            (Some(samples_ns), Some(time_ns)) => samples_ns.push(time_ns),
            (samples_ns, _) => *samples_ns = None,
        }
        self.wall_samples_ns.push(wall_time.as_nanos() as u64);
        self.time += wall_time;
    }

    fn cell(self, kind: SolidKind, count: usize) -> Cell {
        let Self { kernel, gpu_samples_ns, wall_samples_ns, .. } = self;
        Cell { kind, count, kernel, gpu_samples_ns, wall_samples_ns }
    }
}
