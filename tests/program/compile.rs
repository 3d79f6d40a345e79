//! `zerkalo plan --compile`: what compilers make of kernels. Mesa's RADV compiles for GPUs that are not there.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::place::{Place, Run};

/// Of two generations, both known to Mesa since 22.
const FAMILIES: [&str; 2] = ["navi21", "vega10"];

/// What RADV makes of a scene's kernels for a GPU of this family.
fn compiled(place: &Place, family: &str, arguments: &[&str]) -> Run {
    let all = [&["plan"], arguments, &["--compile", "--json", "--device", "RADV"][..]].concat();
    Run::of(place.command(&all).env("RADV_FORCE_FAMILY", family).output().unwrap())
}

/// Each executable's kernel and figures, by their names.
fn executables(run: &Run) -> Vec<(String, BTreeMap<String, u64>)> {
    let told: Value = serde_json::from_str(&run.stdout).unwrap();
    let kernels = told["compiled"].as_array().unwrap();
    let of_kernel = |kernel: &Value| {
        let name = kernel["kernel"].as_str().unwrap().to_owned();
        let executables = kernel["executables"].as_array().unwrap().clone();
        executables.into_iter().map(move |executable| {
            let figure = |one: &Value| Some((one["name"].as_str()?.to_owned(), one["value"].as_u64()?));
            (name.clone(), executable["statistics"].as_array().unwrap().iter().filter_map(figure).collect())
        })
    };
    kernels.iter().flat_map(of_kernel).collect()
}

/// Of kernels in f32, none keeps registers in memory, and only the rays that wait in a scene of glass are there. How
/// much of it is f64's is told in docs/performance.md.
#[test]
fn every_kernel_is_compiled_for_gpus_and_none_in_f32_spills() {
    let place = Place::new();
    let in_f32: [(&str, &[&str]); 5] = [
        ("course", &["--algorithm", "course"]),
        ("whitted_plain", &["--algorithm", "plain"]),
        ("whitted_f32", &["--algorithm", "whitted", "--precision", "f32"]),
        ("ssr", &["--algorithm", "ssr"]),
        ("path_f32", &["--algorithm", "path", "--precision", "f32"]),
    ];
    let in_f64: [(&str, &[&str]); 2] = [
        ("whitted_f64", &["--algorithm", "whitted", "--precision", "f64"]),
        ("path_f64", &["--algorithm", "path", "--precision", "f64"]),
    ];
    for family in FAMILIES {
        if compiled(&place, family, &["squares-1"]).code != Some(0) {
            eprintln!("skipped: there is no RADV here that compiles for {family}");
            continue;
        }
        for scene in ["four", "squares-100", "glass"] {
            for (kernel, arguments) in in_f32.into_iter().chain(in_f64) {
                if (kernel, scene) == ("course", "glass") {
                    continue;
                }
                let run = compiled(&place, family, &[&[scene], arguments].concat());
                assert_eq!(run.code, Some(0), "{family} {scene} {kernel}: {}", run.stderr);
                let executables = executables(&run);
                assert!(!executables.is_empty() && executables.iter().all(|(name, _)| name.starts_with(kernel)));
                for (name, figures) in executables {
                    assert!(figures["VGPRs"] > 0 && figures["Instructions"] > 0, "{name}: {figures:?}");
                    if !kernel.ends_with("f64") {
                        assert_eq!(figures["Spilled VGPRs"], 0, "{family} {scene} {name}");
                        let waits = scene == "glass" && name.starts_with("whitted");
                        assert!(waits || figures["Scratch size"] == 0, "{family} {scene} {name}: {figures:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn what_a_driver_does_not_tell_is_said_and_without_a_device_nothing_is_compiled() {
    let place = Place::new();
    let text = place.run_well(&["plan", "start", "--compile", "--device", "llvmpipe"]);
    assert!(text.contains("compiled whitted_f32") && text.contains("this driver tells nothing of it"), "{text}");
    let told = place.json(&["plan", "start", "--device", "llvmpipe"]);
    assert!(told["compiled"].is_null());
    place.assert_refused(&["plan", "start", "--compile", "--no-device"], 2, &["--no-device"]);
}
