//! Scene files: TOML for people and JSON for programs, with one decoder; and bytes for what is too large for text.
//! One data model, one set of rules.

mod binary;
mod decode;
mod tree;
mod write;

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;
use std::string::FromUtf8Error;

use self::tree::{Document, Node};
use super::error::SceneErrorCause;
use super::validate::{self, Place, Violation};
use super::{Scene, SceneError};
use crate::whole_file::WholeFile;

/// The kinds of scene file; the extension decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileKind {
    Text(Format),
    Zscene,
}

/// Format of text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Toml,
    Json,
}

/// What is wrong in a file.
struct Fault {
    /// Bytes from the start.
    offset: usize,
    what: String,
}

impl Scene {
    /// Reads a `.toml`, `.json` or `.zscene` file; the scene is valid.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let in_file = |error: SceneError| SceneError { path: Some(path.to_owned()), ..error };
        let (kind, content) = read(path).map_err(|what| in_file(SceneError::refused(what)))?;
        kind.decode(content).map_err(in_file)
    }

    /// Reads a scene from a stream of what a file with this extension (`toml`, `json` or `zscene`) holds; the scene is
    /// valid.
    pub fn from_reader(reader: &mut dyn Read, extension: &str) -> Result<Self, SceneError> {
        let kind = FileKind::of(&Path::new("-").with_extension(extension)).map_err(SceneError::refused)?;
        kind.decode(kind.read_all(reader).map_err(SceneError::refused)?)
    }

    /// Reads a scene from the text of a TOML file; the scene is valid.
    pub fn from_toml(source: &str) -> Result<Self, SceneError> {
        Format::Toml.decode(source)
    }

    /// Reads a scene from the text of a JSON file; the scene is valid.
    pub fn from_json(source: &str) -> Result<Self, SceneError> {
        Format::Json.decode(source)
    }

    /// Reads a scene from the bytes of a `.zscene` file; the scene is valid.
    pub fn from_zscene(bytes: &[u8]) -> Result<Self, SceneError> {
        FileKind::Zscene.check_size(bytes.len() as u64).map_err(SceneError::refused)?;
        let in_bytes = |Fault { offset, what }: Fault| SceneError::refused(format!("byte {offset}: {what}"));
        let scene = binary::decode(bytes).map_err(in_bytes)?;
        scene.validate()?;
        Ok(scene)
    }

    /// The scene as bytes of a `.zscene` file; reads back to the bit if the scene is valid.
    pub fn to_zscene(&self) -> Vec<u8> {
        binary::encode(self)
    }

    /// Writes a `.toml`, `.json` or `.zscene` file, whole or not at all; an invalid scene is refused.
    pub fn save(&self, path: &Path) -> Result<(), SceneError> {
        let in_file = |error: SceneError| SceneError { path: Some(path.to_owned()), ..error };
        self.validate().map_err(in_file)?;
        let kind = FileKind::of(path).map_err(|what| in_file(SceneError::refused(what)))?;
        let content = match kind {
            FileKind::Text(Format::Toml) => self.to_toml().into_bytes(),
            FileKind::Text(Format::Json) => self.to_json().into_bytes(),
            FileKind::Zscene => self.to_zscene(),
        };
        kind.check_size(content.len() as u64).map_err(|what| in_file(SceneError::refused(what)))?;
        write(path, &content).map_err(|error| SceneError {
            cause: SceneErrorCause::Disk,
            ..in_file(SceneError::refused(format!("could not be written: {error}")))
        })
    }
}

impl FileKind {
    fn of(path: &Path) -> Result<Self, String> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            Some("toml") => Ok(Self::Text(Format::Toml)),
            Some("json") => Ok(Self::Text(Format::Json)),
            Some("zscene") => Ok(Self::Zscene),
            _ => Err("a scene file's name must end in .toml, .json or .zscene".to_owned()),
        }
    }

    /// Largest file, bytes: about 120 thousand primitives in TOML and 500 thousand in JSON, which take 0.5 GB to read.
    /// The worst that the parsers can be given in that many bytes makes them take 1.9 GB. Bytes are read into a scene
    /// of at most twice their size, and as many as that hold all the primitives that a scene may have.
    fn largest(self) -> u64 {
        match self {
            Self::Text(Format::Toml) => 16 << 20,
            Self::Text(Format::Json) => 64 << 20,
            Self::Zscene => 4 << 30,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Text(Format::Toml) => "Toml",
            Self::Text(Format::Json) => "Json",
            Self::Zscene => "Zscene",
        }
    }

    fn check_size(self, size: u64) -> Result<(), String> {
        if size <= self.largest() {
            return Ok(());
        }
        let too_large = format!("{size} bytes: a {} scene file may have at most {} bytes", self.name(), self.largest());
        Err(match self {
            Self::Text(_) => too_large + "; a .zscene file holds more",
            Self::Zscene => too_large,
        })
    }

    /// Not an endless one, nor more of it than shows that it is too large.
    fn read_all(self, reader: &mut dyn Read) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let read = reader.take(self.largest() + 1).read_to_end(&mut bytes);
        read.map_err(|error| format!("could not be read: {error}"))?;
        Ok(bytes)
    }

    fn decode(self, content: Vec<u8>) -> Result<Scene, SceneError> {
        match self {
            Self::Zscene => Scene::from_zscene(&content),
            Self::Text(format) => {
                let not_text = |error: FromUtf8Error| format!("is not UTF-8 text: {}", error.utf8_error());
                format.decode(&String::from_utf8(content).map_err(not_text).map_err(SceneError::refused)?)
            }
        }
    }
}

impl Format {
    fn decode(self, source: &str) -> Result<Scene, SceneError> {
        FileKind::Text(self).check_size(source.len() as u64).map_err(SceneError::refused)?;
        // Some editors put a byte order mark before UTF-8.
        let source = source.strip_prefix('\u{feff}').unwrap_or(source);
        let decoded = match self {
            Self::Toml => on_a_large_stack(|| self.decode_bare(source)).map_err(SceneError::refused)?,
            Self::Json => self.decode_bare(source),
        };
        decoded.map_err(|fault| SceneError {
            line: Some(1 + source.bytes().take(fault.offset).filter(|&byte| byte == b'\n').count()),
            ..SceneError::refused(fault.what)
        })
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
    let place = match violation.place {
        Place::Scene => None,
        Place::Camera => root.get("camera"),
        Place::Light(index) => element("lights", index),
        Place::Primitive { index, .. } => element("primitives", index),
    };
    let mut node = place.unwrap_or(root);
    for key in violation.field.split('.') {
        node = node.get(key).unwrap_or(node);
    }
    node
}

fn read(path: &Path) -> Result<(FileKind, Vec<u8>), String> {
    let unreadable = |error: io::Error| format!("could not be read: {error}");
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err("is a folder, not a scene file".to_owned());
    }
    let kind = FileKind::of(path)?;
    // A pipe could keep the reader waiting, a device could be endless.
    if !metadata.is_file() {
        return Err("is not a regular file".to_owned());
    }
    kind.check_size(metadata.len())?;
    // The file may have grown since its size was asked.
    let mut file = File::open(path).map_err(unreadable)?;
    Ok((kind, kind.read_all(&mut file)?))
}

fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    let mut file = WholeFile::create(path)?;
    file.as_file_mut().write_all(content)?;
    file.finish()
}
