//! The catalogue of numerical extremes.

use maud::{Markup, html};

use super::picture::image;
use super::text::{both, table_of};
use super::{ReportError, Stability};
use crate::measure::stability::{Row, summary, trials};

pub fn body(stability: &Stability) -> Result<Markup, ReportError> {
    let Stability { rows, sheet } = stability;
    let faults: Vec<&Row> = rows.iter().filter(|row| row.is_fault()).collect();
    let failed = trials(rows.iter().filter(|row| !row.pass));
    let sheet = sheet.as_ref().map(|sheet| image(sheet, "error maps: a row a scene, a column a kernel")).transpose()?;
    Ok(html! {
        p {
            (both(
                "Scenes and rays at the edge of what numbers can do: tiny and huge, far away, needles and plates, cameras \
                 inside, closed rooms of mirrors. The truth is a tracer in double-double numbers; bounds follow from the \
                 rounding unit. The accurate kernel (whitted) must pass everything, ssr and path what is for every algorithm; course and plain \
                 are there to compare.",
                "Сцены и лучи на пределе возможностей чисел: крошечные и огромные, далёкие, иглы и пластины, камера внутри \
                 тела, замкнутые зеркальные комнаты. Истина — трассировщик в числах двойной-двойной точности; границы \
                 выведены из единицы округления. Точное ядро (whitted) обязано пройти всё, ssr и path — то, что для всех алгоритмов; \
                 course и plain — для сравнения.",
            ))
        }
        p.verdict {
            @if rows.is_empty() {
            } @else if faults.is_empty() {
                (both("Every case that must be passed is passed.", "Всё, что обязано быть пройдено, пройдено."))
            } @else {
                (both(format!("FAILED, though it must be passed: {}.", faults.len()),
                    format!("НЕ ПРОЙДЕНО, хотя обязано: {}.", faults.len())))
            }
        }
        (table_of(&summary(rows)))
        @if !failed.rows.is_empty() {
            details { summary { (both("what was failed, and by how much", "что не пройдено и насколько")) }
                (table_of(&failed)) }
        }
        @if !rows.is_empty() {
            details { summary { (both("every trial", "все испытания")) } (table_of(&trials(rows))) }
        }
        @if let Some(sheet) = sheet {
            h3 { (both("Error maps of extremes", "Карты ошибок на крайних случаях")) }
            div.scroll.sheet tabindex="0" { (sheet) }
        }
    })
}
