//! What keeps the picture from being drawn anew or right, in a box over it.

use egui::{Area, Frame, Rect, RichText, ScrollArea, Ui};

use super::Readings;
use crate::viewer::text::Words;

/// From the picture's edges, logical pixels.
const MARGIN: f32 = 12.0;

pub fn show(ui: &mut Ui, picture: Rect, words: &Words, readings: &Readings) {
    let told = [
        (words.refusal_title, readings.refusal),
        (words.shader_error_title, readings.shader_error),
        (words.too_coarse_title, readings.warning),
    ];
    let faults: Vec<_> = told.into_iter().filter_map(|(title, what)| Some((title, what?))).collect();
    if faults.is_empty() || !picture.is_positive() {
        return;
    }
    let place = picture.shrink(MARGIN);
    // A layer of its own: what is done here is not done to the picture beneath.
    Area::new("faults".into()).fixed_pos(place.min).constrain_to(picture).show(ui.ctx(), |ui| {
        ui.set_max_width(place.width());
        for (title, what) in faults {
            Frame::popup(ui.style()).show(ui, |ui| {
                ui.label(RichText::new(title).strong().color(ui.visuals().error_fg_color));
                // Compilers say much, and columns matter in it.
                let text = RichText::new(what).monospace();
                ScrollArea::both().id_salt(title).max_height(picture.height() / 3.0).show(ui, |ui| ui.label(text));
            });
        }
    });
}
