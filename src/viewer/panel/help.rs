//! The sheet of keys and mouse buttons.

use egui::{Align2, Context, Grid, RichText, Vec2};

use crate::viewer::action::Action;
use crate::viewer::text::Words;

pub fn show(ctx: &Context, words: &Words, is_shown: bool, actions: &mut Vec<Action>) {
    let mut is_open = is_shown;
    let sheet =
        egui::Window::new(words.help.title).id("help".into()).open(&mut is_open).collapsible(false).vscroll(true);
    sheet.resizable(false).pivot(Align2::CENTER_CENTER).default_pos(ctx.content_rect().center()).show(ctx, |ui| {
        Grid::new("keys").num_columns(2).striped(true).spacing(Vec2::new(24.0, 4.0)).show(ui, |ui| {
            for (key, effect) in words.help.rows {
                ui.label(RichText::new(key).strong());
                ui.label(effect);
                ui.end_row();
            }
        });
    });
    if is_shown && !is_open {
        actions.push(Action::ShowHelp(false));
    }
}
