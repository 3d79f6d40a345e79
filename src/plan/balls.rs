//! Which lights' balls the camera may see.

use glam::DVec3;

use super::{Decision, Reason, Wishes};
use crate::scene::{Camera, Light, Projection, Scene};

/// What kernels may be off in a direction or a place, relative to its distance: of an `f32` of `u` = 6e-8, a hundredfold.
const SURELY: f64 = 1e-5;

/// How many may be seen.
pub(super) fn decide(scene: &Scene, wishes: &Wishes) -> Decision<usize> {
    let lights = scene.lights.len();
    let window = Window::of(&scene.camera, f64::from(wishes.width) / f64::from(wishes.height));
    let choice = scene.lights.iter().filter(|light| window.may_show(light)).count();
    let reason = match (lights, choice) {
        (0, _) => Reason::NoLights,
        (_, 0) => Reason::BallsOutOfSight { lights },
        (lights, seen) => Reason::BallsInSight { lights, seen },
    };
    Decision { choice, reason }
}

/// A picture's pyramid: the half-spaces it is in, of planes through the camera.
struct Window {
    camera: DVec3,
    /// Unit, outwards.
    normals: [DVec3; 5],
}

impl Window {
    fn of(camera: &Camera, aspect: f64) -> Self {
        let Camera { position, direction, up, vertical_fov_degrees, projection } = *camera;
        let ahead = unit(direction);
        let left = unit(unit(up).cross(ahead));
        let up = ahead.cross(left);
        let half_height = (vertical_fov_degrees.to_radians() / 2.0).tan();
        let half_width = half_height * aspect;
        // Where the picture ends to the left and right, below and above, in half extents (COURSE.md, «Primary rays»).
        let ([right_end, left_end], [low_end, high_end]) = match projection {
            Projection::Centered => ([-1.0, 1.0], [-1.0, 1.0]),
            Projection::Course => ([-1.0, 3.0], [-3.0, 1.0]),
        };
        let beyond = |side: DVec3, end: f64| (side - end * ahead).normalize();
        Self {
            camera: position,
            normals: [
                beyond(left, left_end * half_width),
                beyond(-left, -right_end * half_width),
                beyond(up, high_end * half_height),
                beyond(-up, -low_end * half_height),
                -ahead,
            ],
        }
    }

    fn may_show(&self, light: &Light) -> bool {
        let to_light = light.position - self.camera;
        let near = Light::BALL_RADIUS + SURELY * (to_light.abs().max_element() + light.position.abs().max_element());
        // What is not a number, of places beyond all bounds, may be seen.
        !self.normals.iter().any(|normal| to_light.dot(*normal) > near)
    }
}

fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize()
}
