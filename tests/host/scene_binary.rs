//! `.zscene` files: what is damaged, cut short or a lie is refused in one line that says where.

use std::fs;

use zerkalo::scene::{Scene, SceneError, Solid, gallery};

use crate::random::Random;

fn made(name: &str) -> Scene {
    gallery::scene(name).unwrap_or_else(|| panic!("no scene {name}"))
}

/// With names, lights and all kinds.
fn bytes() -> Vec<u8> {
    made("showcase").to_zscene()
}

/// With a checksum that is right again.
fn signed(mut bytes: Vec<u8>) -> Vec<u8> {
    let end = bytes.len() - 4;
    let sum = crc32fast::hash(&bytes[..end]);
    bytes[end..].copy_from_slice(&sum.to_le_bytes());
    bytes
}

fn refusal(bytes: &[u8]) -> String {
    line(Scene::from_zscene(bytes).expect_err("it was accepted"))
}

fn line(error: SceneError) -> String {
    assert!(error.is_input_error(), "{error}");
    let line = error.to_string();
    assert!(!line.contains(char::is_control) && line.chars().count() < 300, "{line:?}");
    line
}

#[track_caller]
fn assert_names(bytes: &[u8], words: &[&str]) {
    let line = refusal(bytes);
    for word in words {
        assert!(line.contains(word), "{word:?} is not in {line:?}");
    }
}

/// Where the count of lights stands: before it are magic, version, depth, background, camera and projection.
const LIGHT_COUNT_AT: usize = 8 + 4 + 4 + 24 + 80 + 1;
/// Of a scene with one light.
const PRIMITIVE_COUNT_AT: usize = LIGHT_COUNT_AT + 8 + 48;

#[test]
fn names_colours_and_kinds_come_back_to_the_bit() {
    for name in ["showcase", "four", "start", "cloud-1000"] {
        let scene = made(name);
        assert_eq!(format!("{:?}", Scene::from_zscene(&scene.to_zscene()).unwrap()), format!("{scene:?}"), "{name}");
    }
    let mut scene = made("four");
    scene.primitives[0].name = Some(String::new());
    scene.primitives[1].name = Some("имя\n\0😀".repeat(1000));
    assert_eq!(Scene::from_zscene(&scene.to_zscene()).unwrap(), scene);
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let whole = bytes();
    for length in 0..whole.len() {
        assert!(refusal(&whole[..length]).starts_with("byte "), "{length}");
    }
    assert_names(&whole[..4], &["byte 0: ", "ends too soon"]);
    assert_names(&whole[..LIGHT_COUNT_AT - 60], &["camera: ", "ends too soon"]);
    assert_names(&whole[..PRIMITIVE_COUNT_AT + 20], &["primitive 1", "ends too soon"]);
    assert_names(&[whole, vec![0]].concat(), &["1 bytes more than the scene has"]);
}

#[test]
fn a_changed_byte_anywhere_is_refused() {
    let whole = bytes();
    for at in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[at] ^= 0x10;
        refusal(&damaged);
    }
}

#[test]
fn what_is_wrong_is_named() {
    let with = |at: usize, new: &[u8]| {
        let mut changed = bytes();
        changed[at..at + new.len()].copy_from_slice(new);
        signed(changed)
    };
    assert_names(b"primitives = []", &["byte 0: not a zscene file"]);
    assert_names(&with(6, b"\n\n"), &["byte 0: not a zscene file"]);
    assert_names(&with(8, &[5]), &["byte 8: version 5"]);
    assert_names(&with(12, &[0]), &["max_depth = 0: must be a whole number from 1 to 1000"]);
    assert_names(&with(16, &f64::NAN.to_le_bytes()), &["background = [NaN", "finite"]);
    assert_names(&with(LIGHT_COUNT_AT - 1, &[7]), &["camera: projection = 7"]);
    assert_names(&with(LIGHT_COUNT_AT + 8, &f64::INFINITY.to_le_bytes()), &["light 1: position = [inf", "finite"]);
    assert_names(&with(PRIMITIVE_COUNT_AT + 8, &[4]), &["primitive 1: kind = 4: must be 0 (sphere)"]);
    assert_names(&with(PRIMITIVE_COUNT_AT + 17, &[0xFF]), &["primitive 1 (box): its name is not UTF-8"]);

    let mut last = bytes();
    let at = last.len() - 4 - 8;
    last[at..at + 8].copy_from_slice(&2.0_f64.to_le_bytes());
    assert_names(&signed(last), &["primitive 8 (cone \"green cone\"): material.specular = 2: must be from 0 to 1"]);
    assert_names(&[b"zscene\r\n".as_slice(), &[1]].concat(), &["byte 8: ", "ends too soon"]);
}

#[test]
fn counts_that_lie_allocate_nothing() {
    for at in [LIGHT_COUNT_AT, PRIMITIVE_COUNT_AT, PRIMITIVE_COUNT_AT + 9] {
        for count in [9, 60, 16_000_000, 1 << 40, u64::MAX] {
            let mut lying = bytes();
            lying[at..at + 8].copy_from_slice(&count.to_le_bytes());
            refusal(&signed(lying));
        }
    }
    let mut lying = bytes();
    lying[PRIMITIVE_COUNT_AT..PRIMITIVE_COUNT_AT + 8].copy_from_slice(&16_777_217_u64.to_le_bytes());
    assert_names(&signed(lying), &["primitives = [16777217 of them]: at most 16777216 are allowed"]);
}

#[test]
fn an_axis_of_another_length_is_taken_as_in_text() {
    let mut scene = made("cone");
    if let Solid::Cone { axis, .. } = &mut scene.primitives[0].solid {
        *axis *= 3.0;
    }
    let read = Scene::from_zscene(&scene.to_zscene()).unwrap();
    assert_eq!(read, Scene::from_json(&scene.to_json()).unwrap());
    assert_eq!(read, made("cone"));
}

#[test]
fn files_are_read_by_their_extension_and_refused_with_their_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("clouds.ZScene");
    made("cloud-300").save(&path).unwrap();
    assert_eq!(Scene::load(&path).unwrap(), made("cloud-300"));
    fs::write(&path, &bytes()[..200]).unwrap();
    let line = line(Scene::load(&path).unwrap_err());
    assert!(line.contains("clouds.ZScene: byte 1"), "{line}");
}

#[test]
fn twenty_thousand_damaged_files_give_a_scene_or_one_line() {
    let seeds = ["showcase", "four", "start", "cloud-30"].map(|name| made(name).to_zscene());
    let mut random = Random(1);
    let (mut read, mut refused) = (0, 0);
    for round in 0..20_000 {
        let mut bytes = seeds[random.below(seeds.len())].clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len());
            let end = (at + random.below(16)).min(bytes.len());
            match random.below(8) {
                0 => drop(bytes.drain(at..end)),
                1 => bytes.truncate(at.max(8)),
                2 => drop(bytes.splice(at..at, [0; 8])),
                3 => bytes[at..end].fill(0xFF),
                _ => bytes[at] = random.below(256) as u8,
            }
        }
        // Most with the right checksum, for what is behind it to be tried.
        let bytes = if round % 8 == 0 || bytes.len() < 4 { bytes } else { signed(bytes) };
        match Scene::from_zscene(&bytes) {
            Ok(scene) => {
                read += 1;
                scene.validate().unwrap();
                assert_eq!(Scene::from_zscene(&scene.to_zscene()).unwrap(), scene);
            }
            Err(error) => {
                refused += 1;
                line(error);
            }
        }
    }
    assert!(read > 1_000 && refused > 10_000, "{read} read, {refused} refused: the damage is one-sided");
}
