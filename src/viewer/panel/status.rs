//! The status bar: what draws, how big, how fast, and which file.

use egui::Ui;

use super::{Paths, Readings};
use crate::viewer::state::State;
use crate::viewer::text::Words;

pub fn show(ui: &mut Ui, words: &Words, state: &State, readings: &Readings) {
    let groups = &words.groups;
    let [width, height] = readings.picture_size;
    let kernel = words.kernel_name(state.kernel, readings.precision);
    let kernel = match state.beside {
        Some(beside) => format!("{kernel} | {}", words.kernel_name(beside, None)),
        None => kernel.to_owned(),
    };
    let rate = words.frames_per_second(readings.frame_times.frames_per_second());
    // One row, cut off where it ends: a bar that grew with its readings would take room from the picture, which would
    // be traced anew, and read otherwise again.
    ui.horizontal(|ui| {
        ui.set_height(ui.spacing().interact_size.y);
        file(ui, words, state);
        for reading in [readings.device, &format!("{width}×{height}"), &kernel, &format!("{rate} {}", groups.fps)] {
            ui.separator();
            ui.label(reading);
        }
        if let Some(Paths { so_far, asked_for, error }) = readings.paths {
            ui.separator();
            ui.label(format!("{so_far}/{asked_for} {}", words.status_samples));
            if let Some(error) = error {
                ui.label(format!("{} {}", words.status_error, words.three_digits(error)))
                    .on_hover_text(words.status_error_hint);
            }
        }
        if let Some(progress) = readings.progress {
            const BAR_WIDTH: f32 = 90.0;
            ui.add(egui::ProgressBar::new(progress).desired_width(BAR_WIDTH).show_percentage());
        }
    });
}

fn file(ui: &mut Ui, words: &Words, state: &State) {
    let path = state.document.path();
    let name = path.and_then(|path| path.file_name()).map(|name| name.to_string_lossy());
    let name = name.as_deref().unwrap_or(words.status_untitled);
    let is_unsaved = state.document.has_unsaved_changes();
    let response = ui.label(format!("{name}{}", if is_unsaved { " *" } else { "" }));
    let whole = path.map(|path| path.display().to_string());
    let unsaved = is_unsaved.then(|| words.status_unsaved.to_owned());
    let hint: Vec<String> = whole.into_iter().chain(unsaved).collect();
    if !hint.is_empty() {
        response.on_hover_text(hint.join("\n"));
    }
}
