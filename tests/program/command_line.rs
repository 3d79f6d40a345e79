//! The program as a user meets it: what it prints, writes and answers, and that it never ends halfway.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::place::{Place, Run, interrupted, names_in, wait_until};
use serde_json::Value;
use zerkalo::frame::Frame;
use zerkalo::gpu;
use zerkalo::scene::gallery;

impl Place {
    /// Runs what must fail with `code`, one line that holds all of `parts`, and no trace in the folder.
    #[track_caller]
    fn assert_refused_in_one_line(&self, arguments: &[&str], code: i32, parts: &[&str]) {
        self.assert_command_refused(&mut self.command(arguments), code, parts);
    }

    #[track_caller]
    fn assert_command_refused(&self, command: &mut Command, code: i32, parts: &[&str]) {
        let before = self.names();
        let run = Run::of(command.output().unwrap());
        assert_eq!(run.code, Some(code), "{command:?}: {run:?}");
        assert_eq!(run.stdout, "", "{command:?}");
        let line = run.only_line();
        for part in parts {
            assert!(line.contains(part), "{part:?} is not in: {line}");
        }
        assert_eq!(self.names(), before, "{command:?} left something");
    }
}

impl Run {
    /// The program's one line of complaint.
    #[track_caller]
    fn only_line(&self) -> &str {
        let line = self.stderr.strip_suffix('\n').unwrap_or_default();
        assert!(line.starts_with("zerkalo: ") && !line.contains(char::is_control), "{:?}", self.stderr);
        line
    }
}

fn keys(object: &Value) -> BTreeSet<&str> {
    object.as_object().unwrap().keys().map(String::as_str).collect()
}

const SMALL: &[&str] = &["--size", "16x7"];

fn render<'a>(scene: &'a str, output: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["render", scene, "-o", output][..], more].concat()
}

#[test]
fn render_writes_the_picture_and_reports_it_as_json() {
    let place = Place::new();
    for output in ["x.png", "x.exr"] {
        let report = place.json(&render("four", output, &["--size", "160x69", "--json", "--repeat", "2"]));
        let documented = "width height kernel precision error_bound samples_per_pixel scale device driver gpu_time_ns \
                          note samples_ns standard_error validation_messages validation_remarks warning"
            .split(' ');
        assert_eq!(keys(&report), documented.collect());
        assert_eq!((&report["width"], &report["height"]), (&160.into(), &69.into()));
        assert_eq!((&report["kernel"], &report["precision"]), (&"whitted".into(), &"f32".into()));
        assert_eq!(report["validation_messages"], 0);
        let devices = gpu::devices().unwrap();
        let device = devices.iter().find(|device| report["device"] == device.name).expect("a device of the list");
        assert_eq!(report["driver"], device.driver);
        if device.timestamps {
            let samples: Vec<u64> = serde_json::from_value(report["samples_ns"].clone()).unwrap();
            assert_eq!(samples.len(), 2);
            assert!(samples.iter().all(|&sample| sample > 0), "{samples:?}");
            assert_eq!(report["gpu_time_ns"], samples[0].midpoint(samples[1]));
        } else {
            assert_eq!((&report["gpu_time_ns"], &report["samples_ns"]), (&Value::Null, &Value::Array(vec![])));
        }
        let frame = Frame::load(&place.path(output)).unwrap();
        assert_eq!((frame.width(), frame.height()), (160, 69));
    }
    assert_eq!(place.names(), BTreeSet::from(["x.exr".to_owned(), "x.png".to_owned()]), "nothing else is left");
}

#[test]
fn without_repeat_the_one_render_is_timed_and_told_in_a_sentence() {
    let place = Place::new();
    let report = place.json(&render("four", "x.png", &["--size", "16x7", "--json"]));
    if let [sample] = &report["samples_ns"].as_array().unwrap()[..] {
        assert_eq!(&report["gpu_time_ns"], sample);
    }
    let run = place.run(&render("four", "x.png", SMALL));
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert!(run.stdout.starts_with("wrote x.png (16x7, ") && run.stdout.lines().count() == 1, "{}", run.stdout);
}

