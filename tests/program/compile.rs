//! `zerkalo plan --compile`: what compilers make of kernels. Mesa's RADV compiles for GPUs that are not there.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::place::{Place, Run};

/// A GPU that Mesa knows since 22.
const FAMILY: &str = "navi21";

/// What RADV makes of a scene's kernels for [`FAMILY`].
fn compiled(place: &Place, arguments: &[&str]) -> Run {
    let all = [&["plan"], arguments, &["--compile", "--json", "--device", "RADV"][..]].concat();
    let mut program = place.command(&all).env("RADV_FORCE_FAMILY", FAMILY).spawn().unwrap();
    // A compiler may not come to an end: what was wrong with RADV of Mesa 25 and a scene without solids.
    let start = Instant::now();
    while program.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(120) {
            program.kill().unwrap();
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    Run::of(program.wait_with_output().unwrap())
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

/// Every kernel, and scenes in which the accurate one is as small or as large as it comes. RADV takes seconds for each.
const KERNELS: [(&str, &str, &[&str]); 8] = [
    ("start", "whitted_f32", &["--algorithm", "whitted", "--precision", "f32"]),
    ("squares-100", "whitted_f32", &["--algorithm", "whitted", "--precision", "f32"]),
    ("glass", "whitted_f32", &["--algorithm", "whitted", "--precision", "f32"]),
    ("four", "course", &["--algorithm", "course"]),
    ("four", "whitted_f32", &["--algorithm", "whitted", "--precision", "f32"]),
    ("four", "whitted_f64", &["--algorithm", "whitted", "--precision", "f64"]),
    ("four", "ssr", &["--algorithm", "ssr"]),
    ("four", "path_f32", &["--algorithm", "path", "--precision", "f32"]),
];

/// So many leave room for six subgroups on a SIMD of Navi 21.
const MOST_REGISTERS: u64 = 168;

/// Of kernels in f32, none keeps registers in memory, and only the rays that wait in a scene of glass are there. How
/// much of it is f64's is told in docs/performance.md.
#[test]
fn every_kernel_is_compiled_for_gpus_and_none_in_f32_spills() {
    let place = Place::new();
    if compiled(&place, &["squares-1", "--algorithm", "course"]).code != Some(0) {
        eprintln!("skipped: there is no RADV here that compiles for {FAMILY}");
        return;
    }
    for (scene, kernel, arguments) in KERNELS {
        let run = compiled(&place, &[&[scene], arguments].concat());
        assert_eq!(run.code, Some(0), "{scene} {kernel}: {}", run.stderr);
        let executables = executables(&run);
        assert!(!executables.is_empty() && executables.iter().all(|(name, _)| name.starts_with(kernel)));
        for (name, figures) in executables {
            assert!(figures["VGPRs"] > 0 && figures["Instructions"] > 0, "{name}: {figures:?}");
            if !kernel.ends_with("f64") {
                assert_eq!(figures["Spilled VGPRs"], 0, "{scene} {name}");
                assert!(figures["VGPRs"] <= MOST_REGISTERS, "{scene} {name}: {figures:?}");
                let waits = scene == "glass";
                assert!(waits || figures["Scratch size"] == 0, "{scene} {name}: {figures:?}");
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
