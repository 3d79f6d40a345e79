//! What is left for the next run, and what a device's end leaves.

use std::thread;
use std::time::Duration;

use zerkalo::scene::{Primitive, SolidKind, gallery};

use crate::driver::{Desk, Locale, Window};

const SIZE: [u32; 2] = [700, 500];

#[track_caller]
fn add_a_sphere(window: &mut Window) {
    let before = window.settle().primitives;
    window.click("Добавить сферу");
    window.wait_until("one more primitive", |now| now.primitives == before + 1);
    window.settle();
}

#[test]
fn unsaved_work_outlives_an_interrupt_and_a_crash() {
    let desk = Desk::new(Locale::Russian, SIZE);
    gallery::scene("four").unwrap().save(&desk.path("four.toml")).unwrap();
    let question = "После прошлого запуска осталась несохранённая сцена. Восстановить её?";
    let mut window = desk.view(&["four.toml"]);
    add_a_sphere(&mut window);
    window.interrupt();

    let mut window = desk.view(&["start"]);
    assert!(window.now().says(question));
    window.click("Восстановить");
    let back = window.wait_until("it is back", |now| now.primitives == 5 && now.dialog.is_none());
    assert!(back.has_unsaved_changes && back.file.is_some_and(|path| path.ends_with("four.toml")));
    window.key("ctrl+s");
    window.wait_until("it is saved where it belongs", |now| !now.has_unsaved_changes);
    assert_eq!(desk.scene("four.toml").primitives[4], Primitive::course_default(SolidKind::Sphere));
    add_a_sphere(&mut window);
    // Work is kept every two seconds.
    thread::sleep(Duration::from_millis(2500));
    window.kill();

    let mut window = desk.view(&["start"]);
    assert!(window.now().says(question));
    window.click("Не восстанавливать");
    window.wait_until("the scene asked for", |now| now.primitives == 0 && now.dialog.is_none());
    window.close();
    let mut window = desk.view(&["start"]);
    assert_eq!(window.now().dialog, None, "it was given up");
    window.close();
}

#[test]
fn the_window_goes_on_with_its_scene_when_the_device_is_lost() {
    let desk = Desk::new(Locale::Russian, SIZE);
    // Late enough for an edit before it.
    let mut window = desk.start(&["four", "--lose-device-after", "120"]);
    add_a_sphere(&mut window);
    window.click("Добавить куб");
    window.wait_until("one more primitive", |now| now.primitives == 6);
    assert_eq!(window.now().device_losses, 0, "the device was lost too early for this test");
    for step in 0.. {
        // Frames pass while the mouse is over the widgets.
        window.move_mouse([20.0 + f64::from(step % 200), 10.0]);
        if window.now().device_losses > 0 {
            break;
        }
    }
    let now = window.settle();
    assert_eq!((now.device_losses, now.primitives, now.selection, &now.dialog), (1, 6, Some(5), &None));
    window.key("ctrl+z");
    window.wait_until("the history is there too", |now| now.primitives == 5);
    window.save_as("after.toml");
    let size = window.now().picture_size;
    assert!(window.screenshot("after.exr") == desk.render("after.toml", size));
    window.close();
}

#[test]
fn size_language_and_speed_are_remembered_by_the_next_run() {
    let desk = Desk::new(Locale::English, SIZE);
    let mut window = desk.view(&["start"]);
    window.resize([810, 610]);
    window.menu(&["View", "Language", "Русский"]);
    window.wait_until("Russian", |now| now.find("Файл").is_some());
    window.key("Escape");
    window.fill("Сцена и камера: скорость полёта, ед./с", 7.5);
    window.close();

    let mut window = desk.view(&["start"]);
    let now = window.now().clone();
    assert_eq!(now.window, [810, 610]);
    assert!(now.find("Файл").is_some());
    assert_eq!(now.value("Сцена и камера: скорость полёта, ед./с"), "7.5");
    window.close();
}

#[test]
fn the_kernel_and_the_samples_chosen_are_remembered_and_the_course_s_start_is_the_course_s() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    assert_eq!(window.now().kernel, "course", "as the course's program began");
    window.close();

    let mut window = desk.view(&["four"]);
    assert_eq!(window.now().kernel, "whitted f32", "how the last run began was not chosen");
    window.fill("Сцена и камера: лучей на пиксель", 3.0);
    window.click("Точная модель (ЦП)");
    window.wait_until("it is chosen", |now| now.kernel == "reference" && now.is_finished);
    window.close();

    std::fs::write(desk.path("plain.toml"), "kernel = \"plain\"\n").unwrap();
    for (arguments, kernel) in
        [(&["start"][..], "course"), (&["four", "--settings", "plain.toml"], "setting"), (&["four"], "reference")]
    {
        let mut window = desk.view(arguments);
        assert_eq!(window.now().kernel, kernel, "{arguments:?}");
        assert_eq!(window.now().value("Сцена и камера: лучей на пиксель"), "3");
        window.close();
    }
}

#[test]
fn the_window_closes_without_a_word_when_nobody_reads_what_it_tells() {
    let desk = Desk::new(Locale::English, SIZE);
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = desk.program(&["view", "four", "--observe"]).stdout(writer).output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8(output.stderr).unwrap().as_str()), (Some(141), ""));
}

#[test]
fn without_a_display_one_line_names_the_way_without_a_window() {
    let desk = Desk::new(Locale::English, SIZE);
    let output = desk.program(&["view", "start"]).env_remove("DISPLAY").output().unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), complaint.lines().count()), (Some(1), 1), "{complaint}");
    assert!(complaint.starts_with("zerkalo: ") && complaint.contains("zerkalo render"), "{complaint}");
    assert!(output.stdout.is_empty());
}
