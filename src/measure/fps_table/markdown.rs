//! The table for people: Markdown whose columns also stand in line in a terminal.

use super::{Agreement, Algorithm, Cell, Clock, FpsTable, Speeds, frames_per_second, published};
use crate::measure::output::markdown::{figure, in_line};
use crate::scene::SolidKind;

/// Title, machine, a section a kernel, the kernels side by side, and what agrees with the course work.
pub fn of(table: &FpsTable) -> String {
    let mut lines = head(table);
    for &algorithm in &table.plan.algorithms {
        lines.extend(of_kernel(table, algorithm));
    }
    if let [first, second] = table.plan.algorithms[..] {
        lines.extend(side_by_side(table, first, second));
    }
    lines.extend(agreement(table));
    lines.join("\n") + "\n"
}

fn head(table: &FpsTable) -> Vec<String> {
    let (machine, plan) = (&table.machine, &table.plan);
    let seconds = plan.budget.time_ms as f64 / 1e3;
    let mut lines = vec![
        "# Frames a second: table 4.1 measured anew".to_owned(),
        String::new(),
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

fn of_kernel(table: &FpsTable, algorithm: Algorithm) -> Vec<String> {
    let (name, clock, published) = (algorithm.name(), table.clock(), published());
    let speeds = table.speeds(algorithm, clock);
    let fewest = table.plan.fewest();
    let mut lines = Vec::new();
    for shown in [Clock::Gpu, Clock::Wall] {
        let of = match shown {
            Clock::Gpu => "by GPU time (the tracing alone)",
            Clock::Wall if table.plan.in_window => "in the window (from one frame shown to the next)",
            Clock::Wall => "by wall time (to the picture in the host's memory, nothing shown)",
        };
        let title = format!("{name}: frames a second {of}");
        let cell = |kind, count| table.cell(kind, count, algorithm).and_then(|cell| spread(cell, shown));
        if shown == clock {
            lines.extend(section(&title, table, Some("published"), cell, |kind, count| {
                published.get(kind, count).map(figure)
            }));
        } else {
            lines.extend(section(&title, table, None, cell, |_, _| None));
        }
    }
    lines.extend(section(
        &format!("{name}: in parts of the speed with {fewest}"),
        table,
        Some("published"),
        |kind, count| speeds.of_fewest(kind, count, fewest).map(part),
        |kind, count| published.of_fewest(kind, count, fewest).map(part),
    ));
    lines.extend(section(
        &format!("{name}: in parts of the speed with as many spheres"),
        table,
        Some("published"),
        |kind, count| speeds.of_spheres(kind, count).map(part),
        |kind, count| published.of_spheres(kind, count).map(part),
    ));
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

/// How many frames the second draws while the first draws one.
fn side_by_side(table: &FpsTable, first: Algorithm, second: Algorithm) -> Vec<String> {
    let of = |algorithm| table.speeds(algorithm, table.clock());
    let (of_first, of_second) = (of(first), of(second));
    let ratio = |kind, count| Some(figure(of_second.get(kind, count)? / of_first.get(kind, count)?));
    let title = format!("Frames of the {} kernel to one of the {} kernel", second.name(), first.name());
    section(&title, table, None, ratio, |_, _| None)
}

/// A row a number of solids, a column a kind, with a second column beside each where it has a name.
fn section(
    title: &str,
    table: &FpsTable,
    beside: Option<&str>,
    cell: impl Fn(SolidKind, usize) -> Option<String>,
    cell_beside: impl Fn(SolidKind, usize) -> Option<String>,
) -> Vec<String> {
    let both = |first: String, second: Option<String>| [Some(first), second].into_iter().flatten();
    let or_dash = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
    let names = SolidKind::ALL.into_iter().flat_map(|kind| both(kind.name().to_owned(), beside.map(str::to_owned)));
    let mut rows = vec![["n".to_owned()].into_iter().chain(names).collect::<Vec<_>>()];
    for &count in &table.plan.counts {
        let cells = SolidKind::ALL
            .into_iter()
            .flat_map(|kind| both(or_dash(cell(kind, count)), beside.map(|_| or_dash(cell_beside(kind, count)))));
        rows.push([count.to_string()].into_iter().chain(cells).collect());
    }
    [vec![String::new(), format!("## {}", capital(title)), String::new()], in_line(&rows)].concat()
}

fn agreement(table: &FpsTable) -> Vec<String> {
    let speeds = |&algorithm: &Algorithm| (algorithm.name().to_owned(), table.speeds(algorithm, table.clock()));
    let columns: Vec<(String, Speeds)> =
        [("published".to_owned(), published())].into_iter().chain(table.plan.algorithms.iter().map(speeds)).collect();
    let found: Vec<Agreement> = columns.iter().map(|(_, speeds)| Agreement::of(speeds)).collect();
    let mut rows = vec![["claim".to_owned()].into_iter().chain(columns.into_iter().map(|(name, _)| name)).collect()];
    let mut row = |claim: String, verdict: &dyn Fn(&Agreement) -> Option<String>| {
        let verdicts = found.iter().map(|found| verdict(found).unwrap_or_else(|| "–".to_owned()));
        rows.push([claim].into_iter().chain(verdicts).collect::<Vec<_>>());
    };
    row("largest n of all kinds".to_owned(), &|found| found.count.map(|count| count.to_string()));
    row("the fastest first: cone, sphere, cylinder, box".to_owned(), &|found| {
        let order = found.order.as_ref()?.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(", ");
        Some(if found.order_agrees? { "yes".to_owned() } else { format!("no: {order}") })
    });
    for (place, (kind, claimed)) in super::CLAIMED_OF_SPHERES.into_iter().enumerate() {
        row(format!("{} to sphere: {}", kind.name(), part(claimed)), &|found| {
            let ratio = &found.ratios[place];
            Some(format!("{}, {}", part(ratio.found?), if ratio.agrees? { "yes" } else { "no" }))
        });
    }
    let tally = |(all, so): (usize, usize)| (all > 0).then(|| format!("{so} of {all} kinds"));
    row("ever more time a frame (its curve bends up)".to_owned(), &|found| tally(found.ever_slower()));
    row("ever more frames lost (their curve bends down)".to_owned(), &|found| tally(found.ever_steeper()));
    row("Kendall's rank correlation with the published table".to_owned(), &|found| found.rank_correlation.map(part));
    [vec![String::new(), "## The course work's conclusions".to_owned(), String::new()], in_line(&rows)].concat()
}

/// The median frame in frames a second, the quartiles, slow and fast, in brackets.
pub fn spread(cell: &Cell, clock: Clock) -> Option<String> {
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
    use super::super::tests::{BOTH, example};
    use super::*;

    #[test]
    fn columns_stand_in_line_and_every_table_is_markdown() {
        let text = of(&example(&[10, 100], &BOTH));
        let tables: Vec<Vec<&str>> = text
            .split("\n\n")
            .filter(|part| part.starts_with('|'))
            .map(|part| part.trim_end().lines().collect())
            .collect();
        // Two clocks and two ratios a kernel, the kernels side by side, the conclusions.
        assert_eq!(tables.len(), 2 * 4 + 2, "{text}");
        for table in tables {
            let widths: Vec<usize> = table.iter().map(|line| line.chars().count()).collect();
            assert!(widths.iter().all(|width| *width == widths[0]), "{table:?}");
            let bars: Vec<usize> = table.iter().map(|line| line.matches('|').count()).collect();
            assert!(bars.iter().all(|count| *count == bars[0]), "{table:?}");
            assert!(table[1].chars().all(|c| "|-: ".contains(c)), "{table:?}");
        }
    }

    #[test]
    fn the_machine_the_spread_and_the_published_figure_are_told() {
        let text = of(&example(&[10, 100], &[Algorithm::Course]));
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
        let text = of(&table);
        assert!(
            text.contains("- in a window of the picture's size: every frame is shown, present mode mailbox"),
            "{text}"
        );
        let title = "## Course: frames a second in the window";
        assert!(text.contains(title) && !text.contains("nothing shown"), "{text}");
        // 10.05 ms from one to the next, beside the published figure.
        assert!(text.contains("| 99.50 [99.50, 99.50] |     57.14 |"), "{text}");
        table.machine.present_mode = Some("fifo".to_owned());
        assert!(of(&table).contains("present mode fifo (THE WINDOW SYSTEM OFFERS NOTHING BUT WAITING"));
    }

    #[test]
    fn what_is_missing_is_a_dash_and_said() {
        let mut table = example(&[10, 20, 100], &[Algorithm::Course]);
        table.cells.truncate(5);
        table.plan.validation = true;
        let text = of(&table);
        assert!(text.contains("- not complete: 5 of 12 places of the table are measured"), "{text}");
        assert!(text.contains("- under validation"), "{text}");
        assert!(text.lines().any(|line| line.starts_with("| 100 |") && line.contains("–")), "{text}");
    }
}
