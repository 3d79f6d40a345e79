//! Language, looks, menus and what is told of the tracing.

use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use zerkalo::scene::gallery;
use zerkalo::settings::sampling::Sampling;
use zerkalo::tracer::Precision;
use zerkalo::viewer::action::{Action, Effect, Kernel};
use zerkalo::viewer::own_kernel::OwnKernel;
use zerkalo::viewer::panel::Paths;
use zerkalo::viewer::preferences::{Language, Preferences, Theme};
use zerkalo::viewer::state::{Dialog, FilePurpose};

use crate::hands::*;

#[test]
fn the_language_is_switched_in_the_menu_and_changes_every_label() {
    let mut window = open(Language::Russian);
    for (view, menu, language, here, gone) in [
        ("Вид", "Язык", "English", "Material of the primitive", "Материал примитива"),
        ("View", "Language", "Русский", "Материал примитива", "Material of the primitive"),
    ] {
        click(&mut window, view);
        window.get_by_label(menu).hover();
        window.run();
        click(&mut window, language);
        press(&mut window, Modifiers::NONE, Key::Escape);
        assert!(is_there(&window, here) && !is_there(&window, gone), "{language}");
    }
}

#[test]
fn theme_and_scale_are_what_is_preferred() {
    let mut window = open(Language::English);
    let preferences = Preferences { theme: Theme::Light, ui_scale: 1.5, ..window.state().state.preferences.clone() };
    apply(&mut window, Action::SetPreferences(preferences));
    assert_eq!((window.ctx.theme(), window.ctx.zoom_factor()), (egui::Theme::Light, 1.5));
}

#[test]
fn the_rate_is_a_dash_or_a_number_above_zero() {
    let mut window = open(Language::English);
    assert!(is_there(&window, "FPS: —") && is_there(&window, "Median: —"));
    for sample_ns in [0, 1, 16_666_667, u64::MAX] {
        window.state_mut().frame_times.clear();
        window.state_mut().frame_times.push(sample_ns);
        window.run();
        for node in window.get_all_by_label_contains("FPS") {
            let text = node.value().unwrap_or_default();
            let has_digit = text.contains(|c: char| ('1'..='9').contains(&c));
            assert!(has_digit && !text.contains("inf") && !text.contains("NaN"), "{sample_ns} ns: {text}");
        }
    }
    window.state_mut().frame_times.clear();
    window.state_mut().frame_times.push(20_000_000);
    window.run();
    assert!(is_there(&window, "FPS: 50.0") && is_there(&window, "99th percentile: 20.0 ms"));
}

#[test]
fn camera_and_kernel_answer_to_their_widgets() {
    let mut window = open(Language::Russian);
    type_into(&mut window, "Сцена и камера: глубина отражений", "5");
    type_into(&mut window, "Сцена и камера: угол обзора по вертикали, °", "40");
    type_into(&mut window, "Сцена и камера: скорость полёта, ед./с", "8");
    type_into(&mut window, "Фон: B", "1.5");
    for button in ["как в курсовой", "Точная модель (ЦП)", "Инвертировать мышь", "Непрерывная трассировка"]
    {
        click(&mut window, button);
    }
    for (button, kernel) in [
        ("Точная f64 (Vulkan)", Kernel::Own(OwnKernel { precision: Some(Precision::F64), ..OwnKernel::ACCURATE })),
        ("Точная f32 (Vulkan)", Kernel::Own(OwnKernel { precision: Some(Precision::F32), ..OwnKernel::ACCURATE })),
        ("Курсовая (Vulkan)", Kernel::Own(OwnKernel::COURSE)),
        ("Точная модель (ЦП)", Kernel::Own(OwnKernel::REFERENCE)),
    ] {
        click(&mut window, button);
        assert_eq!(window.state().state.kernel, kernel);
    }
    let state = &window.state().state;
    let scene = state.document.scene();
    assert_eq!((scene.max_depth, scene.camera.vertical_fov_degrees, scene.background.z), (5, 40.0, 1.5));
    assert_eq!((scene.camera.projection.name(), state.kernel), ("course", Kernel::Own(OwnKernel::REFERENCE)));
    assert_eq!(state.preferences.fly_speed, 8.0);
    assert!(state.preferences.is_mouse_inverted && state.is_continuous);
}

fn sampling(window: &Window) -> Sampling {
    let state = &window.state().state;
    state.sampling(state.kernel)
}

