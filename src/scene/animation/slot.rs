//! The fields that can be animated, by the names that the scene file has for them.

use glam::DVec3;

use super::{Part, Value};
use crate::scene::validate::{FINITE, unit};
use crate::scene::{Camera, Material, Scene, Solid, SolidKind};

/// A point: the camera looks at it from wherever it is.
pub(super) const LOOK_AT: &str = "camera.look_at";

const SCENE: &[&str] = &[
    "background",
    "ambient_light",
    "camera.position",
    "camera.direction",
    LOOK_AT,
    "camera.up",
    "camera.vertical_fov_degrees",
];
const LIGHT: &[&str] = &["position", "intensity", "radius", "distance_constant"];
const MATERIAL: &[&str] = &[
    "material.color",
    "material.ambient",
    "material.diffuse",
    "material.specular",
    "material.reflection",
    "material.shininess",
    "material.transmission",
    "material.refractive_index",
];

/// The names of a part's fields; of a primitive by its kind.
pub(crate) fn fields(part: Part, kind: Option<SolidKind>) -> Vec<&'static str> {
    let own: &[&str] = match (part, kind) {
        (Part::Scene, _) => SCENE,
        (Part::Light(_), _) => LIGHT,
        (Part::Primitive(_), None) => &[],
        (Part::Primitive(_), Some(SolidKind::Sphere)) => &["center", "radius"],
        (Part::Primitive(_), Some(SolidKind::Box)) => &["center", "half_size", "rotation_degrees"],
        (Part::Primitive(_), Some(SolidKind::Cylinder)) => &["ends", "radius"],
        (Part::Primitive(_), Some(SolidKind::Cone)) => &["apex", "axis", "height", "half_angle_degrees"],
    };
    let of_material = if matches!(part, Part::Primitive(_)) { MATERIAL } else { &[] };
    [own, of_material].concat()
}

/// How values of a field go over into each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A number, sizes or a colour, which have limits: no value is beyond those of the keyframes around it.
    Limited,
    /// Points, each component by itself.
    Free,
    /// By the shortest arc; only the direction of a vector matters.
    Direction,
    /// The angles of a box, by the shortest arc of what they turn.
    Rotation,
}

