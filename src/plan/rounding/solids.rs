//! The four solids as the `f32` kernel meets them (`glsl/whitted/meet.glsl`, `sphere.glsl` and so on).

use glam::{DMat3, DVec3, Vec3};

use super::line::{AxisLine, Face, Interval, Line, Ray, unit};
use super::sides::{F32Curve, along_and_across, between_ends, body, nappe, nearer_to_side};
use crate::plan::{Precision, solids};
use crate::scene::{BoxNearby, CylinderNearby, SceneSpace, Solid, SphereNearby, world_from_box};

/// Scene space. What the kernel has as a value and its error is `f64`.
#[derive(Debug, Clone)]
pub enum F32Solid {
    Sphere {
        center: Vec3,
        radius: f32,
    },
    SphereNearby {
        anchor: Vec3,
        radius: f32,
        curve: F32Curve,
    },
    /// `center`: in a close-up the anchor.
    Box {
        center: Vec3,
        low: Vec3,
        high: Vec3,
        axes: DMat3,
        is_close_up: bool,
    },
    Cylinder {
        center: DVec3,
        axis: DVec3,
        radius: f32,
        half_length: f32,
    },
    CylinderNearby {
        anchor: Vec3,
        axis: DVec3,
        radius: f32,
        low: f32,
        high: f32,
        reach: f32,
        curve: F32Curve,
    },
    Cone {
        apex: Vec3,
        axis: DVec3,
        height: f32,
        base_radius: f32,
        sine: f32,
        cosine: f32,
        is_close_up: bool,
    },
}

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
    /// Of the solid.
    pub size: f32,
    pub face: Face,
    pub inside: bool,
}

