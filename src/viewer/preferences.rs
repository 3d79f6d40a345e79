//! What the window remembers between runs, in the platform's config folder.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use directories::ProjectDirs;
use serde::{Deserialize, Serialize};

use super::own_kernel::OwnKernel;
use crate::settings::sampling::{MAX_PATH_SAMPLES, MAX_SAMPLES};
use crate::whole_file::WholeFile;

/// Bytes read of the file at most: a few hundred are enough, and a file gone wrong may have any size.
const LARGEST_BYTES: u64 = 1 << 16;

/// The platform's folder for what this program remembers, if there is such a folder.
pub fn config_folder() -> Option<PathBuf> {
    Some(ProjectDirs::from("", "", "zerkalo")?.config_dir().to_owned())
}

/// The preferences' file in that folder.
pub fn file_in(folder: &Path) -> PathBuf {
    folder.join("preferences.toml")
}

/// Language of everything the window says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// In the course work's words, where it has them.
    Russian,
    /// For every locale but Russian ones.
    English,
}

impl Language {
    /// For a locale such as `ru-RU` or `ru_RU.UTF-8`; English where it is not known.
    pub fn of_locale(locale: Option<&str>) -> Self {
        let language = locale.and_then(|locale| locale.get(..2)).unwrap_or_default();
        if language.eq_ignore_ascii_case("ru") { Self::Russian } else { Self::English }
    }
}

/// Colours of the widgets; the picture has its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Theme {
    /// Light on dark.
    Dark,
    /// Dark on light.
    Light,
}

/// All that one run leaves to the next, unsaved work apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// By default the system's, if it is one of these.
    pub language: Language,
    /// By default dark.
    pub theme: Theme,
    /// Times the display's own scale.
    pub ui_scale: f32,
    /// Logical pixels.
    pub window_size: [u32; 2],
    /// World units in a second; the course moved 0.05 per frame.
    pub fly_speed: f64,
    /// Mouse up looks down.
    pub is_mouse_inverted: bool,
    /// Pictures wait for the display; off in the course's measurements.
    pub waits_for_display: bool,
    /// What draws at first.
    pub kernel: OwnKernel,
    /// Samples of each pixel by the accurate kernels, at most: so many there are once nothing has changed for long
    /// enough.
    pub samples: u32,
    /// The same by path tracing.
    pub path_samples: u32,
}

impl Default for Preferences {
    /// In the system's language.
    fn default() -> Self {
        Self {
            language: Language::of_locale(sys_locale::get_locale().as_deref()),
            theme: Theme::Dark,
            ui_scale: 1.0,
            window_size: [1280, 800],
            // The course's 0.05 per frame at 60 frames in a second.
            fly_speed: 3.0,
            is_mouse_inverted: false,
            waits_for_display: true,
            kernel: OwnKernel::ACCURATE,
            // Edges look smooth, and a picture at rest is soon done.
            samples: 16,
            // So that a window left alone comes to rest; who wants more asks for it.
            path_samples: 1024,
        }
    }
}

impl Preferences {
    /// What the file says; whatever it does not say, or not in a way that can be used, has its default.
    pub fn load(path: &Path) -> Self {
        let mut bytes = Vec::new();
        // What was read before a fault is as good as any of the file.
        let _ = File::open(path).and_then(|file| file.take(LARGEST_BYTES).read_to_end(&mut bytes));
        Self::of_text(&String::from_utf8_lossy(&bytes))
    }

    /// Writes the file, whole or not at all, and the folder it is in.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        let text = toml::to_string(self).map_err(io::Error::other)?;
        fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        let mut file = WholeFile::create(path)?;
        file.as_file_mut().write_all(text.as_bytes())?;
        file.finish()
    }

    /// With every number in the range that a window can be used with.
    pub fn clamped(self) -> Self {
        let default = Self::default();
        Self {
            ui_scale: Some(self.ui_scale).filter(|scale| scale.is_finite()).unwrap_or(default.ui_scale).clamp(0.5, 3.0),
            window_size: self.window_size.map(|side| side.clamp(320, 16384)),
            fly_speed: Some(self.fly_speed)
                .filter(|speed| speed.is_finite())
                .unwrap_or(default.fly_speed)
                .clamp(0.01, 1000.0),
            samples: self.samples.clamp(1, MAX_SAMPLES),
            path_samples: self.path_samples.clamp(1, MAX_PATH_SAMPLES),
            ..self
        }
    }

    /// Each line is read by itself, for a fault in one says nothing of the others; [`Preferences::save`] writes one
    /// line a field.
    fn of_text(text: &str) -> Self {
        let fields = text.lines().filter_map(|line| line.parse::<toml::Table>().ok()).flatten();
        let usable: toml::Table = fields.filter(|(name, value)| is_usable(name, value)).collect();
        usable.try_into::<Self>().unwrap_or_default().clamped()
    }
}

