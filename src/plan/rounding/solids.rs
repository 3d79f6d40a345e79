//! The four solids in the numbers of the `f32` kernel (`glsl/records/scene.glsl`), and how deep a point is in them.

use glam::{DMat3, DVec3, Vec3};

use super::sides::{F32Curve, along_and_across};
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

/// `SURFACE_ERROR` of the kernel: 8u.
pub const SURFACE_ERROR: f32 = 4.0 * f32::EPSILON;

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

    /// Distance from a point inside to the surface, negative outside, and so many times what the point's position may
    /// be off: in a close-up by what it may be across each face.
    pub fn depth(&self, from_anchor: Vec3, place: f32, errors: f32) -> f32 {
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

    /// What the rounding of a hit scales with: the solid's size, in a close-up the way from the anchor.
    pub fn size_at(&self, point: Vec3) -> f32 {
        match *self {
            Self::SphereNearby { anchor, .. }
            | Self::Box { center: anchor, is_close_up: true, .. }
            | Self::CylinderNearby { anchor, .. }
            | Self::Cone { apex: anchor, is_close_up: true, .. } => (point - anchor).abs().max_element(),
            Self::Sphere { .. } | Self::Box { .. } | Self::Cylinder { .. } | Self::Cone { .. } => self.size(),
        }
    }
}

/// Whether the kernel has it: below that, squares leave the range of `f32`.
pub fn is_large_enough(radius: f64, frame: &SceneSpace) -> bool {
    radius * frame.scale >= Precision::F32.smallest_length()
}
