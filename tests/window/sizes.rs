//! The window in all sizes, and out of sight.

use std::thread;
use std::time::Duration;

use crate::driver::{Desk, Locale};

#[test]
fn it_is_resized_from_tiny_to_large_and_back() {
    let desk = Desk::new(Locale::Russian, [700, 500]);
    let mut window = desk.view(&["four"]);
    for size in [[1500, 950], [320, 240], [1, 1], [801, 3], [64, 48], [999, 777], [5, 600], [1600, 1000], [641, 479]] {
        window.resize(size);
    }
    window.resize([700, 500]);
    let now = window.settle();
    assert_eq!(now.primitives, 4);
    let frame = window.screenshot("window.exr");
    assert!(frame == desk.render("four", [frame.width(), frame.height()]));
    window.close();
}

#[test]
fn it_goes_on_after_it_was_out_of_sight() {
    let desk = Desk::new(Locale::Russian, [700, 500]);
    let mut window = desk.view(&["four"]);
    desk.display.xdotool(&["windowunmap", "--sync", window.id()]);
    thread::sleep(Duration::from_millis(500));
    let before = window.cpu_time();
    thread::sleep(Duration::from_secs(1));
    let used = window.cpu_time() - before;
    assert!(used < Duration::from_millis(100), "a hidden window works: {used:?}");
    desk.display.xdotool(&["windowmap", "--sync", window.id()]);
    desk.display.xdotool(&["windowfocus", "--sync", window.id()]);
    window.click("Добавить куб");
    window.wait_until("it answers", |now| now.primitives == 5 && now.is_whole);
    window.close();
}
