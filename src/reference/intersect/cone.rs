use glam::DVec3;

use super::{Interval, RecentredLine};
use crate::reference::angle::sin_cos_degrees;
use crate::reference::double_double::{DoubleDouble, DoubleDouble3};
use crate::reference::ray::Face;

/// One nappe with its base disk, about its apex.
pub struct Cone {
    /// Unit vector from the apex to the base.
    axis: DoubleDouble3,
    height: DoubleDouble,
    /// Sine of the half-angle.
    sin: DoubleDouble,
    cos: DoubleDouble,
}

impl Cone {
    pub fn new(axis: DVec3, height: f64, half_angle_degrees: f64) -> Self {
        let (sin, cos) = sin_cos_degrees(half_angle_degrees);
        Self { axis: DoubleDouble3::from(axis).normalized(), height: height.into(), sin, cos }
    }

    pub fn base_radius(&self) -> f64 {
        (self.height * self.sin / self.cos).rounded()
    }

    /// The nappe cut by the slab between apex and base; a tie at the rim goes to the side.
    pub fn interval(&self, line: &RecentredLine) -> Option<Interval> {
        let along = line.closest.dot(self.axis);
        let along_slope = line.direction.dot(self.axis);
        let nappe = self.nappe(line, along, along_slope)?;
        let slab = Interval::between_planes(
            along,
            along_slope,
            (DoubleDouble::ZERO, Face::Curved),
            (self.height, Face::Base),
        )?;
        Some(nappe.intersection(slab))
    }

    /// a·s² + 2b·s + c ≤ 0: the double cone cos²α·ρ² ≤ sin²α·z² with ρ the distance from the axis, z along it.
    ///
    /// Where the line leaves the double cone between its nappes (a < 0) only the half-line on this nappe is returned.
    /// Where it stays on one nappe (a > 0) that may be the other one, which the slab then removes.
    fn nappe(&self, line: &RecentredLine, along: DoubleDouble, along_slope: DoubleDouble) -> Option<Interval> {
        let offset = line.closest - self.axis * along;
        let slope = line.direction - self.axis * along_slope;
        let (sin_squared, cos_squared) = (self.sin * self.sin, self.cos * self.cos);
        // Factored so that a line nearly parallel to the side keeps its few significant digits.
        let (across, down) = (self.cos * slope.length_squared().sqrt(), self.sin * along_slope.abs());
        let a = (across - down) * (across + down);
        let b = cos_squared * offset.dot(slope) - sin_squared * along * along_slope;
        let c = cos_squared * offset.length_squared() - sin_squared * along * along;
        let discriminant = self.quarter_discriminant(line);
        let ahead_is_down = along_slope > DoubleDouble::ZERO;
        let half_line = |root| {
            if ahead_is_down {
                Interval::new(root, Face::Curved, DoubleDouble::INFINITY, Face::Curved)
            } else {
                Interval::new(DoubleDouble::NEG_INFINITY, Face::Curved, root, Face::Curved)
            }
        };
        if a > DoubleDouble::ZERO {
            if discriminant < DoubleDouble::ZERO {
                return None;
            }
            let (low, high) = ordered_roots(a, b, c, discriminant.sqrt());
            return Some(Interval::new(low, Face::Curved, high, Face::Curved));
        }
        if a < DoubleDouble::ZERO {
            // The discriminant is a sum of squares here; only a line through the apex can round it below zero.
            let (low, high) = ordered_roots(a, b, c, discriminant.max(DoubleDouble::ZERO).sqrt());
            return Some(half_line(if ahead_is_down { high } else { low }));
        }
        // Parallel to the side: 2b·s + c ≤ 0, and b = −z·dz at the closest point, so that the sign of b shows whether
        // the line enters this nappe. b = 0 is the line through the apex, along the side itself.
        let enters_this_nappe = (b < DoubleDouble::ZERO) == ahead_is_down;
        if b == DoubleDouble::ZERO {
            (c == DoubleDouble::ZERO).then(|| half_line(DoubleDouble::ZERO))
        } else {
            enters_this_nappe.then(|| half_line(-c / (b + b)))
        }
    }

    /// b² − a·c = cos²α·(sin²α·|M|² − (M·axis)²) with M = closest × direction: no squares of b and c that would cancel.
    fn quarter_discriminant(&self, line: &RecentredLine) -> DoubleDouble {
        let moment = line.closest.cross(line.direction);
        let (reach, tilt) = (self.sin * moment.length_squared().sqrt(), moment.dot(self.axis).abs());
        self.cos * self.cos * (reach - tilt) * (reach + tilt)
    }

    pub fn depth(&self, point: DoubleDouble3) -> f64 {
        let along = point.dot(self.axis);
        let radial = (point - self.axis * along).length_squared().sqrt();
        // `along` counts only beyond the apex, where the side's lines come near.
        let to_side = (along * self.sin - radial * self.cos).rounded();
        to_side.min(along.rounded()).min((self.height - along).rounded())
    }

    /// How far a point is beyond the base's plane.
    pub fn beyond_base(&self, point: DoubleDouble3) -> DoubleDouble {
        point.dot(self.axis) - self.height
    }

    /// Outward unit normal at a point of the side; at the apex, where there is none, against the axis.
    pub fn side_normal(&self, point: DoubleDouble3) -> DVec3 {
        let radial = point - self.axis * point.dot(self.axis);
        if radial.length_squared() == DoubleDouble::ZERO {
            return -self.axis.rounded();
        }
        (radial.normalized() * self.cos - self.axis * self.sin).rounded()
    }

    /// Outward unit normal of the base.
    pub fn base_normal(&self) -> DVec3 {
        self.axis.rounded()
    }
}

/// Roots of a·s² + 2b·s + c, a ≠ 0, lower first, given the root of the quarter discriminant; the one that −b would
/// cancel in comes from the product of the roots, c/a.
fn ordered_roots(
    a: DoubleDouble,
    b: DoubleDouble,
    c: DoubleDouble,
    discriminant_root: DoubleDouble,
) -> (DoubleDouble, DoubleDouble) {
    let larger = if b > DoubleDouble::ZERO { -b - discriminant_root } else { -b + discriminant_root };
    let one = larger / a;
    let other = if larger == DoubleDouble::ZERO { one } else { c / larger };
    if one < other { (one, other) } else { (other, one) }
}
