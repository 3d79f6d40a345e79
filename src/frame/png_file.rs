//! Frames as PNG: the display values in 8-bit RGB.

use std::io::{BufRead, Seek, Write};

use png::{BitDepth, ColorType, Decoder, Encoder, EncodingError, Transformations};

use super::{DecodeError, Frame, FrameError, display_value};

pub(super) fn write(frame: &Frame, output: impl Write) -> Result<(), EncodingError> {
    let mut encoder = Encoder::new(output, frame.width, frame.height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    // Row by row: a second buffer of the whole frame would be a quarter of it again.
    let mut rows = writer.stream_writer()?;
    let mut bytes = Vec::with_capacity(frame.width as usize * 3);
    for row in frame.rows() {
        bytes.clear();
        bytes.extend(row.iter().flatten().map(|&value| display_value(value)));
        rows.write_all(&bytes)?;
    }
    rows.finish()?;
    writer.finish()
}

/// Grey, palette and RGB pixels of any depth, as RGB in [0, 1]; alpha is ignored.
pub(super) fn read(input: impl BufRead + Seek) -> Result<Frame, DecodeError> {
    let mut decoder = Decoder::new(input);
    decoder.set_transformations(Transformations::EXPAND);
    let (width, height) = decoder.read_header_info()?.size();
    let mut frame = Frame::new(width, height)?;
    let mut reader = decoder.read_info()?;

    let mut bytes = Vec::new();
    let byte_count = reader.output_buffer_size().unwrap_or(usize::MAX);
    bytes.try_reserve_exact(byte_count).map_err(|_| FrameError::Memory { width, height, bytes: byte_count as u64 })?;
    bytes.resize(byte_count, 0);
    let layout = reader.next_frame(&mut bytes)?;

    let channels = layout.color_type.samples();
    // Grey repeats its first channel; a second or fourth channel is alpha.
    let [red, green, blue] = if channels < 3 { [0, 0, 0] } else { [0, 1, 2] };
    match layout.bit_depth {
        BitDepth::Sixteen => {
            for (pixel, stored) in frame.pixels.iter_mut().zip(bytes.chunks_exact(2 * channels)) {
                let value = |channel: usize| {
                    f32::from(u16::from_be_bytes([stored[2 * channel], stored[2 * channel + 1]])) / 65535.0
                };
                *pixel = [value(red), value(green), value(blue)];
            }
        }
        // EXPAND leaves nothing below eight bits.
        _ => {
            for (pixel, stored) in frame.pixels.iter_mut().zip(bytes.chunks_exact(channels)) {
                *pixel = [red, green, blue].map(|channel| f32::from(stored[channel]) / 255.0);
            }
        }
    }
    Ok(frame)
}
