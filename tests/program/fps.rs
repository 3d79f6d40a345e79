//! `zerkalo fps` as a user meets it, on pictures so small that its figures are of no use.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use crate::place::{Place, Run, interrupted, names_in, wait_until};
use serde_json::Value;
use zerkalo::frame::Frame;

/// A place to measure in.
trait Measuring {
    fn fps_command(&self, arguments: &[&str]) -> Command;
    fn fps(&self, arguments: &[&str]) -> Run;
    fn fps_well(&self, arguments: &[&str]) -> String;
    fn read_json(&self, name: &str) -> Value;
    fn assert_fps_refused(&self, arguments: &[&str], code: i32, part: &str);
}

impl Measuring for Place {
    fn fps_command(&self, arguments: &[&str]) -> Command {
        self.command(&[&["fps"], arguments].concat())
    }

    fn fps(&self, arguments: &[&str]) -> Run {
        Run::of(self.fps_command(arguments).output().unwrap())
    }

    #[track_caller]
    fn fps_well(&self, arguments: &[&str]) -> String {
        let run = self.fps(arguments);
        assert_eq!(run.code, Some(0), "{arguments:?}: {run:?}");
        run.assert_tells_outliers_only();
        run.stdout
    }

    fn read_json(&self, name: &str) -> Value {
        serde_json::from_str(&fs::read_to_string(self.path(name)).unwrap()).unwrap()
    }

    #[track_caller]
    fn assert_fps_refused(&self, arguments: &[&str], code: i32, part: &str) {
        self.assert_refused(&[&["fps"], arguments].concat(), code, &[part]);
    }
}

impl Run {
    /// Other programs of the machine decide whether there are any.
    #[track_caller]
    fn assert_tells_outliers_only(&self) {
        let first = self.stderr.lines().next().unwrap_or_default();
        assert!(first.is_empty() || first.contains("interquartile"), "{}", self.stderr);
    }
}

const TINY: &[&str] = &["--size", "48x21", "--counts", "20,10", "--seconds", "0.02", "--validate"];

#[test]
fn every_place_is_measured_by_both_kernels_and_told_in_every_form() {
    let place = Place::new();
    let stdout = place.fps_well(&[TINY, &["-o", "out", "-o", "more.MD", "--json"]].concat());
    assert_eq!(stdout.lines().count(), 1, "one object on one line");
    let table: Value = serde_json::from_str(&stdout).unwrap();
    let keys: BTreeSet<_> = table.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys, "agreement cells clock complete figures format machine plan".split(' ').collect());
    assert_eq!((&table["plan"]["width"], &table["plan"]["height"]), (&48.into(), &21.into()));
    assert_eq!((&table["plan"]["generations"], &table["complete"]), (&20.into(), &true.into()));
    for key in ["device", "driver", "program"] {
        assert!(table["machine"][key].as_str().is_some_and(|text| !text.is_empty()), "{key}");
    }

    let cells = table["cells"].as_array().unwrap();
    let places: Vec<_> =
        cells.iter().map(|cell| format!("{} {} {}", cell["count"], cell["kind"], cell["kernel"])).collect();
    assert_eq!(places.len(), 2 * 4 * 2);
    assert_eq!(places.iter().collect::<BTreeSet<_>>().len(), places.len());
    assert_eq!(
        places[..2],
        ["10 \"sphere\" \"course\"", "10 \"sphere\" \"whitted\""],
        "kernels side by side, rows in turn"
    );
    for (cell, figures) in cells.iter().zip(table["figures"].as_array().unwrap()) {
        let wall: Vec<u64> = serde_json::from_value(cell["wall_samples_ns"].clone()).unwrap();
        assert!(wall.len() >= 2 && wall.iter().all(|&sample| sample > 0), "{cell}");
        assert_eq!(figures["wall"]["count"], wall.len());
        assert!(figures["wall"]["stddev_ns"].is_f64());
        if let Ok(gpu) = serde_json::from_value::<Vec<u64>>(cell["gpu_samples_ns"].clone()) {
            assert_eq!(gpu.len(), wall.len());
            let median = figures["gpu"]["median_ns"].as_u64().unwrap();
            // serde_json reads the nearest number or its neighbour.
            let expected = 1e9 / median as f64;
            assert!((figures["gpu_fps"].as_f64().unwrap() / expected - 1.0).abs() <= 2.0 * f64::EPSILON, "{figures}");
        }
    }

    assert_eq!(
        names_in(&place.path("out")),
        ["fps.csv", "fps.json", "fps.md", "fps.png", "fps.svg"].map(String::from).into()
    );
    assert_eq!(place.read_json("out/fps.json"), table);
    let markdown = fs::read_to_string(place.path("out/fps.md")).unwrap();
    assert!(markdown.contains(table["machine"]["device"].as_str().unwrap()) && markdown.contains("under validation"));
    assert_eq!(fs::read_to_string(place.path("more.MD")).unwrap(), markdown);
    assert_eq!(fs::read_to_string(place.path("out/fps.csv")).unwrap().lines().count(), 1 + cells.len());
    assert!(Frame::load(&place.path("out/fps.png")).is_ok());
    assert!(fs::read_to_string(place.path("out/fps.svg")).unwrap().contains("</svg>"));
}

