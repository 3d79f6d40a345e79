use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Material;

/// A solid with its material.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// For people only; need not be unique.
    pub name: Option<String>,
    /// Shape and pose, world frame.
    pub solid: Solid,
    /// The same all over its surface.
    pub material: Material,
}

impl Primitive {
    /// What the course's «Добавить» button makes: [`Solid::course_default`] with the default material.
    pub fn course_default(kind: SolidKind) -> Self {
        Self { name: None, solid: Solid::course_default(kind), material: Material::default() }
    }
}

/// Which of the four solids, without its sizes; in JSON by its [name](SolidKind::name).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SolidKind {
    /// Given by its centre and radius.
    Sphere,
    /// Given by its centre, half sizes and three angles.
    Box,
    /// Given by the centres of its bases and its radius.
    Cylinder,
    /// Given by its apex, axis, height and angle.
    Cone,
}

impl SolidKind {
    /// In the order of the course kernel's search, which decides ties.
    pub const ALL: [SolidKind; 4] = [Self::Sphere, Self::Box, Self::Cylinder, Self::Cone];

    /// The word of the scene file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Box => "box",
            Self::Cylinder => "cylinder",
            Self::Cone => "cone",
        }
    }
}

/// Shape and pose in the world frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// All that is at most `radius` from `center`.
    Sphere {
        /// World frame.
        center: DVec3,
        /// World units.
        radius: f64,
    },
    /// Turned about its centre.
    Box {
        /// World frame.
        center: DVec3,
        /// Half of each edge, along the box's own axes; world units.
        half_size: DVec3,
        /// (a, b, c) of local→world = Rx(−a)·Ry(−b)·Rz(−c), the course's rule.
        rotation_degrees: DVec3,
    },
    /// Capped at both ends.
    Cylinder {
        /// Centres of the two bases.
        ends: [DVec3; 2],
        /// Radius of both bases; world units.
        radius: f64,
    },
    /// One nappe from the apex to the base disk at `height` along `axis`.
    Cone {
        /// World frame.
        apex: DVec3,
        /// From the apex towards the base; unit length.
        axis: DVec3,
        /// Along the axis, world units.
        height: f64,
        /// Angle between axis and side, in (0, 90).
        half_angle_degrees: f64,
    },
}

impl Solid {
    /// Whether it is a box without thickness: a single surface, through which light goes straight on.
    pub fn is_plate(&self) -> bool {
        matches!(self, Self::Box { half_size, .. } if half_size.min_element() == 0.0)
    }

    /// Which of the four it is.
    pub fn kind(&self) -> SolidKind {
        match self {
            Self::Sphere { .. } => SolidKind::Sphere,
            Self::Box { .. } => SolidKind::Box,
            Self::Cylinder { .. } => SolidKind::Cylinder,
            Self::Cone { .. } => SolidKind::Cone,
        }
    }

    /// What the course's «Добавить» button makes, at the origin.
    pub fn course_default(kind: SolidKind) -> Self {
        match kind {
            SolidKind::Sphere => Self::Sphere { center: DVec3::ZERO, radius: 1.0 },
            SolidKind::Box => Self::Box { center: DVec3::ZERO, half_size: DVec3::ONE, rotation_degrees: DVec3::ZERO },
            SolidKind::Cylinder => {
                Self::Cylinder { ends: [DVec3::new(1.0, 0.0, 1.0), DVec3::new(-1.0, 0.0, -1.0)], radius: 1.0 }
            }
            SolidKind::Cone => Self::Cone {
                apex: DVec3::ZERO,
                axis: DVec3::NEG_Y,
                height: 1.0,
                half_angle_degrees: COURSE_CONE_HALF_ANGLE_DEGREES,
            },
        }
    }
}

/// acos(0.9): the course's cone stores the cosine 0.9.
const COURSE_CONE_HALF_ANGLE_DEGREES: f64 = 25.841_932_763_167_13;
