//! Scene files: [`FORMATS`] has a row for each kind. TOML for people and JSON for programs share one decoder, `.zscene`
//! has in bytes what is too large for text; NFF is read as other programs write it, and POV-Ray's is written for it to read.
//! One data model, one set of rules.

mod binary;
mod decode;
mod markup;
mod names;
mod nff;
mod note;
mod povray;
mod tree;
mod write;

use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

pub use self::note::{Note, NoteKind};
pub(crate) use self::povray::exposure_below;

use self::markup::Markup;
use super::error::SceneErrorCause;
use super::{Scene, SceneError};
use crate::whole_file::WholeFile;

type ReadFormat = fn(&mut dyn Read) -> Result<Reading, SceneError>;

/// A row of [`FORMATS`].
#[derive(Debug)]
pub struct SceneFormat {
    /// For people.
    pub name: &'static str,
    /// How names of its files end, in lower case and without the dot.
    pub extension: &'static str,
    /// What it is for, for `--help` and docs.
    pub about: &'static str,
    /// Largest file, bytes.
    largest: u64,
    /// `None` where it is written only.
    read: Option<ReadFormat>,
    /// `None` where it is read only.
    write: Option<fn(&Scene, &Export) -> Written>,
}

/// The kinds of scene file; a name's ending tells which one a file is. The first is that of a stream without a name.
pub static FORMATS: [SceneFormat; 5] = [TOML, JSON, ZSCENE, NFF, POV_RAY];

// The sizes of text are about 120 thousand primitives in TOML and 500 thousand in JSON, which take 0.5 GB to read. The
// worst that the parsers can be given in that many bytes makes them take 1.9 GB.
const TOML: SceneFormat = SceneFormat {
    name: "TOML",
    extension: "toml",
    about: "for people",
    largest: 16 << 20,
    read: Some(|file| Markup::Toml.read(file)),
    write: Some(|scene, _| Written::whole(scene.to_toml().into_bytes())),
};

const JSON: SceneFormat = SceneFormat {
    name: "JSON",
    extension: "json",
    about: "for programs",
    largest: 64 << 20,
    read: Some(|file| Markup::Json.read(file)),
    write: Some(|scene, _| Written::whole(scene.to_json().into_bytes())),
};

// Bytes are read into a scene of at most twice their size, and so many hold all the primitives that a scene may have.
const ZSCENE: SceneFormat = SceneFormat {
    name: "zscene",
    extension: "zscene",
    about: "for a million solids",
    largest: 4 << 30,
    read: Some(|file| {
        let in_bytes = |Fault { offset, what }: Fault| SceneError::refused(format!("byte {offset}: {what}"));
        let scene = binary::decode(&read_all(file)?).map_err(in_bytes)?;
        scene.validate()?;
        Ok(scene.into())
    }),
    write: Some(|scene, _| Written::whole(scene.to_zscene())),
};

// Read word by word into a scene of about its size.
const NFF: SceneFormat = SceneFormat {
    name: "NFF",
    extension: "nff",
    about: "of other programs, read only",
    largest: 4 << 30,
    read: Some(nff::read),
    write: None,
};

const POV_RAY: SceneFormat = SceneFormat {
    name: "POV-Ray",
    extension: "pov",
    about: "for POV-Ray 3.7, written only",
    largest: 4 << 30,
    read: None,
    write: Some(povray::write),
};

/// What a format of another program has to be told besides the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Export {
    /// Pixels along x and y of the picture.
    pub size: [u32; 2],
    /// Times every intensity; `None`: the largest power of two, at most 1, that surely keeps the picture below 1.
    pub exposure: Option<f64>,
    /// Times every length; `None`: what the other program's tolerances are made for.
    pub length_scale: Option<f64>,
}

impl Default for Export {
    fn default() -> Self {
        Self { size: [1621, 701], exposure: None, length_scale: None }
    }
}

/// A file's content.
struct Written {
    bytes: Vec<u8>,
    /// What the file does not say of the scene, each in one line.
    losses: Vec<String>,
}

impl Written {
    fn whole(bytes: Vec<u8>) -> Self {
        Self { bytes, losses: Vec::new() }
    }
}

/// What a file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Valid.
    pub scene: Scene,
    /// Pixels along x and y of the picture that the file asks for, where it does.
    pub size: Option<[u32; 2]>,
    /// What the file's format leaves open, and what of it a scene has no place for, each once.
    pub notes: Vec<Note>,
}

impl From<Scene> for Reading {
    fn from(scene: Scene) -> Self {
        Self { scene, size: None, notes: Vec::new() }
    }
}

impl Reading {
    /// The same, where nothing of the file is lost.
    ///
    /// # Errors
    /// The first [loss](NoteKind::Lost).
    pub fn strict(self) -> Result<Self, SceneError> {
        match self.notes.iter().find(|note| note.kind == NoteKind::Lost) {
            None => Ok(self),
            Some(Note { line, what, .. }) => Err(SceneError { line: *line, ..SceneError::refused(what.clone()) }),
        }
    }
}

/// What is wrong in a file.
struct Fault {
    /// Bytes from the start.
    offset: usize,
    what: String,
}

impl Fault {
    /// The same of a file in which the bytes begin at `start`.
    fn moved_by(start: usize) -> impl Fn(Self) -> Self + Copy {
        move |Self { offset, what }| Self { offset: start + offset, what }
    }
}

