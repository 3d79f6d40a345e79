//! All the window says, in Russian and English.
//!
//! A sentence is a field of [`Words`], so that one without its translation does not compile.

mod english;
mod figures;
mod russian;

pub use figures::NO_FIGURE;

use super::action::Kernel;
use super::own_kernel::OwnKernel;
use super::preferences::Language;
use super::state::{FilePurpose, Message};
use crate::algorithm::{Algorithm, Precision};
use crate::scene::{Primitive, SolidKind};

/// The words of one language.
#[derive(Debug)]
pub struct Words {
    /// Words of the menu bar.
    pub menu: MenuWords,
    pub(super) groups: GroupWords,
    /// Words of the modal dialogs.
    pub dialogs: DialogWords,
    pub(super) timeline: TimelineWords,
    pub(super) help: HelpWords,

    /// Singular, as numbered names begin: «Сфера1».
    pub(super) kind_names: KindWords,
    /// Plural, for the grids of table 4.1.
    pub(super) kind_plurals: KindWords,

    pub(super) status_untitled: &'static str,
    pub(super) status_unsaved: &'static str,
    pub(super) status_samples: &'static str,
    /// Before the estimated error of a picture by path tracing.
    pub(super) status_error: &'static str,
    pub(super) status_error_hint: &'static str,
    pub(super) refusal_title: &'static str,
    /// Over why the picture is not right.
    pub(super) too_coarse_title: &'static str,
    pub(super) shader_error_title: &'static str,

    decimal_separator: &'static str,
    milliseconds: &'static str,
}

/// A word a kind of solid.
#[derive(Debug)]
pub(super) struct KindWords {
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

/// Words of the menu bar.
#[derive(Debug)]
pub struct MenuWords {
    /// Title of the first menu.
    pub file: &'static str,
    pub(super) new: &'static str,
    pub(super) open: &'static str,
    pub(super) save: &'static str,
    pub(super) save_as: &'static str,
    pub(super) screenshot: &'static str,
    /// Last entry of the first menu.
    pub quit: &'static str,

    pub(super) edit: &'static str,
    pub(super) undo: &'static str,
    pub(super) redo: &'static str,
    pub(super) duplicate: &'static str,
    pub(super) delete: &'static str,

    pub(super) gallery: &'static str,
    /// Before the plural of a kind.
    pub(super) grids_of: &'static str,

    pub(super) view: &'static str,
    pub(super) language: &'static str,
    pub(super) theme: &'static str,
    pub(super) dark: &'static str,
    pub(super) light: &'static str,
    pub(super) ui_scale: &'static str,
    pub(super) continuous: &'static str,
    pub(super) waits_for_display: &'static str,

    pub(super) help: &'static str,
    pub(super) keys_and_mouse: &'static str,
}

/// Words of the groups on the right. Capitals begin what stands by itself: titles, buttons, choices.
#[derive(Debug)]
pub(super) struct GroupWords {
    // ---- The course's groups, in its order and its words.
    pub(super) light: &'static str,
    pub(super) adding: &'static str,
    pub(super) add: KindWords,
    pub(super) choosing: &'static str,
    pub(super) moving: &'static str,
    pub(super) move_it: &'static str,
    pub(super) rotating: &'static str,
    pub(super) rotate_it: &'static str,
    pub(super) material: &'static str,

    pub(super) add_light: &'static str,
    /// Before its number.
    pub(super) delete_light: &'static str,

    pub(super) selected: &'static str,
    pub(super) nothing_selected: &'static str,
    pub(super) previous: &'static str,
    pub(super) next: &'static str,
    pub(super) name: &'static str,
    pub(super) duplicate: &'static str,
    pub(super) delete: &'static str,

    pub(super) shape: &'static str,
    pub(super) radius: &'static str,
    pub(super) half_size: &'static str,
    pub(super) first_end: &'static str,
    pub(super) second_end: &'static str,
    pub(super) apex: &'static str,
    pub(super) axis: &'static str,
    pub(super) height: &'static str,
    pub(super) half_angle: &'static str,

