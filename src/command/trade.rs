//! `zerkalo trade SCENE…`: what accuracy costs on this device, and which setting is meant.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use anyhow::Result;
use clap::{Args, ValueEnum};

use super::interrupt::Listener;
use super::options::{Contradictory, parse_algorithm, parse_error, parse_size};
use super::{MeasuringArgs, parse_seconds, print_line, progress_bar, refuse_messages, report_files, scene_named};
use crate::algorithm::{Algorithm, Description};
use crate::gpu::Device;
use crate::measure::output::Document;
use crate::measure::trade::{
    self, Axes, Conditions, Counted, Question, SceneTrade, Step, Sweep, Trade, TruePicture, TruthError, measure,
    radiance, truth,
};
use crate::measure::{Budget, Machine};
use crate::reference::RenderError;
use crate::scene::Scene;
use crate::settings::{RenderSettings, SettingsError, Shading, three_digits};
use crate::tracer::{TracerError, limits_of};

/// Which picture is the true one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Target {
    /// Of the middles of the pixels
    Point,
    /// Of the pixels' areas: the reference's mean over 8x8 points in each
    Area,
    /// Of all light: path tracing, against which any algorithm can be measured; errors are then root mean squares
    Radiance,
}

/// Measure the price of accuracy: the time and the error of every setting on scenes, and which one is meant
///
/// Errors are the largest of a linear channel against the reference on the CPU, or by --target radiance root mean squares
/// against all light; times are of frames that take turns with the accurate kernel's. Ctrl-C keeps what is measured.
#[derive(Debug, Clone, Args)]
pub struct TradeArgs {
    /// Scene files or names of `zerkalo gallery`
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Which is the fastest setting whose error is at most E, such as 0.002 or 1/510? By --target radiance, the RMSE
    #[arg(long, value_name = "E", value_parser = parse_error)]
    pub error: Option<f64>,
    /// Which is the most accurate setting that draws N frames a second?
    #[arg(long, value_name = "N", value_parser = parse_fps)]
    pub fps: Option<f64>,
    /// Write the answer for one scene into a file that `render` and `view` take by --settings
    #[arg(long, value_name = "FILE")]
    pub save_settings: Option<PathBuf>,
    /// How much of the light model is drawn, by all algorithms but the course's
    #[arg(long, value_enum, default_value_t)]
    pub shading: Shading,
    /// The true picture
    #[arg(long, value_enum, default_value = "point")]
    pub target: Target,
    /// The largest error is of pixels off discontinuities: not beside one whose ray goes another way
    #[arg(long)]
    pub off_edges: bool,
    /// Samples a pixel of the true picture by --target radiance [default: 4096]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(64..=1 << 24))]
    pub truth_samples: Option<u32>,
    /// Only these algorithms; path tracing by --target radiance only [default: all]
    #[arg(long, alias = "kernel", value_name = "ALGORITHM,ALGORITHM", value_delimiter = ',',
          value_parser = parse_algorithm(Description::is_on_device))]
    pub algorithm: Vec<Algorithm>,
    /// Measure each setting so long, seconds [default: 1 s or 9 pairs of frames, whichever is first, but 2 pairs and
    /// 0.25 s at least]
    #[arg(long, value_name = "S", value_parser = parse_seconds)]
    pub seconds: Option<Duration>,
    /// Pixels, each side 1 to 16384
    #[arg(long, value_name = "WxH", default_value = "405x175", value_parser = parse_size)]
    pub size: (u32, u32),
    /// Where to write what was measured: a file (.json with every sample, .csv, .md; .png, .svg: its chart), or a
    /// folder for one of each, called trade; may be repeated
    #[arg(short, long, value_name = "DIR|FILE")]
    pub output: Vec<PathBuf>,
    #[command(flatten)]
    pub measuring: MeasuringArgs,
}

/// A question that no setting of the sweep answers.
#[derive(Debug, thiserror::Error)]
#[error("no setting of the sweep {what} on {scene:?}")]
pub struct Unanswered {
    what: String,
    scene: String,
}

/// Some seconds on a slow device, half a minute for a sweep.
const QUICK: Budget = Budget { time_ms: 1000, frames: 9, least_ms: 250 };

fn parse_fps(text: &str) -> Result<f64, String> {
    let fps = text.parse::<f64>().ok().filter(|fps| (1e-3..=1e6).contains(fps));
    fps.ok_or("it must be a number of frames a second, 0.001 to 1000000".to_owned())
}

