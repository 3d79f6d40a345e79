//! The chart in the style of figure 4.2: frames a second against the number of solids, a line a kind; the published
//! table and each kernel's own in panels with one scale.

use super::tables::kind_words;
use super::{Algorithm, Cell, Clock, FpsTable, Speeds, frames_per_second, published};
use crate::measure::output::Words;
use crate::measure::output::chart::{
    Axis, CIRCLE, Chart, Line, Mark, Marker, Panel, SQUARE, Sample, Stroke, TRIANGLE, palette,
};
use crate::scene::SolidKind;
use crate::settings::three_digits;

/// Above as in figure 4.2, in parts of each table's fastest cell, so that both fit; below in parts of the speed with as
/// many spheres, which shows the kinds' order where all are slow.
pub fn chart(table: &FpsTable) -> Chart {
    let (machine, plan, clock) = (&table.machine, &table.plan, table.clock());
    let by = match clock {
        Clock::Gpu => "GPU time",
        Clock::Wall if plan.in_window => "in the window",
        Clock::Wall => "wall time",
    };
    let measured = |&algorithm: &Algorithm| Subject {
        name: format!("{} kernel, {by}", algorithm.name()),
        speeds: table.speeds(algorithm, clock),
        quartiles: Box::new(move |kind, count| {
            let quartiles = |cell: &Cell| Some(cell.summary(clock)?.quartiles_ns.map(frames_per_second));
            table.cell(kind, count, algorithm).and_then(quartiles)
        }),
    };
    let published =
        Subject { name: "course work, published".to_owned(), speeds: published(), quartiles: Box::new(|_, _| None) };
    let subjects: Vec<_> = [published].into_iter().chain(plan.algorithms.iter().map(measured)).collect();
    let picture = format!("{}x{}, {} generations", plan.width, plan.height, plan.generations);
    let sample = |kind| {
        let (stroke, marker) = look(kind);
        let Words { english, russian } = kind_words(kind);
        Sample { name: format!("{english} · {russian}"), stroke: Some(stroke), marker }
    };
    Chart {
        title: "Frames a second by number and kind of solids · Кадры в секунду от числа и вида тел",
        subtitle: machine.caption(&picture, plan.validation),
        plot: [410, 300],
        rows: vec![
            row("FPS, the fastest = 1 · кадры/с", subjects.iter().map(Subject::in_parts_of_the_fastest).collect()),
            row("FPS, spheres = 1 · кадры/с", subjects.iter().map(Subject::in_parts_of_spheres).collect()),
        ],
        legend: SolidKind::ALL.map(sample).into(),
        remark: "whiskers: quartiles · усы: квартили",
    }
}

fn look(kind: SolidKind) -> (Stroke, Marker) {
    let (color, dash, shape) = match kind {
        SolidKind::Sphere => (palette::BLUE, None, CIRCLE),
        SolidKind::Box => (palette::VERMILION, Some([14, 7]), SQUARE),
        SolidKind::Cylinder => (palette::GREEN, Some([3, 5]), CIRCLE),
        SolidKind::Cone => (palette::NEARLY_BLACK, Some([8, 4]), TRIANGLE),
    };
    (Stroke { color, width: 2, dash }, Marker { shape, color, is_hollow: kind == SolidKind::Cylinder })
}

/// One table to be shown.
struct Subject<'a> {
    name: String,
    speeds: Speeds,
    quartiles: Box<dyn Fn(SolidKind, usize) -> Option<[f64; 2]> + 'a>,
}

/// The lines of a panel below its title.
type Titled = (String, [Vec<Mark>; SolidKind::ALL.len()]);

