//! Standard input and output in place of files, words about what is mistyped, and warnings.

use std::io::Write;
use std::process::Stdio;

use crate::place::Place;
use zerkalo::frame::Frame;
use zerkalo::scene::gallery;

const REPORTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/reports");

/// Runs with these bytes as standard input; the exit code, what came out, and what was said.
fn piped(place: &Place, arguments: &[&str], input: &[u8]) -> (Option<i32>, Vec<u8>, String) {
    let mut command = place.command(arguments);
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut program = piped.spawn().unwrap();
    let mut stdin = program.stdin.take().unwrap();
    let input = input.to_vec();
    // What is refused is not read to its end.
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = program.wait_with_output().unwrap();
    writer.join().unwrap();
    (output.status.code(), output.stdout, String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_scene_comes_in_and_a_picture_goes_out_by_streams_as_by_files() {
    let place = Place::new();
    let scene = gallery::scene("four").unwrap();
    let size = ["--size", "64x28"];
    for (name, format, output) in [("a.png", "png", "toml"), ("a.exr", "exr", "json"), ("b.png", "png", "zscene")] {
        let input = match output {
            "toml" => scene.to_toml().into_bytes(),
            "json" => scene.to_json().into_bytes(),
            _ => scene.to_zscene(),
        };
        let run = place.run(&[&["render", "four", "-o", name], &size[..]].concat());
        assert_eq!(run.code, Some(0), "{run:?}");
        let arguments = ["render", "-", "--format", output, "-o", "-", "--output-format", format];
        let (code, picture, told) = piped(&place, &[&arguments[..], &size[..]].concat(), &input);
        assert_eq!(code, Some(0), "{told}");
        assert!(told.starts_with("wrote standard output (64x28") && told.lines().count() == 1, "{told}");
        std::fs::write(place.path(&format!("streamed.{format}")), &picture).unwrap();
        let pixels = |name: &str| Frame::load(&place.path(name)).unwrap().pixels().to_vec();
        assert!(pixels(&format!("streamed.{format}")) == pixels(name), "{format} of {output}");
    }
}

#[test]
fn what_comes_by_a_stream_is_refused_as_a_file_is() {
    let place = Place::new();
    for (input, part) in
        [(&b"max_depth = 0"[..], "standard input:1: max_depth = 0"), (b"\xff\xfe", "standard input: is not UTF-8")]
    {
        let (code, stdout, told) = piped(&place, &["render", "-", "-o", "out.png", "--size", "8x8"], input);
        assert_eq!((code, stdout.len(), told.lines().count()), (Some(2), 0, 1), "{told}");
        assert!(told.contains(part), "{told}");
    }
}

#[test]
fn a_format_of_what_has_a_name_is_refused() {
    let place = Place::new();
    for (option, format) in [("--format", "json"), ("--output-format", "exr")] {
        let run = place.run(&["render", "four", "-o", "a.png", option, format]);
        assert!(run.code == Some(2) && run.stderr.contains(option), "{run:?}");
    }
}

#[test]
fn a_mistyped_name_of_the_gallery_gets_the_nearest_one() {
    let place = Place::new();
    for (mistyped, meant) in [("spehre", "sphere"), ("coridor", "corridor"), ("Showcase", "showcase")] {
        let run = place.run(&["render", mistyped, "-o", "a.png"]);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.stderr.contains(&format!("did you mean {meant}?")), "{run:?}");
    }
    let run = place.run(&["render", "quartz", "-o", "a.png"]);
    assert!(run.code == Some(2) && !run.stderr.contains("did you mean"), "{run:?}");
}

#[test]
fn an_impossible_error_is_told_what_is_allowed() {
    let place = Place::new();
    for command in [&["render", "four", "-o", "a.png", "--error", "-1"][..], &["plan", "four", "--error", "-1"]] {
        let run = place.run(command);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.stderr.contains("it must be a number, 0 or greater"), "{run:?}");
    }
}

