//! Frames a second: table 4.1 of the course work measured anew.

use maud::{Markup, html};

use super::ReportError;
use super::picture::chart;
use super::text::{both, dash, table, yes_no};
use crate::algorithm::Algorithm;
use crate::measure::Clock;
use crate::measure::fps_table::{Agreement, FpsTable, Speeds, published, spread};
use crate::measure::output::Table;
use crate::measure::output::markdown::figure;
use crate::scene::SolidKind;

pub fn body(fps: &FpsTable) -> Result<Markup, ReportError> {
    if fps.cells.is_empty() {
        return Ok(html! {});
    }
    let drawn = chart(&fps.to_svg()?, "frames a second by number and kind of solids");
    let plan = &fps.plan;
    let (seconds, frames) = (plan.budget.time_ms as f64 / 1e3, plan.budget.frames);
    let clock = match fps.clock() {
        Clock::Gpu => both("GPU time of the tracing alone", "время ГП, только трассировка"),
        Clock::Wall => both("wall time to the picture", "полное время до изображения"),
    };
    Ok(html! {
        p {
            (both(
                format!(
                    "Solids of one kind on a grid as in figure 4.1, {}x{} pixels, {} generations. A cell is the median \
                     frame of {seconds} s, {frames} frames at most and two at least, after one to warm up; kernels take turns. \
                     In brackets the quartiles; beside them, the course work's own figures from its author's machine.",
                    plan.width, plan.height, plan.generations
                ),
                format!(
                    "Тела одного вида на решётке рисунка 4.1, {}x{} пикселей, поколений: {}. В клетке — медианный кадр за \
                     {seconds} с, не более {frames} и не менее двух, после одного для разогрева; ядра чередуются. В скобках квартили; рядом \
                     — числа курсовой работы с машины её автора.",
                    plan.width, plan.height, plan.generations
                ),
            ))
        }
        (drawn)
        @for &algorithm in &plan.algorithms {
            h3 { (algorithm.name()) ": " (both("frames a second", "кадров в секунду")) " (" (clock) ")" }
            (of_algorithm(fps, algorithm))
        }
        h3 { (both("The course work's conclusions", "Выводы курсовой работы")) }
        (agreement(fps))
    })
}

fn of_algorithm(fps: &FpsTable, algorithm: Algorithm) -> Markup {
    let (clock, published) = (fps.clock(), published());
    let kinds = SolidKind::ALL.into_iter();
    let head: Vec<Markup> = [html! { "n" }]
        .into_iter()
        .chain(kinds.flat_map(|kind| [kind_name(kind), both("published", "в работе")]))
        .collect();
    let row = |&count: &usize| {
        let cells = SolidKind::ALL.into_iter().flat_map(|kind| {
            let ours = fps.cell(kind, count, algorithm).and_then(|cell| spread(cell, clock));
            [ours, published.get(kind, count).map(figure)].map(|cell| cell.map_or_else(dash, |cell| html! { (cell) }))
        });
        [html! { (count) }].into_iter().chain(cells).collect()
    };
    table(&head, &fps.plan.counts.iter().map(row).collect::<Vec<Vec<_>>>())
}

/// The note's claims, by the published table and by each kernel's.
fn agreement(fps: &FpsTable) -> Markup {
    let speeds = |&algorithm: &Algorithm| (html! { (algorithm.name()) }, fps.speeds(algorithm, fps.clock()));
    let columns: Vec<(Markup, Speeds)> = [(both("published", "в работе"), published())]
        .into_iter()
        .chain(fps.plan.algorithms.iter().map(speeds))
        .collect();
    let found: Vec<Agreement> = columns.iter().map(|(_, speeds)| Agreement::of(speeds)).collect();
    let row = |claim: Markup, verdict: &dyn Fn(&Agreement) -> Option<Markup>| {
        let verdicts = found.iter().map(|found| verdict(found).unwrap_or_else(dash));
        [claim].into_iter().chain(verdicts).collect::<Vec<_>>()
    };
    let tally = |(all, so): (usize, usize)| {
        (all > 0).then(|| both(format!("{so} of {all} kinds"), format!("{so} из {all} видов")))
    };
    let order =
        both("the fastest first: cone, sphere, cylinder, box", "от быстрых к медленным: конус, сфера, цилиндр, куб");
    let mut rows = vec![
        row(both("largest n of all kinds", "наибольшее n по всем видам"), &|found| {
            Some(html! { (found.count?) })
        }),
        row(order, &|found| {
            let order = found.order.as_ref()?.iter().map(|&kind| kind_name(kind));
            let agrees = found.order_agrees?;
            Some(html! {
                (yes_no(agrees))
                @if !agrees { ": " @for (place, kind) in order.enumerate() { @if place > 0 { ", " } (kind) } }
            })
        }),
    ];
    for (place, ratio) in found[0].ratios.iter().enumerate() {
        let claim =
            html! { (kind_name(ratio.kind)) " / " (kind_name(SolidKind::Sphere)) (format!(": {:.3}", ratio.claimed)) };
        rows.push(row(claim, &|found| {
            let ratio = &found.ratios[place];
            Some(html! { (format!("{:.3}, ", ratio.found?)) (yes_no(ratio.agrees?)) })
        }));
    }
    rows.push(row(
        both("ever more time a frame", "время кадра растёт всё быстрее"),
        &|found| tally(found.ever_slower()),
    ));
    rows.push(row(both("ever more frames lost", "кадры убывают всё быстрее"), &|found| {
        tally(found.ever_steeper())
    }));
    rows.push(row(
        both("Kendall's rank correlation with the published table", "ранговая корреляция Кендалла с таблицей работы"),
        &|found| Some(html! { (format!("{:.3}", found.rank_correlation?)) }),
    ));
    let head: Vec<Markup> =
        [both("claim", "утверждение")].into_iter().chain(columns.into_iter().map(|(name, _)| name)).collect();
    table(&head, &rows)
}

fn kind_name(kind: SolidKind) -> Markup {
    let russian = match kind {
        SolidKind::Sphere => "сфера",
        SolidKind::Box => "куб",
        SolidKind::Cylinder => "цилиндр",
        SolidKind::Cone => "конус",
    };
    both(kind.name(), russian)
}
