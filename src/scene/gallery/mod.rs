//! Ready scenes: the program's own showcase and glass, the figures of the course work and the grids of its table 4.1;
//! and families of scenes that have any number of solids.
//!
//! All but the families are made here and written to `scenes/`, so that they can be drawn without the files and read
//! without the program.

mod families;
mod figures;
mod glass;
mod lights;
mod motion;
mod showcase;

use std::path::Path;

pub use families::FAMILY_LIMIT;

use super::{Scene, SceneError, SolidKind};
use families::Member;

/// A scene of the gallery.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// What the command line and the file's name call it.
    pub name: String,
    /// One line.
    pub english: String,
    /// One line.
    pub russian: String,
}

/// All scenes: the showcase, the course's start state and figures, the grids by kind and number.
pub fn entries() -> Vec<Entry> {
    makers().into_iter().map(|(entry, _)| entry).collect()
}

/// The families: in their names, N stands for a number and KIND for one of the four.
pub fn families() -> Vec<Entry> {
    families::entries()
}

/// Whether there is a scene called `name`.
pub fn has(name: &str) -> bool {
    maker(name).is_some()
}

/// The scene called `name`, of a family too.
pub fn scene(name: &str) -> Option<Scene> {
    maker(name).map(Maker::make)
}

/// Writes every scene but those of the families to `folder/NAME.toml`.
pub fn write_all(folder: &Path) -> Result<(), SceneError> {
    makers().into_iter().try_for_each(|(entry, maker)| maker.make().save(&folder.join(entry.name + ".toml")))
}

type MakeScene = fn() -> Scene;

enum Maker {
    Single(MakeScene),
    Grid(SolidKind, usize),
    Family(Member),
}

impl Maker {
    fn make(self) -> Scene {
        match self {
            Self::Single(make) => make(),
            Self::Grid(kind, count) => figures::grid(kind, count),
            Self::Family(member) => member.make(),
        }
    }
}

fn maker(name: &str) -> Option<Maker> {
    let family = Member::named(name).map(Maker::Family);
    family.or_else(|| makers().into_iter().find(|(entry, _)| entry.name == name).map(|(_, maker)| maker))
}

fn makers() -> Vec<(Entry, Maker)> {
    let single: [(&str, MakeScene, &str, &str); 18] = [
        ("showcase", showcase::scene, "the four solids among mirrors", "четыре тела среди зеркал"),
        (
            "glass",
            glass::scene,
            "four solids of glass before coloured panes",
            "четыре стеклянных тела перед цветными плитами",
        ),
        ("fading", glass::fading, "equation 1.16: a lamp that fades", "уравнение 1.16: ослабевающий источник"),
        ("room", lights::room, "coloured walls that shine on each other", "цветные стены, освещающие друг друга"),
        (
            "behind",
            lights::behind,
            "figure 1.7: a mirror shows what the camera does not see",
            "рисунок 1.7: в зеркале то, чего не видит наблюдатель",
        ),
        ("matt", lights::matt_still_life, "dark matt solids under a sky", "тёмные матовые тела под небом"),
        ("orbit", motion::orbit, "moves: once around the four solids", "движение: один оборот вокруг четырёх тел"),
        ("dolly", motion::dolly, "moves: between two mirrors", "движение: проезд между двумя зеркалами"),
        (
            "reflection",
            motion::reflection,
            "moves: reflection from 0 to 1 and back",
            "движение: отражение от 0 до 1 и обратно",
        ),
        ("start", figures::start, "the course program as it starts", "начальное состояние программы"),
        ("sphere", figures::sphere, "a sphere", "сфера"),
        ("box", figures::rotated_box, "a turned cube", "повёрнутый куб"),
        ("cylinder", figures::cylinder, "a cylinder", "цилиндр"),
        ("cone", figures::cone, "a cone", "конус"),
        ("four", figures::four, "figure 3.5: the four solids", "рисунок 3.5: четыре примитива"),
        ("light", figures::light, "figure 3.6: a coloured light", "рисунок 3.6: изменённый цвет источника"),
        ("corridor", figures::corridor, "figure 3.7: mutual reflections", "рисунок 3.7: взаимные отражения"),
        ("several", figures::several, "figure 3.8: two solids seen in a third", "рисунок 3.8: два примитива в третьем"),
    ];
    let single = single.map(|(name, make, english, russian)| {
        (Entry { name: name.into(), english: english.into(), russian: russian.into() }, Maker::Single(make))
    });
    let counts = || (10..=100).step_by(10);
    let grids = SolidKind::ALL.into_iter().flat_map(|kind| counts().map(move |count| (kind, count)));
    let grids = grids.map(|(kind, count)| {
        let russian = match kind {
            SolidKind::Sphere => "сферы",
            SolidKind::Box => "кубы",
            SolidKind::Cylinder => "цилиндры",
            SolidKind::Cone => "конусы",
        };
        let name = kind.name();
        let entry = Entry {
            name: format!("grid-{name}-{count}"),
            english: format!("table 4.1: {count} of the kind {name}"),
            russian: format!("таблица 4.1: {russian}, {count}"),
        };
        (entry, Maker::Grid(kind, count))
    });
    single.into_iter().chain(grids).collect()
}
