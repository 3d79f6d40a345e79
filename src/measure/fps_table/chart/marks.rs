//! Lines, markers and the legend. Coordinates are pixels of the backend, `scale` of them to a pixel of the chart.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::measure::output::drawing::{Drawn, FONT};
use crate::scene::SolidKind;

/// Colours of Okabe and Ito's palette (Color Universal Design, 2008), which the colour-blind tell apart; dashes and
/// markers tell the lines apart in grey.
pub(super) struct Look {
    pub color: RGBColor,
    pub name: &'static str,
    /// Pixels drawn and left out; `None`: a whole line.
    dash: Option<(i32, i32)>,
}

pub(super) fn look(kind: SolidKind) -> Look {
    match kind {
        SolidKind::Sphere => Look { color: RGBColor(0, 114, 178), dash: None, name: "sphere · сфера" },
        SolidKind::Box => Look { color: RGBColor(213, 94, 0), dash: Some((14, 7)), name: "box · куб" },
        SolidKind::Cylinder => {
            Look { color: RGBColor(0, 158, 115), dash: Some((3, 5)), name: "cylinder · цилиндр" }
        }
        SolidKind::Cone => Look { color: RGBColor(40, 40, 40), dash: Some((8, 4)), name: "cone · конус" },
    }
}

pub(super) fn draw_line<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    kind: SolidKind,
    path: &[(i32, i32)],
    scale: i32,
) -> Drawn<DB> {
    let Look { color, dash, .. } = look(kind);
    let style = color.stroke_width(2 * scale as u32);
    match dash {
        None => area.draw(&PathElement::new(path.to_vec(), style)),
        Some((drawn, left_out)) => {
            area.draw(&DashedPathElement::new(path.iter().copied(), drawn * scale, left_out * scale, style))
        }
    }
}

pub(super) fn draw_marker<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    kind: SolidKind,
    (x, y): (i32, i32),
    scale: i32,
) -> Drawn<DB> {
    let color = look(kind).color;
    match kind {
        SolidKind::Sphere => area.draw(&Circle::new((x, y), 5 * scale, color.filled())),
        SolidKind::Box => {
            let reach = 4 * scale;
            area.draw(&Rectangle::new([(x - reach, y - reach), (x + reach, y + reach)], color.filled()))
        }
        SolidKind::Cylinder => {
            area.draw(&Circle::new((x, y), 5 * scale, WHITE.filled()))?;
            area.draw(&Circle::new((x, y), 5 * scale, color.stroke_width(2 * scale as u32)))
        }
        SolidKind::Cone => area.draw(&TriangleMarker::new((x, y), 6 * scale, color.filled())),
    }
}

pub(super) fn draw_quartiles<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    ends: [(i32, i32); 2],
    color: RGBColor,
    scale: i32,
) -> Drawn<DB> {
    let style = color.stroke_width(scale as u32);
    area.draw(&PathElement::new(ends.to_vec(), style))?;
    for (x, y) in ends {
        area.draw(&PathElement::new(vec![(x - 6 * scale, y), (x + 6 * scale, y)], style))?;
    }
    Ok(())
}

/// Of a sample of a line.
const SAMPLE_WIDTH: i32 = 46;
const QUARTILES: &str = "quartiles · квартили";

/// In one line about `middle`, which is in pixels of the chart.
pub(super) fn draw_legend<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    middle: (i32, i32),
    scale: i32,
) -> Drawn<DB> {
    let style = TextStyle::from((FONT, 17 * scale).into_font()).pos(Pos::new(HPos::Left, VPos::Center));
    let names = SolidKind::ALL.map(|kind| look(kind).name).into_iter().chain([QUARTILES]);
    let mut lefts = vec![0];
    for name in names {
        let (text_width, _) = area.estimate_text_size(name, &style)?;
        lefts.push(lefts[lefts.len() - 1] + SAMPLE_WIDTH + text_width as i32 / scale + 40);
    }
    let start = middle.0 - lefts[lefts.len() - 1] / 2;
    let y = middle.1 * scale;
    let label = |entry: usize, name: &str| {
        let x = (start + lefts[entry] + SAMPLE_WIDTH + 8) * scale;
        area.draw(&Text::new(name.to_owned(), (x, y), style.clone()))
    };
    for (entry, kind) in SolidKind::ALL.into_iter().enumerate() {
        let x = (start + lefts[entry]) * scale;
        draw_line(area, kind, &[(x, y), (x + SAMPLE_WIDTH * scale, y)], scale)?;
        draw_marker(area, kind, (x + SAMPLE_WIDTH / 2 * scale, y), scale)?;
        label(entry, look(kind).name)?;
    }
    let last = SolidKind::ALL.len();
    let x = (start + lefts[last] + SAMPLE_WIDTH / 2) * scale;
    draw_quartiles(area, [(x, y - 9 * scale), (x, y + 9 * scale)], BLACK, scale)?;
    label(last, QUARTILES)
}
