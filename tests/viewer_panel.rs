//! The panel driven by its names, as a screen reader would drive it: a real state, no window, no device.

use std::path::Path;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use glam::DVec3;
use zerkalo::scene::{Primitive, Scene, Solid, SolidKind, gallery};
use zerkalo::viewer::action::{Action, Effect, Kernel};
use zerkalo::viewer::document::Document;
use zerkalo::viewer::frame_times::FrameTimes;
use zerkalo::viewer::panel::{Panel, Readings, style};
use zerkalo::viewer::preferences::{Language, Preferences, Theme};
use zerkalo::viewer::state::{Dialog, FilePurpose, Message, State};

/// What the program is without its window.
struct App {
    state: State,
    panel: Panel,
    frame_times: FrameTimes,
    refusal: Option<&'static str>,
    effects: Vec<Effect>,
    picture: Rect,
}

type Window = Harness<'static, App>;

const BOTH: [Language; 2] = [Language::Russian, Language::English];
const SIZE: Vec2 = Vec2::new(1280.0, 1500.0);

fn open_with(scene: Scene, language: Language) -> Window {
    let preferences = Preferences { language, ..Preferences::default() };
    let app = App {
        state: State::new(Document::new(scene, None), preferences, None),
        panel: Panel::default(),
        frame_times: FrameTimes::default(),
        refusal: None,
        effects: Vec::new(),
        picture: Rect::NOTHING,
    };
    Harness::builder().with_size(SIZE).with_max_steps(20).build_ui_state(draw, app)
}

fn open(language: Language) -> Window {
    open_with(Scene::default(), language)
}

fn draw(ui: &mut egui::Ui, app: &mut App) {
    style(ui.ctx(), &app.state.preferences);
    let readings = Readings {
        device: "llvmpipe",
        picture_size: [960, 1440],
        frame_times: &app.frame_times,
        progress: Some(0.25),
        refusal: app.refusal,
        shader_error: None,
    };
    let shown = app.panel.show(ui, &app.state, &readings);
    app.picture = shown.picture;
    for action in shown.actions {
        app.effects.extend(app.state.apply(action));
    }
    if shown.is_settled {
        app.state.document.end_run();
    }
}

fn click(window: &mut Window, name: &str) {
    window.get_by_label(name).click();
    window.run();
}

fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run();
}

/// Opens the field for typing and types, without leaving it.
fn begin_to_type(window: &mut Window, name: &str, text: &str) {
    click(window, name);
    window.event(Event::Text(text.to_owned()));
    window.run();
}

fn type_into(window: &mut Window, name: &str, text: &str) {
    begin_to_type(window, name, text);
    press(window, Modifiers::NONE, Key::Enter);
}

/// Replaces what is in a text field, which unlike a number field does not select it by itself.
fn retype(window: &mut Window, name: &str, text: &str) {
    click(window, name);
    press(window, Modifiers::COMMAND, Key::A);
    window.event(Event::Text(text.to_owned()));
    window.run();
}

fn value(window: &Window, name: &str) -> String {
    window.get_by_label(name).value().expect("the field has a value")
}

fn is_there(window: &Window, name: &str) -> bool {
    window.query_by_label(name).is_some()
}

fn scene(window: &Window) -> &Scene {
    window.state().state.document.scene()
}

fn selected(window: &Window) -> &Primitive {
    window.state().state.document.selected().expect("a primitive is selected")
}

fn apply(window: &mut Window, action: Action) {
    window.state_mut().state.apply(action);
    window.run();
}

const REDO: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

#[test]
fn each_button_adds_its_solid_selects_it_and_names_it_with_its_number() {
    let russian = [("сферу", "Сфера"), ("конус", "Конус"), ("куб", "Куб"), ("цилиндр", "Цилиндр")];
    let english = [("a sphere", "Sphere"), ("a cone", "Cone"), ("a cube", "Cube"), ("a cylinder", "Cylinder")];
    for (language, add, list, kinds) in [
        (Language::Russian, "Добавить", "Выбранный примитив", russian),
        (Language::English, "Add", "Selected primitive", english),
    ] {
        let mut window = open(language);
        for number in [1, 2] {
            for (what, name) in kinds {
                click(&mut window, &format!("{add} {what}"));
                assert_eq!(value(&window, list), format!("{name}{number}"));
                assert_eq!(selected(&window), &Primitive::course_default(selected(&window).solid.kind()));
            }
        }
        let kinds: Vec<SolidKind> = scene(&window).primitives.iter().map(|primitive| primitive.solid.kind()).collect();
        let once = [SolidKind::Sphere, SolidKind::Cone, SolidKind::Box, SolidKind::Cylinder];
        assert_eq!(kinds, [once, once].concat());
    }
}

