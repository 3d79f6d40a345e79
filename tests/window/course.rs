//! The functional tests of the course work's section 3.5, by hand in the Russian window.

use zerkalo::frame::Frame;
use zerkalo::scene::Scene;
use zerkalo::viewer::pick::pick;

use crate::driver::{Desk, Locale, Window};
use crate::geometry::{first_entered, primary_ray};

/// The pictures are as wide as the course's for their height, so that all is in them.
const SIZE: [u32; 2] = [1200, 430];

/// What the primary ray of each pixel meets.
fn seen(scene: &Scene, frame: &Frame) -> Vec<Option<usize>> {
    let (width, height) = (frame.width(), frame.height());
    (0..width * height).map(|i| pick(scene, width, height, i % width, i / width)).collect()
}

/// What pixels differ by.
fn difference(frame: &Frame, from: &Frame) -> Vec<[f32; 3]> {
    let pairs = frame.pixels().iter().zip(from.pixels());
    pairs.map(|(pixel, from)| [0, 1, 2].map(|channel| pixel[channel] - from[channel])).collect()
}

/// Saves the scene and sees that the picture in the window is the one that `zerkalo render` makes of it, bit for bit.
#[track_caller]
fn saved_and_rendered_alike(desk: &Desk, window: &mut Window, frame: &Frame) -> Scene {
    window.save_as("scene.toml");
    assert!(
        desk.render_by("course", "scene.toml", [frame.width(), frame.height()]) == *frame,
        "the window draws otherwise"
    );
    desk.scene("scene.toml")
}

#[test]
fn course_3_5_1_primitives_look_like_their_definitions() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    for (axis, value) in [("y", 2.0), ("z", -1.0)] {
        window.fill(&format!("Параметры света: {axis}"), value);
    }
    let placed = [
        ("Добавить сферу", [3.0, 0.5, 7.0], None),
        ("Добавить конус", [1.0, -0.5, 6.0], Some(20.0)),
        ("Добавить куб", [4.0, -3.0, 8.0], Some(35.0)),
        ("Добавить цилиндр", [1.5, -4.0, 9.0], Some(15.0)),
    ];
    for (count, (button, position, degrees)) in placed.into_iter().enumerate() {
        window.click(button);
        window.wait_until("one more primitive", |now| now.primitives == count + 1);
        for (axis, value) in ["x", "y", "z"].into_iter().zip(position) {
            window.fill(&format!("Перемещение примитива: {axis}"), value);
        }
        if let Some(degrees) = degrees {
            window.fill("Поворот примитива: dx", degrees);
            window.click("Повернуть");
        }
    }
    window.click_at(window.last().in_picture(0.02, 0.02));
    let frame = window.screenshot("four.exr");
    let scene = saved_and_rendered_alike(&desk, &mut window, &frame);

    let size @ [width, height] = [frame.width(), frame.height()];
    let solids = || scene.primitives.iter().map(|primitive| &primitive.solid);
    let background = scene.background.as_vec3().to_array();
    let (mut looked_at, mut wrong, mut of_each) = (0, 0, [0; 4]);
    for (row, column) in (0..height).step_by(3).flat_map(|row| (0..width).step_by(3).map(move |column| (row, column))) {
        let defined = first_entered(solids(), primary_ray(&scene.camera, size, [column, row]), 0.02, 14.0);
        let is_drawn = frame.pixels()[(row * width + column) as usize] != background;
        looked_at += 1;
        wrong += u32::from(is_drawn != defined.is_some());
        defined.into_iter().for_each(|index| of_each[index] += 1);
    }
    assert!(of_each.iter().all(|&count| count > 100), "all four are to be seen: {of_each:?}");
    // Proxies: a step of 0.02 misses what a ray grazes, which is less than that of a solid's width of 2.
    assert!(wrong * 200 < looked_at, "{wrong} of {looked_at} pixels are not as defined");
    window.close();
}

