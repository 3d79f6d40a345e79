//! Lines and intervals of the `f32` kernel (`glsl/solids/ray.glsl`, `axis.glsl`), rounded where it rounds.
//!
//! What the kernel keeps as a value and its error, 48 bits in all, is one `f64` here.

use glam::{DVec3, Vec3};

/// Scene space.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Camera position good to 48 bits, else a point of `f32`.
    pub origin: DVec3,
    /// Unit, to a few units in the last place.
    pub direction: Vec3,
}

/// Which part of a solid's surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    Curved,
    /// Face of a box.
    Slab {
        axis: usize,
        positive: bool,
    },
    /// End of a cylinder: the second, or the first.
    End {
        positive: bool,
    },
    /// Base of a cone.
    Base,
}

/// A ray's line about its point closest to a solid's anchor.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Origin of the ray, from the anchor.
    pub origin: Vec3,
    pub closest: DVec3,
    pub direction: Vec3,
    pub direction_squared: f32,
    /// The ray's parameter at the closest point.
    pub t_closest: f64,
}

impl Line {
    pub fn about(ray: &Ray, anchor: DVec3) -> Self {
        let (direction, exact_direction) = (ray.direction, ray.direction.as_dvec3());
        let direction_squared = direction.dot(direction);
        let origin = ray.origin - anchor;
        let to_closest = |place: DVec3| -place.as_vec3().dot(direction) / direction_squared;
        let first = to_closest(origin);
        let near = origin + f64::from(first) * exact_direction;
        let second = to_closest(near);
        Self {
            origin: origin.as_vec3(),
            closest: near + f64::from(second) * exact_direction,
            direction,
            direction_squared,
            t_closest: f64::from(first) + f64::from(second),
        }
    }

    pub fn t_at(&self, s: f32) -> f32 {
        (self.t_closest + f64::from(s)) as f32
    }

    /// How far the closest point is ahead of the ray's origin.
    pub fn start(&self) -> f32 {
        self.t_closest as f32
    }

    /// From the anchor.
    pub fn at(&self, s: f32) -> Vec3 {
        let value = self.closest.as_vec3();
        value + ((self.closest - value.as_dvec3()).as_vec3() + s * self.direction)
    }
}

/// A line about its point nearest to an axis through the anchor.
#[derive(Debug, Clone, Copy)]
pub struct AxisLine {
    pub line: Line,
    pub along: f32,
    pub along_slope: f32,
    pub offset: Vec3,
    pub slope: Vec3,
    pub slope_squared: f32,
    pub moment: f32,
}

impl AxisLine {
    pub fn about(line: Line, axis: DVec3, reach: f32) -> Self {
        let rounded_axis = axis.as_vec3();
        let across = |vector: DVec3| {
            let vector = vector.as_vec3();
            vector - rounded_axis * rounded_axis.dot(vector)
        };
        let direction = line.direction.as_dvec3();
        let along_slope = axis.dot(direction) as f32;
        let slope = across(direction - f64::from(along_slope) * axis);
        let slope_squared = slope.dot(slope);
        let unlimited = -line.closest.as_vec3().dot(slope) / slope_squared;
        let s = if slope_squared > 0.0 { unlimited.clamp(-reach, reach) } else { 0.0 };
        let nearest = line.closest + f64::from(s) * direction;
        let along = axis.dot(nearest) as f32;
        let offset = across(nearest - f64::from(along) * axis);
        let line = Line { closest: nearest, t_closest: line.t_closest + f64::from(s), ..line };
        let moment = rounded_axis.dot(offset.cross(slope));
        Self { line, along, along_slope, offset, slope, slope_squared, moment }
    }

    /// From the axis, perpendicular to it.
    pub fn radial_at(&self, s: f32) -> Vec3 {
        self.offset + s * self.slope
    }

    pub fn along_at(&self, s: f32) -> f32 {
        self.along + s * self.along_slope
    }

    /// The coordinate on the axis, rounded once.
    pub fn exact_along_at(&self, axis: DVec3, s: f32) -> f32 {
        axis.dot(self.line.closest + f64::from(s) * self.line.direction.as_dvec3()) as f32
    }

    /// One step of Newton's towards a plane across the axis.
    pub fn nearer_to_plane(&self, axis: DVec3, plane: f32, s: f32) -> f32 {
        s - (self.exact_along_at(axis, s) - plane) / self.along_slope
    }
}

/// Where a line is inside a solid; empty where near > far.
#[derive(Debug, Clone, Copy)]
pub struct Interval {
    pub near: f32,
    pub far: f32,
    pub near_face: Face,
    pub far_face: Face,
}

impl Interval {
    pub const EMPTY: Self = Self::curved(1.0, -1.0);
    pub const WHOLE_LINE: Self = Self::curved(-f32::MAX, f32::MAX);

    pub const fn curved(near: f32, far: f32) -> Self {
        Self { near, far, near_face: Face::Curved, far_face: Face::Curved }
    }

    pub fn is_met(&self) -> bool {
        self.near <= self.far
    }

    /// The part inside both; at a tie `self` gives the face.
    pub fn intersection(self, other: Self) -> Self {
        let (near, near_face) =
            if other.near > self.near { (other.near, other.near_face) } else { (self.near, self.near_face) };
        let (far, far_face) =
            if other.far < self.far { (other.far, other.far_face) } else { (self.far, self.far_face) };
        Self { near, far, near_face, far_face }
    }

    pub fn between_planes(
        offset: f32,
        slope: f32,
        (low, low_face): (f32, Face),
        (high, high_face): (f32, Face),
    ) -> Self {
        if slope == 0.0 {
            return if low <= offset && offset <= high { Self::WHOLE_LINE } else { Self::EMPTY };
        }
        let (near, near_face, far, far_face) =
            if slope > 0.0 { (low, low_face, high, high_face) } else { (high, high_face, low, low_face) };
        Self { near: (near - offset) / slope, far: (far - offset) / slope, near_face, far_face }
    }
}

/// Roots of a·s² + 2·b·s + c, given the root of b² − a·c.
pub fn ordered_roots(a: f32, b: f32, c: f32, c_scale: f32, discriminant_root: f32) -> (f32, f32) {
    let sign = if b > 0.0 { 1.0 } else { -1.0 };
    let (larger, smaller) = (-b - sign * discriminant_root, -b + sign * discriminant_root);
    let one = larger / a;
    let is_direct = (b * larger).abs() <= a.abs() * c_scale;
    let other = if is_direct { smaller / a } else { c / larger };
    (one.min(other), one.max(other))
}

pub fn unit(vector: Vec3) -> Vec3 {
    vector / vector.length()
}
