//! Charts in pixels and in lines.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::OutputError;
use crate::frame::Frame;

/// The generic name is what an SVG's viewer finds a font by; pixels are drawn with the one registered.
pub const FONT: &str = "sans-serif";
/// The bitmap backend draws thick lines with jagged edges: a picture of so many times the side is averaged.
const SUPERSAMPLING: i32 = 3;

pub type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// A chart that can be drawn on any backend.
pub trait Chart {
    /// Pixels.
    fn size(&self) -> [i32; 2];

    /// `scale`: pixels of the backend to one of the chart.
    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, scale: i32) -> Drawn<DB>;
}

/// The chart as a picture.
pub fn png(chart: &impl Chart) -> Result<Frame, OutputError> {
    register();
    let [width, height] = chart.size();
    let [large_width, large_height] = [width, height].map(|side| side * SUPERSAMPLING);
    let mut bytes = vec![0; (large_width * large_height) as usize * 3];
    {
        let size = (large_width as u32, large_height as u32);
        let area = BitMapBackend::with_buffer(&mut bytes, size).into_drawing_area();
        chart.draw(&area, SUPERSAMPLING).map_err(drawing_error)?;
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

/// The chart as an SVG document.
pub fn svg(chart: &impl Chart) -> Result<String, OutputError> {
    register();
    let [width, height] = chart.size();
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (width as u32, height as u32)).into_drawing_area();
        chart.draw(&area, 1).map_err(drawing_error)?;
    }
    Ok(text)
}

fn register() {
    // A second registration of the same font changes nothing.
    let _ = register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
}

fn drawing_error<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> OutputError {
    OutputError::Chart { reason: error.to_string() }
}

/// `middle`, `size`: pixels of the backend.
pub fn draw_text<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    text: &str,
    middle: (i32, i32),
    size: i32,
) -> Drawn<DB> {
    let style = TextStyle::from((FONT, size).into_font()).pos(Pos::new(HPos::Center, VPos::Center));
    area.draw(&Text::new(text.to_owned(), middle, style))
}
