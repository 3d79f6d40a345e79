//! From NFF's surfaces to solids.

use glam::{DMat3, DVec3};

use crate::scene::validate::unit;
use crate::scene::{Solid, rotation_of};

/// What a `c` is.
pub(super) enum Round {
    Solid(Solid),
    /// Two radii that differ, neither of them 0.
    Truncated,
}

/// A `c` of two centres with their radii.
///
/// # Errors
/// It is no surface, or is to be seen from inside only; in one line, why.
pub(super) fn round(ends: [[f64; 4]; 2]) -> Result<Round, String> {
    let [(base, base_radius), (top, top_radius)] = ends.map(|[x, y, z, radius]| (DVec3::new(x, y, z), radius));
    if base_radius < 0.0 || top_radius < 0.0 {
        let radius = base_radius.min(top_radius);
        return Err(format!(
            "c: radius = {radius}: only its inside is to be seen, which is not drawn here; must be 0 or greater"
        ));
    }
    if base == top {
        return Err("c: its two centres must be different points".to_owned());
    }
    let cone = |apex: DVec3, center: DVec3, radius: f64| {
        let height = apex.distance(center);
        let half_angle_degrees = radius.atan2(height).to_degrees();
        Solid::Cone { apex, axis: unit(center - apex), height, half_angle_degrees }
    };
    Ok(match (base_radius, top_radius) {
        (0.0, 0.0) => return Err("c: both radii are 0: one must be greater".to_owned()),
        (radius, other) if radius == other => Round::Solid(Solid::Cylinder { ends: [base, top], radius }),
        (radius, 0.0) => Round::Solid(cone(top, base, radius)),
        (0.0, radius) => Round::Solid(cone(base, top, radius)),
        _ => Round::Truncated,
    })
}

/// How far a coordinate may be from where it is meant, in the largest one: C's `%g`, which the format is written with,
/// keeps six digits, and half a step of the sixth is at most 5e-6 of the number.
const COORDINATE_ERROR: f64 = 5e-6;

/// A box of no thickness that is the rectangle of these corners in a row; `None` where they are not one.
pub(super) fn rectangle(corners: [DVec3; 4]) -> Option<Solid> {
    let [a, b, c, d] = corners;
    let largest = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    let corner_error = 3f64.sqrt() * COORDINATE_ERROR * largest;
    // The sides of a parallelogram are the means of its opposite ones; each may be off by 2·e, as a corner is by e.
    let [along, across] = [(b - a + (c - d)) / 2.0, (d - a + (c - b)) / 2.0];
    let is_parallelogram = (a - b + (c - d)).length() <= 4.0 * corner_error;
    let [length, width] = [along.length(), across.length()];
    // What its own error could turn has no direction.
    let has_sides = length.min(width) > 8.0 * corner_error;
    let is_right = along.dot(across).abs() <= 2.0 * corner_error * (length + width) + 4.0 * corner_error.powi(2);
    if !(is_parallelogram && has_sides && is_right) {
        return None;
    }
    let center = (a + b + c + d) / 4.0;
    // Along two of the world's axes it needs no rotation.
    let is_axis = |side: DVec3| side.to_array().iter().filter(|component| **component != 0.0).count() == 1;
    if is_axis(along) && is_axis(across) {
        let half_size = (along + across).abs() / 2.0;
        return Some(Solid::Box { center, half_size, rotation_degrees: DVec3::ZERO });
    }
    let x = along / length;
    let y = (across - x * x.dot(across)).normalize();
    let rotation_degrees = rotation_of(&DMat3::from_cols(x, y, x.cross(y)));
    Some(Solid::Box { center, half_size: DVec3::new(length, width, 0.0) / 2.0, rotation_degrees })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::world_from_box;

    /// Corners of a rectangle of half sides 2 and 1 about (3, −1, 2).
    fn corners(rotation_degrees: DVec3) -> [DVec3; 4] {
        let rotation = world_from_box(rotation_degrees);
        [[-2.0, -1.0], [2.0, -1.0], [2.0, 1.0], [-2.0, 1.0]]
            .map(|[x, y]| DVec3::new(3.0, -1.0, 2.0) + rotation * DVec3::new(x, y, 0.0))
    }

    #[test]
    fn a_rectangle_however_it_stands_is_a_box_with_its_corners() {
        let angles = [-180.0, -90.0, -50.0, 0.0, 20.0, 90.0, 133.0];
        for (a, b, c) in angles.iter().flat_map(|a| angles.iter().flat_map(move |b| angles.map(|c| (*a, *b, c)))) {
            let corners = corners(DVec3::new(a, b, c));
            let Some(Solid::Box { center, half_size, rotation_degrees }) = rectangle(corners) else {
                panic!("{a}, {b}, {c}")
            };
            assert_eq!(half_size.to_array().iter().filter(|half| **half == 0.0).count(), 1, "{half_size}");
            let rotation = world_from_box(rotation_degrees);
            for corner in corners {
                let own = rotation.transpose() * (corner - center);
                // A dozen roundings of numbers up to 5.
                assert!((own.abs() - half_size).length() < 1e-14, "{a}, {b}, {c}: {own} of {half_size}");
            }
        }
    }

    #[test]
    fn six_digits_are_enough_and_what_is_skew_is_none() {
        let rounded = |corner: DVec3| DVec3::from_array(corner.to_array().map(|x| format!("{x:.5}").parse().unwrap()));
        let exact = corners(DVec3::new(10.0, 20.0, 30.0));
        assert!(rectangle(exact.map(rounded)).is_some());
        for place in 0..4 {
            let mut moved = exact;
            moved[place] += DVec3::new(1e-3, 0.0, 0.0);
            assert_eq!(rectangle(moved), None);
        }
        let [a, b, c, d] = exact;
        assert_eq!(rectangle([a, c, b, d]), None, "crossed");
        assert_eq!(rectangle([a, b, c + (b - a), d + (b - a)]), None, "slanted");
        assert_eq!(rectangle([a; 4]), None);
    }
}
