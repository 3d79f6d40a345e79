//! Under the picture of a scene that moves: its time, to be set or played.

use egui::{Slider, Ui};

use super::fields::{Scale, decimal, name_widget, number};
use crate::viewer::action::Action;
use crate::viewer::document::Document;
use crate::viewer::text::Words;
use crate::viewer::timeline::Timeline;

/// Pictures a second.
const RATE: Scale = Scale::new(Timeline::RATES[0]..=Timeline::RATES[1], 1.0);

/// Left for the slider at least, logical pixels.
const SLIDER_WIDTH: f32 = 80.0;

pub fn show(ui: &mut Ui, words: &Words, document: &Document, actions: &mut Vec<Action>) {
    let words = &words.timeline;
    let (now, duration_seconds) = (document.timeline(), document.scene().duration_seconds());
    let mut asked = now;
    ui.horizontal_wrapped(|ui| {
        ui.set_min_height(ui.spacing().interact_size.y);
        if ui.button(if now.is_playing { words.pause } else { words.play }).clicked() {
            asked = now.toggled();
        }
        if ui.add_enabled(now.seconds.is_some(), egui::Button::new(words.stop)).on_hover_text(words.stop_hint).clicked()
        {
            asked = Timeline { seconds: None, is_playing: false, ..asked };
        }
        let shown = now.picture_seconds().unwrap_or_default();
        let times = Scale::new(0.0..=duration_seconds, now.rate);
        if let Some(seconds) = number(ui, words.title, words.time, shown, &times) {
            asked = Timeline { seconds: Some(seconds), ..asked };
        }
        ui.label(format!("{} {} {}", words.of, decimal(duration_seconds), words.seconds));
        if let Some(rate) = number(ui, words.title, words.rate, now.rate, &RATE) {
            asked = Timeline { rate, ..asked };
        }
        if document.is_camera_animated() {
            ui.checkbox(&mut asked.follows_camera, words.follows_camera).on_hover_text(words.follows_camera_hint);
        }
        let mut seconds = shown;
        ui.spacing_mut().slider_width = ui.available_width().max(SLIDER_WIDTH);
        let slider = ui.add(Slider::new(&mut seconds, 0.0..=duration_seconds).show_value(false));
        name_widget(&slider, || words.title.to_owned());
        if slider.changed() {
            asked = Timeline { seconds: Some(seconds), ..asked };
        }
    });
    if asked != now {
        actions.push(Action::SetTimeline(asked));
    }
}