#[test]
fn the_101st_primitive_is_refused_with_the_course_s_message() {
    let full = gallery::scene("grid-cone-100").unwrap();
    for (language, add, title, message) in [
        (Language::Russian, "Добавить куб", "Ошибка", "Превышено максимальное число примитивов"),
        (Language::English, "Add a cube", "Error", "The maximum number of primitives is exceeded"),
    ] {
        let mut window = open_with(full.clone(), language);
        click(&mut window, add);
        assert!(is_there(&window, title) && is_there(&window, message));
        assert_eq!(scene(&window).primitives.len(), 100);
        click(&mut window, "OK");
        assert!(!is_there(&window, title) && window.state().state.dialog.is_none());
    }
}

#[test]
fn moving_and_turning_in_an_empty_scene_give_the_course_s_message() {
    for (language, buttons, message) in [
        (Language::Russian, ["Переместить", "Повернуть"], "Не добавлено ни одного примитива."),
        (Language::English, ["Move", "Rotate"], "No primitive has been added."),
    ] {
        let mut window = open(language);
        for button in buttons {
            click(&mut window, button);
            assert!(is_there(&window, message), "{button}");
            press(&mut window, Modifiers::NONE, Key::Escape);
            assert!(!is_there(&window, message), "{button}");
        }
    }
}

#[test]
fn escape_and_enter_close_a_message() {
    let mut window = open(Language::Russian);
    for key in [Key::Escape, Key::Enter] {
        click(&mut window, "Переместить");
        assert_eq!(window.state().state.dialog, Some(Dialog::Message(Message::NoPrimitives)));
        press(&mut window, Modifiers::NONE, key);
        assert_eq!(window.state().state.dialog, None, "{key:?}");
    }
}

#[test]
fn fields_are_dead_while_nothing_is_selected() {
    let mut window = open(Language::Russian);
    let fields = [
        "Перемещение примитива: x",
        "Поворот примитива: dx",
        "Материал примитива: R",
        "Материал примитива: K_s",
        "Имя примитива",
        "Удалить примитив",
    ];
    for (is_selected, expected) in [(false, true), (true, false)] {
        if is_selected {
            click(&mut window, "Добавить сферу");
        }
        for name in fields {
            assert_eq!(window.get_by_label(name).accesskit_node().is_disabled(), expected, "{name}");
        }
    }
}

#[test]
fn a_typed_position_moves_the_primitive() {
    for (language, add, group) in [
        (Language::Russian, "Добавить сферу", "Перемещение примитива"),
        (Language::English, "Add a sphere", "Move the primitive"),
    ] {
        let mut window = open(language);
        click(&mut window, add);
        for (axis, text) in [("x", "1.5"), ("y", "-2"), ("z", "0,25")] {
            type_into(&mut window, &format!("{group}: {axis}"), text);
        }
        assert_eq!(selected(&window).solid.position(), DVec3::new(1.5, -2.0, 0.25));
        assert_eq!(value(&window, &format!("{group}: z")), "0.25");
    }
}

#[test]
fn a_moved_cylinder_keeps_its_orientation() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить цилиндр");
    type_into(&mut window, "Перемещение примитива: y", "3");
    click(&mut window, "Переместить");
    let ends = [DVec3::new(1.0, 3.0, 1.0), DVec3::new(-1.0, 3.0, -1.0)];
    let mut moved = selected(&window).solid.clone();
    let Solid::Cylinder { ends: moved_ends, .. } = &mut moved else { panic!("{moved:?}") };
    moved_ends.sort_by(|one, other| other.x.total_cmp(&one.x));
    assert_eq!(*moved_ends, ends);
}