impl Scene {
    /// Reads a file of any of the [`FORMATS`]; the scene is valid.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::read(path).map(|reading| reading.scene)
    }

    /// The same, with what else the file says.
    pub fn read(path: &Path) -> Result<Reading, SceneError> {
        read(path).map_err(|error| SceneError { path: Some(path.to_owned()), ..error })
    }

    /// Reads a scene from the text of a TOML file; the scene is valid.
    pub fn from_toml(source: &str) -> Result<Self, SceneError> {
        Ok(TOML.read_stream(&mut source.as_bytes())?.scene)
    }

    /// Reads a scene from the text of a JSON file; the scene is valid.
    pub fn from_json(source: &str) -> Result<Self, SceneError> {
        Ok(JSON.read_stream(&mut source.as_bytes())?.scene)
    }

    /// Reads a scene from the bytes of a `.zscene` file; the scene is valid.
    pub fn from_zscene(bytes: &[u8]) -> Result<Self, SceneError> {
        Ok(ZSCENE.read_stream(&mut &*bytes)?.scene)
    }

    /// The scene as bytes of a `.zscene` file; reads back to the bit if the scene is valid.
    pub fn to_zscene(&self) -> Vec<u8> {
        binary::encode(self)
    }

    /// Writes a file of one of the [`FORMATS`] that are written, whole or not at all; an invalid scene is refused.
    pub fn save(&self, path: &Path) -> Result<(), SceneError> {
        self.export(path, &Export::default()).map(drop)
    }

    /// The same; returns what the file does not say of the scene, each in one line.
    pub fn export(&self, path: &Path, export: &Export) -> Result<Vec<String>, SceneError> {
        let in_file = |error: SceneError| SceneError { path: Some(path.to_owned()), ..error };
        let refused = |what| in_file(SceneError::refused(what));
        self.validate().map_err(in_file)?;
        let format = SceneFormat::of(path).map_err(refused)?;
        let write = format.write.ok_or_else(|| {
            refused(format!(
                "{} is read only; a scene is written to {}",
                format.name,
                Extensions(SceneFormat::is_written)
            ))
        })?;
        let Written { bytes, losses } = write(self, export);
        format.check_size(bytes.len() as u64).map_err(refused)?;
        write_whole(path, &bytes).map_err(|error| SceneError {
            cause: SceneErrorCause::Disk,
            ..refused(format!("could not be written: {error}"))
        })?;
        Ok(losses)
    }
}

impl SceneFormat {
    /// Of a file's name.
    ///
    /// # Errors
    /// It has no ending that is known; in one line, what endings are.
    pub fn of(path: &Path) -> Result<&'static Self, String> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let format = FORMATS.iter().find(|format| extension == format.extension);
        format.ok_or_else(|| format!("a scene file's name must end in {}", Extensions(|_| true)))
    }

    /// Whether scenes are written in it, too.
    pub fn is_written(&self) -> bool {
        self.write.is_some()
    }

    /// Whether scenes are read from it, too.
    pub fn is_read(&self) -> bool {
        self.read.is_some()
    }

    /// Reads a scene from a stream.
    pub fn read_stream(&self, stream: &mut dyn Read) -> Result<Reading, SceneError> {
        let read = self.read.ok_or_else(|| {
            let what = format!("{} is written only; a scene is read from {}", self.name, Extensions(Self::is_read));
            SceneError::refused(what)
        })?;
        let mut counted = Counted { inner: stream, bytes: 0, largest: self.largest };
        let reading = read(&mut counted);
        // What was read of one too large makes no scene, or not that which is there.
        self.check_size(counted.bytes).map_err(SceneError::refused)?;
        reading
    }

    fn check_size(&self, size: u64) -> Result<(), String> {
        if size <= self.largest {
            return Ok(());
        }
        let (name, largest) = (self.name, self.largest);
        let too_large = format!("{size} bytes: a {name} scene file may have at most {largest} bytes");
        let is_largest = FORMATS.iter().all(|other| other.largest <= largest);
        Err(if is_largest { too_large } else { too_large + "; a .zscene file holds more" })
    }
}

/// Endings of the formats that are so, as a sentence names them: `.toml, .json or .zscene`.
pub struct Extensions(pub fn(&SceneFormat) -> bool);

impl fmt::Display for Extensions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named: Vec<_> = FORMATS.iter().filter(|format| (self.0)(format)).map(|format| format.extension).collect();
        named.iter().enumerate().try_for_each(|(place, extension)| match named.len() - place {
            1 => write!(f, ".{extension}"),
            2 => write!(f, ".{extension} or "),
            _ => write!(f, ".{extension}, "),
        })
    }
}

/// Not an endless file, nor more of one than shows that it is too large.
struct Counted<'r> {
    inner: &'r mut dyn Read,
    /// That were read.
    bytes: u64,
    largest: u64,
}

impl Read for Counted<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let left = (self.largest + 1 - self.bytes).min(buffer.len() as u64);
        let read = self.inner.read(&mut buffer[..left as usize])?;
        self.bytes += read as u64;
        Ok(read)
    }
}

fn read_all(file: &mut dyn Read) -> Result<Vec<u8>, SceneError> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

fn unreadable(error: io::Error) -> SceneError {
    SceneError::refused(format!("could not be read: {error}"))
}

fn read(path: &Path) -> Result<Reading, SceneError> {
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(SceneError::refused("is a folder, not a scene file".to_owned()));
    }
    let format = SceneFormat::of(path).map_err(SceneError::refused)?;
    // A pipe could keep the reader waiting, a device could be endless.
    if !metadata.is_file() {
        return Err(SceneError::refused("is not a regular file".to_owned()));
    }
    format.check_size(metadata.len()).map_err(SceneError::refused)?;
    // The file may have grown since its size was asked.
    format.read_stream(&mut File::open(path).map_err(unreadable)?)
}

fn write_whole(path: &Path, content: &[u8]) -> io::Result<()> {
    let mut file = WholeFile::create(path)?;
    file.as_file_mut().write_all(content)?;
    file.finish()
}
