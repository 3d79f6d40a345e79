//! What was measured, in files: each is written whole or not at all.

use std::path::Path;

use serde::Serialize;

use super::figures::{Answer, Figures, answers, figures};
use super::{Conditions, SceneTrade, Trade, chart, csv, markdown};
use crate::measure::Machine;
use crate::measure::output::{OutputError, ReportFormat, write_text};

/// What the JSON says it is.
const FORMAT: &str = "zerkalo-trade-1";

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    machine: &'a Machine,
    conditions: &'a Conditions,
    scenes: Vec<SceneDocument<'a>>,
}

/// What was measured, and what is calculated from it.
#[derive(Serialize)]
struct SceneDocument<'a> {
    #[serde(flatten)]
    scene: &'a SceneTrade,
    baseline_ns: Option<u64>,
    figures: Vec<Figures>,
    answers: Vec<Answer>,
}

impl Trade {
    /// One object on one line.
    pub fn to_json(&self) -> String {
        let of_scene = |scene| SceneDocument {
            scene,
            baseline_ns: scene.baseline_ns(),
            figures: figures(scene, &self.conditions),
            answers: answers(scene, &self.conditions),
        };
        let document = Document {
            format: FORMAT,
            machine: &self.machine,
            conditions: &self.conditions,
            scenes: self.scenes.iter().map(of_scene).collect(),
        };
        // invariant: structures, lists, numbers and texts, all of which JSON has.
        serde_json::to_string(&document).expect("what was measured is JSON")
    }

    /// Tables for people, also in a terminal.
    pub fn to_markdown(&self) -> String {
        markdown::of(self)
    }

    /// Writes what the name's extension asks for.
    pub fn save(&self, path: &Path) -> Result<(), OutputError> {
        match ReportFormat::of(path)? {
            ReportFormat::Json => write_text(path, &(self.to_json() + "\n")),
            ReportFormat::Csv => write_text(path, &csv::of(self)),
            ReportFormat::Markdown => write_text(path, &markdown::of(self)),
            ReportFormat::Png => Ok(chart::png(self)?.save(path)?),
            ReportFormat::Svg => write_text(path, &self.to_svg()?),
        }
    }

    /// The chart.
    pub fn to_svg(&self) -> Result<String, OutputError> {
        chart::svg(self)
    }
}
