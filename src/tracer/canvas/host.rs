//! The picture of a [`Canvas`] from and to the host's memory.

use std::sync::Arc;

use super::super::TracerError;
use super::Canvas;
use crate::frame::Frame;
use crate::gpu::{Buffer, BufferKind, InFlight, PIXEL_BYTES, Resource, Use};
use crate::settings::sampling::Sampling;

impl Canvas {
    /// The picture shown, as it is now.
    pub fn read_back(&mut self, in_flight: &mut InFlight) -> Result<Frame, TracerError> {
        self.collect_all(in_flight)?;
        let [width, height] = self.size;
        let mut frame = Frame::new(width, height)?;
        let bytes = frame.pixels().len() as u64 * PIXEL_BYTES;
        let buffer = Arc::new(Buffer::new(&self.device, "picture read back", BufferKind::Readback, bytes)?);
        let resource = Resource::from(&buffer);
        in_flight.run(|recorder| {
            self.make_visible(recorder);
            recorder.make_ready(self.picture(), Use::CopySource);
            recorder.make_ready(&resource, Use::CopyTarget);
            recorder.copy_to_buffer(self.picture(), &resource, width, height);
            recorder.make_ready(&resource, Use::HostRead);
            Ok(())
        })?;
        in_flight.forget(&resource);
        let idle = in_flight.idle()?;
        let pixels: &[[f32; 4]] = bytemuck::cast_slice(buffer.bytes(&idle)?);
        for (target, &[r, g, b, _]) in frame.pixels_mut().iter_mut().zip(pixels) {
            *target = [r, g, b];
        }
        Ok(frame)
    }

    /// Shows a picture traced elsewhere, of the canvas's size; from then on the canvas is plainly
    /// [sampled](Canvas::set_sampling).
    pub fn put(&mut self, in_flight: &mut InFlight, frame: &Frame) -> Result<(), TracerError> {
        assert_eq!([frame.width(), frame.height()], self.size, "the picture is of another size");
        self.collect_all(in_flight)?;
        self.set_sampling(in_flight, Sampling::PLAIN)?;
        self.forget_scene();
        let pixels: Vec<[f32; 4]> = frame.pixels().iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
        let bytes: &[u8] = bytemuck::cast_slice(&pixels);
        let mut buffer = Buffer::new(&self.device, "picture to show", BufferKind::Upload, bytes.len() as u64)?;
        buffer.write(bytes)?;
        let resource = Resource::from(&Arc::new(buffer));
        let image = &mut self.images[self.shown];
        image.is_cleared = true;
        in_flight.run(|recorder| {
            recorder.make_ready(&image.resource, Use::CopyTarget);
            recorder.copy_to_image(&resource, &image.resource, frame.width(), frame.height());
            Ok(())
        })?;
        in_flight.forget(&resource);
        Ok(())
    }
}
