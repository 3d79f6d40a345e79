//! The sections: what each measures is what its command line says, read as any other.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::{Context, Result};
use clap::{Args, Parser};
use jiff::Timestamp;

use super::Progress;
use crate::command::algorithms::{self, AlgorithmsArgs};
use crate::command::fps::{FpsArgs, plan};
use crate::command::stability::{StabilityArgs, kernels};
use crate::command::trade::{TradeArgs, axes, conditions};
use crate::command::validate::{Next, ValidateArgs, validated};
use crate::command::{DeviceArgs, scene_named};
use crate::gpu::{self, Device, TriedDevice};
use crate::measure::algorithms::{self as compared, Comparison, pictures_of_a_seed};
use crate::measure::fps_table::{self, FpsTable, OffScreen};
use crate::measure::stability::{error_sheet, try_all};
use crate::measure::trade::{SceneTrade, Step, Sweep, Target, Trade, TruePicture, Truth, TruthError, measure, truth};
use crate::measure::{Machine, SceneMapsError, scene_maps};
use crate::reference::RenderError;
use crate::report::{NamedMaps, Report, Section, Stability};
use crate::scene::{Scene, SolidKind, gallery};
use crate::tracer::{TracerError, limits_of};
use crate::validation::Outcome;

/// The scenes of a quick report's trade, apart from each other: many mirrors, long paths, plain solids, many solids.
const QUICK_TRADE: [&str; 4] = ["showcase", "corridor", "several", "grid-sphere-100"];

/// Pixels of the gallery's pictures.
const QUICK_PICTURE: [u32; 2] = [203, 88];
const PICTURE: [u32; 2] = [405, 175];

/// What is measured.
pub struct Parts {
    is_quick: bool,
    device: DeviceArgs,
    validation: ValidateArgs,
    stability: StabilityArgs,
    fps: FpsArgs,
    algorithms: AlgorithmsArgs,
    trade: TradeArgs,
    lines: Lines,
}

struct Lines {
    validation: Line,
    stability: Line,
    fps: Line,
    algorithms: Line,
    trade: Line,
}

impl Parts {
    pub fn new(is_quick: bool, device: &DeviceArgs) -> Result<Self> {
        let line = |words: &str| Line::new(words, device);
        let scenes = if is_quick {
            QUICK_TRADE.join(" ")
        } else {
            gallery::entries().into_iter().map(|entry| entry.name).collect::<Vec<_>>().join(" ")
        };
        let lines = if is_quick {
            Lines {
                validation: line("validate --quick"),
                stability: line("stability --quick -o stability.png"),
                fps: line("fps --size 405x175 --counts 10,50,100 --seconds 0.25"),
                algorithms: line("algorithms room behind --size 122x53 --samples 1,16,64 --seeds 4"),
                trade: line(&format!("trade {scenes} --error 1/510 --size 203x88 --seconds 0.25")),
            }
        } else {
            Lines {
                validation: line("validate"),
                stability: line("stability --quick -o stability.png"),
                fps: line("fps"),
                algorithms: line("algorithms --samples 1,16,256"),
                trade: line(&format!("trade {scenes} --error 1/510")),
            }
        };
        Ok(Self {
            is_quick,
            device: device.clone(),
            validation: lines.validation.parse()?,
            stability: lines.stability.parse()?,
            fps: lines.fps.parse()?,
            algorithms: lines.algorithms.parse()?,
            trade: lines.trade.parse()?,
            lines,
        })
    }

    /// Nothing measured yet.
    pub fn report(&self, machine: Machine, begun: Timestamp) -> Report {
        let [width, height] = self.picture();
        let line = |words: &str| Line::new(words, &self.device).to_string();
        let picture = vec![
            "for SCENE of `zerkalo gallery`, and likewise for --algorithm plain, course and --precision f64:"
                .to_owned(),
            Line::new(
                &format!("render SCENE --size {width}x{height} --algorithm reference -o reference.exr"),
                &DeviceArgs::default(),
            )
            .to_string(),
            line(&format!("render SCENE --size {width}x{height} --algorithm whitted --precision f32 -o picture.exr")),
            "zerkalo compare reference.exr picture.exr".to_owned(),
        ];
        let fps = FpsTable::new(machine.clone(), plan(&self.fps, None));
        let algorithms = Comparison {
            machine: machine.clone(),
            conditions: algorithms::conditions(&self.algorithms),
            scenes: Vec::new(),
        };
        let trade = Trade { machine: machine.clone(), conditions: conditions(&self.trade), scenes: Vec::new() };
        Report {
            machine,
            begun,
            is_quick: self.is_quick,
            devices: Section::new(vec!["zerkalo devices".to_owned()], Vec::new()),
            maps: Section::new(picture, Vec::new()),
            validation: Section::new(vec![self.lines.validation.to_string()], None),
            stability: Section::new(vec![self.lines.stability.to_string()], Stability::default()),
            fps: Section::new(vec![self.lines.fps.to_string()], fps),
            algorithms: Section::new(vec![self.lines.algorithms.to_string()], algorithms),
            trade: Section::new(vec![self.lines.trade.to_string()], trade),
        }
    }

