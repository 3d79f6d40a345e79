//! The tables for people, in Markdown and in a report, with the answers in words.

use super::figures::{Figures, figures};
use super::{Conditions, Counted, Point, Question, SceneTrade, Target, Trade};
use crate::measure::Clock;
use crate::measure::output::{Entry, Table, Words, figure};
use crate::settings::three_digits;

/// Title, machine, what the columns mean, and a section a scene.
pub fn blocks(trade: &Trade) -> Vec<String> {
    let mut blocks = vec!["# The price of accuracy".to_owned(), legend(trade).join("\n")];
    trade.scenes.iter().for_each(|scene| blocks.extend(of_scene(scene, &trade.conditions)));
    blocks
}

fn legend(trade: &Trade) -> Vec<String> {
    let Trade { machine, conditions, scenes } = trade;
    let truth = match conditions.target {
        Target::Point => "the reference at the middle of every pixel",
        Target::Area => "the reference's mean over 8x8 points of every pixel",
        Target::Radiance { .. } => "all light over every pixel's area, by path tracing",
    };
    let counted = match conditions.counted {
        Counted::AllPixels => "max error",
        Counted::OffDiscontinuities => "off edges",
        Counted::RootMeanSquare => "RMSE",
    };
    let clock = match scenes.first().map(|scene| scene.clock) {
        Some(Clock::Wall) => "wall time, for the device has no timestamps",
        Some(Clock::Gpu) | None => "GPU time",
    };
    let mut lines = vec![
        format!("- device: {} ({})", machine.device, machine.driver),
        format!("- program: {}", machine.program),
        format!("- picture: {}x{} pixels; the truth is {truth}", conditions.width, conditions.height),
        format!(
            "- ms: {clock} of a frame, the median ratio to the baseline's frame beside it times the baseline's median; in \
             brackets the quartiles. The first line is the baseline against itself"
        ),
    ];
    lines.extend(errors(conditions.counted).map(str::to_owned));
    lines.push(format!(
        "- front: no other setting is as fast and as accurate (ms, {counted}) and better in one of the two"
    ));
    if conditions.validation {
        lines.push("- under validation: these times say nothing of the machine's".to_owned());
    }
    lines
}

/// What the columns of errors mean.
fn errors(counted: Counted) -> [&'static str; 2] {
    match counted {
        Counted::AllPixels | Counted::OffDiscontinuities => [
            "- max error: largest error of a linear channel over all pixels; off edges: without pixels beside one whose ray \
             goes another way; edges differing: those of them that are more than 1/510 off",
            "- proven bound: what is left out is proven to change no channel by more, rounding not in it; –: only measured, \
             on this scene from this camera",
        ],
        Counted::RootMeanSquare => [
            "- RMSE: root of the mean square error of linear channels; of path tracing what a picture by one more seed does \
             not exceed with a confidence of 95 %, and in brackets the mean of those measured. The truth's own error is in \
             every one of them",
            "- max error: largest error of a linear channel over all pixels, of path tracing in its first picture",
        ],
    }
}

/// Where the truth is path-traced, how good it is.
pub fn truth_told(scene: &SceneTrade, conditions: &Conditions) -> Option<Words> {
    let Target::Radiance { truth_samples } = conditions.target else { return None };
    let error = three_digits(scene.truth_standard_error?);
    Some(Words::both(
        format!("The truth: path tracing by {truth_samples} samples a pixel, standard error {error}."),
        format!("Истина: трассировка путей, выборок на пиксель: {truth_samples}, стандартная ошибка {error}."),
    ))
}

fn of_scene(scene: &SceneTrade, conditions: &Conditions) -> Vec<String> {
    let figures = figures(scene, conditions);
    let mut blocks = vec![format!("## {}: {} solids, {} generations", scene.scene, scene.solids, scene.max_depth)];
    blocks.extend(truth_told(scene, conditions).map(|told| told.english));
    if !scene.complete {
        blocks.push(format!("Not complete: {} settings are measured.", scene.points.len()));
    }
    blocks.push(settings(scene, &figures, conditions.counted).to_markdown());
    if !scene.left_out.is_empty() {
        let left_out = scene.left_out.iter().map(|left_out| format!("- {}: {}", left_out.setting, left_out.reason));
        blocks.extend(["Not measured:".to_owned(), left_out.collect::<Vec<_>>().join("\n")]);
    }
    blocks.extend(conditions.questions.iter().map(|&question| answer(scene, &figures, conditions, question)));
    blocks
}

