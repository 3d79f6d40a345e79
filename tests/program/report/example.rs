//! A report of tiny pictures that are drawn here, and of figures that are made up.

use std::ops::ControlFlow;
use std::time::Duration;

use zerkalo::algorithm::Algorithm;
use zerkalo::gpu::{Check, Layer, Messages, SetUpBy, Severity, Validation, tried_devices};
use zerkalo::measure::algorithms::{self, Comparison};
use zerkalo::measure::fps_table::{Cell, FpsTable, Plan};
use zerkalo::measure::stability::Row;
use zerkalo::measure::trade::{
    Axes, Conditions, Counted, Question, SceneTrade, Sweep, Target, Trade, TruePicture, measure, truth,
};
use zerkalo::measure::{Budget, Machine, scene_maps};
use zerkalo::report::{Ending, NamedMaps, Report, Section, Stability};
use zerkalo::scene::gallery;
use zerkalo::settings::Shading;
use zerkalo::tracer::limits_of;
use zerkalo::validation::{Group, Outcome, Pass, Remarked, Switch, TriedCheck};

use crate::common::TestDevice;

/// A name that would do harm if it was taken for a part of the page.
pub const DEVICE: &str = "A & B's <script>alert(1)</script> \"device\"";

const SIZE: [u32; 2] = [24, 10];

/// Long, as the layers' and the drivers' words are.
const DRIVER: &str =
    "Mesa 22.3.6 (LLVM 15.0.6), averyveryverylongwordwithoutasinglespaceasbuildsofdriversmayhaveintheirversions";

pub fn report() -> Report {
    let device = TestDevice::open();
    let machine = Machine {
        device: DEVICE.to_owned(),
        driver: DRIVER.to_owned(),
        program: "zerkalo 0.1.0".to_owned(),
        present_mode: None,
    };
    Report {
        begun: "2026-11-27T20:00:00Z".parse().unwrap(),
        is_quick: true,
        devices: complete("devices", tried_devices().unwrap()),
        maps: complete("render", vec![maps(&device, "start"), maps(&device, "showcase")]),
        validation: complete("validate", Some(validation())),
        stability: complete("stability", stability()),
        fps: complete("fps", fps(&machine)),
        algorithms: complete("algorithms", algorithms(&device, &machine)),
        trade: complete("trade", trade(&device, &machine)),
        machine,
    }
}

fn complete<T>(command: &str, content: T) -> Section<T> {
    let long = "--with-an-option=that-is-much-longer-than-a-telephone-is-wide-and-has-no-space-to-break-at";
    let commands = vec![format!("zerkalo {command} {long}")];
    Section { ending: Ending::Complete, time: Duration::from_millis(83_456), ..Section::new(commands, content) }
}

fn maps(device: &TestDevice, name: &str) -> NamedMaps {
    let mut scene = gallery::scene(name).unwrap();
    let lights = scene.lights.clone();
    // Two are too many for the course's kernel.
    scene.lights.extend(lights.into_iter().filter(|_| name == "showcase"));
    let truth = truth(&scene, SIZE, Target::Point, &|_| ControlFlow::Continue(())).unwrap();
    let maps = scene_maps(device, &scene, &truth, &mut || ControlFlow::Continue(())).unwrap();
    let drawn = maps.maps.iter().filter(|map| map.drawn.is_ok()).count();
    assert_eq!((maps.maps.len(), drawn), (4, if name == "start" { 4 } else { 3 }));
    NamedMaps { name: name.to_owned(), english: "a scene".to_owned(), russian: "сцена".to_owned(), maps }
}

