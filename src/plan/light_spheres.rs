//! Which light spheres the camera may see, and where in its picture.

use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use glam::{DVec2, DVec3};

use super::solids::unit;
use super::{Decision, Reason};
use crate::scene::{Camera, Light, Projection, Scene, farthest_coordinate};

/// What kernels may be off in a direction or a position, relative to distances between the camera, the light and the
/// solids, among which their frame has its origin: of an `f32` of `u` = 6e-8, a hundredfold.
const SURELY: f64 = 1e-5;

/// How many may be seen.
pub(super) fn decide(scene: &Scene, [width, height]: [u32; 2]) -> Decision<usize> {
    let lights = scene.lights.len();
    let aspect = f64::from(width) / f64::from(height);
    // No distance is larger than its largest coordinate by more than the square root of three.
    let farthest = 2.0 * farthest_coordinate(&scene.primitives, scene.camera.position);
    let seen = |light: &&Light| Area::of_light_sphere(light, &scene.camera, aspect, farthest).is_some();
    let choice = scene.lights.iter().filter(seen).count();
    let reason = match (lights, choice) {
        (0, _) => Reason::NoLights,
        (_, 0) => Reason::LightSpheresOutOfSight { lights },
        (lights, seen) => Reason::LightSpheresInSight { lights, seen },
    };
    Decision { choice, reason }
}

/// A rectangle of a picture, in fractions of its width and height, from the top left corner; it may reach beyond the
/// picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    low: DVec2,
    high: DVec2,
}

impl Area {
    /// Outside of it no primary ray meets a light sphere; `None` where none does anywhere. `aspect`: width by height;
    /// `farthest`: no solid has a part that far from the camera.
    pub fn of_light_spheres(scene: &Scene, aspect: f64, farthest: f64) -> Option<Self> {
        let areas =
            scene.lights.iter().filter_map(|light| Self::of_light_sphere(light, &scene.camera, aspect, farthest));
        areas.reduce(|a, b| Self { low: a.low.min(b.low), high: a.high.max(b.high) })
    }

    fn of_light_sphere(light: &Light, camera: &Camera, aspect: f64, farthest: f64) -> Option<Self> {
        let Camera { position, direction, up, vertical_fov_degrees, projection } = *camera;
        let ahead = unit(direction);
        let left = unit(unit(up).cross(ahead));
        let up = ahead.cross(left);
        let half_height = (vertical_fov_degrees.to_radians() / 2.0).tan();
        let half_width = half_height * aspect;
        // Where the picture ends to the left and right, below and above, in half extents (docs/course-work.md, "Primary
        // rays").
        let ([right_end, left_end], [low_end, high_end]) = match projection {
            Projection::Centered => ([-1.0, 1.0], [-1.0, 1.0]),
            Projection::Course => ([-1.0, 3.0], [-3.0, 1.0]),
        };
        let to_light = light.position - position;
        if light.radius == 0.0 {
            return None;
        }
        // Coordinates of the world are differed in `f64`, each rounded once.
        let rounding = 4.0 * f64::EPSILON * light.position.length().max(position.length());
        let radius = light.radius + SURELY * (to_light.length() + farthest) + rounding;
        // From the picture's first edge, at a slope of `first` half extents, to the last one.
        let part = |across: DVec3, half_extent: f64, first: f64, last: f64| {
            let (least, greatest) = slopes(to_light.dot(across), to_light.dot(ahead), radius)?;
            let place = |slope: f64| (first - slope / half_extent) / (first - last);
            let (low, high) = (place(greatest), place(least));
            // What is not a number, of points beyond all bounds, may be seen anywhere.
            if low.is_nan() || high.is_nan() {
                return Some((f64::NEG_INFINITY, f64::INFINITY));
            }
            (low <= 1.0 && high >= 0.0).then_some((low, high))
        };
        let (left_edge, right_edge) = part(left, half_width, left_end, right_end)?;
        let (top, bottom) = part(up, half_height, high_end, low_end)?;
        Some(Self { low: DVec2::new(left_edge, top), high: DVec2::new(right_edge, bottom) })
    }

    /// Along x and y, of a picture of `size`, and one more to each side: pixels are taken at their centres, with
    /// rounding.
    pub fn pixels(self, size: [u32; 2]) -> [Range<u32>; 2] {
        let along = |axis: usize| {
            let count = f64::from(size[axis]);
            // Within the picture, so that the numbers are small.
            let pixel = |place: f64| place.clamp(0.0, 1.0) * count;
            let first = (pixel(self.low[axis]).floor() - 1.0).max(0.0);
            let end = (pixel(self.high[axis]).ceil() + 1.0).min(count);
            first as u32..end as u32
        };
        [along(0), along(1)]
    }
}

/// The least and the greatest slope, across by ahead, of the lines from the origin that meet a disk ahead of it; `None`
/// where it lies behind.
fn slopes(across: f64, ahead: f64, radius: f64) -> Option<(f64, f64)> {
    let distance = across.hypot(ahead);
    // Not a number: anywhere.
    if distance.is_nan() || distance <= radius {
        return Some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (middle, half) = (across.atan2(ahead), (radius / distance).asin());
    let (least, greatest) = (middle - half, middle + half);
    if least >= FRAC_PI_2 || greatest <= -FRAC_PI_2 {
        return None;
    }
    let slope = |angle: f64| if angle.abs() >= FRAC_PI_2 { f64::INFINITY.copysign(angle) } else { angle.tan() };
    Some((slope(least), slope(greatest)))
}
