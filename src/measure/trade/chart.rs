//! Time against error, both logarithmic: a panel a scene, and beside it what the front's numbers stand for.

use plotters::style::RGBColor;

use super::figures::{answers, figures};
use super::{Counted, Question, SceneTrade, Target, Trade};
use crate::algorithm::{Algorithm, Precision};
use crate::measure::output::chart::{
    Axis, BAR, CIRCLE, Chart, DIAMOND, HEXAGON, Line, Mark, Marker, Panel, SQUARE, Sample, Shape, Stroke, TRIANGLE,
    TRIANGLE_DOWN, palette,
};
use crate::settings::{RenderSettings, three_digits};

/// That many lines of a list fit beside a panel, without the answers.
const LIST_LINES: usize = 18;

const FRONT: Stroke = Stroke { color: RGBColor(120, 120, 120), width: 2, dash: None };
const ASKED: Stroke = Stroke { color: RGBColor(90, 90, 90), width: 1, dash: Some([7, 5]) };

pub fn chart(trade: &Trade) -> Chart {
    let Trade { machine, conditions, scenes } = trade;
    Chart {
        title: "The price of accuracy: time against error · Цена точности: время и ошибка",
        subtitle: machine.caption(&format!("{}x{}", conditions.width, conditions.height), conditions.validation),
        plot: [608, 366],
        rows: scenes.iter().map(|scene| vec![panel(scene, trade)]).collect(),
        legend: GROUPS.iter().map(Group::sample).collect(),
        remark: "full: bound proven · граница доказана      hollow: measured · измерено      ring: the answer · ответ",
    }
}

/// Settings that look alike.
struct Group {
    name: &'static str,
    shape: Shape,
    color: RGBColor,
    /// Whether any of them has a proven bound.
    has_bounds: bool,
    holds: fn(&RenderSettings) -> bool,
}

/// The last that holds is a setting's.
const GROUPS: [Group; 9] = [
    Group::new("whitted f32", CIRCLE, palette::BLUE, true, |_| true),
    Group::new("whitted f64", SQUARE, palette::VERMILION, true, |setting| setting.precision == Some(Precision::F64)),
    Group::new("plain", TRIANGLE, palette::GREEN, false, |setting| setting.algorithm == Algorithm::Plain),
    Group::new("course", TRIANGLE_DOWN, palette::NEARLY_BLACK, false, |setting| setting.algorithm == Algorithm::Course),
    Group::new("ssr", DIAMOND, palette::GREEN, false, |setting| setting.algorithm == Algorithm::Ssr),
    Group::new("scale", BAR, palette::ORANGE, false, |setting| setting.scale < 1.0),
    Group::new("samples", HEXAGON, palette::SKY, false, |setting| setting.samples > 1),
    Group::new("path", CIRCLE, palette::PURPLE, false, |setting| setting.algorithm == Algorithm::Path),
    Group::new("no boxes", DIAMOND, palette::PURPLE, true, |setting| !setting.boxes),
];

impl Group {
    const fn new(
        name: &'static str,
        shape: Shape,
        color: RGBColor,
        has_bounds: bool,
        holds: fn(&RenderSettings) -> bool,
    ) -> Self {
        Self { name, shape, color, has_bounds, holds }
    }

    fn of(setting: &RenderSettings) -> &'static Self {
        GROUPS.iter().rfind(|group| (group.holds)(setting)).unwrap_or(&GROUPS[0])
    }

    fn marker(&self, is_proven: bool) -> Marker {
        Marker { shape: self.shape, color: self.color, is_hollow: !is_proven }
    }

    fn sample(&self) -> Sample {
        Sample { name: self.name.to_owned(), stroke: None, marker: self.marker(self.has_bounds) }
    }
}

