//! «Перемещение примитива», «Поворот примитива», «Материал примитива»: the course's groups for the selected one.

use egui::Ui;
use glam::DVec3;

use super::fields::{RGB, Scale, XYZ, check, group, number, number_row, vector};
use crate::scene::{Material, Solid};
use crate::viewer::action::Action;
use crate::viewer::document::Document;
use crate::viewer::text::Words;

pub fn show_moving(ui: &mut Ui, words: &Words, document: &Document, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let position = document.selected().map(|primitive| primitive.solid.position());
    let shown = position.unwrap_or_default();
    group(ui, "moving", groups.moving, |ui| {
        let edited = for_selected(ui, document, |ui| vector(ui, groups.moving, XYZ, shown, &Scale::POSITION));
        actions.extend(edited.map(Action::MoveTo));
        if ui.button(groups.move_it).clicked() {
            actions.push(Action::MoveTo(edited.unwrap_or(shown)));
        }
    });
}

/// Angles being chosen, and what for.
#[derive(Debug, Default)]
pub struct RotationDraft {
    degrees: DVec3,
    /// The selection and the box's pose when `degrees` was taken from it.
    source: Option<(usize, DVec3)>,
}

impl RotationDraft {
    /// Starts anew when something else is selected or a box was turned: with a box's pose, which the course's
    /// «Повернуть» replaces, or with 0 for the others, which it turns on from where they are.
    fn follow(&mut self, document: &Document) {
        let source = document.selection().zip(document.selected()).map(|(index, primitive)| match primitive.solid {
            Solid::Box { rotation_degrees, .. } => (index, rotation_degrees),
            Solid::Sphere { .. } | Solid::Cylinder { .. } | Solid::Cone { .. } => (index, DVec3::ZERO),
        });
        if self.source != source {
            self.degrees = source.map_or(DVec3::ZERO, |(_, degrees)| degrees);
            self.source = source;
        }
    }
}

pub fn show_rotating(
    ui: &mut Ui,
    words: &Words,
    document: &Document,
    draft: &mut RotationDraft,
    actions: &mut Vec<Action>,
) {
    let groups = &words.groups;
    draft.follow(document);
    group(ui, "rotating", groups.rotating, |ui| {
        let edited = for_selected(ui, document, |ui| {
            vector(ui, groups.rotating, ["dx", "dy", "dz"], draft.degrees, &Scale::ROTATION)
        });
        draft.degrees = edited.unwrap_or(draft.degrees);
        if ui.button(groups.rotate_it).clicked() {
            actions.push(Action::Rotate(draft.degrees));
        }
    });
}

pub fn show_material(ui: &mut Ui, words: &Words, document: &Document, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let title = groups.material;
    let material = document.selected().map_or_else(Material::default, |primitive| primitive.material.clone());
    group(ui, "material", title, |ui| {
        let edited = for_selected(ui, document, |ui| {
            let color = vector(ui, title, RGB, material.color, &Scale::SHARE);
            let shares = [("K_a", material.ambient), ("K_d", material.diffuse), ("K_s", material.specular)];
            let edit = |ui: &mut Ui| {
                shares.map(|(label, value)| number(ui, title, label, value, &Scale::SHARE).unwrap_or(value))
            };
            let [ambient, diffuse, specular] = ui.horizontal_wrapped(edit).inner;
            let row = |ui: &mut Ui, label, value, scale| number_row(ui, title, label, value, scale).unwrap_or(value);
            let transmission = row(ui, "K_t", material.transmission, &Scale::SHARE);
            let shininess = row(ui, groups.shininess, material.shininess, &Scale::SHININESS);
            let refractive_index =
                row(ui, groups.refractive_index, material.refractive_index, &Scale::REFRACTIVE_INDEX);
            let has_own = check(ui, material.reflection.is_some(), groups.own_reflection);
            let reflection = match has_own {
                Some(true) => Some(material.reflection()),
                Some(false) => None,
                None => material.reflection.map(|reflection| row(ui, "K_r", reflection, &Scale::SHARE)),
            };
            Material {
                color: color.unwrap_or(material.color),
                ambient,
                diffuse,
                specular,
                reflection,
                shininess,
                transmission,
                refractive_index,
            }
        });
        if edited != material {
            actions.push(Action::SetMaterial(edited));
        }
    });
}

/// Widgets that concern the selected primitive: dead without one, and not mistaken for those of another.
pub fn for_selected<T>(ui: &mut Ui, document: &Document, widgets: impl FnOnce(&mut Ui) -> T) -> T {
    let selection = document.selection();
    ui.add_enabled_ui(selection.is_some(), |ui| ui.push_id(selection, widgets).inner).inner
}