#[test]
fn the_reference_draws_without_a_device_and_says_so() {
    let place = Place::new();
    let mut command =
        place.command(&render("four", "x.exr", &["--size", "80x35", "--algorithm", "reference", "--json"]));
    command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
    let run = Run::of(command.output().unwrap());
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&report["kernel"], &report["precision"]), (&"reference".into(), &"f64".into()));
    assert_eq!((&report["device"], &report["gpu_time_ns"]), (&"CPU".into(), &Value::Null));
    assert!(report["samples_ns"].as_array().unwrap().is_empty());
    let frame = Frame::load(&place.path("x.exr")).unwrap();
    let background = frame.pixels()[0];
    assert!(frame.pixels().iter().any(|&pixel| pixel != background), "the solids are there");

    for option in [&["--repeat", "2"][..], &["--validate"]] {
        let arguments = [&["--size", "80x35", "--algorithm", "reference"], option].concat();
        place.assert_refused_in_one_line(&render("four", "y.exr", &arguments), 2, &[option[0]]);
    }
}

#[test]
fn a_scene_file_and_the_gallery_scene_of_its_name_give_the_same_picture() {
    let place = Place::new();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/several.toml");
    place.json(&render("several", "a.exr", &["--size", "80x35", "--json"]));
    place.json(&render(file.to_str().unwrap(), "b.exr", &["--size", "80x35", "--json"]));
    assert!(fs::read(place.path("a.exr")).unwrap() == fs::read(place.path("b.exr")).unwrap());
}

#[test]
fn compare_finds_a_png_equal_to_the_exr_of_the_same_picture() {
    let place = Place::new();
    for output in ["a.png", "a.exr"] {
        place.json(&render("four", output, &["--size", "160x69", "--json"]));
    }
    let comparison = place.json(&["compare", "a.png", "a.exr", "--json"]);
    let documented = ["rmse", "max_abs", "psnr_db", "flip_mean", "differing_pixels", "pixels", "non_finite_pixels"];
    assert_eq!(keys(&comparison), BTreeSet::from(documented));
    for zero in ["rmse", "max_abs", "flip_mean", "differing_pixels", "non_finite_pixels"] {
        assert_eq!(comparison[zero].as_f64(), Some(0.0), "{zero}");
    }
    assert_eq!(comparison["psnr_db"], Value::Null);
    assert_eq!(comparison["pixels"], 160 * 69);
}

#[test]
fn compare_refuses_what_it_cannot_compare() {
    let place = Place::new();
    place.json(&render("four", "a.png", &["--size", "16x7", "--json"]));
    place.json(&render("four", "b.png", &["--size", "16x8", "--json"]));
    fs::write(place.path("noise.png"), [0x5A; 999]).unwrap();
    place.assert_refused_in_one_line(&["compare", "a.png", "b.png"], 2, &["a.png", "b.png", "16x7", "16x8"]);
    place.assert_refused_in_one_line(&["compare", "a.png", "none.png"], 2, &["none.png"]);
    place.assert_refused_in_one_line(&["compare", "noise.png", "a.png"], 2, &["noise.png"]);
    place.assert_refused_in_one_line(&["compare", "a.png", "a.gif"], 2, &["a.gif", ".png or .exr"]);
}

#[test]
fn an_unknown_scene_name_is_refused_and_says_where_names_are_listed() {
    let place = Place::new();
    place.assert_refused_in_one_line(&render("showcas", "x.png", SMALL), 2, &["showcas", "zerkalo gallery"]);
}

