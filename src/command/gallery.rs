//! `zerkalo gallery`: the scenes that come with the program.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use super::print_line;
use crate::scene::gallery;

/// List the ready scenes, or write them as files
#[derive(Debug, Clone, Args)]
pub struct GalleryArgs {
    /// Write every scene but those of N solids to DIR/NAME.toml
    #[arg(long, value_name = "DIR")]
    pub write: Option<PathBuf>,
}

pub fn run(args: &GalleryArgs) -> Result<()> {
    if let Some(folder) = &args.write {
        std::fs::create_dir_all(folder).with_context(|| format!("could not create folder {}", folder.display()))?;
        return Ok(gallery::write_all(folder)?);
    }
    let mut entries = gallery::entries().into_iter().chain(gallery::families());
    entries.try_for_each(|entry| print_line(&format!("{:16} {}", entry.name, entry.english)))
}
