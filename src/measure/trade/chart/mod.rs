//! Time against error, both logarithmic: a panel a scene, and beside it what the front's numbers stand for.

mod axis;
mod marks;

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::figures::figures;
use super::{Counted, Question, SceneTrade, Target, Trade};
use crate::frame::Frame;
use crate::measure::output::OutputError;
use crate::measure::output::drawing::{self, Chart, Drawn, FONT, draw_text};
use crate::settings::three_digits;
use axis::LogAxis;
use marks::{Group, draw_marker, draw_ring};

/// Pixels.
const WIDTH: i32 = 1180;
const HEAD_HEIGHT: i32 = 72;
const PANEL_HEIGHT: i32 = 470;
const LEGEND_HEIGHT: i32 = 68;
/// The plotting area, from a panel's top.
const PLOT_X: [i32; 2] = [92, 700];
const PLOT_Y: [i32; 2] = [44, 410];
const LIST_LEFT: i32 = 736;
const LIST_STEP: i32 = 21;
/// That many lines of a list fit beside a panel.
const LIST_LINES: usize = 18;

/// The chart as a picture.
pub fn png(trade: &Trade) -> Result<Frame, OutputError> {
    drawing::png(&TradeChart(trade))
}

/// The chart as an SVG document.
pub fn svg(trade: &Trade) -> Result<String, OutputError> {
    drawing::svg(&TradeChart(trade))
}

struct TradeChart<'a>(&'a Trade);

impl Chart for TradeChart<'_> {
    fn size(&self) -> [i32; 2] {
        [WIDTH, HEAD_HEIGHT + PANEL_HEIGHT * self.0.scenes.len() as i32 + LEGEND_HEIGHT]
    }

    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        let Self(trade) = self;
        let [width, height] = self.size();
        area.fill(&WHITE)?;
        let title = "The price of accuracy: time against error · Цена точности: время и ошибка";
        draw_text(area, title, (width / 2 * scale, 24 * scale), 24 * scale)?;
        draw_text(area, &subtitle(trade), (width / 2 * scale, 54 * scale), 15 * scale)?;
        for (place, scene) in trade.scenes.iter().enumerate() {
            let top = HEAD_HEIGHT + place as i32 * PANEL_HEIGHT;
            let part = area.clone().shrink((0, top * scale), (width * scale, PANEL_HEIGHT * scale));
            Panel::new(scene, trade).draw(&part, scale)?;
        }
        draw_legend(area, height - LEGEND_HEIGHT / 2, scale)?;
        area.present()
    }
}

/// What measured.
fn subtitle(trade: &Trade) -> String {
    let Trade { machine, conditions, .. } = trade;
    let watched = if conditions.validation { " · under validation" } else { "" };
    format!(
        "{} ({}) · {}x{} · {}{watched}",
        machine.device, machine.driver, conditions.width, conditions.height, machine.program
    )
}

/// A setting in the chart.
#[derive(Debug, Clone, PartialEq)]
struct Mark {
    name: String,
    group: Group,
    is_proven: bool,
    error: f64,
    time_ms: f64,
    is_on_front: bool,
    /// The questions that it answers.
    answers: Vec<Question>,
}

/// One scene.
struct Panel {
    title: String,
    x_label: &'static str,
    /// By error.
    marks: Vec<Mark>,
    questions: Vec<Question>,
    /// Pixels of the chart, from the panel's corner.
    x: LogAxis,
    y: LogAxis,
}

impl Panel {
    fn new(scene: &SceneTrade, trade: &Trade) -> Self {
        let conditions = &trade.conditions;
        let answered = |place: usize| {
            let is_answer = |question: &&Question| scene.answer(**question, conditions.counted) == Some(place);
            conditions.questions.iter().filter(is_answer).copied().collect()
        };
        let figures = figures(scene, conditions);
        let mark = |(place, figures): (usize, &super::Figures)| {
            let point = &scene.points[place];
            Some(Mark {
                name: figures.name.clone(),
                group: Group::of(&point.setting),
                is_proven: point.bound.is_some(),
                error: figures.largest_error?,
                time_ms: figures.time_ns? / 1e6,
                is_on_front: figures.is_on_front,
                answers: answered(place),
            })
        };
        let mut marks: Vec<Mark> = figures.iter().enumerate().filter_map(mark).collect();
        marks.sort_by(|a, b| a.error.total_cmp(&b.error).then(b.time_ms.total_cmp(&a.time_ms)));
        let x_label = match (conditions.target, conditions.counted) {
            (Target::Point, Counted::AllPixels) => "largest error of a channel · наибольшая ошибка",
            (Target::Point, Counted::OffDiscontinuities) => "largest error off edges · наибольшая ошибка вне границ",
            (Target::Area, Counted::AllPixels) => "largest error against area means · наибольшая ошибка от среднего",
            (Target::Area, Counted::OffDiscontinuities) => {
                "largest error off edges, against area means · вне границ, от среднего"
            }
        };
        let mut title = format!("{}: {} solids, {} generations", scene.scene, scene.solids, scene.max_depth);
        if !scene.complete {
            title += " (not complete)";
        }
        let left = scene.points.len() - marks.len();
        if left > 0 {
            title += &format!("; {left} not drawn, whose error is no number");
        }
        let mut errors: Vec<f64> = marks.iter().map(|mark| mark.error).collect();
        let mut times_ms: Vec<f64> = marks.iter().map(|mark| mark.time_ms).collect();
        for question in &conditions.questions {
            match *question {
                Question::Error(error) => errors.push(error),
                Question::Fps(fps) => times_ms.push(1e3 / fps),
            }
        }
        let x = LogAxis::of_decades(&errors, PLOT_X);
        let y = LogAxis::around(&times_ms, [PLOT_Y[1], PLOT_Y[0]]);
        Self { title, x_label, marks, questions: conditions.questions.clone(), x, y }
    }

