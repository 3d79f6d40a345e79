//! The gallery in small, and where each kernel is off the reference.

use maud::{Markup, html};

use super::picture::image;
use super::text::{both, english};
use super::{NamedMaps, ReportError};
use crate::measure::{Drawn, KernelMap, error_scale};
use crate::settings::three_digits;

/// Pixels.
const SCALE: [u32; 2] = [360, 12];
/// A tick a decade; the scale begins and ends with one.
const TICKS: [&str; 10] = ["10⁻⁹", "10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "1"];

pub fn body(scenes: &[NamedMaps]) -> Result<Markup, ReportError> {
    let scenes: Vec<Markup> = scenes.iter().map(of_scene).collect::<Result<_, _>>()?;
    Ok(html! {
        p {
            (both(
                "Each scene by the accurate kernel in f32, and beside it the errors of every kernel: the largest difference \
                 of a linear channel from the reference, which the CPU calculates in f64. Both are rounded to f32 first, as \
                 files keep them: no error means right to the last bit that is kept. The course work's kernel draws another \
                 model, and its maps show that, too.",
                "Каждая сцена нарисована точным ядром в f32; рядом — ошибки всех ядер: наибольшее отличие линейного канала \
                 от эталона, который считает процессор в f64. Оба сначала округлены до f32, как в файлах: нет ошибки — \
                 значит верно до последнего хранимого бита. Ядро курсовой работы рисует другую модель, и это на его картах \
                 тоже видно.",
            ))
        }
        (legend()?)
        @for scene in &scenes { (scene) }
    })
}

/// The shades of errors with their numbers.
pub fn legend() -> Result<Markup, ReportError> {
    let [width, height] = SCALE;
    let scale = image(&error_scale(width, height)?, "")?;
    Ok(html! {
        div.legend {
            (scale)
            div.ticks aria-hidden="true" { @for tick in TICKS { span { (tick) } } }
            p {
                (both(
                    "Error of a linear channel (1 is white); darkest: 10⁻⁹ or none, red: not a number.",
                    "Ошибка линейного канала (1 — белый); самый тёмный: 10⁻⁹ или нет ошибки, красный: не число.",
                ))
            }
        }
    })
}

fn of_scene(scene: &NamedMaps) -> Result<Markup, ReportError> {
    let NamedMaps { name, english, russian, maps } = scene;
    let picture = image(&maps.picture, name)?;
    let of_kernel: Vec<Markup> = maps.maps.iter().map(|map| of_kernel(name, map)).collect::<Result<_, _>>()?;
    Ok(html! {
        h3 { code { (name) } " " (both(english, russian)) }
        div.pictures {
            figure { (picture) figcaption { (both("picture", "изображение")) } }
            @for figure in &of_kernel { (figure) }
        }
    })
}

fn of_kernel(scene: &str, map: &KernelMap) -> Result<Markup, ReportError> {
    let name = map.setting.to_string();
    let shown = match &map.drawn {
        Ok(Drawn { map, .. }) => image(map, &format!("{scene}: errors of {name}"))?,
        Err(reason) => html! { p.absent { (both("not drawn: ", "не нарисовано: ")) (english(reason)) } },
    };
    Ok(html! {
        figure {
            (shown)
            figcaption { b { (name) } @if let Ok(Drawn { error, .. }) = &map.drawn { br; (told(error)) } }
        }
    })
}

fn told(error: &crate::measure::ImageError) -> Markup {
    let digits = |value: Option<f64>| value.map_or("–".to_owned(), three_digits);
    let (largest, rmse) = (digits(error.max_abs), digits(error.rmse));
    let not_finite = error.non_finite_pixels;
    html! {
        (both(format!("at most {largest}, RMSE {rmse}"), format!("не более {largest}, СКО {rmse}")))
        @if not_finite > 0 { (both(format!(", NaN: {not_finite} px"), format!(", NaN: {not_finite} пикс."))) }
    }
}
