//! The menu bar.

use egui::{Button, KeyboardShortcut, Ui};

use super::fields::{check, choice, name_widget};
use super::shortcuts;
use crate::scene::SolidKind;
use crate::scene::gallery::{self, Entry};
use crate::viewer::action::Action;
use crate::viewer::preferences::{Language, Preferences, Theme};
use crate::viewer::state::State;
use crate::viewer::text::Words;

pub fn show(ui: &mut Ui, words: &Words, state: &State, actions: &mut Vec<Action>) {
    let menu = &words.menu;
    egui::MenuBar::new().ui(ui, |ui| {
        ui.menu_button(menu.file, |ui| file(ui, words, actions));
        ui.menu_button(menu.edit, |ui| edit(ui, words, state, actions));
        ui.menu_button(menu.gallery, |ui| gallery_scenes(ui, words, state.preferences.language, actions));
        ui.menu_button(menu.view, |ui| view(ui, words, state, actions));
        ui.menu_button(menu.help, |ui| {
            item(ui, menu.keys_and_mouse, Some(shortcuts::HELP), true, Action::ShowHelp(true), actions);
        });
    });
}

fn file(ui: &mut Ui, words: &Words, actions: &mut Vec<Action>) {
    let menu = &words.menu;
    item(ui, menu.new, Some(shortcuts::NEW), true, Action::New, actions);
    item(ui, menu.open, Some(shortcuts::OPEN), true, Action::Open, actions);
    ui.separator();
    item(ui, menu.save, Some(shortcuts::SAVE), true, Action::Save, actions);
    item(ui, menu.save_as, Some(shortcuts::SAVE_AS), true, Action::SaveAs, actions);
    item(ui, menu.screenshot, Some(shortcuts::SCREENSHOT), true, Action::Screenshot, actions);
    ui.separator();
    item(ui, menu.quit, None, true, Action::Quit, actions);
}

fn edit(ui: &mut Ui, words: &Words, state: &State, actions: &mut Vec<Action>) {
    let (menu, document) = (&words.menu, &state.document);
    item(ui, menu.undo, Some(shortcuts::UNDO), document.can_undo(), Action::Undo, actions);
    item(ui, menu.redo, Some(shortcuts::REDO), document.can_redo(), Action::Redo, actions);
    ui.separator();
    let is_selected = document.selection().is_some();
    item(ui, menu.duplicate, Some(shortcuts::DUPLICATE), is_selected, Action::Duplicate, actions);
    item(ui, menu.delete, Some(shortcuts::DELETE), is_selected, Action::Delete, actions);
}

fn gallery_scenes(ui: &mut Ui, words: &Words, language: Language, actions: &mut Vec<Action>) {
    let entries = gallery::entries();
    let grid_prefix = |kind: SolidKind| format!("grid-{}-", kind.name());
    let is_grid = |entry: &&Entry| SolidKind::ALL.into_iter().any(|kind| entry.name.starts_with(&grid_prefix(kind)));
    entries.iter().filter(|entry| !is_grid(entry)).for_each(|entry| gallery_item(ui, entry, language, actions));
    ui.separator();
    for kind in SolidKind::ALL {
        let title = format!("{} {}", words.menu.grids_of, words.kind_plurals.of(kind));
        submenu(ui, &title, |ui| {
            let grids = entries.iter().filter(|entry| entry.name.starts_with(&grid_prefix(kind)));
            grids.for_each(|entry| gallery_item(ui, entry, language, actions));
        });
    }
}

fn gallery_item(ui: &mut Ui, entry: &Entry, language: Language, actions: &mut Vec<Action>) {
    let description = match language {
        Language::Russian => &entry.russian,
        Language::English => &entry.english,
    };
    item(ui, description, None, true, Action::OpenGallery(entry.name.clone()), actions);
}

/// Times the display's own scale.
const UI_SCALES: [f32; 7] = [0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 3.0];

fn view(ui: &mut Ui, words: &Words, state: &State, actions: &mut Vec<Action>) {
    let (menu, now) = (&words.menu, &state.preferences);
    let mut prefer = |preferences| actions.push(Action::SetPreferences(preferences));
    submenu(ui, menu.language, |ui| {
        for language in [Language::Russian, Language::English] {
            if choice(ui, now.language == language, language.own_name(), "") {
                prefer(Preferences { language, ..now.clone() });
            }
        }
    });
    submenu(ui, menu.theme, |ui| {
        for (theme, name) in [(Theme::Dark, menu.dark), (Theme::Light, menu.light)] {
            if choice(ui, now.theme == theme, name, "") {
                prefer(Preferences { theme, ..now.clone() });
            }
        }
    });
    submenu(ui, menu.ui_scale, |ui| {
        for ui_scale in UI_SCALES {
            if choice(ui, now.ui_scale == ui_scale, &format!("{} %", ui_scale * 100.0), "") {
                prefer(Preferences { ui_scale, ..now.clone() });
            }
        }
    });
    ui.separator();
    if let Some(waits_for_display) = check(ui, now.waits_for_display, menu.waits_for_display) {
        prefer(Preferences { waits_for_display, ..now.clone() });
    }
    actions.extend(check(ui, state.is_continuous, menu.continuous).map(Action::SetContinuous));
}

/// A menu in a menu.
fn submenu(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    let button = ui.menu_button(title, contents).response;
    name_widget(&button, || title.to_owned());
}

/// A line of a menu with the key that does the same.
fn item(
    ui: &mut Ui,
    text: &str,
    shortcut: Option<KeyboardShortcut>,
    is_enabled: bool,
    action: Action,
    actions: &mut Vec<Action>,
) {
    let key = shortcut.map(|shortcut| ui.ctx().format_shortcut(&shortcut));
    let button = Button::new(text).wrap_mode(egui::TextWrapMode::Extend).shortcut_text(key.unwrap_or_default());
    let response = ui.add_enabled(is_enabled, button);
    name_widget(&response, || text.to_owned());
    if response.clicked() {
        actions.push(action);
    }
}