#[test]
fn a_broken_scene_file_is_refused_with_file_and_line_and_nothing_is_written() {
    let place = Place::new();
    let sphere = "[[primitives]]\nkind = 'sphere'\n";
    let broken = [
        ("truncated.toml", "max_depth = 3\nprimitives = [{ kind = \"sphere\", rad".to_owned(), "truncated.toml:2"),
        ("nan.toml", format!("{sphere}center = [nan, 0, 0]"), "nan.toml:3"),
        ("negative.toml", format!("{sphere}radius = -1"), "negative.toml:3"),
        ("huge.toml", format!("{sphere}radius = 1e400"), "huge.toml:3"),
        ("field.toml", format!("{sphere}radios = 1"), "field.toml:3"),
        ("kind.toml", "[[primitives]]\nkind = 'torus'".to_owned(), "kind.toml:2"),
        ("truncated.json", "{\"lights\": [".to_owned(), "truncated.json:1"),
        ("deep.json", "[".repeat(100_000), "deep.json"),
        ("empty.json", String::new(), "empty.json:1"),
        ("scene.txt", String::new(), "scene.txt"),
    ];
    for (name, text, part) in broken {
        fs::write(place.path(name), text).unwrap();
        place.assert_refused_in_one_line(&render(name, "x.png", SMALL), 2, &[part]);
    }
    fs::write(place.path("bytes.toml"), [0xFF, 0xFE, 0x00, 0xC3]).unwrap();
    place.assert_refused_in_one_line(&render("bytes.toml", "x.png", SMALL), 2, &["bytes.toml"]);
    fs::create_dir(place.path("folder.toml")).unwrap();
    place.assert_refused_in_one_line(&render("folder.toml", "x.png", SMALL), 2, &["folder.toml"]);
    place.assert_refused_in_one_line(&render("missing.toml", "x.png", SMALL), 2, &["missing.toml"]);
}

#[test]
fn a_scene_that_the_kernel_cannot_draw_is_refused_with_the_reason() {
    let place = Place::new();
    fs::write(place.path("lights.toml"), "[[lights]]\n[[lights]]\nposition = [1, 2, 3]").unwrap();
    let course = [SMALL, &["--algorithm", "course"]].concat();
    place.assert_refused_in_one_line(
        &render("lights.toml", "x.png", &course),
        2,
        &["course kernel", "exactly one light", "2"],
    );
    place.json(&render("lights.toml", "x.png", &[SMALL, &["--json"]].concat()));
}

#[test]
fn every_kernel_draws_in_the_precisions_that_it_has_and_refuses_the_other() {
    let place = Place::new();
    for (kernel, precision) in [("course", "f32"), ("whitted", "f32"), ("whitted", "f64"), ("reference", "f64")] {
        let arguments = [SMALL, &["--algorithm", kernel, "--precision", precision, "--json"]].concat();
        let report = place.json(&render("four", "x.exr", &arguments));
        assert_eq!((&report["kernel"], &report["precision"]), (&kernel.into(), &precision.into()));
    }
    // The option's name until 2026.
    let report = place.json(&render("four", "x.exr", &[SMALL, &["--kernel", "course", "--json"]].concat()));
    assert_eq!(report["kernel"], "course");
    for (kernel, precision) in [("course", "f64"), ("reference", "f32")] {
        let arguments = [SMALL, &["--algorithm", kernel, "--precision", precision]].concat();
        place.assert_refused_in_one_line(&render("four", "y.exr", &arguments), 2, &[kernel, precision]);
    }
}

