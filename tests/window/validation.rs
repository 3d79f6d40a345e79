//! `zerkalo validate` where there is a display.

use serde_json::Value;

use crate::driver::{Desk, Locale};

#[test]
fn best_practices_have_nothing_to_say_of_what_a_window_shows() {
    let desk = Desk::new(Locale::English, [700, 500]);
    let arguments = ["validate", "--quick", "--validate", "best-practices", "--json"];
    let output = desk.program(&arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&report["message_count"], &report["no_window"]), (&0.into(), &Value::Null));
    let passes = report["passes"].as_array().unwrap();
    let [off_screen, in_window] = &passes[..] else { panic!("{passes:?}") };
    assert_eq!((&off_screen["in_window"], &in_window["in_window"]), (&false.into(), &true.into()));
    // Every kernel.
    assert!(in_window["runs"].as_u64().unwrap() >= 4 && in_window["begun"] == in_window["runs"], "{in_window}");
}
