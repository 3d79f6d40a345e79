//! Names, choosing, deleting, undo.

use egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;
use zerkalo::scene::Scene;
use zerkalo::settings::Shading;
use zerkalo::viewer::preferences::Language;

use crate::hands::*;

#[test]
fn a_typed_name_renames_and_an_empty_one_gives_the_number_back() {
    for (language, add, field, list, numbered) in [
        (Language::Russian, "Добавить сферу", "Имя примитива", "Выбранный примитив", "Сфера1"),
        (Language::English, "Add a sphere", "Name of the primitive", "Selected primitive", "Sphere1"),
    ] {
        let mut window = open(language);
        click(&mut window, add);
        retype(&mut window, field, "левый шар");
        press(&mut window, Modifiers::NONE, Key::Enter);
        assert_eq!(
            (selected(&window).name.as_deref(), value(&window, list).as_str()),
            (Some("левый шар"), "левый шар")
        );
        retype(&mut window, field, " ");
        press(&mut window, Modifiers::NONE, Key::Enter);
        assert_eq!((selected(&window).name.as_deref(), value(&window, list).as_str()), (None, numbered));
    }
}

#[test]
fn primitives_are_chosen_from_a_list_of_all_names() {
    let mut window = open(Language::Russian);
    for what in ["сферу", "конус", "сферу"] {
        click(&mut window, &format!("Добавить {what}"));
    }
    for (name, index) in [("Конус1", Some(1)), ("Сфера1", Some(0)), ("не выбран", None)] {
        click(&mut window, "Выбранный примитив");
        click(&mut window, name);
        assert_eq!(window.state().state.document.selection(), index, "{name}");
        assert_eq!(value(&window, "Выбранный примитив"), name);
    }
}

#[test]
fn delete_removes_the_selected_primitive_but_not_while_typing() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    begin_to_type(&mut window, "Перемещение примитива: x", "3");
    press(&mut window, Modifiers::NONE, Key::Delete);
    click(&mut window, "Имя примитива");
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(scene(&window).primitives.len(), 1);
    press(&mut window, Modifiers::NONE, Key::Enter);
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(scene(&window).primitives.len(), 0);
}

#[test]
fn undo_and_redo_answer_to_their_keys() {
    let mut window = open(Language::English);
    click(&mut window, "Add a sphere");
    click(&mut window, "Add a cone");
    let count = |window: &Window| scene(window).primitives.len();
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(count(&window), 0);
    press(&mut window, REDO, Key::Z);
    assert_eq!(count(&window), 1);
    press(&mut window, Modifiers::COMMAND, Key::Y);
    assert_eq!(count(&window), 2);
}

#[test]
fn a_drag_is_one_step_back_and_so_is_each_typed_value() {
    let mut window = open(Language::Russian);
    let name = "Параметры света: y";
    type_into(&mut window, name, "1");
    type_into(&mut window, name, "2");
    let start = window.get_by_label(name).rect().center();
    window.hover_at(start);
    window.drag_at(start);
    for point in 1..=40_u16 {
        window.hover_at(start + Vec2::new(f32::from(point), 0.0));
    }
    window.drop_at(start + Vec2::new(40.0, 0.0));
    window.run();
    assert!(scene(&window).lights[0].position.y > 5.0);
    for expected in ["2", "1", "0"] {
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(value(&window, name), expected);
    }
    assert!(!window.state().state.document.can_undo());
}

/// In both languages, and undone step by step.
fn shading(window: &Window) -> Shading {
    let state = &window.state().state;
    state.shading_by(state.kernel)
}

#[test]
fn glass_is_made_in_the_panel_and_undone() {
    for (language, add, material, n, index, own, light, fades, ambient, phong) in [
        (
            Language::Russian,
            "Добавить сферу",
            "Материал примитива",
            "n (степень)",
            "η (показатель преломления)",
            "Зеркало со своим весом",
            "Параметры света",
            "Ослабевает с расстоянием",
            "Рассеянный свет",
            "Фонга",
        ),
        (
            Language::English,
            "Add a sphere",
            "Material of the primitive",
            "n (exponent)",
            "η (refractive index)",
            "Mirror by a weight of its own",
            "Light",
            "Fades with distance",
            "Ambient light",
            "Phong",
        ),
    ] {
        let mut window = open(language);
        click(&mut window, add);
        let before = selected(&window).material.clone();
        type_into(&mut window, &format!("{material}: K_t"), "0.8");
        type_into(&mut window, &format!("{material}: {n}"), "33");
        type_into(&mut window, &format!("{material}: {index}"), "1.5");
        click(&mut window, own);
        type_into(&mut window, &format!("{material}: K_r"), "0.2");
        let glass = selected(&window).material.clone();
        assert_eq!((glass.transmission, glass.shininess, glass.refractive_index), (0.8, 33.0, 1.5));
        assert_eq!((glass.reflection, glass.specular), (Some(0.2), before.specular));
        click(&mut window, &format!("{light}: {fades}"));
        type_into(&mut window, &format!("{light}: K"), "2");
        type_into(&mut window, &format!("{ambient}: G"), "0.5");
        assert_eq!(scene(&window).lights[0].distance_constant, Some(2.0));
        assert_eq!(scene(&window).ambient_light.y, 0.5);
        click(&mut window, phong);
        assert_eq!(shading(&window), Shading::Phong);
        while window.state().state.document.can_undo() {
            press(&mut window, Modifiers::COMMAND, Key::Z);
        }
        assert_eq!(scene(&window).ambient_light, Scene::default().ambient_light);
        assert_eq!(scene(&window).lights[0].distance_constant, None);
    }
}

#[test]
fn duplicating_answers_to_its_key_and_its_button() {
    let mut window = open(Language::English);
    click(&mut window, "Add a cone");
    press(&mut window, Modifiers::COMMAND, Key::D);
    click(&mut window, "Duplicate the primitive");
    assert_eq!(scene(&window).primitives.len(), 3);
}

#[test]
fn keys_pressed_within_one_frame_are_all_answered_in_their_turn() {
    let mut window = open(Language::English);
    click(&mut window, "Add a sphere");
    let key = |key, modifiers| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    let keys = [
        key(Key::D, Modifiers::COMMAND),
        key(Key::D, Modifiers::COMMAND),
        key(Key::Delete, Modifiers::NONE),
        key(Key::Z, Modifiers::COMMAND),
        key(Key::Z, Modifiers::COMMAND),
        key(Key::Z, REDO),
    ];
    window.input_mut().events.extend(keys);
    window.run();
    assert_eq!(scene(&window).primitives.len(), 3, "two more, one less, twice back, once forth");
}
