//! `zerkalo validate` as a user meets it.

use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::place::interrupted;
use serde_json::Value;

/// Where there is no display.
fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_zerkalo"));
    command.arg("validate").args(arguments);
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(variable);
    }
    command
}

#[test]
fn everything_drawn_is_drawn_without_a_message_and_every_check_was_on() {
    let output = command(&["--quick", "--json"]).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    // A line every half minute tells how far it is, and there is nothing else to tell.
    assert!(stderr.lines().all(|line| line.starts_with("progress: ")), "{stderr}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&report["message_count"], &report["messages"]), (&0.into(), &Value::Array(Vec::new())));
    assert_eq!((&report["complete"], &report["quick"]), (&true.into(), &true.into()));
    assert_eq!(report["layer"]["name"], "VK_LAYER_KHRONOS_validation");

    let checks: Vec<_> = report["checks"].as_array().unwrap().iter().collect();
    assert!(checks.iter().all(|tried| tried["works"] == true), "{checks:?}");
    let tried = |validation: &str| -> Vec<&str> {
        let of_kind = checks.iter().filter(|tried| tried["validation"] == validation);
        of_kind.map(|tried| tried["check"].as_str().unwrap()).collect()
    };
    assert_eq!(tried("GPU-assisted"), ["gpu-assisted", "hazards"]);
    assert_eq!(tried("core"), ["core", "synchronization", "hazards"]);
    assert_eq!(tried("best practices"), ["best-practices", "hazards"]);

    let passes = report["passes"].as_array().unwrap();
    assert_eq!(passes.len(), 3);
    // Each kernel at least.
    for (pass, (validation, least)) in passes.iter().zip([("GPU-assisted", 4), ("core", 20), ("best practices", 20)]) {
        assert_eq!((&pass["validation"], &pass["in_window"]), (&validation.into(), &false.into()));
        assert!(pass["runs"].as_u64().unwrap() >= least && pass["begun"] == pass["runs"], "{pass}");
    }
    assert!(report["no_window"].as_str().unwrap().contains("no window can be opened here"));
    for switch in report["switches"].as_array().unwrap() {
        assert!(switch["on"].as_u64().unwrap() > 0 && switch["off"].as_u64().unwrap() > 0, "{switch}");
    }
    // The layer says of debug names, whatever its version, that they are for debugging.
    let remarks = report["remarks"].as_array().unwrap();
    assert!(remarks.iter().any(|remark| remark["id"].as_str().unwrap().contains("specialuse-extension")
        && remark["severity"] == "warning"
        && remark["count"].as_u64().unwrap() > 0
        && remark["why"].as_str().unwrap().len() > 20));
    assert!(report["layer"]["set_up_by"].as_str().unwrap().starts_with("VK_EXT_"));
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_was_found() {
    let program = command(&[]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // The first runs are under way then; all of them take minutes.
    thread::sleep(Duration::from_secs(3));
    let run = interrupted(program);
    assert_eq!((run.code, run.complaints()), (Some(130), vec!["zerkalo: stopped"]));
    let stdout = &run.stdout;
    assert!(stdout.contains("of them were begun") && stdout.contains("messages: 0"), "{stdout}");
}

#[test]
fn what_cannot_be_validated_is_refused() {
    let refused = |command: &mut Command, code: i32, part: &str| {
        let output = command.output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.as_slice()), (Some(code), &b""[..]), "{stderr}");
        assert!(stderr.contains(part) && (code == 1 || stderr.lines().count() >= 1), "{stderr}");
    };
    refused(&mut command(&["--device", "nonsense"]), 2, "nonsense");
    refused(&mut command(&["four"]), 2, "four");
    refused(command(&[]).env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent"), 1, "driver");
}
