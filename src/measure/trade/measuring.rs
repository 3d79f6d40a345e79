//! Settings on a device: their pictures against ground truth, their frames in pairs with the baseline's.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;

use super::{Conditions, LeftOut, PictureError, Planned, Point, SceneTrade, Sweep, Truth, contenders};
use crate::frame::Frame;
use crate::gpu::Device;
use crate::measure::{Budget, Clock, Difference, ErrorDomain, FrameTime, TimedTracer, image_error, tolerances};
use crate::plan::Precision;
use crate::scene::Scene;
use crate::tracer::TracerError;

/// Whether the work may go on, asked often.
type KeepGoing<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

/// What goes on while a scene is measured.
#[derive(Debug, Clone, Copy)]
pub enum Step<'a> {
    /// A part of a frame is drawn: a good moment to stop.
    Tile,
    /// The next setting begins.
    Setting {
        /// Number of settings measured before.
        done: usize,
        /// Name of the setting that is next, in words.
        name: &'a str,
    },
}

/// Measures a sweep on a scene, and once more those settings between which noise may have decided a question. Adds to
/// `trade` as it goes, so that what is measured is there after a failure or a stop.
///
/// # Errors
/// The baseline cannot draw the scene on this device, the device fails, or `watch` breaks.
pub fn measure(
    device: &Arc<Device>,
    scene: &Scene,
    sweep: &Sweep,
    truth: &Truth,
    conditions: &Conditions,
    trade: &mut SceneTrade,
    watch: &mut dyn FnMut(Step<'_>) -> ControlFlow<()>,
) -> Result<(), TracerError> {
    let mut bench = Bench::new(device, scene, truth, conditions.budget, &sweep.baseline, &mut || watch(Step::Tile))?;
    trade.clock = bench.clock;
    let mut measured: Vec<&Planned> = Vec::new();
    for (done, planned) in sweep.planned().enumerate() {
        // A stop is asked for at the next tile.
        let _ = watch(Step::Setting { done, name: &planned.setting.to_string() });
        match bench.measure(planned, &mut || watch(Step::Tile))? {
            Outcome::Measured(point) => {
                trade.points.push(point);
                measured.push(planned);
            }
            Outcome::LeftOut(left_out) => trade.left_out.push(left_out),
        }
    }
    for &question in &conditions.questions {
        let places = contenders(question, &trade.candidates(conditions.counted));
        if places.len() > 1 {
            let done = sweep.planned().count();
            let _ = watch(Step::Setting { done, name: "the contenders once more" });
            let rivals: Vec<(usize, &Planned)> = places.into_iter().map(|place| (place, measured[place])).collect();
            bench.measure_again(&mut trade.points, &rivals, &mut || watch(Step::Tile))?;
        }
    }
    trade.complete = true;
    Ok(())
}

/// A scene on a device with its ground truth and its baseline, warm.
struct Bench<'a> {
    device: &'a Arc<Device>,
    scene: &'a Scene,
    truth: &'a Truth,
    budget: Budget,
    baseline: TimedTracer,
    clock: Clock,
}

/// What became of a setting.
enum Outcome {
    Measured(Point),
    LeftOut(LeftOut),
}

/// A setting whose first frame, compiling included, takes longer is left out; and than so many times the budget.
const PATIENCE: Duration = Duration::from_secs(20);
const PATIENCE_OF_BUDGET: u32 = 20;

/// Times of one tracer with the baseline.
#[derive(Default, Clone)]
struct Pairs {
    baseline_samples_ns: Vec<u64>,
    samples_ns: Vec<u64>,
    /// Wall time of both.
    time: Duration,
}

impl<'a> Bench<'a> {
    /// # Errors
    /// The baseline cannot draw the scene on this device, the device fails, or `keep_going` breaks.
    fn new(
        device: &'a Arc<Device>,
        scene: &'a Scene,
        truth: &'a Truth,
        budget: Budget,
        baseline: &Planned,
        keep_going: KeepGoing<'_>,
    ) -> Result<Self, TracerError> {
        let mut baseline = TimedTracer::new(device, scene, &baseline.settings)?;
        let clock = if baseline.draw(keep_going)?.gpu_time_ns.is_some() { Clock::Gpu } else { Clock::Wall };
        Ok(Self { device, scene, truth, budget, baseline, clock })
    }

