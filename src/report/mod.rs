//! All that can be measured of a device, on one page that needs nothing else. Pure: data in, HTML out.
//!
//! Every text is there in English and Russian, and the reader chooses, which takes no script.

mod algorithms;
mod devices;
mod fps;
mod maps;
mod page;
mod picture;
mod stability;
mod text;
mod trade;
mod validation;

use std::time::Duration;

use jiff::Timestamp;

use crate::frame::{Frame, FrameError};
use crate::gpu::TriedDevice;
use crate::measure::algorithms::Comparison;
use crate::measure::fps_table::FpsTable;
use crate::measure::output::OutputError;
use crate::measure::trade::Trade;
use crate::measure::{Machine, SceneMaps};
use crate::validation::Outcome;

/// What a page is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Where it was measured.
    pub machine: Machine,
    /// When measuring began.
    pub begun: Timestamp,
    /// Less of everything, for a slow device.
    pub is_quick: bool,
    /// Every device with what was found out by trying it.
    pub devices: Section<Vec<TriedDevice>>,
    /// Error maps of scenes of the gallery.
    pub maps: Section<Vec<NamedMaps>>,
    /// `None` before anything is drawn.
    pub validation: Section<Option<Outcome>>,
    /// Catalogue of extremes.
    pub stability: Section<Stability>,
    /// Table 4.1 of the course work.
    pub fps: Section<FpsTable>,
    /// Table 1.1 of the course work.
    pub algorithms: Section<Comparison>,
    /// Price of accuracy.
    pub trade: Section<Trade>,
}

/// A part of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct Section<T> {
    /// What repeats it, line by line.
    pub commands: Vec<String>,
    /// As much of it as there is.
    pub content: T,
    /// Whether all of it is there, and why not.
    pub ending: Ending,
    /// Wall time that it took.
    pub time: Duration,
}

/// How the measuring of a section ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ending {
    /// Nothing of it is measured.
    NotBegun,
    /// All of it is measured.
    Complete,
    /// By Ctrl-C.
    Stopped,
    /// Why, in a line.
    Failed(String),
}

impl<T> Section<T> {
    /// To be measured by what these commands do; `content`: nothing yet.
    pub fn new(commands: Vec<String>, content: T) -> Self {
        Self { commands, content, ending: Ending::NotBegun, time: Duration::ZERO }
    }
}

/// The error maps of a scene of the gallery.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedMaps {
    /// Name of the scene, as in the gallery.
    pub name: String,
    /// What the scene shows, in one line.
    pub english: String,
    /// The same in Russian.
    pub russian: String,
    /// Picture of the scene and its errors, one map a kernel.
    pub maps: SceneMaps,
}

/// The catalogue of extremes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Stability {
    /// One a case and kernel.
    pub rows: Vec<crate::measure::stability::Row>,
    /// The error maps worth looking at.
    pub sheet: Option<Frame>,
}

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A picture could not be encoded.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// A chart could not be drawn.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Report {
    /// The page, whole.
    ///
    /// # Errors
    /// A chart or a picture could not be drawn.
    pub fn to_html(&self) -> Result<String, ReportError> {
        Ok(page::page(self)?.into_string())
    }

    /// Whether every section is.
    pub fn is_complete(&self) -> bool {
        self.endings().into_iter().all(|ending| *ending == Ending::Complete)
    }

    /// In the page's order.
    pub fn endings(&self) -> [&Ending; 7] {
        let Self { machine: _, begun: _, is_quick: _, devices, maps, validation, stability, fps, algorithms, trade } =
            self;
        [
            &devices.ending,
            &maps.ending,
            &validation.ending,
            &stability.ending,
            &fps.ending,
            &algorithms.ending,
            &trade.ending,
        ]
    }
}
