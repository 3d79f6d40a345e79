//! A finished picture: linear pixels in memory, PNG or OpenEXR on disk.

mod apng_file;
mod exr_file;
mod png_file;

use std::fs::File;
use std::io::{BufReader, BufWriter, Cursor, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

pub use self::apng_file::AnimatedPng;
use crate::whole_file::WholeFile;

/// Linear RGB pixels, row-major, row 0 on top. Values are not limited: a highlight may exceed 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

/// How a frame lies on disk; the file name's extension decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileFormat {
    /// Display values: what a screen shows, see [`display_value`].
    Png,
    /// Linear values, every bit of them.
    Exr,
}

/// Why a frame could not be made, read or written; each message is one line that names the operation and the object.
#[derive(Debug, Error)]
pub enum FrameError {
    /// A side is 0 or larger than [`Frame::MAX_SIDE`].
    #[error("a frame of {width}x{height} pixels is impossible: each side must be 1 to {max}", max = Frame::MAX_SIDE)]
    Size {
        /// Pixels.
        width: u64,
        /// Pixels.
        height: u64,
    },
    /// There is no memory for the pixels, or for what a file is decoded into.
    #[error("could not allocate a frame of {width}x{height} pixels ({bytes} B)")]
    Memory {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// How much was asked for.
        bytes: u64,
    },
    /// The extension is no [`FileFormat`]'s.
    #[error("unknown image format: {path:?} must end in .png or .exr")]
    UnknownFormat {
        /// As it was given.
        path: PathBuf,
    },
    /// The file cannot be opened, or is no picture of the format that its extension names.
    #[error("could not read image {path:?}: {reason}")]
    Read {
        /// As it was given.
        path: PathBuf,
        /// The system's or the decoder's own words.
        reason: String,
    },
    /// The file cannot be written whole; an older one of that name is as it was.
    #[error("could not write image {path:?}: {reason}")]
    Write {
        /// As it was given.
        path: PathBuf,
        /// The system's or the encoder's own words.
        reason: String,
    },
    /// [`Frame::encode`] failed, which writes to memory alone.
    #[error("could not encode a frame: {reason}")]
    Encode {
        /// The encoder's own words.
        reason: String,
    },
}

