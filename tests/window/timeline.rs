//! A scene that moves, in the window.

use std::time::Duration;

use zerkalo::frame::Frame;

use crate::driver::{Desk, Locale};

const SIZE: [u32; 2] = [700, 500];

#[test]
fn a_time_s_picture_is_that_of_animate() {
    let desk = Desk::new(Locale::English, SIZE);
    for scene in ["dolly", "reflection"] {
        let mut window = desk.view(&[scene]);
        window.fill("Animation: pictures/s", 10.0);
        window.type_into("Animation: time", "1.5");
        let now = window.wait_until("it is that time", |now| now.seconds == Some(1.5));
        let shown = window.screenshot("window.exr");
        let size = now.picture_size.map(|side| side.to_string()).join("x");
        let picture = ["animate", scene, "-o", "%d.exr", "--fps", "10", "--frames", "15"];
        let animate = [&picture[..], &["--size", &size, "--samples", "16"]].concat();
        assert!(desk.program(&animate).output().unwrap().status.success());
        assert!(shown == Frame::load(&desk.path("15.exr")).unwrap(), "{scene}");
        std::fs::remove_file(desk.path("window.exr")).unwrap();
        window.close();
    }
}

#[test]
fn space_plays_and_pauses_and_moving_the_camera_takes_it_over() {
    let desk = Desk::new(Locale::English, SIZE);
    let mut window = desk.view(&["orbit"]);
    let still = window.settle();
    assert_eq!(still.seconds, None);
    window.key("space");
    let first = window.wait_until("time goes on", |now| now.seconds > Some(0.2));
    assert_ne!(first.position(), still.position());
    window.wait_until("it begins again", |now| now.seconds.is_some_and(|seconds| seconds < 0.2));
    window.key("space");
    let paused = window.settle();
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(window.settle().seconds, paused.seconds);
    window.move_mouse(paused.in_picture(0.5, 0.5));
    window.wheel(-1);
    let moved = window.wait_until("it is nearer", |now| now.position() != paused.position());
    let way = (moved.position() - paused.position()).length();
    assert!(way < 0.5 * paused.position().length(), "from where it was: {way}");
    window.key("space");
    let later = window.wait_until("time goes on", |now| now.seconds != paused.seconds);
    assert_eq!(later.position(), moved.position(), "the camera is the user's");
    window.click("animated camera");
    window.wait_until("it is followed again", |now| now.position() != moved.position());
    window.click("Stop");
    let stopped = window.wait_until("without a time", |now| now.seconds.is_none());
    assert!(!stopped.has_unsaved_changes);
    window.close();
}
