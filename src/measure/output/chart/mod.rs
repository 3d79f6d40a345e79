//! Charts as data, and the one way to draw them, in pixels or in lines.

mod axis;
mod canvas;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::HPos;

use super::OutputError;
use crate::frame::Frame;
pub use axis::Axis;
pub use canvas::{BAR, CIRCLE, DIAMOND, HEXAGON, Marker, SQUARE, Shape, Stroke, TRIANGLE, TRIANGLE_DOWN, palette};
use canvas::{Canvas, Drawn, FONT};

/// Panels in rows, with one legend.
#[derive(Debug, Clone)]
pub struct Chart {
    pub title: &'static str,
    /// What measured.
    pub subtitle: String,
    /// Size of each panel between its axes, pixels.
    pub plot: [i32; 2],
    pub rows: Vec<Vec<Panel>>,
    pub legend: Vec<Sample>,
    /// Below the legend.
    pub remark: &'static str,
}

/// Lines with markers over them.
#[derive(Debug, Clone)]
pub struct Panel {
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    pub lines: Vec<Line>,
    pub marks: Vec<Mark>,
    /// Lines of text to the right.
    pub list: Vec<String>,
}

#[derive(Debug, Clone)]
pub struct Line {
    pub stroke: Stroke,
    /// Values of x and y.
    pub path: Vec<[f64; 2]>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Values of x and y.
    pub at: [f64; 2],
    /// Quartiles of y.
    pub quartiles: Option<[f64; 2]>,
    pub marker: Marker,
    pub is_ringed: bool,
    /// Stands below and to the left.
    pub label: Option<String>,
}

/// An entry of the legend.
#[derive(Debug, Clone)]
pub struct Sample {
    pub name: String,
    pub stroke: Option<Stroke>,
    pub marker: Marker,
}

/// The bitmap backend draws thick lines with jagged edges: a picture of so many times the side is averaged.
const SUPERSAMPLING: i32 = 3;

/// Around a panel's axes, pixels; above are its title and below and to the left the axes' numbers and labels.
const LEFT: i32 = 92;
const RIGHT: i32 = 20;
const TOP: i32 = 44;
const BELOW: i32 = 60;
/// Above and below all panels.
const HEAD: i32 = 68;
const LEGEND: i32 = 68;
/// Width of the list beside a panel.
const LIST: i32 = 460;
const LIST_STEP: i32 = 21;

const GRID: Stroke = Stroke { color: RGBColor(225, 225, 225), width: 1, dash: None };
const FRAME: Stroke = Stroke { color: BLACK, width: 1, dash: None };

impl Chart {
    /// Pixels.
    pub fn size(&self) -> [i32; 2] {
        let ([width, height], columns) = (self.panel(), self.rows.iter().map(Vec::len).max().unwrap_or(0));
        let has_list = self.rows.iter().flatten().any(|panel| !panel.list.is_empty());
        [width * columns as i32 + i32::from(has_list) * LIST, HEAD + height * self.rows.len() as i32 + LEGEND]
    }

    fn panel(&self) -> [i32; 2] {
        [LEFT + self.plot[0] + RIGHT, TOP + self.plot[1] + BELOW]
    }

    pub fn to_frame(&self) -> Result<Frame, OutputError> {
        register();
        let [width, height] = self.size();
        let [large_width, large_height] = [width, height].map(|side| side * SUPERSAMPLING);
        let mut bytes = vec![0; (large_width * large_height) as usize * 3];
        {
            let size = (large_width as u32, large_height as u32);
            let area = BitMapBackend::with_buffer(&mut bytes, size).into_drawing_area();
            self.draw(&area, SUPERSAMPLING).map_err(drawing_error)?;
        }
        let mut frame = Frame::new(width as u32, height as u32)?;
        let (row, block) = (large_width as usize, SUPERSAMPLING as usize);
        for (index, pixel) in frame.pixels_mut().iter_mut().enumerate() {
            let corner = (index / width as usize * row + index % width as usize) * block;
            let samples = (0..block).flat_map(|y| (0..block).map(move |x| corner + y * row + x));
            let sum = |channel| samples.clone().map(|sample| f32::from(bytes[sample * 3 + channel])).sum::<f32>();
            *pixel = [0, 1, 2].map(|channel| sum(channel) / (255 * block * block) as f32);
        }
        Ok(frame)
    }