fn validation() -> Outcome {
    let kind = "GPU-assisted";
    let checks = Check::of(Validation::All).iter();
    let messages = vec![Group {
        severity: Severity::Error,
        id: "VUID-<vkCmdDispatch>-None".to_owned(),
        count: 7,
        text: "the layer's text is long ".repeat(20),
        runs: ["a", "b", "c", "d"].map(str::to_owned).to_vec(),
    }];
    Outcome {
        device: DEVICE.to_owned(),
        driver: DRIVER.to_owned(),
        layer: Layer::named("a layer", [1, 3, 239], SetUpBy::ValidationFeatures),
        quick: true,
        width: 64,
        height: 28,
        complete: true,
        checks: checks.map(|&check| TriedCheck { validation: kind, check, works: check != Check::Core }).collect(),
        passes: [false, true].map(|in_window| Pass { validation: kind, in_window, runs: 9, begun: 9 }).to_vec(),
        no_window: Some("there is no display".to_owned()),
        switches: vec![Switch { name: "shadows", on: 5, off: 4 }],
        message_count: 7,
        messages,
        remarks: Messages::every_remark().into_iter().map(|remark| Remarked { count: 3, remark }).collect(),
    }
}

fn stability() -> Stability {
    let row = |id: &str, kernel, pass| Row {
        id: id.to_owned(),
        kernel,
        precision: Some("f32"),
        pass,
        what: "pixels brighter than all that shines, or not finite",
        measured: 12345.0,
        bound: 0.0,
    };
    let kernels = ["course", "plain", "whitted"];
    let rows = ["SC-1", "SC-2", "TR-1"].map(|id| kernels.map(|kernel| row(id, kernel, kernel == "whitted")));
    let sheet = zerkalo::measure::error_scale(1284, 240).unwrap();
    Stability { rows: rows.concat(), sheet: Some(sheet) }
}

fn fps(machine: &Machine) -> FpsTable {
    let plan = Plan { counts: vec![10, 50, 100], ..Plan::of_course() };
    let mut table = FpsTable::new(machine.clone(), plan);
    for (kind, count) in table.missing() {
        for algorithm in Algorithm::in_fps_table() {
            let times = if algorithm == Algorithm::Course { 1 } else { 2 };
            let time_ns = (count as u64 + kind as u64) * 1_000_000 / times;
            let samples_ns = [0, 1, 2].map(|more| time_ns + more * 50_000).to_vec();
            table.cells.push(Cell {
                kind,
                count,
                algorithm,
                gpu_samples_ns: Some(samples_ns.clone()),
                wall_samples_ns: samples_ns,
            });
        }
    }
    table
}

fn algorithms(device: &TestDevice, machine: &Machine) -> Comparison {
    let scene = gallery::scene("start").unwrap();
    let [width, height] = SIZE;
    let conditions = algorithms::Conditions { width, height, samples: vec![1, 4], seeds: 2, validation: true };
    let measured =
        algorithms::measure(device, "start", &scene, &conditions, &mut |_| ControlFlow::Continue(())).unwrap();
    Comparison { machine: machine.clone(), conditions, scenes: vec![measured] }
}

fn trade(device: &TestDevice, machine: &Machine) -> Trade {
    let scene = gallery::scene("start").unwrap();
    let axes = Axes {
        shading: Shading::Whitted,
        algorithms: vec![Algorithm::Plain, Algorithm::Course],
        errors: vec![0.1],
        generations: vec![1],
        samples: Vec::new(),
        path_samples: Vec::new(),
        scales: Vec::new(),
        target: Target::Point,
    };
    let [width, height] = SIZE;
    let conditions = Conditions {
        width,
        height,
        target: Target::Point,
        counted: Counted::AllPixels,
        budget: Budget::lasting(Duration::from_millis(1)),
        validation: true,
        questions: vec![Question::Error(0.5), Question::Fps(1e6)],
    };
    let sweep = Sweep::of(&scene, &axes, &limits_of(device.description()), SIZE).unwrap();
    let truth = truth(&scene, SIZE, Target::Point, &|_| ControlFlow::Continue(())).unwrap();
    let mut measured = SceneTrade::new("start", &scene, &sweep);
    let truth = TruePicture::Reference(truth);
    measure(device, &scene, &sweep, &truth, &conditions, &mut measured, &mut |_| ControlFlow::Continue(())).unwrap();
    Trade { machine: machine.clone(), conditions, scenes: vec![measured] }
}