    fn front(&self) -> impl Iterator<Item = &Mark> {
        self.marks.iter().filter(|mark| mark.is_on_front)
    }

    fn place(&self, mark: &Mark, scale: i32) -> (i32, i32) {
        (self.x.place(mark.error) * scale, self.y.place(mark.time_ms) * scale)
    }

    /// Of the front's numbers, pixels of the chart: below and left of the front there is nothing else, and left of the
    /// axis are the axis's own.
    fn number_places(&self) -> Vec<(i32, i32)> {
        const OFF: i32 = 13;
        let mut places: Vec<(i32, i32)> = Vec::new();
        for mark in self.front() {
            let (x, mut y) = self.place(mark, 1);
            let x = if x - OFF < PLOT_X[0] + OFF { x + OFF } else { x - OFF };
            y += OFF;
            let is_taken =
                |y| places.iter().any(|&(other_x, other_y)| (x - other_x).abs() < 16 && i32::abs(y - other_y) < OFF);
            while is_taken(y) {
                y += 1;
            }
            places.push((x, y));
        }
        places
    }

    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        let middle = i32::midpoint(PLOT_X[0], PLOT_X[1]) * scale;
        draw_text(area, &self.title, (middle, 22 * scale), 18 * scale)?;
        self.draw_axes(area, scale)?;
        self.draw_questions(area, scale)?;
        self.draw_front(area, scale)?;
        for mark in &self.marks {
            let place = self.place(mark, scale);
            draw_marker(area, mark.group, mark.is_proven, place, scale)?;
            if !mark.answers.is_empty() {
                draw_ring(area, place, scale)?;
            }
        }
        for (number, (x, y)) in self.number_places().into_iter().enumerate() {
            draw_text(area, &(number + 1).to_string(), (x * scale, y * scale), 14 * scale)?;
        }
        self.draw_list(area, scale)
    }

    fn draw_axes<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        let ([left, right], [top, bottom]) = (PLOT_X.map(|x| x * scale), PLOT_Y.map(|y| y * scale));
        let grid = RGBColor(225, 225, 225).stroke_width(scale as u32);
        for tick in self.x.ticks() {
            let x = self.x.place(tick) * scale;
            area.draw(&PathElement::new(vec![(x, top), (x, bottom)], grid))?;
            draw_text(area, &plain(tick), (x, bottom + 15 * scale), 15 * scale)?;
        }
        for tick in self.y.ticks() {
            let y = self.y.place(tick) * scale;
            area.draw(&PathElement::new(vec![(left, y), (right, y)], grid))?;
            let style = style(15 * scale, HPos::Right);
            area.draw(&Text::new(plain(tick), (left - 8 * scale, y), style))?;
        }
        let frame = vec![(left, top), (left, bottom), (right, bottom)];
        area.draw(&PathElement::new(frame, BLACK.stroke_width(scale as u32)))?;
        let middle = i32::midpoint(left, right);
        draw_text(area, self.x_label, (middle, bottom + 40 * scale), 17 * scale)?;
        let turned = TextStyle::from((FONT, 17 * scale).into_font())
            .transform(FontTransform::Rotate270)
            .pos(Pos::new(HPos::Center, VPos::Center));
        area.draw(&Text::new("ms a frame · мс на кадр", (26 * scale, i32::midpoint(top, bottom)), turned))
    }

    /// What is asked for, dashed.
    fn draw_questions<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        for question in &self.questions {
            let line = match *question {
                Question::Error(error) => [(self.x.place(error), PLOT_Y[0]), (self.x.place(error), PLOT_Y[1])],
                Question::Fps(fps) => [(PLOT_X[0], self.y.place(1e3 / fps)), (PLOT_X[1], self.y.place(1e3 / fps))],
            };
            let line = line.map(|(x, y)| (x * scale, y * scale));
            let style = RGBColor(90, 90, 90).stroke_width(scale as u32);
            area.draw(&DashedPathElement::new(line, 7 * scale, 5 * scale, style))?;
        }
        Ok(())
    }

    /// Steps: between two settings of the front, an error costs what the more accurate of them takes.
    fn draw_front<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        let mut path: Vec<(i32, i32)> = Vec::new();
        for mark in self.front() {
            let (x, y) = self.place(mark, scale);
            path.extend(path.last().copied().map(|(_, before)| (x, before)));
            path.push((x, y));
        }
        area.draw(&PathElement::new(path, RGBColor(120, 120, 120).stroke_width(2 * scale as u32)))
    }

    /// What the numbers stand for, and the answers.
    fn draw_list<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB> {
        let mut lines = vec!["the front · фронт: ms · мс, error · ошибка".to_owned()];
        for (number, mark) in self.front().enumerate() {
            let Mark { name, error, time_ms, .. } = mark;
            lines.push(format!("{}  {name}: {} ms, {}", number + 1, three_digits(*time_ms), three_digits(*error)));
        }
        if lines.len() > LIST_LINES {
            lines.truncate(LIST_LINES - 1);
            lines.push("…".to_owned());
        }
        for &question in &self.questions {
            let answer = self.marks.iter().find(|mark| mark.answers.contains(&question));
            let asked = match question {
                Question::Error(error) => format!("error ≤ {}", three_digits(error)),
                Question::Fps(fps) => format!("≥ {} FPS", three_digits(fps)),
            };
            lines.push(format!("{asked}: {}", answer.map_or("none · нет", |mark| &mark.name)));
        }
        for (place, line) in lines.into_iter().enumerate() {
            let at = (LIST_LEFT * scale, (PLOT_Y[0] + place as i32 * LIST_STEP) * scale);
            area.draw(&Text::new(line, at, style(15 * scale, HPos::Left)))?;
        }
        Ok(())
    }
}

