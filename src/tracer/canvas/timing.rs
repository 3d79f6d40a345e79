//! What the chunks of a canvas's pictures took.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::gpu::{Device, GpuError, InFlight, Timer};
use crate::tracer::chunks::Pace;

/// A part of a picture that was submitted.
pub(super) struct Chunk {
    /// Number of the picture, by [`Canvas::begun`](super::Canvas).
    pub picture: u64,
    /// Which of each pixel, from 0.
    pub sample: u32,
    pub blocks: u64,
    pub is_last: bool,
    pub begun_at: Instant,
    pub submitted: Instant,
}

/// The time of a picture that came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Finished {
    /// Sum over all its chunks.
    pub gpu_time_ns: u64,
    /// Which of each pixel, from 0: the first is a picture by itself, the others are added to it while it rests.
    pub sample: u32,
}

#[derive(Default)]
struct Place {
    timer: Option<Arc<Timer>>,
    chunk: Option<Chunk>,
}

/// The chunks in flight, and the times of the pictures that they make up.
pub(super) struct Timing {
    /// What each slot of the ring has in flight, if anything.
    places: [Place; InFlight::COUNT],
    /// How many blocks a chunk is to have.
    pub pace: Pace,
    /// The first picture whose time is of interest: those before were of another size or by another kernel.
    pub first_of_interest: u64,
    /// How long the last whole one took, all in all.
    pub last_took: Option<Duration>,
    /// The picture whose chunks are coming in, with their GPU time so far; `None` where the device has no timestamps.
    timed: (u64, Option<u64>),
    finished: Vec<Finished>,
}

impl Timing {
    pub fn new(device: &Arc<Device>) -> Result<Self, GpuError> {
        let place = || Ok::<_, GpuError>(Place { timer: Timer::new(device, "trace")?, chunk: None });
        Ok(Self {
            places: [place()?, place()?],
            pace: Pace::new(),
            first_of_interest: 0,
            last_took: None,
            timed: (0, Some(0)),
            finished: Vec::new(),
        })
    }

    pub fn timer(&self, place: usize) -> Option<Arc<Timer>> {
        self.places[place].timer.clone()
    }

    pub fn submitted(&mut self, place: usize, chunk: Chunk) {
        self.places[place].chunk = Some(chunk);
    }

    pub fn has_chunks_in_flight(&self) -> bool {
        self.places.iter().any(|place| place.chunk.is_some())
    }

    /// Pictures that came to their end since the last call.
    pub fn take_finished(&mut self) -> Vec<Finished> {
        std::mem::take(&mut self.finished)
    }

    /// Reads the times of what was submitted from this slot of the ring and has ended.
    pub fn collect(&mut self, place: usize) -> Result<(), GpuError> {
        let Place { timer, chunk } = &mut self.places[place];
        let Some(chunk) = chunk.take() else { return Ok(()) };
        let time_ns = timer.as_deref().map(Timer::elapsed_ns).transpose()?;
        // Without timestamps, what the host saw is at least an upper bound.
        let at_most_ns = || chunk.submitted.elapsed().as_nanos() as u64;
        self.pace.measured(chunk.blocks, time_ns.unwrap_or_else(at_most_ns));
        // Chunks come in as they went out: none of an older picture follows one of a newer.
        if self.timed.0 != chunk.picture {
            self.timed = (chunk.picture, Some(0));
        }
        self.timed.1 = self.timed.1.zip(time_ns).map(|(sum, time_ns)| sum + time_ns);
        if chunk.is_last && chunk.picture >= self.first_of_interest {
            self.last_took = Some(chunk.begun_at.elapsed());
            self.finished.extend(self.timed.1.map(|gpu_time_ns| Finished { gpu_time_ns, sample: chunk.sample }));
        }
        Ok(())
    }
}
