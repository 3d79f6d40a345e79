//! A window's panel without the window, and hands for it.

use egui::{Event, Key, Modifiers, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use zerkalo::scene::{Primitive, Scene};
use zerkalo::viewer::action::{Action, Effect};
use zerkalo::viewer::document::Document;
use zerkalo::viewer::frame_times::FrameTimes;
use zerkalo::viewer::panel::{Panel, Paths, Readings, style};
use zerkalo::viewer::preferences::{Language, Preferences};
use zerkalo::viewer::state::State;

/// What the program is without its window.
pub struct App {
    pub state: State,
    pub panel: Panel,
    pub frame_times: FrameTimes,
    pub paths: Option<Paths>,
    pub refusal: Option<&'static str>,
    pub effects: Vec<Effect>,
    pub picture: Rect,
}

pub type Window = Harness<'static, App>;

pub const BOTH: [Language; 2] = [Language::Russian, Language::English];
pub const SIZE: Vec2 = Vec2::new(1280.0, 1500.0);

pub fn open_with(scene: Scene, language: Language) -> Window {
    let preferences = Preferences { language, ..Preferences::default() };
    let app = App {
        state: State::new(Document::new(scene, None), preferences, None),
        panel: Panel::default(),
        frame_times: FrameTimes::default(),
        paths: None,
        refusal: None,
        effects: Vec::new(),
        picture: Rect::NOTHING,
    };
    Harness::builder().with_size(SIZE).with_max_steps(20).build_ui_state(draw, app)
}

pub fn open(language: Language) -> Window {
    open_with(Scene::default(), language)
}

pub fn draw(ui: &mut egui::Ui, app: &mut App) {
    style(ui.ctx(), &app.state.preferences);
    let readings = Readings {
        device: "llvmpipe",
        picture_size: [960, 1440],
        frame_times: &app.frame_times,
        progress: Some(0.25),
        paths: app.paths,
        refusal: app.refusal,
        shader_error: None,
        precision: None,
        warning: None,
    };
    let shown = app.panel.show(ui, &app.state, &readings);
    app.picture = shown.picture;
    for action in shown.actions {
        app.effects.extend(app.state.apply(action));
    }
    if shown.is_settled {
        app.state.document.end_run();
    }
}

pub fn click(window: &mut Window, name: &str) {
    window.get_by_label(name).click();
    window.run();
}

pub fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run();
}

/// Opens the field for typing and types, without leaving it.
pub fn begin_to_type(window: &mut Window, name: &str, text: &str) {
    click(window, name);
    window.event(Event::Text(text.to_owned()));
    window.run();
}

pub fn type_into(window: &mut Window, name: &str, text: &str) {
    begin_to_type(window, name, text);
    press(window, Modifiers::NONE, Key::Enter);
}

/// Replaces what is in a text field, which unlike a number field does not select it by itself.
pub fn retype(window: &mut Window, name: &str, text: &str) {
    click(window, name);
    press(window, Modifiers::COMMAND, Key::A);
    window.event(Event::Text(text.to_owned()));
    window.run();
}

pub fn value(window: &Window, name: &str) -> String {
    window.get_by_label(name).value().expect("the field has a value")
}

pub fn is_there(window: &Window, name: &str) -> bool {
    window.query_by_label(name).is_some()
}

pub fn scene(window: &Window) -> &Scene {
    window.state().state.document.scene()
}

pub fn selected(window: &Window) -> &Primitive {
    window.state().state.document.selected().expect("a primitive is selected")
}

pub fn apply(window: &mut Window, action: Action) {
    window.state_mut().state.apply(action);
    window.run();
}

pub const REDO: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);
