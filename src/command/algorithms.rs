//! `zerkalo algorithms`: table 1.1 of the course work, measured.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::interrupt::Listener;
use super::options::parse_size;
use super::{MeasuringArgs, print_line, progress_bar, refuse_messages, report_files, scene_named};
use crate::frame::Frame;
use crate::gpu::Device;
use crate::measure::Machine;
use crate::measure::algorithms::{Comparison, Conditions, Step, contact_sheet, measure, pictures_of_a_seed};
use crate::measure::output::Document;
use crate::scene::Scene;

/// Compare ray tracing, screen-space reflections and path tracing: time, error, noise
///
/// Table 1.1 of the course work, measured on this device: every algorithm draws the same light, and the truth is path
/// tracing by all samples together.
#[derive(Debug, Clone, Args)]
pub struct AlgorithmsArgs {
    /// Scene files (.toml, .json, .zscene, .nff) or names of `zerkalo gallery`
    #[arg(default_values = DEFAULT_SCENES)]
    pub scenes: Vec<String>,
    /// Pixels, each side 1 to 16384
    #[arg(long, value_name = "WxH", default_value = "162x70", value_parser = parse_size)]
    pub size: (u32, u32),
    /// Samples at which path tracing is looked at; 16 pictures by the most of them are the truth
    #[arg(long, value_name = "N,N", value_delimiter = ',', default_values_t = [1, 16, 256, 4096],
          value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub samples: Vec<u32>,
    /// Pictures of each algorithm, by seeds of their own
    #[arg(long, value_name = "N", default_value = "16", value_parser = clap::value_parser!(u32).range(2..=256))]
    pub seeds: u32,
    /// Where to write what was measured: a file (.json, .csv, .md; .png, .svg: its chart), or a folder for one of each,
    /// called algorithms, and for the pictures side by side; may be repeated
    #[arg(short, long, value_name = "DIR|FILE")]
    pub output: Vec<PathBuf>,
    #[command(flatten)]
    pub measuring: MeasuringArgs,
}

/// Interreflection, what a mirror shows that the camera does not see, mirrors, matt solids, glass.
const DEFAULT_SCENES: [&str; 6] = ["room", "behind", "corridor", "showcase", "matt", "glass"];

/// In a folder, beside the tables.
const SHEET: &str = "algorithms-pictures.png";

pub fn run(args: &AlgorithmsArgs) -> Result<()> {
    let scenes: Vec<(&str, Scene)> =
        args.scenes.iter().map(|name| Ok((name.as_str(), scene_named(name)?))).collect::<Result<_>>()?;
    let outputs = report_files(&args.output, "algorithms")?;
    let sheets: Vec<PathBuf> =
        args.output.iter().filter(|path| path.is_dir()).map(|folder| folder.join(SHEET)).collect();
    sheets.iter().try_for_each(|path| Frame::check_output_path(path))?;
    let listener = Listener::start();
    let device = Device::open(args.measuring.device.device.as_deref(), args.measuring.validation.validation())?;
    let messages = device.messages().clone();
    let machine = Machine::of(device.description());
    let mut comparison = Comparison { machine, conditions: conditions(args), scenes: Vec::new() };
    let measured = scenes.iter().try_for_each(|(name, scene)| -> Result<()> {
        let bar = progress_bar(u64::from(pictures_of_a_seed()) * u64::from(args.seeds));
        bar.set_message((*name).to_owned());
        let outcome = measure(&device, name, scene, &comparison.conditions, &mut |step| {
            match step {
                Step::Picture { done } => bar.set_position(done.into()),
                Step::Part => bar.tick(),
            }
            listener.keep_going()
        });
        bar.finish_and_clear();
        comparison.scenes.push(outcome?);
        outputs.iter().try_for_each(|path| comparison.save(path))?;
        let sheet = contact_sheet(&comparison)?;
        Ok(sheets.iter().try_for_each(|path| sheet.save(path))?)
    });
    drop(device);
    if !comparison.scenes.is_empty() {
        let told = if args.measuring.json { comparison.to_json() } else { comparison.to_markdown() };
        print_line(told.trim_end())?;
    }
    measured?;
    refuse_messages(&messages)
}

pub(super) fn conditions(args: &AlgorithmsArgs) -> Conditions {
    let mut samples = args.samples.clone();
    samples.sort_unstable();
    samples.dedup();
    let (width, height) = args.size;
    Conditions { width, height, samples, seeds: args.seeds, validation: args.measuring.validation.is_on() }
}