#[test]
fn samples_and_scale_are_the_whitted_kernel_s_alone() {
    let place = Place::new();
    let draw = |file: &str, arguments: &[&str]| {
        let report = place.json(&render("four", file, &[SMALL, arguments, &["--json"]].concat()));
        (Frame::load(&place.path(file)).unwrap(), report)
    };
    let (plain, report) = draw("plain.exr", &[]);
    assert_eq!((&report["samples_per_pixel"], &report["scale"]), (&1.into(), &1.0.into()));
    let (same, _) = draw("same.exr", &["--samples", "1", "--scale", "1"]);
    assert!(same == plain);
    let (other, report) = draw("other.exr", &["--samples", "4", "--scale", "1/2"]);
    assert_eq!((&report["samples_per_pixel"], &report["scale"]), (&4.into(), &0.5.into()));
    assert!(other != plain);
    for kernel in ["course", "plain", "reference"] {
        for (option, value) in [("--samples", "2"), ("--scale", "0.5")] {
            let arguments = [SMALL, &["--algorithm", kernel, option, value]].concat();
            place.assert_refused_in_one_line(&render("four", "x.exr", &arguments), 2, &[option, "is for the whitted"]);
        }
    }
}

#[test]
fn a_refusal_leaves_an_older_picture_as_it_was() {
    let place = Place::new();
    fs::write(place.path("x.png"), "older").unwrap();
    place.assert_refused_in_one_line(&render("no such scene", "x.png", SMALL), 2, &["no such scene"]);
    assert_eq!(fs::read(place.path("x.png")).unwrap(), b"older");
}

#[test]
fn an_unknown_picture_format_is_refused() {
    let place = Place::new();
    for output in ["x.jpg", "x", ".png"] {
        place.assert_refused_in_one_line(&render("four", output, SMALL), 2, &[output, ".png or .exr"]);
    }
}

#[test]
fn a_device_that_is_not_there_is_refused_with_the_list_of_those_that_are() {
    let place = Place::new();
    let devices = gpu::devices().unwrap();
    for wanted in ["nonsense", "99"] {
        let mut parts = vec![wanted];
        parts.extend(devices.iter().map(|device| device.name.as_str()));
        place.assert_refused_in_one_line(&render("four", "x.png", &["--device", wanted]), 2, &parts);
        place.assert_command_refused(
            place.command(&render("four", "x.png", SMALL)).env("ZERKALO_DEVICE", wanted),
            2,
            &parts,
        );
    }
}

#[test]
fn the_environment_chooses_the_device_and_the_option_overrules_it() {
    let place = Place::new();
    let devices = gpu::devices().unwrap();
    let device = devices.iter().find(|device| device.lacks.is_empty()).expect("a usable device");
    // Part of the name, in other letters.
    let part: String = device.name.chars().take(4).collect::<String>().to_uppercase();
    let run = Run::of(place.command(&render("four", "x.png", SMALL)).env("ZERKALO_DEVICE", part).output().unwrap());
    assert_eq!(run.code, Some(0), "{run:?}");
    let overruled = render("four", "x.png", &["--size", "16x7", "--device", &device.name]);
    let run = Run::of(place.command(&overruled).env("ZERKALO_DEVICE", "nonsense").output().unwrap());
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(run.stdout.contains(&device.name), "{}", run.stdout);
}

