//! Pictures of all algorithms in turns, and what they are worth.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;

use super::{Conditions, Measured, SceneComparison};
use crate::algorithm::{Algorithm, Precision};
use crate::frame::Frame;
use crate::gpu::Device;
use crate::measure::{ErrorDomain, TimedTracer, image_error};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::tracer::{Progressive, Settings, TracerError, limits_of};

/// What is told while it is measured.
pub enum Step {
    /// So many pictures of all are done.
    Picture {
        /// Of all algorithms together.
        done: u32,
    },
    /// A part of one is.
    Part,
}

/// A picture, and what it took.
struct Drawn {
    pixels: Vec<DVec3>,
    time_ns: u64,
}

/// All pictures of an algorithm at a number of samples.
struct Series {
    algorithm: Algorithm,
    samples: u32,
    pictures: Vec<Drawn>,
}

/// Measures a scene.
///
/// # Errors
/// The device fails, an algorithm cannot draw the scene there, or `progress` stopped it.
pub fn measure(
    device: &Arc<Device>,
    name: &str,
    scene: &Scene,
    conditions: &Conditions,
    progress: &mut dyn FnMut(Step) -> ControlFlow<()>,
) -> Result<SceneComparison, TracerError> {
    let size = [conditions.width, conditions.height];
    let plan = |settings: &RenderSettings| {
        let plan = Plan::for_scene(scene, settings, size, &limits_of(device.description()));
        plan.map(|plan| Settings::planned(&plan)).map_err(|error| TracerError::Refused(error.to_string()))
    };
    let mut frames = Vec::new();
    for (algorithm, samples) in deterministic() {
        let settings =
            RenderSettings { algorithm, samples, precision: Some(Precision::F32), ..RenderSettings::DEFAULT };
        let mut tracer = TimedTracer::new(device, scene, &plan(&settings)?)?;
        // The first is the driver's warm-up.
        tracer.draw(&mut || progress(Step::Part))?;
        frames.push((tracer, Series { algorithm, samples, pictures: Vec::new() }));
    }
    let mut paths = Progressive::new(device, scene, &plan(&PATH)?)?;
    paths.add(1, &mut || progress(Step::Part))?;
    let of_samples = |&samples: &u32| Series { algorithm: Algorithm::Path, samples, pictures: Vec::new() };
    let mut at_samples: Vec<Series> = conditions.samples.iter().map(of_samples).collect();

    let mut done = 0;
    for seed in 0..conditions.seeds {
        for (tracer, series) in &mut frames {
            let time = tracer.draw(&mut || progress(Step::Part))?;
            let time_ns = time.gpu_time_ns.unwrap_or(time.wall_time.as_nanos() as u64);
            series.pictures.push(Drawn { pixels: pixels_of(&tracer.frame), time_ns });
            done += 1;
            stop_if_asked(progress(Step::Picture { done }))?;
        }
        paths.restart_by_seed(seed);
        let mut time_ns = 0;
        for series in &mut at_samples {
            let begun = Instant::now();
            let gpu_time_ns = paths.add(series.samples - paths.samples(), &mut || progress(Step::Part))?;
            time_ns += gpu_time_ns.unwrap_or(begun.elapsed().as_nanos() as u64);
            series.pictures.push(Drawn { pixels: paths.means().collect(), time_ns });
        }
        done += 1;
        stop_if_asked(progress(Step::Picture { done }))?;
    }
    let all: Vec<Series> = frames.into_iter().map(|(_, series)| series).chain(at_samples).collect();
    judge(name, scene, conditions, &all)
}

/// Samples that spare a pixel's colour most of what is due to edges alone.
const AREA_SAMPLES: u32 = 16;

/// What chance has no part in, by one sample a pixel and, where it has them, by several: path tracing's pixels are means
/// over their areas.
fn deterministic() -> impl Iterator<Item = (Algorithm, u32)> {
    let algorithms = Algorithm::in_table_1_1().filter(|algorithm| !algorithm.description().is_statistical);
    algorithms.flat_map(|algorithm| {
        let several = algorithm.description().samples.then_some((algorithm, AREA_SAMPLES));
        [(algorithm, 1)].into_iter().chain(several)
    })
}

/// Pictures that are counted while it is measured, for each seed.
pub fn pictures_of_a_seed() -> u32 {
    deterministic().count() as u32 + 1
}

/// One picture by path tracing.
const PATH: RenderSettings =
    RenderSettings { algorithm: Algorithm::Path, precision: Some(Precision::F32), ..RenderSettings::DEFAULT };

fn stop_if_asked(answer: ControlFlow<()>) -> Result<(), TracerError> {
    match answer {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(TracerError::Stopped),
    }
}

