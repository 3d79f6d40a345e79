//! Primitives made, changed, named and taken away again.

use glam::{DMat3, DVec3};
use zerkalo::scene::{Scene, Solid, gallery};
use zerkalo::viewer::pick::pick;

use crate::driver::{Desk, Locale};

const SIZE: [u32; 2] = [700, 500];

fn cylinder_ends(scene: &Scene) -> [DVec3; 2] {
    match scene.primitives[0].solid {
        Solid::Cylinder { ends, .. } => ends,
        _ => panic!("{scene:?}"),
    }
}

#[test]
fn it_starts_in_the_course_s_state_without_a_word() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    let now = window.now().clone();
    assert_eq!((now.primitives, now.lights, now.selection, &now.dialog, &now.refusal), (0, 1, None, &None, &None));
    assert_eq!((now.position(), now.direction()), (DVec3::new(0.0, 0.0, -2.0), DVec3::Z));
    let light = ["x", "y", "z", "R", "G", "B"].map(|field| now.value(&format!("Параметры света: {field}")).to_owned());
    assert_eq!(light, ["0", "0", "0", "1", "1", "1"]);
    assert!(!now.has_unsaved_changes && now.validation_messages == 0);
    window.close();
}

#[test]
fn a_primitive_added_is_selected_and_named_by_its_kind_and_number() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    let added = [
        ("Добавить сферу", "Сфера1"),
        ("Добавить конус", "Конус1"),
        ("Добавить куб", "Куб1"),
        ("Добавить цилиндр", "Цилиндр1"),
        ("Добавить сферу", "Сфера2"),
    ];
    for (index, (button, name)) in added.into_iter().enumerate() {
        window.click(button);
        let now = window.wait_until("it is selected", |now| now.selection == Some(index));
        assert_eq!((now.primitives, now.selected_name()), (index + 1, name));
    }
    for left in (0..added.len()).rev() {
        window.key("ctrl+z");
        window.wait_until("one fewer", |now| now.primitives == left);
    }
    assert!(!window.now().has_unsaved_changes, "all is undone");
    for (redo, count) in [("ctrl+shift+z", 1), ("ctrl+y", 2)] {
        window.key(redo);
        window.wait_until("one more", |now| now.primitives == count);
    }
    assert_eq!(window.now().selected_name(), "Конус1");
    window.close();
}

#[test]
fn moving_and_turning_a_cylinder_goes_by_the_fields_and_moving_does_not_turn_it() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    window.click("Добавить цилиндр");
    let target = DVec3::new(2.0, -0.5, 3.5);
    for (axis, value) in ["x", "y", "z"].into_iter().zip(target.to_array()) {
        window.fill(&format!("Перемещение примитива: {axis}"), value);
    }
    window.click("Переместить");
    window.save_as("moved.toml");
    let moved = cylinder_ends(&desk.scene("moved.toml"));
    assert_eq!(moved, [target + DVec3::new(1.0, 0.0, 1.0), target - DVec3::new(1.0, 0.0, 1.0)]);

    let degrees = DVec3::new(30.0, 40.0, 50.0);
    for (axis, value) in ["dx", "dy", "dz"].into_iter().zip(degrees.to_array()) {
        window.fill(&format!("Поворот примитива: {axis}"), value);
    }
    window.click("Повернуть");
    window.wait_until("it is turned", |now| now.has_unsaved_changes);
    window.save_as("turned.toml");
    let turned = cylinder_ends(&desk.scene("turned.toml"));
    let [a, b, c] = degrees.to_array().map(|angle| -angle.to_radians());
    let turn = DMat3::from_rotation_z(c) * DMat3::from_rotation_y(b) * DMat3::from_rotation_x(a);
    for (turned, moved) in turned.into_iter().zip(moved) {
        assert!(turned.abs_diff_eq(target + turn * (moved - target), 1e-12), "{turned} by the course's rule");
    }

    window.fill("Перемещение примитива: y", 4.0);
    window.save_as("moved_again.toml");
    let again = cylinder_ends(&desk.scene("moved_again.toml"));
    for (again, turned) in again.into_iter().zip(turned) {
        assert!(again.abs_diff_eq(turned + DVec3::new(0.0, 4.5, 0.0), 1e-12), "{again} is not {turned} moved");
    }
    window.close();
}

#[test]
fn material_shape_and_light_are_taken_at_once_and_undone_step_by_step() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    window.click("Добавить сферу");
    let edits = [
        ("Материал примитива: R", 0.9),
        ("Материал примитива: K_s", 0.5),
        ("Форма примитива: радиус", 0.5),
        ("Параметры света: y", 3.0),
        ("Параметры света: B", 0.25),
    ];
    let before = edits.map(|(field, _)| (field, window.settle().value(field).parse::<f64>().unwrap()));
    edits.iter().for_each(|(field, value)| window.fill(field, *value));
    window.save_as("edited.toml");
    let scene = desk.scene("edited.toml");
    let sphere = &scene.primitives[0];
    assert_eq!((sphere.material.color.x, sphere.material.specular), (0.9, 0.5));
    assert_eq!(sphere.solid, Solid::Sphere { center: DVec3::ZERO, radius: 0.5 });
    assert_eq!((scene.lights[0].position.y, scene.lights[0].intensity.z), (3.0, 0.25));
    // The last number typed has left its field, so that the keys are the window's.
    for (field, value) in before.into_iter().rev() {
        window.key("ctrl+z");
        window.wait_until(&format!("{field:?} is {value} again"), |now| now.value(field).parse() == Ok(value));
    }
    window.close();
}

