//! What the validation layers had to say.

use maud::{Markup, html};

use super::text::{both, dash, english, table, yes_no};
use crate::gpu::Check;
use crate::validation::{Group, Outcome, Pass, Remarked, Switch};

pub fn body(outcome: &Outcome) -> Markup {
    let Outcome { layer, width, height, no_window, message_count, messages, remarks, switches, .. } = outcome;
    html! {
        p {
            (both(
                format!(
                    "Every kernel, precision and variant of a plan draws scenes of the gallery ({width}x{height} pixels) \
                     under the validation layers. Whether a check works is found out by a mistake made on purpose, so that \
                     silence means something."
                ),
                format!(
                    "Все ядра, точности и варианты плана рисуют сцены галереи ({width}x{height} пикселей) под проверочными \
                     слоями. Работает ли проверка, выясняется нарочной ошибкой, поэтому молчание что-то значит."
                ),
            ))
            " " (english(layer.to_string()))
        }
        p.verdict {
            @if *message_count == 0 { (both("No message.", "Сообщений нет.")) } @else {
                span.lacking { (both(format!("Messages: {message_count}."), format!("Сообщений: {message_count}."))) }
            }
        }
        (checks(outcome))
        (passes(&outcome.passes))
        @if let Some(reason) = no_window {
            p { (both("Nothing was drawn in a window: ", "В окне ничего не рисовалось: ")) (english(reason)) }
        }
        @if !messages.is_empty() {
            (table(&[both("message", "сообщение"), both("times", "раз"), both("text", "текст"), both("met by", "где")],
                &messages.iter().map(of_group).collect::<Vec<_>>()))
        }
        @if !remarks.is_empty() {
            p { (both("No faults, with the reason:", "Не ошибки, с причиной:")) }
            ul { @for Remarked { count, remark } in remarks {
                li { (count) " × " (english(remark.to_string())) }
            } }
        }
        details {
            summary { (both("what plans turn on and off in these runs", "что планы включают и выключают в этих запусках")) }
            (table(&[both("part", "часть"), both("on", "есть"), both("off", "нет")],
                &switches.iter().map(of_switch).collect::<Vec<_>>()))
        }
    }
}

/// A row a check, a column a kind of validation.
fn checks(outcome: &Outcome) -> Markup {
    let (mut kinds, mut rows): (Vec<&str>, Vec<Check>) = (Vec::new(), Vec::new());
    for tried in &outcome.checks {
        if !kinds.contains(&tried.validation) {
            kinds.push(tried.validation);
        }
        if !rows.contains(&tried.check) {
            rows.push(tried.check);
        }
    }
    let cell = |check: Check, kind: &str| {
        let tried = outcome.checks.iter().find(|tried| tried.check == check && tried.validation == kind);
        tried.map_or_else(dash, |tried| yes_no(tried.works))
    };
    let row = |&check: &Check| {
        [english(check.name())].into_iter().chain(kinds.iter().map(|kind| cell(check, kind))).collect()
    };
    let head: Vec<Markup> =
        [both("check works", "проверка работает")].into_iter().chain(kinds.iter().map(english)).collect();
    table(&head, &rows.iter().map(row).collect::<Vec<Vec<_>>>())
}

fn passes(passes: &[Pass]) -> Markup {
    let row = |pass: &Pass| {
        let place =
            if pass.in_window { both("in a window", "в окне") } else { both("off screen", "без окна") };
        vec![english(pass.validation), place, html! { (pass.begun) " / " (pass.runs) }]
    };
    table(
        &[both("validation", "проверки"), both("where", "где"), both("runs", "запуски")],
        &passes.iter().map(row).collect::<Vec<_>>(),
    )
}

fn of_group(group: &Group) -> Vec<Markup> {
    /// The layer's texts are long, and of many runs a few tell enough.
    const RUNS_TOLD: usize = 3;
    let Group { severity, id, count, text, runs } = group;
    let told = runs.iter().take(RUNS_TOLD).map(String::as_str).collect::<Vec<_>>().join("; ");
    let more = if runs.len() > RUNS_TOLD { "; …" } else { "" };
    vec![english(format!("{id} ({})", severity.name())), html! { (count) }, english(text.trim()), english(told + more)]
}

fn of_switch(switch: &Switch) -> Vec<Markup> {
    vec![english(switch.name), html! { (switch.on) }, html! { (switch.off) }]
}
