//! The chart in the style of figure 4.2: frames a second against the number of solids, a line a kind; the published
//! table and each kernel's own in panels with one scale.

mod marks;
mod panels;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::FpsTable;
use crate::frame::Frame;
use crate::measure::output::OutputError;
use crate::measure::output::drawing::{self, Chart, Drawn, FONT, draw_text};
use marks::{draw_legend, draw_line, draw_marker, draw_quartiles, look};
use panels::{Panel, Row, rows};

/// Of a panel, and of the strips above and below all of them, pixels.
const PANEL: [i32; 2] = [520, 400];
const PANEL_TITLE_HEIGHT: i32 = 30;
const HEAD_HEIGHT: i32 = 68;
const LEGEND_HEIGHT: i32 = 44;
const MARGIN: i32 = 16;

/// The chart as a picture.
pub fn png(table: &FpsTable) -> Result<Frame, OutputError> {
    drawing::png(&TableChart(table))
}

/// The chart as an SVG document.
pub fn svg(table: &FpsTable) -> Result<String, OutputError> {
    drawing::svg(&TableChart(table))
}

struct TableChart<'a>(&'a FpsTable);

impl Chart for TableChart<'_> {
    /// Two rows of panels.
    fn size(&self) -> [i32; 2] {
        let panels = 1 + self.0.plan.algorithms.len() as i32;
        [PANEL[0] * panels + 2 * MARGIN, HEAD_HEIGHT + 2 * PANEL[1] + LEGEND_HEIGHT]
    }

    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        let [width, height] = self.size();
        area.fill(&WHITE)?;
        let middle = width / 2 * scale;
        let title = "Frames a second by number and kind of solids · Кадры в секунду от числа и вида тел";
        draw_text(area, title, (middle, 22 * scale), 24 * scale)?;
        draw_text(area, &subtitle(self.0), (middle, 50 * scale), 15 * scale)?;
        for (place, row) in rows(self.0).iter().enumerate() {
            draw_row(area, row, HEAD_HEIGHT + place as i32 * PANEL[1], scale)?;
        }
        draw_legend(area, (width / 2, height - LEGEND_HEIGHT / 2), scale)?;
        area.present()
    }
}

/// What measured.
fn subtitle(table: &FpsTable) -> String {
    let (machine, plan) = (&table.machine, &table.plan);
    let watched = if plan.validation { " · under validation" } else { "" };
    format!(
        "{} ({}) · {}x{}, {} generations · {}{watched}",
        machine.device, machine.driver, plan.width, plan.height, plan.generations, machine.program
    )
}

/// `top`: in pixels of the chart.
fn draw_row<DB: DrawingBackend>(area: &DrawingArea<DB, Shift>, row: &Row, top: i32, scale: i32) -> Drawn<DB> {
    let points = || row.panels.iter().flat_map(Panel::points);
    let (fewest, most) =
        points().map(|point| point.count as f64).fold((f64::INFINITY, 0.0_f64), |(a, b), n| (a.min(n), b.max(n)));
    let speeds = points().flat_map(|point| [Some(point.speed), point.quartiles.map(|[fast, _]| fast)]);
    let fastest = speeds.flatten().fold(1.0, f64::max);
    for (place, panel) in row.panels.iter().enumerate() {
        let corner = (MARGIN + place as i32 * PANEL[0], top);
        let part = area.clone().shrink((corner.0 * scale, corner.1 * scale), (PANEL[0] * scale, PANEL[1] * scale));
        let mut chart = ChartBuilder::on(&part)
            .margin(6 * scale)
            .margin_top(PANEL_TITLE_HEIGHT * scale)
            .x_label_area_size(50 * scale)
            .y_label_area_size(62 * scale)
            // A published table is always there: there are points.
            .build_cartesian_2d(fewest - 5.0..most + 5.0, 0.0..fastest * 1.06)?;
        chart
            .configure_mesh()
            .x_labels(12)
            .y_labels(8)
            .max_light_lines(0)
            .bold_line_style(RGBColor(225, 225, 225).stroke_width(scale as u32))
            .axis_style(BLACK.stroke_width(scale as u32))
            .set_all_tick_mark_size(5 * scale)
            .label_style((FONT, 16 * scale))
            .axis_desc_style((FONT, 17 * scale))
            .x_label_formatter(&|count| format!("{count:.0}"))
            .y_label_formatter(&|speed| format!("{speed:.1}"))
            .x_desc("n, solids · число тел")
            .y_desc(if place == 0 { row.label } else { "" })
            .draw()?;
        let (columns, rows) = chart.plotting_area().get_pixel_range();
        let title_middle = (columns.start.midpoint(columns.end), rows.start - PANEL_TITLE_HEIGHT / 2 * scale);
        draw_text(area, &panel.title, title_middle, 18 * scale)?;
        draw_lines(area, panel, &|count, speed| chart.backend_coord(&(count as f64, speed)), scale)?;
    }
    Ok(())
}

/// `place_of`: pixels of the backend.
fn draw_lines<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    panel: &Panel,
    place_of: &dyn Fn(usize, f64) -> (i32, i32),
    scale: i32,
) -> Drawn<DB> {
    for (kind, points) in &panel.lines {
        let path: Vec<(i32, i32)> = points.iter().map(|point| place_of(point.count, point.speed)).collect();
        draw_line(area, *kind, &path, scale)?;
        for (point, &middle) in points.iter().zip(&path) {
            if let Some(quartiles) = point.quartiles {
                let ends = quartiles.map(|speed| place_of(point.count, speed));
                draw_quartiles(area, ends, look(*kind).color, scale)?;
            }
            draw_marker(area, *kind, middle, scale)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fps_table::tests::{BOTH, example};
    use crate::scene::SolidKind;

    #[test]
    fn both_forms_show_every_line_and_a_table_of_nothing_can_be_drawn_too() {
        let mut table = example(&[10, 50, 100], &BOTH);
        for _ in 0..2 {
            let frame = png(&table).unwrap();
            assert_eq!([frame.width(), frame.height()].map(|side| side as i32), TableChart(&table).size());
            let has = |color: RGBColor| {
                let wanted = [color.0, color.1, color.2].map(|channel| f32::from(channel) / 255.0);
                // The averaging rounds far below the half of an 8-bit step.
                let is_same = |pixel: &[f32; 3]| pixel.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 0.5 / 255.0);
                frame.pixels().iter().any(is_same)
            };
            let text = svg(&table).unwrap();
            assert!(text.starts_with("<svg ") && text.trim_end().ends_with("</svg>"));
            for kind in SolidKind::ALL {
                let color = look(kind).color;
                assert!(has(color), "{kind:?}");
                assert!(text.contains(look(kind).name), "{kind:?}");
                assert!(text.contains(&format!("#{:02X}{:02X}{:02X}", color.0, color.1, color.2)), "{kind:?}");
            }
            assert!(text.contains("driver 1") && text.contains("160x70"));
            table.cells.clear();
        }
    }
}
