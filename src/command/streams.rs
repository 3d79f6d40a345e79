//! `-` in place of a file's name: scenes from standard input, pictures to standard output.

use std::io::{self, IsTerminal, Write};

use anyhow::{Context, Result};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use super::options::Contradictory;
use crate::frame::{FileFormat, Frame};
use crate::scene::SceneError;
use crate::scene::format::{FORMATS, Reading, SceneFormat};

/// In place of a file's name.
pub const STREAM: &str = "-";

/// In messages, in place of a file's name.
pub const STANDARD_INPUT: &str = "standard input";

/// What a stream has no name's ending for.
#[derive(Debug, Clone, Copy, Args)]
pub struct StreamArgs {
    /// What a scene from standard input, `-`, is written in [default: toml]
    #[arg(long, value_parser = format_parser(), value_name = "FORMAT")]
    pub format: Option<&'static SceneFormat>,
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
pub enum PictureFormat {
    /// Display values
    #[default]
    Png,
    /// Linear values
    Exr,
}

/// # Errors
/// Standard input has no scene of this format.
pub fn read_scene(format: &SceneFormat) -> Result<Reading, SceneError> {
    format.read_stream(&mut io::stdin().lock()).map_err(|mut error| {
        error.path = Some(STANDARD_INPUT.into());
        error
    })
}

/// By extensions.
fn format_parser() -> impl TypedValueParser<Value = &'static SceneFormat> {
    let values = FORMATS
        .iter()
        .filter(|format| format.is_read())
        .map(|format| PossibleValue::new(format.extension).help(format.about));
    PossibleValuesParser::new(values)
        .try_map(|extension| FORMATS.iter().find(|format| format.extension == extension).ok_or("no such format"))
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
