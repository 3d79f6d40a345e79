//! What a scene must satisfy before anything is computed from it.
//!
//! The kernels calculate in `f32` or `f64`, so no value may exceed the largest `f32`. Small values are not limited:
//! one that is 0 as `f32` (a radius of 1e-60) is drawn by the `f64` kernels and vanishes for the others.

use std::fmt;

use glam::DVec3;

use super::animation::{self, Part};
use super::{Camera, Light, Primitive, Scene, SceneError, Solid, SolidKind, text};

/// Most primitives in a scene, 2²⁴: every index is exact as `f32`, and the records fit one storage buffer of 2 GiB.
pub const PRIMITIVE_LIMIT: usize = 1 << 24;

/// Most lights in a scene: each costs a shadow ray at every hit.
pub const LIGHT_LIMIT: usize = 64;

/// Most generations of a ray: past them even a mirror with k_s = 0.99 weighs less than 1e-4.
pub const DEPTH_LIMIT: u32 = 1000;

/// Smallest sine of the angle between the camera's `direction` and `up`: below it the camera's basis, computed in
/// `f64`, would keep fewer digits than an `f32` has.
const SMALLEST_UP_SINE: f64 = 1e-9;

pub(super) const FINITE: &str = "must be a finite number of at most 3.4028235e38";
pub(super) const DEPTH: &str = "must be a whole number from 1 to 1000";
const POSITIVE: &str = "must be greater than 0";
const NOT_NEGATIVE: &str = "must be 0 or greater";
const FRACTION: &str = "must be from 0 to 1";
const NOT_ZERO: &str = "must not be zero";

impl Scene {
    /// Checks every rule. Loading does it too; programs that build or edit a scene in memory call it themselves.
    pub fn validate(&self) -> Result<(), SceneError> {
        check(self).map_err(|violation| SceneError::refused(violation.to_string()))
    }
}

/// A part of the scene, as messages name it; primitives and lights are counted from 1 there.
#[derive(Debug, Clone, Copy)]
pub(super) enum Place<'a> {
    Scene,
    Camera,
    Light(usize),
    Primitive {
        index: usize,
        kind: Option<SolidKind>,
        name: Option<&'a str>,
    },
    Track(usize),
    /// Indices of the track and of the keyframe in it.
    Keyframe(usize, usize),
}

impl<'a> Place<'a> {
    pub(super) fn of_primitive(index: usize, primitive: &'a Primitive) -> Self {
        Self::Primitive { index, kind: Some(primitive.solid.kind()), name: primitive.name.as_deref() }
    }
}

impl fmt::Display for Place<'_> {
    /// With a colon and a space behind it; nothing for the scene itself.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene => Ok(()),
            Self::Camera => write!(f, "camera: "),
            Self::Light(index) => write!(f, "light {}: ", index + 1),
            Self::Track(index) => write!(f, "animation {}: ", index + 1),
            Self::Keyframe(track, keyframe) => write!(f, "animation {}, keyframe {}: ", track + 1, keyframe + 1),
            Self::Primitive { index, kind, name } => {
                let kind = kind.map(|kind| kind.name().to_owned());
                let name = name.map(|name| format!("\"{}\"", text::one_line(name, text::LONGEST_QUOTE)));
                let about: Vec<String> = kind.into_iter().chain(name).collect();
                write!(f, "primitive {}", index + 1)?;
                if !about.is_empty() {
                    write!(f, " ({})", about.join(" "))?;
                }
                write!(f, ": ")
            }
        }
    }
}

/// A broken rule.
pub(super) struct Violation<'a> {
    pub(super) place: Place<'a>,
    /// As in the scene file, `material.color` included.
    pub(super) field: &'static str,
    value: String,
    rule: &'static str,
    /// Of the animation, where that brings it about.
    pub(super) keyframe: Option<Place<'a>>,
}

impl<'a> Violation<'a> {
    pub(super) fn new(place: Place<'a>, field: &'static str, value: String, rule: &'static str) -> Self {
        Self { place, field, value, rule, keyframe: None }
    }

    /// The same as brought about by a keyframe in a scene of the same parts.
    pub(super) fn at_keyframe(self, track: usize, keyframe: usize, scene: &Scene) -> Violation<'_> {
        let Self { place, field, value, rule, .. } = self;
        let place = match place {
            Place::Primitive { index, .. } => Place::of_primitive(index, &scene.primitives[index]),
            Place::Scene => Place::Scene,
            Place::Camera => Place::Camera,
            Place::Light(index) => Place::Light(index),
            Place::Track(track) => Place::Track(track),
            Place::Keyframe(track, keyframe) => Place::Keyframe(track, keyframe),
        };
        Violation { place, field, value, rule, keyframe: Some(Place::Keyframe(track, keyframe)) }
    }
}

