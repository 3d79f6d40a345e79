//! Looking, flying, going around, coming nearer.

use glam::DVec3;
use zerkalo::frame::Frame;
use zerkalo::scene::gallery;

use crate::driver::{Desk, Locale, Window};

const SIZE: [u32; 2] = [700, 500];
const LEFT: u32 = 1;
const MIDDLE: u32 = 2;
const RIGHT: u32 = 3;

/// Mean column of what is not background.
fn mean_column(frame: &Frame) -> f64 {
    let background = frame.pixels()[0];
    let columns = frame.pixels().iter().enumerate().filter(|(_, pixel)| **pixel != background);
    let columns: Vec<f64> = columns.map(|(i, _)| (i % frame.width() as usize) as f64).collect();
    columns.iter().sum::<f64>() / columns.len() as f64
}

#[test]
fn the_right_button_turns_the_view_by_the_course_s_milliradian_a_pixel() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    let middle = window.now().in_picture(0.4, 0.4);
    window.drag(RIGHT, middle, [100.0, 50.0]);
    // −x is on the right of a camera that looks along +z.
    let (yaw, pitch) = (0.1_f64, -0.05_f64);
    let turned = DVec3::new(-yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
    let is_rotated = |now: &crate::driver::Observation| now.direction().abs_diff_eq(turned, 1e-9);
    window.wait_until("right turns right and down looks down", is_rotated);
    window.drag(RIGHT, middle, [-100.0, -50.0]);
    window.wait_until("and back", |now| now.direction().abs_diff_eq(DVec3::Z, 1e-9));
    window.drag(LEFT, middle, [100.0, 50.0]);
    let now = window.settle();
    assert!(now.direction().abs_diff_eq(DVec3::Z, 1e-9) && !now.has_unsaved_changes, "{}", now.in_short());
    window.close();
}

/// Holds the key down, with the right button held, until the camera has gone half a unit; where it is then.
#[track_caller]
fn fly(window: &mut Window, key: &str) -> DVec3 {
    let before = window.settle();
    window.move_mouse(before.in_picture(0.4, 0.4));
    window.press(RIGHT);
    window.key_down(key);
    window.wait_until("the camera flies", |now| now.position().distance(before.position()) > 0.5);
    window.key_up(key);
    window.release(RIGHT);
    window.settle().position() - before.position()
}

#[test]
fn keys_fly_the_camera_as_they_are_seen_while_the_right_button_is_held() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["sphere"]);
    let opening = window.now().position();
    // −x is on the right.
    let ways = [
        ("w", DVec3::Z),
        ("s", DVec3::NEG_Z),
        ("a", DVec3::X),
        ("d", DVec3::NEG_X),
        ("q", DVec3::Y),
        ("e", DVec3::NEG_Y),
    ];
    for (key, way) in ways {
        let gone = fly(&mut window, key);
        assert!(gone.normalize().abs_diff_eq(way, 1e-9), "{key} goes {gone}");
    }
    window.click("Вернуть камеру");
    window.wait_until("the camera is back", |now| now.position() == opening);
    let before = mean_column(&window.screenshot("before.exr"));
    fly(&mut window, "a");
    let after = mean_column(&window.screenshot("after.exr"));
    assert!(after > before + 5.0, "who goes left sees the sphere farther right: {before} to {after}");
    window.key("w");
    let still = window.settle().position();
    window.key("w");
    assert_eq!(window.settle().position(), still, "without the button keys do not fly");
    assert!(!window.now().has_unsaved_changes, "looking is no edit");
    window.close();
}

#[test]
fn the_middle_button_goes_around_and_the_wheel_nearer_to_the_selected_primitive() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["four"]);
    window.click("Следующий примитив");
    let before = window.wait_until("the sphere is selected", |now| now.selection == Some(0));
    let pivot = gallery::scene("four").unwrap().primitives[0].solid.position();
    let distance = before.position().distance(pivot);
    window.drag(MIDDLE, before.in_picture(0.4, 0.4), [60.0, 30.0]);
    window.wait_until("the camera goes around", |now| {
        now.position().distance(before.position()) > 1.0 && (now.position().distance(pivot) - distance).abs() < 1e-9
    });
    window.wheel(-1);
    let nearer = |factor: f64| {
        move |now: &crate::driver::Observation| (now.position().distance(pivot) / distance - factor).abs() < 1e-9
    };
    window.wait_until("up comes nearer, each time by a tenth of what is left", nearer(0.9_f64.powi(2)));
    window.wheel(2);
    window.wait_until("down goes farther", nearer(0.9_f64.powi(-2)));

    // Alt with the left button is for mice without a middle one.
    window.move_mouse(before.in_picture(0.4, 0.4));
    let around = window.settle().position();
    window.key_down("alt");
    window.drag(LEFT, before.in_picture(0.4, 0.4), [-60.0, 0.0]);
    window.key_up("alt");
    window.wait_until("the camera goes around", |now| now.position().distance(around) > 0.5);

    window.save_as("looked.toml");
    let size = window.now().picture_size;
    window.click_at(before.in_picture(0.02, 0.02));
    assert!(window.screenshot("looked.exr") == desk.render("looked.toml", size), "the camera is saved as it stands");
    window.close();
}
