//! `zerkalo fps --in-window`, on pictures so small that its figures are of no use.

use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;
use zerkalo::frame::display_value;

use crate::driver::{Desk, Locale};

#[test]
fn frames_are_counted_in_a_window_and_the_table_says_so() {
    let desk = Desk::new(Locale::English, [700, 500]);
    let arguments = ["fps", "--in-window", "--size", "64x28", "--counts", "10", "--seconds", "0.05", "--validate"];
    let output = desk.program(&[&arguments[..], &["-o", "fps.md", "--json"]].concat()).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    assert!(stderr.is_empty() || stderr.contains("interquartile"), "{stderr}");
    let table: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&table["plan"]["in_window"], &table["clock"]), (&true.into(), &"wall".into()));
    let mode = table["machine"]["present_mode"].as_str().unwrap();
    // Xvfb offers all of them.
    assert_eq!(mode, "mailbox");
    let cells = table["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 4 * 2);
    for cell in cells {
        let samples = |key: &str| serde_json::from_value::<Vec<u64>>(cell[key].clone()).unwrap();
        let (gpu, wall) = (samples("gpu_samples_ns"), samples("wall_samples_ns"));
        assert!(gpu.len() == wall.len() && wall.len() >= 2, "{cell}");
        assert!(gpu.iter().zip(&wall).all(|(gpu, wall)| *gpu > 0 && gpu < wall), "tracing is a part of it: {cell}");
    }
    let markdown = std::fs::read_to_string(desk.path("fps.md")).unwrap();
    assert!(markdown.contains("in a window of the picture's size: every frame is shown, present mode mailbox"));
    assert!(markdown.contains("## Course: frames a second in the window"), "{markdown}");
}

#[test]
fn what_is_measured_is_what_the_window_shows_and_ctrl_c_stops_it() {
    let desk = Desk::new(Locale::English, [700, 500]);
    let size = [320, 138];
    let rendered = desk.render_by("course", "grid-sphere-10", size);
    let arguments =
        ["fps", "--in-window", "--size", "320x138", "--counts", "10", "--seconds", "600", "--algorithm", "course"];
    let mut program = desk.program(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let deadline = Instant::now() + Duration::from_secs(60);
    let is_shown = || {
        let desktop = desk.display.screenshot(&desk.path("desktop.png"));
        // Without a window manager the window is in the corner. The device rounds to eight bits by itself.
        let shown = desktop.rows().take(138).flat_map(|row| &row[..320]);
        shown.zip(rendered.pixels()).all(|(shown, rendered)| {
            let channels = shown.iter().zip(rendered);
            channels.map(|(a, b)| display_value(*a).abs_diff(display_value(*b))).all(|off| off <= 1)
        })
    };
    while !is_shown() {
        assert!(Instant::now() < deadline, "the picture is not to be seen");
        thread::sleep(Duration::from_millis(100));
    }
    let pid = program.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = loop {
        if program.try_wait().unwrap().is_some() {
            break program.wait_with_output().unwrap();
        }
        assert!(Instant::now() < deadline, "it does not stop");
        thread::sleep(Duration::from_millis(10));
    };
    assert_eq!(output.status.code(), Some(130));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.lines().last().unwrap().contains("stopped, 0 of 4 places"), "{stderr}");
}

#[test]
fn without_a_display_one_line_says_that_nothing_need_be_shown() {
    let desk = Desk::new(Locale::English, [700, 500]);
    let mut command = desk.program(&["fps", "--in-window", "--size", "16x7"]);
    let output = command.env_remove("DISPLAY").output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr.starts_with("zerkalo: no window can be opened here (") && stderr.lines().count() == 1, "{stderr}");
    assert!(stderr.contains("without --in-window nothing need be shown"), "{stderr}");
}
