//! Pictures side by side: a row a scene, a column an algorithm, the truth first.

use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Comparison;
use crate::frame::{Frame, display_value};
use crate::measure::output::OutputError;

const GAP: u32 = 10;
const TITLE_HEIGHT: u32 = 22;
const FONT: &str = "sheet";

/// The pictures of all scenes.
///
/// # Errors
/// It is too large to be a picture.
pub fn contact_sheet(comparison: &Comparison) -> Result<Frame, OutputError> {
    let (width, height) = (comparison.conditions.width, comparison.conditions.height);
    let columns = comparison.scenes.iter().map(|scene| scene.measured.len() as u32 + 1).max().unwrap_or(0);
    let size = (GAP + columns * (width + GAP), GAP + comparison.scenes.len() as u32 * (height + TITLE_HEIGHT + GAP));
    Frame::check_size(size.0, size.1)?;
    // A second registration of the same font changes nothing.
    let _ = register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    let mut bytes = vec![0; (size.0 * size.1 * 3) as usize];
    {
        let area = BitMapBackend::with_buffer(&mut bytes, size).into_drawing_area();
        let failed = |error: DrawingAreaErrorKind<_>| OutputError::Chart { reason: error.to_string() };
        area.fill(&WHITE).map_err(failed)?;
        for (scene, row) in comparison.scenes.iter().zip(0..) {
            let y = GAP + row * (height + TITLE_HEIGHT + GAP);
            let truth = [(format!("{}: truth · истина", scene.scene), &scene.truth)];
            let others = scene.measured.iter().map(|measured| (measured.name(), &measured.picture));
            for ((name, picture), column) in truth.into_iter().chain(others).zip(0..) {
                let x = GAP + column * (width + GAP);
                let style = TextStyle::from((FONT, 16.0).into_font()).pos(Pos::new(HPos::Left, VPos::Top));
                area.draw(&Text::new(name, (x as i32, y as i32), style)).map_err(failed)?;
                for (pixel, place) in picture.pixels().iter().zip(0..) {
                    let at = ((x + place % width) as i32, (y + TITLE_HEIGHT + place / width) as i32);
                    let [red, green, blue] = pixel.map(display_value);
                    area.draw_pixel(at, &RGBColor(red, green, blue)).map_err(failed)?;
                }
            }
        }
    }
    Ok(Frame::of_display(size.0, size.1, &bytes)?)
}