/// A field of a scene.
pub(super) enum Slot<'s> {
    Number(&'s mut f64),
    Optional(&'s mut Option<f64>),
    Amounts(&'s mut DVec3),
    Point(&'s mut DVec3),
    LookAt(&'s mut Camera),
    Direction(&'s mut DVec3),
    /// Whose length is 1.
    Axis(&'s mut DVec3),
    Rotation(&'s mut DVec3),
    Points(&'s mut [DVec3; 2]),
}

/// The field of a part, if it has that.
pub(super) fn slot<'s>(scene: &'s mut Scene, part: Part, field: &str) -> Option<Slot<'s>> {
    Some(match part {
        Part::Scene => match field {
            "background" => Slot::Amounts(&mut scene.background),
            "ambient_light" => Slot::Amounts(&mut scene.ambient_light),
            "camera.position" => Slot::Point(&mut scene.camera.position),
            "camera.direction" => Slot::Direction(&mut scene.camera.direction),
            LOOK_AT => Slot::LookAt(&mut scene.camera),
            "camera.up" => Slot::Direction(&mut scene.camera.up),
            "camera.vertical_fov_degrees" => Slot::Number(&mut scene.camera.vertical_fov_degrees),
            _ => return None,
        },
        Part::Light(index) => {
            let light = scene.lights.get_mut(index)?;
            match field {
                "position" => Slot::Point(&mut light.position),
                "intensity" => Slot::Amounts(&mut light.intensity),
                "radius" => Slot::Number(&mut light.radius),
                "distance_constant" => Slot::Optional(&mut light.distance_constant),
                _ => return None,
            }
        }
        Part::Primitive(index) => {
            let primitive = scene.primitives.get_mut(index)?;
            match field.strip_prefix("material.") {
                Some(field) => of_material(&mut primitive.material, field)?,
                None => of_solid(&mut primitive.solid, field)?,
            }
        }
    })
}

fn of_solid<'s>(solid: &'s mut Solid, field: &str) -> Option<Slot<'s>> {
    Some(match (solid, field) {
        (Solid::Sphere { center, .. } | Solid::Box { center, .. }, "center") => Slot::Point(center),
        (Solid::Sphere { radius, .. } | Solid::Cylinder { radius, .. }, "radius") => Slot::Number(radius),
        (Solid::Box { half_size, .. }, "half_size") => Slot::Amounts(half_size),
        (Solid::Box { rotation_degrees, .. }, "rotation_degrees") => Slot::Rotation(rotation_degrees),
        (Solid::Cylinder { ends, .. }, "ends") => Slot::Points(ends),
        (Solid::Cone { apex, .. }, "apex") => Slot::Point(apex),
        (Solid::Cone { axis, .. }, "axis") => Slot::Axis(axis),
        (Solid::Cone { height, .. }, "height") => Slot::Number(height),
        (Solid::Cone { half_angle_degrees, .. }, "half_angle_degrees") => Slot::Number(half_angle_degrees),
        _ => return None,
    })
}

fn of_material<'s>(material: &'s mut Material, field: &str) -> Option<Slot<'s>> {
    Some(match field {
        "color" => Slot::Amounts(&mut material.color),
        "ambient" => Slot::Number(&mut material.ambient),
        "diffuse" => Slot::Number(&mut material.diffuse),
        "specular" => Slot::Number(&mut material.specular),
        "reflection" => Slot::Optional(&mut material.reflection),
        "shininess" => Slot::Number(&mut material.shininess),
        "transmission" => Slot::Number(&mut material.transmission),
        "refractive_index" => Slot::Number(&mut material.refractive_index),
        _ => return None,
    })
}

impl Slot<'_> {
    pub fn kind(&self) -> Kind {
        match self {
            Self::Number(_) | Self::Optional(_) | Self::Amounts(_) => Kind::Limited,
            Self::Point(_) | Self::LookAt(_) | Self::Points(_) => Kind::Free,
            Self::Direction(_) | Self::Axis(_) => Kind::Direction,
            Self::Rotation(_) => Kind::Rotation,
        }
    }

    /// # Errors
    /// The rule, where a value is not of its type or not finite.
    pub fn check(&self, value: Value) -> Result<(), &'static str> {
        let (is_of_type, rule) = match self {
            Self::Number(_) | Self::Optional(_) => (matches!(value, Value::Number(_)), "must be a number"),
            Self::Points(_) => (matches!(value, Value::Points(_)), "must be an array of two points"),
            _ => (matches!(value, Value::Vector(_)), "must be an array of three numbers"),
        };
        let is_finite = match value {
            Value::Number(number) => number.is_finite(),
            Value::Vector(vector) => vector.is_finite(),
            Value::Points(points) => points.iter().all(|point| point.is_finite()),
        };
        match (is_of_type, is_finite) {
            (false, _) => Err(rule),
            (true, false) => Err(FINITE),
            (true, true) => Ok(()),
        }
    }

    /// Nothing where the value is not of its type.
    pub fn set(&mut self, value: Value) {
        match (self, value) {
            (Self::Number(slot), Value::Number(number)) => **slot = number,
            (Self::Optional(slot), Value::Number(number)) => **slot = Some(number),
            (Self::Points(slot), Value::Points(points)) => **slot = points,
            (Self::LookAt(camera), Value::Vector(point)) => camera.direction = point - camera.position,
            (Self::Axis(slot), Value::Vector(axis)) => **slot = unit(axis),
            (
                Self::Amounts(slot) | Self::Point(slot) | Self::Direction(slot) | Self::Rotation(slot),
                Value::Vector(vector),
            ) => **slot = vector,
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Light, Primitive};

    #[test]
    fn every_field_that_is_named_is_there() {
        for kind in SolidKind::ALL {
            let primitives = vec![Primitive::course_default(kind)];
            let mut scene = Scene { lights: vec![Light::default()], primitives, ..Scene::default() };
            for part in [Part::Scene, Part::Light(0), Part::Primitive(0)] {
                for field in fields(part, Some(kind)) {
                    assert!(slot(&mut scene, part, field).is_some(), "{kind:?}: {field}");
                }
            }
        }
    }
}