#[test]
fn course_3_5_2_highlight_takes_the_light_s_colour() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    window.click("Добавить сферу");
    for (field, value) in [
        ("Перемещение примитива: x", 1.0),
        ("Перемещение примитива: y", -0.5),
        ("Перемещение примитива: z", 4.0),
        ("Материал примитива: K_s", 0.4),
        ("Параметры света: y", 2.0),
    ] {
        window.fill(field, value);
    }
    let mut lit = |file: &str, color: [f64; 3]| {
        for (channel, value) in ["R", "G", "B"].into_iter().zip(color) {
            window.fill(&format!("Параметры света: {channel}"), value);
        }
        window.screenshot(file)
    };
    let dark = lit("dark.exr", [0.0, 0.0, 0.0]);
    let white = lit("white.exr", [1.0, 1.0, 1.0]);
    const TINT: [f32; 3] = [1.0, 0.25, 0.5];
    let tinted = lit("tinted.exr", TINT.map(f64::from));
    saved_and_rendered_alike(&desk, &mut window, &tinted);

    let light = difference(&white, &dark).into_iter().zip(difference(&tinted, &dark));
    // The brightest of the sphere: there the highlight of 0.4 outshines the diffuse 0.1.
    let highlight: Vec<_> = light.filter(|(white, _)| white.iter().all(|&channel| channel > 0.3)).collect();
    assert!(highlight.len() > 100, "there is no highlight: {} pixels", highlight.len());
    for (white, tinted) in highlight {
        for channel in 0..3 {
            let share = tinted[channel] / white[channel];
            // A few roundings of `f32` in sums of magnitude 1.
            assert!((share - TINT[channel]).abs() < 1e-5, "{white:?} became {tinted:?}");
        }
    }
    window.close();
}

#[test]
fn course_3_5_3_reflections_repeat_to_depth_five_and_grow_weaker() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    window.menu(&["Галерея", "рисунок 3.7: взаимные отражения"]);
    window.wait_until("three primitives", |now| now.primitives == 3);
    assert_eq!(window.now().value("Сцена и камера: глубина отражений"), "5");
    let five = window.screenshot("depth5.exr");
    let scene = saved_and_rendered_alike(&desk, &mut window, &five);
    let mut frames: Vec<Frame> = (1..5)
        .map(|depth| {
            window.fill("Сцена и камера: глубина отражений", f64::from(depth));
            window.screenshot(&format!("depth{depth}.exr"))
        })
        .collect();
    frames.push(five);
    window.close();

    // What each generation of rays adds.
    let generations: Vec<_> = frames.windows(2).map(|pair| difference(&pair[1], &pair[0])).collect();
    let seen = seen(&scene, &frames[0]);
    let strengths: Vec<f32> =
        generations.iter().map(|added| added.iter().flatten().map(|channel| channel.abs()).sum()).collect();
    assert!(strengths[3] > 0.0 && strengths.windows(2).all(|pair| pair[1] < pair[0]), "{strengths:?}");
    // The green sphere shows the red box, in that itself, in that the box, in that itself again: in ever fewer pixels.
    const SPHERE: usize = 0;
    let dominates = |added: [f32; 3], channel: usize| added[channel] > 1.5 * added[1 - channel].abs().max(1e-3);
    let repeats = |i: usize, count: usize| (0..count).all(|depth| dominates(generations[depth][i], depth % 2));
    let chains =
        [1, 2, 3, 4].map(|count| (0..seen.len()).filter(|&i| seen[i] == Some(SPHERE) && repeats(i, count)).count());
    assert!(chains[3] >= 5 && chains.windows(2).all(|pair| pair[1] < pair[0]), "{chains:?}");
}

