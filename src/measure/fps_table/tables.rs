//! The tables for people, in Markdown and in a report.

use super::{Agreement, Algorithm, CLAIMED_OF_SPHERES, Cell, Clock, FpsTable, Speeds, frames_per_second, published};
use crate::measure::output::{Entry, Table, Words, figure};
use crate::scene::SolidKind;

/// Title, machine, sections of each kernel, the kernels side by side, and what agrees with the course work.
pub fn blocks(table: &FpsTable) -> Vec<String> {
    let mut blocks = vec!["# Frames a second: table 4.1 measured anew".to_owned(), conditions(table).join("\n")];
    let mut section =
        |title: &str, table: Table| blocks.extend([format!("## {}", capital(title)), table.to_markdown()]);
    let (published, fewest) = (published(), table.plan.fewest());
    for &algorithm in &table.plan.algorithms {
        let (name, speeds) = (algorithm.name(), table.speeds(algorithm, table.clock()));
        for clock in [Clock::Gpu, Clock::Wall] {
            let by = match clock {
                Clock::Gpu => "by GPU time (the tracing alone)",
                Clock::Wall if table.plan.in_window => "in the window (from one frame shown to the next)",
                Clock::Wall => "by wall time (to the picture in the host's memory, nothing shown)",
            };
            section(&format!("{name}: frames a second {by}"), spreads(table, algorithm, clock));
        }
        section(
            &format!("{name}: in parts of the speed with {fewest}"),
            by_kind(
                table,
                |kind, count| speeds.of_fewest(kind, count, fewest).map(part),
                Some(&|kind, count| published.of_fewest(kind, count, fewest).map(part)),
            ),
        );
        section(
            &format!("{name}: in parts of the speed with as many spheres"),
            by_kind(
                table,
                |kind, count| speeds.of_spheres(kind, count).map(part),
                Some(&|kind, count| published.of_spheres(kind, count).map(part)),
            ),
        );
    }
    if let [first, second] = table.plan.algorithms[..] {
        let [of_first, of_second] = [first, second].map(|algorithm| table.speeds(algorithm, table.clock()));
        let ratio = |kind, count| Some(figure(of_second.get(kind, count)? / of_first.get(kind, count)?));
        let title = format!("Frames of the {} kernel to one of the {} kernel", second.name(), first.name());
        section(&title, by_kind(table, ratio, None));
    }
    section("The course work's conclusions", agreement(table));
    blocks
}

fn conditions(table: &FpsTable) -> Vec<String> {
    let (machine, plan) = (&table.machine, &table.plan);
    let seconds = plan.budget.time_ms as f64 / 1e3;
    let mut lines = vec![
        format!("- device: {} ({})", machine.device, machine.driver),
        format!("- program: {}", machine.program),
        format!("- picture: {}x{} pixels, {} generations, as in figure 4.1", plan.width, plan.height, plan.generations),
        format!(
            "- a cell: the median frame of {} frames or {seconds} s of each kernel, which take turns, after one to warm \
             up; in brackets the quartiles",
            plan.budget.frames
        ),
    ];
    if let Some(mode) = &machine.present_mode {
        lines.push(format!("- in a window of the picture's size: {}", shown_by(mode)));
    }
    if plan.validation {
        lines.push("- under validation: these speeds say nothing of the machine's".to_owned());
    }
    let missing = table.missing().len();
    if missing > 0 {
        let all = plan.counts.len() * SolidKind::ALL.len();
        lines.push(format!("- not complete: {} of {all} places of the table are measured", all - missing));
    }
    lines
}

/// What Vulkan's word for a way of showing frames means for their number.
fn shown_by(mode: &str) -> String {
    let meaning = match mode {
        "mailbox" => "no frame waits for the display, which skips the late ones",
        "immediate" => "no frame waits for the display",
        _ => "THE WINDOW SYSTEM OFFERS NOTHING BUT WAITING FOR THE DISPLAY, whose rate limits these figures",
    };
    format!("every frame is shown, present mode {mode} ({meaning})")
}

/// Spreads of a kernel's times; by the table's own clock, beside the published figures.
pub fn spreads(table: &FpsTable, algorithm: Algorithm, clock: Clock) -> Table {
    let published = published();
    let beside = |kind, count| published.get(kind, count).map(figure);
    by_kind(
        table,
        |kind, count| spread(table.cell(kind, count, algorithm)?, clock),
        if clock == table.clock() { Some(&beside) } else { None },
    )
}

type Place<'a> = &'a dyn Fn(SolidKind, usize) -> Option<String>;

/// A row a number of solids, a column a kind, with the published figures beside where they are given.
fn by_kind(table: &FpsTable, cell: impl Fn(SolidKind, usize) -> Option<String>, published: Option<Place<'_>>) -> Table {
    let mut head = vec!["n".into()];
    for kind in SolidKind::ALL {
        head.push(kind_words(kind));
        head.extend(published.map(|_| Words::both("published", "в работе")));
    }
    let row = |&count: &usize| {
        let mut row = vec![Entry::of(count)];
        for kind in SolidKind::ALL {
            row.push(Entry::maybe(cell(kind, count)));
            row.extend(published.map(|published| Entry::maybe(published(kind, count))));
        }
        row
    };
    Table { head, rows: table.plan.counts.iter().map(row).collect() }
}

pub(super) fn kind_words(kind: SolidKind) -> Words {
    let russian = match kind {
        SolidKind::Sphere => "сфера",
        SolidKind::Box => "куб",
        SolidKind::Cylinder => "цилиндр",
        SolidKind::Cone => "конус",
    };
    Words::both(kind.name(), russian)
}

