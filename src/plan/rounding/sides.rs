//! Where a line is inside a cylinder's or a cone's side, or a round surface of a close-up, as the `f32` kernel computes
//! it (`glsl/solids/cylinder.glsl`, `cone.glsl`, `sphere.glsl`).

use glam::{DVec3, Vec3};

use super::line::{AxisLine, Face, Interval, ordered_roots};
use crate::scene::Curve;

/// A round surface of a close-up.
#[derive(Debug, Clone, Copy)]
pub struct F32Curve {
    pub slope: DVec3,
    pub offset: f32,
}

impl F32Curve {
    pub fn of(curve: Curve) -> Self {
        Self { slope: curve.slope, offset: curve.offset as f32 }
    }

    /// From `x`, seen from the anchor: about the height over the surface, where that is small.
    fn height(self, x: DVec3, radius: f32) -> f32 {
        let rounded = x.as_vec3();
        self.slope.dot(x) as f32 + (self.offset + rounded.dot(rounded) / (2.0 * radius))
    }

    pub fn depth(self, x: Vec3, radius: f32) -> f32 {
        let from_center = radius * self.slope.as_vec3() + x;
        -2.0 * radius * self.height(x.as_dvec3(), radius) / (radius + from_center.length())
    }

    /// Where the line x + s·direction is inside.
    pub fn interval(self, x: DVec3, direction: Vec3, radius: f32) -> Interval {
        let a = direction.dot(direction) / (2.0 * radius);
        let b = 0.5 * (self.slope.dot(direction.as_dvec3()) as f32 + x.as_vec3().dot(direction) / radius);
        let c = self.height(x, radius);
        if a == 0.0 {
            return if c <= 0.0 { Interval::WHOLE_LINE } else { Interval::EMPTY };
        }
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return Interval::EMPTY;
        }
        let (low, high) = ordered_roots(a, b, c, 0.0, discriminant.sqrt());
        Interval::curved(low, high)
    }
}

/// A cylinder's body cut by its ends, whose positions along the axis are `low` and `high`.
pub fn between_ends(body: Interval, at: &AxisLine, axis: DVec3, [low, high]: [f32; 2]) -> Interval {
    let end = |positive| Face::End { positive };
    let slab = Interval::between_planes(at.along, at.along_slope, (low, end(false)), (high, end(true)));
    let mut inside = body.intersection(slab);
    let to_base = |face: Face, s: f32| match face {
        Face::End { positive } => at.nearer_to_plane(axis, if positive { high } else { low }, s),
        _ => s,
    };
    inside.near = to_base(inside.near_face, inside.near);
    inside.far = to_base(inside.far_face, inside.far);
    inside
}

/// Interval of a cylinder, without its ends.
pub fn body(at: &AxisLine, radius: f32) -> Interval {
    let b = at.offset.dot(at.slope);
    let distance = at.offset.length();
    if at.slope_squared == 0.0 {
        return if distance <= radius { Interval::WHOLE_LINE } else { Interval::EMPTY };
    }
    let c = (distance - radius) * (distance + radius);
    let reach = radius * at.slope_squared.sqrt();
    let moment = at.moment.abs();
    let discriminant = (reach - moment) * (reach + moment);
    if discriminant < 0.0 {
        return Interval::EMPTY;
    }
    let (low, high) = ordered_roots(at.slope_squared, b, c, radius * radius, discriminant.sqrt());
    Interval::curved(low, high)
}

/// Interval of a cone, without its base.
pub fn nappe(at: &AxisLine, sine: f32, cosine: f32) -> Interval {
    let difference = |x: f32, y: f32| (cosine * x - sine * y) * (cosine * x + sine * y);
    let (offset, along) = (at.offset, at.along);
    let (slope_length, offset_length) = (at.slope_squared.sqrt(), offset.length());
    let a = difference(slope_length, at.along_slope.abs());
    let c = difference(offset_length, along.abs());
    let b = cosine * cosine * offset.dot(at.slope) - sine * sine * along * at.along_slope;
    let turn_length = (along * at.slope - at.along_slope * offset).length();
    let discriminant = -cosine * cosine * difference(at.moment.abs(), turn_length);
    let ahead_is_down = at.along_slope > 0.0;
    let (low, high) = if a == 0.0 {
        let enters = if b != 0.0 { (b < 0.0) == ahead_is_down } else { c == 0.0 };
        if !enters {
            return Interval::EMPTY;
        }
        let root = if b != 0.0 { -c / (b + b) } else { 0.0 };
        (root, root)
    } else {
        if a > 0.0 && discriminant < 0.0 {
            return Interval::EMPTY;
        }
        let to_side = (cosine * offset_length).max(sine * along.abs());
        ordered_roots(a, b, c, to_side * to_side, discriminant.max(0.0).sqrt())
    };
    match (a > 0.0, ahead_is_down) {
        (true, _) => Interval::curved(low, high),
        (false, true) => Interval::curved(high, f32::MAX),
        (false, false) => Interval::curved(-f32::MAX, low),
    }
}

/// One step of Newton's towards a cone's side.
pub fn nearer_to_side(at: &AxisLine, axis: DVec3, sine: f32, cosine: f32, s: f32, length: f32) -> f32 {
    let radial = at.radial_at(s);
    let distance = radial.length();
    let above = cosine * distance - sine * at.exact_along_at(axis, s);
    let change = cosine * (radial.dot(at.slope) / distance) - sine * at.along_slope;
    if above.abs() < change.abs() * (0.0625 * length) { s - above / change } else { s }
}

/// A vector's part along an axis, and what is across it.
pub fn along_and_across(from_anchor: Vec3, axis: DVec3) -> (f32, Vec3) {
    let axis = axis.as_vec3();
    let along = from_anchor.dot(axis);
    (along, from_anchor - along * axis)
}