#[test]
fn a_cone_s_position_fields_show_its_apex() {
    let mut cone = Primitive::course_default(SolidKind::Cone);
    cone.solid.move_to(DVec3::new(4.0, 5.5, -6.0));
    let mut window = open_with(Scene { primitives: vec![cone], ..Scene::default() }, Language::English);
    apply(&mut window, Action::Select(Some(0)));
    let shown = ["x", "y", "z"].map(|axis| value(&window, &format!("Move the primitive: {axis}")));
    assert_eq!(shown, ["4", "5.5", "-6"]);
    assert_eq!(value(&window, "Apex: y"), "5.5");
}

#[test]
fn a_box_shows_its_pose_and_takes_the_angles_as_a_new_one() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить куб");
    type_into(&mut window, "Поворот примитива: dy", "30");
    assert_eq!(selected(&window), &Primitive::course_default(SolidKind::Box), "not before the button is pressed");
    for _ in 0..2 {
        click(&mut window, "Повернуть");
        let Solid::Box { rotation_degrees, .. } = selected(&window).solid else { panic!("no box") };
        assert_eq!(rotation_degrees, DVec3::new(0.0, 30.0, 0.0));
    }
    click(&mut window, "Добавить сферу");
    assert_eq!(value(&window, "Поворот примитива: dy"), "0");
    click(&mut window, "Предыдущий примитив");
    assert_eq!(value(&window, "Поворот примитива: dy"), "30");
}

#[test]
fn a_cone_is_turned_on_from_where_it_is() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить конус");
    type_into(&mut window, "Поворот примитива: dz", "90");
    click(&mut window, "Повернуть");
    click(&mut window, "Повернуть");
    let Solid::Cone { axis, .. } = selected(&window).solid else { panic!("no cone") };
    assert_eq!(axis, DVec3::Y);
}

#[test]
fn material_and_shape_apply_at_once() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить цилиндр");
    for (name, text) in [("R", "1"), ("K_a", "0.2"), ("K_d", "0.5"), ("K_s", "0.35")] {
        type_into(&mut window, &format!("Материал примитива: {name}"), text);
    }
    type_into(&mut window, "Форма примитива: радиус", "0.75");
    type_into(&mut window, "Второе основание: x", "-3");
    let material = &selected(&window).material;
    assert_eq!((material.ambient, material.diffuse, material.specular), (0.2, 0.5, 0.35));
    assert_eq!(material.color, DVec3::new(1.0, 0.5, 0.7));
    let expected = Solid::Cylinder { ends: [DVec3::new(1.0, 0.0, 1.0), DVec3::new(-3.0, 0.0, -1.0)], radius: 0.75 };
    assert_eq!(selected(&window).solid, expected);
}

#[test]
fn a_cone_s_axis_stays_a_unit_vector_and_is_never_zero() {
    let mut window = open(Language::English);
    click(&mut window, "Add a cone");
    type_into(&mut window, "Axis: x", "1");
    let Solid::Cone { axis, .. } = selected(&window).solid else { panic!("no cone") };
    assert!(axis.is_normalized() && axis.x > 0.7 && axis.y < -0.7, "{axis}");
    apply(&mut window, Action::SetSolid(Solid::course_default(SolidKind::Cone)));
    type_into(&mut window, "Axis: y", "0");
    assert_eq!(selected(&window).solid, Solid::course_default(SolidKind::Cone));
    scene(&window).validate().unwrap();
}

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

#[test]
fn duplicating_answers_to_its_key_and_its_button() {
    let mut window = open(Language::English);
    click(&mut window, "Add a cone");
    press(&mut window, Modifiers::COMMAND, Key::D);
    click(&mut window, "Duplicate the primitive");
    assert_eq!(scene(&window).primitives.len(), 3);
}

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
    let state = &window.state().state;
    let scene = state.document.scene();
    assert_eq!((scene.max_depth, scene.camera.vertical_fov_degrees, scene.background.z), (5, 40.0, 1.5));
    assert_eq!((scene.camera.projection.name(), state.kernel), ("course", Kernel::Reference));
    assert_eq!(state.preferences.fly_speed, 8.0);
    assert!(state.preferences.is_mouse_inverted && state.is_continuous);
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

