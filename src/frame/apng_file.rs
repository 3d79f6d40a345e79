//! Frames one after another in one PNG that moves.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use png::{BitDepth, ColorType, Encoder, EncodingError, Writer};

use super::{Frame, FrameError};
use crate::whole_file::WholeFile;

/// A file of display values that is written frame by frame; whole, with all of its frames, or not at all. It plays
/// without end.
pub struct AnimatedPng {
    writer: Writer<BufWriter<File>>,
    file: WholeFile,
    path: PathBuf,
}

impl AnimatedPng {
    /// Of so many frames of a size, pixels, and so many a second.
    ///
    /// # Errors
    /// Nothing can be written there, or there is no frame.
    pub fn create(path: &Path, size: [u32; 2], count: usize, fps: f64) -> Result<Self, FrameError> {
        let refused = |error: EncodingError| FrameError::write(path, error);
        let mut file = WholeFile::create(path).map_err(|error| FrameError::write(path, error))?;
        let output = file.as_file_mut().try_clone().map_err(|error| FrameError::write(path, error))?;
        let mut encoder = Encoder::new(BufWriter::new(output), size[0], size[1]);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_animated(u32::try_from(count).unwrap_or(u32::MAX), 0).map_err(refused)?;
        let (numerator, denominator) = delay(fps);
        encoder.set_frame_delay(numerator, denominator).map_err(refused)?;
        let writer = encoder.write_header().map_err(refused)?;
        Ok(Self { writer, file, path: path.to_owned() })
    }

    /// The next frame, of the file's size.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn add(&mut self, frame: &Frame) -> Result<(), FrameError> {
        self.writer.write_image_data(&frame.display_bytes()).map_err(|error| FrameError::write(&self.path, error))
    }

    /// # Errors
    /// The disk takes no more, or frames are missing.
    pub fn finish(self) -> Result<(), FrameError> {
        let Self { writer, file, path } = self;
        writer.finish().map_err(|error| FrameError::write(&path, error))?;
        file.finish().map_err(|error| FrameError::write(&path, error))
    }
}

/// Seconds that a frame is shown, as the fraction of two numbers of 16 bits that is nearest, or nearly so.
fn delay(fps: f64) -> (u16, u16) {
    if fps.fract() == 0.0 && (1.0..=f64::from(u16::MAX)).contains(&fps) {
        return (1, fps as u16);
    }
    let seconds = fps.recip();
    // A cast keeps what is out of range at the nearest that is in it.
    let denominator = (f64::from(u16::MAX) / seconds).clamp(1.0, 10_000.0).floor();
    ((seconds * denominator).round().max(1.0) as u16, denominator as u16)
}

#[cfg(test)]
mod tests {
    use super::delay;

    #[test]
    fn delays_are_near_what_was_asked_for() {
        assert_eq!((delay(30.0), delay(1.0)), ((1, 30), (1, 1)));
        for fps in [29.97, 24000.0 / 1001.0, 0.5, 0.01, 1e-4, 59.94, 7.5] {
            let (numerator, denominator) = delay(fps);
            let off = f64::from(numerator) / f64::from(denominator) * fps - 1.0;
            assert!(off.abs() < 0.003, "{fps}: {numerator}/{denominator}");
        }
        assert_eq!((delay(1e9), delay(1e-9)), ((1, 10_000), (u16::MAX, 1)));
    }
}
