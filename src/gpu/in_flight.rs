//! Submissions that follow each other without the host's waiting in between.

use std::marker::PhantomData;
use std::sync::Arc;

use ash::vk;

use super::commands::{Commands, Idle, Semaphores};
use super::device::Device;
use super::error::GpuError;
use super::hazards::Hazards;
use super::pipeline::Resource;
use super::recorder::Recorder;

/// A ring of command buffers with one book of hazards: an image keeps its layout and its contents from one submission
/// to the next.
pub struct InFlight {
    ring: [Commands; Self::COUNT],
    next: usize,
    hazards: Hazards,
}

impl InFlight {
    /// Submissions recorded ahead of the device.
    pub const COUNT: usize = 2;

    /// `name` is what debuggers and failures show.
    pub fn new(device: &Arc<Device>, name: &str) -> Result<Self, GpuError> {
        let ring = [Commands::new(device, name)?, Commands::new(device, name)?];
        Ok(Self { ring, next: 0, hazards: Hazards::default() })
    }

    /// Waits until the next slot of the ring is free and returns which it is: what was submitted from there, the last
    /// but [`InFlight::COUNT`], has ended.
    pub fn wait_for_place(&mut self) -> Result<usize, GpuError> {
        self.ring[self.next].wait()?;
        Ok(self.next)
    }

    /// The slots of the ring, from the one submitted from longest ago.
    pub fn places(&self) -> [usize; Self::COUNT] {
        std::array::from_fn(|offset| (self.next + offset) % Self::COUNT)
    }

    /// Waits until nothing that was submitted from here is running.
    pub fn wait_for_all(&mut self) -> Result<(), GpuError> {
        self.ring.iter_mut().try_for_each(Commands::wait)
    }

    /// Records and submits from the next slot, which it waits for.
    pub(crate) fn submit(
        &mut self,
        semaphores: Semaphores,
        record: impl FnOnce(&mut Recorder) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        let place = self.next;
        self.next = (place + 1) % Self::COUNT;
        self.ring[place].submit(&mut self.hazards, semaphores, record)
    }

    /// Records, submits, and waits until the device is done with this and all before it.
    pub fn run(&mut self, record: impl FnOnce(&mut Recorder) -> Result<(), GpuError>) -> Result<(), GpuError> {
        self.submit(Semaphores::default(), record)?;
        self.wait_for_all()
    }

    /// As [`InFlight::wait_for_all`]; while the answer is held, nothing is submitted.
    pub fn idle(&mut self) -> Result<Idle<'_>, GpuError> {
        self.wait_for_all()?;
        Ok(Idle(PhantomData))
    }

    /// A pool for a library's own short submissions, after waiting for all of these.
    pub(crate) fn idle_pool(&mut self) -> Result<vk::CommandPool, GpuError> {
        self.wait_for_all()?;
        Ok(self.ring[self.next].pool)
    }

    /// Strikes a resource that is used no more from the book.
    pub fn forget(&mut self, resource: &Resource) {
        self.hazards.forget(resource.id());
    }
}