#[test]
fn a_click_selects_what_is_seen_there_and_one_on_the_background_nothing() {
    // Wide enough for all four to be in it.
    let desk = Desk::new(Locale::Russian, [1000, 500]);
    let mut window = desk.view(&["four"]);
    let now = window.now().clone();
    let (scene, [width, height]) = (gallery::scene("four").unwrap(), now.picture_size);
    for index in 0..4 {
        // Through the primitive's middle, or, for a cone, a little below its apex.
        let middle_of = |wanted: Option<usize>| {
            let pixels: Vec<_> = (0..width * height).map(|i| [i % width, i / width]).collect();
            let its: Vec<_> = pixels.iter().filter(|[x, y]| pick(&scene, width, height, *x, *y) == wanted).collect();
            *its[its.len() / 2]
        };
        window.click_at(now.in_picture_pixel(middle_of(Some(index))));
        let selected = window.wait_until("it is selected", |now| now.selection == Some(index));
        assert_eq!(selected.selected_name(), ["Сфера1", "Куб1", "Цилиндр1", "Конус1"][index]);
        window.click_at(now.in_picture(0.02, 0.02));
        window.wait_until("nothing is selected", |now| now.selection.is_none());
    }
    window.click("Следующий примитив");
    window.wait_until("the first is selected", |now| now.selection == Some(0));
    window.key("Escape");
    window.wait_until("nothing is selected", |now| now.selection.is_none());
    assert!(!window.now().has_unsaved_changes, "looking is no edit");
    window.close();
}

#[test]
fn primitives_are_chosen_from_the_list_duplicated_named_and_deleted() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["four"]);
    window.click("Выбранный примитив");
    window.click("Цилиндр1");
    window.wait_until("it is selected", |now| now.selection == Some(2));
    window.key("ctrl+d");
    let copied = window.wait_until("there is a copy", |now| now.primitives == 5);
    assert_eq!((copied.selection, copied.selected_name()), (Some(4), "Цилиндр2"));
    window.type_into("Имя примитива", "Column 2");
    window.wait_until("it has its name", |now| now.selected_name() == "Column 2");
    window.save_as("named.toml");
    let scene = desk.scene("named.toml");
    assert_eq!(scene.primitives[4].name.as_deref(), Some("Column 2"));
    assert_eq!(scene.primitives[4].material, scene.primitives[2].material);

    window.key("Delete");
    window.wait_until("it is gone", |now| now.primitives == 4);
    window.click("Выбранный примитив");
    window.click("Конус1");
    window.click("Дублировать примитив");
    window.wait_until("there is a copy", |now| now.primitives == 5 && now.selected_name() == "Конус2");
    window.click("Удалить примитив");
    window.wait_until("it is gone", |now| now.primitives == 4);
    window.close();
}

#[test]
fn the_language_changes_while_the_window_runs() {
    let desk = Desk::new(Locale::English, SIZE);
    let mut window = desk.view(&["four"]);
    window.click("Next primitive");
    window.wait_until("an English name", |now| now.selected_name() == "Sphere1");
    window.menu(&["View", "Language", "Русский"]);
    let now = window.wait_until("a Russian name", |now| now.find("Файл").is_some() && now.selected_name() == "Сфера1");
    assert!(now.find("Добавить сферу").is_some() && now.find("Add a sphere").is_none());
    window.key("Escape");
    window.menu(&["Вид", "Язык", "English"]);
    window.wait_until("English again", |now| now.find("Add a sphere").is_some());
    window.close();
}

#[test]
fn light_depth_projection_and_background_are_edited_too() {
    let desk = Desk::new(Locale::English, SIZE);
    let mut window = desk.view(&["four"]);
    window.fill("Scene and camera: reflection depth", 3.0);
    window.fill("Background: G", 0.9);
    window.click("centred");
    window.fill("Scene and camera: vertical field of view, °", 60.0);
    window.save_as("scene.toml");
    let scene = desk.scene("scene.toml");
    assert_eq!((scene.max_depth, scene.background.y), (3, 0.9));
    assert_eq!((scene.camera.projection.name(), scene.camera.vertical_fov_degrees), ("centered", 60.0));
    let size = window.now().picture_size;
    assert!(window.screenshot("window.exr") == desk.render("scene.toml", size));

    window.click("Course (Vulkan)");
    window.wait_until("the course's kernel", |now| now.kernel == "course" && now.is_whole);
    window.click("Add a light");
    let refused = window.wait_until("the kernel refuses two lights", |now| now.refusal.is_some());
    assert!(refused.lights == 2 && refused.says("The kernel does not draw this scene"), "{}", refused.in_short());
    window.click("Delete the light 2");
    window.wait_until("it draws again", |now| now.refusal.is_none() && now.is_whole);
    window.close();
}