    fn picture(&self) -> [u32; 2] {
        if self.is_quick { QUICK_PICTURE } else { PICTURE }
    }

    /// Of the gallery; a quick report leaves out the grids that are like others of their kind.
    fn is_pictured(&self, entry: &gallery::Entry) -> bool {
        !self.is_quick || !entry.name.starts_with("grid-") || entry.name.ends_with("-100")
    }
}

/// A command line of this program.
struct Line {
    words: Vec<String>,
}

impl Line {
    /// On the device that was asked for, if any was.
    fn new(words: &str, device: &DeviceArgs) -> Self {
        let device = device.device.iter().map(|device| format!("--device={device}"));
        Self { words: words.split(' ').map(str::to_owned).chain(device).collect() }
    }

    /// The first word is the command itself.
    fn parse<A: Args>(&self) -> Result<A> {
        #[derive(Parser)]
        struct Command<A: Args> {
            #[command(flatten)]
            args: A,
        }
        let command: Command<A> =
            Command::try_parse_from(&self.words).with_context(|| format!("could not read `{self}`"))?;
        Ok(command.args)
    }
}

impl std::fmt::Display for Line {
    /// As a shell takes it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "zerkalo")?;
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_=.,/:".contains(c);
        self.words.iter().try_for_each(|word| match word.chars().all(is_plain) {
            true => write!(f, " {word}"),
            false => write!(f, " '{}'", word.replace('\'', r"'\''")),
        })
    }
}

pub fn devices(devices: &mut Vec<TriedDevice>) -> Result<()> {
    *devices = gpu::tried_devices()?;
    Ok(())
}

pub fn maps(maps: &mut Vec<NamedMaps>, parts: &Parts, device: &Arc<Device>, progress: &Progress) -> Result<()> {
    let entries: Vec<_> = gallery::entries().into_iter().filter(|entry| parts.is_pictured(entry)).collect();
    for (place, entry) in entries.iter().enumerate() {
        let share = place as f64 / entries.len() as f64;
        if progress.at(share, &entry.name).is_break() {
            return Err(TracerError::Stopped.into());
        }
        let scene = scene_named(&entry.name)?;
        let truth = true_picture(&scene, parts.picture(), Target::Point, &|_| progress.go_on())?;
        let drawn = scene_maps(device, &scene, &truth, &mut || progress.go_on()).map_err(|error| match error {
            SceneMapsError::Tracer(error) => anyhow::Error::from(error),
            error => error.into(),
        });
        let drawn = drawn.with_context(|| format!("scene {:?}", entry.name))?;
        let gallery::Entry { name, english, russian } = entry.clone();
        maps.push(NamedMaps { name, english, russian, maps: drawn });
    }
    Ok(())
}

pub fn validation(validation: &mut Option<Outcome>, parts: &Parts, progress: &Progress) -> Result<()> {
    let done = AtomicUsize::new(0);
    let (outcome, drawn) = validated(&parts.validation, &|next| match next {
        Some(Next { name, all }) => progress.at(done.fetch_add(1, Ordering::Relaxed) as f64 / all as f64, name),
        None => progress.go_on(),
    })?;
    *validation = Some(outcome);
    drawn
}

