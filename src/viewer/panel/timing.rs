//! How fast the pictures come.

use egui::Ui;
use egui_plot::{Line, Plot, PlotPoints};

use super::fields::{check, group};
use crate::viewer::action::Action;
use crate::viewer::frame_times::FrameTimes;
use crate::viewer::text::{NO_FIGURE, Words};

/// Logical pixels.
const GRAPH_HEIGHT: f32 = 120.0;

pub fn show(ui: &mut Ui, words: &Words, is_continuous: bool, times: &FrameTimes, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let time = |percent| {
        times.percentile_ns(percent).map_or_else(|| NO_FIGURE.to_owned(), |time_ns| words.milliseconds(time_ns))
    };
    group(ui, "timing", groups.timing, |ui| {
        let rate = words.frames_per_second(times.frames_per_second());
        for (label, figure) in [(groups.fps, rate), (groups.median, time(50)), (groups.percentile_99, time(99))] {
            ui.label(format!("{label}: {figure}"));
        }
        show_graph(ui, words, times);
        actions.extend(check(ui, is_continuous, words.menu.continuous).map(Action::SetContinuous));
    });
}

/// Time over frame, the last one at 0.
fn show_graph(ui: &mut Ui, words: &Words, times: &FrameTimes) {
    let groups = &words.groups;
    let first = 1.0 - times.samples_ns().len() as f64;
    let points: PlotPoints =
        times.samples_ns().enumerate().map(|(index, time_ns)| [first + index as f64, time_ns as f64 / 1e6]).collect();
    Plot::new("frame times")
        .height(GRAPH_HEIGHT)
        .include_x(1.0 - FrameTimes::CAPACITY as f64)
        .include_x(0.0)
        .include_y(0.0)
        .x_axis_label(groups.graph_frames)
        .y_axis_label(groups.graph_time)
        // The wheel scrolls the panel, and there is nowhere else to look.
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .show(ui, |plot| plot.line(Line::new(groups.graph_time, points)));
}
