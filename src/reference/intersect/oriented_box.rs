use glam::DVec3;

use super::{Interval, RecentredLine};
use crate::reference::angle::world_from_box_columns;
use crate::reference::double_double::{DoubleDouble, DoubleDouble3};
use crate::reference::ray::Face;

/// About its centre; a half size may be 0.
pub struct OrientedBox {
    half_size: [DoubleDouble; 3],
    /// The box's unit axes in the world frame.
    world_axes: [DoubleDouble3; 3],
}

impl OrientedBox {
    pub fn new(half_size: DVec3, rotation_degrees: DVec3) -> Self {
        Self {
            half_size: half_size.to_array().map(DoubleDouble::from),
            world_axes: world_from_box_columns(rotation_degrees),
        }
    }

    /// The three slabs' intersection (Kay and Kajiya 1986); a tie goes to the lowest axis.
    pub fn interval(&self, line: &RecentredLine) -> Option<Interval> {
        let mut inside = Interval::whole_line();
        for (axis, (&half, &world_axis)) in (0u8..).zip(self.half_size.iter().zip(&self.world_axes)) {
            let slab = Interval::between_planes(
                line.closest.dot(world_axis),
                line.direction.dot(world_axis),
                (-half, Face::Slab { axis, positive: false }),
                (half, Face::Slab { axis, positive: true }),
            )?;
            inside = inside.intersection(slab);
        }
        Some(inside)
    }

    pub fn depth(&self, point: DoubleDouble3) -> f64 {
        let below_faces = self.half_size.iter().zip(&self.world_axes);
        below_faces.map(|(&half, &axis)| (half - point.dot(axis).abs()).rounded()).fold(f64::INFINITY, f64::min)
    }

    /// How far a point is beyond a face's plane.
    pub fn beyond(&self, axis: u8, positive: bool, point: DoubleDouble3) -> DoubleDouble {
        let along = point.dot(self.world_axes[usize::from(axis)]);
        let outward = if positive { along } else { -along };
        outward - self.half_size[usize::from(axis)]
    }

    /// Outward unit normal of a slab face.
    pub fn normal(&self, axis: u8, positive: bool) -> DVec3 {
        let outward = self.world_axes[usize::from(axis)].rounded();
        if positive { outward } else { -outward }
    }
}
