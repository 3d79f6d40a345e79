//! «Добавление примитива» and «Выбор примитива»: adding, finding, naming.

use egui::{ScrollArea, TextEdit, Ui};

use super::fields::{group, name_widget, short_button};
use crate::scene::{Primitive, SolidKind};
use crate::viewer::action::Action;
use crate::viewer::document::Document;
use crate::viewer::text::Words;

/// In the course's order.
const ADDING_ORDER: [SolidKind; 4] = [SolidKind::Sphere, SolidKind::Cone, SolidKind::Box, SolidKind::Cylinder];

pub fn show_adding(ui: &mut Ui, words: &Words, actions: &mut Vec<Action>) {
    group(ui, "adding", words.groups.adding, |ui| {
        for pair in ADDING_ORDER.chunks(2) {
            ui.columns(pair.len(), |columns| {
                for (ui, &kind) in columns.iter_mut().zip(pair) {
                    let button = egui::Button::new(words.groups.add.of(kind));
                    if ui.add_sized([ui.available_width(), 0.0], button).clicked() {
                        actions.push(Action::Add(kind));
                    }
                }
            });
        }
    });
}

/// A name being typed, and whose it is.
#[derive(Debug, Default)]
pub struct NameDraft {
    text: String,
    /// The selection and its name when `text` was taken from it.
    source: Option<(usize, Option<String>)>,
}

impl NameDraft {
    /// Starts anew when something else is selected or the name changed elsewhere, as undoing does.
    fn follow(&mut self, selected: Option<(usize, &Primitive)>) {
        let source = selected.map(|(index, primitive)| (index, primitive.name.clone()));
        if self.source != source {
            self.text = source.as_ref().and_then(|(_, name)| name.clone()).unwrap_or_default();
            self.source = source;
        }
    }
}

pub fn show_choosing(
    ui: &mut Ui,
    words: &Words,
    document: &Document,
    draft: &mut NameDraft,
    actions: &mut Vec<Action>,
) {
    let groups = &words.groups;
    let selection = document.selection();
    group(ui, "choosing", groups.choosing, |ui| {
        ui.horizontal(|ui| {
            ui.add_enabled_ui(!document.scene().primitives.is_empty(), |ui| {
                let (previous, next) = neighbours(document);
                for (sign, name, index) in [("⏴", groups.previous, previous), ("⏵", groups.next, next)] {
                    if short_button(ui, sign, name) {
                        actions.push(Action::Select(Some(index)));
                    }
                }
            });
            list(ui, words, document, actions);
        });
        ui.add_enabled_ui(selection.is_some(), |ui| {
            ui.push_id(selection, |ui| name(ui, words, document, draft, actions));
            ui.horizontal_wrapped(|ui| {
                for (label, action) in [(groups.duplicate, Action::Duplicate), (groups.delete, Action::Delete)] {
                    if ui.button(label).clicked() {
                        actions.push(action);
                    }
                }
            });
        });
    });
}

/// The primitives before and after the selected one, round and round; without one, the last and the first.
fn neighbours(document: &Document) -> (usize, usize) {
    let last = document.scene().primitives.len().saturating_sub(1);
    let selection = document.selection();
    let previous = selection.and_then(|index| index.checked_sub(1)).unwrap_or(last);
    let next = selection.map(|index| index + 1).filter(|&index| index <= last).unwrap_or(0);
    (previous, next)
}

/// All names; as many are made as are in sight.
fn list(ui: &mut Ui, words: &Words, document: &Document, actions: &mut Vec<Action>) {
    const LIST_HEIGHT: f32 = 300.0;
    let groups = &words.groups;
    let primitives = &document.scene().primitives;
    let selection = document.selection();
    let selected = selection.zip(document.selected());
    let shown = selected.map_or_else(
        || groups.nothing_selected.to_owned(),
        |(index, primitive)| words.primitive_name(primitive, document.ordinal(index)),
    );
    let combo = egui::ComboBox::from_id_salt("primitives").selected_text(shown).height(f32::INFINITY).truncate();
    let combo = combo.width(ui.available_width()).show_ui(ui, |ui| {
        if ui.selectable_label(selection.is_none(), groups.nothing_selected).clicked() {
            actions.push(Action::Select(None));
        }
        // A file may hold names of any length.
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
        let row_height = ui.spacing().interact_size.y;
        ScrollArea::vertical().max_height(LIST_HEIGHT).show_rows(ui, row_height, primitives.len(), |ui, rows| {
            for index in rows {
                let name = words.primitive_name(&primitives[index], document.ordinal(index));
                // The same name may be given twice.
                let chosen = ui.push_id(index, |ui| ui.selectable_label(selection == Some(index), name).clicked());
                if chosen.inner {
                    actions.push(Action::Select(Some(index)));
                }
            }
        });
    });
    name_widget(&combo.response, || groups.selected.to_owned());
}

fn name(ui: &mut Ui, words: &Words, document: &Document, draft: &mut NameDraft, actions: &mut Vec<Action>) {
    /// In characters: what messages repeat of a name.
    const LONGEST_NAME: usize = 40;
    let selected = document.selection().zip(document.selected());
    draft.follow(selected);
    let hint = selected.map(|(index, primitive)| words.numbered_name(primitive.solid.kind(), document.ordinal(index)));
    let field = TextEdit::singleline(&mut draft.text).char_limit(LONGEST_NAME).hint_text(hint.unwrap_or_default());
    let response = ui.add(field.desired_width(f32::INFINITY));
    name_widget(&response, || words.groups.name.to_owned());
    if !response.lost_focus() {
        return;
    }
    // Taken, so that a second pass of the same frame finds nothing new.
    let name_before = draft.source.take().and_then(|(_, name)| name).unwrap_or_default();
    let is_given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
    if !is_given_up && draft.text != name_before {
        actions.push(Action::Rename(draft.text.trim().to_owned()));
    }
}
