//! Path tracing and the comparison of algorithms as a user asks for them.

use std::fs;

use crate::place::{Place, Run, interrupted, names_in, wait_until};
use serde_json::Value;
use zerkalo::frame::Frame;

fn path<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["render", "matt", "-o", "x.exr", "--size", "48x21", "--algorithm", "path"][..], more].concat()
}

#[test]
fn samples_are_taken_until_there_are_enough() {
    let place = Place::new();
    let report = place.json(&path(&["--samples", "20"]));
    assert_eq!((&report["kernel"], &report["samples_per_pixel"]), (&"path".into(), &20.into()));
    assert_eq!(report["standard_error"], Value::Null, "of three runs nothing is told");
    assert_eq!(report["samples_ns"].as_array().unwrap().len(), 3, "two runs of 8 and one of 4");
    let report = place.json(&path(&[]));
    assert_eq!(report["samples_per_pixel"], 64);
    let error = |report: &Value| report["standard_error"]["of_99_percent"].as_f64().unwrap();
    let wanted = error(&report) / 2.0;
    let text = wanted.to_string();
    let better = place.json(&path(&["--until-error", &text]));
    assert!(error(&better) <= wanted && better["samples_per_pixel"].as_u64() > Some(64), "{better}");
    let begun = std::time::Instant::now();
    let timed = place.json(&path(&["--seconds", "0.5"]));
    assert!(timed["samples_per_pixel"].as_u64() >= Some(8) && begun.elapsed().as_secs_f64() >= 0.5, "{timed}");
    assert!(place.run_well(&path(&[])).contains("64 samples a pixel"));
}

#[test]
fn a_seed_is_a_picture() {
    let place = Place::new();
    let draw = |more: &[&str]| {
        place.run_well(&path(&[&["--samples", "4"], more].concat()));
        Frame::load(&place.path("x.exr")).unwrap()
    };
    let first = draw(&[]);
    assert_eq!(first.pixels(), draw(&["--seed", "0"]).pixels());
    assert_ne!(first.pixels(), draw(&["--seed", "1"]).pixels());
    assert_ne!(first.pixels(), draw(&["--numbers", "independent"]).pixels());
}

#[test]
fn an_interrupt_loses_the_picture_or_keeps_it_as_asked() {
    let place = Place::new();
    for (more, kept) in [(&["--keep-partial"][..], true), (&[], false)] {
        let name = if kept { "kept.exr" } else { "lost.exr" };
        let arguments = ["render", "matt", "-o", name, "--size", "48x21", "--algorithm", "path", "--seconds", "600"];
        let program = place.command(&[&arguments[..], more].concat()).spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_secs(2));
        let Run { code, stderr, .. } = interrupted(program);
        assert_eq!(code, Some(130), "{stderr}");
        assert_eq!(place.path(name).exists(), kept);
    }
    assert!(Frame::load(&place.path("kept.exr")).unwrap().pixels().iter().flatten().any(|&channel| channel > 0.0));
}

#[test]
fn what_makes_no_sense_is_refused_in_a_line() {
    let place = Place::new();
    for (more, part) in [
        (["--samples", "0"], "samples"),
        (["--until-error", "0"], "above 0"),
        (["--seconds", "-1"], "seconds"),
        (["--scale", "0.5"], "scale"),
        (["--error", "0.1"], "error"),
        (["--repeat", "3"], "--repeat"),
    ] {
        place.assert_refused(&path(&more), 2, &[part]);
    }
    for more in [["--seed", "1"], ["--numbers", "independent"], ["--until-error", "0.1"], ["--seconds", "1"]] {
        let arguments = [&["render", "matt", "-o", "x.exr"][..], &more].concat();
        place.assert_refused(&arguments, 2, &["path"]);
    }
    place.assert_refused(&["render", "matt", "-o", "x.exr", "--samples", "65"], 2, &["1 to 64"]);
    // A file of settings says which algorithm it is.
    for (algorithm, option) in [("path", ["--repeat", "3"]), ("whitted", ["--until-error", "0.1"])] {
        fs::write(place.path("s.toml"), format!("algorithm = \"{algorithm}\"\n")).unwrap();
        let arguments = [&["render", "matt", "-o", "x.exr", "--settings", "s.toml"][..], &option].concat();
        place.assert_refused(&arguments, 2, &[option[0]]);
    }
}

#[test]
fn light_that_grows_at_a_surface_is_drawn_with_a_warning() {
    let place = Place::new();
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/matt.toml")).unwrap();
    fs::write(place.path("bright.toml"), text.replacen("diffuse = 0.25", "diffuse = 1.0, reflection = 0.5", 1))
        .unwrap();
    let arguments = ["render", "bright.toml", "-o", "x.exr", "--size", "16x9", "--algorithm", "path", "--samples", "2"];
    let run = place.run(&arguments);
    assert_eq!(run.code, Some(0), "{run:?}");
    assert_eq!(run.stderr.lines().filter(|line| line.contains("primitive 0 sends back")).count(), 1, "{run:?}");
}

#[test]
fn algorithms_are_compared_and_told_in_every_form() {
    let place = Place::new();
    let arguments = ["algorithms", "behind", "--size", "32x14", "--samples", "16,1", "--seeds", "3", "-o", "out"];
    let report = place.json(&arguments);
    let scene = &report["scenes"][0];
    let names: Vec<_> = (scene["measured"].as_array().unwrap().iter())
        .map(|measured| format!("{} {}", measured["algorithm"].as_str().unwrap(), measured["samples"]))
        .collect();
    assert_eq!(names, ["whitted 1", "whitted 16", "ssr 1", "path 1", "path 16"]);
    for measured in scene["measured"].as_array().unwrap() {
        assert_eq!(measured["times_ns"].as_array().unwrap().len(), 3);
        let is_noisy = measured["noise"].as_f64().unwrap() > 0.0;
        assert_eq!(is_noisy, measured["algorithm"] == "path", "{measured}");
    }
    assert_eq!(scene["truth_samples"], 48);
    for ranks in scene["ranks"].as_array().unwrap() {
        assert_eq!(ranks["ranks"].as_array().unwrap().len(), 9);
    }
    let names: Vec<String> = names_in(&place.path("out")).into_iter().collect();
    assert_eq!(names.len(), 6, "five forms and the pictures: {names:?}");
    let csv = fs::read_to_string(place.path("out/algorithms.csv")).unwrap();
    assert_eq!(csv.lines().count(), 6);
    let markdown = fs::read_to_string(place.path("out/algorithms.md")).unwrap();
    assert!(markdown.contains("## behind: 5 solids") && markdown.contains("frame time"), "{markdown}");
    let sheet = Frame::load(&place.path("out/algorithms-pictures.png")).unwrap();
    assert_eq!(sheet.width(), 10 + 6 * (32 + 10));
}

#[test]
fn an_interrupt_keeps_the_scenes_that_were_compared() {
    let place = Place::new();
    let arguments =
        ["algorithms", "matt", "room", "--size", "24x10", "--samples", "1,4096", "--seeds", "2", "-o", "out"];
    let program = place.command(&arguments).spawn().unwrap();
    wait_until("a scene is compared", || place.path("out/algorithms.json").exists());
    std::thread::sleep(std::time::Duration::from_millis(300));
    let Run { code, stdout, stderr } = interrupted(program);
    assert_eq!(code, Some(130), "{stderr}");
    assert!(stdout.contains("## matt: 4 solids") && !stdout.contains("## room"), "{stdout}");
}
