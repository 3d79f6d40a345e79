//! How the mouse and the keyboard move the camera. A valid camera stays valid, whatever finite numbers come in, and
//! keeps its `up`.

use glam::{DVec2, DVec3};

use super::camera_frame::{unit, world_from_camera};
use crate::scene::Camera;

/// The course's.
const LOOK_RADIANS_PER_PIXEL: f64 = 0.001;

/// A quarter turn in about 300 pixels: one goes around a thing farther than one turns the head.
const ORBIT_RADIANS_PER_PIXEL: f64 = 0.005;

/// From the plane normal to `up`: at 90° left and right would be undefined.
const LARGEST_PITCH_DEGREES: f64 = 89.0;

/// Share of the distance to the pivot that one step towards it leaves.
const DISTANCE_LEFT_BY_STEP: f64 = 0.9;

/// World units; from the pivot itself no step would lead away again.
const SMALLEST_PIVOT_DISTANCE: f64 = 1e-3;

/// What a scene may hold in a coordinate.
const LARGEST_COORDINATE: f64 = f32::MAX as f64;

/// Where the held keys want to go, each from −1 (the opposite way) to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Flight {
    /// Along the viewing direction.
    pub ahead: f64,
    /// On the picture.
    pub left: f64,
    /// Along the camera's `up`, which is the world's +y unless a scene says otherwise.
    pub up: f64,
}

/// Turns the view by a movement of the mouse (x to the right, y down): right turns right, down looks down, or up if
/// `is_inverted`.
pub fn look(camera: &mut Camera, pixels: DVec2, is_inverted: bool) {
    let downward_pixels = if is_inverted { -pixels.y } else { pixels.y };
    turn(camera, pixels.x * LOOK_RADIANS_PER_PIXEL, -downward_pixels * LOOK_RADIANS_PER_PIXEL);
}

/// Moves without turning, at `speed` world units in a second for each wish of 1.
pub fn fly(camera: &mut Camera, wish: Flight, seconds: f64, speed: f64) {
    let axes = world_from_camera(camera);
    let wished = |wish: f64| wish.clamp(-1.0, 1.0);
    let heading =
        axes.z_axis * wished(wish.ahead) - axes.x_axis * wished(wish.left) + unit(camera.up) * wished(wish.up);
    let distance = (seconds * speed).clamp(-LARGEST_COORDINATE, LARGEST_COORDINATE);
    place(camera, camera.position + heading * distance);
}

/// Goes around `pivot` by a movement of the mouse (x to the right, y down) as if it took hold of the scene: the pivot
/// keeps its distance and its position in the picture.
pub fn orbit(camera: &mut Camera, pivot: DVec3, pixels: DVec2) {
    let pivot_in_camera = world_from_camera(camera).transpose() * (pivot - camera.position);
    turn(camera, pixels.x * ORBIT_RADIANS_PER_PIXEL, -pixels.y * ORBIT_RADIANS_PER_PIXEL);
    place(camera, pivot - world_from_camera(camera) * pivot_in_camera);
}

/// Goes straight towards `pivot` (`steps` > 0) or away from it, never through it.
pub fn zoom(camera: &mut Camera, pivot: DVec3, steps: f64) {
    let from_pivot = camera.position - pivot;
    let distance = from_pivot.length();
    let target_distance = (distance * DISTANCE_LEFT_BY_STEP.powf(steps)).max(SMALLEST_PIVOT_DISTANCE.min(distance));
    place(camera, pivot + from_pivot * (target_distance / distance));
}

/// Turns the viewing direction to the right about `up`, and upward as far as the pitch's limit.
fn turn(camera: &mut Camera, rightward_radians: f64, upward_radians: f64) {
    let (ahead, up) = (unit(camera.direction), unit(camera.up));
    let horizontal = ahead - up * ahead.dot(up);
    let largest_pitch = LARGEST_PITCH_DEGREES.to_radians();
    let pitch = ahead.dot(up).atan2(horizontal.length()) + upward_radians;
    let (sin_pitch, cos_pitch) = pitch.clamp(-largest_pitch, largest_pitch).sin_cos();
    let horizontal = unit(horizontal);
    let (sin_turn, cos_turn) = rightward_radians.sin_cos();
    let turned = horizontal * cos_turn + horizontal.cross(up) * sin_turn;
    camera.direction = turned * cos_pitch + up * sin_pitch;
}

