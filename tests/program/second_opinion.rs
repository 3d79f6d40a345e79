//! POV-Ray's pictures of the same scenes.

use std::fs;
use std::process::{Command, Stdio};

use glam::DVec3;
use serde_json::Value;

use crate::budget::random_scene;
use crate::place::Place;

/// Says so where POV-Ray is not installed.
fn has_povray() -> bool {
    let run = Command::new("povray").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    if run.is_err() {
        eprintln!("skipped: POV-Ray is not installed");
    }
    run.is_ok()
}

/// In `glass`, solids that let light through stand flush on the floor: of two surfaces in one place POV-Ray takes either.
const GALLERY: [&str; 18] = [
    "showcase",
    "fading",
    "room",
    "behind",
    "matt",
    "start",
    "sphere",
    "box",
    "cylinder",
    "cone",
    "four",
    "light",
    "corridor",
    "several",
    "grid-sphere-20",
    "grid-box-20",
    "grid-cylinder-20",
    "grid-cone-20",
];

#[test]
fn povray_agrees_on_the_gallery_and_on_random_scenes() {
    if !has_povray() {
        return;
    }
    let place = Place::new();
    let mut scenes: Vec<String> = GALLERY.map(str::to_owned).into();
    // Every fifth has lights of any strength, of which 16 bits show nothing; the even ones are rooms of mirrors, in which
    // nearly every pixel is beside an edge.
    for seed in (1..50).step_by(2).filter(|seed| seed % 5 != 4) {
        let mut scene = random_scene(seed);
        scene.lights.iter_mut().for_each(|light| light.intensity = light.intensity.min(DVec3::ONE));
        scene.max_depth = scene.max_depth.min(12);
        let name = format!("random-{seed}.toml");
        scene.save(&place.path(&name)).unwrap();
        scenes.push(name);
    }
    let mut arguments = vec!["second-opinion", "--size", "101x44", "--json", "-o", "table.csv", "--map", "map.png"];
    arguments.extend(scenes.iter().map(String::as_str));
    let told: Value = serde_json::from_str(&place.run_well(&arguments)).unwrap();
    let opinions = told["scenes"].as_array().unwrap();
    assert!(told["judge"].as_str().unwrap().contains("POV-Ray 3.7") && opinions.len() == scenes.len());
    for opinion in opinions {
        assert!(opinion["agrees"] == true && opinion["losses"].as_array().unwrap().is_empty(), "{opinion}");
        assert!(opinion["smooth"].as_u64().unwrap() > 1000, "{opinion}");
    }
    assert_eq!(fs::read_to_string(place.path("table.csv")).unwrap().lines().count(), 1 + scenes.len());
    assert!(place.path("map.png").exists());
}

/// A judge that never found a fault would prove nothing: here POV-Ray gets another scene than it should.
#[cfg(unix)]
#[test]
fn what_is_written_wrongly_is_found() {
    use std::os::unix::fs::PermissionsExt;
    if !has_povray() {
        return;
    }
    let place = Place::new();
    let faults = [
        "s/phong_size 5.0/phong_size 4.0/",
        "s/reflection { rgb 0.1/reflection { rgb 0.12/",
        "s/diffuse 0.1/diffuse 0.12/",
    ];
    for (number, fault) in faults.iter().enumerate() {
        let name = format!("judge-{number}");
        fs::write(
            place.path(&name),
            format!("#!/bin/sh\nsed -i '{fault}' scene.pov 2>/dev/null\nexec povray \"$@\"\n"),
        )
        .unwrap();
        fs::set_permissions(place.path(&name), fs::Permissions::from_mode(0o755)).unwrap();
        let judge = place.path(&name);
        let run = place.run(&["second-opinion", "four", "--size", "101x44", "--povray", judge.to_str().unwrap()]);
        assert_eq!(run.code, Some(1), "{fault}: {}{}", run.stdout, run.stderr);
        assert!(run.stderr.contains("differs by more than 1e-3 on four"), "{fault}: {}", run.stderr);
    }
}

#[test]
fn without_povray_it_is_said_how_to_get_it_and_a_file_for_it_is_written() {
    let place = Place::new();
    place.assert_refused(&["second-opinion", "four", "--povray", "no-such-program"], 1, &["apt install povray"]);
    place.run_well(&[
        "convert",
        "showcase",
        "out.pov",
        "--size",
        "64x28",
        "--exposure",
        "0.25",
        "--length-scale",
        "128",
    ]);
    let text = fs::read_to_string(place.path("out.pov")).unwrap();
    assert!(text.contains("+W64 +H28") && text.contains("1/4 of its brightness"), "{text}");
    assert!(text.contains("Lengths are 128 times"), "{text}");
    place.assert_refused(&["convert", "showcase", "out.toml", "--size", "64x28"], 2, &["are for a .pov file"]);
    place.assert_refused(&["render", "out.pov", "-o", "a.png"], 2, &["POV-Ray is written only"]);
}
