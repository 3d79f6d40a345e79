//! How numbers are shown, typed and dragged.

use egui::{Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;
use glam::DVec3;
use zerkalo::scene::{Primitive, Scene, Solid, SolidKind};
use zerkalo::viewer::action::Action;
use zerkalo::viewer::preferences::Language;

use crate::hands::*;

#[test]
fn a_light_is_edited_at_once_and_its_intensity_may_be_any() {
    let mut window = open(Language::Russian);
    type_into(&mut window, "Параметры света: x", "2.5");
    type_into(&mut window, "Параметры света: G", "7");
    click(&mut window, "Добавить источник света");
    type_into(&mut window, "Параметры света 2: z", "-1");
    let lights = &scene(&window).lights;
    assert_eq!((lights[0].position, lights[0].intensity), (DVec3::new(2.5, 0.0, 0.0), DVec3::new(1.0, 7.0, 1.0)));
    assert_eq!(lights[1].position.z, -1.0);
    click(&mut window, "Удалить источник света 1");
    assert_eq!(scene(&window).lights.len(), 1);
    assert_eq!(value(&window, "Параметры света: z"), "-1");
}

#[test]
fn values_outside_the_range_are_clamped_and_what_is_no_number_is_ignored() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    for (name, text, expected) in [
        ("Перемещение примитива: x", "5000", "1000"),
        ("Перемещение примитива: y", "-1e9", "-1000"),
        ("Перемещение примитива: z", "nan", "0"),
        ("Материал примитива: R", "7", "1"),
        ("Материал примитива: K_d", "inf", "0.1"),
        ("Форма примитива: радиус", "-1", "1e-6"),
        ("Поворот примитива: dx", "361", "360"),
        ("Сцена и камера: глубина отражений", "0", "1"),
        ("Сцена и камера: глубина отражений", "1e7", "1000"),
        ("Сцена и камера: угол обзора по вертикали, °", "180", "179.999"),
    ] {
        type_into(&mut window, name, text);
        assert_eq!(value(&window, name), expected, "{name} after {text}");
    }
    scene(&window).validate().unwrap();
}

#[test]
fn arrow_keys_go_by_the_course_s_steps_and_stop_at_the_end_of_the_range() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    for (name, before, after) in [
        ("Перемещение примитива: x", "0", "0.5"),
        ("Материал примитива: K_s", "0.1", "0.15"),
        ("Параметры света: x", "1000", "1000"),
    ] {
        type_into(&mut window, name, before);
        click(&mut window, name);
        press(&mut window, Modifiers::NONE, Key::ArrowUp);
        press(&mut window, Modifiers::NONE, Key::Enter);
        assert_eq!(value(&window, name), after, "{name}");
    }
}

#[test]
fn dragging_goes_through_every_step() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    for (name, step) in [("Перемещение примитива: x", 0.5), ("Параметры света: R", -0.05)]
    {
        let start = window.get_by_label(name).rect().center();
        let mut seen: Vec<f64> = vec![value(&window, name).parse().unwrap()];
        window.hover_at(start);
        window.drag_at(start);
        for point in 1..=60_u16 {
            window.hover_at(start + Vec2::new(f32::from(point).copysign(step as f32), 0.0));
            window.run();
            seen.push(value(&window, name).parse().unwrap());
        }
        window.drop_at(start);
        window.run();
        seen.dedup();
        assert!(seen.len() > 10, "{name}: {seen:?}");
        let is_a_step = |pair: &[f64]| (pair[1] - pair[0] - step).abs() < 1e-12;
        assert!(seen.windows(2).all(is_a_step), "{name}: {seen:?}");
    }
}

#[test]
fn looking_at_a_number_does_not_change_it() {
    let mut sphere = Primitive::course_default(SolidKind::Sphere);
    sphere.name = Some(" шар ".to_owned());
    sphere.solid = Solid::Sphere { center: DVec3::new(5000.0, 1.0 / 3.0, 0.0), radius: 1e-8 };
    let scene_before = Scene { primitives: vec![sphere], ..Scene::default() };
    let mut window = open_with(scene_before.clone(), Language::Russian);
    apply(&mut window, Action::Select(Some(0)));
    for name in ["Перемещение примитива: x", "Перемещение примитива: y", "Форма примитива: радиус"]
    {
        click(&mut window, name);
        press(&mut window, Modifiers::NONE, Key::Enter);
        click(&mut window, name);
        press(&mut window, Modifiers::NONE, Key::Tab);
        click(&mut window, name);
        click(&mut window, "Имя примитива");
    }
    assert_eq!(scene(&window), &scene_before);
    assert!(!window.state().state.document.has_unsaved_changes());
}

#[test]
fn escape_gives_up_what_was_typed_and_nothing_more() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    begin_to_type(&mut window, "Перемещение примитива: x", "77");
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(3);
    assert_eq!(selected(&window).solid.position(), DVec3::ZERO);
    retype(&mut window, "Имя примитива", "шар");
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(3);
    assert_eq!(selected(&window).name, None);
    assert_eq!(value(&window, "Имя примитива"), "");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().state.document.selection(), None);
}

#[test]
fn what_was_typed_goes_to_the_primitive_that_was_selected_then() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    click(&mut window, "Добавить куб");
    begin_to_type(&mut window, "Перемещение примитива: x", "9");
    click(&mut window, "Предыдущий примитив");
    retype(&mut window, "Имя примитива", "шар");
    click(&mut window, "Добавить конус");
    let primitives = &scene(&window).primitives;
    assert_eq!((primitives[0].name.as_deref(), primitives[0].solid.position().x), (Some("шар"), 0.0));
    assert_eq!((primitives[1].name.as_deref(), primitives[1].solid.position().x), (None, 9.0));
    assert_eq!(primitives[2], Primitive::course_default(SolidKind::Cone));
}
