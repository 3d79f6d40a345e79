//! Rays and solids by the course work's definitions, apart from all that the program knows of them.

use glam::{DMat3, DVec3};
use zerkalo::scene::{Camera, Solid};

/// Origin and direction of the ray through the middle of a pixel: docs/course-work.md's primary rays, with the window
/// that the course's projection is.
pub fn primary_ray(camera: &Camera, [width, height]: [u32; 2], [column, row]: [u32; 2]) -> (DVec3, DVec3) {
    let (width, height) = (f64::from(width), f64::from(height));
    let (x, y) = ((f64::from(column) + 0.5) / width * 2.0 - 1.0, 1.0 - (f64::from(row) + 0.5) / height * 2.0);
    let (a, b) = ((1.0 - 2.0 * x) * (width / height) * 0.25_f64.tan(), (2.0 * y - 1.0) * 0.25_f64.tan());
    let f = -camera.direction.normalize();
    let s = f.cross(DVec3::Y).normalize();
    let u = s.cross(f);
    (camera.position, (s * a + u * b - f).normalize())
}

/// Whether a point is in the solid: its definition in section 1.1.3.
pub fn is_inside(solid: &Solid, point: DVec3) -> bool {
    match solid {
        Solid::Sphere { center, radius } => point.distance(*center) <= *radius,
        Solid::Box { center, half_size, rotation_degrees } => {
            let [a, b, c] = rotation_degrees.to_array().map(|degrees| -degrees.to_radians());
            let world_from_local = DMat3::from_rotation_x(a) * DMat3::from_rotation_y(b) * DMat3::from_rotation_z(c);
            (world_from_local.transpose() * (point - center)).abs().cmple(*half_size).all()
        }
        Solid::Cylinder { ends: [first, second], radius } => {
            let axis = (second - first).normalize();
            let along = (point - first).dot(axis);
            (0.0..=first.distance(*second)).contains(&along) && (point - (first + axis * along)).length() <= *radius
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let from_apex = point - apex;
            let along = from_apex.dot(axis.normalize());
            along <= *height && along >= from_apex.length() * half_angle_degrees.to_radians().cos()
        }
    }
}

/// Which of the solids the ray enters first within `far`, by looking at a point every `step`.
pub fn first_entered<'a>(
    solids: impl Iterator<Item = &'a Solid> + Clone,
    (origin, direction): (DVec3, DVec3),
    step: f64,
    far: f64,
) -> Option<usize> {
    let points = (0..(far / step) as u32).map(|i| origin + direction * (f64::from(i) * step));
    points.into_iter().find_map(|point| solids.clone().position(|solid| is_inside(solid, point)))
}