/// Why the contents of a file are no frame.
#[derive(Debug, Error)]
enum DecodeError {
    #[error(transparent)]
    Frame(#[from] FrameError),
    #[error(transparent)]
    Png(#[from] png::DecodingError),
    #[error(transparent)]
    Exr(#[from] exr::error::Error),
}

impl FrameError {
    /// Whether what the caller named is at fault (a size, a file name, an input file), not the machine.
    pub fn is_input_error(&self) -> bool {
        match self {
            Self::Size { .. } | Self::UnknownFormat { .. } | Self::Read { .. } => true,
            Self::Memory { .. } | Self::Write { .. } | Self::Encode { .. } => false,
        }
    }

    fn read(path: &Path, reason: impl ToString) -> Self {
        Self::Read { path: path.to_owned(), reason: reason.to_string() }
    }

    fn write(path: &Path, reason: impl ToString) -> Self {
        Self::Write { path: path.to_owned(), reason: reason.to_string() }
    }
}

impl FileFormat {
    /// The format that the extension of `path` names, in capitals or not.
    pub fn of(path: &Path) -> Result<Self, FrameError> {
        let extension = path.extension().unwrap_or_default();
        if extension.eq_ignore_ascii_case("png") {
            Ok(Self::Png)
        } else if extension.eq_ignore_ascii_case("exr") {
            Ok(Self::Exr)
        } else {
            Err(FrameError::UnknownFormat { path: path.to_owned() })
        }
    }
}

/// The 8-bit value a screen shows for a linear one: clamped to [0, 1], times 255, rounded to nearest; NaN is 0.
/// There is no gamma, as in the course work's display.
pub fn display_value(linear: f32) -> u8 {
    // `clamp` keeps NaN and the cast turns it into 0.
    (linear.clamp(0.0, 1.0) * 255.0).round() as u8
}

impl Frame {
    /// Of display values, three bytes a pixel, row by row from the top.
    ///
    /// # Errors
    /// As of [`Frame::new`].
    pub(crate) fn of_display(width: u32, height: u32, bytes: &[u8]) -> Result<Self, FrameError> {
        let mut frame = Self::new(width, height)?;
        for (pixel, rgb) in frame.pixels.iter_mut().zip(bytes.chunks_exact(3)) {
            *pixel = [rgb[0], rgb[1], rgb[2]].map(|value| f32::from(value) / 255.0);
        }
        Ok(frame)
    }

    /// Largest width and height in pixels.
    pub const MAX_SIDE: u32 = 16384;

    /// A black frame. Fails on an impossible size and, instead of aborting, when the memory is not to be had:
    /// the largest frame takes 3 GiB.
    pub fn new(width: u32, height: u32) -> Result<Self, FrameError> {
        Self::check_size(width, height)?;
        let count = width as usize * height as usize;
        let mut pixels: Vec<[f32; 3]> = Vec::new();
        pixels.try_reserve_exact(count).map_err(|_| FrameError::Memory {
            width,
            height,
            bytes: (count * size_of::<[f32; 3]>()) as u64,
        })?;
        pixels.resize(count, [0.0; 3]);
        Ok(Self { width, height, pixels })
    }

    /// Refuses what no frame can be, before anything is allocated for it.
    pub fn check_size(width: u32, height: u32) -> Result<(), FrameError> {
        let sides = 1..=Self::MAX_SIDE;
        if sides.contains(&width) && sides.contains(&height) {
            Ok(())
        } else {
            Err(FrameError::Size { width: width.into(), height: height.into() })
        }
    }

    /// In pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// In pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All `width * height` pixels, row by row from the top.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// As [`Frame::pixels`], to be filled.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }

    /// The rows from the top, each of `width` pixels.
    pub fn rows(&self) -> impl Iterator<Item = &[[f32; 3]]> {
        self.pixels.chunks_exact(self.width as usize)
    }

    /// Reads a PNG (8 or 16 bits, grey or RGB; values scaled to [0, 1], alpha ignored) or the first RGB layer of an
    /// OpenEXR file (alpha ignored, the data window only).
    pub fn load(path: &Path) -> Result<Self, FrameError> {
        let format = FileFormat::of(path)?;
        let file = BufReader::new(File::open(path).map_err(|error| FrameError::read(path, error))?);
        match format {
            FileFormat::Png => png_file::read(file),
            FileFormat::Exr => exr_file::read(file),
        }
        .map_err(|error| FrameError::read(path, error))
    }

    /// Writes the frame whole or not at all: into a temporary file beside `path` that takes its place at the end.
    /// After a failure or an interruption an older file is as it was.
    pub fn save(&self, path: &Path) -> Result<(), FrameError> {
        let format = FileFormat::of(path)?;
        let mut file = WholeFile::create(path).map_err(|error| FrameError::write(path, error))?;
        let mut output = BufWriter::new(file.as_file_mut());
        match format {
            FileFormat::Png => png_file::write(self, &mut output).map_err(|error| FrameError::write(path, error))?,
            FileFormat::Exr => exr_file::write(self, &mut output).map_err(|error| FrameError::write(path, error))?,
        }
        output.flush().map_err(|error| FrameError::write(path, error))?;
        drop(output);
        file.finish().map_err(|error| FrameError::write(path, error))
    }

    /// The [display values](display_value), red, green and blue of each pixel, row by row from the top.
    pub fn display_bytes(&self) -> Vec<u8> {
        self.pixels.iter().flatten().map(|&value| display_value(value)).collect()
    }

    /// The bytes of a file.
    pub fn encode(&self, format: FileFormat) -> Result<Vec<u8>, FrameError> {
        let mut bytes = Cursor::new(Vec::new());
        let encoded = match format {
            FileFormat::Png => png_file::write(self, &mut bytes).map_err(|error| error.to_string()),
            FileFormat::Exr => exr_file::write(self, &mut bytes).map_err(|error| error.to_string()),
        };
        encoded.map(|()| bytes.into_inner()).map_err(|reason| FrameError::Encode { reason })
    }

    /// Refuses at once what [`Frame::save`] would refuse after a long render: an unknown extension, a folder that does
    /// not exist or may not be written to, a name that is a folder's, a write-protected file. Leaves nothing behind.
    pub fn check_output_path(path: &Path) -> Result<(), FrameError> {
        FileFormat::of(path)?;
        WholeFile::create(path).map(drop).map_err(|error| FrameError::write(path, error))
    }
}
