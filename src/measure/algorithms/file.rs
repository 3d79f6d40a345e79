//! What was measured, in files.

use serde::Serialize;

use super::chart::chart;
use super::ranks::{Rank, ranks};
use super::tables::blocks;
use super::{Comparison, Conditions, SceneComparison};
use crate::measure::Machine;
use crate::measure::output::chart::Chart;
use crate::measure::output::{Document, Table};

/// What the JSON says it is.
const FORMAT: &str = "zerkalo-algorithms-1";

/// Columns of CSV.
const COLUMNS: &str = "scene,solids,max_depth,algorithm,samples,time_ms,rmse,flip,largest,noise,truth_samples,\
    truth_standard_error,width,height,device,driver,program";

#[derive(Serialize)]
struct Data<'a> {
    format: &'static str,
    machine: &'a Machine,
    conditions: &'a Conditions,
    scenes: Vec<SceneData<'a>>,
}

#[derive(Serialize)]
struct SceneData<'a> {
    #[serde(flatten)]
    scene: &'a SceneComparison,
    /// The note's ranks with path tracing at each number of samples.
    ranks: Vec<RanksAt>,
}

#[derive(Serialize)]
struct RanksAt {
    path_samples: u32,
    ranks: Vec<Rank>,
}

#[derive(Serialize)]
struct Time {
    time_ms: Option<f64>,
}

impl Document for Comparison {
    fn data(&self) -> impl Serialize {
        let of_scene = |scene| SceneData {
            scene,
            ranks: (self.conditions.samples.iter())
                .map(|&samples| RanksAt { path_samples: samples, ranks: ranks(scene, samples) })
                .collect(),
        };
        Data {
            format: FORMAT,
            machine: &self.machine,
            conditions: &self.conditions,
            scenes: self.scenes.iter().map(of_scene).collect(),
        }
    }

    fn records(&self) -> Table {
        let rows = self.scenes.iter().flat_map(|scene| scene.measured.iter().map(move |measured| (scene, measured)));
        Table::of_records(
            COLUMNS,
            rows.map(|(scene, measured)| {
                (measured, Time { time_ms: measured.time_ms() }, scene, &self.conditions, &self.machine)
            }),
        )
    }

    fn blocks(&self) -> Vec<String> {
        blocks(self)
    }

    fn chart(&self) -> Option<Chart> {
        Some(chart(self))
    }
}
