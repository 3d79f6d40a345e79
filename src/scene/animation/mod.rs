//! A scene that moves: which of its numbers change with time, and through what values.
//!
//! A scene is what it is without its animation, until it is [brought to a time](Scene::go_to). What it is then depends
//! on that time alone, not on the times before: pictures of an animation can be drawn in any order and by several
//! machines.

mod curve;
mod slot;

use std::collections::HashMap;
use std::mem;

use glam::DVec3;

use super::validate::{Place, Violation, check_part};
use super::{Scene, SceneError, text};
pub use curve::Interpolation;
pub(crate) use slot::fields;
use slot::{LOOK_AT, slot};

/// One number, vector or pair of points of a scene, and its values with time.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// What it changes something of.
    pub part: Part,
    /// What of that, as the scene file names it: `camera.position`, `radius`, `material.reflection`.
    pub field: &'static str,
    /// What it is between two keyframes.
    pub interpolation: Interpolation,
    /// At least one, in the order of their times. Before the first it has the value of that, after the last of that.
    pub keyframes: Vec<Keyframe>,
}

impl Track {
    /// That it takes in memory.
    pub(crate) fn size_bytes(&self) -> usize {
        size_of::<Self>() + self.keyframes.len() * size_of::<Keyframe>()
    }
}

/// A part of a scene that has fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Part {
    /// The scene itself, and its camera.
    Scene,
    /// By its index.
    Light(usize),
    /// By its index.
    Primitive(usize),
}

/// A value at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Keyframe {
    /// From the animation's start, 0 to [`Keyframe::LATEST_SECONDS`].
    pub seconds: f64,
    /// Of the field's kind.
    pub value: Value,
}

impl Keyframe {
    /// 10⁶ s: nearly twelve days.
    pub const LATEST_SECONDS: f64 = 1e6;
}

/// What a field has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// In the unit of the field.
    Number(f64),
    /// A point, a direction, a colour, sizes or angles.
    Vector(DVec3),
    /// Of a cylinder.
    Points([DVec3; 2]),
}

impl Value {
    /// As scene files and messages have it.
    pub(super) fn text(self) -> String {
        match self {
            Self::Number(value) => text::number(value),
            Self::Vector(value) => text::vector(value),
            Self::Points(value) => text::points(value),
        }
    }
}

impl Scene {
    /// Time of the last keyframe, s; 0 without any.
    pub fn duration_seconds(&self) -> f64 {
        self.animation.iter().filter_map(|track| track.keyframes.last()).map(|last| last.seconds).fold(0.0, f64::max)
    }

    /// Brings everything that is animated to a time, s.
    ///
    /// # Errors
    /// Between keyframes something has a value that a scene may not have: two ends of a cylinder that meet, a camera's
    /// `up` along its direction. The scene is to be used no more then.
    pub fn go_to(&mut self, seconds: f64) -> Result<(), SceneError> {
        let tracks = mem::take(&mut self.animation);
        apply(tracks.iter(), self, seconds);
        self.animation = tracks;
        for Track { part, .. } in &self.animation {
            check_part(self, *part).map_err(|violation| SceneError::refused(format!("at {seconds} s: {violation}")))?;
        }
        Ok(())
    }

    /// Takes a primitive out, with what is animated of it.
    ///
    /// # Panics
    /// There is none of that index.
    pub fn remove_primitive(&mut self, index: usize) {
        self.primitives.remove(index);
        self.retarget(|part| match part {
            Part::Primitive(other) => index_without(index, other).map(Part::Primitive),
            other => Some(other),
        });
    }

    /// Takes a light out, with what is animated of it.
    ///
    /// # Panics
    /// There is none of that index.
    pub fn remove_light(&mut self, index: usize) {
        self.lights.remove(index);
        self.retarget(|part| match part {
            Part::Light(other) => index_without(index, other).map(Part::Light),
            other => Some(other),
        });
    }

    /// Names every animated part anew; what has no name is animated no more.
    fn retarget(&mut self, name: impl Fn(Part) -> Option<Part>) {
        self.animation.retain_mut(|track| name(track.part).map(|part| track.part = part).is_some());
    }
}

/// Number of the last picture that is not after a time, of so many a second from 0 on. A time that is a whole number of
/// pictures but for its rounding has that picture: quotient and product are off by an ulp each, 2⁻⁵² of a number.
pub fn picture_at(seconds: f64, pictures_a_second: f64) -> u64 {
    (seconds * pictures_a_second * (1.0 + 4.0 * f64::EPSILON)).floor() as u64
}

