//! The catalogue of numerical extremes.

use maud::{Markup, html};

use super::picture::image;
use super::text::{both, dash, english, table};
use super::{ReportError, Stability};
use crate::measure::stability::{Passed, Row, Summary, short};

pub fn body(stability: &Stability) -> Result<Markup, ReportError> {
    let Stability { rows, sheet } = stability;
    let faults: Vec<&Row> = rows.iter().filter(|row| row.is_fault()).collect();
    let failed: Vec<Vec<Markup>> = rows.iter().filter(|row| !row.pass).map(cells).collect();
    let all: Vec<Vec<Markup>> = rows.iter().map(cells).collect();
    let sheet = sheet.as_ref().map(|sheet| image(sheet, "error maps: a row a scene, a column a kernel")).transpose()?;
    Ok(html! {
        p {
            (both(
                "Scenes and rays at the edge of what numbers can do: tiny and huge, far away, needles and plates, cameras \
                 inside, closed rooms of mirrors. The truth is a tracer in double-double numbers; bounds follow from the \
                 rounding unit. The accurate kernel (whitted) must pass everything, the other two are there to compare.",
                "Сцены и лучи на пределе возможностей чисел: крошечные и огромные, далёкие, иглы и пластины, камера внутри \
                 тела, замкнутые зеркальные комнаты. Истина — трассировщик в числах двойной-двойной точности; границы \
                 выведены из единицы округления. Точное ядро (whitted) обязано пройти всё, два других — для сравнения.",
            ))
        }
        p.verdict {
            @if rows.is_empty() {
            } @else if faults.is_empty() {
                (both("The accurate kernel passes every case that was tried.", "Точное ядро прошло все испытанные случаи."))
            } @else {
                (both(format!("FAILED on the accurate kernel: {}.", faults.len()),
                    format!("НЕ ПРОЙДЕНО точным ядром: {}.", faults.len())))
            }
        }
        (summary(rows))
        @if !failed.is_empty() {
            details { summary { (both("what was failed, and by how much", "что не пройдено и насколько")) }
                (table(&head(), &failed)) }
        }
        @if !rows.is_empty() {
            details { summary { (both("every trial", "все испытания")) } (table(&head(), &all)) }
        }
        @if let Some(sheet) = sheet {
            h3 { (both("Error maps of extremes", "Карты ошибок на крайних случаях")) }
            div.scroll.sheet tabindex="0" { (sheet) }
        }
    })
}

/// How many passed, a row a group of cases.
fn summary(rows: &[Row]) -> Markup {
    let Summary { subjects, groups, all } = Summary::of(rows);
    let told = |Passed { passed, tried }: Passed| {
        let is_whole = passed == tried;
        html! { span.lacking[!is_whole] { (both(format!("{passed} of {tried}"), format!("{passed} из {tried}"))) } }
    };
    let head: Vec<Markup> =
        [both("passed", "пройдено")].into_iter().chain(subjects.iter().map(|subject| html! { (subject) })).collect();
    let of_group = |(name, cells): &(String, Vec<Option<Passed>>)| {
        let cells = cells.iter().map(|cell| cell.map_or_else(dash, told));
        [html! { code { (name) } " " (group_name(name)) }].into_iter().chain(cells).collect()
    };
    let total = [both("all", "всего")].into_iter().chain(all.into_iter().map(told)).collect();
    table(&head, &groups.iter().map(of_group).chain([total]).collect::<Vec<Vec<_>>>())
}

