//! What a kernel calculates in, and what rounding then moves.

use glam::DVec3;

use super::ceiling::brightest_source;
use super::lengths::Lengths;
use super::rounding::{self, Rounding};
use super::solids::{self, outside_by};
use super::{Decision, Limits, PlanError, Reason};
use crate::algorithm::{Kernel, Precision};
use crate::scene::{Camera, Projection, Solid};
use crate::settings::RenderSettings;

/// Silhouettes that move by less change only pixels that they run through.
const LARGEST_SHIFT_PIXELS: f64 = 0.5;

/// As asked for, else f32 unless that is known to be wrong, or an error is allowed that f32 may exceed by rounding
/// alone; with what rounding to f32 does, where that was looked at.
pub(super) fn choose(
    lengths: &Lengths,
    settings: &RenderSettings,
    size: [u32; 2],
    limits: &Limits,
) -> Result<(Decision<Precision>, Option<Rounding>), PlanError> {
    let decide = |choice, reason| Decision { choice, reason };
    if let [only] = *settings.algorithm.description().precisions {
        return Ok((decide(only, Reason::OnlyOne), None));
    }
    match settings.precision {
        Some(Precision::F64) if !limits.float64 => return Err(PlanError::NoFloat64),
        Some(precision) => return Ok((decide(precision, Reason::Asked), None)),
        None => {}
    }
    let shift_pixels = silhouette_shift_pixels(lengths, size);
    let tolerance = Precision::F32.rounding_tolerance() * brightest_source(lengths.scene).max(1.0);
    let rounding = rounding_to_f32(lengths, settings, size, shift_pixels);
    let may_err = settings.error > 0.0;
    let (choice, reason) = match rounding {
        Rounding::Harmful { wrong, tried, cause } => (Precision::F64, Reason::RoundingSpoils { wrong, tried, cause }),
        Rounding::Unknown { ratio } => (Precision::F64, Reason::RoundingIsUnknown { ratio }),
        _ if may_err && settings.error < tolerance => (Precision::F64, Reason::RoundingExceedsError { tolerance }),
        _ if may_err && shift_pixels > LARGEST_SHIFT_PIXELS => {
            (Precision::F64, Reason::RoundingMovesSilhouettes { shift_pixels })
        }
        _ if may_err => (Precision::F32, Reason::RoundingIsWithinError { tolerance, shift_pixels }),
        Rounding::Harmless { tried } => (Precision::F32, Reason::RoundingIsHarmless { tried, tolerance }),
        Rounding::Mild => (Precision::F32, Reason::RoundingIsNoCut { tolerance, shift_pixels }),
    };
    let decision = match (choice, reason) {
        (Precision::F64, _) if limits.float64 => decide(choice, reason),
        // These say what is wrong, whatever draws.
        (_, Reason::RoundingSpoils { .. } | Reason::RoundingIsUnknown { .. }) => decide(Precision::F32, reason),
        (Precision::F64, _) => decide(Precision::F32, Reason::NoFloat64 { tolerance, shift_pixels }),
        (Precision::F32, _) => decide(choice, reason),
    };
    Ok((decision, Some(rounding)))
}

/// What it does to the picture that is asked for, whose silhouettes it moves by so much.
fn rounding_to_f32(lengths: &Lengths, settings: &RenderSettings, size: [u32; 2], shift_pixels: f64) -> Rounding {
    rounding::of_f32(lengths, settings.max_depth.unwrap_or(lengths.scene.max_depth), size, shift_pixels)
}

/// What rounding to `f32` does to the picture that is asked for.
pub(super) fn try_f32(lengths: &Lengths, settings: &RenderSettings, size: [u32; 2]) -> Rounding {
    rounding_to_f32(lengths, settings, size, silhouette_shift_pixels(lengths, size))
}

/// No silhouette that the camera sees directly is drawn farther than that from where it is, in pixels, in `f32`. In
/// mirrors there is no such bound: a round one multiplies an angle's error at every reflection.
///
/// A kernel errs between hit and miss where the clearance is below 8u·size (docs/numerics.md, H); the stored solid is
/// off by u of its position, seen from the camera, and of its size; the ray's direction by less than 32u of the
/// window's extent.
///
/// In a close-up the size's part is taken by the way from the solid's anchor. That is the point nearest to the camera,
/// so that from a silhouette at a distance D it is at most 2D, and the position of the anchor at most D; of a cone the
/// anchor is the apex.
fn silhouette_shift_pixels(lengths: &Lengths, size: [u32; 2]) -> f64 {
    let [width, height] = size.map(f64::from);
    let u = Precision::F32.unit_roundoff();
    let Camera { position, vertical_fov_degrees, projection, .. } = lengths.scene.camera;
    let half_height = (vertical_fov_degrees.to_radians() / 2.0).tan();
    let half_width = half_height * width / height;
    // The window's farthest corner, and its height, in half extents.
    let (corner, window_height) = match projection {
        Projection::Centered => (1.0, 2.0),
        Projection::Course => (3.0, 4.0),
    };
    let corner = (corner * half_width).hypot(corner * half_height);
    // A turn by dθ moves an image by dθ·(1 + r²), r being its distance from the axis in the plane at distance 1.
    let pixels_per_radian = (1.0 + corner * corner) * height / (window_height * half_height);
    let is_close_up = lengths.close_up(Kernel::Whitted(Precision::F32)).is_some();
    let solid_shift = |solid: &Solid| {
        let size = match solid {
            Solid::Sphere { .. } | Solid::Box { .. } | Solid::Cylinder { .. } if is_close_up => return 9.0 * 2.0 + 1.0,
            _ => solids::size(solid),
        };
        let from_camera = (solid.position() - position).length();
        let distance = nearest_silhouette(solid, position);
        if distance > 0.0 { (9.0 * size + from_camera) / distance } else { 0.0 }
    };
    let angle = lengths.scene.primitives.iter().map(|primitive| solid_shift(&primitive.solid)).fold(0.0, f64::max);
    u * (angle + 32.0 * (1.0 + corner)) * pixels_per_radian
}

/// A lower bound on the distance of a solid's silhouette; 0 from inside, where there is none.
fn nearest_silhouette(solid: &Solid, camera: DVec3) -> f64 {
    let outside_by = outside_by(solid, camera).max(0.0);
    match *solid {
        // The tangent's length: r + d is the distance of the centre.
        Solid::Sphere { radius, .. } => (outside_by * (2.0 * radius + outside_by)).sqrt(),
        Solid::Box { .. } | Solid::Cylinder { .. } | Solid::Cone { .. } => outside_by,
    }
}
