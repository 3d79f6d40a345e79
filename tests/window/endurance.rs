//! Long use.

use std::time::{Duration, Instant};

use crate::driver::{Desk, Locale, Window};

#[track_caller]
fn edit_and_resize(window: &mut Window, edits: usize, resizes: u32) {
    for _ in 0..edits / 2 {
        for (key, primitives) in [("ctrl+d", 5), ("Delete", 4)] {
            window.key(key);
            window.wait_until("the edit", |now| now.primitives == primitives && now.is_whole);
        }
        window.key("ctrl+z");
        window.key("ctrl+z");
        window.wait_until("undone", |now| now.primitives == 4 && now.selection == Some(0) && now.is_whole);
    }
    for i in 0..resizes {
        window.resize([600 + 37 * (i % 5), 400 + 29 * (i % 7)]);
    }
    window.resize([500, 360]);
}

#[test]
fn two_hundred_edits_and_twenty_resizes_leave_no_memory_behind() {
    let desk = Desk::new(Locale::Russian, [500, 360]);
    let mut window = desk.view(&["four"]);
    window.click("Следующий примитив");
    window.wait_until("the sphere is selected", |now| now.selection == Some(0));
    // Caches fill, and the allocator comes to know what is needed.
    edit_and_resize(&mut window, 60, 20);
    let before = window.resident_kib();
    edit_and_resize(&mut window, 200, 20);
    let after = window.resident_kib();
    eprintln!("memory before and after 200 edits and 20 resizes: {before} KiB, {after} KiB");
    assert!(after * 100 < before * 102, "{before} KiB became {after} KiB");
    window.close();
}

#[test]
fn half_a_minute_of_everything_is_without_a_word_of_validation() {
    const MIDDLE: u32 = 2;
    const RIGHT: u32 = 3;
    let desk = Desk::new(Locale::English, [700, 500]);
    let mut window = desk.view(&["four"]);
    let end = Instant::now() + Duration::from_secs(30);
    let scenes = ["a sphere", "figure 3.5: the four solids", "figure 3.7: mutual reflections", "a cone"];
    let mut rounds = 0;
    while Instant::now() < end {
        let middle = window.settle().in_picture(0.5, 0.5);
        window.drag(RIGHT, middle, [40.0, -25.0]);
        window.drag(MIDDLE, middle, [-60.0, 30.0]);
        window.wheel(2);
        window.click("Add a cylinder");
        window.keys(&["ctrl+d", "ctrl+d", "Delete", "ctrl+z", "ctrl+shift+z"], 3);
        window.fill("Material of the primitive: K_s", if rounds % 2 == 0 { 0.75 } else { 0.8 });
        window.resize([500 + 61 * (rounds % 6), 420 + 53 * (rounds % 5)]);
        // While it is on, the picture is never whole for long.
        window.click("Continuous tracing");
        window.drag(RIGHT, middle, [-80.0, 20.0]);
        window.click("Continuous tracing");
        window.resize([700, 500]);
        window.menu(&["Gallery", scenes[rounds as usize % scenes.len()]]);
        window.click("Do not save");
        window.wait_until("the next scene", |now| now.dialog.is_none() && !now.has_unsaved_changes);
        rounds += 1;
    }
    eprintln!("{rounds} rounds of everything in half a minute");
    assert_eq!(window.settle().validation_messages, 0);
    window.close();
}