fn pixels_of(frame: &Frame) -> Vec<DVec3> {
    frame.pixels().iter().map(|pixel| DVec3::from_array(pixel.map(f64::from))).collect()
}

/// Mean of pictures but for one of them, if any.
fn mean_without(pictures: &[Drawn], left_out: Option<usize>) -> Vec<DVec3> {
    let counted = || pictures.iter().enumerate().filter(|(place, _)| Some(*place) != left_out);
    let count = counted().count() as f64;
    let mut mean = vec![DVec3::ZERO; pictures.first().map_or(0, |picture| picture.pixels.len())];
    for (_, picture) in counted() {
        mean.iter_mut().zip(&picture.pixels).for_each(|(mean, pixel)| *mean += *pixel / count);
    }
    mean
}

/// Standard deviation of a channel between pictures, root of the mean square over them; 0 of one.
fn spread(pictures: &[Drawn]) -> f64 {
    if pictures.len() < 2 {
        return 0.0;
    }
    let mean = mean_without(pictures, None);
    let squares: f64 = pictures
        .iter()
        .flat_map(|picture| picture.pixels.iter().zip(&mean).map(|(pixel, mean)| (*pixel - *mean).length_squared()))
        .sum();
    (squares / (3 * mean.len() * (pictures.len() - 1)) as f64).sqrt()
}

fn frame_of(conditions: &Conditions, pixels: &[DVec3]) -> Result<Frame, TracerError> {
    let mut frame = Frame::new(conditions.width, conditions.height)?;
    let narrow = |pixel: &DVec3| pixel.to_array().map(|channel| channel as f32);
    frame.pixels_mut().iter_mut().zip(pixels).for_each(|(to, from)| *to = narrow(from));
    Ok(frame)
}

fn judge(name: &str, scene: &Scene, conditions: &Conditions, all: &[Series]) -> Result<SceneComparison, TracerError> {
    // invariant: the command asks for a number of samples at least, and for two seeds.
    let best = all.last().map_or(&[][..], |series| &series.pictures[..]);
    let whole = frame_of(conditions, &mean_without(best, None))?;
    let without = (0..best.len())
        .map(|seed| frame_of(conditions, &mean_without(best, Some(seed))))
        .collect::<Result<Vec<_>, _>>()?;
    let mut measured = Vec::new();
    for Series { algorithm, samples, pictures } in all {
        let (mut squares, mut flip, mut largest) = (0.0, 0.0, 0.0_f64);
        for (seed, picture) in pictures.iter().enumerate() {
            let truth = if algorithm.description().is_statistical { &without[seed] } else { &whole };
            let picture = frame_of(conditions, &picture.pixels)?;
            let error = image_error(truth, &picture, ErrorDomain::Linear, None)
                .map_err(|error| TracerError::Refused(error.to_string()))?;
            squares += error.rmse.unwrap_or(f64::INFINITY).powi(2) / pictures.len() as f64;
            flip += error.flip_mean / pictures.len() as f64;
            largest = largest.max(error.max_abs.unwrap_or(f64::INFINITY));
        }
        measured.push(Measured {
            algorithm: *algorithm,
            samples: *samples,
            times_ns: pictures.iter().map(|picture| picture.time_ns).collect(),
            rmse: squares.sqrt(),
            flip,
            largest,
            noise: spread(pictures),
            picture: frame_of(conditions, pictures.first().map_or(&[][..], |picture| &picture.pixels[..]))?,
        });
    }
    let most = conditions.samples.last().copied().unwrap_or_default();
    Ok(SceneComparison {
        scene: name.to_owned(),
        solids: scene.primitives.len(),
        max_depth: scene.max_depth,
        truth_samples: u64::from(most) * u64::from(conditions.seeds),
        truth_standard_error: spread(best) / f64::from(conditions.seeds).sqrt(),
        measured,
        truth: whole,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pictures(values: &[f64]) -> Vec<Drawn> {
        values.iter().map(|&value| Drawn { pixels: vec![DVec3::splat(value); 4], time_ns: 1 }).collect()
    }

    #[test]
    fn a_seed_is_judged_by_the_others_and_equal_pictures_have_no_noise() {
        assert_eq!(mean_without(&pictures(&[1.0, 2.0, 6.0]), Some(2))[0], DVec3::splat(1.5));
        assert_eq!(spread(&pictures(&[0.5, 0.5, 0.5])), 0.0);
        // Of 1 and 3 the variance is 2.
        assert!((spread(&pictures(&[1.0, 3.0])) - 2.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(spread(&pictures(&[1.0])), 0.0);
    }
}
