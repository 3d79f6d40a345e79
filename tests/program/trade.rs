//! `zerkalo trade` as a user meets it, on pictures so small that its times are of little use; and on scenes that no
//! gallery has, whether its answers are right.

use std::collections::BTreeSet;
use std::fs;
use std::time::Duration;

use crate::budget::random_scene;
use crate::place::{Place, Run, interrupted, names_in, wait_until};
use glam::DVec3;
use serde_json::Value;
use zerkalo::frame::Frame;
use zerkalo::measure::{ErrorDomain, image_error, quartiles};

fn array<'a>(value: &'a Value, key: &str) -> &'a Vec<Value> {
    value[key].as_array().unwrap()
}

const TINY: &[&str] = &["--size", "48x21", "--seconds", "0.01"];

#[test]
fn every_setting_is_measured_and_told_in_every_form() {
    let place = Place::new();
    let questions = ["--error", "0.5", "--fps", "0.01", "-o", "out", "--algorithm", "plain,course"];
    let trade = place.json(&[&["trade", "squares-121", "start"], TINY, &questions].concat());
    assert_eq!((&trade["format"], &trade["conditions"]["width"]), (&"zerkalo-trade-2".into(), &48.into()));
    let scenes = array(&trade, "scenes");
    let names: Vec<_> = scenes.iter().map(|scene| scene["scene"].as_str().unwrap()).collect();
    assert_eq!(names, ["squares-121", "start"]);
    for scene in scenes {
        let (points, figures) = (array(scene, "points"), array(scene, "figures"));
        assert_eq!((points.len(), &scene["complete"]), (figures.len(), &true.into()));
        for point in points {
            let (ours, baseline) = (array(point, "samples_ns"), array(point, "baseline_samples_ns"));
            assert!(ours.len() >= 2 && ours.len() == baseline.len(), "{point}");
            assert_eq!(point["error"]["pixels"], 48 * 21);
        }
        assert_eq!(figures[0]["name"], "whitted f32", "the baseline is the first");
        assert_eq!(points[0]["bound"], 0.0);
        assert!(points[1..].iter().all(|point| point["bound"].is_null()), "of the others nothing is proven");
        assert!(figures.iter().any(|figures| figures["is_on_front"] == true));
        for answer in array(scene, "answers") {
            let place = answer["place"].as_u64().unwrap() as usize;
            assert_eq!((&answer["setting"], &answer["name"]), (&points[place]["setting"], &figures[place]["name"]));
        }
    }
    let squares = &scenes[0];
    let reasons: Vec<_> =
        array(squares, "left_out").iter().map(|left_out| left_out["setting"]["kernel"].clone()).collect();
    assert_eq!(reasons, ["course"], "it takes 100 solids");

    assert_eq!(
        names_in(&place.path("out")),
        ["trade.csv", "trade.json", "trade.md", "trade.png", "trade.svg"].map(String::from).into()
    );
    let file: Value = serde_json::from_str(&fs::read_to_string(place.path("out/trade.json")).unwrap()).unwrap();
    assert_eq!(file, trade);
    let measured: usize = scenes.iter().map(|scene| array(scene, "points").len()).sum();
    assert_eq!(fs::read_to_string(place.path("out/trade.csv")).unwrap().lines().count(), 1 + measured);
    let markdown = fs::read_to_string(place.path("out/trade.md")).unwrap();
    assert!(markdown.contains("## start: ") && !markdown.contains("under validation"), "{markdown}");
    assert!(Frame::load(&place.path("out/trade.png")).is_ok());
    assert!(fs::read_to_string(place.path("out/trade.svg")).unwrap().contains("</svg>"));
}

#[test]
fn validation_has_nothing_to_say_of_measuring() {
    let place = Place::new();
    let options = ["--validate", "--algorithm", "course", "--target", "area", "--off-edges"];
    let text = place.run_well(&[&["trade", "start"], TINY, &options].concat());
    for part in ["under validation", "8x8 points", "| course ", "(ms, off edges)"] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
}

