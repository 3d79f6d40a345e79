//! Modal dialogs: which there are, and what they say.

use std::path::PathBuf;

use super::super::action::Action;
use super::super::edits::Refusal;

/// A modal dialog.
#[derive(Debug, Clone, PartialEq)]
pub enum Dialog {
    /// Title «Ошибка» / "Error" and one of the window's own sentences, or a sentence of the library.
    Message(Message),
    /// Which file to open, save or take a screenshot to.
    File(FilePurpose),
    /// There are unsaved changes, and this would lose them: save, discard or cancel?
    Unsaved(Box<Action>),
    /// The last run left unsaved work: take it up?
    Recover,
}

/// What a dialog says, before it is put into words.
#[derive(Debug, Clone, PartialEq)]
pub enum Message {
    /// The course's «Не добавлено ни одного примитива.»
    NoPrimitives,
    /// An edit is one of the selected primitive, and none is.
    NothingSelected,
    /// The course's «Превышено максимальное число примитивов»
    TooManyPrimitives,
    /// A screenshot's, before its picture was whole.
    SceneChanged,
    /// What was lost of a file that was opened, and what was assumed; lines.
    ReadOtherwise(String),
    /// In the words of what failed, such as a scene file's fault with its line.
    Failure(String),
}

impl Message {
    /// First line of an error.
    pub(super) fn failure(error: impl ToString) -> Self {
        Self::Failure(error.to_string().lines().next().unwrap_or_default().to_owned())
    }
}

impl From<Refusal> for Message {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::NoPrimitives => Self::NoPrimitives,
            Refusal::NothingSelected => Self::NothingSelected,
            Refusal::TooManyPrimitives(_) => Self::TooManyPrimitives,
            Refusal::Invalid(error) => Self::failure(error),
        }
    }
}

/// What a file dialog is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePurpose {
    /// A scene to be read.
    Open,
    /// Where the scene is written; a name without an extension gets `.toml`.
    Save,
    /// Where the picture is written; a name without an extension gets `.png`.
    Screenshot,
}

impl FilePurpose {
    /// The file that a given name means: one without an extension gets the usual one where a file is written.
    pub fn completed(self, path: PathBuf) -> PathBuf {
        let usual = match self {
            Self::Open => return path,
            Self::Save => "toml",
            Self::Screenshot => "png",
        };
        if path.extension().is_none_or(|extension| extension.is_empty()) { path.with_extension(usual) } else { path }
    }
}
