//! Adding, moving, turning, material and shape.

use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use glam::DVec3;
use zerkalo::scene::{Primitive, Scene, Solid, SolidKind, gallery};
use zerkalo::viewer::action::Action;
use zerkalo::viewer::preferences::Language;
use zerkalo::viewer::state::{Dialog, Message};

use crate::hands::*;

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
