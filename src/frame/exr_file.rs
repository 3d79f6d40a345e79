//! Frames as OpenEXR: 32-bit float RGB, compressed without loss.

use std::io::{BufRead, Seek, Write};

use exr::prelude::{
    Blocks, Compression, Encoding, Image, LineOrder, ReadChannels, ReadLayers, SpecificChannels, Vec2, WritableImage,
    read as read_image,
};

use super::{DecodeError, Frame, FrameError};

pub(super) fn write(frame: &Frame, output: impl Write + Seek) -> Result<(), exr::error::Error> {
    let width = frame.width as usize;
    let channels = SpecificChannels::rgb(|position: Vec2<usize>| {
        let [red, green, blue] = frame.pixels[position.y() * width + position.x()];
        (red, green, blue)
    });
    // Scan lines in zip blocks are what every reader understands.
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    Image::from_encoded_channels((width, frame.height as usize), encoding, channels).write().to_buffered(output)
}

/// The first layer with the channels R, G and B in half, float or integer samples.
pub(super) fn read(input: impl BufRead + Seek) -> Result<Frame, DecodeError> {
    let chunks = exr::block::read(input, false)?;
    // Before anything is allocated for them: a few bytes of header can claim any size.
    for header in chunks.headers() {
        let Vec2(width, height) = header.layer_size;
        if width.max(height) > Frame::MAX_SIDE as usize {
            return Err(FrameError::Size { width: width as u64, height: height as u64 }.into());
        }
    }
    let image = read_image()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Frame::new(size.width() as u32, size.height() as u32),
            |frame: &mut Result<Frame, FrameError>, position, (red, green, blue): (f32, f32, f32)| {
                if let Ok(frame) = frame {
                    let width = frame.width as usize;
                    frame.pixels[position.y() * width + position.x()] = [red, green, blue];
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_chunks(chunks)?;
    Ok(image.layer_data.channel_data.pixels?)
}