#[test]
fn wrong_arguments_are_refused_by_name() {
    let place = Place::new();
    let wrong: [(&[&str], &str); 21] = [
        (&["--size", "0x5"], "--size"),
        (&["--size", "16385x1"], "--size"),
        (&["--size", "12"], "--size"),
        (&["--size", "-1x5"], "-1"),
        (&["--size", "99999999999999999999x1"], "--size"),
        (&["--repeat", "0"], "--repeat"),
        (&["--repeat", "-1"], "-1"),
        (&["--repeat", "many"], "--repeat"),
        (&["--max-depth", "0"], "--max-depth"),
        (&["--max-depth", "1001"], "--max-depth"),
        (&["--samples", "0"], "--samples"),
        (&["--samples", "1.5"], "--samples"),
        (&["--scale", "0.2"], "--scale"),
        (&["--scale", "3/2"], "--scale"),
        (&["--error", "1/0"], "--error"),
        (&["--error", "less"], "--error"),
        (&["--algorithm", "none"], "--algorithm"),
        (&["--precision", "f16"], "--precision"),
        (&["--unknown"], "--unknown"),
        (&["--device"], "--device"),
        (&["another.toml"], "another.toml"),
    ];
    for (arguments, part) in wrong {
        let run = place.run(&render("four", "x.png", arguments));
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(run.stderr.starts_with("error: ") && run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
    }
    for arguments in [&["render", "four"][..], &["render"], &["compare", "a.png"], &["paint"]] {
        assert_eq!(place.run(arguments).code, Some(2), "{arguments:?}");
    }
    assert_eq!(place.names(), BTreeSet::new());
}

#[test]
fn a_folder_that_is_not_there_is_the_machines_fault_and_told_before_the_render() {
    let place = Place::new();
    // At full size and depth 1000 it would take minutes to get as far as the writing.
    let arguments = render("grid-sphere-100", "nowhere/x.png", &["--max-depth", "1000"]);
    place.assert_refused_in_one_line(&arguments, 1, &["nowhere/x.png", "not a folder"]);
}

#[test]
fn a_machine_without_a_driver_is_told_so() {
    let place = Place::new();
    let without_driver = |arguments: &[&str]| {
        let mut command = place.command(arguments);
        command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
        place.assert_command_refused(&mut command, 1, &["no Vulkan driver found"]);
    };
    without_driver(&render("four", "x.png", SMALL));
    without_driver(&["devices"]);
    without_driver(&["devices", "--json"]);
}

#[test]
fn without_a_word_and_a_display_the_showcase_is_rendered_and_said_so() {
    let place = Place::new();
    let run = Run::of(place.command(&[]).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap());
    assert_eq!(run.code, Some(0));
    assert!(run.stderr.starts_with("zerkalo: no display here") && run.stderr.lines().count() == 1, "{}", run.stderr);
    assert!(run.stdout.contains("zerkalo.png"), "{}", run.stdout);
    let frame = Frame::load(&place.path("zerkalo.png")).unwrap();
    assert_eq!((frame.width(), frame.height()), (1621, 701));
    assert!(frame.pixels().windows(2).any(|pair| pair[0] != pair[1]), "nothing is on it");
}

#[test]
fn devices_lists_them_for_programs_and_for_people() {
    let place = Place::new();
    let devices = place.json(&["devices", "--json"]);
    let devices = devices.as_array().unwrap();
    assert!(!devices.is_empty());
    let text = place.run(&["devices"]);
    assert_eq!((text.code, text.stderr.as_str()), (Some(0), ""));
    // What its arithmetic was found to be, and its limits, are indented below each device that can be used.
    let (below, lines): (Vec<_>, Vec<_>) = text.stdout.lines().partition(|line| line.starts_with(' '));
    assert_eq!(lines.len(), devices.len());
    let usable = devices.iter().filter(|device| device["lacks"].as_array().is_some_and(Vec::is_empty)).count();
    assert_eq!(below.len(), 3 * usable, "{below:?}");
    assert_eq!(below.iter().filter(|line| line.contains("sums and products exact")).count(), 2 * usable, "{below:?}");
    for (index, (device, line)) in devices.iter().zip(lines).enumerate() {
        for key in ["index", "name", "kind", "driver", "api_version", "lacks", "f32_arithmetic", "f64_arithmetic"] {
            assert!(keys(device).contains(key), "{key} is missing in {device}");
        }
        assert_eq!(device["index"], index);
        assert!(device["lacks"].is_array());
        assert!(line.contains(device["name"].as_str().unwrap()), "{line}");
    }
    assert_eq!(text.stdout.matches("the default").count(), 1, "{}", text.stdout);
}

#[test]
fn gallery_lists_every_name_and_writes_the_committed_files() {
    let place = Place::new();
    let run = place.run(&["gallery"]);
    let listed: Vec<_> = run.stdout.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let entries = gallery::entries().into_iter().chain(gallery::families());
    let names: Vec<_> = entries.map(|entry| entry.name).collect();
    assert_eq!(listed, names);

    let run = place.run(&["gallery", "--write", "scenes"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let written = place.path("scenes");
    assert_eq!(names_in(&written), names_in(&committed));
    for name in names_in(&written) {
        let text = |folder: &Path| fs::read_to_string(folder.join(&name)).unwrap().replace("\r\n", "\n");
        assert!(text(&written) == text(&committed), "{name}");
    }

    fs::write(place.path("file"), "").unwrap();
    place.assert_refused_in_one_line(&["gallery", "--write", "file"], 1, &["could not create folder file"]);
}

#[test]
fn a_corrupt_pipeline_cache_is_ignored_and_replaced() {
    let place = Place::new();
    fs::create_dir(place.path("cache")).unwrap();
    let run = || {
        let mut command = place.command(&render("four", "x.exr", SMALL));
        let run = Run::of(command.env("XDG_CACHE_HOME", place.path("cache")).output().unwrap());
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        fs::read(place.path("x.exr")).unwrap()
    };
    let picture = run();
    let [cache] = &pipeline_caches(&place.path("cache"))[..] else { panic!("one cache file is expected") };
    let whole = fs::read(cache).unwrap();
    let noise: Vec<u8> = (0..whole.len()).map(|i| (i * 151 % 256) as u8).collect();
    for damaged in [&noise[..], &whole[..whole.len() / 2], b"", &[whole.as_slice(), &noise].concat()] {
        fs::write(cache, damaged).unwrap();
        assert!(run() == picture, "another picture");
        assert_eq!(fs::read(cache).unwrap()[..8], whole[..8], "the cache is made anew");
    }
}

fn pipeline_caches(cache_home: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(cache_home.join("zerkalo")) else { return Vec::new() };
    let paths = entries.map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|extension| extension == "bin")).collect()
}

/// As programs end that SIGPIPE kills, and as their shell reports it; `zerkalo view --observe` is among the window's
/// tests.
#[test]
fn a_reader_that_went_away_ends_a_command_without_a_word() {
    let place = Place::new();
    place.json(&render("four", "old.png", &["--size", "16x7", "--json"]));
    let commands: [&[&str]; 10] = [
        &["gallery"],
        &["devices"],
        &["devices", "--json"],
        &["plan", "four"],
        &["--help"],
        &["render", "--help"],
        &["--version"],
        &["compare", "old.png", "old.png"],
        &["convert", "four", "four.toml"],
        &render("four", "x.png", SMALL),
    ];
    for arguments in commands {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let run = Run::of(place.command(arguments).stdout(writer).stderr(Stdio::piped()).output().unwrap());
        assert_eq!((run.code, run.stderr.as_str()), (Some(141), ""), "{arguments:?}");
    }
    // What is written does not depend on who listens.
    assert_eq!(place.names(), ["four.toml", "old.png", "x.png"].map(str::to_owned).into());
    let [old, new] = ["old.png", "x.png"].map(|name| fs::read(place.path(name)).unwrap());
    assert!(old == new, "the picture is cut short");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_under_the_output_is_told_in_a_line() {
    let place = Place::new();
    place.json(&render("four", "x.png", &["--size", "16x7", "--json"]));
    let commands: [&[&str]; 6] = [
        &["gallery"],
        &["plan", "four"],
        &["devices"],
        &["devices", "--json"],
        &["compare", "x.png", "x.png"],
        &render("four", "x.png", &["--size", "16x7", "--json"]),
    ];
    for arguments in commands {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let run = Run::of(place.command(arguments).stdout(full).stderr(Stdio::piped()).output().unwrap());
        assert_eq!(run.code, Some(1), "{arguments:?}: {run:?}");
        let line = run.only_line();
        assert!(line.contains("could not write ") && line.contains("No space left"), "{arguments:?}: {line}");
    }
}

/// The first Ctrl-C stops between two tiles; the picture asked for and its temporary file are not there then, and
/// an older picture of the name is as it was.
#[cfg(unix)]
#[test]
fn an_interrupt_stops_the_render_and_leaves_nothing() {
    let place = Place::new();
    fs::create_dir(place.path("cache")).unwrap();
    fs::write(place.path("older.png"), "older").unwrap();
    for output in ["x.png", "older.png"] {
        // Repeated, so that no device is done before it is interrupted.
        let arguments = render("grid-sphere-100", output, &["--repeat", "1000000"]);
        let before = place.names();
        let cache_home = place.path("cache");
        pipeline_caches(&cache_home).iter().for_each(|path| fs::remove_file(path).unwrap());
        let mut command = place.command(&arguments);
        command.env("XDG_CACHE_HOME", &cache_home).stdout(Stdio::piped()).stderr(Stdio::piped());
        let program = command.spawn().unwrap();
        // The cache file is written when the kernel is compiled: the first render is next.
        wait_until("the kernel is compiled", || !pipeline_caches(&cache_home).is_empty());
        let run = interrupted(program);
        assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
        assert!(run.only_line().contains("stopped"), "{run:?}");
        assert_eq!(place.names(), before);
    }
    assert_eq!(fs::read(place.path("older.png")).unwrap(), b"older");
}

#[test]
fn plan_tells_what_runs_what_is_left_out_and_why() {
    let place = Place::new();
    let report = place.json(&["plan", "corridor", "--error", "1/510", "--size", "64x28", "--json"]);
    let documented =
        ["bound", "bounds", "compiled", "cuts", "decisions", "device", "error", "height", "scene", "warning", "width"];
    assert_eq!(keys(&report), documented.into());
    assert_eq!((&report["scene"], &report["width"], &report["height"]), (&"corridor".into(), &64.into(), &28.into()));
    let (error, bound) = (report["error"].as_f64().unwrap(), report["bound"].as_f64().unwrap());
    assert!(error == 1.0 / 510.0 && bound > 0.0 && bound <= error, "{report}");
    let decisions = report["decisions"].as_array().unwrap();
    let about: Vec<_> = decisions.iter().map(|decision| decision["what"].as_str().unwrap()).collect();
    for what in ["spheres", "boxes", "lights", "shadow rays", "highlights", "generations", "precision", "error"] {
        assert!(about.contains(&what), "{what} is not in {about:?}");
    }
    for decision in decisions {
        assert_eq!(keys(decision), ["choice", "saves", "what", "why"].into());
        assert!(decision["why"].as_str().is_some_and(|why| !why.is_empty()), "{decision}");
    }

    let run = place.run(&["plan", "corridor", "--error", "0.002"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_eq!(run.stdout.lines().count(), 1 + decisions.len());
    assert!(run.stdout.starts_with("corridor at 1621x701 on "), "{}", run.stdout);
    assert!(about.iter().all(|what| run.stdout.contains(what)) && run.stdout.contains("; saves "), "{}", run.stdout);
}

#[test]
fn render_tells_the_bound_on_what_an_allowed_error_changed() {
    let place = Place::new();
    let within = |error| place.json(&render("several", "x.exr", &["--size", "16x7", "--json", "--error", error]));
    assert_eq!(within("0")["error_bound"], 0.0);
    let bound = within("1/50")["error_bound"].as_f64().unwrap();
    assert!(bound > 0.0 && bound <= 1.0 / 50.0, "{bound}");
    assert_eq!(within("1e-4")["precision"], "f64", "f32 is not known to keep that");
    let run = place.run(&render("several", "x.exr", &["--size", "16x7", "--error", "1/50"]));
    assert!(run.stdout.contains("at most ") && run.stdout.lines().count() == 1, "{}", run.stdout);
    for kernel in ["course", "reference"] {
        let arguments = [SMALL, &["--algorithm", kernel, "--error", "1/50"]].concat();
        place.assert_refused_in_one_line(&render("four", "y.exr", &arguments), 2, &["whitted", "error"]);
    }
}

#[test]
fn plan_needs_no_device() {
    let place = Place::new();
    let mut command = place.command(&["plan", "four", "--json"]);
    command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
    let without_driver = Run::of(command.output().unwrap());
    let unasked = place.run(&["plan", "four", "--json", "--no-device"]);
    for run in [&without_driver, &unasked] {
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{run:?}");
        let report: Value = serde_json::from_str(&run.stdout).unwrap();
        assert_eq!((&report["device"], &report["bound"]), (&Value::Null, &0.0.into()));
    }
    assert_eq!(without_driver.stdout, unasked.stdout);
    place.assert_refused_in_one_line(
        &["plan", "four", "--precision", "f64", "--no-device"],
        2,
        &["f64", "shaderFloat64"],
    );
}

#[test]
fn plan_refuses_wrong_wishes() {
    let place = Place::new();
    for wrong in ["1/0", "x", "nan", "inf", "1/-2"] {
        let run = place.run(&["plan", "four", "--error", wrong]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{wrong}");
        assert!(run.stderr.contains("--error") && run.stderr.contains("1/510"), "{}", run.stderr);
    }
    for arguments in [&["--max-depth", "0"][..], &["--size", "0x1"], &["--precision", "f16"], &["--error"]] {
        assert_eq!(place.run(&[&["plan", "four"], arguments].concat()).code, Some(2), "{arguments:?}");
    }
    place.assert_refused_in_one_line(&["plan", "no such scene"], 2, &["no such scene", "zerkalo gallery"]);
    place.assert_refused_in_one_line(&["plan", "four", "--device", "nonsense"], 2, &["nonsense"]);
}

#[test]
fn stability_prints_a_row_a_case_and_fails_only_for_the_accurate_kernel() {
    let place = Place::new();
    let files = ["-o", "sheet.png", "-o", "table.json", "-o", "table.csv", "-o", "table.md"];
    let report = place.json(&[&["stability", "--quick", "--algorithm", "course", "--json"][..], &files].concat());
    assert_eq!(keys(&report), ["cases", "complete", "device", "driver", "quick"].into());
    let cases = report["cases"].as_array().unwrap();
    assert!(cases.len() > 80);
    for case in cases {
        assert_eq!(keys(case), ["bound", "id", "kernel", "measured", "pass", "precision", "what"].into());
    }
    let failed = cases.iter().filter(|case| case["pass"] == false).count();
    assert!(failed > 20, "the course's kernel fails much, and that is no failure of the program");
    assert!(Frame::load(&place.path("sheet.png")).is_ok());
    let [json, csv, markdown] = ["json", "csv", "md"]
        .map(|extension| fs::read_to_string(place.path("table").with_extension(extension)).unwrap());
    assert_eq!(serde_json::from_str::<Value>(&json).unwrap(), report);
    let head = "case,kernel,precision,pass,what,measured,bound,quick,device,driver";
    assert_eq!((csv.lines().next(), csv.lines().count()), (Some(head), 1 + cases.len()));
    let failures = |text: &str, mark: &str| text.lines().filter(|line| line.contains(mark)).count();
    assert_eq!((failures(&csv, ",false,"), failures(&markdown, " FAIL ")), (failed, failed));
}

#[test]
fn stability_and_validate_refuse_what_they_cannot_do() {
    let place = Place::new();
    for (arguments, words) in [
        (&["stability", "--algorithm", "course", "--precision", "f64"][..], "f32 only"),
        (&["stability", "--algorithm", "reference"], "invalid value"),
        (&["stability", "-o", "sheet.jpg"], "sheet.jpg"),
        (&["validate", "-o", "chart.svg"], "chart.svg"),
    ] {
        let run = place.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{}", run.stderr);
        assert!(run.stderr.contains(words), "{}", run.stderr);
    }
}
