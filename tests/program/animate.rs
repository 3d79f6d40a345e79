//! `zerkalo animate`: pictures of a scene that moves.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use zerkalo::scene::gallery;

use crate::place::Place;

const SMALL: [&str; 4] = ["--size", "48x24", "--fps", "5"];

fn animate<'a>(scene: &'a str, output: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["animate", scene, "-o", output, "--validate"], &SMALL[..], more].concat()
}

#[test]
fn any_picture_alone_is_that_of_the_whole_run_to_the_byte() {
    let place = Place::new();
    for scene in ["orbit", "dolly", "reflection"] {
        let told = place.json(&animate(scene, &format!("{scene}/%02d.exr"), &[]));
        let frames = told["frames"].as_array().unwrap();
        assert_eq!((frames.len(), frames[20]["seconds"].as_f64()), (21, Some(4.0)), "to the last keyframe");
        assert_eq!((&told["validation_messages"], &told["skipped"]), (&0.into(), &0.into()));
        for number in ["7", "13"] {
            place.run_well(&animate(scene, "alone%02d.exr", &["--frames", number]));
            let name = format!("{:02}.exr", number.parse::<u32>().unwrap());
            let read = |name: String| fs::read(place.path(&name)).unwrap();
            assert_eq!(read(format!("alone{name}")), read(format!("{scene}/{name}")), "{scene}, {number}");
        }
    }
    // What `render` draws of the scene as it is then.
    let mut scene = gallery::scene("orbit").unwrap();
    scene.go_to(7.0 / 5.0).unwrap();
    scene.save(&place.path("then.toml")).unwrap();
    place.run_well(&["render", "then.toml", "-o", "then.exr", "--size", "48x24"]);
    assert_eq!(fs::read(place.path("then.exr")).unwrap(), fs::read(place.path("orbit/07.exr")).unwrap());
}

#[test]
fn what_is_there_and_whole_is_not_drawn_again_and_what_was_cut_off_is() {
    let place = Place::new();
    place.run_well(&animate("dolly", "%d.png", &["--frames", "2..4"]));
    let cut = place.path("3.png");
    let whole = fs::read(&cut).unwrap();
    fs::write(&cut, &whole[..whole.len() / 2]).unwrap();
    let told = place.json(&animate("dolly", "%d.png", &["--frames", "1..5", "--skip-existing"]));
    let numbers: Vec<_> = told["frames"].as_array().unwrap().iter().map(|frame| frame["number"].as_u64()).collect();
    assert_eq!((numbers, told["skipped"].as_u64()), (vec![Some(1), Some(3), Some(5)], Some(2)));
    assert_eq!(fs::read(&cut).unwrap(), whole);
    let other_size = ["animate", "dolly", "-o", "%d.png", "--size", "24x12", "--fps", "5", "--frames", "2..4"];
    let told = place.json(&[&other_size[..], &["--skip-existing"]].concat());
    assert_eq!(told["skipped"].as_u64(), Some(0), "pictures of another size are others");
}

#[test]
fn tasks_of_a_slurm_array_share_the_pictures_without_rest() {
    let place = Place::new();
    place.run_well(&animate("orbit", "whole/%04d.png", &["--frames", "0..8"]));
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/animate.slurm");
    let programs = Path::new(env!("CARGO_BIN_EXE_zerkalo")).parent().unwrap();
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap());
    // More tasks than one, whose numbers need not begin at 0; the last of two that share one picture has none.
    for (pictures, first_task, tasks) in [("9", 3, 4), ("1", 0, 2)] {
        for task in first_task..first_task + tasks {
            let mut command = Command::new("bash");
            command.args([script, "orbit", pictures, pictures, "--validate"]).args(SMALL);
            command.current_dir(place.path("")).env("PATH", &path).env("SLURM_ARRAY_TASK_ID", task.to_string());
            command.env("SLURM_ARRAY_TASK_MIN", first_task.to_string());
            command.env("SLURM_ARRAY_TASK_COUNT", tasks.to_string());
            let output = command.output().unwrap();
            assert!(output.status.success(), "{output:?}");
        }
        let names = || fs::read_dir(place.path(pictures)).unwrap().map(|entry| entry.unwrap().file_name());
        assert_eq!(names().count().to_string(), pictures);
        for name in names() {
            let read = |folder| fs::read(place.path(folder).join(&name)).unwrap();
            assert_eq!(read(pictures), read("whole"), "{name:?}");
        }
    }
}

