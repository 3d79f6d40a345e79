use glam::DVec3;

use super::{Interval, RecentredLine};
use crate::reference::double_double::{DoubleDouble, DoubleDouble3};
use crate::reference::ray::Face;

/// Capped, about the centre between its ends.
pub struct Cylinder {
    /// Unit vector from the first end to the second.
    axis: DoubleDouble3,
    half_length: DoubleDouble,
    radius: DoubleDouble,
}

impl Cylinder {
    /// `half_axis` leads from the centre to the second end.
    pub fn new(half_axis: DoubleDouble3, half_length: DoubleDouble, radius: f64) -> Self {
        Self { axis: half_axis.normalized(), half_length, radius: radius.into() }
    }

    /// The infinite body cut by the slab between the bases; a tie at the rim goes to the body.
    pub fn interval(&self, line: &RecentredLine) -> Option<Interval> {
        let along = line.closest.dot(self.axis);
        let along_slope = line.direction.dot(self.axis);
        let body = self.body(line.closest - self.axis * along, line.direction - self.axis * along_slope)?;
        let slab = Interval::between_planes(
            along,
            along_slope,
            (-self.half_length, Face::End(0)),
            (self.half_length, Face::End(1)),
        )?;
        Some(body.intersection(slab))
    }

    /// |offset + s·slope|² ≤ r², both vectors being perpendicular to the axis.
    fn body(&self, offset: DoubleDouble3, slope: DoubleDouble3) -> Option<Interval> {
        let radius_squared = self.radius * self.radius;
        let slope_squared = slope.length_squared();
        if slope_squared == DoubleDouble::ZERO {
            return (offset.length_squared() <= radius_squared).then(Interval::whole_line);
        }
        // Lagrange: (offset·slope)² − |slope|²·|offset|² = −|offset × slope|², which cancels nothing but r.
        let discriminant = radius_squared * slope_squared - offset.cross(slope).length_squared();
        if discriminant < DoubleDouble::ZERO {
            return None;
        }
        let middle = -offset.dot(slope);
        let half_chord = discriminant.sqrt();
        Some(Interval::new(
            (middle - half_chord) / slope_squared,
            Face::Curved,
            (middle + half_chord) / slope_squared,
            Face::Curved,
        ))
    }

    pub fn depth(&self, point: DoubleDouble3) -> f64 {
        let along = point.dot(self.axis);
        let radial = (point - self.axis * along).length_squared().sqrt();
        (self.radius - radial).rounded().min((self.half_length - along.abs()).rounded())
    }

    /// How far a point is beyond the plane of the base about `ends[end]`.
    pub fn beyond(&self, end: u8, point: DoubleDouble3) -> DoubleDouble {
        let along = point.dot(self.axis);
        let outward = if end == 0 { -along } else { along };
        outward - self.half_length
    }

    /// Outward unit normal at a point of the body.
    pub fn body_normal(&self, point: DoubleDouble3) -> DVec3 {
        (point - self.axis * point.dot(self.axis)).normalized().rounded()
    }

    /// Outward unit normal of the base about `ends[end]`.
    pub fn end_normal(&self, end: u8) -> DVec3 {
        let axis = self.axis.rounded();
        if end == 0 { -axis } else { axis }
    }
}