/// What a group of cases is about.
fn group_name(id: &str) -> Markup {
    match id {
        "SC" => both("scenes scaled by 10⁻⁶ to 10⁶", "сцены в 10⁻⁶–10⁶ раз больше"),
        "TR" => both("scenes moved far away", "далеко сдвинутые сцены"),
        "DS" => both("solids far away", "далёкие тела"),
        "GR" => both("grazing rays", "скользящие лучи"),
        "TC" => both("thin and flat cylinders", "тонкие и плоские цилиндры"),
        "FB" => both("flat boxes", "плоские параллелепипеды"),
        "BX" => both("rays along faces and edges", "лучи вдоль граней и рёбер"),
        "KN" => both("needles, plates and mirror images of cones", "конусы-иглы, конусы-пластины, второй лист"),
        "TG" => both("spheres that touch", "касающиеся сферы"),
        "CF" => both("boxes that share a face", "кубы с общей гранью"),
        "IN" => both("cameras inside", "камера внутри тела"),
        "ON" => both("cameras on a surface", "камера на поверхности"),
        "LT" => both("lights inside and on surfaces", "свет внутри тела и на поверхности"),
        "DG" => both("impossible scenes", "невозможные сцены"),
        "MR" => both("closed rooms of mirrors", "замкнутые зеркальные комнаты"),
        "IT" => both("enormous intensities", "огромные яркости"),
        "N" => both("no solids, and 10⁵ of them", "ни одного тела и 10⁵ тел"),
        "IM" => both("pictures of odd sizes", "изображения необычных размеров"),
        "FV" => both("extreme fields of view", "крайние углы обзора"),
        "RD" => both("rays without a direction", "лучи без направления"),
        _ => html! {},
    }
}

fn head() -> [Markup; 6] {
    [
        both("case", "случай"),
        both("kernel", "ядро"),
        both("verdict", "итог"),
        both("worst of all that is measured", "худшее из измеренного"),
        both("measured", "измерено"),
        both("at most", "не более"),
    ]
}

fn cells(row: &Row) -> Vec<Markup> {
    let what = russian(row.what).map_or_else(|| english(row.what), |russian| both(row.what, russian));
    vec![
        html! { (row.id) },
        html! { (row.subject()) },
        if row.pass {
            both("pass", "да")
        } else {
            html! { span.lacking { (both("FAIL", "НЕТ")) } }
        },
        what,
        html! { (short(row.measured)) },
        html! { (short(row.bound)) },
    ]
}

/// What is measured, in Russian; `None` for what has no translation yet.
fn russian(what: &str) -> Option<&'static str> {
    Some(match what {
        "bright pixels too few to prove anything" => "слишком мало ярких пикселей, чтобы судить",
        "hits too few to prove anything" => "слишком мало попаданий, чтобы судить",
        "hits with NaN or infinity" => "попадания с NaN или бесконечностью",
        "pixels brighter than all that shines, or not finite" => "пиксели ярче всего светящегося или не числа",
        "pixels of solids too few to prove anything" => "слишком мало пикселей тел, чтобы судить",
        "pixels that depend on the tiling" => "пиксели, зависящие от разбиения на плитки",
        "pixels with NaN or infinity" => "пиксели с NaN или бесконечностью",
        "rays that escape from a closed room" => "лучи, ушедшие из замкнутой комнаты",
        "rays that meet again what they leave" => "лучи, вновь попавшие туда, откуда вышли",
        "rays that start far off what they leave" => "лучи, начатые далеко от того, откуда вышли",
        "rays without a direction that meet something" => "лучи без направления, попавшие во что-то",
        "scenes accepted, refused or named wrongly" => "сцены, неверно принятые, отвергнутые или названные",
        "true hits too few to prove anything" => "слишком мало верных попаданий, чтобы судить",
        "wrong faces" => "неверные грани",
        "wrong hits or misses (H)" => "неверные попадания и промахи (H)",
        "largest difference off discontinuities" => "наибольшее отличие вне границ",
        "normal (N)" => "нормаль (N)",
        "point off the surface (P)" => "точка вне поверхности (P)",
        "share of discontinuity pixels that differ" => "доля пикселей на границах, которые отличаются",
        "t off the surface (T)" => "t вне поверхности (T)",
        _ => return None,
    })
}
