//! What the window costs, and how soon it answers. These tests have the machine to themselves.

use std::thread;
use std::time::{Duration, Instant};

use crate::driver::{Desk, Locale};

#[test]
fn an_idle_window_costs_nothing_and_continuous_tracing_does() {
    let desk = Desk::alone(Locale::Russian, [700, 500]);
    let mut window = desk.view(&["four"]);
    let pictures = window.now().pictures_traced;
    let before = window.cpu_time();
    thread::sleep(Duration::from_secs(3));
    let used = window.cpu_time() - before;
    assert_eq!(window.now().pictures_traced, pictures);
    assert!(used < Duration::from_millis(100), "3 s without a hand on it took {used:?} of the processor");

    window.click("Непрерывная трассировка");
    window.wait_until("it traces on and on", |now| now.pictures_traced > pictures + 10);
    window.click("Непрерывная трассировка");
    window.settle();
    window.close();
}

#[test]
fn the_panel_answers_while_a_slow_picture_is_traced() {
    let desk = Desk::alone(Locale::Russian, [1500, 950]);
    let mut window = desk.view(&["start"]);
    let switch = "Инвертировать мышь";
    window.click(switch);
    window.click(switch);
    window.menu(&["Галерея", "Таблица 4.1: кубы", "таблица 4.1: кубы, 100"]);
    window.wait_until("the grid", |now| now.primitives == 100);
    window.fill("Сцена и камера: глубина отражений", 100.0);
    // On the switch, which does not move; its widget does not tell whether it is under the mouse.
    window.click(switch);
    let begun = Instant::now();
    let mut answers = Vec::new();
    for _ in 0..20 {
        let before = window.now().value(switch).to_owned();
        let clicked = Instant::now();
        window.click_again();
        let answered = window.wait_until("the switch turns", |now| now.value(switch) != before);
        answers.push(clicked.elapsed());
        assert!(!answered.is_whole, "the picture came too soon, after {:?}", begun.elapsed());
        // Longer than a double click would be.
        thread::sleep(Duration::from_millis(320));
    }
    answers.sort();
    let (median, longest) = (answers[answers.len() / 2], answers[answers.len() - 1]);
    eprintln!("answers while a slow picture is traced: median {median:?}, longest {longest:?}");
    // The issue asks for 100 ms. xdotool's own start, the layers and the two cores, which the software device takes
    // whole, are in the figure too; a window that waited for a picture of many seconds would be far off.
    assert!(median < Duration::from_millis(250), "{answers:?}");
    window.key("Escape");
    window.menu(&["Галерея", "начальное состояние программы"]);
    window.close();
}
