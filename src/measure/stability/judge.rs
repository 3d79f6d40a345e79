//! Hits against the reference's, by the tolerances of docs/numerics.md: T, P, N and H, each in units of its tolerance.

use glam::DVec3;

use super::Measured;
use crate::reference::{Hit, OriginSurface, Ray, Solids};
use crate::scene::{Primitive, Solid, world_from_box};
use crate::tracer::probe::{ProbeHit, ProbeRay};
use crate::tracer::{Kernel, Precision};

/// A solid in numbers that the kernel stores exactly, with the reference's answers about it.
pub(super) struct Judge {
    pub solid: Solid,
    /// The largest of its lengths.
    pub size: f64,
    kernel: Kernel,
    truth: Solids,
    grown: Solids,
    /// None where it shrinks to nothing.
    shrunk: Option<Solids>,
}

/// What was found of all rays.
#[derive(Debug, Default)]
pub(super) struct Tally {
    pub true_hits: usize,
    wrong: usize,
    not_finite: usize,
    wrong_surface: usize,
    t: f64,
    point: f64,
    normal: f64,
}

impl Judge {
    pub fn new(solid: &Solid, kernel: Kernel) -> Self {
        let solid = stored_solid(solid, kernel.precision());
        let size = size(&solid);
        // H: hit or miss may only be wrong where it hangs on that much.
        let band = 8.0
            * kernel.precision().unit_roundoff()
            * match solid {
                Solid::Cylinder { radius, .. } => radius,
                _ => size,
            };
        Self {
            truth: solids(&solid),
            grown: solids(&resized(&solid, band).unwrap_or_else(|| solid.clone())),
            shrunk: resized(&solid, -band).as_ref().map(solids),
            solid,
            size,
            kernel,
        }
    }

    pub fn true_hit(&self, ray: &ProbeRay) -> Option<Hit> {
        self.truth.nearest(&Ray { origin: ray.origin, direction: ray.direction }, OriginSurface::Free)
    }

    fn is_within_band(&self, ray: &ProbeRay) -> bool {
        let ray = Ray { origin: ray.origin, direction: ray.direction };
        let is_hit = |solids: &Solids| solids.nearest(&ray, OriginSurface::Free).is_some();
        is_hit(&self.grown) != self.shrunk.as_ref().is_some_and(is_hit)
    }

    /// Counts a free ray's hit.
    pub fn judge(&self, tally: &mut Tally, ray: &ProbeRay, hit: Option<&ProbeHit>) {
        let truth = self.true_hit(ray);
        tally.true_hits += usize::from(truth.is_some());
        let (hit, truth) = match (hit, truth) {
            (None, None) => return,
            (Some(hit), Some(truth)) => (hit, truth),
            _ => {
                tally.wrong += usize::from(!self.is_within_band(ray));
                return;
            }
        };
        if !hit.is_finite() {
            tally.not_finite += 1;
            return;
        }
        let precision = self.kernel.precision();
        let u = precision.unit_roundoff();
        let half_ulp = half_ulp(precision, hit.t);
        let t_bar = half_ulp + 4.0 * u * self.size;
        let cosine = truth.normal.dot(ray.direction).abs();
        let t_error = match precision {
            Precision::F32 => distance(&self.solid, ray.origin, hit.t * ray.direction),
            // An f64 distance would be no better than what it validates; to first order, the reference's t being
            // rounded.
            Precision::F64 => ((hit.t - truth.t).abs() * cosine - half_ulp).max(0.0),
        };
        tally.t = tally.t.max(t_error / t_bar);
        if hit.surface.is_some_and(|surface| surface != (truth.face, truth.side)) {
            // At an edge both faces are right, to the tolerance of t.
            let is_at_edge = (hit.t - truth.t).abs() <= 2.0 * t_bar / cosine.max(f64::MIN_POSITIVE) || t_error <= t_bar;
            tally.wrong_surface += usize::from(!is_at_edge);
            return;
        }
        let point_bar = 4.0 * u * (anchor(&self.solid).abs().max_element() + self.size);
        let point_error = match precision {
            Precision::F32 => distance(&self.solid, hit.point, DVec3::ZERO),
            Precision::F64 => truth.normal.dot(hit.point - truth.point).abs(),
        };
        tally.point = tally.point.max(point_error / point_bar);
        tally.normal = tally.normal.max((hit.normal - truth.normal).length() * cosine / (8.0 * u));
    }
}

impl Tally {
    /// `least_hits`: fewer true hits would prove nothing.
    pub fn measured(&self, least_hits: usize) -> Vec<Measured> {
        vec![
            Measured::none_of("wrong hits or misses (H)", self.wrong),
            Measured::none_of("hits with NaN or infinity", self.not_finite),
            Measured::none_of("wrong faces", self.wrong_surface),
            Measured { what: "t off the surface (T)", measured: self.t, bound: 1.0 },
            Measured { what: "point off the surface (P)", measured: self.point, bound: 1.0 },
            Measured { what: "normal (N)", measured: self.normal, bound: 1.0 },
            Measured::none_of("true hits too few to prove anything", least_hits.saturating_sub(self.true_hits)),
        ]
    }
}

fn half_ulp(precision: Precision, t: f64) -> f64 {
    match precision {
        Precision::F32 => (f64::from((t.abs() as f32).next_up()) - t.abs()) / 2.0,
        Precision::F64 => (t.abs().next_up() - t.abs()) / 2.0,
    }
}

