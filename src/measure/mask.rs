//! Which pixels of a picture count.

use std::path::Path;

use crate::frame::{Frame, FrameError};

/// A choice of pixels, row-major, row 0 on top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mask {
    width: u32,
    height: u32,
    counted: Vec<bool>,
}

impl Mask {
    /// A pixel counts when its brightest channel is at least 128 of 255.
    pub fn from_frame(frame: &Frame) -> Self {
        let threshold = 128.0 / 255.0;
        let counted = frame.pixels().iter().map(|pixel| pixel.iter().any(|&value| value >= threshold)).collect();
        Self { width: frame.width(), height: frame.height(), counted }
    }

    /// Reads the mask from an image file, see [`Mask::from_frame`].
    pub fn load(path: &Path) -> Result<Self, FrameError> {
        Ok(Self::from_frame(&Frame::load(path)?))
    }

    /// In pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// In pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// One entry a pixel, true where it counts.
    pub fn counted(&self) -> &[bool] {
        &self.counted
    }
}
