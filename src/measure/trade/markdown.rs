//! Tables for people, with the answers in words.

use super::figures::{Figures, figures};
use super::{Conditions, Counted, Point, Question, SceneTrade, Target, Trade};
use crate::measure::Clock;
use crate::measure::output::markdown::{figure, in_line};
use crate::settings::three_digits;

/// Title, machine, what the columns mean, and a section a scene.
pub fn of(trade: &Trade) -> String {
    let mut lines = head(trade);
    for scene in &trade.scenes {
        lines.extend(of_scene(scene, &trade.conditions));
    }
    lines.join("\n") + "\n"
}

fn head(trade: &Trade) -> Vec<String> {
    let Trade { machine, conditions, scenes } = trade;
    let truth = match conditions.target {
        Target::Point => "the reference at the middle of every pixel",
        Target::Area => "the reference's mean over 8x8 points of every pixel",
    };
    let counted = match conditions.counted {
        Counted::AllPixels => "max abs",
        Counted::OffDiscontinuities => "off edges",
    };
    let clock = match scenes.first().map(|scene| scene.clock) {
        Some(Clock::Wall) => "wall time, for the device has no timestamps",
        Some(Clock::Gpu) | None => "GPU time",
    };
    let mut lines = vec![
        "# The price of accuracy".to_owned(),
        String::new(),
        format!("- device: {} ({})", machine.device, machine.driver),
        format!("- program: {}", machine.program),
        format!("- picture: {}x{} pixels; the truth is {truth}", conditions.width, conditions.height),
        format!(
            "- ms: {clock} of a frame, the median ratio to the baseline's frame beside it times the baseline's median; in \
             brackets the quartiles. The first line is the baseline against itself"
        ),
        "- max abs: largest error of a linear channel over all pixels; off edges: without pixels beside one whose ray \
         goes another way; edges: those of them that are more than 1/510 off"
            .to_owned(),
        "- bound: what is left out is proven to change no channel by more, rounding not in it; -: only measured, on this \
         scene from this camera"
            .to_owned(),
        format!("- front: no other setting is as fast and as accurate (ms, {counted}) and better in one of the two"),
    ];
    if conditions.validation {
        lines.push("- under validation: these times say nothing of the machine's".to_owned());
    }
    lines
}

fn of_scene(scene: &SceneTrade, conditions: &Conditions) -> Vec<String> {
    let figures = figures(scene, conditions);
    let mut lines = vec![
        String::new(),
        format!("## {}: {} solids, {} generations", scene.scene, scene.solids, scene.max_depth),
        String::new(),
    ];
    if !scene.complete {
        lines.extend([format!("Not complete: {} settings are measured.", scene.points.len()), String::new()]);
    }
    lines.extend(table(scene, &figures));
    if !scene.left_out.is_empty() {
        lines.extend([String::new(), "Not measured:".to_owned(), String::new()]);
        lines.extend(scene.left_out.iter().map(|left_out| format!("- {}: {}", left_out.setting, left_out.reason)));
    }
    for &question in &conditions.questions {
        lines.extend([String::new(), answer(scene, &figures, conditions, question)]);
    }
    lines
}

fn table(scene: &SceneTrade, figures: &[Figures]) -> Vec<String> {
    let header =
        ["setting", "front", "ms", "of baseline", "max abs", "off edges", "edges", "RMSE", "PSNR", "FLIP", "bound"];
    let header = header.map(str::to_owned);
    let rows: Vec<Vec<String>> = [header].into_iter().chain(rows(scene, figures)).map(Vec::from).collect();
    in_line(&rows)
}

/// What is told of every setting, cell by cell: name, a star on the front, ms with quartiles, parts of the baseline's
/// time, largest error, that off edges, share of edge pixels that differ, RMSE, PSNR in dB, FLIP, bound. The baseline,
/// then the others from the most accurate.
pub fn rows(scene: &SceneTrade, figures: &[Figures]) -> Vec<[String; 11]> {
    let mut order: Vec<usize> = (0..scene.points.len()).collect();
    let key = |place: usize| figures[place].largest_error.unwrap_or(f64::INFINITY);
    order[1.min(scene.points.len())..].sort_by(|&a, &b| key(a).total_cmp(&key(b)));
    order.into_iter().map(|place| row(&scene.points[place], &figures[place])).collect()
}