    /// Draws a setting's picture once, which warms it up too, then pairs of frames until the budget is spent.
    ///
    /// # Errors
    /// The device fails, or `keep_going` breaks. What this setting alone cannot do leaves it out.
    fn measure(&mut self, planned: &Planned, keep_going: KeepGoing<'_>) -> Result<Outcome, TracerError> {
        let &Planned { setting, bound, .. } = planned;
        let left_out = |reason: String| Ok(Outcome::LeftOut(LeftOut { setting, reason }));
        let patience = PATIENCE.max(Duration::from_millis(self.budget.time_ms) * PATIENCE_OF_BUDGET);
        let mut tracer = match TimedTracer::new(self.device, self.scene, &planned.settings) {
            Err(TracerError::Refused(reason)) => return left_out(reason),
            tracer => tracer?,
        };
        let start = Instant::now();
        let mut is_out_of_patience = false;
        let first = tracer.draw(&mut || {
            is_out_of_patience = start.elapsed() > patience;
            if is_out_of_patience { ControlFlow::Break(()) } else { keep_going() }
        });
        match first {
            Err(TracerError::Stopped) if is_out_of_patience => {
                return left_out(format!("one frame takes longer than {} s", patience.as_secs_f64()));
            }
            Err(error @ TracerError::LoopLimitReached { .. }) => return left_out(error.to_string()),
            first => first?,
        };
        let error = self.error_of(&tracer.frame);
        // One tracer, one list of pairs.
        let pairs = self.pairs_of(&mut [tracer], self.budget, keep_going)?.pop().unwrap_or_default();
        let Pairs { baseline_samples_ns, samples_ns, .. } = pairs;
        Ok(Outcome::Measured(Point { setting, bound, error, baseline_samples_ns, samples_ns }))
    }

    /// Adds to points the times of pairs in which they take turns, twice as many as each had at first.
    ///
    /// # Errors
    /// The device fails, or `keep_going` breaks; then the points stay as they were.
    fn measure_again(
        &mut self,
        points: &mut [Point],
        contenders: &[(usize, &Planned)],
        keep_going: KeepGoing<'_>,
    ) -> Result<(), TracerError> {
        let Budget { time_ms, frames, least_ms } = self.budget;
        let budget = Budget { time_ms: 2 * time_ms, frames: 2 * frames, least_ms: 2 * least_ms };
        let mut tracers = Vec::new();
        for (_, planned) in contenders {
            let mut tracer = TimedTracer::new(self.device, self.scene, &planned.settings)?;
            tracer.draw(keep_going)?;
            tracers.push(tracer);
        }
        let pairs = self.pairs_of(&mut tracers, budget, keep_going)?;
        for (&(place, _), pairs) in contenders.iter().zip(pairs) {
            points[place].baseline_samples_ns.extend(pairs.baseline_samples_ns);
            points[place].samples_ns.extend(pairs.samples_ns);
        }
        Ok(())
    }

    /// The tracer that is least far in its budget goes next; who is first of a pair alternates.
    fn pairs_of(
        &mut self,
        tracers: &mut [TimedTracer],
        budget: Budget,
        keep_going: KeepGoing<'_>,
    ) -> Result<Vec<Pairs>, TracerError> {
        let mut all = vec![Pairs::default(); tracers.len()];
        let share_done = |pairs: &Pairs| budget.share_done(pairs.samples_ns.len(), pairs.time);
        loop {
            let next = (0..all.len()).min_by(|&a, &b| share_done(&all[a]).total_cmp(&share_done(&all[b])));
            let Some(next) = next.filter(|&next| share_done(&all[next]) < 1.0) else { return Ok(all) };
            let (pairs, tracer) = (&mut all[next], &mut tracers[next]);
            let (baseline, ours) = if pairs.samples_ns.len().is_multiple_of(2) {
                let baseline = self.baseline.draw(keep_going)?;
                (baseline, tracer.draw(keep_going)?)
            } else {
                let ours = tracer.draw(keep_going)?;
                (self.baseline.draw(keep_going)?, ours)
            };
            pairs.baseline_samples_ns.push(self.time_ns(baseline));
            pairs.samples_ns.push(self.time_ns(ours));
            pairs.time += baseline.wall_time + ours.wall_time;
        }
    }

    fn time_ns(&self, FrameTime { gpu_time_ns, wall_time }: FrameTime) -> u64 {
        gpu_time_ns.filter(|_| self.clock == Clock::Gpu).unwrap_or(wall_time.as_nanos() as u64)
    }

    fn error_of(&self, frame: &Frame) -> PictureError {
        let Truth { image, frame: truth } = self.truth;
        // invariant: ground truth and the frame are of one size, and no mask is empty.
        let of_image = image_error(truth, frame, ErrorDomain::Linear, None).expect("pictures of one size");
        let colors: Vec<DVec3> = frame.pixels().iter().map(|pixel| DVec3::from_array(pixel.map(f64::from))).collect();
        let (tolerance, _) = tolerances(Precision::F32);
        let difference = Difference::between(image, &colors, tolerance, |_| true);
        PictureError {
            image: of_image,
            max_abs_off_discontinuities: Some(difference.largest).filter(|largest| largest.is_finite()),
            discontinuity_pixels: difference.discontinuities,
            differing_discontinuity_pixels: difference.differing,
        }
    }
}
