//! The keys that stand for an action; those that fly the camera are the picture's.

use egui::{Context, Event, Key, KeyboardShortcut, Modifiers};

use crate::viewer::action::Action;
use crate::viewer::state::State;

pub const NEW: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::N);
pub const OPEN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::O);
pub const SAVE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::S);
pub const SAVE_AS: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::S);
pub const SCREENSHOT: KeyboardShortcut = KeyboardShortcut::new(Modifiers::NONE, Key::F12);
pub const UNDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Z);
pub const REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
pub const DUPLICATE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::D);
pub const DELETE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::NONE, Key::Delete);
pub const PLAY: KeyboardShortcut = KeyboardShortcut::new(Modifiers::NONE, Key::Space);
pub const HELP: KeyboardShortcut = KeyboardShortcut::new(Modifiers::NONE, Key::F1);
const OTHER_REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Y);

/// Takes the keys away from egui and answers them, each press in its turn: a slow frame may have several. While a text
/// field has the focus, undoing and deleting are its own.
pub fn consume(ctx: &Context, state: &State, was_typing: bool, actions: &mut Vec<Action>) {
    let is_typing = ctx.text_edit_focused();
    let mut is_help_shown = state.is_help_shown;
    let mut pressed = Vec::new();
    ctx.input_mut(|input| {
        input.events.retain(|event| {
            let answer = answer(event, is_typing, is_help_shown);
            if let Some(Action::ShowHelp(is_shown)) = answer {
                is_help_shown = is_shown;
            }
            let is_left = answer.is_none();
            pressed.extend(answer);
            is_left
        });
    });
    if !pressed.is_empty() {
        // So that the field gives its value up to what is about to be saved.
        ctx.memory_mut(|memory| memory.stop_text_input());
    }
    actions.extend(pressed);
    if !was_typing && !egui::Popup::is_any_open(ctx) {
        actions.extend(on_escape(ctx, state));
        actions.extend(on_space(ctx, state));
    }
}

fn answer(event: &Event, is_typing: bool, is_help_shown: bool) -> Option<Action> {
    let &Event::Key { key, pressed: true, modifiers, .. } = event else { return None };
    let always = [
        (NEW, Action::New),
        (OPEN, Action::Open),
        (SAVE, Action::Save),
        (SAVE_AS, Action::SaveAs),
        (SCREENSHOT, Action::Screenshot),
        (DUPLICATE, Action::Duplicate),
        (HELP, Action::ShowHelp(!is_help_shown)),
    ];
    let not_typing = [(UNDO, Action::Undo), (REDO, Action::Redo), (OTHER_REDO, Action::Redo), (DELETE, Action::Delete)];
    let not_typing = not_typing.into_iter().filter(|_| !is_typing);
    let is_it = |shortcut: KeyboardShortcut| key == shortcut.logical_key && modifiers.matches_exact(shortcut.modifiers);
    always.into_iter().chain(not_typing).find(|(shortcut, _)| is_it(*shortcut)).map(|(_, action)| action)
}

/// What the space bar asks for: nothing where a widget has the focus, which it presses, and where nothing moves.
fn on_space(ctx: &Context, state: &State) -> Option<Action> {
    let document = &state.document;
    let is_free = ctx.memory(|memory| memory.focused().is_none()) && !document.scene().animation.is_empty();
    let is_pressed = is_free && ctx.input_mut(|input| input.consume_shortcut(&PLAY));
    is_pressed.then(|| Action::SetTimeline(document.timeline().toggled()))
}

fn on_escape(ctx: &Context, state: &State) -> Option<Action> {
    let answer = match state.document.selection() {
        _ if state.is_help_shown => Action::ShowHelp(false),
        Some(_) => Action::Select(None),
        None => return None,
    };
    ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)).then_some(answer)
}
