use glam::DVec3;
use rayon::prelude::*;

use super::{Primitive, Solid};

/// A sphere around a solid, world frame.
pub struct BoundingSphere {
    /// World frame.
    pub center: DVec3,
    /// World units.
    pub radius: f64,
}

impl BoundingSphere {
    /// The smallest one, to rounding.
    pub fn of(solid: &Solid) -> Self {
        match *solid {
            Solid::Sphere { center, radius } => Self { center, radius },
            Solid::Box { center, half_size, .. } => Self { center, radius: half_size.length() },
            Solid::Cylinder { ends: [a, b], radius } => {
                Self { center: a.midpoint(b), radius: radius.hypot(half_length(a, b)) }
            }
            Solid::Cone { apex, axis, height, half_angle_degrees } => {
                // Through the apex and the base's rim; of a blunt cone, the base itself.
                let base_radius = height * half_angle_degrees.to_radians().tan();
                let radius = (height * height + base_radius * base_radius) / (2.0 * height);
                let (radius, at) = if base_radius <= height { (radius, radius) } else { (base_radius, height) };
                Self { center: apex + axis * at, radius }
            }
        }
    }
}

fn half_length(a: DVec3, b: DVec3) -> f64 {
    // Halved first: the difference of two numbers near the largest must not overflow.
    (b * 0.5 - a * 0.5).length()
}

/// The largest coordinate of a solid, relative to an origin; world lengths.
pub fn farthest_coordinate(primitives: &[Primitive], origin: DVec3) -> f64 {
    let farthest = |primitive: &Primitive| {
        let sphere = BoundingSphere::of(&primitive.solid);
        (sphere.center - origin).abs().max_element() + sphere.radius
    };
    primitives.par_iter().map(farthest).reduce(|| 0.0, f64::max)
}