/// `SURFACE_ERROR` of the kernel: 8u.
pub const SURFACE_ERROR: f32 = 4.0 * f32::EPSILON;

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
    /// As the kernel's records have it.
    pub fn of(solid: &Solid, frame: &SceneSpace) -> Self {
        let scale = frame.scale;
        let length = |length: f64| (length * scale) as f32;
        match *solid {
            Solid::Sphere { center, radius } if frame.is_close_up => {
                let SphereNearby { anchor, curve } = SphereNearby::of(frame.point(center), radius * scale);
                Self::SphereNearby { anchor: anchor.as_vec3(), radius: length(radius), curve: F32Curve::of(curve) }
            }
            Solid::Sphere { center, radius } => {
                Self::Sphere { center: frame.point(center).as_vec3(), radius: length(radius) }
            }
            Solid::Box { center, half_size, rotation_degrees } => {
                let (center, half_size) = (frame.point(center), half_size * scale);
                let (axes, is_close_up) = (world_from_box(rotation_degrees), frame.is_close_up);
                let BoxNearby { anchor, low, high } = if is_close_up {
                    BoxNearby::of(center, half_size, axes)
                } else {
                    BoxNearby { anchor: center, low: -half_size, high: half_size }
                };
                let (center, low, high) = (anchor.as_vec3(), low.as_vec3(), high.as_vec3());
                Self::Box { center, low, high, axes, is_close_up }
            }
            Solid::Cylinder { ends: [a, b], radius } => {
                let (half_a, half_b) = (frame.point(a) * 0.5, frame.point(b) * 0.5);
                let half_axis = half_b - half_a;
                let (center, axis, half_length) = (half_a + half_b, solids::unit(half_axis), half_axis.length());
                if !frame.is_close_up {
                    return Self::Cylinder { center, axis, radius: length(radius), half_length: half_length as f32 };
                }
                let CylinderNearby { anchor, low, high, curve, reach } =
                    CylinderNearby::of(center, axis, radius * scale, half_length);
                let (anchor, curve) = (anchor.as_vec3(), F32Curve::of(curve));
                let [low, high, reach] = [low, high, reach].map(|length| length as f32);
                Self::CylinderNearby { anchor, axis, radius: length(radius), low, high, reach, curve }
            }
            Solid::Cone { apex, axis, height, half_angle_degrees } => {
                let (sine, cosine) = half_angle_degrees.to_radians().sin_cos();
                Self::Cone {
                    apex: frame.point(apex).as_vec3(),
                    axis: solids::unit(axis),
                    height: length(height),
                    base_radius: length(height * sine / cosine),
                    sine: sine as f32,
                    cosine: cosine as f32,
                    is_close_up: frame.is_close_up,
                }
            }
        }
    }

    pub fn size(&self) -> f32 {
        match *self {
            Self::Sphere { radius, .. } | Self::SphereNearby { radius, .. } => radius,
            Self::Box { high, .. } => high.max_element(),
            Self::Cylinder { radius, half_length, .. } => radius.max(half_length),
            Self::CylinderNearby { radius, low, high, .. } => radius.max(high - low),
            Self::Cone { height, base_radius, .. } => height.max(base_radius),
        }
    }

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

    /// Distance from a point inside to the surface, negative outside, and so many times what the point's place may be off:
    /// in a close-up by what it may be across each face.
    fn depth(&self, from_anchor: Vec3, place: f32, errors: f32) -> f32 {
        let error = errors * SURFACE_ERROR;
        let simply = error * (place + self.size());
        let nearby = from_anchor.abs().max_element();
        match *self {
            Self::Sphere { radius, .. } => radius - from_anchor.length() + simply,
            Self::SphereNearby { radius, curve, .. } => {
                curve.depth(from_anchor, radius) + error * (place + (nearby + curve.offset.abs()))
            }
            Self::Box { low, high, axes, is_close_up, .. } => {
                let axes = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.as_vec3());
                let in_axes = Vec3::from_array(axes.map(|axis| axis.dot(from_anchor)));
                if !is_close_up {
                    return (high - in_axes.abs()).min_element() + simply;
                }
                let across = Vec3::from_array(axes.map(|axis| axis.abs().dot(from_anchor.abs()))) + place;
                let above_low = in_axes - low + error * (across + low.abs());
                let below_high = high - in_axes + error * (across + high.abs());
                above_low.min(below_high).min_element()
            }
            Self::Cylinder { axis, radius, half_length, .. } => {
                let (along, radial) = along_and_across(from_anchor, axis);
                (radius - radial.length()).min(half_length - along.abs()) + simply
            }
            Self::CylinderNearby { axis, radius, low, high, curve, .. } => {
                let (along, radial) = along_and_across(from_anchor, axis);
                let across = place + axis.as_vec3().abs().dot(from_anchor.abs());
                let above_low = along - low + error * (across + low.abs());
                let below_high = high - along + error * (across + high.abs());
                let body_error = error * (place + (radial.abs().max_element() + curve.offset.abs()));
                (curve.depth(radial, radius) + body_error).min(above_low.min(below_high))
            }
            Self::Cone { axis, height, sine, cosine, is_close_up, .. } => {
                let (along, radial) = along_and_across(from_anchor, axis);
                let depth = (along * sine - radial.length() * cosine).min(along.min(height - along));
                depth + if is_close_up { error * (place + nearby) } else { simply }
            }
        }
    }

    /// What the rounding of a hit goes by: the solid's size, in a close-up the way from the anchor.
    fn size_at(&self, point: Vec3) -> f32 {
        match *self {
            Self::SphereNearby { anchor, .. }
            | Self::Box { center: anchor, is_close_up: true, .. }
            | Self::CylinderNearby { anchor, .. }
            | Self::Cone { apex: anchor, is_close_up: true, .. } => (point - anchor).abs().max_element(),
            Self::Sphere { .. } | Self::Box { .. } | Self::Cylinder { .. } | Self::Cone { .. } => self.size(),
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

/// Whether the kernel has it: below that, squares leave the range of `f32`.
pub fn is_large_enough(radius: f64, frame: &SceneSpace) -> bool {
    radius * frame.scale >= Precision::F32.smallest_length()
}
