//! The course work's own measurements, by its program on its author's machine.

use super::Speeds;
use crate::scene::SolidKind;

/// Table 4.1: kinds in the order of [`SolidKind::ALL`].
const TABLE: [(usize, [f64; 4]); 10] = [
    (10, [57.1419, 54.9538, 54.3946, 55.4482]),
    (20, [54.3279, 50.9881, 52.2229, 54.4413]),
    (30, [47.5699, 41.1863, 46.283, 51.0728]),
    (40, [42.3703, 29.4745, 37.9257, 42.2258]),
    (50, [33.1457, 24.6811, 31.8656, 35.819]),
    (60, [30.409, 20.0419, 27.4269, 31.1626]),
    (70, [26.0904, 16.3896, 24.1506, 26.0774]),
    (80, [23.2984, 14.2909, 21.2716, 23.4664]),
    (90, [22.4715, 12.416, 18.746, 20.8784]),
    (100, [18.6406, 11.0113, 16.4398, 19.3409]),
];

/// Table 4.1: frames a second, present to screen included, averaged over 30 s.
pub fn published() -> Speeds {
    let mut speeds = Speeds::default();
    for (count, row) in TABLE {
        SolidKind::ALL.into_iter().zip(row).for_each(|(kind, fps)| speeds.set(kind, count, fps));
    }
    speeds
}

/// The kinds with 100 solids, the fastest first, as the note's conclusion to table 4.1 has them.
pub const CLAIMED_ORDER: [SolidKind; 4] = [SolidKind::Cone, SolidKind::Sphere, SolidKind::Cylinder, SolidKind::Box];

/// How many times the frames of spheres the note counts with 100 solids of the kind.
pub const CLAIMED_OF_SPHERES: [(SolidKind, f64); 3] =
    [(SolidKind::Cone, 1.04), (SolidKind::Box, 1.0 / 1.70), (SolidKind::Cylinder, 1.0 / 1.13)];