#[test]
fn course_3_5_4_two_solids_are_seen_in_a_third() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    window.menu(&["Галерея", "рисунок 3.8: два примитива в третьем"]);
    window.wait_until("three primitives", |now| now.primitives == 3);
    let all = window.screenshot("all.exr");
    let scene = saved_and_rendered_alike(&desk, &mut window, &all);
    let seen = seen(&scene, &all);

    // In the mirror, the red box's image is red and the green cone's green; the rest is the bluish mirror.
    let [red, green] = images(&mut window, &seen, "both");
    assert!(red > 500 && green > 200, "the mirror shows too little: {red} red pixels and {green} green ones");
    for (index, left) in [(1, [0, green]), (2, [red, 0])] {
        let pixel = middle_of(&seen, index, all.width());
        window.click_at(window.last().in_picture_pixel(pixel));
        window.wait_until("it is selected", |now| now.selection == Some(index));
        window.key("Delete");
        window.wait_until("it is gone", |now| now.primitives == 2);
        assert_eq!(
            images(&mut window, &seen, &format!("without{index}-")),
            left,
            "its image goes with it, and no other"
        );
        window.keys(&["ctrl+z"], 3);
        window.wait_until("it is back", |now| now.primitives == 3);
    }
    window.close();
}

/// How many pixels of the mirror the second generation of rays makes red, and how many green.
#[track_caller]
fn images(window: &mut Window, seen: &[Option<usize>], file: &str) -> [usize; 2] {
    const MIRROR: usize = 0;
    let mut drawn = |depth: f64| {
        window.fill("Сцена и камера: глубина отражений", depth);
        window.screenshot(&format!("{file}{depth}.exr"))
    };
    let (plain, mirrored) = (drawn(1.0), drawn(2.0));
    let added = difference(&mirrored, &plain);
    let is_of = |added: [f32; 3], channel: usize| {
        (0..3).all(|other| other == channel || added[channel] > 1.5 * added[other].abs())
    };
    [0, 1].map(|channel| (0..seen.len()).filter(|&i| seen[i] == Some(MIRROR) && is_of(added[i], channel)).count())
}

/// A pixel well within what is seen of a primitive: the middle of its middle row.
fn middle_of(seen: &[Option<usize>], index: usize, width: u32) -> [u32; 2] {
    let rows: Vec<_> = seen.chunks_exact(width as usize).enumerate().collect();
    let count = |row: &[Option<usize>]| row.iter().filter(|seen| **seen == Some(index)).count();
    let (row, pixels) = rows.iter().max_by_key(|(_, pixels)| count(pixels)).expect("a row");
    let columns: Vec<_> = (0..width).filter(|&column| pixels[column as usize] == Some(index)).collect();
    [columns[columns.len() / 2], *row as u32]
}

#[test]
fn course_3_5_5_changing_absent_primitives_warns() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    for button in ["Переместить", "Повернуть"] {
        window.click(button);
        let warned = window.wait_until("a warning", |now| now.dialog.is_some());
        assert!(warned.says("Ошибка") && warned.says("Не добавлено ни одного примитива."));
        window.click("OK");
        let now = window.wait_until("the warning is gone", |now| now.dialog.is_none());
        assert_eq!((now.primitives, now.has_unsaved_changes), (0, false));
    }
    assert!(window.now().widget("Материал примитива: R").is_disabled, "there is no material to change");
    window.close();
}

#[test]
fn course_3_5_6_the_101st_primitive_warns() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    window.click("Добавить куб");
    window.wait_until("a primitive", |now| now.primitives == 1);
    for count in 2..=100 {
        window.click_again();
        window.wait_until("one more", |now| now.primitives == count);
    }
    assert_eq!(window.now().selected_name(), "Куб100");
    for again in ["the button", "Ctrl-D"] {
        if again == "Ctrl-D" {
            window.key("ctrl+d");
        } else {
            window.click("Добавить сферу");
        }
        let warned = window.wait_until("a warning", |now| now.dialog.is_some());
        assert!(warned.says("Ошибка") && warned.says("Превышено максимальное число примитивов"), "by {again}");
        assert_eq!(warned.primitives, 100);
        // The first frames of a dialog are laid out anew.
        window.settle();
        window.click("OK");
        window.wait_until("the warning is gone", |now| now.dialog.is_none() && now.primitives == 100);
    }
    window.close();
}
