//! Scenes saved, opened, and never lost without a question.

use std::fs;

use zerkalo::scene::{Scene, gallery};

use crate::driver::{Desk, Locale, Window};

const SIZE: [u32; 2] = [700, 500];

#[track_caller]
fn edit(window: &mut Window) {
    let before = window.settle().primitives;
    window.click("Добавить сферу");
    window.wait_until("one more primitive", |now| now.primitives == before + 1 && now.has_unsaved_changes);
}

#[test]
fn a_scene_is_saved_saved_again_by_its_key_and_opened() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["four"]);
    window.menu(&["Файл", "Сохранить как…"]);
    window.type_into("Имя файла", "mine");
    window.wait_until("it has a file", |now| now.file.as_ref().is_some_and(|path| path.ends_with("/mine.toml")));
    assert_eq!(desk.scene("mine.toml"), gallery::scene("four").unwrap());

    edit(&mut window);
    window.key("ctrl+s");
    window.wait_until("it is saved", |now| !now.has_unsaved_changes);
    assert_eq!(desk.scene("mine.toml").primitives.len(), 5);

    gallery::scene("corridor").unwrap().save(&desk.path("other.json")).unwrap();
    window.key("ctrl+o");
    window.type_into("Имя файла", "other.json");
    let opened =
        window.wait_until("it is opened", |now| now.file.as_ref().is_some_and(|path| path.ends_with("other.json")));
    assert_eq!((opened.primitives, opened.dialog), (3, None));
    window.menu(&["Файл", "Открыть…"]);
    window.click("mine.toml");
    window.click("Открыть");
    window.wait_until("the first is opened again", |now| now.primitives == 5 && now.dialog.is_none());

    window.key("ctrl+n");
    let new = window.wait_until("a new scene", |now| now.primitives == 0);
    assert_eq!((new.file, new.has_unsaved_changes), (None, false));
    window.close();
}

#[test]
fn a_file_that_is_there_is_replaced_only_when_asked() {
    let desk = Desk::new(Locale::Russian, SIZE);
    fs::write(desk.path("old.toml"), "dear").unwrap();
    let mut window = desk.view(&["four"]);
    window.key("ctrl+shift+s");
    window.type_into("Имя файла", "old.toml");
    window.click("Не заменять");
    window.click("Отмена");
    window.wait_until("the dialog closes", |now| now.dialog.is_none());
    assert_eq!(fs::read_to_string(desk.path("old.toml")).unwrap(), "dear");
    window.key("ctrl+shift+s");
    window.type_into("Имя файла", "old.toml");
    window.click("Заменить");
    window.wait_until("it is saved", |now| now.dialog.is_none() && now.file.is_some());
    assert_eq!(desk.scene("old.toml").primitives.len(), 4);
    window.close();
}

#[test]
fn unsaved_changes_are_asked_about_before_they_are_lost() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let mut window = desk.view(&["start"]);
    edit(&mut window);
    let question = "В сцене есть несохранённые изменения. Сохранить их?";
    window.menu(&["Файл", "Выход"]);
    assert!(window.wait_until("the question", |now| now.dialog.is_some()).says(question));
    window.click("Отмена");
    window.wait_until("it goes on", |now| now.dialog.is_none() && now.primitives == 1);

    window.menu(&["Галерея", "рисунок 3.5: четыре примитива"]);
    window.wait_until("the question", |now| now.says(question));
    window.click("Не сохранять");
    window.wait_until("the other scene", |now| now.primitives == 4 && !now.has_unsaved_changes);

    edit(&mut window);
    window.menu(&["Файл", "Выход"]);
    window.wait_until("the question", |now| now.says(question));
    window.click("Сохранить");
    window.type_into("Имя файла", "kept.toml");
    assert_eq!(window.ended(), (Some(0), String::new()));
    assert_eq!(desk.scene("kept.toml").primitives.len(), 5);
}

#[test]
fn a_file_that_cannot_be_read_or_written_is_told_of_and_changes_nothing() {
    let desk = Desk::new(Locale::Russian, SIZE);
    fs::write(desk.path("broken.toml"), "max_depth = \"many\"\n").unwrap();
    let mut window = desk.view(&["four"]);
    window.key("ctrl+o");
    window.type_into("Имя файла", "broken.toml");
    let told = window.wait_until("a message", |now| now.says("Ошибка"));
    assert!(told.dialog.is_some_and(|dialog| dialog.contains("broken.toml") && dialog.contains("max_depth")));
    window.click("OK");
    window.wait_until("the scene stays", |now| now.dialog.is_none() && now.primitives == 4 && now.file.is_none());

    // A folder in which nobody makes files, whatever rights they have.
    window.key("ctrl+shift+s");
    window.type_into("Имя файла", "/proc/scene.toml");
    window.wait_until("a message", |now| now.says("Ошибка"));
    window.click("OK");
    let now = window.wait_until("the scene stays", |now| now.dialog.is_none());
    assert_eq!((now.primitives, now.file), (4, None));
    window.key("ctrl+shift+s");
    window.type_into("Имя файла", "no/such/folder.toml");
    window.wait_until("the dialog says so", |now| now.says("Такой папки нет."));
    window.click("Отмена");
    window.close();
}

#[test]
fn a_folder_that_went_away_keeps_the_old_file_and_the_work() {
    let desk = Desk::new(Locale::Russian, SIZE);
    let [stick, drawer] = ["stick", "drawer"].map(|name| desk.path(name));
    fs::create_dir(&stick).unwrap();
    gallery::scene("four").unwrap().save(&stick.join("scene.toml")).unwrap();
    let old = fs::read(stick.join("scene.toml")).unwrap();
    let mut window = desk.view(&["stick/scene.toml"]);
    edit(&mut window);
    fs::rename(&stick, &drawer).unwrap();
    window.key("ctrl+s");
    let told = window.wait_until("a message", |now| now.says("Ошибка"));
    assert!(told.dialog.is_some_and(|dialog| dialog.contains("scene.toml")));
    assert!(fs::read(drawer.join("scene.toml")).unwrap() == old, "the old file is as it was");
    window.click("OK");
    let now = window.wait_until("the work is still there", |now| now.dialog.is_none());
    assert_eq!((now.primitives, now.has_unsaved_changes), (5, true));

    fs::rename(&drawer, &stick).unwrap();
    window.key("ctrl+s");
    window.wait_until("now it is saved", |now| !now.has_unsaved_changes);
    assert_eq!(Scene::load(&stick.join("scene.toml")).unwrap().primitives.len(), 5);
    window.close();
}
