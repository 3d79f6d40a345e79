//! Random solids and rays in numbers that a precision stores exactly, and how far a point is from a solid.

use glam::DVec3;
use zerkalo::reference::{Hit, OriginSurface, Ray, Solids};
use zerkalo::scene::{Solid, SolidKind};
use zerkalo::tracer::Precision;

use super::{From, ProbeRay, stored, stored_vector};
use crate::oracle::rays::middle;
use crate::oracle::{primitive, size};
use crate::random::Random;

/// Largest distance of a ray's origin from the solid, in sizes: DS of the catalogue ends there, and so do the digits of
/// a number with its error.
const FARTHEST: f64 = 1e7;

/// A solid with its reference.
pub struct Case {
    pub solid: Solid,
    pub size: f64,
    /// Largest distance of a ray's origin, in sizes.
    farthest: f64,
    reference: Solids,
}

impl Case {
    /// Any pose and proportion, every number as the precision stores it.
    pub fn random(random: &mut Random, kind: SolidKind, precision: Precision) -> Self {
        Self { farthest: FARTHEST, ..Self::changed(random, kind, precision, |_, solid| solid) }
    }

    /// As a picture's scene lies in the kernel's frame: no coordinate of a solid or a ray's origin is larger than 2.
    pub fn in_scene_space(random: &mut Random, kind: SolidKind, precision: Precision) -> Self {
        let case = Self::changed(random, kind, precision, |random, solid| {
            let scale = random.magnitude(-5.0, -0.5) / size(&solid);
            let from = middle(&solid);
            let target = random.unit_vector() * random.uniform(0.0, 0.6);
            let place = |point: DVec3| (point - from) * scale + target;
            match solid {
                Solid::Sphere { center, radius } => Solid::Sphere { center: place(center), radius: radius * scale },
                Solid::Box { center, half_size, rotation_degrees } => {
                    Solid::Box { center: place(center), half_size: half_size * scale, rotation_degrees }
                }
                Solid::Cylinder { ends, radius } => Solid::Cylinder { ends: ends.map(place), radius: radius * scale },
                Solid::Cone { apex, axis, height, half_angle_degrees } => {
                    Solid::Cone { apex: place(apex), axis, height: height * scale, half_angle_degrees }
                }
            }
        });
        Self { farthest: 1.0 / case.size, ..case }
    }

    fn changed(
        random: &mut Random,
        kind: SolidKind,
        precision: Precision,
        change: impl Fn(&mut Random, Solid) -> Solid,
    ) -> Self {
        let number = |value| stored(precision, value);
        let vector = |value| stored_vector(precision, value);
        let solid = loop {
            let changed = random.solid(kind);
            let solid = match change(random, changed) {
                Solid::Sphere { center, radius } => Solid::Sphere { center: vector(center), radius: number(radius) },
                Solid::Box { center, half_size, rotation_degrees } => {
                    Solid::Box { center: vector(center), half_size: vector(half_size), rotation_degrees }
                }
                Solid::Cylinder { ends, radius } => Solid::Cylinder { ends: ends.map(vector), radius: number(radius) },
                Solid::Cone { apex, axis, height, half_angle_degrees } => {
                    Solid::Cone { apex: vector(apex), axis, height: number(height), half_angle_degrees }
                }
            };
            if !matches!(solid, Solid::Cylinder { ends: [a, b], .. } if a == b) {
                break solid;
            }
        };
        let reference = Solids::new(&[primitive(solid.clone())]);
        Self { size: size(&solid), farthest: FARTHEST, reference, solid }
    }

    /// By the reference.
    pub fn cast(&self, ray: &ProbeRay, origin_surface: OriginSurface) -> Option<Hit> {
        self.reference.nearest(&Ray { origin: ray.origin, direction: ray.direction }, origin_surface)
    }

    /// A fan of rays from one origin: every second one within 10⁻² of the silhouette, down to the precision's last bit,
    /// which is told.
    pub fn fan(&self, random: &mut Random, precision: Precision, index: usize, count: u32) -> Vec<(ProbeRay, bool)> {
        let middle = middle(&self.solid);
        let origin = loop {
            let distance = match random.uniform(0.0, 6.0) {
                inside if inside < 1.0 => inside * random.magnitude(-3.0, 0.0),
                near if near < 3.0 => random.magnitude(-2.0, 3.0),
                _ => random.magnitude(0.0, self.farthest.log10()),
            };
            let origin = stored_vector(precision, middle + random.unit_vector() * self.size * distance);
            if (origin - middle).length() <= self.farthest * self.size {
                break origin;
            }
        };
        let towards = |target: DVec3| {
            let direction = stored_vector(precision, (target - origin).normalize());
            ProbeRay { origin, direction, solid: index, from: From::Space }
        };
        let around = random.unit_vector();
        let sideways = (middle - origin).cross(around).normalize() * 4.0 * self.size;
        let silhouette = self.silhouette(|offset| towards(middle + sideways * offset));
        let closest = precision.unit_roundoff().log10();
        let mut rays = Vec::new();
        while rays.len() < count as usize {
            let is_near = random.chance(0.5);
            let target = if is_near {
                middle + sideways * (silhouette * (1.0 + random.signed_magnitude(closest, -2.0)))
            } else {
                middle + random.unit_vector() * self.size * random.uniform(0.0, 1.2)
            };
            let ray = towards(target);
            if ray.direction.is_finite() {
                rays.push((ray, is_near));
            }
        }
        rays
    }

    fn silhouette(&self, ray_at: impl Fn(f64) -> ProbeRay) -> f64 {
        let (mut hits, mut misses) = (0.0, 1.0);
        for _ in 0..50 {
            let middle = 0.5 * (hits + misses);
            if self.cast(&ray_at(middle), OriginSurface::Free).is_some() {
                hits = middle;
            } else {
                misses = middle;
            }
        }
        hits
    }

    /// Of origin + path from the surface.
    pub fn distance(&self, origin: DVec3, path: DVec3) -> f64 {
        zerkalo::measure::stability::distance(&self.solid, origin, path)
    }
}