pub fn stability(stability: &mut Stability, parts: &Parts, device: &Arc<Device>, progress: &Progress) -> Result<()> {
    /// Share of the time that the catalogue takes; the rest is the sheet's.
    const CATALOGUE: f64 = 0.7;
    let args = &parts.stability;
    let kernels = kernels(args, device.description())?;
    try_all(device, &kernels, args.quick, &mut stability.rows, &mut |trials| {
        progress.at(CATALOGUE * trials.done as f64 / trials.all as f64, trials.id)
    })?;
    let sheet = error_sheet(device, &mut |done, all| {
        progress.at(CATALOGUE + (1.0 - CATALOGUE) * done as f64 / all as f64, "error maps")
    })?;
    stability.sheet = Some(sheet);
    Ok(())
}

pub fn fps(table: &mut FpsTable, device: &Arc<Device>, progress: &Progress) -> Result<()> {
    let missing = table.missing();
    let mut stage = OffScreen::new(device);
    // The more solids, the longer.
    let solids = |places: &[(SolidKind, usize)]| places.iter().map(|(_, count)| *count as f64).sum::<f64>();
    for (place, &(kind, count)) in missing.iter().enumerate() {
        let share = solids(&missing[..place]) / solids(&missing);
        if progress.at(share, &format!("{count} of the kind {}", kind.name())).is_break() {
            return Err(TracerError::Stopped.into());
        }
        table.put(fps_table::measure(&mut stage, &table.plan, kind, count, &mut || progress.go_on())?);
    }
    Ok(())
}

pub fn algorithms(comparison: &mut Comparison, parts: &Parts, device: &Arc<Device>, progress: &Progress) -> Result<()> {
    let names = &parts.algorithms.scenes;
    let pictures = f64::from(pictures_of_a_seed() * comparison.conditions.seeds);
    for (place, name) in names.iter().enumerate() {
        let scene = scene_named(name)?;
        let measured = compared::measure(device, name, &scene, &comparison.conditions, &mut |step| match step {
            compared::Step::Picture { done } => {
                progress.at((place as f64 + f64::from(done) / pictures) / names.len() as f64, name)
            }
            compared::Step::Part => progress.go_on(),
        })?;
        comparison.scenes.push(measured);
    }
    Ok(())
}

pub fn trade(trade: &mut Trade, parts: &Parts, device: &Arc<Device>, progress: &Progress) -> Result<()> {
    let names = &parts.trade.scenes;
    for (place, name) in names.iter().enumerate() {
        let at = |share: f64, what: &str| {
            progress.at((place as f64 + share) / names.len() as f64, &format!("{name}: {what}"))
        };
        let scene = scene_named(name)?;
        let Trade { conditions, scenes, .. } = &mut *trade;
        let size = [conditions.width, conditions.height];
        let sweep = Sweep::of(&scene, &axes(&parts.trade), &limits_of(device.description()), size)?;
        /// Share of a scene's time that the reference takes.
        const TRUTH: f64 = 0.1;
        let truth = true_picture(&scene, size, conditions.target, &|share| at(TRUTH * share, "the reference"))?;
        let truth = TruePicture::Reference(truth);
        scenes.push(SceneTrade::new(name, &scene, &sweep));
        // invariant: it was pushed just now.
        let measured = scenes.last_mut().expect("a scene");
        let all = sweep.planned().count() as f64;
        measure(device, &scene, &sweep, &truth, conditions, measured, &mut |step| match step {
            Step::Setting { done, name } => at(TRUTH + (1.0 - TRUTH) * (done as f64 / all).min(1.0), name),
            Step::Tile => progress.go_on(),
        })?;
    }
    Ok(())
}

/// `watch` hears of the share that is done, from any thread.
fn true_picture(
    scene: &Scene,
    size: [u32; 2],
    target: Target,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Truth> {
    truth(scene, size, target, watch).map_err(|error| match error {
        TruthError::Render(RenderError::Cancelled) => TracerError::Stopped.into(),
        error => error.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn command_lines_are_read_as_they_are_told() {
        for (is_quick, scenes) in [(true, QUICK_TRADE.len()), (false, gallery::entries().len())] {
            let parts = Parts::new(is_quick, &DeviceArgs { device: Some("it's -1".to_owned()) }).unwrap();
            assert_eq!(parts.trade.scenes.len(), scenes);
            assert!(parts.stability.quick);
            assert_eq!(parts.fps.measuring.device.device.as_deref(), Some("it's -1"));
            let told = parts.lines.fps.to_string();
            assert!(told.starts_with("zerkalo fps ") && told.ends_with(r" '--device=it'\''s -1'"), "{told}");
        }
    }
}
