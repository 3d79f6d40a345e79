//! What was measured, in files: each is written whole or not at all.

use serde::Serialize;
use serde_json::json;

use super::chart::chart;
use super::figures::{Answer, Figures, answers, figures};
use super::tables::blocks;
use super::{Conditions, SceneTrade, Trade};
use crate::measure::Machine;
use crate::measure::output::chart::Chart;
use crate::measure::output::{Document, Table};

/// What the JSON says it is.
const FORMAT: &str = "zerkalo-trade-2";

/// Columns of CSV.
const COLUMNS: &str = "scene,setting=name,kernel=setting/kernel,precision=setting/precision,error=setting/error,\
    max_depth=setting/max_depth,boxes=setting/boxes,samples=setting/samples,scale=setting/scale,\
    time_ns,first_quartile_ns=quartiles_ns/0,third_quartile_ns=quartiles_ns/1,of_baseline=ratio,pairs=samples_ns,\
    frames_per_second,counted_error,max_abs=error/max_abs,\
    max_abs_off_discontinuities=error/max_abs_off_discontinuities,rmse=error/rmse,psnr_db=error/psnr_db,\
    flip_mean=error/flip_mean,non_finite_pixels=error/non_finite_pixels,\
    discontinuity_pixels=error/discontinuity_pixels,\
    differing_discontinuity_pixels=error/differing_discontinuity_pixels,pixels=error/pixels,bound,on_front=is_on_front,\
    width,height,target,device,driver,program,validation";

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

    /// A row a setting on a scene; the machine stands in every row.
    fn records(&self) -> Table {
        let Self { machine, conditions, scenes } = self;
        let records = scenes.iter().flat_map(|scene| {
            let points = scene.points.iter().zip(figures(scene, conditions));
            points.map(move |(point, figures)| (json!({ "scene": scene.scene }), point, figures, conditions, machine))
        });
        Table::of_records(COLUMNS, records)
    }

    fn blocks(&self) -> Vec<String> {
        blocks(self)
    }

    fn chart(&self) -> Option<Chart> {
        Some(chart(self))
    }
}

#[cfg(test)]
mod tests {
    use super::super::example::example;
    use super::*;

    #[test]
    fn csv_has_a_line_a_setting_with_all_that_is_known_of_it() {
        let text = example().records().to_csv();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 5);
        assert_eq!(
            lines[3],
            "room,\"whitted f32, error 0.00392\",whitted,f32,0.00392156862745098,,true,1,1,5000000,4750000,5250000,0.5,3,\
             200,0.001,0.001,0.0001,0.00025,72.04119982655925,0.01,0,200,10,11200,0.003,true,160,70,point,a device,\
             driver 1,z 1,false"
        );
        assert!(lines[4].starts_with("room,\"whitted f32, 2 generations\",whitted,f32,0,2,true"), "{text}");
    }
}
