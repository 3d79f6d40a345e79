//! The picture in the window is the picture.

use zerkalo::frame::{Frame, display_value};
use zerkalo::scene::gallery;
use zerkalo::viewer::pick::pick;

use crate::driver::{Desk, Locale};

fn display_values(frame: &Frame) -> Vec<[u8; 3]> {
    frame.pixels().iter().map(|pixel| pixel.map(display_value)).collect()
}

#[test]
fn screenshots_and_the_window_s_own_pixels_are_the_rendered_picture() {
    let desk = Desk::new(Locale::Russian, [701, 503]);
    for name in ["showcase", "several", "grid-cone-30"] {
        let mut window = desk.view(&[name]);
        let now = window.now().clone();
        let rendered = desk.render(name, now.picture_size);
        let exr = window.screenshot("window.exr");
        assert!(exr == rendered, "{name}: the EXR file is not what `zerkalo render` makes");
        let png = window.screenshot("window.png");
        assert_eq!(display_values(&png), display_values(&rendered), "{name}");

        let desktop = desk.display.screenshot(&desk.path("desktop.png"));
        let ([left, top], [width, height]) = (now.picture_corner, now.picture_size);
        let rows = desktop.rows().skip(top as usize).take(height as usize);
        let shown = rows.flat_map(|row| &row[left as usize..(left + width) as usize]);
        for (i, (shown, rendered)) in shown.zip(display_values(&rendered)).enumerate() {
            let shown = shown.map(display_value);
            // The device rounds to eight bits by itself.
            let is_near = (0..3).all(|channel| shown[channel].abs_diff(rendered[channel]) <= 1);
            assert!(is_near, "{name}: pixel {i} is shown as {shown:?} and should be {rendered:?}");
        }
        std::fs::remove_file(desk.path("window.exr")).unwrap();
        std::fs::remove_file(desk.path("window.png")).unwrap();
        window.close();
    }
}

#[test]
fn the_gallery_s_menu_opens_its_scenes() {
    let desk = Desk::new(Locale::Russian, [700, 500]);
    let mut window = desk.view(&["start"]);
    for (path, name) in [
        (&["Галерея", "четыре тела среди зеркал"][..], "showcase"),
        (&["Галерея", "рисунок 3.6: изменённый цвет источника"], "light"),
        (&["Галерея", "Таблица 4.1: цилиндры", "таблица 4.1: цилиндры, 30"], "grid-cylinder-30"),
    ] {
        window.menu(path);
        let count = gallery::scene(name).unwrap().primitives.len();
        window.wait_until("it is opened", |now| now.primitives == count);
        let size = window.settle().picture_size;
        let file = format!("{name}.exr");
        assert!(window.screenshot(&file) == desk.render_by("course", name, size), "{name}");
    }
    window.close();
}

#[test]
fn the_accurate_model_draws_when_it_is_chosen() {
    let desk = Desk::new(Locale::Russian, [560, 300]);
    let mut window = desk.view(&["four"]);
    window.click("Курсовая (Vulkan)");
    window.wait_until("the course's", |now| now.kernel == "course" && now.is_whole);
    let course = window.screenshot("course.exr");
    window.click("Точная модель (ЦП)");
    window.wait_until("the other picture", |now| now.kernel == "reference" && now.is_whole);
    let accurate = window.screenshot("accurate.exr");
    assert!(accurate != course, "a cone has a base, and highlights are where the light is");
    window.click("Курсовая (Vulkan)");
    window.wait_until("the first again", |now| now.kernel == "course" && now.is_whole);
    assert!(window.screenshot("again.exr") == course);
    window.close();
}

#[test]
fn the_accurate_kernel_draws_on_the_device_with_as_many_lights_as_there_are() {
    let desk = Desk::new(Locale::Russian, [560, 300]);
    let mut window = desk.view(&["four"]);
    window.fill("Сцена и камера: лучей на пиксель", 1.0);
    window.wait_until("it draws", |now| now.kernel == "whitted f32" && now.is_whole);
    let size = window.settle().picture_size;
    assert!(window.screenshot("f32.exr") == desk.render_by("whitted", "four", size));
    window.click("Добавить источник света");
    window.wait_until("a second light", |now| now.lights == 2 && now.is_whole && now.refusal.is_none());
    window.save_as("two.toml");
    assert_eq!(desk.scene("two.toml").lights.len(), 2);
    let size = window.settle().picture_size;
    assert!(window.screenshot("two lights.exr") == desk.render_by("whitted", "two.toml", size));
    window.click("Точная f64 (Vulkan)");
    window.wait_until("twice the digits", |now| now.kernel == "whitted f64" && now.is_whole && now.refusal.is_none());
    window.close();
}

