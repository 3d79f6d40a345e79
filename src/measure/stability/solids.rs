//! What the cases of rays are made of: solids of every kind, and rays at them.

use glam::{DQuat, DVec3};

use crate::scene::{Solid, SolidKind};
use crate::tracer::Precision;
use crate::tracer::probe::{From, ProbeRay};

use super::judge::{anchor, size, stored_vector};

/// One of each kind about the origin, of size 1, askew.
pub(super) fn usual() -> Vec<Solid> {
    let axis = DVec3::new(0.36, -0.48, 0.8);
    SolidKind::ALL
        .map(|kind| match kind {
            SolidKind::Sphere => Solid::Sphere { center: DVec3::ZERO, radius: 1.0 },
            SolidKind::Box => Solid::Box {
                center: DVec3::ZERO,
                half_size: DVec3::new(1.0, 0.7, 0.4),
                rotation_degrees: DVec3::new(20.0, 35.0, 50.0),
            },
            SolidKind::Cylinder => Solid::Cylinder { ends: [-axis, axis], radius: 0.6 },
            SolidKind::Cone => Solid::Cone { apex: -0.5 * axis, axis, height: 1.0, half_angle_degrees: 30.0 },
        })
        .to_vec()
}

/// The same solid `scale` times as large about the world's origin, then moved.
pub(super) fn placed(solid: &Solid, scale: f64, shift: DVec3) -> Solid {
    let place = |point: DVec3| shift + point * scale;
    match *solid {
        Solid::Sphere { center, radius } => Solid::Sphere { center: place(center), radius: radius * scale },
        Solid::Box { center, half_size, rotation_degrees } => {
            Solid::Box { center: place(center), half_size: half_size * scale, rotation_degrees }
        }
        Solid::Cylinder { ends, radius } => Solid::Cylinder { ends: ends.map(place), radius: radius * scale },
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            Solid::Cone { apex: place(apex), axis, height: height * scale, half_angle_degrees }
        }
    }
}

/// A point inside.
pub(super) fn middle(solid: &Solid) -> DVec3 {
    match *solid {
        Solid::Cone { apex, axis, height, .. } => apex + axis * (0.5 * height),
        _ => anchor(solid),
    }
}

/// The `index`th of directions that spread evenly over the sphere (a golden spiral of `count` points).
pub(super) fn direction(index: usize, count: usize) -> DVec3 {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let z = 1.0 - (2.0 * index as f64 + 1.0) / count as f64;
    let (sin, cos) = (index as f64 * GOLDEN_ANGLE).sin_cos();
    let across = (1.0 - z * z).sqrt();
    DVec3::new(across * cos, across * sin, z)
}

/// A free ray in numbers that the precision stores.
pub(super) fn ray(origin: DVec3, towards: DVec3, precision: Precision) -> ProbeRay {
    let origin = stored_vector(origin, precision);
    let direction = stored_vector((towards - origin).normalize(), precision);
    ProbeRay { origin, direction, solid: 0, from: From::Space }
}

/// `count` rays from points at `distance` sizes around a solid, at points in and just around it.
pub(super) fn rays_at(solid: &Solid, distance: f64, count: usize, precision: Precision) -> Vec<ProbeRay> {
    let (middle, size) = (middle(solid), size(solid));
    (0..count)
        .map(|index| {
            let origin = middle + direction(index, count) * (size * distance);
            // Another spiral, so that origins and targets are not tied to each other.
            let target =
                direction((index * 7 + 3) % count, count) * (1.2 * size * ((index * 13 % count) as f64 / count as f64));
            ray(origin, middle + target, precision)
        })
        .collect()
}

/// `count` rays from `distance` sizes away that pass a sphere's centre, or a cylinder's axis, at `radius`·(1 +
/// clearance).
pub(super) fn grazing(
    solid: &Solid,
    distance: f64,
    clearance: f64,
    count: usize,
    precision: Precision,
) -> Vec<ProbeRay> {
    let (middle, size) = (middle(solid), size(solid));
    (0..count)
        .map(|index| {
            let (from, offset) = match *solid {
                Solid::Cylinder { ends: [a, b], radius } => {
                    let axis = (b - a).normalize();
                    let turn = DQuat::from_axis_angle(axis, index as f64 * 2.4);
                    let from = turn * axis.any_orthonormal_vector();
                    (from, axis.cross(from) * (radius * (1.0 + clearance)))
                }
                _ => {
                    let from = direction(index, count);
                    (from, from.any_orthonormal_vector() * (size * (1.0 + clearance)))
                }
            };
            let origin = stored_vector(middle + offset + from * (size * distance), precision);
            ProbeRay { origin, direction: stored_vector(-from, precision), solid: 0, from: From::Space }
        })
        .collect()
}
