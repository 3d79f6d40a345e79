//! NFF files, as other programs write them.

use std::path::{Path, PathBuf};

use glam::DVec3;
use zerkalo::scene::format::{FORMATS, Note, NoteKind, Reading};
use zerkalo::scene::{Material, Projection, Scene, SceneError, Solid, SolidKind};

use crate::random::Random;

/// A view, a background, a light with a colour and a fill: nothing is assumed after it.
const HEAD: &str = "v from 1 2 5 at 1 2 1 up 0 1 0 angle 60 resolution 40 31\n\
                    b 0.1 0.2 0.3\n\
                    l 4 3 2 0.5 0.6 0.7\n\
                    f 1 0.5 0.25 0.8 0.125 20 0 1\n";

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenes/nff").join(name).with_extension("nff")
}

fn read(text: &str) -> Result<Reading, SceneError> {
    let format = FORMATS.iter().find(|format| format.extension == "nff").unwrap();
    format.read_stream(&mut text.as_bytes())
}

/// What `HEAD` and `text` hold, with the kinds of the notes.
fn after_head(text: &str) -> (Scene, Vec<NoteKind>) {
    let Reading { scene, notes, .. } = read(&format!("{HEAD}{text}")).unwrap();
    (scene, notes.iter().map(|note| note.kind).collect())
}

fn lone_solid(text: &str) -> Solid {
    let (scene, _) = after_head(text);
    let [primitive] = &scene.primitives[..] else { panic!("{scene:?}") };
    primitive.solid.clone()
}

#[test]
fn the_samples_of_the_procedural_databases_are_read_and_what_is_lost_is_counted() {
    let line = |name: &str, what: &str| {
        let notes = Scene::read(&sample(name)).unwrap().notes;
        notes.iter().map(Note::to_string).find(|note| note.contains(what)).unwrap_or_else(|| panic!("{notes:?}"))
    };
    // Spheres, boxes, cylinders, cones; lights.
    for (name, kinds, lights) in [
        ("balls-3", [820, 1, 0, 0], 3),
        ("lattice-3", [64, 0, 144, 0], 6),
        ("mount-2", [4, 0, 0, 0], 1),
        ("rings-2", [150, 1, 150, 0], 3),
        ("tree-3", [15, 1, 0, 0], 7),
    ] {
        let Reading { scene, size, .. } = Scene::read(&sample(name)).unwrap();
        let count = |kind: SolidKind| scene.primitives.iter().filter(|each| each.solid.kind() == kind).count();
        assert_eq!((SolidKind::ALL.map(count), scene.lights.len()), (kinds, lights), "{name}");
        assert_eq!((size, scene.background), (Some([512, 512]), DVec3::new(0.078, 0.361, 0.753)), "{name}");
        assert!(scene.validate().is_ok());
    }
    assert_eq!(line("tree-3", "truncated"), "line 23: a truncated cone is left out (15 times, here first)");
    assert_eq!(
        line("mount-2", "polygon"),
        "line 16: a polygon that is no rectangle is left out (32 times, here first)"
    );
    assert!(line("lattice-3", "bases").starts_with("line 18: an open cylinder or cone is drawn with its bases (144"));
    assert!(line("balls-3", "no colour").ends_with("(3 times, here first)"));
}

#[test]
fn the_view_is_between_the_centres_of_the_outer_rows() {
    let Reading { scene, size, notes } = read(HEAD).unwrap();
    assert_eq!((size, notes), (Some([40, 31]), Vec::new()));
    let camera = &scene.camera;
    assert_eq!((camera.position, camera.direction), (DVec3::new(1.0, 2.0, 5.0), DVec3::new(0.0, 0.0, -4.0)));
    assert_eq!((camera.up, camera.projection), (DVec3::Y, Projection::Centered));
    // The centre of the lowest of N rows is (N − 1)/N of the half field's tangent from the middle.
    let half_tan = (camera.vertical_fov_degrees / 2.0).to_radians().tan();
    assert!((half_tan * 30.0 / 31.0 - 30f64.to_radians().tan()).abs() < 1e-15);
    assert_eq!(scene.ambient_light, Scene::default().ambient_light);
}

#[test]
fn lights_and_fills_become_lights_and_materials() {
    let (scene, notes) = after_head("l 1 2 3\nl 4 5 6 s 0 0 0 1 f 0 1 0 0 1 9 .5 1.5 s 0 0 0 2");
    assert_eq!(notes, [NoteKind::Assumed], "of two lights told once");
    let intensities: Vec<_> = scene.lights.iter().map(|light| light.intensity).collect();
    let third = DVec3::splat(3f64.sqrt().recip());
    assert_eq!(intensities, [DVec3::new(0.5, 0.6, 0.7), third, third]);
    assert!(scene.lights.iter().all(|light| light.radius == 0.0 && light.distance_constant.is_none()));
    let materials = scene.primitives.iter().map(|each| each.material.clone()).collect::<Vec<_>>();
    let diffuse = Material { shininess: 20.0, ..Material::of_course(DVec3::new(1.0, 0.5, 0.25), 0.0, 0.8, 0.125) };
    let glass = Material {
        shininess: 9.0,
        transmission: 0.5,
        refractive_index: 1.5,
        ..Material::of_course(DVec3::Y, 0.0, 0.0, 1.0)
    };
    assert_eq!(materials, [diffuse, glass]);
}

