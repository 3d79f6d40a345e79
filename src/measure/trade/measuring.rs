//! Settings on a device: their pictures against ground truth, their frames in pairs with the baseline's.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;

use super::{
    Conditions, Counted, EdgeError, LeftOut, PictureError, Planned, Point, SceneTrade, Sweep, TruePicture, contenders,
};
use crate::frame::Frame;
use crate::gpu::Device;
use crate::measure::{Budget, Clock, Difference, ErrorDomain, FrameTime, TimedTracer, image_error, rmse, tolerances};
use crate::plan::Precision;
use crate::scene::Scene;
use crate::tracer::{Settings, TracerError};

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
    truth: &TruePicture,
    conditions: &Conditions,
    trade: &mut SceneTrade,
    watch: &mut dyn FnMut(Step<'_>) -> ControlFlow<()>,
) -> Result<(), TracerError> {
    let mut bench = Bench::new(device, scene, truth, conditions, &sweep.baseline, &mut || watch(Step::Tile))?;
    trade.clock = bench.clock;
    if let TruePicture::Radiance(radiance) = truth {
        trade.truth_standard_error = Some(radiance.standard_error);
    }
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
    for (round, &question) in (1..).zip(&conditions.questions) {
        let places = contenders(question, &trade.candidates(conditions.counted));
        if places.len() > 1 {
            let done = sweep.planned().count();
            let _ = watch(Step::Setting { done, name: "the contenders once more" });
            let rivals: Vec<(usize, &Planned)> = places.into_iter().map(|place| (place, measured[place])).collect();
            bench.measure_again(&mut trade.points, &rivals, round * SEEDS_AT_ONCE, &mut || watch(Step::Tile))?;
        }
    }
    trade.complete = true;
    Ok(())
}

/// A scene on a device with its ground truth and its baseline, warm.
struct Bench<'a> {
    device: &'a Arc<Device>,
    scene: &'a Scene,
    truth: &'a TruePicture,
    conditions: &'a Conditions,
    baseline: TimedTracer,
    clock: Clock,
    /// Of path tracing, where that many samples took too long: more of them take longer.
    too_many_samples: Option<u32>,
}

/// What became of a setting.
enum Outcome {
    Measured(Point),
    LeftOut(LeftOut),
}

/// A setting whose first frame, compiling included, takes longer is left out; and than so many times the budget.
const PATIENCE: Duration = Duration::from_secs(20);
const PATIENCE_OF_BUDGET: u32 = 20;

/// Seeds for a setting's pictures whenever it is measured: each time it has others.
const SEEDS_AT_ONCE: u32 = 1 << 16;

/// Times of one tracer with the baseline.
#[derive(Default, Clone)]
struct Pairs {
    baseline_samples_ns: Vec<u64>,
    samples_ns: Vec<u64>,
    /// Of pictures by path tracing.
    rmse: Vec<f64>,
    /// Wall time of both.
    time: Duration,
}

impl<'a> Bench<'a> {
    /// # Errors
    /// The baseline cannot draw the scene on this device, the device fails, or `keep_going` breaks.
    fn new(
        device: &'a Arc<Device>,
        scene: &'a Scene,
        truth: &'a TruePicture,
        conditions: &'a Conditions,
        baseline: &Planned,
        keep_going: KeepGoing<'_>,
    ) -> Result<Self, TracerError> {
        let mut baseline = TimedTracer::new(device, scene, &baseline.settings)?;
        let clock = if baseline.draw(keep_going)?.gpu_time_ns.is_some() { Clock::Gpu } else { Clock::Wall };
        Ok(Self { device, scene, truth, conditions, baseline, clock, too_many_samples: None })
    }

