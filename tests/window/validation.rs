//! `zerkalo validate` where there is a display.

use std::fs;

use serde_json::Value;

use crate::driver::{Desk, Locale};

#[test]
fn best_practices_have_nothing_to_say_of_what_a_window_shows() {
    let desk = Desk::new(Locale::English, [700, 500]);
    let folder = tempfile::tempdir().unwrap();
    let files = ["json", "csv", "md"].map(|extension| folder.path().join("found").with_extension(extension));
    let outputs = files.iter().flat_map(|path| ["-o", path.to_str().unwrap()]).collect::<Vec<_>>();
    let arguments = [&["validate", "--quick", "--validate", "best-practices", "--json"][..], &outputs].concat();
    let output = desk.program(&arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let [json, csv, markdown] = files.map(|path| fs::read_to_string(path).unwrap());
    assert_eq!(serde_json::from_str::<Value>(&json).unwrap(), report);
    assert_eq!(csv, "severity,id,count,text,runs,quick,device,driver\n", "there is no message");
    assert!(markdown.contains("| best practices |") && markdown.contains("messages: 0"), "{markdown}");
    assert_eq!((&report["message_count"], &report["no_window"]), (&0.into(), &Value::Null));
    let passes = report["passes"].as_array().unwrap();
    let [off_screen, in_window] = &passes[..] else { panic!("{passes:?}") };
    assert_eq!(
        (&off_screen["validation"], &in_window["validation"]),
        (&"best practices".into(), &"best practices".into())
    );
    assert_eq!((&off_screen["in_window"], &in_window["in_window"]), (&false.into(), &true.into()));
    // Every kernel.
    assert!(in_window["runs"].as_u64().unwrap() >= 4 && in_window["begun"] == in_window["runs"], "{in_window}");
}
