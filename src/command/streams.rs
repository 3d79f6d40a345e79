//! `-` in place of a file's name: scenes from standard input, pictures to standard output.

use std::io::{self, IsTerminal, Write};

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

use super::options::Contradictory;
use crate::frame::{FileFormat, Frame};
use crate::scene::{Scene, SceneError};

/// In place of a file's name.
pub const STREAM: &str = "-";

/// What a stream has no name's ending for.
#[derive(Debug, Clone, Copy, Args)]
pub struct StreamArgs {
    /// What a scene from standard input, `-`, is written in [default: toml]
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Option<SceneFormat>,
    /// What a picture to standard output, `-o -`, is written in [default: png]
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub output_format: Option<PictureFormat>,
}

impl StreamArgs {
    /// # Errors
    /// A format is given of what is no stream: the file's name says it.
    pub fn check(&self, is_from_stream: bool, is_into_stream: bool) -> Result<()> {
        if self.format.is_some() && !is_from_stream {
            return Err(Contradictory("--format is for a scene from standard input, -").into());
        }
        if self.output_format.is_some() && !is_into_stream {
            return Err(Contradictory("--output-format is for a picture to standard output, -o -").into());
        }
        Ok(())
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum SceneFormat {
    #[default]
    Toml,
    Json,
    Zscene,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum PictureFormat {
    /// Display values
    #[default]
    Png,
    /// Linear values
    Exr,
}

impl SceneFormat {
    /// # Errors
    /// Standard input has no scene of this format.
    pub fn read_scene(self) -> Result<Scene, SceneError> {
        let extension = match self {
            Self::Toml => "toml",
            Self::Json => "json",
            Self::Zscene => "zscene",
        };
        Scene::from_reader(&mut io::stdin().lock(), extension).map_err(|mut error| {
            error.path = Some("standard input".into());
            error
        })
    }
}

impl PictureFormat {
    /// # Errors
    /// Standard output is a terminal, which shows no picture.
    pub fn check_output() -> Result<()> {
        if io::stdout().is_terminal() {
            return Err(Contradictory("-o -: standard output is a terminal; it must be a pipe or a file").into());
        }
        Ok(())
    }

    /// # Errors
    /// There is no room for it, or nobody who reads it.
    pub fn write(self, frame: &Frame) -> Result<()> {
        let bytes = frame.encode(match self {
            Self::Png => FileFormat::Png,
            Self::Exr => FileFormat::Exr,
        })?;
        let mut output = io::stdout().lock();
        output.write_all(&bytes).and_then(|()| output.flush()).context("could not write to standard output")
    }
}