pub fn run(args: &TradeArgs) -> Result<()> {
    if args.save_settings.is_some() && (questions(args).len() != 1 || args.scenes.len() != 1) {
        return Err(Contradictory("--save-settings is for one scene and one of --error and --fps").into());
    }
    check_target(args)?;
    let scenes: Vec<(&str, Scene)> = args
        .scenes
        .iter()
        .map(|name| Ok((name.as_str(), args.shading.applied(&scene_named(name)?).into_owned())))
        .collect::<Result<_>>()?;
    let outputs = report_files(&args.output, "trade")?;
    args.save_settings.iter().try_for_each(|path| RenderSettings::check_output_path(path))?;

    // From before the driver's threads compile anything until they are gone: a program that ends in their midst may
    // crash.
    let listener = Listener::start();
    let device = Device::open(args.measuring.device.device.as_deref(), args.measuring.validation.validation())?;
    let messages = device.messages().clone();
    let conditions = conditions(args);
    let mut trade = Trade { machine: Machine::of(device.description()), conditions, scenes: Vec::new() };
    let measured = scenes.iter().try_for_each(|(name, scene)| {
        let outcome = measure_scene(&mut trade, args, &device, name, scene, &listener);
        outputs.iter().try_for_each(|path| trade.save(path)).map_err(anyhow::Error::from).and(outcome)
    });
    drop(device);
    // Before anything is printed: nobody may be there to read it, and the file is wanted all the same.
    let wanted = args.save_settings.as_ref().filter(|_| measured.is_ok());
    let saved = wanted.map_or(Ok(()), |path| save_answer(&trade, path));
    if !trade.scenes.is_empty() {
        print_line(if args.measuring.json { trade.to_json() } else { trade.to_markdown() }.trim_end())?;
    }
    measured?;
    saved?;
    refuse_messages(&messages)?;
    unanswered(&trade).map_or(Ok(()), |unanswered| Err(unanswered.into()))
}

/// Enough that the truth is better than most pictures measured against it; seconds for a small one on a CPU.
const USUAL_TRUTH_SAMPLES: u32 = 4096;

/// # Errors
/// What is for another target.
fn check_target(args: &TradeArgs) -> Result<(), Contradictory> {
    let is_radiance = args.target == Target::Radiance;
    if is_radiance && args.off_edges {
        return Err(Contradictory("--off-edges is for the largest error: with --target radiance, the RMSE counts"));
    }
    if !is_radiance && args.truth_samples.is_some() {
        return Err(Contradictory("--truth-samples is for --target radiance"));
    }
    if !is_radiance && args.algorithm.iter().any(|algorithm| algorithm.description().is_statistical) {
        return Err(Contradictory(
            "path tracing draws more light than the reference: it is measured against all light, by --target radiance",
        ));
    }
    Ok(())
}

fn target(args: &TradeArgs) -> trade::Target {
    match args.target {
        Target::Point => trade::Target::Point,
        Target::Area => trade::Target::Area,
        Target::Radiance => {
            trade::Target::Radiance { truth_samples: args.truth_samples.unwrap_or(USUAL_TRUTH_SAMPLES) }
        }
    }
}

fn questions(args: &TradeArgs) -> Vec<Question> {
    args.error.map(Question::Error).into_iter().chain(args.fps.map(Question::Fps)).collect()
}

pub(super) fn conditions(args: &TradeArgs) -> Conditions {
    let (width, height) = args.size;
    Conditions {
        width,
        height,
        target: target(args),
        counted: match args.target {
            Target::Radiance => Counted::RootMeanSquare,
            Target::Point | Target::Area if args.off_edges => Counted::OffDiscontinuities,
            Target::Point | Target::Area => Counted::AllPixels,
        },
        budget: args.seconds.map_or(QUICK, Budget::lasting),
        validation: args.measuring.validation.is_on(),
        questions: questions(args),
    }
}

pub(super) fn axes(args: &TradeArgs) -> Axes {
    let asked: Vec<f64> = args.error.into_iter().collect();
    let full = Axes { shading: args.shading, ..Axes::full(target(args), &asked) };
    if args.algorithm.is_empty() { full } else { Axes { algorithms: args.algorithm.clone(), ..full } }
}