fn panel(scene: &SceneTrade, Trade { conditions, .. }: &Trade) -> Panel {
    let (figures, answers) = (figures(scene, conditions), answers(scene, conditions));
    // Indices into the points, with error and ms; by error.
    let drawn = figures.iter().enumerate();
    let drawn = drawn.filter_map(|(place, figures)| Some((place, [figures.counted_error?, figures.time_ns? / 1e6])));
    let mut drawn: Vec<(usize, [f64; 2])> = drawn.collect();
    drawn.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1])));
    let front: Vec<_> = drawn.iter().copied().filter(|(place, _)| figures[*place].is_on_front).collect();

    let mut title = format!("{}: {} solids, {} generations", scene.scene, scene.solids, scene.max_depth);
    if !scene.complete {
        title += " (not complete)";
    }
    let left = figures.len() - drawn.len();
    if left > 0 {
        title += &format!("; {left} not drawn, whose error is no number");
    }
    let mut list = vec!["the front · фронт: ms · мс, error · ошибка".to_owned()];
    // Steps: between two settings of the front, an error costs what the more accurate of them takes.
    let mut steps: Vec<[f64; 2]> = Vec::new();
    for (number, &(place, [error, time_ms])) in front.iter().enumerate() {
        steps.extend(steps.last().copied().map(|[_, before]| [error, before]));
        steps.push([error, time_ms]);
        let (name, time_ms, error) = (&figures[place].name, three_digits(time_ms), three_digits(error));
        list.push(format!("{}  {name}: {time_ms} ms, {error}", number + 1));
    }
    if list.len() > LIST_LINES {
        list.truncate(LIST_LINES - 1);
        list.push("…".to_owned());
    }

    let [mut errors, mut times_ms] = [0, 1].map(|axis| drawn.iter().map(|(_, at)| at[axis]).collect::<Vec<_>>());
    let mut lines = Vec::new();
    for answer in &answers {
        // From one end of an axis to the other.
        let (asked, path) = match answer.question {
            Question::Error(error) => {
                errors.push(error);
                (format!("error ≤ {}", three_digits(error)), [0.0, f64::INFINITY].map(|end| [error, end]))
            }
            Question::Fps(fps) => {
                times_ms.push(1e3 / fps);
                (format!("≥ {} FPS", three_digits(fps)), [0.0, f64::INFINITY].map(|end| [end, 1e3 / fps]))
            }
        };
        lines.push(Line { stroke: ASKED, path: path.into() });
        list.push(format!("{asked}: {}", answer.name.as_deref().unwrap_or("none · нет")));
    }
    lines.push(Line { stroke: FRONT, path: steps });

    let x_label = match (conditions.target, conditions.counted) {
        (_, Counted::RootMeanSquare) => {
            "RMSE to all light (path: 95 % limit) · СКО от полного света (path: граница 95 %)"
        }
        (Target::Point | Target::Radiance { .. }, Counted::AllPixels) => {
            "largest error of a channel · наибольшая ошибка"
        }
        (Target::Point | Target::Radiance { .. }, Counted::OffDiscontinuities) => {
            "largest error off edges · наибольшая ошибка вне границ"
        }
        (Target::Area, Counted::AllPixels) => "largest error against area means · наибольшая ошибка от среднего",
        (Target::Area, Counted::OffDiscontinuities) => {
            "largest error off edges, against area means · вне границ, от среднего"
        }
    };
    let mark = |&(place, at): &(usize, [f64; 2])| Mark {
        at,
        quartiles: None,
        marker: Group::of(&scene.points[place].setting).marker(scene.points[place].bound.is_some()),
        is_ringed: answers.iter().any(|answer| answer.place == Some(place)),
        label: front.iter().position(|(other, _)| *other == place).map(|number| (number + 1).to_string()),
    };
    Panel {
        title,
        x: Axis::of_decades(x_label, &errors),
        y: Axis::around("ms a frame · мс на кадр", &times_ms),
        lines,
        marks: drawn.iter().map(mark).collect(),
        list,
    }
}

#[cfg(test)]
mod tests {
    use super::super::example::example;
    use super::*;

    #[test]
    fn marks_are_by_error_and_say_what_they_answer() {
        let mut trade = example();
        trade.conditions.questions = vec![Question::Error(0.01), Question::Fps(1e6)];
        let panel = panel(&trade.scenes[0], &trade);
        let told = |mark: &Mark| (mark.marker.color, !mark.marker.is_hollow, mark.label.clone(), mark.is_ringed);
        let number = |number: &str| Some(number.to_owned());
        assert_eq!(
            panel.marks.iter().map(told).collect::<Vec<_>>(),
            [
                (palette::VERMILION, true, number("1"), false),
                (palette::BLUE, true, number("2"), true),
                (palette::BLUE, true, None, false),
                (palette::BLUE, false, number("3"), false)
            ]
        );
        assert!(panel.title.contains("1 not drawn"), "{}", panel.title);
        assert_eq!(panel.list[1], "1  whitted f64: 20 ms, 3.00e-8");
        assert_eq!(panel.list[4..], ["error ≤ 0.01: whitted f32, error 0.00392", "≥ 1.00e6 FPS: none · нет"]);
        assert_eq!(panel.lines[2].path.len(), 5, "of the front's steps");
    }

    #[test]
    fn every_group_is_in_the_legend_and_nothing_measured_can_be_drawn_too() {
        let mut trade = example();
        for _ in 0..2 {
            let text = chart(&trade).to_svg().unwrap();
            for Group { name, color: RGBColor(red, green, blue), .. } in &GROUPS {
                assert!(text.contains(&format!("#{red:02X}{green:02X}{blue:02X}")) && text.contains(name), "{name}");
            }
            assert!(text.contains("driver 1") && text.contains("160x70"));
            trade.scenes[0].points.clear();
        }
    }
}