/// What `other` is counted as when `index` is gone.
fn index_without(index: usize, other: usize) -> Option<usize> {
    (other != index).then(|| other - usize::from(other > index))
}

/// Where the camera looks comes last: it depends on where it is.
fn apply<'t>(tracks: impl Iterator<Item = &'t Track> + Clone, scene: &mut Scene, seconds: f64) {
    let (last, first): (Vec<_>, Vec<_>) = tracks.partition(|track| track.field == LOOK_AT);
    for Track { part, field, interpolation, keyframes } in first.into_iter().chain(last) {
        if let Some(mut slot) = slot(scene, *part, field) {
            slot.set(curve::at(keyframes, *interpolation, slot.kind(), seconds));
        }
    }
}

/// The rules of an animation: everything it names is there, and every keyframe leaves what it changes valid.
pub(super) fn check(scene: &Scene) -> Result<(), Violation<'_>> {
    if scene.animation.is_empty() {
        return Ok(());
    }
    let mut moved = scene.clone();
    let mut of_part: HashMap<Part, Vec<&Track>> = HashMap::new();
    for (index, track) in scene.animation.iter().enumerate() {
        let wrong = |field, value: String, rule| Violation::new(Place::Track(index), field, value, rule);
        let &Track { part, field, ref keyframes, .. } = track;
        if !part.is_in(scene) {
            return Err(wrong(part.key(), part.number().to_string(), "there is no such"));
        }
        let Some(slot) = slot(&mut moved, part, field) else {
            return Err(wrong("field", format!("\"{field}\""), "there is no such field, or none that can be animated"));
        };
        if keyframes.is_empty() {
            return Err(wrong("keyframes", "[]".to_owned(), "must have at least one"));
        }
        for (place, keyframe) in keyframes.iter().enumerate() {
            let wrong = |field, value, rule| Err(Violation::new(Place::Keyframe(index, place), field, value, rule));
            let seconds = keyframe.seconds;
            if !(0.0..=Keyframe::LATEST_SECONDS).contains(&seconds) {
                return wrong("seconds", seconds.to_string(), "must be from 0 to 1000000");
            }
            if place > 0 && seconds <= keyframes[place - 1].seconds {
                return wrong("seconds", seconds.to_string(), "must be later than that of the keyframe before");
            }
            if let Err(rule) = slot.check(keyframe.value) {
                return wrong("value", keyframe.value.text(), rule);
            }
        }
        let siblings = of_part.entry(part).or_default();
        if siblings.iter().any(|other| other.field == field) {
            return Err(wrong("field", format!("\"{field}\""), "is animated already"));
        }
        let is_of_view = |field: &str| [LOOK_AT, "camera.direction"].contains(&field);
        if is_of_view(field) && siblings.iter().any(|other| is_of_view(other.field)) {
            return Err(wrong("field", format!("\"{field}\""), "the camera's direction is animated already"));
        }
        siblings.push(track);
    }
    for (index, track) in scene.animation.iter().enumerate() {
        for (place, keyframe) in track.keyframes.iter().enumerate() {
            apply(of_part[&track.part].iter().copied(), &mut moved, keyframe.seconds);
            // Names are those of the scene itself.
            check_part(&moved, track.part).map_err(|violation| violation.at_keyframe(index, place, scene))?;
        }
    }
    Ok(())
}

impl Part {
    fn is_in(self, scene: &Scene) -> bool {
        match self {
            Self::Scene => true,
            Self::Light(index) => index < scene.lights.len(),
            Self::Primitive(index) => index < scene.primitives.len(),
        }
    }

    /// Of the scene file.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Scene => "field",
            Self::Light(_) => "light",
            Self::Primitive(_) => "primitive",
        }
    }

    /// As messages and scene files count it, from 1.
    pub(super) fn number(self) -> usize {
        match self {
            Self::Scene => 0,
            Self::Light(index) | Self::Primitive(index) => index + 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_of_a_picture_has_that_picture_however_it_is_rounded() {
        for fps in [7.0, 24.0, 24000.0 / 1001.0, 30.0, 100.0] {
            for number in 0..5000_u64 {
                assert_eq!(picture_at(number as f64 / fps, fps), number, "{fps}");
            }
        }
        assert_eq!((picture_at(0.999, 1.0), picture_at(0.29, 100.0), picture_at(1e6, 1e9)), (0, 29, 1e15 as u64));
    }
}
