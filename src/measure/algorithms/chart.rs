//! Time against error, both logarithmic: a panel a scene, in which path tracing is a line of its samples.

use plotters::style::RGBColor;

use super::{Comparison, Measured, SceneComparison};
use crate::measure::output::chart::{
    Axis, CIRCLE, Chart, DIAMOND, Line, Mark, Marker, Panel, SQUARE, Sample, Shape, Stroke, palette,
};
use crate::settings::three_digits;

const LINE: Stroke = Stroke { color: palette::BLUE, width: 2, dash: None };

/// Of every algorithm that is measured, in the order of their names.
const LOOKS: [(&str, Shape, RGBColor); 3] =
    [("path", CIRCLE, palette::BLUE), ("ssr", DIAMOND, palette::ORANGE), ("whitted", SQUARE, palette::VERMILION)];

fn marker(name: &str) -> Marker {
    let look = LOOKS.iter().find(|(of, ..)| *of == name).unwrap_or(&LOOKS[0]);
    Marker { shape: look.1, color: look.2, is_hollow: false }
}

pub fn chart(comparison: &Comparison) -> Chart {
    let Comparison { machine, conditions, scenes } = comparison;
    let sample = |&(name, ..): &(&str, Shape, RGBColor)| Sample {
        name: name.to_owned(),
        stroke: (name == "path").then_some(LINE),
        marker: marker(name),
    };
    Chart {
        title: "Table 1.1, measured: time against error · Таблица 1.1: время и ошибка",
        subtitle: machine.caption(&format!("{}x{}", conditions.width, conditions.height), conditions.validation),
        plot: [608, 366],
        rows: scenes.iter().map(|scene| vec![panel(scene)]).collect(),
        legend: LOOKS.iter().map(sample).collect(),
        remark: "error: RMSE to the truth · ошибка: СКО от истины",
    }
}

/// The slope of the logarithm of the noise over that of the samples, by least squares; `None` of fewer than two.
fn slope(paths: &[&Measured]) -> Option<f64> {
    let points: Vec<_> = paths.iter().map(|path| [f64::from(path.samples).ln(), path.noise.ln()]).collect();
    let n = points.len() as f64;
    let [x, y] = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / n);
    let across: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
    let both: f64 = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
    (points.len() > 1 && both.is_finite()).then(|| both / across)
}

fn panel(scene: &SceneComparison) -> Panel {
    let at = |measured: &Measured| Some([measured.time_ms()?, measured.rmse]);
    let marks: Vec<Mark> = (scene.measured.iter())
        .filter_map(|measured| {
            let is_statistical = measured.algorithm.description().is_statistical;
            Some(Mark {
                at: at(measured)?,
                quartiles: None,
                marker: marker(measured.algorithm.name()),
                is_ringed: false,
                label: (is_statistical || measured.samples > 1).then(|| measured.samples.to_string()),
            })
        })
        .collect();
    let paths: Vec<&Measured> =
        scene.measured.iter().filter(|measured| measured.algorithm.description().is_statistical).collect();
    let [times, errors] = [0, 1].map(|axis| marks.iter().map(|mark| mark.at[axis]).collect::<Vec<_>>());
    let mut list = vec!["ms · мс, RMSE · СКО, noise · шум".to_owned()];
    list.extend(scene.measured.iter().map(|measured| {
        let time = measured.time_ms().map_or("–".to_owned(), three_digits);
        let [rmse, noise] = [measured.rmse, measured.noise].map(three_digits);
        format!("{}: {time} ms, {rmse}, {noise}", measured.name())
    }));
    list.extend(slope(&paths).map(|slope| format!("slope of the noise · наклон шума: {slope:.2}")));
    Panel {
        title: format!("{}: {} solids, {} generations", scene.scene, scene.solids, scene.max_depth),
        x: Axis::of_decades("ms a picture · мс на изображение", &times),
        y: Axis::of_decades("RMSE to the truth · СКО от истины", &errors),
        lines: vec![Line { stroke: LINE, path: paths.iter().filter_map(|path| at(path)).collect() }],
        marks,
        list,
    }
}