/// The baseline, then the others from the most accurate.
pub fn settings(scene: &SceneTrade, figures: &[Figures], counted: Counted) -> Table {
    let mut order: Vec<usize> = (0..scene.points.len()).collect();
    let key = |place: usize| figures[place].counted_error.unwrap_or(f64::INFINITY);
    order[1.min(scene.points.len())..].sort_by(|&a, &b| key(a).total_cmp(&key(b)));
    let mut head = vec![
        Words::both("setting", "настройка"),
        Words::both("front", "фронт"),
        Words::both("ms [quartiles]", "мс [квартили]"),
        Words::both("of baseline", "от базовой"),
    ];
    let [rmse, max] = [Words::both("RMSE", "СКО"), Words::both("max error", "наиб. ошибка")];
    let [psnr, flip] = [Words::both("PSNR, dB", "PSNR, дБ"), "FLIP".into()];
    head.extend(match counted {
        Counted::RootMeanSquare => vec![rmse, max, psnr, flip],
        Counted::AllPixels | Counted::OffDiscontinuities => {
            let off_edges = Words::both("off edges", "вне границ");
            let differing = Words::both("edges differing", "отличия на границах");
            vec![max, off_edges, differing, rmse, psnr, flip, Words::both("proven bound", "доказанная граница")]
        }
    });
    Table { head, rows: order.into_iter().map(|place| row(&scene.points[place], &figures[place], counted)).collect() }
}

fn row(point: &Point, figures: &Figures, counted: Counted) -> Vec<Entry> {
    let digits = |value: Option<f64>| Entry::maybe(value.map(three_digits));
    let error = &point.error;
    let max = match error.image.non_finite_pixels {
        0 => digits(error.image.max_abs),
        pixels => Entry::of(format!("NaN: {pixels} px")),
    };
    let psnr = Entry::maybe(error.image.psnr_db.map(|db| format!("{db:.1}")));
    let flip = Entry::of(three_digits(error.image.flip_mean));
    let errors = match counted {
        Counted::RootMeanSquare => {
            let of_pictures =
                mean(&point.rmse_of_pictures).map_or(String::new(), |mean| format!(" [{}]", three_digits(mean)));
            let rmse = figures.counted_error.map(|error| three_digits(error) + &of_pictures);
            vec![Entry::maybe(rmse), max, psnr, flip]
        }
        Counted::AllPixels | Counted::OffDiscontinuities => {
            let off_edges = digits(error.edges.and_then(|edges| edges.max_abs_off_discontinuities));
            let differing = Entry::maybe(error.edges.map(|edges| percent(edges.differing_share())));
            vec![max, off_edges, differing, digits(error.image.rmse), psnr, flip, digits(point.bound)]
        }
    };
    let time = figures.time_ns.zip(figures.quartiles_ns).map(|(time_ns, quartiles_ns)| {
        let [first, third] = quartiles_ns.map(ms);
        format!("{} [{first}, {third}]", ms(time_ns))
    });
    let mut row = vec![
        Entry::of(&figures.name),
        Entry::of(if figures.is_on_front { "★" } else { "" }),
        Entry::maybe(time),
        Entry::maybe(figures.ratio.map(|ratio| format!("{ratio:.3}"))),
    ];
    row.extend(errors);
    row
}

/// `None` of no values.
fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// What is asked for, to be followed by the answer.
pub fn asked(question: Question) -> Words {
    match question {
        Question::Error(error) => {
            let error = three_digits(error);
            Words::both(
                format!("The fastest within an error of {error}"),
                format!("Самая быстрая с ошибкой до {error}"),
            )
        }
        Question::Fps(fps) => {
            let fps = three_digits(fps);
            let russian = format!("Самая точная при {fps} кадрах в секунду");
            Words::both(format!("The most accurate at {fps} frames a second"), russian)
        }
    }
}

fn answer(scene: &SceneTrade, figures: &[Figures], conditions: &Conditions, question: Question) -> String {
    let asked = asked(question).english;
    let told = |place: usize| told(&scene.points[place], &figures[place]);
    if let Some(place) = scene.answer(question, conditions.counted) {
        return format!("{asked}: **{}**, {}.", figures[place].name, told(place));
    }
    let (without, nearest, key): (_, _, fn(&Figures) -> Option<f64>) = match question {
        Question::Error(_) => ("keeps it", "the most accurate one", |figures| figures.counted_error),
        Question::Fps(_) => ("reaches it", "the fastest one", |figures| figures.time_ns),
    };
    let known = figures.iter().enumerate().filter_map(|(place, figures)| Some((place, key(figures)?)));
    let best = known.min_by(|(_, a), (_, b)| a.total_cmp(b));
    let best = best.map(|(place, _)| format!("; {nearest}, {}: {}", figures[place].name, told(place)));
    format!("{asked}: no setting of the sweep {without}{}.", best.unwrap_or_default())
}

