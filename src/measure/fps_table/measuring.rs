use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Duration;

use super::{Cell, Plan, kernel_of};
use crate::algorithm::Algorithm;
use crate::gpu::{Device, DeviceDescription};
use crate::measure::{FrameTime, TimedTracer};
use crate::plan::Plan as RenderPlan;
use crate::scene::{Scene, SolidKind, gallery};
use crate::settings::RenderSettings;
use crate::tracer::{Settings, TracerError, limits_of};

/// Where the frames of a table are drawn.
pub trait Stage {
    /// From now on this scene is drawn, as the plan has it.
    fn set_scene(&mut self, scene: &Scene, plan: &Plan) -> Result<(), TracerError>;

    /// A frame by one of the plan's kernels. `keep_going` can stop the work.
    fn draw(
        &mut self,
        algorithm: Algorithm,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<FrameTime, TracerError>;
}

/// How an algorithm draws a cell's scene on a device: as `zerkalo render` does.
///
/// # Errors
/// The table is not measured with the algorithm, or the scene does not fit the device.
pub fn settings_of(
    algorithm: Algorithm,
    scene: &Scene,
    plan: &Plan,
    device: &DeviceDescription,
) -> Result<Settings, TracerError> {
    let settings = RenderSettings {
        algorithm,
        precision: Some(kernel_of(algorithm)?.precision()),
        max_depth: Some(plan.generations),
        ..RenderSettings::default()
    };
    let planned = RenderPlan::for_scene(scene, &settings, [plan.width, plan.height], &limits_of(device));
    Ok(Settings::planned(&planned.map_err(|error| TracerError::Refused(error.to_string()))?))
}

/// Error about an algorithm that is not in the plan.
pub fn no_scene(algorithm: Algorithm) -> TracerError {
    TracerError::Refused(format!("no scene for the {} algorithm", algorithm.name()))
}

/// Frames that go to the host's memory, and nothing is shown.
pub struct OffScreen {
    device: Arc<Device>,
    tracers: Vec<(Algorithm, TimedTracer)>,
}

impl OffScreen {
    pub fn new(device: &Arc<Device>) -> Self {
        Self { device: device.clone(), tracers: Vec::new() }
    }
}

impl Stage for OffScreen {
    fn set_scene(&mut self, scene: &Scene, plan: &Plan) -> Result<(), TracerError> {
        let tracer = |&algorithm: &Algorithm| {
            let settings = settings_of(algorithm, scene, plan, self.device.description())?;
            Ok((algorithm, TimedTracer::new(&self.device, scene, &settings)?))
        };
        // The last scene's pictures make room before.
        self.tracers.clear();
        self.tracers = plan.algorithms.iter().map(tracer).collect::<Result<_, TracerError>>()?;
        Ok(())
    }

    fn draw(
        &mut self,
        algorithm: Algorithm,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<FrameTime, TracerError> {
        let found = self.tracers.iter_mut().find(|(known, ..)| *known == algorithm);
        let (_, tracer) = found.ok_or_else(|| no_scene(algorithm))?;
        tracer.draw(keep_going)
    }
}

/// What a kernel has measured of one cell.
struct Run {
    algorithm: Algorithm,
    gpu_samples_ns: Option<Vec<u64>>,
    wall_samples_ns: Vec<u64>,
    time: Duration,
}

/// Measures all kernels of the plan on `count` solids of the kind, standing as in table 4.1. Their frames alternate,
/// each next one by the kernel that is least far in its budget, so that what else the machine does meets them alike.
/// Every kernel's first frame is left out: drivers compile, and caches fill.
///
/// `keep_going` is asked after every tile and can stop the work there; then there is no cell.
///
/// # Errors
/// There is no such grid in the gallery, the stage fails, or `keep_going` breaks.
pub fn measure(
    stage: &mut dyn Stage,
    plan: &Plan,
    kind: SolidKind,
    count: usize,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Vec<Cell>, TracerError> {
    let name = format!("grid-{}-{count}", kind.name());
    let scene = gallery::scene(&name)
        .ok_or_else(|| TracerError::Refused(format!("the gallery has no scene '{name}' to measure")))?;
    stage.set_scene(&scene, plan)?;
    let mut runs: Vec<Run> = plan.algorithms.iter().map(|&algorithm| Run::new(algorithm)).collect();
    for run in &runs {
        stage.draw(run.algorithm, keep_going)?;
    }
    let share_done = |run: &Run| plan.budget.share_done(run.wall_samples_ns.len(), run.time);
    while let Some(next) = runs.iter_mut().min_by(|a, b| share_done(a).total_cmp(&share_done(b))) {
        if share_done(next) >= 1.0 {
            break;
        }
        next.note(stage.draw(next.algorithm, keep_going)?);
    }
    Ok(runs.into_iter().map(|run| run.cell(kind, count)).collect())
}

impl Run {
    fn new(algorithm: Algorithm) -> Self {
        Self { algorithm, gpu_samples_ns: Some(Vec::new()), wall_samples_ns: Vec::new(), time: Duration::ZERO }
    }

    fn note(&mut self, FrameTime { gpu_time_ns, wall_time }: FrameTime) {
        match (&mut self.gpu_samples_ns, gpu_time_ns) {
            (Some(samples_ns), Some(time_ns)) => samples_ns.push(time_ns),
            (samples_ns, _) => *samples_ns = None,
        }
        self.wall_samples_ns.push(wall_time.as_nanos() as u64);
        self.time += wall_time;
    }

    fn cell(self, kind: SolidKind, count: usize) -> Cell {
        let Self { algorithm, gpu_samples_ns, wall_samples_ns, .. } = self;
        Cell { kind, count, algorithm, gpu_samples_ns, wall_samples_ns }
    }
}
