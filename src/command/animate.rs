//! `zerkalo animate SCENE -o OUT`: the pictures of a scene that moves.

mod film;

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use anyhow::Result;
use clap::Args;
use serde::Serialize;

use self::film::{Film, Numbered, Target};
use super::drawing::DrawingArgs;
use super::interrupt::Listener;
use super::options::parse_positive;
use super::{
    DeviceArgs, ReadingArgs, ValidationArgs, print_json, print_line, progress_bar, refuse_messages, size_or_offered,
};
use crate::algorithm::{Algorithm, Precision};
use crate::frame::Frame;
use crate::gpu::Device;
use crate::measure::median;
use crate::plan::{Limits, Plan};
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::tracer::{Progressive, Settings, Tracer, TracerError, limits_of};

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
    #[serde(flatten)]
    precision: Drawn,
}

/// What a picture was drawn by.
#[derive(Debug, Clone, Copy, Serialize)]
struct Drawn {
    #[serde(rename = "precision")]
    choice: Precision,
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
        return Err(refused("--skip-existing is for files of their own, such as -o frames/%04d.png"));
    }
    if scene.animation.is_empty() {
        return Err(refused("nothing moves in the scene: it has no [[animation]]; `zerkalo render` draws it"));
    }
    let numbers = numbers(&scene, args)?;
    let setting = args.drawing.setting(DrawingArgs::USUAL_PATH_SAMPLES)?;
    if !setting.algorithm.description().is_on_device() {
        let what = format!("--algorithm {}: animations are drawn on a device", setting.algorithm.name());
        return Err(TracerError::Refused(what).into());
    }
    let all = numbers.clone().count();
    let missing: Vec<u64> = numbers.filter(|&number| !(args.skip_existing && target.has_whole(number, size))).collect();
    let skipped = all - missing.len();

    let listener = Listener::start();
    let device = Device::open(args.device.device.as_deref(), args.validation.validation())?;
    let (description, messages) = (device.description().clone(), device.messages().clone());
    let mut film = Film::begin(target, size, args.fps, missing.len(), &args.ffmpeg)?;
    let mut painter = Painter::new(&device, scene, setting, size);
    let mut reports = Vec::new();
    let bar = progress_bar(missing.len() as u64);
    let mut begun = Instant::now();
    let mut drawn_all = Ok(());
    for &number in &missing {
        let seconds = number as f64 / args.fps;
        let drawn = painter.draw(seconds, &listener);
        let (frame, gpu_time_ns, precision) = match drawn {
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
        reports.push(FrameReport { number, seconds, gpu_time_ns, frame_time_ns, precision });
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
            let advice = if Target::of(&args.output)?.is_many() {
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

fn refused(what: &str) -> anyhow::Error {
    TracerError::Refused(what.to_owned()).into()
}

/// Of the pictures that are asked for.
fn numbers(scene: &Scene, args: &AnimateArgs) -> Result<RangeInclusive<u64>> {
    // A time that is a whole number of pictures but for its rounding has that picture.
    let last = (scene.duration_seconds() * args.fps * (1.0 + 1e-12)).floor() as u64;
    match &args.frames {
        None => Ok(0..=last),
        Some(asked) if *asked.end() <= last => Ok(asked.clone()),
        Some(asked) => {
            let (first, end) = (asked.start(), asked.end());
            let what = format!(
                "--frames {first}..{end}: the animation takes {} s, which are pictures 0 to {last} at {} a second",
                scene.duration_seconds(),
                args.fps
            );
            Err(TracerError::Refused(what).into())
        }
    }
}

/// Draws a scene at one time after another: what is on the device is kept where it fits.
struct Painter<'d> {
    device: &'d Arc<Device>,
    scene: Scene,
    setting: RenderSettings,
    size: [u32; 2],
    limits: Limits,
    tracer: Option<AnyTracer>,
    warned: bool,
}

enum AnyTracer {
    Exact(Tracer),
    Statistical(Progressive),
}

impl<'d> Painter<'d> {
    fn new(device: &'d Arc<Device>, scene: Scene, setting: RenderSettings, size: [u32; 2]) -> Self {
        let limits = limits_of(device.description());
        Self { device, scene, setting, size, limits, tracer: None, warned: false }
    }

    fn draw(&mut self, seconds: f64, listener: &Listener) -> Result<(Frame, Option<u64>, Drawn)> {
        self.scene.go_to(seconds)?;
        let scene = self.setting.shading.applied(&self.scene);
        let plan = Plan::for_scene(&scene, &self.setting, self.size, &self.limits)?;
        if let Some(warning) = plan.warning().filter(|_| !self.warned) {
            eprintln!("warning: at {seconds} s: {warning}");
            self.warned = true;
        }
        let settings = Settings::planned(&plan);
        let drawn = Drawn { choice: settings.kernel.precision(), error_bound: plan.bounds.total() };
        let is_statistical = self.setting.algorithm.description().is_statistical;
        match &mut self.tracer {
            None if is_statistical => {
                self.tracer = Some(AnyTracer::Statistical(Progressive::new(self.device, &scene, &settings)?));
            }
            None => self.tracer = Some(AnyTracer::Exact(Tracer::new(self.device, &scene, &settings)?)),
            Some(AnyTracer::Exact(tracer)) => tracer.set_scene(&scene, &settings)?,
            Some(AnyTracer::Statistical(tracer)) => tracer.restart(&scene, &settings)?,
        }
        let (frame, gpu_time_ns) = match &mut self.tracer {
            Some(AnyTracer::Exact(tracer)) => {
                let mut frame = tracer.frame()?;
                let gpu_time_ns = tracer.render(&mut frame, &mut |_| listener.keep_going())?;
                (frame, gpu_time_ns)
            }
            Some(AnyTracer::Statistical(tracer)) => {
                let gpu_time_ns = tracer.add(self.setting.samples, &mut || listener.keep_going())?;
                (tracer.frame()?, gpu_time_ns)
            }
            None => return Err(TracerError::Stopped.into()),
        };
        Ok((frame, gpu_time_ns, drawn))
    }
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
    fn a_last_keyframe_on_a_picture_is_drawn_however_its_time_is_rounded() {
        let scene = |seconds: f64| {
            let text = format!(
                "[[animation]]\nfield = 'background'\nkeyframes = [{{ seconds = {seconds}, value = [0, 0, 0] }}]"
            );
            Scene::from_toml(&text).unwrap()
        };
        for n in 0..5000_u64 {
            let rounded = n as f64 * 0.01;
            let last = (scene(rounded).duration_seconds() * 100.0 * (1.0 + 1e-12)).floor() as u64;
            assert_eq!(last, n);
        }
    }

    #[test]
    fn targets_are_many_files_or_one() {
        assert!(Target::of(Path::new("a/%04d.png")).unwrap().is_many());
        assert!(!Target::of(Path::new("a.apng")).unwrap().is_many());
    }
}
