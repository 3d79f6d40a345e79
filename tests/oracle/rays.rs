//! Solids and rays over all the scales the tolerances are set for.

use glam::DVec3;
use zerkalo::reference::Ray;
use zerkalo::scene::{Solid, SolidKind};

use super::{Subject, anchor};
use crate::random::Random;

impl Random {
    pub fn signed_magnitude(&mut self, low: f64, high: f64) -> f64 {
        let magnitude = self.magnitude(low, high);
        if self.chance(0.5) { magnitude } else { -magnitude }
    }

    /// Into the half-space about a normal; every third at 10^U(−16, 0) to the surface.
    pub fn direction_into(&mut self, normal: DVec3) -> DVec3 {
        let sample = self.unit_vector();
        let height = normal.dot(sample);
        if self.chance(1.0 / 3.0) {
            sample - normal * (height - self.magnitude(-16.0, 0.0))
        } else {
            sample * height.signum()
        }
    }

    /// Coordinates ±10^U(−8, 8), lengths 10^U(−4, 4), any pose, any proportion.
    pub fn solid(&mut self, kind: SolidKind) -> Solid {
        let position = self.vector(|random| random.signed_magnitude(-8.0, 8.0));
        match kind {
            SolidKind::Sphere => Solid::Sphere { center: position, radius: self.magnitude(-4.0, 4.0) },
            SolidKind::Box => Solid::Box {
                center: position,
                half_size: self.vector(|random| random.magnitude(-4.0, 4.0)),
                rotation_degrees: self.vector(|random| random.uniform(0.0, 360.0)),
            },
            SolidKind::Cylinder => {
                let axis = self.unit_vector() * self.magnitude(-4.0, 4.0);
                Solid::Cylinder { ends: [position, position + axis], radius: self.magnitude(-4.0, 4.0) }
            }
            SolidKind::Cone => {
                let half_angle_degrees = match self.uniform(0.0, 3.0) {
                    narrow if narrow < 1.0 => self.magnitude(-3.0, 1.0),
                    wide if wide < 2.0 => 90.0 - self.magnitude(-1.0, 1.0),
                    _ => self.uniform(5.0, 85.0),
                };
                let (axis, height) = (self.unit_vector(), self.magnitude(-4.0, 4.0));
                Solid::Cone { apex: position, axis, height, half_angle_degrees }
            }
        }
    }

    /// From anywhere (a third from near the solid, a sixth from inside), towards the solid's surroundings; half of the
    /// rays just past or just onto its silhouette as the reference sees it.
    pub fn ray_at(&mut self, subject: &Subject) -> Ray {
        let (middle, size) = (middle(&subject.solid), subject.size);
        let origin = match self.uniform(0.0, 6.0) {
            inside if inside < 1.0 => middle + self.unit_vector() * subject.least_length() * inside,
            near if near < 3.0 => middle + self.unit_vector() * size * self.magnitude(-2.0, 3.0),
            _ => self.vector(|random| random.signed_magnitude(-8.0, 8.0)),
        };
        self.ray_from(subject, origin)
    }

    /// Towards the solid's surroundings, every second ray close to the silhouette.
    pub fn ray_from(&mut self, subject: &Subject, origin: DVec3) -> Ray {
        let (middle, size) = (middle(&subject.solid), subject.size);
        let length = self.magnitude(-1.0, 1.0);
        let towards = |target: DVec3| Ray { origin, direction: (target - origin).normalize() * length };
        if self.chance(0.5) {
            return towards(middle + self.unit_vector() * size * self.uniform(0.0, 1.2));
        }
        let sideways = (middle - origin).cross(self.unit_vector()).normalize() * 4.0 * size;
        let silhouette = silhouette(subject, |offset| towards(middle + sideways * offset));
        towards(middle + sideways * (silhouette * (1.0 + self.signed_magnitude(-16.0, -2.0))))
    }
}

/// The offset in (0, 1) where a fan of rays leaves the solid.
fn silhouette(subject: &Subject, ray_at: impl Fn(f64) -> Ray) -> f64 {
    let (mut hits, mut misses) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (hits + misses);
        if subject.cast(&ray_at(middle)).is_some() {
            hits = middle;
        } else {
            misses = middle;
        }
    }
    hits
}

/// A point inside the solid.
pub fn middle(solid: &Solid) -> DVec3 {
    match *solid {
        Solid::Cone { apex, axis, height, .. } => apex + axis * height / 2.0,
        _ => anchor(solid),
    }
}