fn is_usable(name: &str, value: &toml::Value) -> bool {
    toml::Table::from_iter([(name.to_owned(), value.clone())]).try_into::<Preferences>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unusual() -> Preferences {
        Preferences {
            language: Language::Russian,
            theme: Theme::Light,
            ui_scale: 1.1,
            window_size: [1621, 701],
            fly_speed: 0.7,
            is_mouse_inverted: true,
            waits_for_display: false,
            kernel: OwnKernel::COURSE,
            samples: 7,
            path_samples: 100_000,
        }
    }

    #[test]
    fn what_was_saved_is_loaded_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/er/preferences.toml");
        unusual().save(&path).unwrap();
        assert_eq!(Preferences::load(&path), unusual());
        Preferences::default().save(&path).unwrap();
        assert_eq!(Preferences::load(&path), Preferences::default());
    }

    #[test]
    fn the_language_is_the_locale_s_where_it_is_russian() {
        for locale in ["ru", "ru-RU", "ru_RU.UTF-8", "RU"] {
            assert_eq!(Language::of_locale(Some(locale)), Language::Russian, "{locale}");
        }
        for locale in [None, Some(""), Some("r"), Some("en-US"), Some("C"), Some("я"), Some("uk_UA")] {
            assert_eq!(Language::of_locale(locale), Language::English, "{locale:?}");
        }
    }

    #[test]
    fn a_missing_file_and_a_folder_give_the_defaults() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(Preferences::load(&folder.path().join("none.toml")), Preferences::default());
        assert_eq!(Preferences::load(folder.path()), Preferences::default());
    }

    #[test]
    fn a_damaged_field_does_not_spoil_the_others() {
        let text = "theme = \"light\"\nlanguage = \"klingon\"\nui_scale = [1\nfly_speed = 2\nwindow_size = [-5, 800]\n\
                    unknown = 7\nkernel = \"f16\"\nsamples = -1\nis_mouse_inverted = \"yes\"\n\0\u{1}=\nwaits_for_display = false\ntheme";
        let expected =
            Preferences { theme: Theme::Light, fly_speed: 2.0, waits_for_display: false, ..Preferences::default() };
        assert_eq!(Preferences::of_text(text), expected);
    }

    #[test]
    fn a_file_cut_short_or_of_other_bytes_is_no_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("preferences.toml");
        unusual().save(&path).unwrap();
        let whole = fs::read(&path).unwrap();
        for length in 0..whole.len() {
            fs::write(&path, &whole[..length]).unwrap();
            let loaded = Preferences::load(&path);
            assert_eq!(loaded.clone().clamped(), loaded);
        }
        fs::write(&path, [0xff, 0xfe, 0x00, b'\n'].repeat(1 << 16)).unwrap();
        assert_eq!(Preferences::load(&path), Preferences::default());
    }

    #[test]
    fn numbers_out_of_range_are_brought_into_it() {
        let text = "ui_scale = 1e300\nfly_speed = -3.0\nwindow_size = [1, 4000000000]\nsamples = 1000\n\
                    path_samples = 0";
        let expected = Preferences {
            ui_scale: 1.0,
            fly_speed: 0.01,
            window_size: [320, 16384],
            samples: 64,
            path_samples: 1,
            ..Preferences::default()
        };
        assert_eq!(Preferences::of_text(text), expected);
        let wild = Preferences { ui_scale: 0.1, fly_speed: f64::NAN, ..Preferences::default() }.clamped();
        assert_eq!((wild.ui_scale, wild.fly_speed), (0.5, 3.0));
        assert_eq!(unusual().clamped(), unusual());
    }
}