#[test]
fn cylinders_cones_and_rectangles_become_solids() {
    let ends = [DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 3.0)];
    assert_eq!(lone_solid("c 0 1 0 .5 0 1 3 .5"), Solid::Cylinder { ends, radius: 0.5 });
    for (text, apex, axis) in [("c 0 1 0 4 0 1 3 0", ends[1], DVec3::NEG_Z), ("c 0 1 0 0 0 1 3 4", ends[0], DVec3::Z)] {
        let half_angle_degrees = (4f64 / 3.0).atan().to_degrees();
        let Solid::Cone { half_angle_degrees: angle, .. } = lone_solid(text) else { panic!("{text}") };
        assert!((angle - half_angle_degrees).abs() < 1e-13);
        assert_eq!(lone_solid(text), Solid::Cone { apex, axis, height: 3.0, half_angle_degrees: angle });
    }
    let plate = Solid::Box {
        center: DVec3::new(1.0, 2.0, -0.5),
        half_size: DVec3::new(3.0, 1.0, 0.0),
        rotation_degrees: DVec3::ZERO,
    };
    assert_eq!(lone_solid("p 4  -2 1 -.5  4 1 -.5  4 3 -.5  -2 3 -.5"), plate);
    assert_eq!(lone_solid("pp 4  -2 1 -.5 0 0 1  4 1 -.5 0 0 1  4 3 -.5 0 0 1  -2 3 -.5 0 0 1"), plate);
}

#[test]
fn strict_refuses_what_is_lost_and_takes_what_is_assumed() {
    for (text, is_lost) in [
        ("s 0 0 0 1", false),
        ("l 1 2 3", false),
        ("v from 0 0 9 at 0 0 0 up 0 1 0 angle 9 hither 1 resolution 9 9", true),
        ("c 0 0 0 1 0 0 1 1", true),
        ("c 0 0 0 1 0 0 1 2", true),
        ("p 3 0 0 0 1 0 0 0 1 0", true),
        ("p 5 0 0 0 1 0 0 1 1 0 0 1 0 0 .5 0", true),
        ("p 4 0 0 0 2 0 0 2 1 0 0 3 0", true),
        ("pp 4 0 0 0 0 0 1 2 0 0 0 0 1 2 1 0 0 0 1 0 1 0 0 0 1", true),
        ("f 1 1 1 1 .5 100000 0 1", true),
        ("f 1 1 1 1 0 100000 0 0", false),
        ("f 1 1 1 1 1.5 9 0 1", true),
        ("f 2 1 1 1 0 9 0 1", true),
        ("f 1 1 1 1 0 9 .5 0", true),
    ] {
        let reading = read(&format!("{HEAD}{text}")).unwrap();
        let strict = reading.clone().strict();
        assert_eq!(strict.is_err(), is_lost, "{text}: {:?}", reading.notes);
        if let Err(error) = strict {
            assert_eq!((error.line, error.is_input_error()), (Some(5), true), "{text}: {error}");
        }
    }
    let lines = "s 0 0 0 1 # hither\n\n#\n  # resolution\n c 0 0 0\t1\r\n0 0 1 1";
    assert_eq!(read(&format!("{HEAD}{lines}")).unwrap().strict().unwrap_err().line, Some(9), "comments are no words");
    let bare = read("s 0 0 0 1").unwrap();
    assert_eq!(bare.notes.len(), 3, "no view, no background, no fill: {:?}", bare.notes);
    assert!(bare.strict().is_ok());
}