    pub(super) camera: &'static str,
    pub(super) background: &'static str,
    pub(super) ambient_light: &'static str,
    pub(super) attenuation: &'static str,
    pub(super) own_reflection: &'static str,
    pub(super) shininess: &'static str,
    pub(super) refractive_index: &'static str,
    pub(super) max_depth: &'static str,
    pub(super) max_depth_hint: &'static str,
    pub(super) projection: &'static str,
    pub(super) projection_course: &'static str,
    pub(super) projection_course_hint: &'static str,
    pub(super) projection_centered: &'static str,
    pub(super) vertical_fov: &'static str,
    pub(super) kernel: &'static str,
    pub(super) kernel_course: &'static str,
    pub(super) kernel_course_hint: &'static str,
    pub(super) kernel_accurate: &'static str,
    pub(super) kernel_accurate_hint: &'static str,
    pub(super) kernel_accurate_f32: &'static str,
    pub(super) kernel_accurate_f32_hint: &'static str,
    pub(super) kernel_accurate_f64: &'static str,
    pub(super) kernel_accurate_f64_hint: &'static str,
    pub(super) kernel_ssr: &'static str,
    pub(super) kernel_ssr_hint: &'static str,
    pub(super) kernel_path: &'static str,
    pub(super) kernel_path_hint: &'static str,
    /// Of the list of what draws the picture's right side.
    pub(super) beside: &'static str,
    pub(super) beside_hint: &'static str,
    /// In that list, where there is but one picture.
    pub(super) beside_nothing: &'static str,
    /// What is between the sides.
    pub(super) divider: &'static str,
    pub(super) shading: &'static str,
    pub(super) shading_lambert: &'static str,
    pub(super) shading_phong: &'static str,
    pub(super) shading_whitted: &'static str,
    pub(super) kernel_reference: &'static str,
    pub(super) kernel_reference_hint: &'static str,
    pub(super) kernel_by_setting: &'static str,
    pub(super) samples: &'static str,
    pub(super) samples_hint: &'static str,
    pub(super) path_samples: &'static str,
    pub(super) path_samples_hint: &'static str,
    pub(super) scale: &'static str,
    pub(super) scale_hint: &'static str,
    pub(super) reset_camera: &'static str,
    pub(super) fly_speed: &'static str,
    pub(super) invert_mouse: &'static str,

    pub(super) timing: &'static str,
    pub(super) fps: &'static str,
    pub(super) median: &'static str,
    pub(super) percentile_99: &'static str,
    pub(super) graph_frames: &'static str,
    pub(super) graph_time: &'static str,
}

impl GroupWords {
    /// A kernel's label and what is to be known of it; `None` of what the window does not offer.
    pub(super) fn kernel_words(&self, OwnKernel { algorithm, precision }: OwnKernel) -> Option<[&'static str; 2]> {
        match (algorithm, precision) {
            (Algorithm::Course, _) => Some([self.kernel_course, self.kernel_course_hint]),
            (Algorithm::Whitted, None) => Some([self.kernel_accurate, self.kernel_accurate_hint]),
            (Algorithm::Whitted, Some(Precision::F32)) => {
                Some([self.kernel_accurate_f32, self.kernel_accurate_f32_hint])
            }
            (Algorithm::Whitted, Some(Precision::F64)) => {
                Some([self.kernel_accurate_f64, self.kernel_accurate_f64_hint])
            }
            (Algorithm::Reference, _) => Some([self.kernel_reference, self.kernel_reference_hint]),
            (Algorithm::Ssr, _) => Some([self.kernel_ssr, self.kernel_ssr_hint]),
            (Algorithm::Path, None) => Some([self.kernel_path, self.kernel_path_hint]),
            (Algorithm::Plain, _) | (Algorithm::Path, Some(_)) => None,
        }
    }
}

/// Words of the modal dialogs.
#[derive(Debug)]
pub struct DialogWords {
    pub(super) error: &'static str,
    /// Over what a file of another program was read as.
    pub(super) read_otherwise: &'static str,
    pub(super) ok: &'static str,
    pub(super) cancel: &'static str,
    pub(super) no_primitives: &'static str,
    pub(super) scene_changed: &'static str,
    pub(super) nothing_selected: &'static str,
    pub(super) too_many_primitives: &'static str,

