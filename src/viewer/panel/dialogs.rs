//! The modal dialogs: messages, questions and the choice of a file.

use egui::{Context, Id, Key, Modal, Modifiers, Ui};

use super::file_dialog::{FileAnswer, FileDialog};
use crate::viewer::action::{Action, UnsavedAnswer};
use crate::viewer::state::{Dialog, FilePurpose, Message, State};
use crate::viewer::text::Words;

/// The file dialog while it is open, and where the last one was.
#[derive(Debug, Default)]
pub struct Dialogs {
    file: Option<FileDialog>,
}

/// Logical pixels.
const WIDTH: f32 = 420.0;

impl Dialogs {
    pub fn show(&mut self, ctx: &Context, words: &Words, state: &State, actions: &mut Vec<Action>) {
        let dialogs = &words.dialogs;
        let answer = match &state.dialog {
            None => None,
            Some(Dialog::Message(message)) => show_message(ctx, words, message),
            Some(Dialog::Unsaved(_)) => {
                let answers = [
                    (dialogs.save, UnsavedAnswer::Save),
                    (dialogs.discard, UnsavedAnswer::Discard),
                    (dialogs.cancel, UnsavedAnswer::Cancel),
                ];
                let (answer, is_dismissed) = ask(ctx, dialogs.unsaved_title, dialogs.unsaved, answers);
                answer.or(is_dismissed.then_some(UnsavedAnswer::Cancel)).map(Action::AnswerUnsaved)
            }
            // Nothing but an answer closes it: work must not be lost to a slip.
            Some(Dialog::Recover) => {
                let answers = [(dialogs.recover_yes, true), (dialogs.recover_no, false)];
                ask(ctx, dialogs.recover_title, dialogs.recover, answers).0.map(Action::AnswerRecover)
            }
            Some(Dialog::File(purpose)) => self.show_file(ctx, words, *purpose, state),
        };
        if !matches!(state.dialog, Some(Dialog::File(_)))
            && let Some(file) = &mut self.file
        {
            file.close();
        }
        actions.extend(answer);
    }

    fn show_file(&mut self, ctx: &Context, words: &Words, purpose: FilePurpose, state: &State) -> Option<Action> {
        let own_path = state.document.path();
        let last_folder = self.file.as_ref().map(FileDialog::folder);
        let is_open = self.file.as_ref().is_some_and(|file| file.is_open_for(purpose));
        if !is_open {
            self.file = Some(FileDialog::open(purpose, own_path, last_folder, words));
        }
        let file = self.file.as_mut()?;
        let (answer, is_dismissed) = modal(ctx, words.file_dialog_title(purpose), |ui| file.show(ui, words, own_path));
        let answer = answer.or(is_dismissed.then_some(FileAnswer::Cancel))?;
        file.close();
        Some(match (answer, purpose) {
            (FileAnswer::Cancel, _) => Action::CloseDialog,
            (FileAnswer::Path(path), FilePurpose::Open) => Action::OpenFile(path),
            (FileAnswer::Path(path), FilePurpose::Save) => Action::SaveTo(path),
            (FileAnswer::Path(path), FilePurpose::Screenshot) => Action::ScreenshotTo(path),
        })
    }
}

fn show_message(ctx: &Context, words: &Words, message: &Message) -> Option<Action> {
    let (title, text) = (words.message_title(message), words.message(message));
    let (answer, is_dismissed) = ask(ctx, title, text, [(words.dialogs.ok, ())]);
    let is_entered = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter));
    (answer.is_some() || is_dismissed || is_entered).then_some(Action::CloseDialog)
}

/// A sentence with a button for each answer, and whether it was waved away.
fn ask<T, const N: usize>(ctx: &Context, title: &str, sentence: &str, answers: [(&str, T); N]) -> (Option<T>, bool) {
    modal(ctx, title, |ui| {
        ui.label(sentence);
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            let clicked =
                answers.into_iter().filter_map(|(label, answer)| ui.button(label).clicked().then_some(answer));
            // Every button must be drawn, whichever was clicked.
            clicked.collect::<Vec<T>>().pop()
        })
        .inner
    })
}

/// A titled dialog over everything: what came of it, and whether Escape or a click beside it waves it away.
fn modal<T>(ctx: &Context, title: &str, contents: impl FnOnce(&mut Ui) -> T) -> (T, bool) {
    let response = Modal::new(Id::new("dialog")).show(ctx, |ui| {
        ui.set_max_width(WIDTH);
        ui.heading(title);
        ui.separator();
        contents(ui)
    });
    let is_dismissed = response.should_close();
    (response.inner, is_dismissed)
}