impl Subject<'_> {
    fn in_parts_of_the_fastest(&self) -> Titled {
        let all = SolidKind::ALL.into_iter().flat_map(|kind| self.speeds.of_kind(kind));
        match all.map(|(_, fps)| fps).max_by(f64::total_cmp) {
            Some(fastest) => {
                (format!("{}: 1 is {} FPS", self.name, three_digits(fastest)), self.lines(|_| Some(fastest)))
            }
            None => (format!("{}: nothing yet", self.name), self.lines(|_| None)),
        }
    }

    fn in_parts_of_spheres(&self) -> Titled {
        (self.name.clone(), self.lines(|count| self.speeds.get(SolidKind::Sphere, count)))
    }

    /// `base`: what is 1 at a number of solids; where there is none, there is no mark.
    fn lines(&self, base: impl Fn(usize) -> Option<f64>) -> [Vec<Mark>; SolidKind::ALL.len()] {
        let mark = |kind, (count, fps): (usize, f64)| {
            let base = base(count)?;
            Some(Mark {
                at: [count as f64, fps / base],
                quartiles: (self.quartiles)(kind, count).map(|quartiles| quartiles.map(|quartile| quartile / base)),
                marker: look(kind).1,
                is_ringed: false,
                label: None,
            })
        };
        SolidKind::ALL.map(|kind| self.speeds.of_kind(kind).filter_map(|cell| mark(kind, cell)).collect())
    }
}

/// Panels with one scale. A published table is always there: there are marks.
fn row(label: &'static str, panels: Vec<Titled>) -> Vec<Panel> {
    let marks = || panels.iter().flat_map(|(_, lines)| lines.iter().flatten());
    let counts = || marks().map(|mark| mark.at[0]);
    let [fewest, most] = [counts().fold(f64::INFINITY, f64::min), counts().fold(0.0, f64::max)];
    let fastest =
        marks().flat_map(|mark| [mark.at[1], mark.quartiles.map_or(0.0, |[fast, _]| fast)]).fold(1.0, f64::max);
    let panel = |(place, (title, lines)): (usize, Titled)| Panel {
        title,
        x: Axis::linear("n, solids · число тел", fewest - 5.0, most + 5.0),
        y: Axis::linear(if place == 0 { label } else { "" }, 0.0, fastest * 1.06),
        lines: SolidKind::ALL
            .into_iter()
            .zip(&lines)
            .map(|(kind, marks)| Line { stroke: look(kind).0, path: marks.iter().map(|mark| mark.at).collect() })
            .collect(),
        marks: lines.into_iter().flatten().collect(),
        list: Vec::new(),
    };
    panels.into_iter().enumerate().map(panel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fps_table::tests::{BOTH, example};

    #[test]
    fn above_is_1_the_fastest_cell_and_below_the_spheres() {
        let rows = chart(&example(&[10, 100], &BOTH)).rows;
        let [above, below] = &rows[..] else { panic!("two rows") };
        let titles = |row: &[Panel]| row.iter().map(|panel| panel.title.clone()).collect::<Vec<_>>();
        assert_eq!(
            titles(above),
            [
                "course work, published: 1 is 57.1 FPS",
                "course kernel, GPU time: 1 is 100 FPS",
                "whitted kernel, GPU time: 1 is 200 FPS"
            ]
        );
        assert_eq!(titles(below)[1], "course kernel, GPU time");
        assert_eq!((above[0].marks.len(), below[0].marks.len()), (40, 40));
        for panel in above {
            assert_eq!(panel.marks.iter().map(|mark| mark.at[1]).max_by(f64::total_cmp), Some(1.0));
        }
        assert_eq!((above[1].marks[1].at, above[1].marks[1].quartiles), ([100.0, 0.1], Some([0.1, 0.1])));
        for panel in below {
            assert!(panel.lines[0].path.iter().all(|[_, speed]| *speed == 1.0));
        }
        let [_, cone] = below[1].lines[3].path[1];
        // A quotient of two speeds of one rounding each.
        assert!((cone / (100.0 / 103.0) - 1.0).abs() < 3.0 * f64::EPSILON, "{cone}");
    }

    #[test]
    fn without_spheres_nothing_is_in_parts_of_them_and_a_table_of_nothing_can_be_drawn_too() {
        let mut table = example(&[10], &[Algorithm::Course]);
        table.cells.remove(0);
        let rows = chart(&table).rows;
        assert_eq!((rows[0][1].marks.len(), rows[1][1].marks.len()), (3, 0));
        table.cells.clear();
        let empty = chart(&table);
        assert!(empty.rows[0][1].title.ends_with("nothing yet"));
        assert!(empty.to_svg().unwrap().contains("driver 1"));
    }
}