#[test]
fn broken_files_are_refused_with_their_line() {
    for (text, part) in [
        ("x 1 2 3", "\"x\": must be one of v, b, l, f, c, s, p, pp"),
        ("1 2 3", "\"1\": must be one of"),
        ("sphere 0 0 0 1", "\"sphere\""),
        ("S 0 0 0 1", "\"S\""),
        ("\u{1b}[31m", "\"\\u{1b}[31m\""),
        ("s", "s: the file ends where a number must be"),
        ("s 0 0 0", "s: the file ends"),
        ("s 0 0 0 s", "s: \"s\": must be a finite number"),
        ("s 0 0 0 nan", "\"nan\": must be a finite number"),
        ("s 0 0 0 inf", "must be a finite number"),
        ("s 0 0 0 1e999", "must be a finite number"),
        ("s 0 0 0 0x10", "must be a finite number"),
        ("s 0 0 0 1,5", "must be a finite number"),
        ("s 0 0 0 -1", "radius = -1: only its inside"),
        ("s 0 0 0 0", "radius = 0: must be greater than 0"),
        ("s 1e39 0 0 1", "center = [1e39, 0, 0]"),
        ("c 0 0 0 1", "c: the file ends"),
        ("c 0 0 0 1 0 0 0 1", "two centres must be different"),
        ("c 0 0 0 0 0 0 1 0", "both radii are 0"),
        ("c 0 0 0 -1 0 0 1 -1", "radius = -1: only its inside"),
        ("c 0 0 0 1 0 0 1 -1", "radius = -1"),
        ("c 0 0 0 1 0 0 1e39 0", "apex"),
        ("c 0 0 0 1 0 0 1e-30 0", "half_angle_degrees = 90: must be between 0 and 90"),
        ("p", "p: the file ends"),
        ("p 2 0 0 0 1 1 1", "p: 2 corners: must be 3 or more"),
        ("p -4", "\"-4\": must be a whole number"),
        ("p 4.0", "\"4.0\": must be a whole number"),
        ("p 99999999999999999999", "must be a whole number"),
        ("p 18446744073709551615 0 0 0", "p: the file ends"),
        ("p 4 0 0 0 1 0 0 1 1 0 0 1", "p: the file ends"),
        ("pp 3 0 0 0 0 0 1 1 0 0 0 0 1 1 1 0", "pp: the file ends"),
        ("b 0 0", "b: the file ends"),
        ("b 0 0 -1", "background"),
        ("l 1 2", "l: the file ends"),
        ("l 1 2 3 4", "l: the file ends"),
        ("l 1 2 3 1 1 -1", "intensity"),
        ("f 1 1 1 1 1 1 1", "f: the file ends"),
        ("f 1 1 1 -1 1 1 1 1", "below 0"),
        ("f 1 -1 1 1 1 1 1 1", "below 0"),
        ("v", "v: from is missing"),
        ("v from 0 0 1", "v: at is missing"),
        ("v from 0 0 1 at 0 0 0", "v: up is missing"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0", "v: angle is missing"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0 angle 45", "v: resolution is missing"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0 angle 180 resolution 9 9", "angle = 180: must be between 0 and 180"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0 angle 0 resolution 9 9", "angle = 0"),
        ("v from 0 0 1 at 0 0 1 up 0 1 0 angle 45 resolution 9 9", "direction"),
        ("v from 0 0 1 at 0 0 0 up 0 0 1 angle 45 resolution 9 9", "up"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0 angle 45 resolution 1 1", "resolution = 1: must be from 2 to 16384"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0 angle 45 resolution 9 99999", "resolution = 99999"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0 angle 45 resolution 9", "resolution: the file ends"),
        ("v from 0 0 1 at 0 0 0 up 0 1 0 angle 45 resolution 9 9 yon 5", "\"yon\": must be one of"),
    ] {
        let error = read(&format!("{HEAD}{text}\n")).expect_err(text);
        assert!(error.what.contains(part) && error.line == Some(5), "{text}: {error}");
        assert!(error.is_input_error() && error.to_string().lines().count() == 1, "{text}: {error}");
    }
    let error = read(&format!("{HEAD}{}", "l 0 0 0\n".repeat(64))).unwrap_err();
    assert!(error.line == Some(68) && error.what.contains("at most 64 are allowed"), "{error}");
}

/// Bytes of a sample changed, left out and doubled: an error or a valid scene, never a panic.
#[test]
fn whatever_happens_to_a_file_it_is_read_or_refused() {
    let whole = std::fs::read(sample("tree-3")).unwrap();
    let mut random = Random(21);
    let mut below = |count: usize| (random.bits() % count as u64) as usize;
    let mut read_well = 0;
    for _ in 0..100_000 {
        let mut bytes = whole.clone();
        for _ in 0..1 + below(5) {
            let at = below(bytes.len());
            match below(4) {
                0 => bytes[at] = below(256) as u8,
                1 => bytes[at] = b"0123456789 -+.e#\nvblfcsp"[below(24)],
                2 if bytes.len() > 1 => drop(bytes.remove(at)),
                _ => bytes.truncate(at.max(1)),
            }
        }
        let format = FORMATS.iter().find(|format| format.extension == "nff").unwrap();
        match format.read_stream(&mut &bytes[..]) {
            Ok(reading) => {
                assert!(reading.scene.validate().is_ok());
                read_well += 1;
            }
            Err(error) => assert!(error.line.is_some() && error.to_string().lines().count() == 1, "{error}"),
        }
    }
    assert!((10_000..90_000).contains(&read_well), "{read_well} of 100000 were read");
}

#[test]
fn a_scene_is_not_written_as_nff() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.nff");
    let error = Scene::default().save(&path).unwrap_err();
    assert!(
        error.is_input_error() && error.what == "NFF is read only; a scene is written to .toml, .json, .zscene or .pov"
    );
    assert!(!path.exists());
}
