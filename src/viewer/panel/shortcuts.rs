//! The keys that stand for an action; those that fly the camera are the picture's.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

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
pub const HELP: KeyboardShortcut = KeyboardShortcut::new(Modifiers::NONE, Key::F1);
const OTHER_REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Y);

/// Takes the keys away from egui and answers them. While a text field has the focus, undoing and deleting are its own.
pub fn consume(ctx: &Context, state: &State, was_typing: bool, actions: &mut Vec<Action>) {
    // Those with more modifiers first, since egui lets the others match them too.
    let always = [
        (SAVE_AS, Action::SaveAs),
        (SAVE, Action::Save),
        (OPEN, Action::Open),
        (NEW, Action::New),
        (SCREENSHOT, Action::Screenshot),
        (DUPLICATE, Action::Duplicate),
        (HELP, Action::ShowHelp(!state.is_help_shown)),
    ];
    let not_typing = [(REDO, Action::Redo), (OTHER_REDO, Action::Redo), (UNDO, Action::Undo), (DELETE, Action::Delete)];
    let is_typing = ctx.text_edit_focused();
    let pressed = ctx.input_mut(|input| {
        let mut consumed = |shortcuts: &[(KeyboardShortcut, Action)]| {
            let pressed = shortcuts.iter().filter(|(shortcut, _)| input.consume_shortcut(shortcut));
            pressed.map(|(_, action)| action.clone()).collect::<Vec<_>>()
        };
        let mut pressed = consumed(&always);
        if !is_typing {
            pressed.extend(consumed(&not_typing));
        }
        pressed
    });
    if !pressed.is_empty() {
        // So that the field gives its value up to what is about to be saved.
        ctx.memory_mut(|memory| memory.stop_text_input());
    }
    actions.extend(pressed);
    if !was_typing && !egui::Popup::is_any_open(ctx) {
        actions.extend(on_escape(ctx, state));
    }
}

fn on_escape(ctx: &Context, state: &State) -> Option<Action> {
    let answer = match state.document.selection() {
        _ if state.is_help_shown => Action::ShowHelp(false),
        Some(_) => Action::Select(None),
        None => return None,
    };
    ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)).then_some(answer)
}