#[test]
fn samples_are_added_while_the_window_rests_and_the_scale_changes_what_is_traced_alone() {
    let desk = Desk::new(Locale::Russian, [560, 300]);
    let mut window = desk.view(&["four"]);
    let (size, traced) = (window.settle().picture_size, window.last().pictures_traced);
    window.fill("Сцена и камера: лучей на пиксель", 5.0);
    window.wait_until("all samples", |now| now.is_finished && now.pictures_traced >= traced + 5);
    let traced = window.settle().pictures_traced;
    assert!(window.screenshot("samples.exr") == desk.render_with(&["--samples", "5"], "four", size));
    assert_eq!(window.settle().pictures_traced, traced, "it rests");

    window.fill("Сцена и камера: масштаб трассировки", 0.5);
    window.wait_until("a smaller picture", |now| now.is_finished && now.pictures_traced >= traced + 5);
    let scaled = desk.render_with(&["--samples", "5", "--scale", "0.5"], "four", size);
    assert!(window.screenshot("scaled.exr") == scaled);
    // What is seen is what is picked.
    let scene = gallery::scene("four").unwrap();
    let is_seen = |&(x, y): &(u32, u32)| pick(&scene, size[0], size[1], x, y).is_some();
    let (x, y) = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).find(is_seen).expect("a primitive");
    let chosen = pick(&scene, size[0], size[1], x, y);
    let place = window.now().in_picture_pixel([x, y]);
    window.click_at(place);
    window.wait_until("it is selected", |now| now.selection == chosen);
    window.close();
}

#[test]
fn the_first_picture_is_refined_while_the_window_rests_and_any_change_begins_with_one_sample() {
    let desk = Desk::new(Locale::Russian, [560, 300]);
    let mut window = desk.start(&["four"]);
    let whole = window.wait_until("the first picture", |now| now.is_whole);
    assert_eq!((whole.kernel.as_str(), whole.is_finished), ("whitted f32", false), "samples are still to come");
    let now = window.settle();
    assert_eq!(now.pictures_traced, 16);
    assert!(window.screenshot("rest.exr") == desk.render("four", now.picture_size));
    // The same picture for as long as nothing changes; then the first sample of the next, and the others again.
    let before = window.settle().pictures_traced;
    window.click("Следующий примитив");
    window.wait_until("the sphere is selected", |now| now.selection == Some(0));
    window.settle();
    assert_eq!(window.now().pictures_traced, before, "a choice is no change");
    window.key("Delete");
    let edited = window.wait_until("the edit is shown", |now| now.primitives == 3 && now.is_whole);
    assert!(!edited.is_finished, "{}", edited.in_short());
    window.save_as("three.toml");
    assert!(window.screenshot("three.exr") == desk.render("three.toml", now.picture_size));
    window.close();
}

#[test]
fn a_settings_file_draws_as_it_does_in_render_until_another_kernel_is_chosen() {
    let desk = Desk::new(Locale::Russian, [560, 300]);
    let setting = "kernel = \"plain\"\nerror = 0.1\nmax_depth = 3\n";
    std::fs::write(desk.path("fast.toml"), setting).unwrap();
    let mut window = desk.view(&["corridor", "--settings", "fast.toml"]);
    assert_eq!(window.now().kernel, "setting");
    let size = window.settle().picture_size;
    assert!(window.screenshot("fast.exr") == desk.render_with(&["--settings", "fast.toml"], "corridor", size));
    window.click("Курсовая (Vulkan)");
    window.wait_until("the course's", |now| now.kernel == "course" && now.is_whole);
    assert!(window.screenshot("course.exr") == desk.render_by("course", "corridor", size));
    window.click("Файл настроек (Vulkan)");
    window.wait_until("the file's again", |now| now.kernel == "setting" && now.is_whole);
    window.close();
}

#[test]
fn a_screenshot_is_taken_while_picture_follows_picture() {
    let desk = Desk::new(Locale::Russian, [700, 500]);
    let mut window = desk.view(&["four"]);
    let size = window.now().picture_size;
    window.click("Непрерывная трассировка");
    window.wait_until("it is on", |now| now.value("Непрерывная трассировка") == "True");
    window.key("F12");
    window.type_into("Имя файла", "moving.exr");
    window.wait_until("the dialog closes", |now| now.dialog.is_none());
    let traced = window.now().pictures_traced;
    window.wait_until("many more pictures", |now| now.pictures_traced > traced + 20);
    assert!(desk.path("moving.exr").exists(), "it waits for a rest that does not come");
    window.click("Непрерывная трассировка");
    window.settle();
    assert!(Frame::load(&desk.path("moving.exr")).unwrap() == desk.render("four", size));
    window.close();
}