impl fmt::Display for Violation<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, field, value, rule, keyframe } = self;
        keyframe.iter().try_for_each(|keyframe| write!(f, "{keyframe}"))?;
        write!(f, "{place}{field} = {value}: {rule}")
    }
}

/// The first broken rule, in the order of the scene's fields.
pub(super) fn check(scene: &Scene) -> Result<(), Violation<'_>> {
    check_part(scene, Part::Scene)?;
    let whole = Field::of(Place::Scene);
    whole.rule("max_depth", (1..=DEPTH_LIMIT).contains(&scene.max_depth), DEPTH, || scene.max_depth.to_string())?;
    check_light_count(scene.lights.len())?;
    check_primitive_count(scene.primitives.len())?;
    for (index, light) in scene.lights.iter().enumerate() {
        check_light(index, light)?;
    }
    for (index, primitive) in scene.primitives.iter().enumerate() {
        check_primitive(index, primitive)?;
    }
    animation::check(scene)
}

/// What can be animated of a part, which is there.
pub(super) fn check_part(scene: &Scene, part: Part) -> Result<(), Violation<'_>> {
    match part {
        Part::Scene => {
            check_camera(&scene.camera)?;
            let whole = Field::of(Place::Scene);
            whole.vector("background", scene.background, NOT_NEGATIVE, |v| v.min_element() >= 0.0)?;
            whole.vector("ambient_light", scene.ambient_light, NOT_NEGATIVE, |v| v.min_element() >= 0.0)
        }
        Part::Light(index) => check_light(index, &scene.lights[index]),
        Part::Primitive(index) => check_primitive(index, &scene.primitives[index]),
    }
}

pub(super) fn check_light_count(count: usize) -> Result<(), Violation<'static>> {
    let shown = || format!("[{count} of them]");
    Field::of(Place::Scene).rule("lights", count <= LIGHT_LIMIT, "at most 64 are allowed", shown)
}

pub(super) fn check_primitive_count(count: usize) -> Result<(), Violation<'static>> {
    let shown = || format!("[{count} of them]");
    Field::of(Place::Scene).rule("primitives", count <= PRIMITIVE_LIMIT, "at most 16777216 are allowed", shown)
}

pub(super) fn check_camera(camera: &Camera) -> Result<(), Violation<'_>> {
    let field = Field::of(Place::Camera);
    field.any_vector("position", camera.position)?;
    field.vector("direction", camera.direction, NOT_ZERO, |v| v != DVec3::ZERO)?;
    field.vector("up", camera.up, NOT_ZERO, |v| v != DVec3::ZERO)?;
    let up_sine = unit(camera.direction).cross(unit(camera.up)).length();
    field.vector("up", camera.up, "must not be parallel to direction", |_| up_sine >= SMALLEST_UP_SINE)?;
    field.number("vertical_fov_degrees", camera.vertical_fov_degrees, "must be between 0 and 180", |x| {
        x > 0.0 && x < 180.0
    })
}

pub(super) fn check_light(index: usize, light: &Light) -> Result<(), Violation<'_>> {
    let field = Field::of(Place::Light(index));
    field.any_vector("position", light.position)?;
    field.vector("intensity", light.intensity, NOT_NEGATIVE, |v| v.min_element() >= 0.0)?;
    field.number("radius", light.radius, "must be 0 or greater", |x| x >= 0.0)?;
    match light.distance_constant {
        Some(constant) => field.number("distance_constant", constant, POSITIVE, |x| x > 0.0),
        None => Ok(()),
    }
}

pub(super) fn check_primitive(index: usize, primitive: &Primitive) -> Result<(), Violation<'_>> {
    let field = Field::of(Place::of_primitive(index, primitive));
    match &primitive.solid {
        Solid::Sphere { center, radius } => {
            field.any_vector("center", *center)?;
            field.number("radius", *radius, POSITIVE, |x| x > 0.0)?;
        }
        Solid::Box { center, half_size, rotation_degrees } => {
            field.any_vector("center", *center)?;
            // A plate without thickness is legal: both of its faces are hit.
            field.vector("half_size", *half_size, NOT_NEGATIVE, |v| v.min_element() >= 0.0)?;
            field.any_vector("rotation_degrees", *rotation_degrees)?;
        }
        Solid::Cylinder { ends, radius } => {
            let shown = || text::points(*ends);
            field.rule("ends", ends.iter().all(|end| is_finite_f32(*end)), FINITE, shown)?;
            field.rule("ends", ends[0] != ends[1], "must be two different points", shown)?;
            field.number("radius", *radius, POSITIVE, |x| x > 0.0)?;
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            field.any_vector("apex", *apex)?;
            field.vector("axis", *axis, NOT_ZERO, |v| v != DVec3::ZERO)?;
            field.vector("axis", *axis, "must have length 1", is_unit)?;
            field.number("height", *height, POSITIVE, |x| x > 0.0)?;
            field.number("half_angle_degrees", *half_angle_degrees, "must be between 0 and 90", |x| {
                x > 0.0 && x < 90.0
            })?;
        }
    }
    let material = &primitive.material;
    field.vector("material.color", material.color, FRACTION, |v| v.min_element() >= 0.0 && v.max_element() <= 1.0)?;
    field.number("material.ambient", material.ambient, FRACTION, |x| (0.0..=1.0).contains(&x))?;
    field.number("material.diffuse", material.diffuse, FRACTION, |x| (0.0..=1.0).contains(&x))?;
    field.number("material.specular", material.specular, FRACTION, |x| (0.0..=1.0).contains(&x))?;
    field.number("material.reflection", material.reflection(), FRACTION, |x| (0.0..=1.0).contains(&x))?;
    field
        .number("material.shininess", material.shininess, "must be from 1 to 1024", |x| (1.0..=1024.0).contains(&x))?;
    field.number("material.transmission", material.transmission, FRACTION, |x| (0.0..=1.0).contains(&x))?;
    let index_rule = "must be from 0.01 to 100";
    field.number("material.refractive_index", material.refractive_index, index_rule, |x| (0.01..=100.0).contains(&x))
}