    pub fn to_svg(&self) -> Result<String, OutputError> {
        register();
        let [width, height] = self.size();
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, (width as u32, height as u32)).into_drawing_area();
            self.draw(&area, 1).map_err(drawing_error)?;
        }
        Ok(text)
    }

    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        area.fill(&WHITE)?;
        let (canvas, [width, height], [panel_width, panel_height]) =
            (Canvas::new(area, scale), self.size(), self.panel());
        canvas.text(self.title, [width / 2, 22], 24, HPos::Center)?;
        canvas.text(&self.subtitle, [width / 2, 52], 15, HPos::Center)?;
        for (panels, row) in self.rows.iter().zip(0..) {
            for (panel, column) in panels.iter().zip(0..) {
                panel.draw(&canvas.part([column * panel_width, HEAD + row * panel_height]), self.plot)?;
            }
        }
        self.draw_legend(&canvas.part([0, height - LEGEND]))?;
        canvas.text(self.remark, [width / 2, height - LEGEND + 47], 16, HPos::Center)?;
        area.present()
    }

    fn draw_legend<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> Drawn<DB> {
        const GAP: i32 = 26;
        const SIZE: i32 = 16;
        const Y: i32 = 21;
        let lengths = self.legend.iter().map(|sample| if sample.stroke.is_some() { 46 } else { 16 } + 8);
        let widths =
            self.legend.iter().map(|sample| canvas.width_of(&sample.name, SIZE)).collect::<Result<Vec<_>, _>>()?;
        let all: i32 = lengths.clone().zip(&widths).map(|(length, width)| length + width + GAP).sum();
        let mut x = (self.size()[0] - all + GAP) / 2;
        for (Sample { name, stroke, marker }, (length, width)) in self.legend.iter().zip(lengths.zip(widths)) {
            if let Some(stroke) = *stroke {
                canvas.line(&[[x, Y], [x + length - 8, Y]], stroke)?;
            }
            canvas.marker(*marker, [x + (length - 8) / 2, Y])?;
            canvas.text(name, [x + length, Y], SIZE, HPos::Left)?;
            x += length + width + GAP;
        }
        Ok(())
    }
}

fn register() {
    // A second registration of the same font changes nothing.
    let _ = register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
}

fn drawing_error<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> OutputError {
    OutputError::Chart { reason: error.to_string() }
}

impl Panel {
    /// `plot`: pixels between the axes.
    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, plot: [i32; 2]) -> Drawn<DB> {
        let place = |[x, y]: [f64; 2]| self.place([x, y], plot);
        self.draw_axes(canvas, plot)?;
        for Line { stroke, path } in &self.lines {
            canvas.line(&path.iter().map(|&at| place(at)).collect::<Vec<_>>(), *stroke)?;
        }
        for &Mark { at, quartiles, marker, is_ringed, .. } in &self.marks {
            if let Some(quartiles) = quartiles {
                draw_whisker(canvas, quartiles.map(|quartile| place([at[0], quartile])), marker.color)?;
            }
            canvas.marker(marker, place(at))?;
            if is_ringed {
                canvas.ring(place(at))?;
            }
        }
        for (label, place) in self.label_places(plot) {
            canvas.text(label, place, 14, HPos::Center)?;
        }
        for (line, step) in self.list.iter().zip(0..) {
            canvas.text(line, [LEFT + plot[0] + 36, TOP + step * LIST_STEP], 15, HPos::Left)?;
        }
        Ok(())
    }

    fn place(&self, [x, y]: [f64; 2], plot: [i32; 2]) -> [i32; 2] {
        let pixels = |share: f64, length: i32| (share * f64::from(length)).round() as i32;
        [LEFT + pixels(self.x.share(x), plot[0]), TOP + pixels(1.0 - self.y.share(y), plot[1])]
    }

    fn draw_axes<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, plot: [i32; 2]) -> Drawn<DB> {
        let ([left, right], [top, bottom]) = ([LEFT, LEFT + plot[0]], [TOP, TOP + plot[1]]);
        let [middle_x, middle_y] = [i32::midpoint(left, right), i32::midpoint(top, bottom)];
        canvas.text(&self.title, [middle_x, 22], 18, HPos::Center)?;
        for tick in self.x.ticks() {
            let [x, _] = self.place([tick, 0.0], plot);
            canvas.line(&[[x, top], [x, bottom]], GRID)?;
            canvas.text(&axis::plain(tick), [x, bottom + 15], 15, HPos::Center)?;
        }
        for tick in self.y.ticks() {
            let [_, y] = self.place([0.0, tick], plot);
            canvas.line(&[[left, y], [right, y]], GRID)?;
            canvas.text(&axis::plain(tick), [left - 8, y], 15, HPos::Right)?;
        }
        canvas.line(&[[left, top], [left, bottom], [right, bottom]], FRAME)?;
        canvas.text(self.x.label, [middle_x, bottom + 40], 17, HPos::Center)?;
        canvas.turned_text(self.y.label, [26, middle_y], 17)
    }

    /// Below and to the left of their marks, but to the right of the axis, left of which its own numbers are, and none
    /// over another.
    fn label_places(&self, plot: [i32; 2]) -> Vec<(&str, [i32; 2])> {
        const OFF: i32 = 13;
        let mut places: Vec<(&str, [i32; 2])> = Vec::new();
        for mark in &self.marks {
            let Some(label) = &mark.label else { continue };
            let [x, y] = self.place(mark.at, plot);
            let x = if x - OFF < LEFT + OFF { x + OFF } else { x - OFF };
            let is_taken = |y: i32| places.iter().any(|(_, [a, b])| (x - a).abs() < 16 && (y - b).abs() < OFF);
            let y = (y + OFF..).find(|&y| !is_taken(y)).unwrap_or(y);
            places.push((label, [x, y]));
        }
        places
    }
}