#[test]
fn save_as_asks_for_a_file_and_save_writes_it_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new scene.toml");
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    press(&mut window, REDO, Key::S);
    assert!(is_there(&window, "Сохранить сцену"));
    retype(&mut window, "Имя файла", folder.path().join("new scene").to_str().unwrap());
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(window.state().state.dialog, None);
    assert_eq!(Scene::load(&path).unwrap().primitives.len(), 1);

    // Typed and not entered: saving takes it up all the same.
    begin_to_type(&mut window, "Перемещение примитива: x", "4");
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert_eq!(window.state().state.dialog, None);
    assert_eq!(Scene::load(&path).unwrap().primitives[0].solid.position().x, 4.0);
    assert!(!window.state().state.document.has_unsaved_changes());
}

#[test]
fn another_file_is_replaced_only_when_told_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.json");
    std::fs::write(&path, "precious").unwrap();
    let mut window = open(Language::English);
    press(&mut window, REDO, Key::S);
    retype(&mut window, "File name", path.to_str().unwrap());
    click(&mut window, "Save");
    assert!(is_there(&window, "There is such a file already. Replace it?"));
    click(&mut window, "Do not replace");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "precious");
    click(&mut window, "Save");
    click(&mut window, "Replace");
    assert_eq!(Scene::load(&path).unwrap(), Scene::default());
    press(&mut window, REDO, Key::S);
    click(&mut window, "Save");
    assert_eq!(window.state().state.dialog, None, "its own file is not asked about");
}

#[test]
fn the_open_dialog_walks_through_folders_and_says_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("scenes")).unwrap();
    gallery::scene("cone").unwrap().save(&folder.path().join("scenes/a cone.toml")).unwrap();
    std::fs::write(folder.path().join("scenes/notes.txt"), "").unwrap();
    let mut window = open(Language::English);
    press(&mut window, Modifiers::COMMAND, Key::O);
    click(&mut window, "Open");
    assert!(is_there(&window, "Type a file name."));
    for (name, fault) in [
        ("missing.toml", "There is no such file."),
        ("missing.txt", "The name of a scene file must end in .toml or .json."),
    ] {
        retype(&mut window, "File name", folder.path().join(name).to_str().unwrap());
        click(&mut window, "Open");
        assert!(is_there(&window, fault), "{name}: {fault}");
    }
    retype(&mut window, "File name", folder.path().to_str().unwrap());
    press(&mut window, Modifiers::NONE, Key::Enter);
    click(&mut window, "scenes/");
    assert!(is_there(&window, "a cone.toml") && !is_there(&window, "notes.txt"));
    click(&mut window, "a cone.toml");
    click(&mut window, "Open");
    assert_eq!(window.state().state.dialog, None);
    assert_eq!(scene(&window), &gallery::scene("cone").unwrap());
    press(&mut window, Modifiers::COMMAND, Key::O);
    let offered = window.query_by_role_and_label(Role::Button, "a cone.toml").is_some();
    assert!(offered, "the folder is remembered");
    click(&mut window, "Folder up");
    assert!(is_there(&window, "scenes/"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().state.dialog, None);
}

#[test]
fn a_screenshot_asks_for_a_picture_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open(Language::Russian);
    press(&mut window, Modifiers::NONE, Key::F12);
    assert_eq!(value(&window, "Имя файла"), "zerkalo.png");
    retype(&mut window, "Имя файла", folder.path().join("shot.exr").to_str().unwrap());
    click(&mut window, "Сохранить");
    let expected: &Path = &folder.path().join("shot.exr");
    assert_eq!(window.state().effects, [Effect::SaveScreenshot(expected.to_owned())]);
}

#[test]
fn a_new_scene_asks_about_unsaved_changes_first() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    for (answer, left) in [("Отмена", 1), ("Не сохранять", 0)] {
        press(&mut window, Modifiers::COMMAND, Key::N);
        assert!(is_there(&window, "В сцене есть несохранённые изменения. Сохранить их?"));
        click(&mut window, answer);
        assert_eq!(window.state().state.dialog, None);
        assert_eq!(scene(&window).primitives.len(), left, "{answer}");
    }
}

#[test]
fn recovery_waits_for_an_answer() {
    let mut window = open(Language::English);
    window.state_mut().state.dialog = Some(Dialog::Recover);
    window.run();
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().state.dialog, Some(Dialog::Recover));
    click(&mut window, "Do not recover");
    assert_eq!(window.state().state.dialog, None);
}

