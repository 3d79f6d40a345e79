//! What the chart shows, before it is drawn.

use crate::measure::fps_table::{Algorithm, Cell, Clock, FpsTable, Speeds, frames_per_second, published};
use crate::scene::SolidKind;

/// A point of a line, frames a second in the panel's parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    /// Of solids.
    pub count: usize,
    pub speed: f64,
    /// Of the fast and of the slow frames.
    pub quartiles: Option<[f64; 2]>,
}

pub(super) struct Panel {
    pub title: String,
    pub lines: Vec<(SolidKind, Vec<Point>)>,
}

impl Panel {
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        self.lines.iter().flat_map(|(_, points)| points)
    }
}

/// Panels with one scale: the published table and one of each kernel.
pub(super) struct Row {
    /// Of the y axis.
    pub label: &'static str,
    pub panels: Vec<Panel>,
}

/// One table to be shown.
struct Subject<'a> {
    name: String,
    speeds: Speeds,
    quartiles: Box<dyn Fn(SolidKind, usize) -> Option<[f64; 2]> + 'a>,
}

/// Above as in figure 4.2, in parts of each table's fastest cell, so that both fit; below in parts of the speed with as
/// many spheres, which shows the kinds' order where all are slow.
pub(super) fn rows(table: &FpsTable) -> [Row; 2] {
    let clock = table.clock();
    let by = match clock {
        Clock::Gpu => "GPU time",
        Clock::Wall if table.plan.in_window => "in the window",
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
    let subjects: Vec<_> = [published].into_iter().chain(table.plan.algorithms.iter().map(measured)).collect();
    [
        Row {
            label: "FPS, the fastest = 1 · кадры/с",
            panels: subjects.iter().map(Subject::in_parts_of_the_fastest).collect(),
        },
        Row {
            label: "FPS, spheres = 1 · кадры/с",
            panels: subjects.iter().map(Subject::in_parts_of_spheres).collect(),
        },
    ]
}

impl Subject<'_> {
    fn in_parts_of_the_fastest(&self) -> Panel {
        let all = SolidKind::ALL.into_iter().flat_map(|kind| self.speeds.of_kind(kind));
        let Some(fastest) = all.map(|(_, fps)| fps).max_by(f64::total_cmp) else {
            return self.panel(format!("{}: nothing yet", self.name), |_| None);
        };
        self.panel(format!("{}: 1 is {} FPS", self.name, three_digits(fastest)), |_| Some(fastest))
    }

    fn in_parts_of_spheres(&self) -> Panel {
        self.panel(self.name.clone(), |count| self.speeds.get(SolidKind::Sphere, count))
    }

    /// `base`: what is 1 at a number of solids; where there is none, there is no point.
    fn panel(&self, title: String, base: impl Fn(usize) -> Option<f64>) -> Panel {
        let point = |kind, (count, fps): (usize, f64)| {
            let base = base(count)?;
            let quartiles = (self.quartiles)(kind, count).map(|quartiles| quartiles.map(|quartile| quartile / base));
            Some(Point { count, speed: fps / base, quartiles })
        };
        let line = |kind| (kind, self.speeds.of_kind(kind).filter_map(|cell| point(kind, cell)).collect());
        Panel { title, lines: SolidKind::ALL.map(line).into() }
    }
}

fn three_digits(fps: f64) -> String {
    match fps {
        _ if fps >= 100.0 => format!("{fps:.0}"),
        _ if fps >= 10.0 => format!("{fps:.1}"),
        _ if fps >= 1.0 => format!("{fps:.2}"),
        _ => format!("{fps:.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fps_table::tests::{BOTH, example};

    #[test]
    fn above_is_1_the_fastest_cell_and_below_the_spheres() {
        let [above, below] = rows(&example(&[10, 100], &BOTH));
        let titles = |row: &Row| row.panels.iter().map(|panel| panel.title.clone()).collect::<Vec<_>>();
        assert_eq!(
            titles(&above),
            [
                "course work, published: 1 is 57.1 FPS",
                "course kernel, GPU time: 1 is 100 FPS",
                "whitted kernel, GPU time: 1 is 200 FPS"
            ]
        );
        assert_eq!(titles(&below)[1], "course kernel, GPU time");
        assert_eq!((above.panels[0].points().count(), below.panels[0].points().count()), (40, 40));
        for panel in &above.panels {
            assert_eq!(panel.points().map(|point| point.speed).max_by(f64::total_cmp), Some(1.0));
        }
        assert_eq!(above.panels[1].lines[0].1[1], Point { count: 100, speed: 0.1, quartiles: Some([0.1, 0.1]) });
        for panel in &below.panels {
            assert!(panel.lines[0].1.iter().all(|point| point.speed == 1.0));
        }
        let cone = below.panels[1].lines[3].1[1];
        // A quotient of two speeds of one rounding each.
        assert!((cone.speed / (100.0 / 103.0) - 1.0).abs() < 3.0 * f64::EPSILON, "{cone:?}");
    }

    #[test]
    fn without_spheres_nothing_is_in_parts_of_them() {
        let mut table = example(&[10], &[Algorithm::Course]);
        table.cells.remove(0);
        let [above, below] = rows(&table);
        assert_eq!((above.panels[1].points().count(), below.panels[1].points().count()), (3, 0));
        table.cells.clear();
        assert!(rows(&table)[0].panels[1].title.ends_with("nothing yet"));
    }
}
