//! Settings in TOML files.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

use super::{Numbers, RenderSettings, Shading};
use crate::algorithm::{Algorithm, Precision};
use crate::whole_file::WholeFile;

/// Why a setting could not be read or written; each message is one line.
#[derive(Debug, Error)]
pub enum SettingsError {
    /// The file's text is no setting, or one that contradicts itself.
    #[error("{}:{line}: {what}", path.display())]
    Invalid {
        /// As it was given.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// What is wrong there, in one line.
        what: String,
    },
    /// There is no such file, or it cannot be read, is too large or is no text.
    #[error("could not read setting {path:?}: {reason}")]
    Read {
        /// As it was given.
        path: PathBuf,
        /// The system's own words, or what a file has to be.
        reason: String,
    },
    /// The file cannot be written whole.
    #[error("could not write setting {path:?}: {reason}")]
    Write {
        /// As it was given.
        path: PathBuf,
        /// The system's own words.
        reason: String,
    },
}

impl SettingsError {
    /// Whether what the caller named is at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        match self {
            Self::Invalid { .. } | Self::Read { .. } => true,
            Self::Write { .. } => false,
        }
    }
}

/// What a file may say; the rest is as in [`RenderSettings::default`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fields {
    #[serde(alias = "kernel")]
    algorithm: Option<Spanned<Algorithm>>,
    precision: Option<Spanned<Precision>>,
    error: Option<Spanned<f64>>,
    max_depth: Option<Spanned<u32>>,
    boxes: Option<Spanned<bool>>,
    samples: Option<Spanned<u32>>,
    scale: Option<Spanned<f64>>,
    seed: Option<Spanned<u32>>,
    numbers: Option<Spanned<Numbers>>,
    shading: Option<Spanned<Shading>>,
}

/// Largest file, bytes: a setting takes a tenth of one thousand.
const LARGEST_BYTES: u64 = 1 << 16;

impl RenderSettings {
    /// # Errors
    /// The file cannot be read, or is no setting.
    pub fn load(path: &Path) -> Result<Self, SettingsError> {
        let unreadable = |reason: String| SettingsError::Read { path: path.to_owned(), reason };
        let metadata = fs::metadata(path).map_err(|error| unreadable(error.to_string()))?;
        // A pipe could keep the reader waiting.
        if !metadata.is_file() || metadata.len() > LARGEST_BYTES {
            return Err(unreadable(format!("it is not a file of at most {LARGEST_BYTES} bytes")));
        }
        let source = fs::read_to_string(path).map_err(|error| unreadable(error.to_string()))?;
        Self::from_toml(&source).map_err(|(line, what)| SettingsError::Invalid { path: path.to_owned(), line, what })
    }

    /// With the line at fault, from 1, and what is wrong there.
    fn from_toml(source: &str) -> Result<Self, (usize, String)> {
        let line = |offset: usize| 1 + source.bytes().take(offset).filter(|&byte| byte == b'\n').count();
        let fields: Fields = toml::from_str(source).map_err(|error| {
            let offset = error.span().map_or(0, |span| span.start);
            (line(offset), in_one_line(source, &error, offset))
        })?;
        let Fields { algorithm, precision, error, max_depth, boxes, samples, scale, seed, numbers, shading } = fields;
        let places = [
            ("precision", precision.as_ref().map(Spanned::span)),
            ("error", error.as_ref().map(Spanned::span)),
            ("max_depth", max_depth.as_ref().map(Spanned::span)),
            ("boxes", boxes.as_ref().map(Spanned::span)),
            ("samples", samples.as_ref().map(Spanned::span)),
            ("scale", scale.as_ref().map(Spanned::span)),
            ("seed", seed.as_ref().map(Spanned::span)),
            ("numbers", numbers.as_ref().map(Spanned::span)),
            ("shading", shading.as_ref().map(Spanned::span)),
        ];
        let default = Self::default();
        let on_cpu = algorithm.as_ref().filter(|algorithm| !algorithm.get_ref().description().is_on_device());
        if let Some(algorithm) = on_cpu {
            let what = "such a file is for what draws on a Vulkan device";
            return Err((
                line(algorithm.span().start),
                format!("algorithm = {:?}: {what}", algorithm.get_ref().name()),
            ));
        }
        let setting = Self {
            algorithm: algorithm.map_or(default.algorithm, Spanned::into_inner),
            precision: precision.map_or(default.precision, |precision| Some(precision.into_inner())),
            error: error.map_or(default.error, Spanned::into_inner),
            max_depth: max_depth.map_or(default.max_depth, |depth| Some(depth.into_inner())),
            boxes: boxes.map_or(default.boxes, Spanned::into_inner),
            samples: samples.map_or(default.samples, Spanned::into_inner),
            scale: scale.map_or(default.scale, Spanned::into_inner),
            seed: seed.map_or(default.seed, Spanned::into_inner),
            numbers: numbers.map_or(default.numbers, Spanned::into_inner),
            shading: shading.map_or(default.shading, Spanned::into_inner),
        };
        setting.check().map_err(|contradiction| {
            let place = places.into_iter().find(|(field, _)| *field == contradiction.field);
            let offset = place.and_then(|(_, span)| span).map_or(0, |span| span.start);
            (line(offset), contradiction.what)
        })?;
        Ok(setting)
    }

