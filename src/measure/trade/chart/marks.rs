//! Markers and what they stand for. Coordinates are pixels of the backend, `scale` of them to a pixel of the chart.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::algorithm::{Algorithm, Precision};
use crate::measure::output::drawing::Drawn;
use crate::settings::RenderSettings;

/// Settings that look alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    WhittedF32,
    WhittedF64,
    Plain,
    Course,
    WithoutBoxes,
    Sampled,
    Scaled,
}

impl Group {
    pub const ALL: [Self; 7] = [
        Self::WhittedF32,
        Self::WhittedF64,
        Self::Plain,
        Self::Course,
        Self::WithoutBoxes,
        Self::Sampled,
        Self::Scaled,
    ];

    pub fn of(setting: &RenderSettings) -> Self {
        match (setting.boxes, setting.algorithm, setting.precision) {
            (false, _, _) => Self::WithoutBoxes,
            _ if setting.samples > 1 => Self::Sampled,
            _ if setting.scale < 1.0 => Self::Scaled,
            (_, Algorithm::Course, _) => Self::Course,
            (_, Algorithm::Plain, _) => Self::Plain,
            (_, Algorithm::Whitted | Algorithm::Reference, Some(Precision::F64)) => Self::WhittedF64,
            (_, Algorithm::Whitted | Algorithm::Reference, _) => Self::WhittedF32,
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::WhittedF32 => "whitted f32",
            Self::WhittedF64 => "whitted f64",
            Self::Plain => "plain",
            Self::Course => "course",
            Self::WithoutBoxes => "no boxes",
            Self::Sampled => "samples",
            Self::Scaled => "scale",
        }
    }

    /// Whether any of them has a proven bound.
    pub fn has_bounds(self) -> bool {
        matches!(self, Self::WhittedF32 | Self::WhittedF64 | Self::WithoutBoxes)
    }

    /// Of Okabe and Ito's palette (Color Universal Design, 2008), which the colour-blind tell apart; in grey the shapes
    /// do.
    pub fn color(self) -> RGBColor {
        match self {
            Self::WhittedF32 => RGBColor(0, 114, 178),
            Self::WhittedF64 => RGBColor(213, 94, 0),
            Self::Plain => RGBColor(0, 158, 115),
            Self::Course => RGBColor(40, 40, 40),
            Self::WithoutBoxes => RGBColor(204, 121, 167),
            Self::Sampled => RGBColor(86, 180, 233),
            Self::Scaled => RGBColor(230, 159, 0),
        }
    }

    /// Corners around the middle, in parts of the marker's reach; `None`: a circle.
    fn corners(self) -> Option<&'static [(f64, f64)]> {
        match self {
            Self::WhittedF32 => None,
            Self::WhittedF64 => Some(&[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)]),
            Self::Plain => Some(&[(0.0, -1.15), (1.05, 0.75), (-1.05, 0.75)]),
            Self::Course => Some(&[(0.0, 1.15), (1.05, -0.75), (-1.05, -0.75)]),
            Self::WithoutBoxes => Some(&[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)]),
            Self::Sampled => Some(&[(-0.6, -1.1), (0.6, -1.1), (1.2, 0.0), (0.6, 1.1), (-0.6, 1.1), (-1.2, 0.0)]),
            Self::Scaled => Some(&[(-1.5, -0.65), (1.5, -0.65), (1.5, 0.65), (-1.5, 0.65)]),
        }
    }
}

/// Pixels of the chart.
const REACH: i32 = 6;

/// Full where a bound is proven, else hollow.
pub fn draw_marker<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    group: Group,
    is_proven: bool,
    middle: (i32, i32),
    scale: i32,
) -> Drawn<DB> {
    let reach = f64::from(REACH * scale);
    draw_shape(area, group, middle, reach, group.color())?;
    if is_proven { Ok(()) } else { draw_shape(area, group, middle, 0.55 * reach, WHITE) }
}

fn draw_shape<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    group: Group,
    (x, y): (i32, i32),
    reach: f64,
    color: RGBColor,
) -> Drawn<DB> {
    let pixels = |parts: f64| (parts * reach).round() as i32;
    match group.corners() {
        None => area.draw(&Circle::new((x, y), pixels(1.0), color.filled())),
        Some(corners) => {
            let corners: Vec<_> = corners.iter().map(|&(right, down)| (x + pixels(right), y + pixels(down))).collect();
            area.draw(&Polygon::new(corners, color.filled()))
        }
    }
}

/// Around the marker of an answer.
pub fn draw_ring<DB: DrawingBackend>(area: &DrawingArea<DB, Shift>, middle: (i32, i32), scale: i32) -> Drawn<DB> {
    area.draw(&Circle::new(middle, (REACH + 5) * scale, BLACK.stroke_width(2 * scale as u32)))
}
