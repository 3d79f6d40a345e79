//! What a canvas adds to a submission: the next chunk, and what makes the picture one to be looked at.

use std::time::Instant;

use super::super::renderer::{Sample, TargetKind};
use super::super::tiles::Tile;
use super::timing::Chunk;
use super::{Canvas, LONG};
use crate::gpu::{GpuError, Recorder, Use};

impl Canvas {
    /// Records the next chunk, if there is any, for a submission from this slot of the ring, which is
    /// [collected](Canvas::collect).
    pub fn record(&mut self, recorder: &mut Recorder, place: usize) -> Result<(), GpuError> {
        self.clear(recorder);
        if !self.renderer.has_next() && self.sweep.left() == 0 && self.lacks_samples() {
            self.begin_sample();
        } else if self.sweep.left() == 0 || self.is_in_place {
            self.begin(recorder)?;
        }
        let is_whole = self.renderer.kernel().draws_whole();
        let blocks = if is_whole { self.sweep.left() } else { self.timing.pace.blocks().min(self.sweep.left()) };
        if blocks == 0 {
            return Ok(());
        }
        if !self.is_in_place && self.begun_at.elapsed() > LONG {
            // Longer than expected: from here on it is seen.
            self.shown = 1 - self.shown;
            self.is_in_place = true;
        }
        let target = if self.is_in_place { self.shown } else { 1 - self.shown };
        let Some(set) = self.images[target].set.clone() else { return Ok(()) };
        let parts = self.sweep.take(blocks);
        let is_last = self.sweep.left() == 0;
        let timer = self.timing.timer(place);
        recorder.labelled("trace", |recorder| {
            timer.iter().for_each(|timer| recorder.start(timer));
            // The barrier comes after the timer's start: with a framebuffer around, lavapipe takes a time only at the
            // next.
            recorder.make_ready(self.pixels.as_ref().unwrap_or(&self.images[target].resource), Use::ShaderWrite);
            let tile = Tile::whole(self.sampling.traced_size(self.size));
            self.renderer.record(recorder, &set, Sample { index: self.sample, tile, parts: &parts });
            if let Some(pixels) = &self.pixels {
                self.images[target].take(recorder, pixels, &parts);
            }
            if is_last {
                self.shown = target;
            }
            if target == self.shown {
                self.is_upscaled = false;
                if is_last {
                    // What it takes is part of the picture's time.
                    self.upscale(recorder);
                }
            }
            timer.iter().for_each(|timer| recorder.stop(timer));
            Ok(())
        })?;
        let (picture, sample, begun_at) = (self.begun, self.sample, self.begun_at);
        let chunk = Chunk { picture, sample, blocks, is_last, begun_at, submitted: Instant::now() };
        self.timing.submitted(place, chunk);
        Ok(())
    }

    /// Makes the picture shown one that can be looked at: cleared before anything is traced, and up to date where it is
    /// traced at a smaller size. To be recorded before it is looked at, after the [chunk](Canvas::record).
    pub fn make_visible(&mut self, recorder: &mut Recorder) {
        self.clear(recorder);
        self.upscale(recorder);
    }

    fn upscale(&mut self, recorder: &mut Recorder) {
        if let Some(upscaling) = self.upscaling.as_ref().filter(|_| !self.is_upscaled) {
            upscaling.record(recorder, self.shown, Tile::whole(self.size));
            self.is_upscaled = true;
        }
    }

    /// Takes up the scene asked for.
    fn begin(&mut self, recorder: &mut Recorder) -> Result<(), GpuError> {
        let Some(taken_up) = self.renderer.take_up(recorder)? else { return Ok(()) };
        self.uploaded_bytes += taken_up.uploaded;
        self.dropped.extend(taken_up.dropped);
        if self.renderer.target() == TargetKind::Pixels && self.pixels.is_none() {
            let traced_size = self.sampling.traced_size(self.size);
            self.pixels = Some(TargetKind::Pixels.make(&self.device, "pixels", traced_size)?);
        }
        for image in &mut self.images {
            if taken_up.needs_binding || image.set.is_none() {
                image.set = self.renderer.bind(self.pixels.as_ref().unwrap_or(&image.resource))?;
            }
        }
        self.sample = 0;
        self.begun += 1;
        self.begun_at = Instant::now();
        if self.sweep.left() > 0 {
            self.sweep.start_here();
        } else {
            self.sweep.start();
        }
        self.is_in_place = self.timing.last_took.is_none_or(|took| took > LONG);
        Ok(())
    }

    /// Takes up the next sample of each pixel, which goes into the picture shown: that is one of the scene all the
    /// while.
    fn begin_sample(&mut self) {
        self.sample += 1;
        self.begun += 1;
        self.begun_at = Instant::now();
        self.sweep.start();
        self.is_in_place = true;
    }

    fn clear(&mut self, recorder: &mut Recorder) {
        let color = self.renderer.background().unwrap_or_default();
        for image in self.images.iter_mut().filter(|image| !image.is_cleared) {
            recorder.make_ready(&image.resource, Use::CopyTarget);
            recorder.clear(&image.resource, [color[0], color[1], color[2], 1.0]);
            image.is_cleared = true;
        }
    }
}
