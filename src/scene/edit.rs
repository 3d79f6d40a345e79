//! The edits of the course work: add, move, rotate. An edit does not check its numbers; [`Scene::validate`] does.

use glam::{DMat3, DVec3};

use super::validate::unit;
use super::{Primitive, Scene, Solid, SolidKind};

/// Most primitives that the course's kernel and its panel take.
pub const COURSE_PRIMITIVE_LIMIT: usize = 100;

/// A scene is full.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the scene already holds {limit} primitives, the most allowed here")]
pub struct TooManyPrimitives {
    /// What the caller allows, which may be less than [`PRIMITIVE_LIMIT`](super::PRIMITIVE_LIMIT).
    pub limit: usize,
}

impl Scene {
    /// Appends the course's default solid of this kind at the origin and returns its index; a scene that already holds
    /// `limit` primitives is left as it was.
    pub fn add(&mut self, kind: SolidKind, limit: usize) -> Result<usize, TooManyPrimitives> {
        if self.primitives.len() >= limit {
            return Err(TooManyPrimitives { limit });
        }
        self.primitives.push(Primitive::course_default(kind));
        Ok(self.primitives.len() - 1)
    }
}

impl Solid {
    /// The point that [`Solid::move_to`] moves: centre of a sphere or box, apex of a cone, midpoint of a cylinder's
    /// axis.
    pub fn position(&self) -> DVec3 {
        match self {
            Self::Sphere { center, .. } | Self::Box { center, .. } => *center,
            Self::Cylinder { ends, .. } => ends[0].midpoint(ends[1]),
            Self::Cone { apex, .. } => *apex,
        }
    }

    /// Moves [`Solid::position`] to `target` (world frame) without turning the solid.
    pub fn move_to(&mut self, target: DVec3) {
        match self {
            Self::Sphere { center, .. } | Self::Box { center, .. } => *center = target,
            Self::Cylinder { ends, .. } => {
                let half_axis = half_axis(ends);
                *ends = [target - half_axis, target + half_axis];
            }
            Self::Cone { apex, .. } => *apex = target,
        }
    }

    /// Turns by (a, b, c) degrees, the course's «Повернуть»: a box takes the angles as its pose; a cylinder is turned
    /// about its midpoint and a cone about its apex, on from where they are, by p ↦ Rz(−c)·Ry(−b)·Rx(−a)·p.
    pub fn rotate(&mut self, degrees: DVec3) {
        let turn = rotation_z(-degrees.z) * rotation_y(-degrees.y) * rotation_x(-degrees.x);
        match self {
            Self::Sphere { .. } => {}
            Self::Box { rotation_degrees, .. } => *rotation_degrees = degrees,
            Self::Cylinder { ends, .. } => {
                let middle = ends[0].midpoint(ends[1]);
                let half_axis = turn * half_axis(ends);
                *ends = [middle - half_axis, middle + half_axis];
            }
            // Lest the errors of many turns add up in the length.
            Self::Cone { axis, .. } => *axis = unit(turn * *axis),
        }
    }
}

/// The local→world rotation Rx(−a)·Ry(−b)·Rz(−c) of a box with `rotation_degrees` (a, b, c); world→local is its
/// transpose.
pub fn world_from_box(rotation_degrees: DVec3) -> DMat3 {
    rotation_x(-rotation_degrees.x) * rotation_y(-rotation_degrees.y) * rotation_z(-rotation_degrees.z)
}

/// The `rotation_degrees` of a box from its local→world rotation: what [`world_from_box`] makes that of, to rounding.
pub(crate) fn rotation_of(world_from_box: &DMat3) -> DVec3 {
    let [x, y, z] = [world_from_box.x_axis, world_from_box.y_axis, world_from_box.z_axis];
    // The first row of Rx(α)·Ry(β)·Rz(γ) is (cosβ·cosγ, −cosβ·sinγ, sinβ).
    let beta = z.x.atan2(x.x.hypot(y.x));
    let gamma = (-y.x).atan2(x.x);
    // With Rz(γ) taken off, the second column is (0, cosα, sinα). Near β = ±90°, where γ is mostly rounding, that makes
    // up for it: there both turn about one axis.
    let (sin, cos) = gamma.sin_cos();
    let second = x * sin + y * cos;
    let alpha = second.z.atan2(second.y);
    -DVec3::new(alpha, beta, gamma).map(f64::to_degrees)
}

/// From a cylinder's midpoint to its second end.
fn half_axis(ends: &[DVec3; 2]) -> DVec3 {
    (ends[1] - ends[0]) * 0.5
}

fn rotation_x(degrees: f64) -> DMat3 {
    let (sin, cos) = sin_cos(degrees);
    DMat3::from_cols(DVec3::X, DVec3::new(0.0, cos, sin), DVec3::new(0.0, -sin, cos))
}

fn rotation_y(degrees: f64) -> DMat3 {
    let (sin, cos) = sin_cos(degrees);
    DMat3::from_cols(DVec3::new(cos, 0.0, -sin), DVec3::Y, DVec3::new(sin, 0.0, cos))
}

fn rotation_z(degrees: f64) -> DMat3 {
    let (sin, cos) = sin_cos(degrees);
    DMat3::from_cols(DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0), DVec3::Z)
}

/// Sine and cosine, exact at quarter turns; whole turns are taken off without rounding first.
fn sin_cos(degrees: f64) -> (f64, f64) {
    let degrees = degrees % 360.0;
    let quarters = (degrees / 90.0).round();
    // Exact by Sterbenz's lemma: the two are within a factor of 2 of each other, or nothing is subtracted.
    let (sin, cos) = (degrees - quarters * 90.0).to_radians().sin_cos();
    match quarters.rem_euclid(4.0) {
        1.0 => (cos, -sin),
        2.0 => (-sin, -cos),
        3.0 => (-cos, sin),
        _ => (sin, cos),
    }
}