/// The same two programs' pictures as `render` makes of them; beside each other, each has its columns.
#[test]
fn all_algorithms_are_chosen_and_two_of_them_stand_side_by_side() {
    let desk = Desk::new(Locale::English, [760, 320]);
    let mut window = desk.view(&["showcase"]);
    window.click("Screen space (Vulkan)");
    window.wait_until("screen space", |now| now.kernel == "ssr" && now.is_finished);
    let size = window.settle().picture_size;
    let ssr = window.screenshot("ssr.exr");
    assert!(ssr == desk.render_by("ssr", "showcase", size));

    // More than the samples at fixed places that other kernels have.
    window.click("Path tracing (Vulkan)");
    window.fill("Scene and camera: paths per pixel", 70.0);
    let now = window.wait_until("path tracing", |now| now.kernel == "path f32" && now.is_finished);
    assert!(now.says("70/70 paths"), "{}", now.in_short());
    let is_estimate = |text: &str| text.strip_prefix("error ≈ ").is_some_and(|error| error.parse::<f64>().is_ok());
    let is_told = now.widgets.iter().any(|widget| is_estimate(&widget.name) || is_estimate(&widget.value));
    assert!(is_told, "{:?}", now.widgets);
    let path = window.screenshot("path.exr");
    let rendered = desk.render_with(&["--algorithm", "path", "--samples", "70"], "showcase", size);
    // One keeps the mean in f32 from path to path, which moves it by (n + 1)/2 + 3 = 38.5 units of 2⁻²⁴ of the largest
    // sample at most (settings::sampling); the other keeps it in f64, of runs of eight, 7.5 units. 140 of them are
    // allowed: samples up to three times as bright as the brightest pixel.
    let most = |frame: &Frame| frame.pixels().iter().flatten().copied().fold(1.0, f32::max);
    let bound = 70.0 * f32::EPSILON * most(&rendered);
    for (pixel, rendered) in path.pixels().iter().flatten().zip(rendered.pixels().iter().flatten()) {
        assert!((pixel - rendered).abs() <= bound, "{pixel} {rendered}");
    }

    window.click("Scene and camera: Right of the divider");
    window.click("Right of the divider: Screen space (Vulkan)");
    window.wait_until("both", |now| now.is_finished && now.says("Path tracing (Vulkan) | Screen space (Vulkan)"));
    let divider = window.settle().find("Divider").expect("a divider").middle();
    window.move_mouse(divider);
    window.press(1);
    // A hand is not so fast that all of it lies in one frame, of which egui looks only at the mouse's last position.
    std::thread::sleep(std::time::Duration::from_millis(300));
    window.move_mouse([divider[0] - 60.0, divider[1]]);
    window.wait_until("it follows the mouse", |now| {
        now.find("Divider").is_some_and(|there| there.middle()[0] < divider[0] - 50.0)
    });
    window.release(1);
    let now = window.settle();
    assert_eq!(now.selection, None, "a drag of the divider is no click into the picture");
    let column = now.find("Divider").unwrap().middle()[0] - f64::from(now.picture_corner[0]);
    let both = window.screenshot("both.exr");
    let parted = both.rows().zip(path.rows().zip(ssr.rows())).all(|(row, (left, right))| {
        // Where the divider's middle is not known to the pixel, either may be.
        let (near, far) = (column as usize - 2, column as usize + 2);
        row[..near] == left[..near] && row[far..] == right[far..]
    });
    assert!(parted, "the left columns are one's, the right columns the other's");
    window.click("Scene and camera: Right of the divider");
    window.click("Right of the divider: nothing: one picture");
    window.wait_until("one picture", |now| now.is_finished && now.find("Divider").is_none());
    assert!(window.screenshot("path again.exr") == path);
    window.close();
}

#[test]
fn a_settings_file_may_ask_for_many_paths() {
    let desk = Desk::new(Locale::Russian, [560, 300]);
    std::fs::write(desk.path("paths.toml"), "kernel = \"path\"\nsamples = 100\n").unwrap();
    let mut window = desk.view(&["four", "--settings", "paths.toml"]);
    let now = window.wait_until("all of them", |now| now.is_finished);
    assert!(now.says("100/100 путей"), "{}", now.in_short());
    window.close();
}

/// What stands on the base of a cone of 10⁷: f32 has no shadows there.
#[test]
fn where_f32_is_too_coarse_f64_draws_and_f32_is_warned_of() {
    let desk = Desk::new(Locale::English, [900, 700]);
    let base = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/wide_base.toml");
    std::fs::copy(base, desk.path("base.toml")).unwrap();
    let mut window = desk.view(&["base.toml"]);
    let now = window.wait_until("it is drawn", |now| now.is_whole);
    assert_eq!(now.kernel, "whitted f64");
    let warning = "The picture is wrong: f32 is too coarse for it";
    assert!(!now.says(warning), "{}", now.in_short());
    window.click("Accurate f32 (Vulkan)");
    let now = window.wait_until("as told, and warned of", |now| now.kernel == "whitted f32" && now.is_whole);
    assert!(now.says(warning), "{}", now.in_short());
    window.click("Accurate (Vulkan)");
    window.wait_until("right again", |now| now.kernel == "whitted f64" && now.is_whole && !now.says(warning));
    window.close();

    std::fs::write(desk.path("f32.toml"), "kernel = \"whitted\"\nprecision = \"f32\"\n").unwrap();
    let mut window = desk.view(&["base.toml", "--settings", "f32.toml"]);
    window.wait_until("as the file says, and warned of", |now| now.is_whole && now.says(warning));
    window.close();
}
