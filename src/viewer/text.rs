//! All the window says, in Russian and English.
//!
//! A sentence is a field of [`Words`], so that one without its translation does not compile.

mod english;
mod russian;

use super::preferences::Language;
use super::state::{FilePurpose, Message};
use crate::scene::{Primitive, SolidKind};

/// What stands for a figure that is not there.
pub const NO_FIGURE: &str = "—";

/// The words of one language.
#[derive(Debug)]
pub struct Words {
    pub menu: MenuWords,
    pub groups: GroupWords,
    pub dialogs: DialogWords,
    pub help: HelpWords,

    /// Singular, as numbered names begin: «Сфера1».
    pub kind_names: KindWords,
    /// Plural, for the grids of table 4.1.
    pub kind_plurals: KindWords,

    pub status_untitled: &'static str,
    pub status_unsaved: &'static str,
    pub refusal_title: &'static str,
    /// Over why the picture is not right.
    pub too_coarse_title: &'static str,
    pub shader_error_title: &'static str,

    decimal_separator: &'static str,
    milliseconds: &'static str,
}

/// A word a kind of solid.
#[derive(Debug)]
pub struct KindWords {
    sphere: &'static str,
    cube: &'static str,
    cylinder: &'static str,
    cone: &'static str,
}

impl KindWords {
    pub fn of(&self, kind: SolidKind) -> &'static str {
        match kind {
            SolidKind::Sphere => self.sphere,
            SolidKind::Box => self.cube,
            SolidKind::Cylinder => self.cylinder,
            SolidKind::Cone => self.cone,
        }
    }
}

/// Of the menu bar.
#[derive(Debug)]
pub struct MenuWords {
    pub file: &'static str,
    pub new: &'static str,
    pub open: &'static str,
    pub save: &'static str,
    pub save_as: &'static str,
    pub screenshot: &'static str,
    pub quit: &'static str,

    pub edit: &'static str,
    pub undo: &'static str,
    pub redo: &'static str,
    pub duplicate: &'static str,
    pub delete: &'static str,

    pub gallery: &'static str,
    /// Before the plural of a kind.
    pub grids_of: &'static str,

    pub view: &'static str,
    pub language: &'static str,
    pub theme: &'static str,
    pub dark: &'static str,
    pub light: &'static str,
    pub ui_scale: &'static str,
    pub continuous: &'static str,
    pub waits_for_display: &'static str,

    pub help: &'static str,
    pub keys_and_mouse: &'static str,
}

/// Of the groups on the right. Capitals begin what stands by itself: titles, buttons, choices.
#[derive(Debug)]
pub struct GroupWords {
    // ---- The course's groups, in its order and its words.
    pub light: &'static str,
    pub adding: &'static str,
    pub add: KindWords,
    pub choosing: &'static str,
    pub moving: &'static str,
    pub move_it: &'static str,
    pub rotating: &'static str,
    pub rotate_it: &'static str,
    pub material: &'static str,

    pub add_light: &'static str,
    /// Before its number.
    pub delete_light: &'static str,

    pub selected: &'static str,
    pub nothing_selected: &'static str,
    pub previous: &'static str,
    pub next: &'static str,
    pub name: &'static str,
    pub duplicate: &'static str,
    pub delete: &'static str,

    pub shape: &'static str,
    pub radius: &'static str,
    pub half_size: &'static str,
    pub first_end: &'static str,
    pub second_end: &'static str,
    pub apex: &'static str,
    pub axis: &'static str,
    pub height: &'static str,
    pub half_angle: &'static str,

    pub camera: &'static str,
    pub background: &'static str,
    pub max_depth: &'static str,
    pub max_depth_hint: &'static str,
    pub projection: &'static str,
    pub projection_course: &'static str,
    pub projection_course_hint: &'static str,
    pub projection_centered: &'static str,
    pub vertical_fov: &'static str,
    pub kernel: &'static str,
    pub kernel_course: &'static str,
    pub kernel_course_hint: &'static str,
    pub kernel_accurate: &'static str,
    pub kernel_accurate_hint: &'static str,
    pub kernel_accurate_f32: &'static str,
    pub kernel_accurate_f32_hint: &'static str,
    pub kernel_accurate_f64: &'static str,
    pub kernel_accurate_f64_hint: &'static str,
    pub kernel_reference: &'static str,
    pub kernel_reference_hint: &'static str,
    pub kernel_by_setting: &'static str,
    pub samples: &'static str,
    pub samples_hint: &'static str,
    pub scale: &'static str,
    pub scale_hint: &'static str,
    pub reset_camera: &'static str,
    pub fly_speed: &'static str,
    pub invert_mouse: &'static str,

    pub timing: &'static str,
    pub fps: &'static str,
    pub median: &'static str,
    pub percentile_99: &'static str,
    pub graph_frames: &'static str,
    pub graph_time: &'static str,
}

/// Of the modal dialogs.
#[derive(Debug)]
pub struct DialogWords {
    pub error: &'static str,
    pub ok: &'static str,
    pub cancel: &'static str,
    pub no_primitives: &'static str,
    pub scene_changed: &'static str,
    pub nothing_selected: &'static str,
    pub too_many_primitives: &'static str,

    pub unsaved_title: &'static str,
    pub unsaved: &'static str,
    pub save: &'static str,
    pub discard: &'static str,

    pub recover_title: &'static str,
    pub recover: &'static str,
    pub recover_yes: &'static str,
    pub recover_no: &'static str,