    /// Writes the file, whole or not at all, below `comment`, which says where the setting comes from.
    pub fn save(&self, path: &Path, comment: &str) -> Result<(), SettingsError> {
        let write = || -> io::Result<()> {
            let text = toml::to_string(self).map_err(io::Error::other)?;
            let comment: String = comment.lines().map(|line| format!("# {line}\n")).collect();
            let mut file = WholeFile::create(path)?;
            file.as_file_mut().write_all((comment + &text).as_bytes())?;
            file.finish()
        };
        write().map_err(|error| SettingsError::Write { path: path.to_owned(), reason: error.to_string() })
    }

    /// Refuses at once what [`RenderSettings::save`] would refuse after a long measuring. Leaves nothing behind.
    pub fn check_output_path(path: &Path) -> Result<(), SettingsError> {
        let failed = |error: io::Error| SettingsError::Write { path: path.to_owned(), reason: error.to_string() };
        WholeFile::create(path).map(drop).map_err(failed)
    }
}

/// With the field, which serde names only where it is unknown.
fn in_one_line(source: &str, error: &toml::de::Error, offset: usize) -> String {
    let what = error.message().lines().collect::<Vec<_>>().join(" ");
    let start = source[..offset].rfind('\n').map_or(0, |newline| newline + 1);
    match source[start..].split_once('=') {
        Some((field, _)) if offset > start && !field.contains('\n') => format!("{}: {what}", field.trim()),
        _ => what,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_is_read_as_it_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("fast.toml");
        let cut = RenderSettings {
            algorithm: Algorithm::Whitted,
            precision: Some(Precision::F64),
            error: 1.0 / 510.0,
            max_depth: Some(3),
            boxes: false,
            samples: 4,
            scale: 0.5,
            shading: Shading::Phong,
            ..RenderSettings::default()
        };
        let path = RenderSettings {
            algorithm: Algorithm::Path,
            samples: 1 << 20,
            seed: 7,
            numbers: Numbers::Independent,
            ..RenderSettings::default()
        };
        for setting in [
            cut,
            path,
            RenderSettings::default(),
            RenderSettings { algorithm: Algorithm::Course, ..RenderSettings::default() },
        ] {
            setting.save(&file, "two\nlines").unwrap();
            assert_eq!(RenderSettings::load(&file).unwrap(), setting);
            assert!(fs::read_to_string(&file).unwrap().starts_with("# two\n# lines\nkernel = "));
        }
        assert_eq!(RenderSettings::from_toml(""), Ok(RenderSettings::default()));
        assert_eq!(RenderSettings::from_toml("algorithm = \"plain\""), RenderSettings::from_toml("kernel = \"plain\""));
    }

    #[test]
    fn a_fault_is_told_with_its_line_and_field() {
        for (source, line, part) in [
            ("kernel = \"whitted\"\ngenerations = 3", 2, "unknown field `generations`"),
            ("\nkernel = \"fast\"", 2, "kernel: unknown variant `fast`"),
            ("error = 0\nalgorithm = \"reference\"", 2, "draws on a Vulkan device"),
            ("precision = \"f16\"", 1, "precision: unknown variant `f16`"),
            ("\n\nmax_depth = -1", 3, "max_depth: "),
            ("max_depth = \"two\"", 1, "max_depth: "),
            ("max_depth = 0", 1, "max_depth = 0"),
            ("kernel = \"course\"\nerror = 0.1", 2, "the course algorithm keeps to no error"),
            (
                "precision = \"f64\"\nkernel = \"plain\"",
                1,
                "the plain algorithm calculates in f32 only; whitted and path can in f64",
            ),
            ("error = nan", 1, "error = NaN"),
            ("error = 1\nerror = 2", 2, "duplicate key"),
            ("boxes = 1", 1, "boxes: "),
            ("error = 0.1\nsamples = 65", 2, "1 to 64 samples, not 65"),
            ("seed = 1", 1, "seed is for the path algorithm, not for whitted"),
            ("kernel = \"path\"\nsamples = 0", 2, "1 to 1073741824 samples, not 0"),
            ("scale = 0.5\nkernel = \"plain\"", 1, "scale is for the whitted algorithm"),
            ("kernel", 1, ""),
        ] {
            let (found, what) = RenderSettings::from_toml(source).unwrap_err();
            assert!(found == line && what.contains(part) && !what.contains('\n'), "{source:?}: {found}: {what}");
        }
    }

    #[test]
    fn what_is_no_file_of_text_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("setting.toml");
        assert!(RenderSettings::load(&path).is_err_and(|error| error.is_input_error()));
        assert!(RenderSettings::load(folder.path()).is_err_and(|error| error.is_input_error()));
        fs::write(&path, [0xff, 0xfe]).unwrap();
        assert!(RenderSettings::load(&path).is_err_and(|error| error.is_input_error()));
        let nowhere = folder.path().join("nowhere/setting.toml");
        assert!(RenderSettings::check_output_path(&nowhere).is_err_and(|error| !error.is_input_error()));
    }
}