fn row(point: &Point, figures: &Figures) -> [String; 11] {
    let or_dash = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    let digits = |value: Option<f64>| or_dash(value.map(three_digits));
    let error = &point.error;
    let time = figures.time_ns.zip(figures.quartiles_ns).map(|(time_ns, quartiles_ns)| {
        let [first, third] = quartiles_ns.map(ms);
        format!("{} [{first}, {third}]", ms(time_ns))
    });
    [
        figures.name.clone(),
        if figures.is_on_front { "*" } else { "" }.to_owned(),
        or_dash(time),
        or_dash(figures.ratio.map(|ratio| format!("{ratio:.3}"))),
        match error.image.non_finite_pixels {
            0 => digits(error.image.max_abs),
            pixels => format!("NaN: {pixels} px"),
        },
        digits(error.max_abs_off_discontinuities),
        percent(error.differing_share()),
        digits(error.image.rmse),
        or_dash(error.image.psnr_db.map(|db| format!("{db:.1}"))),
        three_digits(error.image.flip_mean),
        digits(point.bound),
    ]
}

fn answer(scene: &SceneTrade, figures: &[Figures], conditions: &Conditions, question: Question) -> String {
    let (asked, without) = match question {
        Question::Error(error) => {
            (format!("The fastest within an error of {}", three_digits(error)), "no setting of the sweep keeps it")
        }
        Question::Fps(fps) => (
            format!("The most accurate at {} frames a second", three_digits(fps)),
            "no setting of the sweep reaches it",
        ),
    };
    match scene.answer(question, conditions.counted) {
        Some(place) => {
            format!("{asked}: **{}**, {}.", figures[place].name, told(&scene.points[place], &figures[place]))
        }
        None => {
            let nearest = match question {
                Question::Error(_) => "; the most accurate one",
                Question::Fps(_) => "; the fastest one",
            };
            let key = |place: usize| match question {
                Question::Error(_) => figures[place].largest_error,
                Question::Fps(_) => figures[place].time_ns,
            };
            let places = (0..figures.len()).filter(|&place| key(place).is_some());
            let best = places.min_by(|&a, &b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
            let best = best.map(|place| {
                format!("{nearest}, {}: {}", figures[place].name, told(&scene.points[place], &figures[place]))
            });
            format!("{asked}: {without}{}.", best.unwrap_or_default())
        }
    }
}

/// Time, error and what of it is proven.
fn told(point: &Point, figures: &Figures) -> String {
    let time = figures.time_ns.zip(figures.frames_per_second);
    let time = time.map_or("not timed".to_owned(), |(time_ns, fps)| {
        format!("{} ms ({} frames a second)", ms(time_ns), three_digits(fps))
    });
    let error = figures.largest_error.map_or("no number".to_owned(), three_digits);
    let share = percent(point.error.differing_share());
    let proof = match point.bound {
        Some(0.0) => "nothing is left out, the rest is rounding".to_owned(),
        Some(bound) => {
            format!("what is left out is proven to be at most {}, the rest is rounding", three_digits(bound))
        }
        None => "measured on this scene from this camera, not proven".to_owned(),
    };
    format!("{time}, error {error}; {share} of the edge pixels are more than 1/510 off; {proof}")
}

fn ms(time_ns: f64) -> String {
    figure(time_ns / 1e6)
}

fn percent(share: f64) -> String {
    format!("{} %", three_digits(100.0 * share))
}

#[cfg(test)]
mod tests {
    use super::super::example::example;
    use super::*;

    #[test]
    fn the_table_the_truth_and_the_answers_are_told() {
        let mut trade = example();
        trade.conditions.questions = vec![Question::Error(0.01), Question::Fps(30.0), Question::Error(1e-9)];
        let text = of(&trade);
        for part in [
            "- device: a device (driver 1)",
            "160x70 pixels; the truth is the reference at the middle of every pixel",
            "## room: 7 solids, 20 generations",
            "NaN: 3 px",
            "- course: one light",
            "The fastest within an error of 0.01: **whitted f32, error 0.00392**, 5.000 ms (200 frames a second), error \
             0.001; 5 % of the edge pixels are more than 1/510 off; what is left out is proven to be at most 0.003, the \
             rest is rounding.",
            "The most accurate at 30 frames a second: **whitted f64**, 20.00 ms",
            "no setting of the sweep keeps it; the most accurate one, whitted f64: ",
        ] {
            assert!(text.contains(part), "{part:?} is not in:\n{text}");
        }
        assert!(!text.contains("validation") && !text.contains("Not complete"));
        let table: Vec<&str> = text.lines().filter(|line| line.starts_with('|')).collect();
        assert_eq!(table.len(), 2 + 5);
        assert!(table[2].starts_with("| whitted f32 "), "the baseline is the first");
        assert!(table[3].starts_with("| whitted f64 ") && table[3].contains(" * "), "then the most accurate");
    }

    #[test]
    fn what_is_not_whole_or_was_watched_is_said() {
        let mut trade = example();
        trade.scenes[0].complete = false;
        trade.conditions.validation = true;
        trade.conditions.target = Target::Area;
        let text = of(&trade);
        for part in ["Not complete: 5 settings are measured.", "- under validation", "8x8 points"] {
            assert!(text.contains(part), "{part:?} is not in:\n{text}");
        }
    }
}