    pub open_title: &'static str,
    pub save_title: &'static str,
    pub screenshot_title: &'static str,
    pub open: &'static str,
    pub folder_up: &'static str,
    pub files: &'static str,
    pub no_files: &'static str,
    pub file_name: &'static str,
    pub file_name_missing: &'static str,
    pub no_such_file: &'static str,
    pub no_such_folder: &'static str,
    pub scene_extension: &'static str,
    pub picture_extension: &'static str,
    /// Before what the system said.
    pub folder_unreadable: &'static str,
    pub replace_question: &'static str,
    pub replace: &'static str,
    pub keep: &'static str,
}

/// Of the sheet of keys.
#[derive(Debug)]
pub struct HelpWords {
    pub title: &'static str,
    /// What to press, what comes of it.
    pub rows: [(&'static str, &'static str); 16],
}

impl Language {
    pub fn words(self) -> &'static Words {
        match self {
            Self::Russian => &russian::WORDS,
            Self::English => &english::WORDS,
        }
    }

    /// The language's own name for itself, which its readers look for.
    pub fn own_name(self) -> &'static str {
        match self {
            Self::Russian => "Русский",
            Self::English => "English",
        }
    }
}

impl Words {
    /// The name given to the primitive, or the course's «Сфера1» with its number among those of its kind.
    pub fn primitive_name(&self, primitive: &Primitive, ordinal: usize) -> String {
        primitive.name.clone().unwrap_or_else(|| self.numbered_name(primitive.solid.kind(), ordinal))
    }

    /// The course's «Сфера1».
    pub fn numbered_name(&self, kind: SolidKind, ordinal: usize) -> String {
        format!("{}{ordinal}", self.kind_names.of(kind))
    }

    pub fn message<'a>(&self, message: &'a Message) -> &'a str {
        match message {
            Message::NoPrimitives => self.dialogs.no_primitives,
            Message::NothingSelected => self.dialogs.nothing_selected,
            Message::TooManyPrimitives => self.dialogs.too_many_primitives,
            Message::SceneChanged => self.dialogs.scene_changed,
            Message::Failure(what) => what,
        }
    }

    pub fn file_dialog_title(&self, purpose: FilePurpose) -> &'static str {
        match purpose {
            FilePurpose::Open => self.dialogs.open_title,
            FilePurpose::Save => self.dialogs.save_title,
            FilePurpose::Screenshot => self.dialogs.screenshot_title,
        }
    }

    /// `12.3 ms`, to three significant digits.
    pub fn milliseconds(&self, time_ns: u64) -> String {
        format!("{} {}", self.three_digits(time_ns as f64 / 1e6), self.milliseconds)
    }

    /// `59.8`, to three significant digits; a dash for anything but a finite rate above 0.
    pub fn frames_per_second(&self, rate: Option<f64>) -> String {
        let rate = rate.filter(|rate| rate.is_finite() && *rate > 0.0);
        rate.map_or_else(|| NO_FIGURE.to_owned(), |rate| self.three_digits(rate))
    }

    fn three_digits(&self, value: f64) -> String {
        let magnitude = if value > 0.0 { value.log10().floor() } else { 0.0 };
        let decimals = (2.0 - magnitude).clamp(0.0, 20.0) as usize;
        format!("{value:.decimals$}").replace('.', self.decimal_separator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_rates_have_three_digits_and_the_language_s_separator() {
        let (russian, english) = (Language::Russian.words(), Language::English.words());
        assert_eq!(
            (russian.milliseconds(12_345_678), english.milliseconds(12_345_678)),
            ("12,3 мс".into(), "12.3 ms".into())
        );
        assert_eq!((english.milliseconds(1_234), english.milliseconds(0)), ("0.00123 ms".into(), "0.00 ms".into()));
        assert_eq!(english.milliseconds(4_200_000_000), "4200 ms");
        assert_eq!(
            (russian.frames_per_second(Some(57.14)), english.frames_per_second(Some(1234.5))),
            ("57,1".into(), "1234".into())
        );
    }

    #[test]
    fn a_rate_is_never_zero_infinite_or_not_a_number() {
        let words = Language::English.words();
        for rate in [None, Some(0.0), Some(-1.0), Some(f64::INFINITY), Some(f64::NAN)] {
            assert_eq!(words.frames_per_second(rate), NO_FIGURE, "{rate:?}");
        }
        for slow in [1e-3, 5e-11] {
            assert!(words.frames_per_second(Some(slow)).contains(|c: char| ('1'..='9').contains(&c)), "{slow}");
        }
    }

    #[test]
    fn the_course_s_words_are_the_course_s() {
        let words = Language::Russian.words();
        let groups = &words.groups;
        let titles = [groups.light, groups.adding, groups.choosing, groups.moving, groups.rotating, groups.material];
        assert_eq!(
            titles,
            [
                "Параметры света",
                "Добавление примитива",
                "Выбор примитива",
                "Перемещение примитива",
                "Поворот примитива",
                "Материал примитива"
            ]
        );
        assert_eq!(SolidKind::ALL.map(|kind| words.numbered_name(kind, 1)), ["Сфера1", "Куб1", "Цилиндр1", "Конус1"]);
        assert_eq!(words.message(&Message::NoPrimitives), "Не добавлено ни одного примитива.");
        assert_eq!(words.message(&Message::TooManyPrimitives), "Превышено максимальное число примитивов");
    }
}
