use glam::DVec3;

use super::{SceneSpace, Solid, world_from_box};

/// A box around a solid or several, along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub low: DVec3,
    /// Largest coordinates.
    pub high: DVec3,
}

impl Bounds {
    /// Around nothing.
    pub const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// Around a solid; in the scene space given.
    pub fn of(solid: &Solid, space: SceneSpace) -> Self {
        let around = |center: DVec3, reach: DVec3| Self { low: center - reach, high: center + reach };
        // Of a disk across an axis, along each coordinate.
        let disk = |axis: DVec3, radius: f64| (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt) * radius;
        let scale = space.scale;
        match *solid {
            Solid::Sphere { center, radius } => around(space.point(center), DVec3::splat(radius * scale)),
            Solid::Box { center, half_size, rotation_degrees } => {
                let axes = world_from_box(rotation_degrees);
                let half_size = half_size * scale;
                let reach =
                    axes.x_axis.abs() * half_size.x + axes.y_axis.abs() * half_size.y + axes.z_axis.abs() * half_size.z;
                around(space.point(center), reach)
            }
            Solid::Cylinder { ends: [a, b], radius } => {
                let (a, b) = (space.point(a), space.point(b));
                let axis = b * 0.5 - a * 0.5;
                let reach = disk((axis / axis.abs().max_element()).normalize(), radius * scale);
                around(a, reach).union(around(b, reach))
            }
            Solid::Cone { apex, axis, height, half_angle_degrees } => {
                let (apex, height) = (space.point(apex), height * scale);
                let reach = disk(axis, height * half_angle_degrees.to_radians().tan());
                around(apex, DVec3::ZERO).union(around(apex + axis * height, reach))
            }
        }
    }

    /// Around both.
    pub fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The centre.
    pub fn middle(&self) -> DVec3 {
        self.low.midpoint(self.high)
    }

    /// Whether they have a point in common, or may by the rounding of `f32` coordinates.
    pub fn touches(&self, other: &Self) -> bool {
        let slack = 1e-5 * self.largest().max(other.largest());
        self.low.cmple(other.high + slack).all() && other.low.cmple(self.high + slack).all()
    }

    fn largest(&self) -> f64 {
        self.low.abs().max(self.high.abs()).max_element()
    }
}
