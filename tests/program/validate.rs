//! `zerkalo validate` as a user meets it.

use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::place::{Run, interrupted};
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
    assert_eq!((output.status.code(), stderr.as_str()), (Some(0), ""));
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
    assert_eq!(tried("GPU-assisted"), ["core", "synchronization", "hazards", "gpu-assisted"]);
    assert_eq!(tried("best practices"), ["core", "synchronization", "hazards", "best-practices"]);

    let passes = report["passes"].as_array().unwrap();
    assert_eq!(passes.len(), 2);
    for (pass, validation) in passes.iter().zip(["GPU-assisted", "best practices"]) {
        assert_eq!((&pass["validation"], &pass["in_window"]), (&validation.into(), &false.into()));
        assert!(pass["runs"].as_u64().unwrap() > 20 && pass["begun"] == pass["runs"], "{pass}");
    }
    assert!(report["no_window"].as_str().unwrap().contains("no window can be opened here"));
    for switch in report["switches"].as_array().unwrap() {
        assert!(switch["on"].as_u64().unwrap() > 0 && switch["off"].as_u64().unwrap() > 0, "{switch}");
    }
    let allowed = report["allowed"].as_array().unwrap();
    assert!(allowed.iter().any(|allowed| allowed["id_part"] == "specialuse-extension-debugging"
        && allowed["count"].as_u64().unwrap() > 0
        && allowed["why"].as_str().unwrap().len() > 20));
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_was_found() {
    let program = command(&[]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // The first runs are under way then; all of them take minutes.
    thread::sleep(Duration::from_secs(3));
    let Run { code, stdout, stderr } = interrupted(program);
    assert_eq!((code, stderr.as_str()), (Some(130), "zerkalo: stopped\n"));
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