fn solids(solid: &Solid) -> Solids {
    Solids::new(&[Primitive { name: None, solid: solid.clone(), material: Default::default() }])
}

/// The nearest number of a precision.
fn stored(value: f64, precision: Precision) -> f64 {
    match precision {
        Precision::F32 => f64::from(value as f32),
        Precision::F64 => value,
    }
}

pub(super) fn stored_vector(vector: DVec3, precision: Precision) -> DVec3 {
    DVec3::from_array(vector.to_array().map(|value| stored(value, precision)))
}

/// Axes and angles stay: the kernel gets them as pairs of numbers, or their sines.
fn stored_solid(solid: &Solid, precision: Precision) -> Solid {
    let number = |value| stored(value, precision);
    let vector = |value| stored_vector(value, precision);
    match *solid {
        Solid::Sphere { center, radius } => Solid::Sphere { center: vector(center), radius: number(radius) },
        Solid::Box { center, half_size, rotation_degrees } => {
            Solid::Box { center: vector(center), half_size: vector(half_size), rotation_degrees }
        }
        Solid::Cylinder { ends, radius } => Solid::Cylinder { ends: ends.map(vector), radius: number(radius) },
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            Solid::Cone { apex: vector(apex), axis, height: number(height), half_angle_degrees }
        }
    }
}

/// The largest of a solid's lengths.
pub(super) fn size(solid: &Solid) -> f64 {
    match *solid {
        Solid::Sphere { radius, .. } => radius,
        Solid::Box { half_size, .. } => half_size.max_element(),
        Solid::Cylinder { ends: [a, b], radius } => radius.max((b - a).length() / 2.0),
        Solid::Cone { height, half_angle_degrees, .. } => height.max(height * half_angle_degrees.to_radians().tan()),
    }
}

/// Centre, or apex of a cone.
pub(super) fn anchor(solid: &Solid) -> DVec3 {
    match *solid {
        Solid::Sphere { center, .. } | Solid::Box { center, .. } => center,
        Solid::Cylinder { ends: [a, b], .. } => a.midpoint(b),
        Solid::Cone { apex, .. } => apex,
    }
}

/// Each face moved outwards by a length, or inwards by its opposite; `None` where nothing is left. Edges and apex stay
/// sharp.
pub fn resized(solid: &Solid, by: f64) -> Option<Solid> {
    match *solid {
        Solid::Sphere { center, radius } => {
            (radius + by > 0.0).then_some(Solid::Sphere { center, radius: radius + by })
        }
        Solid::Box { center, half_size, rotation_degrees } => {
            let half_size = half_size + by;
            (half_size.min_element() >= 0.0).then_some(Solid::Box { center, half_size, rotation_degrees })
        }
        Solid::Cylinder { ends: [a, b], radius } => {
            let length = (b - a).length();
            let shift = (b - a) * (by / length);
            let remains = radius + by > 0.0 && length + 2.0 * by > 0.0;
            remains.then_some(Solid::Cylinder { ends: [a - shift, b + shift], radius: radius + by })
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let beyond_apex = by / half_angle_degrees.to_radians().sin();
            let height = height + by + beyond_apex;
            let cone = Solid::Cone { apex: apex - axis * beyond_apex, axis, height, half_angle_degrees };
            (height > 0.0).then_some(cone)
        }
    }
}

/// Distance from the surface in plain `f64`, which is enough to validate an `f32`: from inside and near the surface
/// exactly, from elsewhere at most. The point is origin + path, summed only beside the solid: far from the world's
/// origin an `f64` does not hold it.
pub fn distance(solid: &Solid, origin: DVec3, path: DVec3) -> f64 {
    let from = |place: DVec3| (origin - place) + path;
    match *solid {
        Solid::Sphere { center, radius } => (from(center).length() - radius).abs(),
        Solid::Box { center, half_size, rotation_degrees } => {
            let above = (world_from_box(rotation_degrees).transpose() * from(center)).abs() - half_size;
            outside_or_inside(&above.to_array())
        }
        Solid::Cylinder { ends: [a, b], radius } => {
            let axis = (b - a).normalize();
            let (from_a, length) = (from(a), (b - a).length());
            let along = from_a.dot(axis);
            let radial = (from_a - axis * along).length();
            outside_or_inside(&[radial - radius, (along - length / 2.0).abs() - length / 2.0])
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let from_apex = from(apex);
            let along = from_apex.dot(axis);
            let radial = (from_apex - axis * along).length();
            let (sin, cos) = half_angle_degrees.to_radians().sin_cos();
            let beyond_apex = along * cos + radial * sin < 0.0;
            let side = if beyond_apex { from_apex.length() } else { radial * cos - along * sin };
            let base = if radial > height * sin / cos && along > height {
                (radial - height * sin / cos).hypot(along - height)
            } else {
                along - height
            };
            if side <= 0.0 && base <= 0.0 { side.max(base).abs() } else { side.max(base) }
        }
    }
}

/// From the signed distances to convex faces at right angles to each other.
fn outside_or_inside(above: &[f64]) -> f64 {
    let largest = above.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if largest <= 0.0 { -largest } else { above.iter().map(|a| a.max(0.0).powi(2)).sum::<f64>().sqrt() }
}
