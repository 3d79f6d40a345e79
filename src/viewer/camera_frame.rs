//! The camera's axes, which the mouse, the keyboard and the highlight all need.

use glam::{DMat3, DVec3};

use crate::scene::Camera;

/// The rotation whose columns are the unit vectors, world frame, to the right on the picture, up on the picture and
/// along the optical axis; its transpose is camera→world's inverse. The camera must be valid.
///
/// Left-handed: the course's picture has `cross(−ahead, up)` on its left (docs/course-work.md).
pub(super) fn world_from_camera(camera: &Camera) -> DMat3 {
    let ahead = unit(camera.direction);
    let right = unit(ahead.cross(unit(camera.up)));
    DMat3::from_cols(right, right.cross(ahead), ahead)
}

/// The unit vector along `vector`, whose length may be any but 0 (which yields NaN); scaled first so that no square
/// leaves the range of `f64`.
pub(super) fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_start_camera_has_negative_x_on_its_right() {
        let axes = world_from_camera(&Camera::default());
        assert_eq!(axes, DMat3::from_cols(DVec3::NEG_X, DVec3::Y, DVec3::Z));
    }

    #[test]
    fn lengths_of_direction_and_up_do_not_matter() {
        let camera = Camera { direction: DVec3::new(1.0, -2.0, 3.0), ..Camera::default() };
        let scaled = Camera { direction: camera.direction * 1e-200, up: camera.up * 1e30, ..camera.clone() };
        assert!(world_from_camera(&camera).abs_diff_eq(world_from_camera(&scaled), 1e-15));
    }
}
