//! Sines, cosines and rotations of stored degrees, to double-double accuracy.

use glam::DVec3;

use super::double_double::{DoubleDouble, DoubleDouble3};

/// π/180
const RADIANS_PER_DEGREE: DoubleDouble = DoubleDouble::from_parts(0.017453292519943295, 2.9486522708701687e-19);

/// (sin, cos) of an angle in degrees; exactly 0 and ±1 at multiples of 90.
pub fn sin_cos_degrees(angle_degrees: f64) -> (DoubleDouble, DoubleDouble) {
    // Both steps are exact: `%` always, and the subtraction by Sterbenz's lemma.
    let within_turn_degrees = angle_degrees % 360.0;
    let quarter_turns = (within_turn_degrees / 90.0).round();
    let rest_degrees = within_turn_degrees - 90.0 * quarter_turns;
    let (sin, cos) = sin_cos_taylor(RADIANS_PER_DEGREE * rest_degrees);
    match quarter_turns.rem_euclid(4.0) as u32 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// (sin, cos) by Taylor's series, for |angle| ≤ π/4, where its terms fall from the first on.
fn sin_cos_taylor(angle_radians: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    // x²⁹/29! < 2⁻¹⁰⁶·x for |x| ≤ π/4.
    const LAST_POWER: i32 = 29;
    let (mut sin, mut cos) = (DoubleDouble::ZERO, DoubleDouble::ZERO);
    let mut term = DoubleDouble::ONE;
    for power in 0..=LAST_POWER {
        let signed = if power % 4 < 2 { term } else { -term };
        if power % 2 == 0 {
            cos = cos + signed;
        } else {
            sin = sin + signed;
        }
        term = term * angle_radians / DoubleDouble::from(f64::from(power + 1));
    }
    (sin, cos)
}

/// The box's axes in the world frame: the columns of local→world = Rx(−a)·Ry(−b)·Rz(−c), the course's rule.
pub fn world_from_box_columns(rotation_degrees: DVec3) -> [DoubleDouble3; 3] {
    let (sin_a, cos_a) = sin_cos_degrees(-rotation_degrees.x);
    let (sin_b, cos_b) = sin_cos_degrees(-rotation_degrees.y);
    let (sin_c, cos_c) = sin_cos_degrees(-rotation_degrees.z);
    [
        DoubleDouble3::new(cos_b * cos_c, cos_a * sin_c + sin_a * sin_b * cos_c, sin_a * sin_c - cos_a * sin_b * cos_c),
        DoubleDouble3::new(
            -(cos_b * sin_c),
            cos_a * cos_c - sin_a * sin_b * sin_c,
            sin_a * cos_c + cos_a * sin_b * sin_c,
        ),
        DoubleDouble3::new(sin_b, -(sin_a * cos_b), cos_a * cos_b),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        for (angle_degrees, sin, cos) in
            [(0.0, 0.0, 1.0), (90.0, 1.0, 0.0), (-180.0, 0.0, -1.0), (270.0, -1.0, 0.0), (3600.0, 0.0, 1.0)]
        {
            assert_eq!(sin_cos_degrees(angle_degrees), (sin.into(), cos.into()), "{angle_degrees}°");
        }
    }

    #[test]
    fn sine_and_cosine_lie_on_the_unit_circle_far_beyond_f64() {
        for step in 0..7200 {
            let (sin, cos) = sin_cos_degrees(f64::from(step) * 0.1 - 360.0);
            let excess = sin * sin + cos * cos - DoubleDouble::ONE;
            assert!(excess.rounded().abs() < 1e-30, "step {step}: {excess:?}");
        }
    }

    #[test]
    fn box_axes_follow_the_course_rule() {
        // Rx(−90)·Ry(−90)·Rz(−90), worked by hand on the unit vectors: x → z, y → y, z → −x.
        let [x, y, z] = world_from_box_columns(DVec3::splat(90.0));
        assert_eq!([x.rounded(), y.rounded(), z.rounded()], [DVec3::Z, DVec3::Y, DVec3::NEG_X]);
        let [x, _, z] = world_from_box_columns(DVec3::new(0.0, 90.0, 0.0));
        assert_eq!([x.rounded(), z.rounded()], [DVec3::Z, DVec3::NEG_X]);
    }
}