fn draw_whisker<DB: DrawingBackend>(canvas: &Canvas<'_, DB>, ends: [[i32; 2]; 2], color: RGBColor) -> Drawn<DB> {
    let stroke = Stroke { color, width: 1, dash: None };
    canvas.line(&ends, stroke)?;
    ends.into_iter().try_for_each(|[x, y]| canvas.line(&[[x - 6, y], [x + 6, y]], stroke))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Time against error, both logarithmic, with lines of samples.
    fn example() -> Chart {
        let looks = [(palette::BLUE, CIRCLE, None), (palette::VERMILION, DIAMOND, Some([8, 4]))];
        let of_look = |(color, shape, dash): (RGBColor, Shape, Option<[i32; 2]>)| {
            let marker = Marker { shape, color, is_hollow: dash.is_some() };
            (Stroke { color, width: 2, dash }, marker)
        };
        let path: Vec<[f64; 2]> = (0..5).map(|n| [10f64.powi(n), 10f64.powi(-n)]).collect();
        let mark = |&[x, y]: &[f64; 2], marker| Mark {
            at: [x, y],
            quartiles: Some([0.9 * y, 1.1 * y]),
            marker,
            is_ringed: x == 1.0,
            label: Some(x.to_string()),
        };
        let panel = Panel {
            title: "a < b".to_owned(),
            x: Axis::of_decades("time", &[1.0, 1e4]),
            y: Axis::around("error", &[1e-4, 1.0]),
            lines: looks.map(|look| Line { stroke: of_look(look).0, path: path.clone() }).to_vec(),
            marks: looks.iter().flat_map(|&look| path.iter().map(move |at| mark(at, of_look(look).1))).collect(),
            list: vec!["a list".to_owned()],
        };
        let sample =
            |name: &str, look| Sample { name: name.to_owned(), stroke: Some(of_look(look).0), marker: of_look(look).1 };
        Chart {
            title: "a chart",
            subtitle: "of nothing".to_owned(),
            plot: [300, 200],
            rows: vec![vec![panel.clone(), panel]],
            legend: vec![sample("one", looks[0]), sample("two", looks[1])],
            remark: "a remark",
        }
    }

    #[test]
    fn both_forms_show_all_that_a_chart_has() {
        let chart = example();
        let frame = chart.to_frame().unwrap();
        assert_eq!([frame.width(), frame.height()].map(|side| side as i32), chart.size());
        let text = chart.to_svg().unwrap();
        assert!(text.starts_with("<svg ") && text.trim_end().ends_with("</svg>"));
        for part in ["a chart", "of nothing", "a &lt; b", "time", "error", "a list", "one", "two", "a remark", "10000"]
        {
            assert!(text.contains(part), "{part:?} is not in:\n{text}");
        }
        for RGBColor(red, green, blue) in [palette::BLUE, palette::VERMILION] {
            let wanted = [red, green, blue].map(|channel| f32::from(channel) / 255.0);
            // The averaging rounds far below the half of an 8-bit step.
            let is_same = |pixel: &[f32; 3]| pixel.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 0.5 / 255.0);
            assert!(frame.pixels().iter().any(is_same));
            assert!(text.contains(&format!("#{red:02X}{green:02X}{blue:02X}")));
        }
    }

    #[test]
    fn no_label_is_over_another() {
        let chart = example();
        let places = chart.rows[0][0].label_places(chart.plot);
        assert_eq!(places.len(), 10);
        for (place, (_, [x, y])) in places.iter().enumerate() {
            let is_apart = |(_, [a, b]): &(&str, [i32; 2])| (x - a).abs() >= 16 || (y - b).abs() >= 13;
            assert!(places[..place].iter().all(is_apart), "{places:?}");
        }
    }
}
