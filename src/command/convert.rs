//! `zerkalo convert SCENE OUT`: a scene in another kind of file.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::options::{Contradictory, parse_factor, parse_size};
use super::{ReadingArgs, print_line, size_or_offered};
use crate::scene::format::{Export, SceneFormat};

/// Write a scene as a file of another kind: .toml for people, .json for programs, .zscene for a million solids,
/// .pov for POV-Ray to draw
#[derive(Debug, Clone, Args)]
pub struct ConvertArgs {
    /// A scene file (.toml, .json, .zscene, .nff) or a name of `zerkalo gallery`
    pub scene: String,
    /// The file to write: .toml, .json, .zscene or .pov
    #[arg(value_name = "OUT")]
    pub output: PathBuf,
    #[command(flatten)]
    pub reading: ReadingArgs,
    #[command(flatten)]
    pub export: ExportArgs,
}

/// What a file for another program says besides the scene.
#[derive(Debug, Clone, Args)]
pub struct ExportArgs {
    /// Pixels of the picture that OUT, a .pov file, is for [default: what the scene's file says, else 1621x701]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Times every intensity in a .pov file [default: a power of two that surely keeps the picture below 1]
    #[arg(long, value_name = "E", value_parser = parse_factor)]
    pub exposure: Option<f64>,
    /// Times every length in a .pov file [default: a power of two that brings the largest coordinate to 1024 to 2048]
    #[arg(long, value_name = "S", value_parser = parse_factor)]
    pub length_scale: Option<f64>,
}

pub fn run(args: &ConvertArgs) -> Result<()> {
    let ExportArgs { size, exposure, length_scale } = args.export;
    let is_for_others = SceneFormat::of(&args.output).is_ok_and(|format| !format.is_read());
    if !is_for_others && (size.is_some() || exposure.is_some() || length_scale.is_some()) {
        return Err(Contradictory("--size, --exposure and --length-scale are for a .pov file").into());
    }
    let reading = args.reading.read(&args.scene)?;
    let (scene, size) = (reading.scene, size_or_offered(size, reading.size));
    let losses = scene.export(&args.output, &Export { size, exposure, length_scale })?;
    let output = args.output.display().to_string();
    for loss in losses {
        eprintln!("warning: {}: {loss}", output.escape_debug());
    }
    print_line(&format!("wrote {} ({} primitives)", output.escape_debug(), scene.primitives.len()))
}