#[test]
fn keys_and_buttons_behind_a_dialog_are_dead() {
    let mut window = open(Language::Russian);
    click(&mut window, "Добавить сферу");
    window.state_mut().state.dialog = Some(Dialog::Message(Message::Failure("no such thing".to_owned())));
    window.run();
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::NONE, Key::Delete);
    let behind = window.get_by_label("Добавить куб").rect().center();
    assert!(is_there(&window, "no such thing"));
    window.hover_at(behind);
    window.drag_at(behind);
    window.drop_at(behind);
    window.run();
    assert_eq!(scene(&window).primitives.len(), 1);
}

#[test]
fn the_help_sheet_comes_and_goes_with_its_key() {
    let mut window = open(Language::Russian);
    press(&mut window, Modifiers::NONE, Key::F1);
    assert!(is_there(&window, "осмотреться"));
    press(&mut window, Modifiers::NONE, Key::F1);
    assert!(!is_there(&window, "осмотреться"));
    press(&mut window, Modifiers::NONE, Key::F1);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!is_there(&window, "осмотреться"));
}

#[test]
fn a_refusal_is_shown_over_the_picture() {
    let mut window = open(Language::English);
    window.state_mut().refusal = Some("it has 2 lights, and the course's kernel knows one");
    window.run();
    let fault = window.get_by_label("it has 2 lights, and the course's kernel knows one").rect();
    assert!(window.state().picture.contains_rect(fault), "{fault}");
}

#[test]
fn the_picture_is_free_of_widgets() {
    let window = open(Language::Russian);
    let picture = window.state().picture;
    assert!(picture.width() > 900.0 && picture.height() > 1400.0, "{picture}");
    let covering = named_widgets(&window).into_iter().filter(|(_, rect)| rect.shrink(1.0).intersects(picture));
    assert_eq!(covering.collect::<Vec<_>>(), []);
    let layer = window.ctx.layer_id_at(picture.center());
    assert!(layer.is_none_or(|layer| layer.order == egui::Order::Background), "{layer:?}");
}

#[test]
fn every_widget_has_a_name_of_its_own() {
    for language in BOTH {
        let mut window = open(language);
        apply(&mut window, Action::AddLight);
        for kind in SolidKind::ALL {
            apply(&mut window, Action::Add(kind));
            let mut names: Vec<String> = named_widgets(&window).into_iter().map(|(name, _)| name).collect();
            assert!(names.len() > 40, "{names:?}");
            assert!(names.iter().all(|name| !name.is_empty()), "{names:?}");
            names.sort();
            let twice: Vec<_> = names.windows(2).filter(|pair| pair[0] == pair[1]).collect();
            assert!(twice.is_empty(), "{twice:?}");
        }
    }
}

#[test]
fn every_sign_of_every_word_can_be_drawn() {
    let window = open(Language::Russian);
    let font = egui::FontId::default();
    for language in BOTH {
        let words = format!("{:?} ⏴⏵⏶×", language.words());
        let missing: String =
            window.ctx.fonts_mut(|fonts| words.chars().filter(|sign| !fonts.has_glyph(&font, *sign)).collect());
        assert_eq!(missing, "");
    }
}

#[test]
fn every_group_is_in_sight_in_a_tall_window() {
    let window = open_with(gallery::scene("showcase").unwrap(), Language::Russian);
    let inside = Rect::from_min_size(Pos2::ZERO, SIZE);
    let outside = named_widgets(&window).into_iter().filter(|(_, rect)| !inside.contains_rect(*rect));
    assert_eq!(outside.collect::<Vec<_>>(), []);
}

/// What can be clicked or typed into, with its place.
fn named_widgets(window: &Window) -> Vec<(String, Rect)> {
    let roles = [Role::Button, Role::SpinButton, Role::TextInput, Role::CheckBox, Role::RadioButton, Role::ComboBox];
    let is_widget = move |node: &egui_kittest::kittest::AccessKitNode<'_>| roles.contains(&node.role());
    let widgets = window.query_all_by(is_widget);
    widgets.map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect())).collect()
}

#[test]
fn a_right_click_in_the_picture_is_left_to_the_picture() {
    let mut window = open(Language::Russian);
    let picture = window.state().picture.center();
    window.event(Event::PointerMoved(picture));
    window.event(Event::PointerButton {
        pos: picture,
        button: PointerButton::Secondary,
        pressed: true,
        modifiers: Modifiers::NONE,
    });
    window.run();
    assert!(!window.ctx.egui_wants_pointer_input());
}
