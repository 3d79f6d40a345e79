//! Trials as tables, for people and for programs.

use super::Row;
use crate::measure::output::{Entry, Table, Words};

/// A row a trial.
pub fn trials<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Table {
    let head = vec![
        Words::both("case", "случай"),
        Words::both("kernel", "ядро"),
        Words::both("verdict", "итог"),
        Words::both("worst of all that is measured", "худшее из измеренного"),
        Words::both("measured", "измерено"),
        Words::both("at most", "не более"),
    ];
    let row = |row: &Row| {
        let pass = Entry::Text(Words::both("pass", "да"));
        vec![
            Entry::of(&row.id),
            Entry::of(row.subject()),
            if row.pass { pass } else { Entry::Lacking(Words::both("FAIL", "НЕТ")) },
            Entry::Text(Words::both(row.what, russian(row.what))),
            Entry::of(short(row.measured)),
            Entry::of(short(row.bound)),
        ]
    };
    Table { head, rows: rows.into_iter().map(row).collect() }
}

/// How many passed of how many, a row a group of cases, a column a kernel and precision, both in the rows' order.
pub fn summary(rows: &[Row]) -> Table {
    let (mut subjects, mut groups): (Vec<String>, Vec<&str>) = (Vec::new(), Vec::new());
    for row in rows {
        if !subjects.contains(&row.subject()) {
            subjects.push(row.subject());
        }
        if !groups.contains(&group(row)) {
            groups.push(group(row));
        }
    }
    let line = |name: Words, is_wanted: &dyn Fn(&Row) -> bool| {
        let passed = |subject: &String| {
            let tried = || rows.iter().filter(|row| is_wanted(row) && row.subject() == *subject);
            let (passed, tried) = (tried().filter(|row| row.pass).count(), tried().count());
            let words = Words::both(format!("{passed} of {tried}"), format!("{passed} из {tried}"));
            match tried {
                // No case of the group is for that kernel.
                0 => Entry::Absent,
                _ if passed < tried => Entry::Lacking(words),
                _ => Entry::Text(words),
            }
        };
        [Entry::Text(name)].into_iter().chain(subjects.iter().map(passed)).collect()
    };
    let of_groups = groups.iter().map(|name| line(group_name(name), &|row| group(row) == *name));
    let rows = of_groups.chain([line(Words::both("all", "всего"), &|_| true)]).collect();
    let head = [Words::both("passed", "пройдено")].into_iter().chain(subjects.iter().map(Into::into)).collect();
    Table { head, rows }
}

/// Letters before the number.
fn group(row: &Row) -> &str {
    row.id.split('-').next().unwrap_or(&row.id)
}

/// What a group of cases is about, behind its letters.
fn group_name(id: &str) -> Words {
    let (english, russian) = match id {
        "SC" => ("scenes scaled by 10⁻⁶ to 10⁶", "сцены в 10⁻⁶–10⁶ раз больше"),
        "TR" => ("scenes moved far away", "далеко сдвинутые сцены"),
        "DS" => ("solids far away", "далёкие тела"),
        "GR" => ("grazing rays", "скользящие лучи"),
        "TC" => ("thin and flat cylinders", "тонкие и плоские цилиндры"),
        "FB" => ("flat boxes", "плоские параллелепипеды"),
        "BX" => ("rays along faces and edges", "лучи вдоль граней и рёбер"),
        "KN" => ("needles, plates and mirror images of cones", "конусы-иглы, конусы-пластины, второй лист"),
        "TG" => ("spheres that touch", "касающиеся сферы"),
        "CF" => ("boxes that share a face", "кубы с общей гранью"),
        "IN" => ("cameras inside", "камера внутри тела"),
        "ON" => ("cameras on a surface", "камера на поверхности"),
        "LT" => ("lights inside and on surfaces", "свет внутри тела и на поверхности"),
        "DG" => ("impossible scenes", "невозможные сцены"),
        "MR" => ("closed rooms of mirrors", "замкнутые зеркальные комнаты"),
        "IT" => ("enormous intensities", "огромные яркости"),
        "N" => ("no solids, and 10⁵ of them", "ни одного тела и 10⁵ тел"),
        "IM" => ("pictures of odd sizes", "изображения необычных размеров"),
        "FV" => ("extreme fields of view", "крайние углы обзора"),
        "RD" => ("rays without a direction", "лучи без направления"),
        "WD" => ("wide grounds", "широкие основания"),
        "MS" => ("mixed scales", "разные масштабы"),
        "LP" => ("lights in planes of faces", "свет в плоскости грани"),
        "AL" => ("every algorithm: odd sizes, cameras inside", "все алгоритмы: необычные размеры, камера внутри"),
        "LR" => ("scenes within a light's sphere", "сцены внутри сферы источника"),
        _ => return id.into(),
    };
    Words::join(&[id.into(), Words::both(english, russian)], " ")
}

