//! The error maps worth looking at, as one picture: a row a scene, a column a kernel.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;
use plotters::prelude::*;
use plotters::style::register_font;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::scenes::{moved_and_scaled, sheet_ball_on_floor, sheet_far_ball, sheet_thin_cylinder};
use crate::algorithm::ALGORITHMS;
use crate::frame::Frame;
use crate::gpu::Device;
use crate::measure::{LARGEST_ERROR, SMALLEST_ERROR, error_color};
use crate::reference;
use crate::scene::Scene;
use crate::tracer::{Kernel, Precision, Settings, Tracer, TracerError};

/// Size of a map, pixels.
const MAP: [u32; 2] = [240, 180];
const GAP: u32 = 12;
const TITLE_HEIGHT: u32 = 40;
const ROW_TITLE_HEIGHT: u32 = 24;
const LEGEND_HEIGHT: u32 = 64;
const FONT: &str = "sheet";

fn rows() -> Vec<(&'static str, Scene)> {
    let floor = sheet_ball_on_floor();
    let scaled = |scale| moved_and_scaled(&floor, DVec3::ZERO, scale);
    vec![
        ("a sphere 10⁴ radii away · сфера в 10⁴ радиусов", sheet_far_ball(1e4)),
        ("a sphere 10⁶ radii away · сфера в 10⁶ радиусов", sheet_far_ball(1e6)),
        ("a cylinder 10⁴ times as long as thick · цилиндр в 10⁴ раз длиннее толщины", sheet_thin_cylinder()),
        ("a scene of size 0.001 · сцена размером 0,001", scaled(1e-3)),
        ("the same of size 1 · та же размером 1", floor.clone()),
        ("the same of size 1000 · та же размером 1000", scaled(1e3)),
    ]
}

fn columns(device: &Device) -> Vec<(String, Kernel)> {
    let kernels = ALGORITHMS.iter().filter(|row| row.casts_rays()).flat_map(|row| row.kernels).copied();
    let kernels = kernels.filter(|kernel| device.description().float64 || kernel.precision() == Precision::F32);
    kernels.map(|kernel| (format!("{} {}", kernel.algorithm().name(), kernel.precision().name()), kernel)).collect()
}

/// The sheet: the reference's pictures, and how far each kernel's are from them.
///
/// `progress` hears how many of how many maps are done and can stop the work there.
pub fn error_sheet(
    device: &Arc<Device>,
    progress: &mut dyn FnMut(usize, usize) -> ControlFlow<()>,
) -> Result<Frame, TracerError> {
    let (rows, columns) = (rows(), columns(device));
    let width = GAP + (columns.len() as u32 + 1) * (MAP[0] + GAP);
    let height = TITLE_HEIGHT + rows.len() as u32 * (MAP[1] + ROW_TITLE_HEIGHT + GAP) + LEGEND_HEIGHT;
    let mut bytes = vec![0; (width * height * 3) as usize];
    let total = rows.len() * columns.len();
    let mut done = 0;
    // A second registration of the same font changes nothing.
    let _ = register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    {
        let area = BitMapBackend::with_buffer(&mut bytes, (width, height)).into_drawing_area();
        let drawing =
            |error: DrawingAreaErrorKind<_>| TracerError::Refused(format!("could not draw the sheet: {error}"));
        area.fill(&WHITE).map_err(drawing)?;
        let text = |text: &str, at: (u32, u32), size: f64| {
            let style = TextStyle::from((FONT, size).into_font()).pos(Pos::new(HPos::Left, VPos::Top));
            area.draw(&Text::new(text.to_owned(), (at.0 as i32, at.1 as i32), style)).map_err(drawing)
        };
        let column_x = |column: usize| GAP + column as u32 * (MAP[0] + GAP);
        text("reference · эталон", (column_x(0), GAP), 20.0)?;
        for (index, (name, _)) in columns.iter().enumerate() {
            text(&format!("{name}: error · ошибка"), (column_x(index + 1), GAP), 20.0)?;
        }
        for (index, (title, scene)) in rows.iter().enumerate() {
            let y = TITLE_HEIGHT + index as u32 * (MAP[1] + ROW_TITLE_HEIGHT + GAP);
            text(title, (GAP, y), 18.0)?;
            let truth = truth(scene)?;
            let put = |column: usize, color: &dyn Fn(usize) -> RGBColor| {
                let (left, top) = (column_x(column), y + ROW_TITLE_HEIGHT);
                (0..(MAP[0] * MAP[1]) as usize).try_for_each(|pixel| {
                    let at = (left + pixel as u32 % MAP[0], top + pixel as u32 / MAP[0]);
                    area.draw_pixel((at.0 as i32, at.1 as i32), &color(pixel)).map_err(drawing)
                })
            };
            put(0, &|pixel| {
                let [r, g, b] = truth[pixel].as_vec3().to_array().map(crate::frame::display_value);
                RGBColor(r, g, b)
            })?;
            for (column, (_, kernel)) in columns.iter().enumerate() {
                let settings = Settings { kernel: *kernel, ..Settings::new(MAP[0], MAP[1]) };
                let ours = Tracer::new(device, scene, &settings)?.render_f64()?;
                put(column + 1, &|pixel| error_color((ours[pixel] - truth[pixel]).abs().max_element()))?;
                done += 1;
                if progress(done, total).is_break() {
                    return Err(TracerError::Stopped);
                }
            }
        }
        draw_legend(&area, height - LEGEND_HEIGHT + GAP, &text).map_err(drawing)?;
        area.present().map_err(drawing)?;
    }
    Ok(Frame::of_display(width, height, &bytes)?)
}

fn truth(scene: &Scene) -> Result<Vec<DVec3>, TracerError> {
    let image = reference::render(scene, MAP[0], MAP[1], &|_| ControlFlow::Continue(()))
        .map_err(|error| TracerError::Refused(error.to_string()))?;
    Ok(image.pixels.iter().map(|pixel| pixel.color).collect())
}

type Area<'a> = DrawingArea<BitMapBackend<'a>, plotters::coord::Shift>;
type DrawingResult<'a> = Result<(), DrawingAreaErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>>;

/// A bar from the smallest to the largest error, with a number a decade.
fn draw_legend<'a>(
    area: &Area<'a>,
    top: u32,
    text: &impl Fn(&str, (u32, u32), f64) -> Result<(), TracerError>,
) -> DrawingResult<'a> {
    const WIDTH: u32 = 720;
    for x in 0..WIDTH {
        let decades = (LARGEST_ERROR / SMALLEST_ERROR).log10();
        let error = SMALLEST_ERROR * 10f64.powf(decades * f64::from(x) / f64::from(WIDTH));
        for y in 0..14 {
            area.draw_pixel(((GAP + x) as i32, (top + y) as i32), &error_color(error))?;
        }
    }
    // The font has no raised minus.
    for (index, label) in
        ["1e-9", "1e-8", "1e-7", "1e-6", "1e-5", "1e-4", "1e-3", "1e-2", "1e-1", "1"].iter().enumerate()
    {
        // Text fails where drawing pixels does.
        let _ = text(label, (GAP + index as u32 * WIDTH / 9, top + 18), 16.0);
    }
    let _ = text("error of a linear channel · ошибка линейного канала", (GAP + WIDTH + 60, top), 18.0);
    Ok(())
}