#[test]
fn where_f32_is_too_coarse_f64_draws_and_f32_is_warned_of() {
    let place = Place::new();
    // What stands on the base of a cone, whose place is told from the apex, far below.
    let base = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/wide_base.toml");
    let size = ["--size", "96x42"];
    let render = |more: &[&str]| place.run(&[&["render", base, "-o", "a.png", "--json"], &size[..], more].concat());
    let run = render(&[]);
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&report["precision"], &report["warning"]), (&"f64".into(), &serde_json::Value::Null), "{run:?}");
    assert_eq!(run.stderr, "");
    let run = render(&["--precision", "f32"]);
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((run.code, &report["precision"]), (Some(0), &"f32".into()), "{run:?}");
    let warning = report["warning"].as_str().unwrap();
    assert_eq!(run.stderr, format!("warning: {warning}\n"));
    assert!(warning.contains("primitive 1 is 5.7e7 wide: f32 moves its surface by 3.4"), "{warning}");

    let run = place.run(&["plan", base]);
    assert!(run.stdout.lines().any(|line| line.contains("precision") && line.contains("f64")), "{run:?}");
    assert!(run.stdout.contains("primitive 1 is 5.7e7 wide"), "{run:?}");
    let run = place.run(&["plan", base, "--no-device"]);
    assert!(run.stdout.contains("warning: f32 is too coarse for this scene"), "{run:?}");
    let planet = format!("{REPORTS}/planet.json");
    for (scene, is_close_up) in [("four", false), (&planet, true)] {
        let run = place.run(&["plan", scene]);
        let has = |what: &str, choice: &str| {
            run.stdout.lines().any(|line| line.split_whitespace().take(2).eq([what, choice]))
        };
        assert!(has("precision", "f32") && has("close-up", "yes") == is_close_up, "{run:?}");
        assert!(!run.stdout.contains("warning"), "{run:?}");
    }
}

#[test]
fn a_file_of_another_program_is_drawn_at_its_size_and_what_it_loses_is_told_or_refused() {
    let place = Place::new();
    let sample = |name: &str| format!("{}/tests/scenes/nff/{name}.nff", env!("CARGO_MANIFEST_DIR"));
    std::fs::write(
        place.path("ball.nff"),
        "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45 resolution 48 32 b 0 0 1 f 1 1 1 1 0 9 0 1 l 0 9 9 1 1 1 s 0 0 0 1",
    )
    .unwrap();
    let told = place.json(&["render", "ball.nff", "-o", "ball.exr", "--json", "--strict"]);
    assert_eq!((&told["width"], &told["height"]), (&48.into(), &32.into()));
    assert_eq!(place.json(&["plan", "ball.nff", "--no-device", "--json"])["width"], 48);
    place.run_well(&["convert", "ball.nff", "ball.toml", "--strict"]);
    place.run_well(&["render", "ball.toml", "-o", "same.exr", "--size", "48x32"]);
    assert_eq!(std::fs::read(place.path("ball.exr")).unwrap(), std::fs::read(place.path("same.exr")).unwrap());

    let tree = sample("tree-3");
    let lost = format!("{tree}:23: a truncated cone is left out (15 times, here first)");
    let run = place.run(&["convert", &tree, "tree.zscene"]);
    let told = ["note: ", "note: ", "warning: "].iter().zip(run.stderr.lines());
    assert!(run.code == Some(0) && told.clone().count() == 3 && run.stderr.lines().count() == 3, "{}", run.stderr);
    assert!(told.clone().all(|(word, line)| line.starts_with(word)), "{}", run.stderr);
    assert_eq!(run.stderr.lines().last(), Some(format!("warning: {lost}").as_str()));
    place.assert_refused(&["convert", &tree, "strict.zscene", "--strict"], 2, &[&lost]);
    place.assert_refused(&["convert", "four", "four.nff"], 2, &["NFF is read only"]);
    assert!(!place.path("strict.zscene").exists() && !place.path("four.nff").exists());

    let arguments = ["render", "-", "-o", "piped.exr", "--format", "nff", "--strict"];
    let (code, _, said) = piped(&place, &arguments, &std::fs::read(place.path("ball.nff")).unwrap());
    assert_eq!((code, said.as_str()), (Some(0), ""));
    assert_eq!(std::fs::read(place.path("ball.exr")).unwrap(), std::fs::read(place.path("piped.exr")).unwrap());
    let (code, _, said) =
        piped(&place, &["render", "-", "-o", "lost.exr", "--format", "nff", "--strict"], b"c 0 0 0 1 1 1 1 2");
    assert!(code == Some(2) && said.contains("standard input:1: a truncated cone"), "{said}");
}