#[test]
fn one_kernel_is_measured_alone_and_the_tables_are_printed() {
    let place = Place::new();
    let text = place.fps_well(&["--size", "16x7", "--counts", "10", "--algorithm", "whitted", "--seconds", "0.01"]);
    assert!(text.contains("## Whitted: frames a second") && !text.contains("## Course"), "{text}");
    assert!(text.contains("| 10 |") && text.contains("57.14"), "{text}");
    assert_eq!(place.names(), BTreeSet::new(), "nothing is written unasked");
}

#[test]
fn other_algorithms_have_their_tables_where_they_are_asked_for() {
    let place = Place::new();
    let sized = ["--size", "16x7", "--counts", "10", "--seconds", "0.01", "--algorithm", "ssr,path,ssr"];
    let text = place.fps_well(&[&sized[..], &["-o", "fps.json", "-o", "fps.svg"]].concat());
    for title in
        ["## Ssr: frames a second", "## Path: frames a second", "## Frames of the path kernel to one of the ssr"]
    {
        assert!(text.contains(title), "{title}: {text}");
    }
    assert!(!text.contains("## Whitted"), "{text}");
    let cells = place.read_json("fps.json")["cells"].as_array().unwrap().len();
    assert_eq!(cells, 2 * 4, "a cell of each kind by each of both");
    assert!(fs::read_to_string(place.path("fps.svg")).unwrap().contains("path kernel"));
}

#[test]
fn what_cannot_be_measured_or_written_is_refused() {
    let place = Place::new();
    for (arguments, part) in [
        (&["--size", "0x5"][..], "--size"),
        (&["--seconds", "0"], "--seconds"),
        (&["--seconds", "many"], "--seconds"),
        (&["--seconds", "1", "--full"], "--full"),
        (&["--counts", "10,15"], "--counts"),
        (&["--counts", "0"], "--counts"),
        (&["--algorithm", "reference"], "--algorithm"),
        (&["-o", "table.txt"], "table.txt"),
        (&["--resume", "none.json"], "none.json"),
        (&["--device", "nonsense"], "nonsense"),
        (&["four"], "four"),
    ] {
        place.assert_fps_refused(arguments, 2, part);
    }
    place.assert_fps_refused(&["-o", "nowhere/table.csv"], 1, "nowhere/table.csv");
    fs::write(place.path("file"), "").unwrap();
    place.assert_fps_refused(&["-o", "file/table"], 1, "file/table");
}

