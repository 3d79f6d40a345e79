//! What tables of measurements are written as.

pub mod chart;
mod table;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use thiserror::Error;

use crate::frame::FrameError;
use crate::whole_file::WholeFile;
use chart::Chart;
pub use table::{Entry, Table, Words, figure};

/// Why a table could not be written; each message is one line.
#[derive(Debug, Error)]
pub enum OutputError {
    #[error("unknown report format: {path:?} must end in .json, .csv, .md, .png or .svg, or be a folder")]
    UnknownFormat { path: PathBuf },
    #[error("there is no chart of this for {path:?}: its tables are for .json, .csv and .md")]
    NoChart { path: PathBuf },
    #[error("could not write {path:?}: {reason}")]
    Write { path: PathBuf, reason: String },
    #[error("could not draw the chart: {reason}")]
    Chart { reason: String },
    #[error(transparent)]
    Frame(#[from] FrameError),
}

impl OutputError {
    /// Whether what the caller named is at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        match self {
            Self::UnknownFormat { .. } | Self::NoChart { .. } => true,
            Self::Write { .. } | Self::Chart { .. } => false,
            Self::Frame(error) => error.is_input_error(),
        }
    }

    fn write(path: &Path, reason: impl ToString) -> Self {
        Self::Write { path: path.to_owned(), reason: reason.to_string() }
    }
}

/// What a file holds of a table; its name's extension decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReportFormat {
    /// Everything, every sample too; the one format that is read.
    Json,
    /// A line a cell.
    Csv,
    /// Tables for people.
    Markdown,
    /// The chart in pixels.
    Png,
    /// The chart in lines.
    Svg,
}

impl ReportFormat {
    pub const ALL: [Self; 5] = [Self::Json, Self::Csv, Self::Markdown, Self::Png, Self::Svg];

    pub fn extension(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Csv => "csv",
            Self::Markdown => "md",
            Self::Png => "png",
            Self::Svg => "svg",
        }
    }

    /// The format that the extension of `path` names, in capitals or not.
    pub fn of(path: &Path) -> Result<Self, OutputError> {
        let extension = path.extension().unwrap_or_default();
        let named = Self::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()));
        named.ok_or_else(|| OutputError::UnknownFormat { path: path.to_owned() })
    }

    pub fn is_chart(self) -> bool {
        matches!(self, Self::Png | Self::Svg)
    }
}

/// Measurements with all forms that they are written in.
pub trait Document {
    /// Everything, every sample too: what JSON has.
    fn data(&self) -> impl Serialize;

    /// A row a measurement, in which all stands that is known of it: what CSV has.
    fn records(&self) -> Table;

    /// Headings, lists, tables and paragraphs of Markdown, for people, also in a terminal.
    fn blocks(&self) -> Vec<String>;

    /// `None` where there is nothing that a chart could show.
    fn chart(&self) -> Option<Chart> {
        None
    }

    /// One object on one line.
    fn to_json(&self) -> String {
        // invariant: structures, lists, numbers and texts: JSON has them all.
        serde_json::to_string(&self.data()).expect("what was measured is JSON")
    }

    fn to_markdown(&self) -> String {
        self.blocks().join("\n\n") + "\n"
    }

    /// Writes what the name's extension asks for.
    fn save(&self, path: &Path) -> Result<(), OutputError> {
        let chart = || self.chart().ok_or_else(|| OutputError::NoChart { path: path.to_owned() });
        match ReportFormat::of(path)? {
            ReportFormat::Json => write_text(path, &(self.to_json() + "\n")),
            ReportFormat::Csv => write_text(path, &self.records().to_csv()),
            ReportFormat::Markdown => write_text(path, &self.to_markdown()),
            ReportFormat::Png => Ok(chart()?.to_frame()?.save(path)?),
            ReportFormat::Svg => write_text(path, &chart()?.to_svg()?),
        }
    }
}

/// Writes a file whole or not at all.
pub fn write_text(path: &Path, text: &str) -> Result<(), OutputError> {
    let write = || -> io::Result<()> {
        let mut file = WholeFile::create(path)?;
        file.as_file_mut().write_all(text.as_bytes())?;
        file.finish()
    };
    write().map_err(|error| OutputError::write(path, error))
}

/// Refuses at once what could not be written after a long measuring. Leaves nothing behind.
pub fn check_output_path(path: &Path) -> Result<(), OutputError> {
    ReportFormat::of(path)?;
    check_writable(path)
}

/// As [`check_output_path`], of what has no chart.
pub fn check_table_path(path: &Path) -> Result<(), OutputError> {
    match ReportFormat::of(path)?.is_chart() {
        true => Err(OutputError::NoChart { path: path.to_owned() }),
        false => check_writable(path),
    }
}

/// As [`check_output_path`], whatever the name.
pub fn check_writable(path: &Path) -> Result<(), OutputError> {
    WholeFile::create(path).map(drop).map_err(|error| OutputError::write(path, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_names_the_format() {
        for format in ReportFormat::ALL {
            assert_eq!(ReportFormat::of(Path::new(&format!("a/b.{}", format.extension()))).unwrap(), format);
        }
        assert_eq!(ReportFormat::of(Path::new("b.JSON")).unwrap(), ReportFormat::Json);
        for bad in ["a.txt", "a", ".md", ""] {
            assert!(ReportFormat::of(Path::new(bad)).is_err_and(|error| error.is_input_error()), "{bad}");
        }
    }
}
