use glam::{DVec2, DVec3};

use super::ray::Ray;
use crate::scene::{Camera, Projection};

/// The rays through a picture's pixels (docs/course-work.md, "Primary rays").
pub struct PrimaryRays {
    position: DVec3,
    /// Unit vectors in the world frame: to the left of the picture, up, and along the optical axis.
    left: DVec3,
    up: DVec3,
    ahead: DVec3,
    /// Half extent of the centred window in the plane at distance 1.
    half_extent: DVec2,
    projection: Projection,
    picture_size: DVec2,
}

impl PrimaryRays {
    /// For a picture of `width` × `height` square pixels.
    pub fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let ahead = unit(camera.direction);
        let left = unit(-ahead.cross(unit(camera.up)));
        let half_height = (camera.vertical_fov_degrees.to_radians() / 2.0).tan();
        let picture_size = DVec2::new(width.into(), height.into());
        Self {
            position: camera.position,
            left,
            up: -left.cross(ahead),
            ahead,
            half_extent: DVec2::new(half_height * picture_size.x / picture_size.y, half_height),
            projection: camera.projection,
            picture_size,
        }
    }

    /// Through the centre of a pixel counted from the left and from the top; its direction has unit length.
    pub fn through(&self, column: u32, row: u32) -> Ray {
        self.through_point(DVec2::new(column.into(), row.into()) + 0.5)
    }

    /// Through a point of the picture, right and down from its top left corner in pixels, at most `width` and `height`;
    /// its direction has unit length.
    pub fn through_point(&self, point: DVec2) -> Ray {
        let from_top_left = point / self.picture_size;
        // x right, y up, in [0, 1]²: what the camera formula was written for.
        let centered = DVec2::new(from_top_left.x, 1.0 - from_top_left.y);
        let window = match self.projection {
            Projection::Centered => centered,
            // The course feeds the same formula [-1, 1]².
            Projection::Course => 2.0 * centered - 1.0,
        };
        let to_left = (1.0 - 2.0 * window.x) * self.half_extent.x;
        let upward = (2.0 * window.y - 1.0) * self.half_extent.y;
        Ray { origin: self.position, direction: unit(self.left * to_left + self.up * upward + self.ahead) }
    }
}

/// The unit vector along `vector`, whose length may be any but 0 (which yields NaN); scaled first so that no square
/// leaves the range of `f64`.
pub(super) fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize()
}
