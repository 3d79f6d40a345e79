//! Ray tracing, screen-space reflections and path tracing: table 1.1 of the course work measured.

use maud::{Markup, html};

use super::ReportError;
use super::picture::{self, image};
use super::text::{both, table_of};
use crate::measure::algorithms::{Comparison, SceneComparison, chart, contact_sheet, figures, ranks, verdicts};
use crate::settings::three_digits;

pub fn body(comparison: &Comparison) -> Result<Markup, ReportError> {
    if comparison.scenes.is_empty() {
        return Ok(html! {});
    }
    let conditions = &comparison.conditions;
    let (width, height, seeds) = (conditions.width, conditions.height, conditions.seeds);
    let sheet = image(&contact_sheet(comparison)?, "a row a scene: the truth, then each algorithm's picture")?;
    Ok(html! {
        p {
            (both(
                format!(
                    "Every algorithm draws the same light ({width}x{height} pixels, pictures of each: {seeds}, in turns). \
                     The truth is path tracing by all seeds together; each seed is judged by the others. Noise is the \
                     standard deviation between the pictures."
                ),
                format!(
                    "Все алгоритмы рисуют один и тот же свет ({width}x{height} пикселей, изображений каждого: {seeds}, по \
                     очереди). Истина — трассировка путей по всем зёрнам вместе; о каждом зерне судят по остальным. Шум — \
                     стандартное отклонение между изображениями."
                ),
            ))
        }
        (picture::chart(&chart(comparison).to_svg()?, "time of a picture against its error, a panel a scene"))
        @for scene in &comparison.scenes { (of_scene(comparison, scene)) }
        div.scroll.sheet tabindex="0" { (sheet) }
    })
}

fn of_scene(comparison: &Comparison, scene: &SceneComparison) -> Markup {
    let (samples, error) = (scene.truth_samples, three_digits(scene.truth_standard_error));
    html! {
        h3 { code { (scene.scene) } }
        p { (both(
            format!("The truth: samples a pixel: {samples}, standard error {error}."),
            format!("Истина: выборок на пиксель — {samples}, стандартная ошибка {error}."),
        )) }
        (table_of(&figures(scene)))
        @for &samples in &comparison.conditions.samples {
            details {
                summary { (both(
                    format!("the note's ranks, path tracing, samples a pixel: {samples}"),
                    format!("места по записке, трассировка путей, выборок на пиксель: {samples}"),
                )) }
                (table_of(&verdicts(&ranks(scene, samples))))
            }
        }
    }
}
