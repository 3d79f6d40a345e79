use crate::frame::Frame;

/// A rectangle of the picture, pixels from its top left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Tile {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// The picture cut into tiles of at most `side`, row by row.
pub(super) fn tiles(width: u32, height: u32, side: u32) -> Vec<Tile> {
    let cut = |x: u32, y: u32| Tile { x, y, width: side.min(width - x), height: side.min(height - y) };
    let rows = (0..height).step_by(side as usize);
    rows.flat_map(|y| (0..width).step_by(side as usize).map(move |x| cut(x, y))).collect()
}

impl Tile {
    /// All of a picture.
    pub fn whole([width, height]: [u32; 2]) -> Self {
        Self { x: 0, y: 0, width, height }
    }

    /// Puts `pixels`, the tile's rows as RGBA, at their position in `frame`; alpha is dropped.
    pub fn copy_pixels(&self, pixels: &[[f32; 4]], frame: &mut Frame) {
        let (tile_width, frame_width) = (self.width as usize, frame.width() as usize);
        let rows = pixels.chunks_exact(tile_width).take(self.height as usize);
        for (row, y) in rows.zip(self.y as usize..) {
            let start = y * frame_width + self.x as usize;
            let target = &mut frame.pixels_mut()[start..start + tile_width];
            for (target, &[r, g, b, _]) in target.iter_mut().zip(row) {
                *target = [r, g, b];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        for (width, height, side) in [(1, 1, 8), (8, 8, 8), (9, 17, 8), (1621, 701, 512), (5, 300, 1)] {
            let mut seen = vec![0; (width * height) as usize];
            for tile in tiles(width, height, side) {
                assert!(tile.width <= side && tile.height <= side);
                for y in tile.y..tile.y + tile.height {
                    for x in tile.x..tile.x + tile.width {
                        seen[(y * width + x) as usize] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|&times| times == 1), "{width}x{height} in tiles of {side}");
        }
    }
}
