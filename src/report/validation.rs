//! What the validation layers had to say.

use maud::{Markup, html};

use super::text::{both, english, table, table_of};
use crate::validation::{Group, Outcome, Remarked, tables};

pub fn body(outcome: &Outcome) -> Markup {
    let Outcome { layer, width, height, no_window, message_count, messages, remarks, .. } = outcome;
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
        (table_of(&tables::checks(outcome)))
        (table_of(&tables::passes(outcome)))
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
            (table_of(&tables::switches(outcome)))
        }
    }
}

fn of_group(group: &Group) -> Vec<Markup> {
    let Group { severity, id, count, text, .. } = group;
    vec![
        english(format!("{id} ({})", severity.name())),
        html! { (count) },
        english(text.trim()),
        english(group.met_by()),
    ]
}