/// The fields of one place: each check passes or says what is wrong there.
struct Field<'a> {
    place: Place<'a>,
}

impl<'a> Field<'a> {
    fn of(place: Place<'a>) -> Self {
        Self { place }
    }

    fn rule(
        &self,
        field: &'static str,
        holds: bool,
        rule: &'static str,
        shown: impl Fn() -> String,
    ) -> Result<(), Violation<'a>> {
        if holds { Ok(()) } else { Err(Violation::new(self.place, field, shown(), rule)) }
    }

    fn number(
        &self,
        field: &'static str,
        value: f64,
        rule: &'static str,
        holds: impl Fn(f64) -> bool,
    ) -> Result<(), Violation<'a>> {
        let shown = || text::number(value);
        self.rule(field, is_finite_f32(DVec3::splat(value)), FINITE, shown)?;
        self.rule(field, holds(value), rule, shown)
    }

    fn vector(
        &self,
        field: &'static str,
        value: DVec3,
        rule: &'static str,
        holds: impl Fn(DVec3) -> bool,
    ) -> Result<(), Violation<'a>> {
        let shown = || text::vector(value);
        self.rule(field, is_finite_f32(value), FINITE, shown)?;
        self.rule(field, holds(value), rule, shown)
    }

    fn any_vector(&self, field: &'static str, value: DVec3) -> Result<(), Violation<'a>> {
        self.vector(field, value, FINITE, |_| true)
    }
}

/// Finite, and still finite when rounded to `f32`.
fn is_finite_f32(value: DVec3) -> bool {
    value.is_finite() && value.abs().max_element() <= f64::from(f32::MAX)
}

/// `value` scaled to length 1, from any finite length but 0: the largest component is made 1 first, lest its square
/// overflow or vanish. A vector that [`is_unit`] already is returned to the bit, so that loading what was saved
/// changes nothing.
pub(super) fn unit(value: DVec3) -> DVec3 {
    let largest = value.abs().max_element();
    if is_unit(value) || largest == 0.0 || !value.is_finite() { value } else { (value / largest).normalize() }
}

/// Length 1 as far as normalising can make it: length, reciprocal and product err by half an ulp each, twice that in
/// the square.
fn is_unit(value: DVec3) -> bool {
    (value.length_squared() - 1.0).abs() <= 8.0 * f64::EPSILON
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_beyond_the_limits_are_refused() {
        assert!(check_light_count(LIGHT_LIMIT).is_ok() && check_primitive_count(PRIMITIVE_LIMIT).is_ok());
        let message = check_primitive_count(PRIMITIVE_LIMIT + 1).err().map(|violation| violation.to_string());
        assert_eq!(message.as_deref(), Some("primitives = [16777217 of them]: at most 16777216 are allowed"));
        assert!(check_light_count(LIGHT_LIMIT + 1).is_err());
    }

    #[test]
    fn limits_in_the_messages_are_the_limits_checked() {
        assert!(DEPTH.ends_with(&DEPTH_LIMIT.to_string()));
        assert_eq!((LIGHT_LIMIT, PRIMITIVE_LIMIT), (64, 16_777_216));
    }

    #[test]
    fn unit_of_extreme_vectors_has_length_one_and_is_stable() {
        for scale in [5e-324, 1e-200, 1e-30, 1.0, 3.0, 1e38] {
            let once = unit(DVec3::new(1.0, -2.0, 3.0) * scale);
            assert!(is_unit(once), "{scale:e}: {once:?}");
            assert_eq!(unit(once), once);
        }
    }
}