/// The note's claims, by the published table and by each kernel's.
pub fn agreement(table: &FpsTable) -> Table {
    let speeds = |&algorithm: &Algorithm| (algorithm.name().into(), table.speeds(algorithm, table.clock()));
    let columns: Vec<(Words, Speeds)> = [(Words::both("published", "в работе"), published())]
        .into_iter()
        .chain(table.plan.algorithms.iter().map(speeds))
        .collect();
    let found: Vec<Agreement> = columns.iter().map(|(_, speeds)| Agreement::of(speeds)).collect();
    let head = [Words::both("claim", "утверждение")].into_iter().chain(columns.into_iter().map(|(name, _)| name));
    let mut rows = Vec::new();
    let mut row = |claim: Words, verdict: &dyn Fn(&Agreement) -> Option<Words>| {
        let verdicts = found.iter().map(|found| Entry::maybe(verdict(found)));
        rows.push([Entry::Text(claim)].into_iter().chain(verdicts).collect::<Vec<_>>());
    };
    let tally = |(all, so): (usize, usize)| {
        (all > 0).then(|| Words::both(format!("{so} of {all} kinds"), format!("{so} из {all} видов")))
    };
    row(Words::both("largest n of all kinds", "наибольшее n по всем видам"), &|found| {
        Some(found.count?.into())
    });
    let order = Words::both(
        "the fastest first: cone, sphere, cylinder, box",
        "от быстрых к медленным: конус, сфера, цилиндр, куб",
    );
    row(order, &|found| {
        let order: Vec<Words> = found.order.iter().flatten().map(|&kind| kind_words(kind)).collect();
        let no = || Words::join(&[Words::yes_no(false), Words::join(&order, ", ")], ": ");
        Some(if found.order_agrees? { Words::yes_no(true) } else { no() })
    });
    for (place, (kind, claimed)) in CLAIMED_OF_SPHERES.into_iter().enumerate() {
        let kinds = Words::join(&[kind_words(kind), kind_words(SolidKind::Sphere)], " / ");
        row(Words::join(&[kinds, part(claimed).into()], ": "), &|found| {
            let ratio = &found.ratios[place];
            Some(Words::join(&[part(ratio.found?).into(), Words::yes_no(ratio.agrees?)], ", "))
        });
    }
    row(
        Words::both(
            "ever more time a frame (its curve bends up)",
            "время кадра растёт всё быстрее (кривая выпукла вниз)",
        ),
        &|found| tally(found.ever_slower()),
    );
    row(
        Words::both(
            "ever more frames lost (their curve bends down)",
            "кадры убывают всё быстрее (кривая выпукла вверх)",
        ),
        &|found| tally(found.ever_steeper()),
    );
    row(
        Words::both(
            "Kendall's rank correlation with the published table",
            "ранговая корреляция Кендалла с таблицей работы",
        ),
        &|found| Some(part(found.rank_correlation?).into()),
    );
    Table { head: head.collect(), rows }
}

/// The median frame in frames a second, the quartiles, slow and fast, in brackets.
fn spread(cell: &Cell, clock: Clock) -> Option<String> {
    let summary = cell.summary(clock)?;
    let [fast, slow] = summary.quartiles_ns.map(|quartile| figure(frames_per_second(quartile)));
    Some(format!("{} [{slow}, {fast}]", figure(frames_per_second(summary.median_ns as f64))))
}

/// In parts of something: three digits behind the point.
fn part(value: f64) -> String {
    format!("{value:.3}")
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::super::tests::example;
    use super::*;
    use crate::measure::output::Document;

    #[test]
    fn the_machine_the_spread_and_the_published_figure_are_told() {
        let text = example(&[10, 100], &[Algorithm::Course]).to_markdown();
        for part in [
            "- device: a device, of \"two\" cores (driver 1)",
            "- program: z 1",
            "160x70 pixels, 20 generations",
            "| 100.0 [100.0, 100.0] |     57.14 |",
            // 10.05 ms, between 10 and 10.05 ms.
            "99.50 [99.50, 99.50]",
            "no: sphere, box, cylinder, cone",
            "4 of 4 kinds",
        ] {
            assert!(text.contains(part), "{part:?} is not in:\n{text}");
        }
        assert!(!text.contains("not complete") && !text.contains("validation") && !text.contains("whitted"), "{text}");
    }

    #[test]
    fn a_table_measured_in_a_window_says_so_and_is_judged_by_the_frames_shown() {
        let mut table = example(&[10, 100], &[Algorithm::Course]);
        (table.plan.in_window, table.machine.present_mode) = (true, Some("mailbox".to_owned()));
        let text = table.to_markdown();
        assert!(
            text.contains("- in a window of the picture's size: every frame is shown, present mode mailbox"),
            "{text}"
        );
        let title = "## Course: frames a second in the window";
        assert!(text.contains(title) && !text.contains("nothing shown"), "{text}");
        // 10.05 ms from one to the next, beside the published figure.
        assert!(text.contains("| 99.50 [99.50, 99.50] |     57.14 |"), "{text}");
        table.machine.present_mode = Some("fifo".to_owned());
        assert!(table.to_markdown().contains("present mode fifo (THE WINDOW SYSTEM OFFERS NOTHING BUT WAITING"));
    }

    #[test]
    fn what_is_missing_is_a_dash_and_said() {
        let mut table = example(&[10, 20, 100], &[Algorithm::Course]);
        table.cells.truncate(5);
        table.plan.validation = true;
        let text = table.to_markdown();
        assert!(text.contains("- not complete: 5 of 12 places of the table are measured"), "{text}");
        assert!(text.contains("- under validation"), "{text}");
        assert!(text.lines().any(|line| line.starts_with("| 100 |") && line.contains("–")), "{text}");
    }
}