#[test]
fn an_answer_is_saved_and_drawn_by() {
    let place = Place::new();
    let ask = ["--algorithm", "plain", "--error", "0.5", "--save-settings", "fast.toml"];
    let text = place.run_well(&[&["trade", "corridor"], TINY, &ask].concat());
    assert!(text.contains("The fastest within an error of 0.5: **"), "{text}");
    let saved = fs::read_to_string(place.path("fast.toml")).unwrap();
    assert!(saved.starts_with("# The fastest setting within an error of 0.5 on \"corridor\" at 48x21"), "{saved}");
    let arguments = ["render", "corridor", "--settings", "fast.toml", "-o", "a.exr", "--size", "48x21"];
    let report = place.json(&arguments);
    assert!(saved.contains(&format!("kernel = {}", report["kernel"])), "{saved}{report}");
    place.assert_refused(&[&arguments[..], &["--algorithm", "plain"]].concat(), 2, &["--settings", "--algorithm"]);

    fs::write(place.path("wrong.toml"), "kernel = \"whitted\"\nfaster = true\n").unwrap();
    let wrong = ["render", "corridor", "--settings", "wrong.toml", "-o", "b.exr"];
    place.assert_refused(&wrong, 2, &["wrong.toml:2: ", "faster"]);
    place.assert_refused(&["view", "corridor", "--settings", "wrong.toml"], 2, &["wrong.toml:2: ", "faster"]);
    place.assert_refused(&["render", "corridor", "--settings", "none.toml", "-o", "b.exr"], 2, &["none.toml"]);
}

#[test]
fn a_question_without_an_answer_is_a_failure_that_tells_what_comes_nearest() {
    let place = Place::new();
    let ask = ["--algorithm", "plain", "--fps", "1000000", "--save-settings", "none.toml"];
    let run = place.run(&[&["trade", "start"], TINY, &ask].concat());
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stderr.contains("no setting of the sweep draws 1.00e6 frames a second on \"start\""), "{}", run.stderr);
    assert!(run.stdout.contains("no setting of the sweep reaches it; the fastest one, "), "{}", run.stdout);
    assert_eq!(place.names(), BTreeSet::new());
}

