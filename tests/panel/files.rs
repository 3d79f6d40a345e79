//! Files, questions and other dialogs.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use std::path::Path;
use zerkalo::scene::{Scene, gallery};
use zerkalo::viewer::action::Effect;
use zerkalo::viewer::preferences::Language;
use zerkalo::viewer::state::{Dialog, Message};

use crate::hands::*;

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
        ("missing.txt", "The name of a scene file must end in one of: .toml, .json, .zscene, .nff."),
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
