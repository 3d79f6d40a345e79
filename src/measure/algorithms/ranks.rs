//! The note's ranks, and whether they hold.

use serde::Serialize;

use super::{Measured, SceneComparison};
use crate::algorithm::Algorithm;

/// A row of the note's table 1.1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Criterion {
    /// The quickest is 1.
    FrameTime,
    /// The farthest from the truth is 1.
    Realism,
    /// 1 where pictures differ by chance, else 0.
    Noise,
}

/// A cell of the table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rank {
    /// Row.
    pub criterion: Criterion,
    /// Column.
    pub algorithm: Algorithm,
    /// By the note.
    pub noted: u32,
    /// As measured; algorithms that cannot be told apart have one rank.
    pub measured: u32,
}

impl Rank {
    /// Whether the note is right.
    pub fn holds(&self) -> bool {
        self.noted == self.measured
    }
}

/// Errors that differ by less, in parts of the larger, are the same: the truth's own noise is of that order.
const EQUAL_SHARE: f64 = 0.02;

/// Of what the note says of an algorithm: frame time, realism, noise.
fn noted(algorithm: Algorithm) -> Option<[u32; 3]> {
    algorithm.description().table_1_1
}

/// The nine ranks, path tracing taken at so many samples; fewer where an algorithm was not measured.
pub fn ranks(scene: &SceneComparison, path_samples: u32) -> Vec<Rank> {
    let of_table = |measured: &&Measured| {
        noted(measured.algorithm).is_some()
            && measured.samples == if measured.algorithm.description().is_statistical { path_samples } else { 1 }
    };
    let columns: Vec<&Measured> = scene.measured.iter().filter(of_table).collect();
    let rank = |value: f64, of: &dyn Fn(&Measured) -> f64, is_before: &dyn Fn(f64, f64) -> bool| {
        1 + columns.iter().filter(|other| is_before(of(other), value)).count() as u32
    };
    let time = |measured: &Measured| measured.time_ms().unwrap_or(f64::INFINITY);
    let mut ranks = Vec::new();
    for column in &columns {
        let Some([time_noted, realism_noted, noise_noted]) = noted(column.algorithm) else { continue };
        let by_time = rank(time(column), &time, &|other, own| other < own);
        let by_error = rank(column.rmse, &|measured| measured.rmse, &|other, own| {
            other > own * (1.0 + EQUAL_SHARE) + scene.truth_standard_error
        });
        let algorithm = column.algorithm;
        let cell = |criterion, noted, measured| Rank { criterion, algorithm, noted, measured };
        ranks.extend([
            cell(Criterion::FrameTime, time_noted, by_time),
            cell(Criterion::Realism, realism_noted, by_error),
            cell(Criterion::Noise, noise_noted, u32::from(column.noise > 0.0)),
        ]);
    }
    ranks
}
