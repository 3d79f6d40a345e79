//! What was measured, in files: each is written whole or not at all.

use serde::Serialize;

use super::chart::chart;
use super::figures::{Answer, Figures, answers, figures};
use super::records::records;
use super::tables::blocks;
use super::{Conditions, SceneTrade, Trade};
use crate::measure::Machine;
use crate::measure::output::chart::Chart;
use crate::measure::output::{Document, Table};

/// What the JSON says it is.
const FORMAT: &str = "zerkalo-trade-1";

#[derive(Serialize)]
struct Data<'a> {
    format: &'static str,
    machine: &'a Machine,
    conditions: &'a Conditions,
    scenes: Vec<SceneData<'a>>,
}

/// What was measured, and what is calculated from it.
#[derive(Serialize)]
struct SceneData<'a> {
    #[serde(flatten)]
    scene: &'a SceneTrade,
    baseline_ns: Option<u64>,
    figures: Vec<Figures>,
    answers: Vec<Answer>,
}

impl Document for Trade {
    fn data(&self) -> impl Serialize {
        let of_scene = |scene| SceneData {
            scene,
            baseline_ns: scene.baseline_ns(),
            figures: figures(scene, &self.conditions),
            answers: answers(scene, &self.conditions),
        };
        Data {
            format: FORMAT,
            machine: &self.machine,
            conditions: &self.conditions,
            scenes: self.scenes.iter().map(of_scene).collect(),
        }
    }

    fn records(&self) -> Table {
        records(self)
    }

    fn blocks(&self) -> Vec<String> {
        blocks(self)
    }

    fn chart(&self) -> Chart {
        chart(self)
    }
}
