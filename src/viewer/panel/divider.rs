//! What stands between the picture's two sides: a line that is dragged, and the names of what draws them.

use egui::{Align2, Area, Color32, CursorIcon, FontId, Painter, Rect, Sense, Stroke, TextStyle, Ui, WidgetInfo, pos2};

use super::fields::name_widget;
use crate::viewer::action::Action;
use crate::viewer::state::State;
use crate::viewer::text::Words;

/// Width of what can be taken hold of, logical pixels.
const GRIP: f32 = 9.0;
/// From a name to the line and to the picture's lower edge, logical pixels.
const MARGIN: f32 = 10.0;
/// Two strokes, so that it is seen on light and dark.
const STROKES: [(f32, Color32); 2] = [(3.0, Color32::from_black_alpha(160)), (1.0, Color32::WHITE)];

pub fn show(ui: &Ui, picture: Rect, words: &Words, state: &State, actions: &mut Vec<Action>) {
    let Some(beside) = state.beside.filter(|_| picture.is_positive()) else { return };
    let x = picture.left() + picture.width() * state.divider as f32;
    let grip = Rect::from_x_y_ranges(x - GRIP / 2.0..=x + GRIP / 2.0, picture.y_range());
    // A layer of its own: what is done here is not done to the picture beneath.
    let area = Area::new("divider".into()).fixed_pos(grip.min).constrain(false).fade_in(false);
    area.show(ui.ctx(), |ui| {
        let response = ui.allocate_rect(grip, Sense::drag()).on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
        let name = words.groups.divider;
        response.widget_info(|| WidgetInfo::slider(true, state.divider, name));
        name_widget(&response, || name.to_owned());
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            actions.push(Action::MoveDivider(f64::from((pointer.x - picture.left()) / picture.width())));
        }
        let painter = ui.painter().with_clip_rect(picture);
        for (width, color) in STROKES {
            painter.vline(x, picture.y_range(), Stroke::new(width, color));
        }
        let font = TextStyle::Body.resolve(ui.style());
        let [left, right] = [picture.with_max_x(x), picture.with_min_x(x)];
        let y = picture.bottom() - MARGIN;
        let [left_name, right_name] = [state.kernel, beside].map(|kernel| words.kernel_name(kernel, None));
        write(&painter.with_clip_rect(left), pos2(x - MARGIN, y), Align2::RIGHT_BOTTOM, left_name, &font);
        write(&painter.with_clip_rect(right), pos2(x + MARGIN, y), Align2::LEFT_BOTTOM, right_name, &font);
    });
}

/// White letters on black.
fn write(painter: &Painter, place: egui::Pos2, anchor: Align2, text: &str, font: &FontId) {
    let letters = painter.layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE);
    let rect = anchor.anchor_size(place, letters.size());
    painter.rect_filled(rect.expand(3.0), 3.0, Color32::from_black_alpha(160));
    painter.galley(rect.min, letters, Color32::WHITE);
}
