use std::path::PathBuf;

use super::text;

/// Why a scene was refused; displayed as one short line, `PATH:LINE: WHAT`, with the parts that are known.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{what}", origin(.path, .line))]
pub struct SceneError {
    /// The file that was read or written, if it was one.
    pub path: Option<PathBuf>,
    /// Line of the file, from 1, where it is known.
    pub line: Option<usize>,
    /// Names the primitive, the field, the value and the rule, as far as they apply.
    pub what: String,
    pub(super) cause: SceneErrorCause,
}

/// Who is at fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SceneErrorCause {
    /// The scene, or a file that cannot be read as one.
    Input,
    /// Whatever kept a valid scene from being written.
    Disk,
}

impl SceneError {
    /// A fault of the input whose position is not known yet.
    pub(super) fn refused(what: String) -> Self {
        Self { path: None, line: None, what, cause: SceneErrorCause::Input }
    }

    /// Whether the scene or its file is at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        self.cause == SceneErrorCause::Input
    }
}

fn origin(path: &Option<PathBuf>, line: &Option<usize>) -> String {
    // A name on a file system is at most 4096 bytes; it is repeated whole, for it is what has to be found.
    let path = path.as_ref().map(|path| text::one_line(&path.display().to_string(), usize::MAX));
    match (path, line) {
        (Some(path), Some(line)) => format!("{path}:{line}: "),
        (Some(path), None) => format!("{path}: "),
        (None, Some(line)) => format!("line {line}: "),
        (None, None) => String::new(),
    }
}
