//! The tables for people.

use super::ranks::{Criterion, Rank, ranks};
use super::{Comparison, Measured, SceneComparison};
use crate::measure::output::{Entry, Table, Words, figure};
use crate::settings::three_digits;

/// Title, machine, what the columns mean, and a section a scene.
pub fn blocks(comparison: &Comparison) -> Vec<String> {
    let Comparison { machine, conditions, scenes } = comparison;
    let legend = [
        format!("- device: {} ({})", machine.device, machine.driver),
        format!("- program: {}", machine.program),
        format!("- picture: {}x{} pixels, {} of each algorithm", conditions.width, conditions.height, conditions.seeds),
        "- ms: time of a picture, median; error: to the truth, which is path tracing by all seeds together (each seed is \
         judged by the others); noise: standard deviation between the pictures"
            .to_owned(),
    ];
    let mut blocks = vec!["# Table 1.1, measured".to_owned(), legend.join("\n")];
    for scene in scenes {
        blocks.push(format!("## {}: {} solids, {} generations", scene.scene, scene.solids, scene.max_depth));
        blocks.push(format!(
            "The truth: {} samples a pixel, standard error {}.",
            scene.truth_samples,
            three_digits(scene.truth_standard_error)
        ));
        blocks.push(figures(scene).to_markdown());
        for &samples in &conditions.samples {
            blocks.push(format!("The note's ranks, path tracing by {samples} samples:"));
            blocks.push(verdicts(&ranks(scene, samples)).to_markdown());
        }
    }
    blocks
}

/// A row an algorithm and number of samples.
pub fn figures(scene: &SceneComparison) -> Table {
    let head = vec![
        Words::both("algorithm", "алгоритм"),
        Words::both("ms", "мс"),
        Words::both("RMSE", "СКО"),
        "FLIP".into(),
        Words::both("largest error", "наибольшая ошибка"),
        Words::both("noise", "шум"),
    ];
    let row = |measured: &Measured| {
        vec![
            Entry::of(measured.name()),
            Entry::maybe(measured.time_ms().map(figure)),
            Entry::of(three_digits(measured.rmse)),
            Entry::of(three_digits(measured.flip)),
            Entry::of(three_digits(measured.largest)),
            Entry::of(three_digits(measured.noise)),
        ]
    };
    Table { head, rows: scene.measured.iter().map(row).collect() }
}

/// The note's table, each cell with what was measured.
pub fn verdicts(ranks: &[Rank]) -> Table {
    let mut algorithms: Vec<_> = ranks.iter().map(|rank| rank.algorithm).collect();
    algorithms.dedup();
    let criteria = [
        (Criterion::FrameTime, Words::both("frame time (1: the quickest)", "время кадра (1: быстрейший)")),
        (Criterion::Realism, Words::both("realism (1: the least)", "реалистичность (1: наименьшая)")),
        (Criterion::Noise, Words::both("noise", "шум")),
    ];
    let in_words = |criterion, rank: u32| match criterion {
        Criterion::Noise => Words::yes_no(rank > 0),
        Criterion::FrameTime | Criterion::Realism => rank.into(),
    };
    let entry = |rank: Option<&Rank>| {
        let Some(rank) = rank else { return Entry::Absent };
        let [noted, measured] = [rank.noted, rank.measured].map(|value| in_words(rank.criterion, value));
        if rank.holds() {
            Entry::of(Words::both(format!("{}, holds", noted.english), format!("{}, верно", noted.russian)))
        } else {
            Entry::Lacking(Words::both(
                format!("{}, is {}", noted.english, measured.english),
                format!("{}, на деле {}", noted.russian, measured.russian),
            ))
        }
    };
    let rows = criteria.into_iter().map(|(criterion, name)| {
        let of = |algorithm| ranks.iter().find(|rank| (rank.criterion, rank.algorithm) == (criterion, algorithm));
        [Entry::of(name)].into_iter().chain(algorithms.iter().map(|&algorithm| entry(of(algorithm)))).collect()
    });
    let head = [Words::both("note", "записка")].into_iter();
    let head = head.chain(algorithms.iter().map(|algorithm| algorithm.name().into())).collect();
    Table { head, rows: rows.collect() }
}
