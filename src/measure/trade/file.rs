//! What was measured, in files: each is written whole or not at all.

use serde::Serialize;

use super::figures::{Answer, Figures, answers, figures};
use super::{Conditions, SceneTrade, Trade, chart, csv, markdown};
use crate::frame::Frame;
use crate::measure::Machine;
use crate::measure::output::{OutputError, Table};

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

impl Table for Trade {
    fn to_json(&self) -> String {
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

    fn to_csv(&self) -> String {
        csv::of(self)
    }

    fn to_markdown(&self) -> String {
        markdown::of(self)
    }

    fn to_svg(&self) -> Result<String, OutputError> {
        chart::svg(self)
    }

    fn to_frame(&self) -> Result<Frame, OutputError> {
        chart::png(self)
    }
}
