//! The price of accuracy.

use maud::{Markup, html};

use super::text::{both, english, table_of, words};
use super::{ReportError, picture};
use crate::measure::output::figure;
use crate::measure::trade::{Answer, Figures, SceneTrade, Trade, answers, asked, chart, figures, settings, truth_told};
use crate::settings::three_digits;

pub fn body(trade: &Trade) -> Result<Markup, ReportError> {
    let scenes: Vec<Markup> = trade.scenes.iter().map(|scene| of_scene(trade, scene)).collect::<Result<_, _>>()?;
    let (width, height) = (trade.conditions.width, trade.conditions.height);
    Ok(html! {
        p {
            (both(
                format!(
                    "Every setting on a scene ({width}x{height} pixels): the time of a frame, in pairs with the accurate \
                     kernel's in f32, and the largest error of a linear channel against the reference. On the front (★) \
                     nothing else is as fast and as accurate."
                ),
                format!(
                    "Все настройки на сцене ({width}x{height} пикселей): время кадра в паре с кадром точного ядра в f32 и \
                     наибольшая ошибка линейного канала относительно эталона. На фронте (★) — те, быстрее и точнее которых \
                     нет."
                ),
            ))
        }
        @for scene in &scenes { (scene) }
    })
}

fn of_scene(trade: &Trade, scene: &SceneTrade) -> Result<Markup, ReportError> {
    let conditions = &trade.conditions;
    let figures = figures(scene, conditions);
    // Its own chart: a panel a scene stands where the scene is described.
    let alone = Trade { machine: trade.machine.clone(), conditions: conditions.clone(), scenes: vec![scene.clone()] };
    let drawn = picture::chart(&chart(&alone).to_svg()?, &format!("{}: time of a frame against error", scene.scene));
    let settings = settings(scene, &figures, conditions.counted);
    Ok(html! {
        h3 { code { (scene.scene) } " "
            (both(format!("{} solids, {} generations", scene.solids, scene.max_depth),
                format!("тел: {}, поколений: {}", scene.solids, scene.max_depth))) }
        @if !scene.complete {
            p.verdict { (both("Not complete: what is measured is told.", "Не закончено: показано измеренное.")) }
        }
        @if let Some(told) = truth_told(scene, conditions) { p { (words(&told)) } }
        @for answer in answers(scene, conditions) { (told(&answer, &figures)) }
        (drawn)
        details {
            summary { (both(format!("every setting: {}", settings.rows.len()), format!("все настройки: {}", settings.rows.len()))) }
            (table_of(&settings))
            @if !scene.left_out.is_empty() {
                p { (both("Not measured:", "Не измерены:")) }
                ul { @for left_out in &scene.left_out {
                    li { (left_out.setting.to_string()) ": " (english(&left_out.reason)) }
                } }
            }
        }
    })
}

/// A question with its answer, in a sentence.
fn told(answer: &Answer, figures: &[Figures]) -> Markup {
    let found = answer.place.map(|place| &figures[place]);
    html! {
        p.verdict {
            (words(&asked(answer.question))) ": "
            @if let Some(found) = found {
                b { (found.name) }
                @if let (Some(time_ns), Some(error)) = (found.time_ns, found.counted_error) {
                    (both(
                        format!(", {} ms a frame, error {}.", figure(time_ns / 1e6), three_digits(error)),
                        format!(", {} мс на кадр, ошибка {}.", figure(time_ns / 1e6), three_digits(error)),
                    ))
                }
            } @else { (both("no setting of the sweep.", "такой настройки среди измеренных нет.")) }
        }
    }
}