    pub(super) unsaved_title: &'static str,
    pub(super) unsaved: &'static str,
    pub(super) save: &'static str,
    /// Answer to the question about unsaved changes.
    pub discard: &'static str,

    pub(super) recover_title: &'static str,
    pub(super) recover: &'static str,
    pub(super) recover_yes: &'static str,
    pub(super) recover_no: &'static str,

    pub(super) open_title: &'static str,
    pub(super) save_title: &'static str,
    pub(super) screenshot_title: &'static str,
    pub(super) open: &'static str,
    pub(super) folder_up: &'static str,
    /// For the list of files; nothing shows it yet.
    pub files: &'static str,
    pub(super) no_files: &'static str,
    /// Label of the field for a name in a file dialog.
    pub file_name: &'static str,
    pub(super) file_name_missing: &'static str,
    pub(super) no_such_file: &'static str,
    pub(super) no_such_folder: &'static str,
    /// Before the extensions.
    pub(super) scene_extension: &'static str,
    /// Before the extensions.
    pub(super) picture_extension: &'static str,
    /// Before what the system said.
    pub(super) folder_unreadable: &'static str,
    pub(super) replace_question: &'static str,
    pub(super) replace: &'static str,
    pub(super) keep: &'static str,
}

/// Words of the bar under a scene that moves.
#[derive(Debug)]
pub(super) struct TimelineWords {
    pub(super) title: &'static str,
    pub(super) play: &'static str,
    pub(super) pause: &'static str,
    /// Button that shows the scene as its file has it.
    pub(super) stop: &'static str,
    pub(super) stop_hint: &'static str,
    pub(super) time: &'static str,
    /// Between a time and how long all takes.
    pub(super) of: &'static str,
    pub(super) seconds: &'static str,
    pub(super) rate: &'static str,
    pub(super) follows_camera: &'static str,
    pub(super) follows_camera_hint: &'static str,
}

/// Words of the sheet of keys.
#[derive(Debug)]
pub(super) struct HelpWords {
    pub(super) title: &'static str,
    /// What to press, what comes of it.
    pub(super) rows: [(&'static str, &'static str); 17],
}

impl Language {
    /// All that the window says in it.
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

    pub(super) fn message<'a>(&self, message: &'a Message) -> &'a str {
        match message {
            Message::NoPrimitives => self.dialogs.no_primitives,
            Message::NothingSelected => self.dialogs.nothing_selected,
            Message::TooManyPrimitives => self.dialogs.too_many_primitives,
            Message::SceneChanged => self.dialogs.scene_changed,
            Message::ReadOtherwise(what) | Message::Failure(what) => what,
        }
    }

    pub(super) fn message_title(&self, message: &Message) -> &'static str {
        match message {
            Message::ReadOtherwise(_) => self.dialogs.read_otherwise,
            _ => self.dialogs.error,
        }
    }

    pub(super) fn file_dialog_title(&self, purpose: FilePurpose) -> &'static str {
        match purpose {
            FilePurpose::Open => self.dialogs.open_title,
            FilePurpose::Save => self.dialogs.save_title,
            FilePurpose::Screenshot => self.dialogs.screenshot_title,
        }
    }

    /// Of what draws a picture, in a precision where that was chosen.
    pub(super) fn kernel_name(&self, kernel: Kernel, precision: Option<Precision>) -> &'static str {
        let words = match kernel {
            Kernel::Own(kernel) => {
                let exact = OwnKernel { precision: precision.or(kernel.precision), ..kernel };
                self.groups.kernel_words(exact).or_else(|| self.groups.kernel_words(kernel))
            }
            Kernel::BySetting(_) => Some([self.groups.kernel_by_setting, ""]),
        };
        words.map_or("", |[label, _]| label)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
