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

/// The nine ranks, path tracing taken at so many samples; fewer where an algorithm was not measured.
///
/// A picture's distance to a truth that is itself off by s is off by s at most (the triangle's inequality), so that two
/// errors that differ by no more than 2s cannot be told apart.
pub fn ranks(scene: &SceneComparison, path_samples: u32) -> Vec<Rank> {
    let is_of_table = |measured: &&Measured| {
        let is_statistical = measured.algorithm.description().is_statistical;
        measured.samples == if is_statistical { path_samples } else { 1 }
    };
    let columns: Vec<&Measured> = scene.measured.iter().filter(is_of_table).collect();
    let time_ms = |measured: &Measured| measured.time_ms().unwrap_or(f64::INFINITY);
    let least = 2.0 * scene.truth_standard_error;
    // One more than there are before it.
    let rank =
        |is_before: &dyn Fn(&Measured) -> bool| 1 + columns.iter().filter(|other| is_before(other)).count() as u32;
    let ranks_of = |column: &&Measured| {
        let algorithm = column.algorithm;
        let [time_noted, realism_noted, noise_noted] = algorithm.description().table_1_1?;
        let by_time = rank(&|other| time_ms(other) < time_ms(column));
        let by_error = rank(&|other| other.rmse > column.rmse + least);
        let cell = |criterion, noted, measured| Rank { criterion, algorithm, noted, measured };
        Some([
            cell(Criterion::FrameTime, time_noted, by_time),
            cell(Criterion::Realism, realism_noted, by_error),
            cell(Criterion::Noise, noise_noted, u32::from(column.noise > 0.0)),
        ])
    };
    columns.iter().filter_map(ranks_of).flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Frame;

    fn measured(algorithm: Algorithm, samples: u32, time_ns: u64, rmse: f64, noise: f64) -> Measured {
        let picture = Frame::new(1, 1).unwrap();
        Measured { algorithm, samples, times_ns: vec![time_ns], rmse, flip: 0.0, largest: 0.0, noise, picture }
    }

    fn found(ssr: Measured, truth_standard_error: f64) -> Vec<[u32; 3]> {
        let scene = SceneComparison {
            scene: "a scene".to_owned(),
            solids: 1,
            max_depth: 1,
            truth_samples: 1,
            truth_standard_error,
            measured: vec![
                measured(Algorithm::Whitted, 1, 20, 0.1, 0.0),
                measured(Algorithm::Whitted, 16, 1, 0.0, 0.0),
                ssr,
                measured(Algorithm::Path, 1, 15, 0.5, 0.5),
                measured(Algorithm::Path, 256, 900, 0.01, 0.01),
            ],
            truth: Frame::new(1, 1).unwrap(),
        };
        ranks(&scene, 256).chunks(3).map(|ranks| [0, 1, 2].map(|place| ranks[place].measured)).collect()
    }

    #[test]
    fn ranks_are_those_of_what_was_measured_and_what_cannot_be_told_apart_has_one() {
        let ssr = |time_ns, rmse| measured(Algorithm::Ssr, 1, time_ns, rmse, 0.0);
        // As the note has it.
        assert_eq!(found(ssr(10, 0.2), 1e-3), [[2, 2, 0], [1, 1, 0], [3, 3, 1]]);
        assert_eq!(found(ssr(30, 0.05), 1e-3), [[1, 1, 0], [2, 2, 0], [3, 3, 1]]);
        // Below twice the truth's own error, and above.
        assert_eq!(found(ssr(10, 0.1015), 1e-3), [[2, 1, 0], [1, 1, 0], [3, 3, 1]]);
        assert_eq!(found(ssr(10, 0.1025), 1e-3), [[2, 2, 0], [1, 1, 0], [3, 3, 1]]);
    }
}
