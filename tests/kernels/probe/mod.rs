//! The accurate kernel's intersections a ray at a time: `glsl/probe/rays.comp`.
pub mod cases;

use glam::DVec3;
use zerkalo::reference::{Face, Side};
use zerkalo::tracer::Precision;
pub use zerkalo::tracer::probe::{From, Probe, ProbeHit, ProbeRay};

/// The nearest number of a precision.
pub fn stored(precision: Precision, value: f64) -> f64 {
    match precision {
        Precision::F32 => f64::from(value as f32),
        Precision::F64 => value,
    }
}

pub fn stored_vector(precision: Precision, vector: DVec3) -> DVec3 {
    DVec3::from_array(vector.to_array().map(|value| stored(precision, value)))
}

/// Where the accurate kernel says that the hit is.
pub fn surface(hit: &ProbeHit) -> (Face, Side) {
    hit.surface.expect("the accurate kernel tells")
}