fn style(size: i32, side: HPos) -> TextStyle<'static> {
    TextStyle::from((FONT, size).into_font()).pos(Pos::new(side, VPos::Center))
}

/// A tick's number.
fn plain(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value) { three_digits(value) } else { format!("{value:.0e}") }
}

/// In two lines, `y` being their middle in pixels of the chart.
fn draw_legend<DB: DrawingBackend>(area: &DrawingArea<DB, Shift>, y: i32, scale: i32) -> Drawn<DB> {
    const MARKER_WIDTH: i32 = 24;
    const GAP: i32 = 26;
    let texts = ["full: bound proven · граница доказана", "hollow: measured · измерено", "ring: the answer · ответ"];
    let style = style(16 * scale, HPos::Left);
    let mut widths = Vec::new();
    for group in Group::ALL {
        let (text_width, _) = area.estimate_text_size(group.name(), &style)?;
        widths.push(MARKER_WIDTH + text_width as i32 / scale + GAP);
    }
    let (mut x, above) = ((WIDTH - widths.iter().sum::<i32>() + GAP) / 2, (y - 13) * scale);
    for (group, width) in Group::ALL.into_iter().zip(widths) {
        draw_marker(area, group, group.has_bounds(), ((x + 8) * scale, above), scale)?;
        area.draw(&Text::new(group.name(), ((x + MARKER_WIDTH) * scale, above), style.clone()))?;
        x += width;
    }
    draw_text(area, &texts.join("      "), (WIDTH / 2 * scale, (y + 13) * scale), 16 * scale)
}

#[cfg(test)]
mod tests {
    use super::super::example::example;
    use super::*;

    #[test]
    fn marks_are_by_error_and_say_what_they_answer() {
        let mut trade = example();
        trade.conditions.questions = vec![Question::Error(0.01), Question::Fps(1e6)];
        let panel = Panel::new(&trade.scenes[0], &trade);
        let told: Vec<_> = panel.marks.iter().map(|mark| (mark.group, mark.is_proven, mark.is_on_front)).collect();
        assert_eq!(
            told,
            [
                (Group::WhittedF64, true, true),
                (Group::WhittedF32, true, true),
                (Group::WhittedF32, true, false),
                (Group::WhittedF32, false, true)
            ]
        );
        assert_eq!(panel.marks[1].answers, [Question::Error(0.01)]);
        assert!(panel.title.contains("1 not drawn"), "{}", panel.title);
        let places = panel.number_places();
        assert_eq!(places.len(), 3);
        let is_apart = |a: (i32, i32), b: (i32, i32)| (a.0 - b.0).abs() >= 16 || (a.1 - b.1).abs() >= 13;
        assert!((1..3).all(|place| is_apart(places[place - 1], places[place])), "{places:?}");
    }

    #[test]
    fn both_forms_show_every_group_and_nothing_measured_can_be_drawn_too() {
        let mut trade = example();
        trade.conditions.questions = vec![Question::Error(0.01), Question::Fps(50.0)];
        for _ in 0..2 {
            let frame = png(&trade).unwrap();
            assert_eq!([frame.width(), frame.height()].map(|side| side as i32), TradeChart(&trade).size());
            let text = svg(&trade).unwrap();
            assert!(text.starts_with("<svg ") && text.trim_end().ends_with("</svg>"));
            for group in Group::ALL {
                let RGBColor(red, green, blue) = group.color();
                assert!(text.contains(&format!("#{red:02X}{green:02X}{blue:02X}")), "{group:?}");
                assert!(text.contains(group.name()), "{group:?}");
            }
            assert!(text.contains("driver 1") && text.contains("160x70"));
            trade.scenes[0].points.clear();
        }
    }
}