/// What is measured; as it is where it has no translation.
fn russian(what: &str) -> &str {
    match what {
        "bright pixels too few to prove anything" => "слишком мало ярких пикселей, чтобы судить",
        "hits too few to prove anything" => "слишком мало попаданий, чтобы судить",
        "hits with NaN or infinity" => "попадания с NaN или бесконечностью",
        "pixels brighter than all that shines, or not finite" => "пиксели ярче всего светящегося или не числа",
        "pixels of solids too few to prove anything" => "слишком мало пикселей тел, чтобы судить",
        "pixels other than the background" => "пиксели, отличные от фона",
        "pixels that depend on the tiling" => "пиксели, зависящие от разбиения на плитки",
        "pixels with NaN, infinity or less than no light" => "пиксели с NaN, бесконечностью или отрицательным светом",
        "pixels with NaN or infinity" => "пиксели с NaN или бесконечностью",
        "rays that escape from a closed room" => "лучи, ушедшие из замкнутой комнаты",
        "rays that meet again what they leave" => "лучи, вновь попавшие туда, откуда вышли",
        "rays that start far off what they leave" => "лучи, начатые далеко от того, откуда вышли",
        "rays without a direction that meet something" => "лучи без направления, попавшие во что-то",
        "scenes accepted, refused or named wrongly" => "сцены, неверно принятые, отвергнутые или названные",
        "share of pixels that are wrong without a word" => "доля пикселей, неверных без предупреждения",
        "true hits too few to prove anything" => "слишком мало верных попаданий, чтобы судить",
        "wrong faces" => "неверные грани",
        "wrong hits or misses (H)" => "неверные попадания и промахи (H)",
        "largest difference off discontinuities" => "наибольшее отличие вне границ",
        "normal (N)" => "нормаль (N)",
        "point off the surface (P)" => "точка вне поверхности (P)",
        "share of discontinuity pixels that differ" => "доля пикселей на границах, которые отличаются",
        "t off the surface (T)" => "t вне поверхности (T)",
        _ => what,
    }
}

/// Counts whole, the rest to three digits.
fn short(value: f64) -> String {
    match value {
        _ if !value.is_finite() => value.to_string(),
        _ if value.fract() == 0.0 && value.abs() < 1e6 => format!("{value:.0}"),
        _ if (1e-3..1e4).contains(&value.abs()) => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::stability::trials::tests::row;

    #[test]
    fn passes_are_counted_by_group_and_kernel() {
        let rows = [
            row("SC-1", "course", false),
            row("SC-1", "whitted", true),
            row("SC-2", "course", true),
            row("N-0", "scene", true),
        ];
        let table = summary(&rows);
        assert_eq!(table.head[1..], ["course f32", "whitted f32", "scene"].map(Words::from));
        assert_eq!(table.rows[0][1], Entry::Lacking(Words::both("1 of 2", "1 из 2")));
        assert_eq!(table.rows[1][1..3], [Entry::Absent, Entry::Absent]);
        assert_eq!(table.rows[2][3], Entry::Text(Words::both("1 of 1", "1 из 1")));
        assert_eq!(summary(&[]).rows.len(), 1);
    }
}
