//! The page around the sections: language, head, contents, how long each section took.

use std::time::Duration;

use jiff::fmt::strtime;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::text::{both, commands, duration, english, table};
use super::{Ending, Report, ReportError, Section, algorithms, devices, fps, maps, stability, trade, validation};

/// A section, made up.
struct Chapter<'a> {
    /// What the address of the section ends with.
    anchor: &'static str,
    title: Markup,
    commands: &'a [String],
    ending: &'a Ending,
    time: Duration,
    body: Markup,
}

impl<'a> Chapter<'a> {
    fn new<T>(anchor: &'static str, title: Markup, section: &'a Section<T>, body: Markup) -> Self {
        let Section { commands, content: _, ending, time } = section;
        Self { anchor, title, commands, ending, time: *time, body }
    }
}

fn chapters(report: &Report) -> Result<Vec<Chapter<'_>>, ReportError> {
    Ok(vec![
        Chapter::new("devices", both("Devices", "Устройства"), &report.devices, devices::body(&report.devices.content)),
        Chapter::new("maps", both("Gallery", "Галерея"), &report.maps, maps::body(&report.maps.content)?),
        Chapter::new(
            "validation",
            both("Validation", "Проверочные слои"),
            &report.validation,
            report.validation.content.as_ref().map_or_else(Markup::default, validation::body),
        ),
        Chapter::new(
            "stability",
            both("Stability", "Устойчивость"),
            &report.stability,
            stability::body(&report.stability.content)?,
        ),
        Chapter::new("fps", both("Speed", "Скорость"), &report.fps, fps::body(&report.fps.content)?),
        Chapter::new(
            "algorithms",
            both("Three algorithms", "Три алгоритма"),
            &report.algorithms,
            algorithms::body(&report.algorithms.content)?,
        ),
        Chapter::new(
            "trade",
            both("The price of accuracy", "Цена точности"),
            &report.trade,
            trade::body(&report.trade.content)?,
        ),
    ])
}

pub fn page(report: &Report) -> Result<Markup, ReportError> {
    let chapters = chapters(report)?;
    Ok(html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "zerkalo: " (report.machine.device) }
                // Browsers ask a server for an icon that a page does not name.
                link rel="icon" href="data:,";
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body {
                // Before all that their state shows and hides: see style.css.
                input #language-en type="radio" name="language" checked;
                label for="language-en" lang="en" { "English" }
                input #language-ru type="radio" name="language";
                label for="language-ru" lang="ru" { "Русский" }
                (head(report))
                nav { ol { @for chapter in &chapters {
                    li { a href={ "#" (chapter.anchor) } { (chapter.title) } }
                } } }
                main { @for chapter in &chapters { (of_chapter(chapter)) } }
                (budget(report, &chapters))
            }
        }
    })
}

fn head(report: &Report) -> Markup {
    let machine = &report.machine;
    // invariant: these directives are for every timestamp.
    let begun = strtime::format("%Y-%m-%d %H:%M UTC", report.begun).expect("a timestamp has a date");
    html! {
        header {
            h1 { (both("zerkalo: a device measured", "zerkalo: измерение устройства")) }
            dl {
                dt { (both("device", "устройство")) } dd { (english(&machine.device)) }
                dt { (both("driver", "драйвер")) } dd { (english(&machine.driver)) }
                dt { (both("program", "программа")) } dd { (english(&machine.program)) }
                dt { (both("begun", "начато")) } dd { (begun) }
                dt { (both("measured", "измерено")) }
                dd { @if report.is_quick {
                    (both("quickly: few scenes, small pictures", "быстро: немного сцен, маленькие изображения"))
                } @else { (both("in full", "полностью")) } }
            }
            @if !report.is_complete() {
                p.partial { (both(
                    "This report is partial: some sections are not whole, as each of them tells.",
                    "Этот отчёт неполон: часть разделов не закончена, о чём в них сказано.",
                )) }
            }
        }
    }
}

fn of_chapter(chapter: &Chapter) -> Markup {
    html! {
        section id=(chapter.anchor) {
            h2 { (chapter.title) }
            @if *chapter.ending != Ending::Complete { p.partial { (ending(chapter.ending)) } }
            (chapter.body)
            details { summary { (both("how to repeat this", "как это повторить")) } (commands(chapter.commands)) }
        }
    }
}

/// What each section took.
fn budget(report: &Report, chapters: &[Chapter]) -> Markup {
    let row = |chapter: &Chapter| vec![chapter.title.clone(), ending(chapter.ending), duration(chapter.time)];
    let all: Duration = chapters.iter().map(|chapter| chapter.time).sum();
    let whole = if report.is_complete() { ending(&Ending::Complete) } else { both("partial", "неполно") };
    let total = vec![both("all", "всё"), whole, duration(all)];
    html! {
        footer {
            h2 { (both("Time taken", "Затраченное время")) }
            (table(&[both("section", "раздел"), both("state", "состояние"), both("time", "время")],
                &chapters.iter().map(row).chain([total]).collect::<Vec<_>>()))
        }
    }
}

fn ending(ending: &Ending) -> Markup {
    match ending {
        Ending::NotBegun => both("not measured", "не измерялось"),
        Ending::Complete => both("complete", "закончено"),
        Ending::Stopped => both("stopped by Ctrl-C", "прервано (Ctrl-C)"),
        Ending::Failed(reason) => html! { (both("failed: ", "не удалось: ")) (english(reason)) },
    }
}
