//! What the plan needs to know of a solid's shape.

use glam::DVec3;

use crate::scene::{Scene, Solid, world_from_box};

/// The largest of a solid's lengths.
pub(super) fn size(solid: &Solid) -> f64 {
    match *solid {
        Solid::Sphere { radius, .. } => radius,
        Solid::Box { half_size, .. } => half_size.max_element(),
        Solid::Cylinder { ends: [a, b], radius } => radius.max(half_axis(a, b).length()),
        Solid::Cone { height, half_angle_degrees, .. } => height.max(height * half_angle_degrees.to_radians().tan()),
    }
}

/// How far a point is from the half-space of the face that it is farthest out of: negative inside, and outside at most
/// the distance from the solid.
pub(super) fn outside_by(solid: &Solid, point: DVec3) -> f64 {
    let from_anchor = point - solid.position();
    match *solid {
        Solid::Sphere { radius, .. } => from_anchor.length() - radius,
        Solid::Box { half_size, rotation_degrees, .. } => {
            let in_box = world_from_box(rotation_degrees).transpose() * from_anchor;
            (in_box.abs() - half_size).max_element()
        }
        Solid::Cylinder { ends: [a, b], radius } => {
            let half_axis = half_axis(a, b);
            let (along, across) = along_and_across(from_anchor, half_axis.normalize());
            (along.abs() - half_axis.length()).max(across - radius)
        }
        Solid::Cone { axis, height, half_angle_degrees, .. } => {
            let (sine, cosine) = half_angle_degrees.to_radians().sin_cos();
            let (along, across) = along_and_across(from_anchor, axis);
            // Before the apex a needle's side is near however far the apex is.
            (across * cosine - along * sine).max(-along).max(along - height)
        }
    }
}

/// Unit vector along one of any length but zero, whose square need not be a number.
pub(super) fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize()
}

/// How far a point is from the nearest plane of a flat face, among those that it does not lie in to the rounding of
/// `f64`.
pub(super) fn from_face_planes(solid: &Solid, point: DVec3) -> f64 {
    let from_anchor = point - solid.position();
    let least = 8.0 * f64::EPSILON * (point.abs().max_element() + size(solid));
    let beyond = |distance: f64| if distance > least { distance } else { f64::INFINITY };
    match *solid {
        Solid::Sphere { .. } => f64::INFINITY,
        Solid::Box { half_size, rotation_degrees, .. } => {
            let in_box = world_from_box(rotation_degrees).transpose() * from_anchor;
            (in_box.abs() - half_size).abs().map(beyond).min_element()
        }
        Solid::Cylinder { ends: [a, b], .. } => {
            let half_axis = half_axis(a, b);
            beyond((from_anchor.dot(unit(half_axis)).abs() - half_axis.length()).abs())
        }
        Solid::Cone { axis, height, .. } => beyond((from_anchor.dot(axis) - height).abs()),
    }
}

fn half_axis(a: DVec3, b: DVec3) -> DVec3 {
    b * 0.5 - a * 0.5
}

fn along_and_across(vector: DVec3, axis: DVec3) -> (f64, f64) {
    let along = vector.dot(axis);
    (along, (vector - along * axis).length())
}

/// Whether the scene is one solid, and the camera outside of it by far more than any kernel's rounding.
///
/// Then every hit is from outside: what leaves a convex solid outwards never meets it again. So no shadow falls on it
/// (a light on the other side of its surface is below the horizon), and all that it mirrors is the background. From
/// inside, a light outside would be hidden by the solid itself.
pub(super) fn is_lone_and_seen_from_outside(scene: &Scene) -> bool {
    let [primitive] = &scene.primitives[..] else { return false };
    let camera = scene.camera.position;
    // Kernels take an origin within 8u of size and position for inside: 5e-7 in f32.
    const SURELY: f64 = 1e-5;
    let place = (camera - primitive.solid.position()).length();
    outside_by(&primitive.solid, camera) > SURELY * (size(&primitive.solid) + place)
}

/// Whether it is a box whose axes are not the world's.
pub(crate) fn is_rotated(solid: &Solid) -> bool {
    match *solid {
        Solid::Box { rotation_degrees, .. } => world_from_box(rotation_degrees) != glam::DMat3::IDENTITY,
        Solid::Sphere { .. } | Solid::Cylinder { .. } | Solid::Cone { .. } => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each with a point outside, how far, and a point inside.
    #[test]
    fn outside_by_is_a_distance_before_a_face_and_negative_inside() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let sphere = Solid::Sphere { center: DVec3::X, radius: 2.0 };
        let rotated = Solid::Box {
            center: DVec3::ZERO,
            half_size: DVec3::new(1.0, 2.0, 3.0),
            rotation_degrees: DVec3::new(0.0, 0.0, 90.0),
        };
        let cylinder = Solid::Cylinder { ends: [DVec3::ZERO, DVec3::Y * 4.0], radius: 1.0 };
        let cone = Solid::Cone { apex: DVec3::ZERO, axis: DVec3::Y, height: 2.0, half_angle_degrees: 45.0 };
        let needle = Solid::Cone { apex: DVec3::ZERO, axis: DVec3::Y, height: 2.0, half_angle_degrees: 1e-3 };
        let cases = [
            (&sphere, DVec3::X * 5.0, 2.0),
            (&sphere, DVec3::X, -2.0),
            (&rotated, DVec3::X * 5.0, 3.0),
            (&rotated, DVec3::Z, -1.0),
            (&cylinder, DVec3::new(0.0, 7.0, 0.5), 3.0),
            (&cylinder, DVec3::new(3.0, 2.0, 0.0), 2.0),
            (&cylinder, DVec3::Y * 2.0, -1.0),
            (&cone, DVec3::Y * 5.0, 3.0),
            (&cone, DVec3::new(2.0, 0.0, 0.0), 2.0 * half),
            (&cone, DVec3::Y, -half),
            (&needle, DVec3::NEG_Y * 3.0, 3.0),
        ];
        for (solid, point, expected) in cases {
            let outside_by = outside_by(solid, point);
            assert!((outside_by - expected).abs() < 1e-12, "{outside_by} is not {expected}: {solid:?} {point}");
        }
    }
}
