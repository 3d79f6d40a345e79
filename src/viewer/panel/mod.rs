//! The window's widgets, drawn with egui: a pure function of what the window knows, answering what the user asks.
//!
//! Around the free centre, where the picture is, stand a menu bar, a status bar and the groups of the course's panel
//! with those that are new; over them come faults, help and dialogs. All speak [`Action`].

mod camera;
mod dialogs;
mod divider;
mod faults;
mod fields;
mod file_dialog;
mod folder;
mod help;
mod light;
mod menu;
mod primitives;
mod selected;
mod shape;
mod shortcuts;
mod status;
mod timeline;
mod timing;

use std::ops::RangeInclusive;

use self::dialogs::Dialogs;
use self::primitives::NameDraft;
use self::selected::RotationDraft;
use super::action::Action;
use super::frame_times::FrameTimes;
use super::preferences::{Preferences, Theme};
use super::state::State;
use crate::plan::Precision;

/// What the panel shows of the tracing, which is not the state's to know.
#[derive(Debug)]
pub struct Readings<'a> {
    /// Its name; empty without one.
    pub device: &'a str,
    /// Size of the picture shown, pixels.
    pub picture_size: [u32; 2],
    /// Times of pictures that the device traced; empty before the first.
    pub frame_times: &'a FrameTimes,
    /// Share of the picture that is traced, while it is not whole.
    pub progress: Option<f32>,
    /// Of the picture by path tracing, or of the first of two.
    pub paths: Option<Paths>,
    /// Why the kernel does not draw this scene, in one line; the last good picture stays.
    pub refusal: Option<&'a str>,
    /// Precision of the accurate kernel, where that draws.
    pub precision: Option<Precision>,
    /// Why the picture is not right.
    pub warning: Option<&'a str>,
    /// A broken shader's compiler messages (`--watch`); the last good one draws.
    pub shader_error: Option<&'a str>,
}

/// How far a picture by path tracing has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paths {
    /// Of each pixel.
    pub so_far: u32,
    /// Of each pixel.
    pub asked_for: u32,
    /// Estimated root mean square error of linear colour, once there is an estimate.
    pub error: Option<f64>,
}

/// What the widgets keep between two frames that is nobody else's business: half-typed names, angles not yet applied.
#[derive(Debug, Default)]
pub struct Panel {
    name: NameDraft,
    rotation: RotationDraft,
    dialogs: Dialogs,
    /// Whether a text field had the focus when the last frame ended: egui takes it away on Escape before anyone sees.
    was_typing: bool,
}

/// What came of drawing the widgets.
#[derive(Debug)]
pub struct Shown {
    /// In the order in which they are to be done.
    pub actions: Vec<Action>,
    /// Free of widgets, for the picture; logical pixels.
    pub picture: egui::Rect,
    /// Whether no value is in hand, dragged or typed: the next edit is then an undo step of its own, see
    /// [`Document::end_run`](super::document::Document::end_run).
    pub is_settled: bool,
}

/// Width of the panel on the right, logical pixels.
const PANEL_WIDTH: f32 = 320.0;
const PANEL_WIDTHS: RangeInclusive<f32> = 260.0..=640.0;

impl Panel {
    /// Draws everything but the picture into the root `ui` of a frame. A frame may take several passes
    /// ([`egui::Context::run_ui`]): the actions of all of them count.
    pub fn show(&mut self, ui: &mut egui::Ui, state: &State, readings: &Readings) -> Shown {
        let words = state.preferences.language.words();
        let mut actions = Vec::new();
        if state.dialog.is_none() {
            shortcuts::consume(ui.ctx(), state, self.was_typing, &mut actions);
        }
        egui::Panel::top("menu bar").show(ui, |ui| menu::show(ui, words, state, &mut actions));
        egui::Panel::bottom("status bar").show(ui, |ui| status::show(ui, words, state, readings));
        let side = egui::Panel::right("groups").default_size(PANEL_WIDTH).size_range(PANEL_WIDTHS);
        side.show(ui, |ui| {
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                self.show_groups(ui, state, readings, &mut actions);
            });
        });
        if !state.document.scene().animation.is_empty() {
            let bar = egui::Panel::bottom("timeline");
            bar.show(ui, |ui| timeline::show(ui, words, &state.document, &mut actions));
        }
        let picture = ui.available_rect_before_wrap();
        divider::show(ui, picture, words, state, &mut actions);
        faults::show(ui, picture, words, readings);
        help::show(ui.ctx(), words, state.is_help_shown, &mut actions);
        self.dialogs.show(ui.ctx(), words, state, &mut actions);
        self.was_typing = ui.ctx().text_edit_focused();
        // A field gives its value up in the frame in which a click elsewhere takes its focus, and means what was
        // selected and open before that click.
        actions.sort_by_key(|action| !sets_a_value(action));
        let is_settled = !self.was_typing && !ui.input(|input| input.pointer.any_down());
        Shown { actions, picture, is_settled }
    }

    fn show_groups(&mut self, ui: &mut egui::Ui, state: &State, readings: &Readings, actions: &mut Vec<Action>) {
        let words = state.preferences.language.words();
        let document = &state.document;
        light::show(ui, words, document.scene(), actions);
        primitives::show_adding(ui, words, actions);
        primitives::show_choosing(ui, words, document, &mut self.name, actions);
        selected::show_moving(ui, words, document, actions);
        selected::show_rotating(ui, words, document, &mut self.rotation, actions);
        selected::show_material(ui, words, document, actions);
        shape::show(ui, words, document, actions);
        camera::show(ui, words, state, actions);
        timing::show(ui, words, state.is_continuous, readings.frame_times, actions);
    }
}

/// Gives egui the theme and the scale that are preferred.
pub fn style(ctx: &egui::Context, preferences: &Preferences) {
    ctx.set_theme(match preferences.theme {
        Theme::Dark => egui::Theme::Dark,
        Theme::Light => egui::Theme::Light,
    });
    // Its own keys would change the scale behind the preferences' back.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    ctx.set_zoom_factor(preferences.ui_scale);
}

/// Whether it is what a field holds, rather than what a button or a key does.
fn sets_a_value(action: &Action) -> bool {
    matches!(
        action,
        Action::Rename(_)
            | Action::MoveTo(_)
            | Action::SetSolid(_)
            | Action::SetMaterial(_)
            | Action::SetLight(..)
            | Action::SetBackground(_)
            | Action::SetAmbientLight(_)
            | Action::SetMaxDepth(_)
            | Action::SetVerticalFov(_)
            | Action::SetSampling(_)
    )
}