#[test]
fn samples_and_scale_are_set_where_the_kernel_has_them_and_stay_in_range() {
    let mut window = open(Language::English);
    let (samples, scale) = ("Scene and camera: samples per pixel", "Scene and camera: render scale");
    let is_enabled = |window: &Window, name: &str| !window.get_by_label(name).accesskit_node().is_disabled();
    click(&mut window, "Course (Vulkan)");
    assert!(!is_enabled(&window, samples) && !is_enabled(&window, scale), "the course kernel knows but one way");
    click(&mut window, "Accurate f32 (Vulkan)");
    assert!(is_enabled(&window, samples) && is_enabled(&window, scale));
    assert_eq!(sampling(&window), Sampling { samples: 16, scale: 1.0 }, "until told otherwise");
    for (typed, taken) in [("5", 5), ("0", 1), ("1000", 64), ("2.6", 3)] {
        type_into(&mut window, samples, typed);
        assert_eq!(sampling(&window).samples, taken, "{typed}");
    }
    for (typed, taken) in [("0,5", 0.5), ("0", 0.25), ("7", 1.0), ("0.3", 0.3)] {
        type_into(&mut window, scale, typed);
        assert_eq!(sampling(&window), Sampling { samples: 3, scale: taken }, "{typed}");
    }
    click(&mut window, "Reference (CPU)");
    assert_eq!(sampling(&window), Sampling::PLAIN);
    click(&mut window, "Accurate f64 (Vulkan)");
    assert_eq!(sampling(&window), Sampling { samples: 3, scale: 0.3 });
}

#[test]
fn paths_have_a_number_of_their_own_and_are_told_with_their_error() {
    let mut window = open(Language::English);
    let paths = "Scene and camera: paths per pixel";
    let is_enabled = |window: &Window, name: &str| !window.get_by_label(name).accesskit_node().is_disabled();
    assert!(!is_enabled(&window, paths));
    click(&mut window, "Path tracing (Vulkan)");
    assert_eq!(sampling(&window), Sampling { samples: 1024, scale: 1.0 }, "until told otherwise");
    for (typed, taken) in [("100000", 100_000), ("0", 1), ("1e12", 1 << 30)] {
        type_into(&mut window, paths, typed);
        assert_eq!(sampling(&window).samples, taken, "{typed}");
    }
    window.state_mut().paths = Some(Paths { so_far: 64, asked_for: 1024, error: None });
    window.run();
    assert!(is_there(&window, "64/1024 paths") && window.query_by_label_contains("error").is_none());
    window.state_mut().paths = Some(Paths { so_far: 128, asked_for: 1024, error: Some(0.003_124) });
    window.run();
    assert!(is_there(&window, "128/1024 paths") && is_there(&window, "error ≈ 0.00312"));
}

#[test]
fn a_second_kernel_is_chosen_from_a_list_and_the_divider_is_dragged() {
    let mut window = open(Language::English);
    assert!(!is_there(&window, "Divider"));
    click(&mut window, "Scene and camera: Right of the divider");
    click(&mut window, "Right of the divider: Reference (CPU)");
    assert_eq!(window.state().state.beside, Some(Kernel::Own(OwnKernel::REFERENCE)));
    for (share, taken) in [(0.25, 0.25), (-1.0, 0.0), (7.0, 1.0)] {
        apply(&mut window, Action::MoveDivider(share));
        assert_eq!(window.state().state.divider, taken);
    }
    apply(&mut window, Action::MoveDivider(0.5));
    let (from, picture) = (window.get_by_label("Divider").rect().center(), window.state().picture);
    let to = from + egui::vec2(picture.width() / 4.0, 0.0);
    window.drag_at(from);
    window.run();
    window.hover_at(to);
    window.run();
    window.drop_at(to);
    window.run();
    let divider = window.state().state.divider;
    assert!((divider - 0.75).abs() < 0.01, "{divider}");
}

#[test]
fn gallery_scenes_open_by_their_description() {
    let mut window = open(Language::Russian);
    click(&mut window, "Галерея");
    click(&mut window, "рисунок 3.5: четыре примитива");
    assert_eq!(scene(&window), &gallery::scene("four").unwrap());
    click(&mut window, "Галерея");
    window.get_by_label("Таблица 4.1: конусы").hover();
    window.run();
    click(&mut window, "таблица 4.1: конусы, 20");
    assert_eq!(scene(&window), &gallery::scene("grid-cone-20").unwrap());
}

#[test]
fn the_menus_do_what_the_keys_do() {
    let mut window = open(Language::English);
    click(&mut window, "Add a sphere");
    for (menu, item) in [("Edit", "Duplicate"), ("Edit", "Delete"), ("Edit", "Undo"), ("Edit", "Undo")] {
        click(&mut window, menu);
        click(&mut window, item);
    }
    assert_eq!(scene(&window).primitives.len(), 1);
    click(&mut window, "File");
    click(&mut window, "Save as…");
    assert_eq!(window.state().state.dialog, Some(Dialog::File(FilePurpose::Save)));
    click(&mut window, "Cancel");
    click(&mut window, "File");
    click(&mut window, "Quit");
    click(&mut window, "Do not save");
    assert_eq!(window.state().effects, [Effect::Quit]);
}