#[test]
fn one_apng_has_every_picture_and_its_time() {
    let place = Place::new();
    place.run_well(&animate("reflection", "all.apng", &[]));
    let file = std::io::BufReader::new(fs::File::open(place.path("all.apng")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!((control.num_frames, control.num_plays), (21, 0));
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    for number in 0..21 {
        reader.next_frame(&mut pixels).unwrap();
        let frame = reader.info().frame_control().unwrap();
        assert_eq!((frame.delay_num, frame.delay_den), (1, 5), "{number}");
    }
    place.run_well(&animate("reflection", "%02d.png", &["--frames", "20"]));
    let last = zerkalo::frame::Frame::load(&place.path("20.png")).unwrap();
    assert_eq!(pixels, last.display_bytes());
}

/// A program in FFmpeg's place that keeps what it is given.
#[cfg(unix)]
#[test]
fn films_are_ffmpeg_s_whole_or_not_at_all() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new();
    let script = |name: &str, text: &str| {
        fs::write(place.path(name), format!("#!/bin/sh\n{text}\n")).unwrap();
        fs::set_permissions(place.path(name), fs::Permissions::from_mode(0o755)).unwrap();
    };
    script("keeps", "for last; do :; done; echo \"$@\" > words; cat > \"$last\"");
    script("fails", "cat > /dev/null; echo 'no such codec' >&2; exit 3");
    place.run_well(&animate("orbit", "film.mp4", &["--ffmpeg", "./keeps", "--frames", "0..3"]));
    assert_eq!(fs::metadata(place.path("film.mp4")).unwrap().len(), 4 * 48 * 24 * 3);
    let words = fs::read_to_string(place.path("words")).unwrap();
    assert!(words.contains("-video_size 48x24 -framerate 5 -i -") && words.contains("-f mp4"), "{words}");
    place.assert_refused(&animate("orbit", "film.webm", &["--ffmpeg", "./fails"]), 1, &["FFmpeg: no such codec"]);
    place.assert_refused(&animate("orbit", "film.webm", &["--ffmpeg", "./absent"]), 1, &["is not installed", "apng"]);
}

#[test]
fn animate_refuses_what_it_cannot_do() {
    let place = Place::new();
    place.assert_refused(&animate("showcase", "%d.png", &[]), 2, &["nothing moves", "zerkalo render"]);
    place.assert_refused(&animate("orbit", "a.png", &[]), 2, &["a.png", "frames/%04d.png"]);
    place.assert_refused(&animate("orbit", "a.gif", &[]), 2, &["a.gif", ".apng, .mp4 or .webm"]);
    place.assert_refused(&animate("orbit", "%d.png", &["--frames", "0..21"]), 2, &["pictures 0 to 20 at 5 a second"]);
    let too_many = ["animate", "orbit", "-o", "%d.png", "--fps", "1e9"];
    place.assert_refused(&too_many, 2, &["4000000001 pictures", "at most 1000000", "--frames A..B"]);
    place.assert_refused(&animate("orbit", "%d.png", &["--frames", "3..1"]), 2, &["--frames", "0..119"]);
    place.assert_refused(&animate("orbit", "a.apng", &["--skip-existing"]), 2, &["--skip-existing is for files"]);
    place.assert_refused(&animate("orbit", "%d.png", &["--algorithm", "reference"]), 2, &["on a device"]);
}

/// Ctrl-C keeps every picture drawn, and a kill leaves none in part; the same run again draws the rest.
#[cfg(unix)]
#[test]
fn a_run_that_was_ended_goes_on_to_the_same_files() {
    use crate::place::{interrupted, wait_until};
    let place = Place::new();
    let words = |folder: &'static str| {
        let more = ["--fps", "30", "--size", "160x80", "--frames", "0..59", "--skip-existing"];
        [&["animate", "dolly", "-o", folder], &more[..]].concat()
    };
    place.run_well(&words("whole/%02d.png"));
    let has_some = || place.path("cut/02.png").exists();
    let program = place.command(&words("cut/%02d.png")).spawn().unwrap();
    wait_until("pictures are there", has_some);
    let run = interrupted(program);
    assert_eq!(run.code, Some(130), "{run:?}");
    assert!(run.stderr.contains("of 60 pictures; to go on: the same with --skip-existing"), "{run:?}");
    let mut program = place.command(&words("cut/%02d.png")).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(700));
    program.kill().unwrap();
    program.wait().unwrap();
    place.run_well(&words("cut/%02d.png"));
    for number in 0..60 {
        let read = |folder: &str| fs::read(place.path(&format!("{folder}/{number:02}.png"))).unwrap();
        assert_eq!(read("cut"), read("whole"), "{number}");
    }
}