    /// Draws a setting's picture once, which warms it up too, then pairs of frames until the budget is spent.
    ///
    /// # Errors
    /// The device fails, or `keep_going` breaks. What this setting alone cannot do leaves it out.
    fn measure(&mut self, planned: &Planned, keep_going: KeepGoing<'_>) -> Result<Outcome, TracerError> {
        let &Planned { setting, bound, .. } = planned;
        let budget = self.conditions.budget;
        let left_out = |reason: String| Ok(Outcome::LeftOut(LeftOut { setting, reason }));
        let patience = PATIENCE.max(Duration::from_millis(budget.time_ms) * PATIENCE_OF_BUDGET);
        let too_long = || format!("one frame takes longer than {} s", patience.as_secs_f64());
        if planned.path_samples().zip(self.too_many_samples).is_some_and(|(samples, too_many)| samples >= too_many) {
            return left_out(too_long());
        }
        let mut tracer = match self.tracer(planned, 0) {
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
                self.too_many_samples = planned.path_samples().or(self.too_many_samples);
                return left_out(too_long());
            }
            Err(error @ TracerError::LoopLimitReached { .. }) => return left_out(error.to_string()),
            first => first?,
        };
        let error = self.error_of(&tracer.frame);
        // One tracer, one list of pairs.
        let first_rmse = self.rmse_of(&tracer, planned);
        let mut tracers = [(tracer, planned)];
        let pairs = match self.pairs_of(&mut tracers, budget, keep_going) {
            // Paths of one seed may be longer than those of another.
            Err(error @ TracerError::LoopLimitReached { .. }) => return left_out(error.to_string()),
            pairs => pairs?.pop().unwrap_or_default(),
        };
        let Pairs { baseline_samples_ns, samples_ns, rmse, .. } = pairs;
        let rmse_of_pictures = first_rmse.into_iter().chain(rmse).collect();
        Ok(Outcome::Measured(Point { setting, bound, error, rmse_of_pictures, baseline_samples_ns, samples_ns }))
    }

    /// `first_seed`: of the pictures, where chance makes them.
    fn tracer(&self, planned: &Planned, first_seed: u32) -> Result<TimedTracer, TracerError> {
        let Planned { settings, .. } = planned;
        match planned.path_samples() {
            None => TimedTracer::new(self.device, self.scene, settings),
            Some(samples) => {
                let settings = Settings { seed: first_seed, ..settings.clone() };
                TimedTracer::of_paths(self.device, self.scene, &settings, samples)
            }
        }
    }

    /// Adds to points the times of pairs in which they take turns, twice as many as each had at first. Pictures of chance
    /// have seeds from `first_seed` on.
    ///
    /// # Errors
    /// The device fails, or `keep_going` breaks; then the points stay as they were.
    fn measure_again(
        &mut self,
        points: &mut [Point],
        contenders: &[(usize, &Planned)],
        first_seed: u32,
        keep_going: KeepGoing<'_>,
    ) -> Result<(), TracerError> {
        let Budget { time_ms, frames, least_ms } = self.conditions.budget;
        let budget = Budget { time_ms: 2 * time_ms, frames: 2 * frames, least_ms: 2 * least_ms };
        let mut tracers = Vec::new();
        for &(_, planned) in contenders {
            let mut tracer = self.tracer(planned, first_seed)?;
            tracer.draw(keep_going)?;
            tracers.push((tracer, planned));
        }
        let pairs = match self.pairs_of(&mut tracers, budget, keep_going) {
            // What was measured at first stands.
            Err(TracerError::LoopLimitReached { .. }) => return Ok(()),
            pairs => pairs?,
        };
        for (&(place, _), pairs) in contenders.iter().zip(pairs) {
            points[place].baseline_samples_ns.extend(pairs.baseline_samples_ns);
            points[place].samples_ns.extend(pairs.samples_ns);
            points[place].rmse_of_pictures.extend(pairs.rmse);
        }
        Ok(())
    }

    /// The tracer that is least far in its budget goes next; who is first of a pair alternates.
    fn pairs_of(
        &mut self,
        tracers: &mut [(TimedTracer, &Planned)],
        budget: Budget,
        keep_going: KeepGoing<'_>,
    ) -> Result<Vec<Pairs>, TracerError> {
        let mut all = vec![Pairs::default(); tracers.len()];
        let share_done = |pairs: &Pairs| budget.share_done(pairs.samples_ns.len(), pairs.time);
        loop {
            let next = (0..all.len()).min_by(|&a, &b| share_done(&all[a]).total_cmp(&share_done(&all[b])));
            let Some(next) = next.filter(|&next| share_done(&all[next]) < 1.0) else { return Ok(all) };
            let (pairs, (tracer, planned)) = (&mut all[next], &mut tracers[next]);
            let (baseline, ours) = if pairs.samples_ns.len().is_multiple_of(2) {
                let baseline = self.baseline.draw(keep_going)?;
                (baseline, tracer.draw(keep_going)?)
            } else {
                let ours = tracer.draw(keep_going)?;
                (self.baseline.draw(keep_going)?, ours)
            };
            pairs.baseline_samples_ns.push(self.time_ns(baseline));
            pairs.samples_ns.push(self.time_ns(ours));
            pairs.rmse.extend(self.rmse_of(tracer, planned));
            pairs.time += baseline.wall_time + ours.wall_time;
        }
    }

    fn time_ns(&self, FrameTime { gpu_time_ns, wall_time }: FrameTime) -> u64 {
        gpu_time_ns.filter(|_| self.clock == Clock::Gpu).unwrap_or(wall_time.as_nanos() as u64)
    }

    /// Of the picture that was drawn last, where chance made it and the RMSE counts.
    fn rmse_of(&self, tracer: &TimedTracer, planned: &Planned) -> Option<f64> {
        let is_wanted = planned.path_samples().is_some() && self.conditions.counted == Counted::RootMeanSquare;
        is_wanted.then(|| rmse(self.truth.frame(), &tracer.frame).unwrap_or(f64::INFINITY))
    }

    fn error_of(&self, frame: &Frame) -> PictureError {
        // invariant: ground truth and the frame are of one size, and no mask is empty.
        let image = image_error(self.truth.frame(), frame, ErrorDomain::Linear, None).expect("pictures of one size");
        let TruePicture::Reference(truth) = self.truth else { return PictureError { image, edges: None } };
        let colors: Vec<DVec3> = frame.pixels().iter().map(|pixel| DVec3::from_array(pixel.map(f64::from))).collect();
        let (tolerance, _) = tolerances(Precision::F32);
        let difference = Difference::between(&truth.image, &colors, tolerance, |_| true);
        let edges = EdgeError {
            max_abs_off_discontinuities: Some(difference.largest).filter(|largest| largest.is_finite()),
            discontinuity_pixels: difference.discontinuities,
            differing_discontinuity_pixels: difference.differing,
        };
        PictureError { image, edges: Some(edges) }
    }
}