/// Puts the camera there, or leaves it where it is if numbers do not reach that far.
fn place(camera: &mut Camera, position: DVec3) {
    if position.is_finite() {
        camera.position = position.clamp(DVec3::splat(-LARGEST_COORDINATE), DVec3::splat(LARGEST_COORDINATE));
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scene::{Projection, Scene};
    use crate::viewer::outline::Projector;

    /// Where the camera's picture of 800 × 600 shows the point.
    fn seen(camera: &Camera, point: DVec3) -> DVec2 {
        Projector::new(camera, 800, 600).project(point).unwrap()
    }

    fn pitch_degrees(camera: &Camera) -> f64 {
        unit(camera.direction).dot(unit(camera.up)).asin().to_degrees()
    }

    #[test]
    fn mouse_to_the_right_turns_right_and_down_looks_down() {
        for projection in Projection::ALL {
            let mut camera = Camera { projection, ..Camera::default() };
            let before = seen(&camera, DVec3::ZERO);
            look(&mut camera, DVec2::new(100.0, 0.0), false);
            let turned = seen(&camera, DVec3::ZERO);
            assert!(turned.x < before.x - 50.0 && (turned.y - before.y).abs() < 1e-9, "{turned}");
            look(&mut camera, DVec2::new(-100.0, 50.0), false);
            let tilted = seen(&camera, DVec3::ZERO);
            assert!(tilted.y < before.y - 20.0 && (tilted.x - before.x).abs() < 1e-9, "{tilted}");
            look(&mut camera, DVec2::new(0.0, 50.0), true);
            assert!(seen(&camera, DVec3::ZERO).distance(before) < 1e-9);
        }
    }

    #[test]
    fn a_pixel_turns_by_a_thousandth_of_a_radian() {
        let mut camera = Camera::default();
        look(&mut camera, DVec2::new(1.0, 0.0), false);
        assert!((camera.direction.angle_between(DVec3::Z) - 0.001).abs() < 1e-12);
    }

    #[test]
    fn the_pitch_stops_before_the_poles_and_comes_back() {
        for up in [DVec3::Y, DVec3::new(0.2, 3.0, -1.0)] {
            let mut camera = Camera { up, ..Camera::default() };
            look(&mut camera, DVec2::new(0.0, 1e7), false);
            assert!((pitch_degrees(&camera) + 89.0).abs() < 1e-6);
            look(&mut camera, DVec2::new(0.0, -1e7), false);
            assert!((pitch_degrees(&camera) - 89.0).abs() < 1e-6);
            look(&mut camera, DVec2::new(0.0, 89.0_f64.to_radians() * 1000.0), false);
            assert!(pitch_degrees(&camera).abs() < 1e-6);
            assert_eq!(camera.up, up);
        }
    }

    #[test]
    fn a_camera_that_looks_almost_along_its_up_can_be_turned_away() {
        let mut camera = Camera { direction: DVec3::new(2e-9, -1.0, 0.0), ..Camera::default() };
        assert!(is_valid(&camera));
        look(&mut camera, DVec2::ZERO, false);
        assert!((pitch_degrees(&camera) + 89.0).abs() < 1e-6 && camera.direction.x > 0.0, "{camera:?}");
    }

    #[test]
    fn keys_move_as_seen_on_the_picture() {
        let point = DVec3::new(0.3, 0.2, 5.0);
        for projection in Projection::ALL {
            let start = Camera { projection, direction: DVec3::new(0.1, 0.0, 1.0), ..Camera::default() };
            let flown = |wish| {
                let mut camera = start.clone();
                fly(&mut camera, wish, 0.1, 3.0);
                assert!((camera.position.distance(start.position) - 0.3).abs() < 1e-12);
                camera
            };
            let before = seen(&start, point);
            let right = seen(&flown(Flight { left: -1.0, ..Flight::default() }), point);
            assert!(right.x < before.x - 10.0 && (right.y - before.y).abs() < 1e-9, "D: {before} → {right}");
            let left = seen(&flown(Flight { left: 1.0, ..Flight::default() }), point);
            assert!(left.x > before.x + 10.0, "A: {before} → {left}");
            let up = seen(&flown(Flight { up: 1.0, ..Flight::default() }), point);
            assert!(up.y > before.y + 10.0 && (up.x - before.x).abs() < 1e-9, "Q: {before} → {up}");
            let ahead = flown(Flight { ahead: 1.0, ..Flight::default() });
            assert!(unit(ahead.position - start.position).distance(unit(start.direction)) < 1e-12, "W");
        }
    }

    #[test]
    fn up_is_the_world_s_though_the_camera_looks_down() {
        let mut camera = Camera { direction: DVec3::new(0.0, -1.0, 1.0), ..Camera::default() };
        fly(&mut camera, Flight { up: -1.0, ..Flight::default() }, 1.0, 2.0);
        assert_eq!(camera.position, DVec3::new(0.0, -2.0, -2.0));
    }

    #[test]
    fn orbiting_keeps_the_pivot_s_distance_and_its_place_on_the_picture() {
        let pivot = DVec3::new(0.2, -0.1, 3.0);
        for projection in Projection::ALL {
            let start = Camera { projection, ..Camera::default() };
            let mut camera = start.clone();
            for pixels in [DVec2::new(200.0, 30.0), DVec2::new(-20.0, 1e5), DVec2::new(500.0, -70.0)] {
                orbit(&mut camera, pivot, pixels);
                assert!((camera.position.distance(pivot) - start.position.distance(pivot)).abs() < 1e-12);
                assert!(seen(&camera, pivot).distance(seen(&start, pivot)) < 1e-9);
                assert!(pitch_degrees(&camera).abs() < 89.0 + 1e-9);
            }
            assert!(camera.position.distance(start.position) > 1.0);
        }
    }

    #[test]
    fn orbiting_drags_the_near_side_with_the_mouse() {
        let pivot = DVec3::new(0.0, 0.0, 3.0);
        let near_side = DVec3::new(0.0, 0.0, 2.0);
        let mut camera = Camera::default();
        let before = seen(&camera, near_side);
        orbit(&mut camera, pivot, DVec2::new(20.0, 10.0));
        let after = seen(&camera, near_side);
        assert!(after.x > before.x + 1.0 && after.y > before.y + 1.0, "{before} → {after}");
    }

    #[test]
    fn zooming_approaches_the_pivot_and_never_passes_it() {
        let pivot = DVec3::new(1.0, 2.0, 3.0);
        let start = Camera::default();
        let mut camera = start.clone();
        zoom(&mut camera, pivot, 1.0);
        assert!((camera.position.distance(pivot) / start.position.distance(pivot) - 0.9).abs() < 1e-12);
        zoom(&mut camera, pivot, -1.0);
        assert!(camera.position.distance(start.position) < 1e-12);
        zoom(&mut camera, pivot, 1e6);
        assert!((camera.position.distance(pivot) - SMALLEST_PIVOT_DISTANCE).abs() < 1e-12);
        assert!((camera.position - pivot).dot(start.position - pivot) > 0.0);
        zoom(&mut camera, pivot, -10.0);
        assert!(camera.position.distance(pivot) > 2.0 * SMALLEST_PIVOT_DISTANCE, "and away again");
    }

    #[test]
    fn zooming_at_the_pivot_itself_does_nothing() {
        let mut camera = Camera::default();
        let pivot = camera.position;
        zoom(&mut camera, pivot, -3.0);
        assert_eq!(camera, Camera::default());
    }

    fn any_finite() -> impl Strategy<Value = f64> + Clone {
        prop_oneof![-1e3..1e3, proptest::num::f64::NORMAL | proptest::num::f64::ZERO | proptest::num::f64::SUBNORMAL]
    }

    fn any_vector(component: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = DVec3> {
        (component.clone(), component.clone(), component).prop_map(DVec3::from)
    }

    fn valid_camera() -> impl Strategy<Value = Camera> {
        let vector = || any_vector(prop_oneof![-1.0..1.0, -1e30..1e30, -1e-30..1e-30]);
        (vector(), vector(), vector())
            .prop_map(|(position, direction, up)| Camera { position, direction, up, ..Camera::default() })
            .prop_filter("a valid camera", is_valid)
    }

    fn is_valid(camera: &Camera) -> bool {
        Scene { camera: camera.clone(), ..Scene::default() }.validate().is_ok()
    }

    proptest! {
        #[test]
        fn a_valid_camera_stays_valid_whatever_comes_in(
            camera in valid_camera(),
            pivot in any_vector(any_finite()),
            wish in any_vector(any_finite()),
            (x, y, steps, seconds, speed) in (any_finite(), any_finite(), any_finite(), any_finite(), any_finite()),
        ) {
            let wish = Flight { ahead: wish.x, left: wish.y, up: wish.z };
            let moves: [&dyn Fn(&mut Camera); 4] = [
                &|camera| look(camera, DVec2::new(x, y), true),
                &|camera| fly(camera, wish, seconds, speed),
                &|camera| orbit(camera, pivot, DVec2::new(x, y)),
                &|camera| zoom(camera, pivot, steps),
            ];
            for (index, change) in moves.iter().enumerate() {
                let mut moved = camera.clone();
                change(&mut moved);
                prop_assert!(is_valid(&moved), "move {index}: {moved:?}");
                prop_assert_eq!(moved.up, camera.up);
            }
        }
    }
}
