//! What records and proxies are written with.

use glam::DVec3;

use crate::scene::two_sum;

/// A vector and a number: a row of four.
pub(super) fn row(vector: DVec3, fourth: f64) -> [f64; 4] {
    [vector.x, vector.y, vector.z, fourth]
}

/// The unit vector along value + error, and what its rounding lost.
pub(super) fn unit((value, error): (DVec3, DVec3)) -> (DVec3, DVec3) {
    // Scaled by a power of two, so that no square leaves the range of `f64`.
    let scale = (-value.abs().max_element().log2().floor().clamp(-1022.0, 1022.0)).exp2();
    let (value, error) = (value * scale, error * scale);
    let length = value.length();
    let square_error = |x: f64| x.mul_add(x, -(x * x));
    let squares = value * value;
    // |value|² − length², each product and each sum with its error.
    let (xy, xy_error) = two_sum(DVec3::splat(squares.x), DVec3::splat(squares.y));
    let (xyz, xyz_error) = two_sum(xy, DVec3::splat(squares.z));
    let lost: f64 = value.to_array().map(square_error).iter().sum();
    let missing = (xyz.x - length * length) - square_error(length) + (lost + xy_error.x + xyz_error.x);
    let length_error = (missing / 2.0 + value.dot(error)) / length;
    let unit = value / length;
    let rest = DVec3::new(
        (-unit.x).mul_add(length, value.x),
        (-unit.y).mul_add(length, value.y),
        (-unit.z).mul_add(length, value.z),
    );
    (unit, (rest + error - unit * length_error) / length)
}