/// Time, error and what of it is proven.
fn told(point: &Point, figures: &Figures) -> String {
    let time = figures.time_ns.zip(figures.frames_per_second);
    let time = time.map_or("not timed".to_owned(), |(time_ns, fps)| {
        format!("{} ms ({} frames a second)", ms(time_ns), three_digits(fps))
    });
    let error = figures.counted_error.map_or("no number".to_owned(), three_digits);
    let edges = point.error.edges.map_or(String::new(), |edges| {
        format!("; {} of the edge pixels are more than 1/510 off", percent(edges.differing_share()))
    });
    let proof = match point.bound {
        None if !point.rmse_of_pictures.is_empty() && figures.counted_error.is_some() => format!(
            ", which a picture by one more seed does not exceed with a confidence of 95 %, by the {} measured",
            point.rmse_of_pictures.len()
        ),
        Some(0.0) => "; nothing is left out, the rest is rounding".to_owned(),
        Some(bound) => {
            format!("; what is left out is proven to be at most {}, the rest is rounding", three_digits(bound))
        }
        None => "; measured on this scene from this camera, not proven".to_owned(),
    };
    format!("{time}, error {error}{edges}{proof}")
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
    use crate::algorithm::{Algorithm, Precision};
    use crate::measure::output::Document;
    use crate::settings::RenderSettings;

    #[test]
    fn the_table_the_truth_and_the_answers_are_told() {
        let mut trade = example();
        trade.conditions.questions = vec![Question::Error(0.01), Question::Fps(30.0), Question::Error(1e-9)];
        let text = trade.to_markdown();
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
        assert!(table[3].starts_with("| whitted f64 ") && table[3].contains(" ★ "), "then the most accurate");
    }

    #[test]
    fn of_all_light_the_root_mean_square_counts_and_of_path_tracing_with_a_confidence() {
        let mut trade = example();
        trade.conditions.target = Target::Radiance { truth_samples: 4096 };
        trade.conditions.counted = Counted::RootMeanSquare;
        // Mean 0.0002, deviation 0.00001; Student's 2.920 for two degrees of freedom, √(4/3).
        trade.conditions.questions = vec![Question::Error(0.000234), Question::Error(0.000233)];
        let scene = &mut trade.scenes[0];
        scene.truth_standard_error = Some(0.000123);
        scene.points.iter_mut().for_each(|point| (point.error.edges, point.bound) = (None, None));
        scene.points[2].setting = RenderSettings {
            algorithm: Algorithm::Path,
            samples: 64,
            precision: Some(Precision::F32),
            ..RenderSettings::DEFAULT
        };
        scene.points[2].rmse_of_pictures = vec![0.00019, 0.0002, 0.00021];
        // Columns stand in line.
        let text = trade.to_markdown().split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
        for part in [
            "the truth is all light over every pixel's area, by path tracing",
            "The truth: path tracing by 4096 samples a pixel, standard error 0.000123.",
            "| RMSE | max error | PSNR, dB | FLIP |",
            "| 0.000234 [0.0002] | 0.001 |",
            "(ms, RMSE)",
            "within an error of 0.000234: **path f32, 64 samples**, 5.000 ms (200 frames a second), error 0.000234, which a \
             picture by one more seed does not exceed with a confidence of 95 %, by the 3 measured.",
            "within an error of 0.000233: **whitted f64**, 20.00 ms",
        ] {
            assert!(text.contains(part), "{part:?} is not in:\n{text}");
        }
        assert!(!text.contains("edge pixels") && !text.contains("proven bound"), "{text}");
    }

    #[test]
    fn what_is_not_whole_or_was_watched_is_said() {
        let mut trade = example();
        trade.scenes[0].complete = false;
        trade.conditions.validation = true;
        trade.conditions.target = Target::Area;
        let text = trade.to_markdown();
        for part in ["Not complete: 5 settings are measured.", "- under validation", "8x8 points"] {
            assert!(text.contains(part), "{part:?} is not in:\n{text}");
        }
    }
}