/// Adds a scene to what is measured.
fn measure_scene(
    trade: &mut Trade,
    args: &TradeArgs,
    device: &Arc<Device>,
    name: &str,
    scene: &Scene,
    listener: &Listener,
) -> Result<()> {
    let (width, height) = args.size;
    let sweep = Sweep::of(scene, &axes(args), &limits_of(device.description()), [width, height])?;
    let truth = match trade.conditions.target {
        trade::Target::Point | trade::Target::Area => {
            TruePicture::Reference(true_picture(&trade.conditions, name, scene, listener)?)
        }
        trade::Target::Radiance { truth_samples: samples } => {
            let bar = progress_bar(samples.into());
            bar.set_message(format!("{name}: all light, by path tracing"));
            let drawn = radiance(device, scene, args.shading, [width, height], samples, &mut |so_far| {
                bar.set_position(so_far.into());
                listener.keep_going()
            });
            bar.finish_and_clear();
            TruePicture::Radiance(drawn?)
        }
    };
    let bar = progress_bar(sweep.planned().count() as u64);
    trade.scenes.push(SceneTrade::new(name, scene, &sweep));
    let Trade { conditions, scenes, .. } = trade;
    // invariant: it was pushed just now.
    let measured = scenes.last_mut().expect("a scene");
    let outcome = measure(device, scene, &sweep, &truth, conditions, measured, &mut |step| {
        match step {
            Step::Setting { done, name: setting } => {
                bar.set_position(done as u64);
                bar.set_message(format!("{name}: {setting}"));
            }
            Step::Tile => bar.tick(),
        }
        listener.keep_going()
    });
    bar.finish_and_clear();
    Ok(outcome?)
}

fn true_picture(conditions: &Conditions, name: &str, scene: &Scene, listener: &Listener) -> Result<trade::Truth> {
    let bar = progress_bar(1000);
    bar.set_message(format!("{name}: the reference"));
    let start = Instant::now();
    let is_told = AtomicBool::new(false);
    let size = [conditions.width, conditions.height];
    let truth = truth(scene, size, conditions.target, &|share| {
        bar.set_position((1000.0 * share) as u64);
        let so_far = start.elapsed();
        let about = so_far.as_secs_f64() / share.max(1e-3);
        if so_far > Duration::from_secs(5) && about > 60.0 && !is_told.swap(true, Ordering::Relaxed) {
            let solids = scene.primitives.len();
            bar.suspend(|| {
                eprintln!(
                    "zerkalo: the reference of {name:?} takes about {} min, for its rays look at all {solids} solids on \
                     the CPU; a smaller --size takes less",
                    three_digits(about / 60.0)
                );
            });
        }
        listener.keep_going()
    });
    bar.finish_and_clear();
    truth.map_err(|error| match error {
        TruthError::Render(RenderError::Cancelled) => TracerError::Stopped.into(),
        error => error.into(),
    })
}

/// The one answer, with where it comes from.
fn save_answer(trade: &Trade, path: &std::path::Path) -> Result<(), SettingsError> {
    let Trade { machine, conditions, scenes } = trade;
    let (Some(scene), Some(&question)) = (scenes.first(), conditions.questions.first()) else { return Ok(()) };
    let Some(place) = scene.answer(question, conditions.counted) else { return Ok(()) };
    let asked = match question {
        Question::Error(error) if conditions.counted == Counted::RootMeanSquare => {
            format!(
                "The fastest setting within an RMSE of {error} to all light (of path tracing with a confidence of 95 %)"
            )
        }
        Question::Error(error) => format!("The fastest setting within an error of {error}"),
        Question::Fps(fps) => format!("The most accurate setting at {fps} frames a second"),
    };
    let comment = format!(
        "{asked} on {:?} at {}x{} pixels,\nmeasured by zerkalo trade on {} ({}), {}.",
        scene.scene, conditions.width, conditions.height, machine.device, machine.driver, machine.program
    );
    scene.points[place].setting.save(path, &comment)
}

fn unanswered(trade: &Trade) -> Option<Unanswered> {
    let Conditions { questions, counted, .. } = &trade.conditions;
    let pairs = trade.scenes.iter().flat_map(|scene| questions.iter().map(move |question| (scene, question)));
    let (scene, question) = pairs.into_iter().find(|(scene, question)| scene.answer(**question, *counted).is_none())?;
    let what = match question {
        Question::Error(error) => format!("keeps an error of {}", three_digits(*error)),
        Question::Fps(fps) => format!("draws {} frames a second", three_digits(*fps)),
    };
    Some(Unanswered { what, scene: scene.scene.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_a_second_are_within_their_limits() {
        assert_eq!(parse_fps("60"), Ok(60.0));
        assert!(["0", "-1", "nan", "inf", "1e9", "x", ""].iter().all(|bad| parse_fps(bad).is_err()));
    }
}