#[test]
fn what_cannot_be_measured_or_written_is_refused() {
    let place = Place::new();
    for (arguments, part) in [
        (&["--size", "0x5"][..], "--size"),
        (&["--error=-1"], "--error"),
        (&["--fps", "0"], "--fps"),
        (&["--seconds", "0"], "--seconds"),
        (&["--algorithm", "reference"], "--algorithm"),
        (&["--target", "blur"], "--target"),
        (&["--algorithm", "path"], "--target radiance"),
        (&["--truth-samples", "64"], "--truth-samples"),
        (&["--target", "radiance", "--truth-samples", "63"], "--truth-samples"),
        (&["--target", "radiance", "--off-edges"], "--off-edges"),
        (&["-o", "table.txt"], "table.txt"),
        (&["--save-settings", "a.toml"], "--save-settings"),
        (&["--save-settings", "a.toml", "--error", "1", "--fps", "1"], "--save-settings"),
        (&["four", "--save-settings", "a.toml", "--error", "1"], "--save-settings"),
        (&["no scene"], "no scene"),
        (&["--device", "nonsense"], "nonsense"),
    ] {
        place.assert_refused(&[&["trade", "start"], arguments].concat(), 2, &[part]);
    }
    place.assert_refused(&["trade"], 2, &["SCENE"]);
    place.assert_refused(&["trade", "start", "-o", "nowhere/trade.csv"], 1, &["nowhere/trade.csv"]);
    place.assert_refused(
        &["trade", "start", "--error", "1", "--save-settings", "nowhere/a.toml"],
        1,
        &["nowhere/a.toml"],
    );
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_measured() {
    let place = Place::new();
    let arguments =
        ["trade", "start", "showcase", "--size", "48x21", "--seconds", "0.3", "--algorithm", "plain", "-o", "out"];
    let program = place.command(&arguments).spawn().unwrap();
    // The first scene is written when it is done.
    wait_until("a scene is measured", || place.path("out/trade.json").exists());
    std::thread::sleep(Duration::from_millis(300));
    let Run { code, stdout, stderr } = interrupted(program);
    assert_eq!(code, Some(130), "{stderr}");
    assert!(stdout.contains("## start: ") && stdout.contains("Not complete: "), "{stdout}");
    assert_eq!(names_in(&place.path("out")).len(), 5, "every form of what there is, and nothing else");
    let kept: Value = serde_json::from_str(&fs::read_to_string(place.path("out/trade.json")).unwrap()).unwrap();
    let complete: Vec<_> = array(&kept, "scenes").iter().map(|scene| scene["complete"].clone()).collect();
    assert_eq!(complete, [true, false]);
}

// ---- Whether the answers are right.

/// Writes a scene that no gallery has, lit by about 1.
fn write_scene(place: &Place, seed: u64) -> String {
    let mut scene = random_scene(seed);
    // Each depth is settings more, compiled one by one.
    scene.max_depth = scene.max_depth.min(2);
    scene.lights.iter_mut().for_each(|light| light.intensity = light.intensity.min(DVec3::ONE));
    let name = format!("random-{seed}.toml");
    scene.save(&place.path(&name)).unwrap();
    name
}

/// The median of the ratios of a point's pairs.
fn ratio(point: &Value) -> f64 {
    let samples = |key| serde_json::from_value::<Vec<f64>>(point[key].clone()).unwrap();
    let pairs = samples("samples_ns").into_iter().zip(samples("baseline_samples_ns"));
    quartiles(&pairs.map(|(ours, baseline)| ours / baseline).collect::<Vec<_>>()).unwrap()[1]
}

/// The place that docs/commands.md promises for the fastest setting that keeps `error`: of those within 3 % of the
/// fastest the one whose error is proven, then the most accurate, then the faster.
fn promised_answer(points: &[Value], error: f64) -> usize {
    let own = |place: usize| points[place]["error"]["max_abs"].as_f64().filter(|own| *own <= error);
    let mut keeping: Vec<usize> = (0..points.len())
        .filter(|&place| points[place]["error"]["non_finite_pixels"] == 0 && own(place).is_some())
        .collect();
    let fastest = keeping.iter().map(|&place| ratio(&points[place])).fold(f64::INFINITY, f64::min);
    keeping.retain(|&place| ratio(&points[place]) <= 1.03 * fastest);
    let is_proven = |place: usize| points[place]["bound"].as_f64().is_some_and(|bound| bound <= error);
    if keeping.iter().any(|&place| is_proven(place)) {
        keeping.retain(|&place| is_proven(place));
    }
    let least = keeping.iter().filter_map(|&place| own(place)).fold(f64::INFINITY, f64::min);
    keeping.retain(|&place| own(place) == Some(least));
    keeping.into_iter().min_by(|&a, &b| ratio(&points[a]).total_cmp(&ratio(&points[b]))).unwrap()
}

/// Asks for the fastest setting that keeps `error`, and checks the answer: that it keeps the error, by pictures drawn
/// anew, and that it is the promised one of what was measured. The answer's place and the run.
fn assert_answer_is_right(place: &Place, scene: &str, error: f64, options: &[&str]) -> (usize, Value) {
    let asked = error.to_string();
    let saved = ["--error", &asked, "--save-settings", "chosen.toml"];
    let trade = place.json(&[&["trade", scene], &saved[..], options].concat());
    let scene_of_run = &trade["scenes"][0];
    let points = array(scene_of_run, "points");
    let chosen = scene_of_run["answers"][0]["place"].as_u64().unwrap() as usize;

    let size = options.iter().position(|option| *option == "--size").map(|place| options[place + 1]).unwrap();
    place.run_well(&["render", scene, "--algorithm", "reference", "--size", size, "-o", "truth.exr"]);
    place.run_well(&["render", scene, "--settings", "chosen.toml", "--size", size, "-o", "ours.exr"]);
    let frame = |name| Frame::load(&place.path(name)).unwrap();
    let anew = image_error(&frame("truth.exr"), &frame("ours.exr"), ErrorDomain::Linear, None).unwrap();
    let name = &scene_of_run["answers"][0]["name"];
    assert!(anew.max_abs.unwrap() <= error && anew.non_finite_pixels == 0, "{scene}: {name}: {anew:?}");
    // serde_json reads the nearest number or its neighbour.
    let told = points[chosen]["error"]["max_abs"].as_f64().unwrap();
    assert!((anew.max_abs.unwrap() - told).abs() <= 2.0 * f64::EPSILON * told, "{scene}: {name}: {told}, {anew:?}");

    assert_eq!(chosen, promised_answer(points, error), "{scene}: {name}: {points:?}");
    (chosen, trade)
}

#[test]
fn the_setting_chosen_for_an_error_keeps_it_and_is_the_promised_one() {
    let place = Place::new();
    for (seed, error, kernels) in [(3, 1.0 / 510.0, "whitted"), (8, 0.1, "plain")] {
        let scene = write_scene(&place, seed);
        let options = ["--size", "64x28", "--seconds", "0.02", "--algorithm", kernels];
        assert_answer_is_right(&place, &scene, error, &options);
    }
}

/// In the room most light comes from the walls, which only path tracing sees; without walls any algorithm will do.
#[test]
fn for_all_light_any_algorithm_may_be_the_answer_and_a_picture_by_another_seed_keeps_the_error() {
    let place = Place::new();
    for (scene, error, algorithms) in [("room", 0.02, "ssr,path"), ("matt", 0.05, "ssr,path")] {
        let asked = error.to_string();
        let options = ["--target", "radiance", "--truth-samples", "1024", "--algorithm", algorithms, "--validate"];
        let questions = ["--error", &asked, "--save-settings", "chosen.toml", "-o", "trade.svg"];
        let trade = place.json(&[&["trade", scene], TINY, &options, &questions].concat());
        let scene_of_run = &trade["scenes"][0];
        let truth_error = scene_of_run["truth_standard_error"].as_f64().unwrap();
        assert!(truth_error > 0.0 && truth_error < error / 5.0, "{truth_error}");
        let points = array(scene_of_run, "points");
        let mut by_samples = Vec::new();
        for point in points {
            assert!(point["error"]["discontinuity_pixels"].is_null() && point["bound"].is_null(), "{point}");
            if point["setting"]["kernel"] == "path" {
                let of_pictures: Vec<f64> = serde_json::from_value(point["rmse_of_pictures"].clone()).unwrap();
                assert!(of_pictures.len() > array(point, "samples_ns").len() / 2, "{point}");
                assert!(of_pictures.windows(2).any(|pair| pair[0] != pair[1]), "every picture by its own seed");
                by_samples.push(of_pictures[0]);
            } else {
                assert!(point["rmse_of_pictures"].is_null());
            }
        }
        assert!(by_samples.len() == 9 && by_samples[0] > 4.0 * by_samples[8], "1 and 256 samples: {by_samples:?}");

        let answer = &scene_of_run["answers"][0];
        if scene == "room" {
            assert_eq!(answer["setting"]["kernel"], "path", "{answer}");
        }
        let truth = ["--algorithm", "path", "--samples", "4096", "--seed", "77"];
        place.run_well(&[&["render", scene, "--size", "48x21", "-o", "truth.exr"][..], &truth].concat());
        place.run_well(&["render", scene, "--settings", "chosen.toml", "--size", "48x21", "-o", "ours.exr"]);
        let frame = |name| Frame::load(&place.path(name)).unwrap();
        let anew = image_error(&frame("truth.exr"), &frame("ours.exr"), ErrorDomain::Linear, None).unwrap();
        assert!(anew.rmse.unwrap() <= error, "{answer}: {anew:?}");
    }
}

/// `cargo test --release --test trade -- --ignored --nocapture`. Each scene is measured twice: what the first run
/// chooses must also be within a tenth of the fastest of the second.
#[test]
#[ignore = "takes five minutes and a quiet machine"]
fn on_ten_scenes_the_answers_hold_in_a_second_run() {
    let place = Place::new();
    let options = ["--size", "122x53", "--seconds", "0.15"];
    for (seed, error) in (100..110).zip([1.0 / 510.0, 0.02, 0.1].into_iter().cycle()) {
        let scene = write_scene(&place, seed);
        let (chosen, first) = assert_answer_is_right(&place, &scene, error, &options);
        let (_, second) = assert_answer_is_right(&place, &scene, error, &options);
        let points = array(&second["scenes"][0], "points");
        let keeps = |point: &&Value| point["error"]["max_abs"].as_f64().is_some_and(|own| own <= error);
        let fastest = points.iter().filter(keeps).map(ratio).min_by(f64::total_cmp).unwrap();
        let again = ratio(&points[chosen]);
        let name = &first["scenes"][0]["answers"][0]["name"];
        println!("{scene}, error {error:.5}: {name}: {:.3} of the fastest in the second run", again / fastest);
        assert!(again <= 1.1 * fastest, "{scene}: {name}: {again} to {fastest}");
    }
}
