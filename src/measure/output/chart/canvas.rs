//! Strokes, markers and texts on any backend.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The generic name is what an SVG's viewer finds a font by; pixels are drawn with the one registered.
pub const FONT: &str = "sans-serif";

/// Colours of Okabe and Ito's palette (Color Universal Design, 2008), which the colour-blind tell apart; dashes and
/// shapes tell lines and markers apart in grey.
pub mod palette {
    use plotters::style::RGBColor;

    pub const BLUE: RGBColor = RGBColor(0, 114, 178);
    pub const VERMILION: RGBColor = RGBColor(213, 94, 0);
    pub const GREEN: RGBColor = RGBColor(0, 158, 115);
    pub const NEARLY_BLACK: RGBColor = RGBColor(40, 40, 40);
    pub const PURPLE: RGBColor = RGBColor(204, 121, 167);
    pub const SKY: RGBColor = RGBColor(86, 180, 233);
    pub const ORANGE: RGBColor = RGBColor(230, 159, 0);
}

/// How a line is drawn; in pixels of the chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    pub color: RGBColor,
    pub width: i32,
    /// Pixels drawn and left out; `None`: a whole line.
    pub dash: Option<[i32; 2]>,
}

/// Corners around the centre, in parts of a marker's reach; none: a circle.
pub type Shape = &'static [(f64, f64)];

pub const CIRCLE: Shape = &[];
pub const SQUARE: Shape = &[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)];
pub const TRIANGLE: Shape = &[(0.0, -1.15), (1.05, 0.75), (-1.05, 0.75)];
pub const TRIANGLE_DOWN: Shape = &[(0.0, 1.15), (1.05, -0.75), (-1.05, -0.75)];
pub const DIAMOND: Shape = &[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)];
pub const HEXAGON: Shape = &[(-0.6, -1.1), (0.6, -1.1), (1.2, 0.0), (0.6, 1.1), (-0.6, 1.1), (-1.2, 0.0)];
pub const BAR: Shape = &[(-1.5, -0.65), (1.5, -0.65), (1.5, 0.65), (-1.5, 0.65)];

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marker {
    pub shape: Shape,
    pub color: RGBColor,
    pub is_hollow: bool,
}

/// Reach of a marker, pixels of the chart.
const REACH: i32 = 6;

pub type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// A part of a chart, in whose pixels all coordinates are.
pub struct Canvas<'a, DB: DrawingBackend> {
    area: &'a DrawingArea<DB, Shift>,
    /// Pixels of the backend to one of the chart.
    scale: i32,
    corner: [i32; 2],
}

impl<'a, DB: DrawingBackend> Canvas<'a, DB> {
    pub fn new(area: &'a DrawingArea<DB, Shift>, scale: i32) -> Self {
        Self { area, scale, corner: [0, 0] }
    }

    pub fn part(&self, [x, y]: [i32; 2]) -> Self {
        Self { corner: [self.corner[0] + x, self.corner[1] + y], ..*self }
    }

    fn at(&self, [x, y]: [i32; 2]) -> (i32, i32) {
        ((self.corner[0] + x) * self.scale, (self.corner[1] + y) * self.scale)
    }

    pub fn line(&self, path: &[[i32; 2]], Stroke { color, width, dash }: Stroke) -> Drawn<DB> {
        let (path, style) = (path.iter().map(|&place| self.at(place)), color.stroke_width((width * self.scale) as u32));
        match dash.map(|dash| dash.map(|pixels| pixels * self.scale)) {
            None => self.area.draw(&PathElement::new(path.collect::<Vec<_>>(), style)),
            Some([drawn, left_out]) => {
                self.area.draw(&DashedPathElement::new(path.collect::<Vec<_>>(), drawn, left_out, style))
            }
        }
    }

    /// `side`: the side of the text that is at `place`; in height its centre is.
    pub fn text(&self, text: &str, place: [i32; 2], size: i32, side: HPos) -> Drawn<DB> {
        self.area.draw(&Text::new(text.to_owned(), self.at(place), self.style(size, side)))
    }

    /// From below to above, about its centre.
    pub fn turned_text(&self, text: &str, place: [i32; 2], size: i32) -> Drawn<DB> {
        let style = self.style(size, HPos::Center).transform(FontTransform::Rotate270);
        self.area.draw(&Text::new(text.to_owned(), self.at(place), style))
    }

    pub fn width_of(&self, text: &str, size: i32) -> Result<i32, DrawingAreaErrorKind<DB::ErrorType>> {
        Ok(self.area.estimate_text_size(text, &self.style(size, HPos::Left))?.0 as i32 / self.scale)
    }

    fn style(&self, size: i32, side: HPos) -> TextStyle<'static> {
        TextStyle::from((FONT, size * self.scale).into_font()).pos(Pos::new(side, VPos::Center))
    }

    pub fn marker(&self, Marker { shape, color, is_hollow }: Marker, place: [i32; 2]) -> Drawn<DB> {
        let reach = f64::from(REACH * self.scale);
        self.shape(shape, place, reach, color)?;
        if is_hollow { self.shape(shape, place, 0.55 * reach, WHITE) } else { Ok(()) }
    }

    fn shape(&self, shape: Shape, place: [i32; 2], reach: f64, color: RGBColor) -> Drawn<DB> {
        let (x, y) = self.at(place);
        let pixels = |parts: f64| (parts * reach).round() as i32;
        if shape.is_empty() {
            return self.area.draw(&Circle::new((x, y), pixels(1.0), color.filled()));
        }
        let corners: Vec<_> = shape.iter().map(|&(right, down)| (x + pixels(right), y + pixels(down))).collect();
        self.area.draw(&Polygon::new(corners, color.filled()))
    }

    /// Around a marker.
    pub fn ring(&self, place: [i32; 2]) -> Drawn<DB> {
        let style = BLACK.stroke_width(2 * self.scale as u32);
        self.area.draw(&Circle::new(self.at(place), (REACH + 5) * self.scale, style))
    }
}
