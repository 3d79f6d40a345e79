//! Where the `f32` kernel's rays meet its solids (`glsl/solids/meet.glsl`, `sphere.glsl` and so on).

use glam::Vec3;

use super::line::{AxisLine, Face, Interval, Line, Ray, unit};
use super::sides::{between_ends, body, nappe, nearer_to_side};
use super::solids::F32Solid;

/// What a ray's origin is to a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A point as stored.
    Free,
    /// A rounded point of another solid's surface.
    OtherSurface,
    /// A rounded point of this solid's surface, left inwards.
    OwnInside(Face),
}

#[derive(Debug, Clone, Copy)]
pub struct F32Hit {
    pub t: f32,
    pub point: Vec3,
    /// Unit, towards the side the ray came from.
    pub normal: Vec3,
    /// Size of the solid.
    pub size: f32,
    pub face: Face,
    pub inside: bool,
}

enum Met {
    Plain(Line),
    AboutAxis(AxisLine),
}

impl Met {
    fn line(&self) -> &Line {
        match self {
            Self::Plain(line) | Self::AboutAxis(AxisLine { line, .. }) => line,
        }
    }
}

impl F32Solid {
    fn meet_line(&self, ray: &Ray) -> Met {
        match *self {
            Self::Sphere { center: anchor, .. }
            | Self::SphereNearby { anchor, .. }
            | Self::Box { center: anchor, .. } => Met::Plain(Line::about(ray, anchor.as_dvec3())),
            Self::CylinderNearby { anchor, axis, reach, .. } => {
                Met::AboutAxis(AxisLine::about(Line::about(ray, anchor.as_dvec3()), axis, reach))
            }
            Self::Cylinder { center, axis, radius, half_length } => {
                Met::AboutAxis(AxisLine::about(Line::about(ray, center), axis, radius.hypot(half_length)))
            }
            Self::Cone { apex, axis, height, base_radius, .. } => {
                Met::AboutAxis(AxisLine::about(Line::about(ray, apex.as_dvec3()), axis, height.hypot(base_radius)))
            }
        }
    }

    /// The first point ahead of the ray's origin, if there is one.
    pub fn meet(&self, ray: &Ray, origin: Origin) -> Option<F32Hit> {
        let at = self.meet_line(ray);
        let interval = self.interval(&at);
        let (is_met, line) = (interval.is_met(), at.line());
        let place = if origin == Origin::Free { 0.0 } else { ray.origin.abs().max_element() as f32 };
        let is_own = matches!(origin, Origin::OwnInside(_));
        let inside = is_own || self.depth(line.origin, place, 1.0) >= 0.0;
        let mut s = if inside { interval.far } else { interval.near };
        let mut t = line.t_at(s);
        let mut face = if inside { interval.far_face } else { interval.near_face };
        let mut is_ahead = is_met && t > 0.0;
        if inside && !is_own {
            let errors = if origin == Origin::Free { -0.25 } else { -1.0 };
            let start = interval.near.max(-line.start());
            let middle = line.closest.as_vec3() + (0.5 * (start + interval.far)) * line.direction;
            is_ahead = is_ahead && self.depth(middle, place, errors) > 0.0;
        }
        let leaves_here = is_own && !is_ahead;
        if leaves_here {
            t = 0.0;
            s = -line.start();
            if let Origin::OwnInside(own) = origin
                && !is_met
            {
                face = own;
            }
        }
        if !(is_ahead || leaves_here) {
            return None;
        }
        let (point, normal) = self.surface(&at, s, face);
        let point = if leaves_here { ray.origin.as_vec3() } else { point };
        let normal = if inside { -normal } else { normal };
        Some(F32Hit { t, point, normal, size: self.size_at(point), face, inside })
    }

