//! What a scene takes of a device's memory.

use super::{LightFeatures, Limits, PlanError, Precision, Structure};
use crate::scene::SolidKind;

/// Rows of four numbers in the kernel's records: of a solid of each kind, of its proxy, of a box around solids and of
/// the view (`glsl/records/scene.glsl`).
const SOLID_ROWS: [usize; 4] = [1, 7, 4, 4];
const CLOSE_UP_ROWS: [usize; 4] = [3, 7, 5, 4];
pub(crate) const VIEW_ROWS: usize = 7;
const PROXY_ROWS: [usize; 4] = [1, 2, 2, 2];
const BOX_ROWS: usize = 2;

/// Rows of a solid of that kind.
pub(crate) fn solid_row_count(kind: SolidKind, is_close_up: bool) -> usize {
    if is_close_up { CLOSE_UP_ROWS[kind as usize] } else { SOLID_ROWS[kind as usize] }
}

/// Refuses a scene that does not fit the device's arrays. Solids and boxes come in whole groups.
pub(super) fn check_arrays(
    counts: [usize; 4],
    lights: usize,
    light_features: LightFeatures,
    precision: Precision,
    is_close_up: bool,
    limits: &Limits,
) -> Result<(), PlanError> {
    let whole = |count: usize| count.next_multiple_of(Structure::GROUP);
    let boxes_over = |count: usize| -> usize {
        let levels = match Structure::over(count) {
            Structure::None => 0,
            Structure::Hierarchy { levels } => levels,
        };
        (1..=levels).map(|level| whole(count.div_ceil(Structure::GROUP.pow(level)))).sum()
    };
    let of_kind = |kind: usize| PROXY_ROWS[kind] * whole(counts[kind]) + BOX_ROWS * boxes_over(counts[kind]);
    let [spheres, boxes, cylinders, cones] =
        SolidKind::ALL.map(|kind| solid_row_count(kind, is_close_up) * whole(counts[kind as usize]));
    let row_bytes = match precision {
        Precision::F32 => 16,
        Precision::F64 => 32,
    };
    let own = [
        ("view and lights", VIEW_ROWS + light_features.light_rows() * lights),
        ("spheres", spheres),
        ("boxes", boxes),
        ("cylinders", cylinders),
        ("cones", cones),
        ("materials", light_features.material_rows() * counts.map(whole).iter().sum::<usize>()),
    ];
    // The proxies are of `f32` for either precision.
    let proxies = ("proxies", 16 * (0..4).map(of_kind).sum::<usize>() as u64);
    let limit = limits.max_array_bytes;
    let mut arrays = own.into_iter().map(|(array, rows)| (array, rows as u64 * row_bytes)).chain([proxies]);
    match arrays.find(|&(_, bytes)| bytes > limit) {
        Some((array, bytes)) => Err(PlanError::TooLarge { array, bytes, limit, precision }),
        None => Ok(()),
    }
}
