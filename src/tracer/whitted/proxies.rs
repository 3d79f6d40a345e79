//! What the search tests before the kernel solves anything: the proxies of `glsl/search/proxies.glsl` and the boxes of
//! `hierarchy.glsl`, rounded conservatively. Scene space.

use glam::DVec3;
use rayon::prelude::*;

use super::hierarchy::{GROUP, Level};
use super::rows::{row, unit};
use crate::plan::is_rotated;
use crate::scene::{Bounds, SceneSpace, Solid, SolidKind};

/// A row of the texel buffer.
type Row = [f32; 4];

/// `place_error` of `glsl/search/traversal.glsl`.
fn place_error(frame: SceneSpace) -> f32 {
    8.0 * f32::EPSILON * frame.reach
}

/// `DISTANCE_ERROR` of `glsl/search/proxies.glsl`.
const DISTANCE_ERROR: f64 = 8.0 * f32::EPSILON as f64;

/// A size that no ray finds a way through.
const IMPOSSIBLE: f32 = -1e30;

/// One row for a sphere, two for the others.
pub fn proxy(solid: &Solid, bounds: Bounds, frame: SceneSpace) -> impl Iterator<Item = Row> + use<> {
    let narrow = |vector: DVec3, fourth: f64| row(vector, fourth).map(|number| number as f32);
    let scale = frame.scale;
    let (first, second) = match *solid {
        Solid::Sphere { center, radius } => {
            let radius = radius * scale;
            let mut sphere =
                narrow(frame.point(center), radius * (1.0 + DISTANCE_ERROR) + f64::from(place_error(frame)));
            sphere[3] = sphere[3].next_up();
            (sphere, None)
        }
        Solid::Box { .. } => {
            let [middle, half_size] = box_rows(bounds, frame, 2.0, if is_rotated(solid) { 0.0 } else { 1.0 });
            (middle, Some(half_size))
        }
        Solid::Cylinder { ends: [a, b], radius } => {
            let (half_a, half_b) = (frame.point(a) * 0.5, frame.point(b) * 0.5);
            let half_axis = half_b - half_a;
            let axis = unit((half_axis, DVec3::ZERO)).0;
            (narrow(half_a + half_b, radius * scale), Some(narrow(axis, half_axis.length())))
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let height = height * scale;
            let base_radius = height * half_angle_degrees.to_radians().tan();
            (narrow(frame.point(apex), height), Some(narrow(axis, base_radius)))
        }
    };
    [first].into_iter().chain(second)
}

/// What makes a group whole: a proxy that is never met.
pub fn nothing(kind: SolidKind) -> Vec<Row> {
    match kind {
        SolidKind::Sphere => vec![[0.0, 0.0, 0.0, IMPOSSIBLE]],
        SolidKind::Box => NO_BOX.to_vec(),
        SolidKind::Cylinder | SolidKind::Cone => vec![[0.0; 4], [0.0, 0.0, 0.0, -1.0]],
    }
}

const NO_BOX: [Row; 2] = [[0.0; 4], [IMPOSSIBLE, IMPOSSIBLE, IMPOSSIBLE, 0.0]];

/// Centre and half size, rounded outwards by so many place errors.
fn box_rows(bounds: Bounds, frame: SceneSpace, place_errors: f32, fourth: f32) -> [Row; 2] {
    let [x, y, z] = bounds.low.midpoint(bounds.high).as_vec3().to_array();
    let [half_x, half_y, half_z] = ((bounds.high - bounds.low) * 0.5).as_vec3().to_array();
    let outwards = place_errors * place_error(frame);
    [[x, y, z, 0.0], [half_x + outwards, half_y + outwards, half_z + outwards, fourth]]
}

/// Two rows a box, in whole groups. `height`: of the level, from 1 on.
///
/// As the kernel computes it, no box is entered before the one around it: either t is off by a place error at most, at
/// a slope of 1, the rows by half of one, and each level is larger than what is in it by four.
pub fn level_rows(level: &Level, height: usize, frame: SceneSpace) -> Vec<Row> {
    let place_errors = (4 * height - 2) as f32;
    let boxes = level.boxes.par_iter().enumerate();
    let mut rows: Vec<_> = boxes
        .flat_map_iter(|(index, bounds)| box_rows(*bounds, frame, place_errors, level.orders[index / GROUP] as f32))
        .collect();
    let missing = level.boxes.len().next_multiple_of(GROUP) - level.boxes.len();
    rows.extend(std::iter::repeat_n(NO_BOX, missing).flatten());
    rows
}
