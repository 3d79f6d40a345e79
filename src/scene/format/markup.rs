//! TOML and JSON: text of which a tree is made first.

use std::io::Read;
use std::string::FromUtf8Error;

use super::tree::{Document, Node};
use super::{Fault, Reading, decode, read_all};
use crate::scene::validate::{self, Place, Violation};
use crate::scene::{Scene, SceneError};

/// Format of text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Markup {
    Toml,
    Json,
}

impl Markup {
    pub(super) fn read(self, file: &mut dyn Read) -> Result<Reading, SceneError> {
        let not_text = |error: FromUtf8Error| format!("is not UTF-8 text: {}", error.utf8_error());
        let text = String::from_utf8(read_all(file)?).map_err(not_text).map_err(SceneError::refused)?;
        // Some editors put a byte order mark before UTF-8.
        let source = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let decoded = match self {
            Self::Toml => on_a_large_stack(|| self.decode_bare(source)).map_err(SceneError::refused)?,
            Self::Json => self.decode_bare(source),
        };
        let in_line = |fault: Fault| SceneError {
            line: Some(1 + source.bytes().take(fault.offset).filter(|&byte| byte == b'\n').count()),
            ..SceneError::refused(fault.what)
        };
        Ok(decoded.map_err(in_line)?.into())
    }

    fn decode_bare(self, source: &str) -> Result<Scene, Fault> {
        let document = match self {
            Self::Toml => Document::parse_toml(source)?,
            Self::Json => Document::parse_json(source)?,
        };
        let scene = decode::scene(document.root())?;
        if let Err(violation) = validate::check(&scene) {
            let offset = locate(document.root(), &violation).offset();
            return Err(Fault { offset, what: violation.to_string() });
        }
        Ok(scene)
    }
}

/// Runs `work` on a thread of its own. The TOML parser limits how deep values nest and how many parts a key has, each
/// to 80, and so builds trees of 6400 levels from a few kilobytes; dropping one recurses, which took between 2 and
/// 4 MB of stack without optimisation, and a thread may have less.
fn on_a_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, String> {
    std::thread::scope(|scope| {
        let worker = std::thread::Builder::new().name("scene file".to_owned()).stack_size(64 << 20);
        let running =
            worker.spawn_scoped(scope, work).map_err(|error| format!("no thread to read it with: {error}"))?;
        running.join().or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// Where the offending value stands, or the innermost table around it when the value is a default.
fn locate<'t>(root: Node<'t>, violation: &Violation<'_>) -> Node<'t> {
    let element = |list, index| root.get(list).and_then(|list| list.at(index));
    let place = match violation.keyframe.unwrap_or(violation.place) {
        Place::Scene => None,
        Place::Camera => root.get("camera"),
        Place::Light(index) => element("lights", index),
        Place::Primitive { index, .. } => element("primitives", index),
        Place::Track(index) => element("animation", index),
        Place::Keyframe(track, keyframe) => {
            element("animation", track).and_then(|track| track.get("keyframes")?.at(keyframe))
        }
    };
    let mut node = place.unwrap_or(root);
    for key in violation.field.split('.') {
        node = node.get(key).unwrap_or(node);
    }
    node
}
