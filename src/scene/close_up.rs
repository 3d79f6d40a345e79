//! Solids as a close-up has them: relative to an anchor, which is where they are nearest to the camera.
//!
//! A solid much larger than the way to the camera is given relative to its centre by numbers whose rounding alone is
//! more than that way. From an anchor nearby, a sphere's surface is offset + slope·x + |x|²/(2·radius) = 0, whose terms
//! are all as small as x; and so is a cylinder's, across its axis.
//!
//! Scene space, the camera at its origin. Anchors are points in `f32`, so that rounding takes nothing from them; the
//! rest is computed for them in `f64`.

use glam::{DMat3, DVec3};

/// A round surface about an anchor.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Curve {
    /// From the centre, or from the axis, to the anchor, in radii.
    pub slope: DVec3,
    /// Half of what |slope|² is more than 1, in lengths.
    pub offset: f64,
}

impl Curve {
    fn of(from_center: DVec3, radius: f64) -> Self {
        let distance = from_center.length();
        // |from_center|² − radius², factored: its first factor is exact where the two are near each other.
        Self { slope: from_center / radius, offset: (distance - radius) * ((distance + radius) / (2.0 * radius)) }
    }
}

/// A sphere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SphereNearby {
    pub anchor: DVec3,
    pub curve: Curve,
}

impl SphereNearby {
    pub fn of(center: DVec3, radius: f64) -> Self {
        let distance = center.length();
        let outward = if distance > 0.0 { -center / distance } else { DVec3::Y };
        // By the height of the surface, which is exact where it is small.
        let anchor = in_f32(outward * (radius - distance));
        Self { anchor, curve: Curve::of(anchor - center, radius) }
    }
}

/// A box between planes across its axes, given by their positions from the anchor.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoxNearby {
    pub anchor: DVec3,
    pub low: DVec3,
    pub high: DVec3,
}

impl BoxNearby {
    /// `axes`: from the box's own frame to the kernel's.
    pub fn of(center: DVec3, half_size: DVec3, axes: DMat3) -> Self {
        let nearest = (axes.transpose() * -center).clamp(-half_size, half_size);
        let anchor = in_f32(center + axes * nearest);
        let from_center = axes.transpose() * (anchor - center);
        Self { anchor, low: -half_size - from_center, high: half_size - from_center }
    }
}

/// A cylinder between its ends, given by their positions along the axis from the anchor.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CylinderNearby {
    pub anchor: DVec3,
    pub low: f64,
    pub high: f64,
    /// Across the axis.
    pub curve: Curve,
    /// No point of the cylinder is farther than that from the anchor.
    pub reach: f64,
}

impl CylinderNearby {
    /// `axis`: unit.
    pub fn of(center: DVec3, axis: DVec3, radius: f64, half_length: f64) -> Self {
        let along = -center.dot(axis);
        let across = -center - along * axis;
        let distance = across.length();
        let nearest = if distance > radius { across * (radius / distance) } else { across };
        let anchor = in_f32(center + along.clamp(-half_length, half_length) * axis + nearest);
        let from_center = anchor - center;
        let place = from_center.dot(axis);
        let (low, high) = (-half_length - place, half_length - place);
        let curve = Curve::of(from_center - place * axis, radius);
        Self { anchor, low, high, curve, reach: (2.0 * radius).hypot(high.max(-low)) }
    }
}

fn in_f32(point: DVec3) -> DVec3 {
    point.as_vec3().as_dvec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn height(curve: Curve, x: DVec3, radius: f64) -> f64 {
        curve.offset + curve.slope.dot(x) + x.length_squared() / (2.0 * radius)
    }

    #[test]
    fn a_sphere_is_told_from_its_point_nearest_to_the_camera() {
        let radius = 0.75;
        for (center, distance) in
            [(DVec3::Y * -0.7500001, 1e-7), (DVec3::new(0.4, 0.3, 0.0), 0.25), (DVec3::ZERO, 0.75)]
        {
            let SphereNearby { anchor, curve } = SphereNearby::of(center, radius);
            assert!((anchor.length() - distance).abs() < 1e-6, "{center}: {anchor}");
            // Straight up from the anchor, by what the surface is off it and then by 1e-8.
            let outward = (anchor - center).normalize();
            let on_surface = outward * (radius - (anchor - center).length());
            assert!(height(curve, on_surface, radius).abs() < 1e-15);
            let above = height(curve, on_surface + outward * 1e-8, radius);
            assert!((above - 1e-8).abs() < 1e-14, "{center}: {above}");
        }
    }

    #[test]
    fn a_box_and_a_cylinder_keep_their_faces() {
        let (center, half_size) = (DVec3::new(0.3, -0.5, 0.0), DVec3::new(1.0, 0.5, 0.7));
        let BoxNearby { anchor, low, high } = BoxNearby::of(center, half_size, DMat3::IDENTITY);
        assert_eq!(anchor, DVec3::ZERO);
        assert!((anchor + low - (center - half_size)).abs().max_element() < 1e-15);
        assert!((anchor + high - (center + half_size)).abs().max_element() < 1e-15);

        let nearby = CylinderNearby::of(center, DVec3::Y, 1.0, 0.5);
        let CylinderNearby { anchor, low, high, curve, reach } = nearby;
        assert_eq!((anchor, low, high), (DVec3::ZERO, -1.0, 0.0));
        // On the body, 0.3 from the axis to one side and 1 to the other.
        assert!(height(curve, DVec3::X * 1.3, 1.0).abs() < 1e-15 && height(curve, DVec3::X * -0.7, 1.0).abs() < 1e-15);
        assert!(reach >= DVec3::new(1.3, 1.0, 0.0).length());
    }
}
