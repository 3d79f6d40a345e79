//! `zerkalo animate SCENE -o OUT`: the pictures of a scene that moves.

mod film;
mod painter;

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Result;
use clap::Args;
use serde::Serialize;

use self::film::{Film, Numbered, Target};
use self::painter::{Drawn, Painter};
use super::drawing::DrawingArgs;
use super::interrupt::Listener;
use super::options::{Contradictory, parse_positive};
use super::{
    DeviceArgs, ReadingArgs, ValidationArgs, print_json, print_line, progress_bar, refuse_messages, size_or_offered,
};
use crate::algorithm::{Algorithm, Precision};
use crate::gpu::Device;
use crate::measure::median;
use crate::scene::picture_at;
use crate::tracer::TracerError;

/// Pictures of one run, so that what is told of them fits in memory.
const MOST_PICTURES: u64 = 1_000_000;

/// Render the pictures of a scene that moves, each a file or all in one
///
/// What moves is in the scene's file, as [[animation]]; docs/scene-files.md tells how. A picture depends on its number
/// alone: several runs, on several machines too, may each draw some of them.
#[derive(Debug, Clone, Args)]
pub struct AnimateArgs {
    /// A scene file (.toml, .json, .zscene) or a name of `zerkalo gallery`
    pub scene: String,
    #[command(flatten)]
    pub reading: ReadingArgs,
    /// Files of their own, with the picture's number in place of %04d: frames/%04d.png or .exr; or one that has all:
    /// .apng, or by FFmpeg .mp4 or .webm
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Pictures a second
    #[arg(long, value_name = "N", default_value = "30", value_parser = parse_positive)]
    pub fps: f64,
    /// Only those from number A to number B, both too, or only number A [default: all, from 0 to the last keyframe]
    #[arg(long, value_name = "A..B", value_parser = parse_frames)]
    pub frames: Option<RangeInclusive<u64>>,
    /// Leave out pictures whose files are there and whole
    #[arg(long)]
    pub skip_existing: bool,
    /// FFmpeg's program, for .mp4 and .webm
    #[arg(long, value_name = "PROGRAM", default_value = "ffmpeg")]
    pub ffmpeg: PathBuf,
    #[command(flatten)]
    pub drawing: DrawingArgs,
    #[command(flatten)]
    pub device: DeviceArgs,
    #[command(flatten)]
    pub validation: ValidationArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// A picture that was drawn.
#[derive(Debug, Serialize)]
struct FrameReport {
    number: u64,
    /// From the animation's start.
    seconds: f64,
    /// Null where the device has no timestamps.
    gpu_time_ns: Option<u64>,
    /// From the scene before to this one's pixels, and until the one that writes them could take them.
    frame_time_ns: u64,
    /// What it was calculated in.
    precision: Precision,
    /// No linear channel is changed more by what was left out.
    error_bound: f64,
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report<'a> {
    width: u32,
    height: u32,
    fps: f64,
    #[serde(rename = "kernel")]
    algorithm: Algorithm,
    device: &'a str,
    driver: &'a str,
    /// That were there already.
    skipped: u64,
    frames: &'a [FrameReport],
    /// Median of the drawn; null without any, or without timestamps.
    gpu_time_ns: Option<u64>,
    /// Median of what the others take beyond it, without the first, which compiles; null without them.
    beyond_tracing_ns: Option<u64>,
    validation_messages: usize,
}

/// Ctrl-C ended it early.
#[derive(Debug, thiserror::Error)]
#[error("stopped after {drawn} of {all} pictures; {advice}")]
pub struct Stopped {
    drawn: usize,
    all: usize,
    advice: &'static str,
}

pub fn run(args: &AnimateArgs) -> Result<()> {
    let reading = args.reading.read(&args.scene)?;
    let size = size_or_offered(args.drawing.size, reading.size);
    let scene = reading.scene;
    let target = Target::of(&args.output)?;
    if args.skip_existing && !target.is_many() {
        return Err(Contradictory("--skip-existing is for files of their own, such as -o frames/%04d.png").into());
    }
    if scene.animation.is_empty() {
        let what = "nothing moves in the scene: it has no [[animation]]; `zerkalo render` draws it";
        return Err(Contradictory(what).into());
    }
    let numbers = numbers(scene.duration_seconds(), args)?;
    let setting = args.drawing.setting(DrawingArgs::USUAL_PATH_SAMPLES)?;
    if !setting.algorithm.description().is_on_device() {
        let what = format!("--algorithm {}: animations are drawn on a device", setting.algorithm.name());
        return Err(TracerError::Refused(what).into());
    }
    let (all, is_many) = (numbers.clone().count(), target.is_many());
    let missing: Vec<u64> = numbers.filter(|&number| !(args.skip_existing && target.has_whole(number, size))).collect();
    let skipped = all - missing.len();

    let listener = Listener::start();
    let device = Device::open(args.device.device.as_deref(), args.validation.validation())?;
    let (description, messages) = (device.description().clone(), device.messages().clone());
    let film = Film::begin(target, size, args.fps, missing.len(), &args.ffmpeg)?;
    let mut painter = Painter::new(&device, scene, setting, size);
    let mut reports = Vec::new();
    let bar = progress_bar(missing.len() as u64);
    let mut begun = Instant::now();
    let mut drawn_all = Ok(());
    for &number in &missing {
        let seconds = number as f64 / args.fps;
        let Drawn { frame, gpu_time_ns, precision, error_bound } = match painter.draw(seconds, &listener) {
            Ok(drawn) => drawn,
            Err(error) => {
                drawn_all = Err(error);
                break;
            }
        };
        if !film.take(Numbered { number, frame }) {
            break;
        }
        let frame_time_ns = begun.elapsed().as_nanos() as u64;
        reports.push(FrameReport { number, seconds, gpu_time_ns, frame_time_ns, precision, error_bound });
        begun = Instant::now();
        bar.inc(1);
    }
    bar.finish_and_clear();
    drop(painter);
    drop(device);
    // What was drawn is to be written, whatever ended the drawing; a film of parts is none.
    let written = film.end(drawn_all.is_ok());
    match drawn_all.err() {
        Some(error) if matches!(error.downcast_ref(), Some(TracerError::Stopped)) => {
            written?;
            let advice = if is_many {
                "to go on: the same with --skip-existing"
            } else {
                "one file has all or none; files of their own, frames/%04d.png, are kept"
            };
            return Err(Stopped { drawn: reports.len() + skipped, all, advice }.into());
        }
        Some(error) => return Err(error),
        None => written?,
    }
    let beyond = |report: &FrameReport| Some(report.frame_time_ns.saturating_sub(report.gpu_time_ns?));
    let beyond: Vec<u64> = reports.iter().skip(1).filter_map(beyond).collect();
    let tracing: Vec<u64> = reports.iter().filter_map(|report| report.gpu_time_ns).collect();
    let (gpu_time_ns, beyond_tracing_ns) = (median(&tracing), median(&beyond));
    if args.json {
        print_json(&Report {
            width: size[0],
            height: size[1],
            fps: args.fps,
            algorithm: setting.algorithm,
            device: &description.name,
            driver: &description.driver,
            skipped: skipped as u64,
            frames: &reports,
            gpu_time_ns,
            beyond_tracing_ns,
            validation_messages: messages.count(),
        })?;
    } else {
        let ms = |time: Option<u64>| time.map_or("?".to_owned(), |time| format!("{:.2}", time as f64 / 1e6));
        let were_there = if skipped > 0 { format!(", {skipped} were there") } else { String::new() };
        print_line(&format!(
            "wrote {} ({} pictures of {}x{}{were_there}, {}, {} ms GPU time a picture and {} ms beyond it, medians)",
            args.output.display().to_string().escape_debug(),
            reports.len(),
            size[0],
            size[1],
            description.name,
            ms(gpu_time_ns),
            ms(beyond_tracing_ns),
        ))?;
    }
    refuse_messages(&messages)
}

/// Of the pictures that are asked for.
fn numbers(duration_seconds: f64, args: &AnimateArgs) -> Result<RangeInclusive<u64>, TracerError> {
    let last = picture_at(duration_seconds, args.fps);
    let asked = args.frames.clone().unwrap_or(0..=last);
    let (first, end) = (*asked.start(), *asked.end());
    if end > last {
        return Err(TracerError::Refused(format!(
            "--frames {first}..{end}: the animation takes {duration_seconds} s, which are pictures 0 to {last} at {} a \
             second",
            args.fps
        )));
    }
    if end - first >= MOST_PICTURES {
        return Err(TracerError::Refused(format!(
            "{} pictures: a run draws at most {MOST_PICTURES}; --frames A..B takes a part of them",
            end - first + 1
        )));
    }
    Ok(asked)
}

/// Such as 7 or 0..119.
fn parse_frames(text: &str) -> Result<RangeInclusive<u64>, String> {
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    let number = |text: &str| text.parse::<u64>().ok();
    let range = number(first).zip(number(last)).filter(|(first, last)| first <= last);
    let (first, last) = range.ok_or("it must be one number or two, A..B, the second not smaller, such as 0..119")?;
    Ok(first..=last)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn frames_are_a_number_or_a_range_with_both_ends() {
        assert_eq!((parse_frames("7"), parse_frames("0..119")), (Ok(7..=7), Ok(0..=119)));
        assert!(
            ["", "..", "3..", "..3", "3..2", "-1", "1.5", "0..=3", "a"].iter().all(|bad| parse_frames(bad).is_err())
        );
    }

    #[test]
    fn targets_are_many_files_or_one() {
        assert!(Target::of(Path::new("a/%04d.png")).unwrap().is_many());
        assert!(!Target::of(Path::new("a.apng")).unwrap().is_many());
    }
}