#[test]
fn a_table_is_gone_on_with_only_as_it_was_begun() {
    let place = Place::new();
    place.fps_well(&[
        "--size",
        "16x7",
        "--counts",
        "10",
        "--algorithm",
        "course",
        "--seconds",
        "0.01",
        "-o",
        "fps.json",
    ]);
    let whole = place.read_json("fps.json");
    for (arguments, part) in [
        (&["--size", "16x8"][..], "its height is 7, and here it is 8"),
        (&["--counts", "10,20"], "its counts is [10]"),
        (&["--algorithm", "whitted"], "its kernels is [\"course\"]"),
        (&["--full"], "its budget is"),
        (&["--validate"], "its validation is false"),
    ] {
        place.assert_fps_refused(&[&["--resume", "fps.json"], arguments].concat(), 2, part);
    }
    for (key, other) in [("device", "another device"), ("driver", "another driver"), ("program", "zerkalo 0.0.1")] {
        let mut altered = whole.clone();
        altered["machine"][key] = other.into();
        fs::write(place.path("other.json"), altered.to_string()).unwrap();
        place.assert_fps_refused(&["--resume", "other.json"], 2, &format!("its {key} is \"{other}\""));
    }
    fs::write(place.path("noise.json"), "noise").unwrap();
    place.assert_fps_refused(&["--resume", "noise.json"], 2, "noise.json");
    // Another machine's part of the table.
    let part = ["--size", "16x7", "--counts", "20", "--algorithm", "course", "--seconds", "0.01", "-o", "part.json"];
    place.fps_well(&part);
    let twice = ["--resume", "fps.json", "--resume", "again.json"];
    let mut again = whole.clone();
    again["cells"][0]["wall_samples_ns"][0] = 1.into();
    fs::write(place.path("again.json"), again.to_string()).unwrap();
    place.assert_fps_refused(&twice, 2, "again.json");
    fs::copy(place.path("fps.json"), place.path("all.json")).unwrap();
    place.fps_well(&["--resume", "all.json", "--resume", "part.json"]);
    let all = place.read_json("all.json");
    let cells =
        [&whole, &place.read_json("part.json")].map(|table| table["cells"].as_array().unwrap().clone()).concat();
    assert_eq!((&all["cells"], &all["plan"]["counts"]), (&cells.into(), &serde_json::json!([10, 20])));
    // Whole already: nothing is measured anew, and other forms can be had of it.
    place.fps_well(&["--resume", "fps.json", "-o", "fps.md"]);
    assert_eq!(place.read_json("fps.json"), whole);
    assert!(place.path("fps.md").exists());
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_every_finished_cell_and_the_table_is_gone_on_with() {
    let place = Place::new();
    let arguments = ["--size", "48x21", "--counts", "10,20", "--seconds", "0.2", "--validate", "-o", "out"];
    let program = place.fps_command(&arguments).spawn().unwrap();
    wait_until("a cell is measured", || place.path("out/fps.json").exists());
    let Run { code, stdout, stderr } = interrupted(program);
    assert_eq!(code, Some(130), "{stderr}");
    let last = stderr.lines().last().unwrap();
    assert!(
        last.contains("stopped") && last.contains("--resume \"out/fps.json\" -o \"out\" --validate=core"),
        "{stderr}"
    );
    assert!(stdout.contains("- not complete: "), "{stdout}");
    assert_eq!(names_in(&place.path("out")).len(), 5, "every form of what there is, and nothing else");

    let kept = place.read_json("out/fps.json");
    let kept_cells = kept["cells"].as_array().unwrap();
    assert_eq!(kept["complete"], false);
    assert!((2..16).contains(&kept_cells.len()) && kept_cells.len().is_multiple_of(2), "{}", kept_cells.len());

    place.fps_well(&["--resume", "out/fps.json", "-o", "out", "--validate"]);
    let whole = place.read_json("out/fps.json");
    assert_eq!(
        (&whole["plan"], &whole["machine"], &whole["complete"]),
        (&kept["plan"], &kept["machine"], &true.into())
    );
    let cells = whole["cells"].as_array().unwrap();
    assert_eq!((cells.len(), &cells[..kept_cells.len()]), (16, &kept_cells[..]), "what was measured stays");
}
