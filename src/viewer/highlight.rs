//! The selected primitive's outline over the picture.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke};

use super::outline::{Projector, outline};
use crate::scene::{Camera, Solid};

/// Two strokes, so that it is seen on light and dark.
const STROKES: [(f32, Color32); 2] = [(3.0, Color32::from_black_alpha(160)), (1.0, Color32::from_rgb(255, 176, 32))];

/// Draws into `picture`, logical pixels, which shows `picture_size` pixels of the scene.
pub fn draw(painter: &Painter, picture: Rect, picture_size: [u32; 2], camera: &Camera, solid: &Solid) {
    let projector = Projector::new(camera, picture_size[0], picture_size[1]);
    let pixels_per_point = painter.pixels_per_point();
    let on_window =
        |pixel: glam::DVec2| -> Pos2 { picture.min + egui::vec2(pixel.x as f32, pixel.y as f32) / pixels_per_point };
    let lines: Vec<Vec<Pos2>> = outline(solid)
        .iter()
        .flat_map(|line| projector.project_polyline(line))
        .map(|line| line.into_iter().map(on_window).collect())
        .collect();
    let painter = painter.with_clip_rect(picture);
    for (width, color) in STROKES {
        painter.extend(lines.iter().map(|line| Shape::line(line.clone(), Stroke::new(width, color))));
    }
}
