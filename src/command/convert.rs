//! `zerkalo convert SCENE OUT`: a scene in another kind of file.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::{ReadingArgs, print_line};

/// Write a scene as a file of another kind: .toml for people, .json for programs, .zscene for a million solids
#[derive(Debug, Clone, Args)]
pub struct ConvertArgs {
    /// A scene file (.toml, .json, .zscene, .nff) or a name of `zerkalo gallery`
    pub scene: String,
    /// The file to write: .toml, .json or .zscene
    #[arg(value_name = "OUT")]
    pub output: PathBuf,
    #[command(flatten)]
    pub reading: ReadingArgs,
}

pub fn run(args: &ConvertArgs) -> Result<()> {
    let scene = args.reading.read(&args.scene)?.scene;
    scene.save(&args.output)?;
    let output = args.output.display().to_string();
    print_line(&format!("wrote {} ({} primitives)", output.escape_debug(), scene.primitives.len()))
}