    fn interval(&self, at: &Met) -> Interval {
        match (self, at) {
            (&Self::Sphere { radius, .. }, Met::Plain(line)) => {
                let value = line.closest.as_vec3();
                let error = (line.closest - value.as_dvec3()).as_vec3();
                let half_chord_squared = radius * radius - (value.dot(value) + 2.0 * value.dot(error));
                if half_chord_squared < 0.0 {
                    return Interval::EMPTY;
                }
                let s = (half_chord_squared / line.direction_squared).sqrt();
                Interval::curved(-s, s)
            }
            (&Self::SphereNearby { radius, curve, .. }, Met::Plain(line)) => {
                curve.interval(line.closest, line.direction, radius)
            }
            (&Self::Box { low, high, axes, .. }, Met::Plain(line)) => {
                let slab = |axis: usize| {
                    let across = axes.col(axis);
                    let offset = across.dot(line.closest) as f32;
                    let slope = across.dot(line.direction.as_dvec3()) as f32;
                    let face = |positive| Face::Slab { axis, positive };
                    Interval::between_planes(offset, slope, (low[axis], face(false)), (high[axis], face(true)))
                };
                slab(0).intersection(slab(1)).intersection(slab(2))
            }
            (&Self::Cylinder { axis, radius, half_length, .. }, Met::AboutAxis(at)) => {
                between_ends(body(at, radius), at, axis, [-half_length, half_length])
            }
            (&Self::CylinderNearby { axis, radius, low, high, curve, .. }, Met::AboutAxis(at)) => {
                between_ends(curve.interval(at.offset.as_dvec3(), at.slope, radius), at, axis, [low, high])
            }
            (&Self::Cone { axis, height, sine, cosine, .. }, Met::AboutAxis(at)) => {
                let slab =
                    Interval::between_planes(at.along, at.along_slope, (0.0, Face::Curved), (height, Face::Base));
                let side = nappe(at, sine, cosine);
                let mut inside = side.intersection(slab);
                if !inside.is_met() {
                    return Interval::EMPTY;
                }
                let length = side.far - side.near;
                let nearer = |face: Face, s: f32| match face {
                    Face::Base => at.nearer_to_plane(axis, height, s),
                    _ => nearer_to_side(at, axis, sine, cosine, s, length),
                };
                inside.near = nearer(inside.near_face, inside.near);
                inside.far = nearer(inside.far_face, inside.far);
                inside
            }
            // A line is made for its solid.
            _ => Interval::EMPTY,
        }
    }

    /// Point and outward unit normal of a face, scene space.
    fn surface(&self, at: &Met, s: f32, face: Face) -> (Vec3, Vec3) {
        match (self, at) {
            (&Self::Sphere { center, radius }, Met::Plain(line)) => {
                let normal = unit(line.at(s));
                (center + radius * normal, normal)
            }
            (&Self::SphereNearby { anchor, radius, curve }, Met::Plain(line)) => {
                let from_anchor = line.at(s);
                let normal = unit(curve.slope.as_vec3() + from_anchor / radius);
                (anchor + (from_anchor + curve.depth(from_anchor, radius) * normal), normal)
            }
            (&Self::Box { center, low, high, axes, .. }, Met::Plain(line)) => {
                let (axis, positive) = match face {
                    Face::Slab { axis, positive } => (axis, positive),
                    _ => (0, true),
                };
                let across = axes.col(axis).as_vec3();
                let normal = if positive { across } else { -across };
                let from_center = line.at(s);
                let above = if positive { high[axis] } else { -low[axis] } - normal.dot(from_center);
                (center + (from_center + above * normal), normal)
            }
            (&Self::Cylinder { center, axis, radius, half_length }, Met::AboutAxis(at)) => {
                let (rounded_axis, rounded_center) = (axis.as_vec3(), center.as_vec3());
                let axis_error = (axis - rounded_axis.as_dvec3()).as_vec3();
                let center_error = (center - rounded_center.as_dvec3()).as_vec3();
                let (mut radial, mut along) = (at.radial_at(s), at.along_at(s));
                let normal = match face {
                    Face::End { positive } => {
                        along = if positive { half_length } else { -half_length };
                        if positive { rounded_axis } else { -rounded_axis }
                    }
                    _ => {
                        let normal = unit(radial);
                        radial = radius * normal;
                        normal
                    }
                };
                let from_center = along * rounded_axis + (radial + (along * axis_error + center_error));
                (rounded_center + from_center, normal)
            }
            (&Self::CylinderNearby { anchor, axis, radius, low, high, curve, .. }, Met::AboutAxis(at)) => {
                let rounded_axis = axis.as_vec3();
                let axis_error = (axis - rounded_axis.as_dvec3()).as_vec3();
                let (mut radial, mut along) = (at.radial_at(s), at.along_at(s));
                let normal = match face {
                    Face::End { positive } => {
                        along = if positive { high } else { low };
                        if positive { rounded_axis } else { -rounded_axis }
                    }
                    _ => {
                        let normal = unit(curve.slope.as_vec3() + radial / radius);
                        radial += curve.depth(radial, radius) * normal;
                        normal
                    }
                };
                (anchor + (along * rounded_axis + (radial + along * axis_error)), normal)
            }
            (&Self::Cone { apex, axis, height, sine, cosine, .. }, Met::AboutAxis(at)) => {
                let rounded_axis = axis.as_vec3();
                let axis_error = (axis - rounded_axis.as_dvec3()).as_vec3();
                let (mut radial, mut along) = (at.radial_at(s), at.along_at(s));
                let distance = radial.length();
                let normal = if face == Face::Base {
                    along = height;
                    rounded_axis
                } else if distance > 0.0 {
                    let above = cosine * distance - sine * along;
                    let normal = cosine * (radial / distance) - sine * rounded_axis;
                    along += above * sine;
                    radial -= (above * cosine / distance) * radial;
                    normal
                } else {
                    -rounded_axis
                };
                (apex + (along * rounded_axis + (radial + along * axis_error)), normal)
            }
            _ => (Vec3::NAN, Vec3::NAN),
        }
    }
}
