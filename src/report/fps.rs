//! Frames a second: table 4.1 of the course work measured anew.

use maud::{Markup, html};

use super::text::{both, table_of};
use super::{ReportError, picture};
use crate::measure::Clock;
use crate::measure::fps_table::{FpsTable, agreement, chart, spreads};

pub fn body(fps: &FpsTable) -> Result<Markup, ReportError> {
    if fps.cells.is_empty() {
        return Ok(html! {});
    }
    let drawn = picture::chart(&chart(fps).to_svg()?, "frames a second by number and kind of solids");
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
            (table_of(&spreads(fps, algorithm, fps.clock())))
        }
        h3 { (both("The course work's conclusions", "Выводы курсовой работы")) }
        (table_of(&agreement(fps)))
    })
}
