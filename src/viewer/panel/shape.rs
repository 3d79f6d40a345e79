//! The sizes of the selected primitive, and its pose as far as moving and turning do not set it.

use egui::Ui;
use glam::DVec3;

use super::fields::{Scale, XYZ, group, number_row, vector};
use super::selected::for_selected;
use crate::scene::Solid;
use crate::viewer::action::Action;
use crate::viewer::document::Document;
use crate::viewer::text::Words;

pub fn show(ui: &mut Ui, words: &Words, document: &Document, actions: &mut Vec<Action>) {
    let Some(primitive) = document.selected() else { return };
    group(ui, "shape", words.groups.shape, |ui| {
        let edited = for_selected(ui, document, |ui| edit(ui, words, &primitive.solid));
        actions.extend(edited.filter(|edited| *edited != primitive.solid).map(Action::SetSolid));
    });
}

/// The solid as its fields now have it; `None` when they make none.
fn edit(ui: &mut Ui, words: &Words, solid: &Solid) -> Option<Solid> {
    let groups = &words.groups;
    let length =
        |ui: &mut Ui, label, value| number_row(ui, groups.shape, label, value, &Scale::LENGTH).unwrap_or(value);
    let triple = |ui: &mut Ui, title, value: DVec3, scale| {
        ui.label(title);
        vector(ui, title, XYZ, value, scale).unwrap_or(value)
    };
    match solid {
        Solid::Sphere { center, radius } => {
            Some(Solid::Sphere { center: *center, radius: length(ui, groups.radius, *radius) })
        }
        Solid::Box { center, half_size, rotation_degrees } => {
            let half_size = triple(ui, groups.half_size, *half_size, &Scale::HALF_SIZE);
            Some(Solid::Box { center: *center, half_size, rotation_degrees: *rotation_degrees })
        }
        Solid::Cylinder { ends, radius } => {
            let ends = [
                triple(ui, groups.first_end, ends[0], &Scale::POSITION),
                triple(ui, groups.second_end, ends[1], &Scale::POSITION),
            ];
            let radius = length(ui, groups.radius, *radius);
            (ends[0] != ends[1]).then_some(Solid::Cylinder { ends, radius })
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let apex = triple(ui, groups.apex, *apex, &Scale::POSITION);
            let edited_axis = triple(ui, groups.axis, *axis, &Scale::AXIS);
            // An axis that was not touched keeps its bits.
            let axis = if edited_axis == *axis { *axis } else { edited_axis.try_normalize()? };
            let height = length(ui, groups.height, *height);
            let half_angle = number_row(ui, groups.shape, groups.half_angle, *half_angle_degrees, &Scale::HALF_ANGLE);
            Some(Solid::Cone { apex, axis, height, half_angle_degrees: half_angle.unwrap_or(*half_angle_degrees) })
        }
    }
}
