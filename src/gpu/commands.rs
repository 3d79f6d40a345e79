//! Recording, submitting and waiting.

use std::any::Any;
use std::marker::PhantomData;
use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::GpuError;
use super::hazards::Hazards;
use super::recorder::Recorder;

/// One command buffer, recorded anew for every submission.
pub struct Commands {
    pub(super) pool: vk::CommandPool,
    buffer: vk::CommandBuffer,
    fence: vk::Fence,
    name: String,
    /// What the submission in flight uses; `None` where none is.
    in_flight: Option<Vec<Arc<dyn Any>>>,
    /// Hazards of the last [`Commands::run`] and those that went on from it.
    hazards: Hazards,
    device: Arc<Device>,
}

/// Nothing that was submitted from some commands is running, and nothing can be while they are borrowed.
pub struct Idle<'a>(pub(super) PhantomData<&'a mut Commands>);

/// Semaphores between a submission and the display.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Semaphores {
    /// Waited for before the given stages.
    pub wait: Option<(vk::Semaphore, vk::PipelineStageFlags)>,
    pub signal: Option<vk::Semaphore>,
}

impl Commands {
    /// `name` is what debuggers and failures show.
    pub fn new(device: &Arc<Device>, name: &str) -> Result<Self, GpuError> {
        let failed = |what| GpuError::call(move || format!("create the {what} '{name}'"));
        // Null handles until made; `Drop` ignores them, so a failure on the way leaks nothing.
        let mut commands = Self {
            pool: vk::CommandPool::null(),
            buffer: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            name: name.to_owned(),
            in_flight: None,
            hazards: Hazards::default(),
            device: device.clone(),
        };
        let info = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::TRANSIENT)
            .queue_family_index(device.queue_family);
        // SAFETY: the device is alive and has the queue family.
        commands.pool = unsafe { device.raw.create_command_pool(&info, None) }.map_err(failed("command pool"))?;
        device.set_name(commands.pool, name);
        let info = vk::CommandBufferAllocateInfo::default().command_pool(commands.pool).command_buffer_count(1);
        // SAFETY: the pool is alive.
        commands.buffer = unsafe { device.raw.allocate_command_buffers(&info) }.map_err(failed("command buffer"))?[0];
        device.set_name(commands.buffer, name);
        // SAFETY: the device is alive.
        commands.fence =
            unsafe { device.raw.create_fence(&vk::FenceCreateInfo::default(), None) }.map_err(failed("fence"))?;
        device.set_name(commands.fence, name);
        Ok(commands)
    }

    /// Records, submits, and waits until the device is done. Images lose what they held.
    pub fn run(&mut self, record: impl FnOnce(&mut Recorder) -> Result<(), GpuError>) -> Result<(), GpuError> {
        // The host waits for each such submission, so nothing is owed between two of them.
        self.hazards = Hazards::default();
        self.go_on(record)
    }

    /// As [`Commands::run`], but images keep what the last run left in them.
    pub fn go_on(&mut self, record: impl FnOnce(&mut Recorder) -> Result<(), GpuError>) -> Result<(), GpuError> {
        let mut hazards = std::mem::take(&mut self.hazards);
        let submitted = self.submit(&mut hazards, Semaphores::default(), record);
        self.hazards = hazards;
        submitted?;
        self.wait()
    }

    /// Records and submits, after waiting for the submission before; `hazards` is the book of the submissions that
    /// this one follows without the host's waiting for them, and stays as it is where nothing is submitted.
    pub(super) fn submit(
        &mut self,
        hazards: &mut Hazards,
        semaphores: Semaphores,
        record: impl FnOnce(&mut Recorder) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        let before = hazards.clone();
        let submitted = self.record_and_submit(hazards, semaphores, record);
        if submitted.is_err() {
            *hazards = before;
        }
        submitted
    }

    fn record_and_submit(
        &mut self,
        hazards: &mut Hazards,
        semaphores: Semaphores,
        record: impl FnOnce(&mut Recorder) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        self.wait()?;
        let raw = &self.device.raw;
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the last submission was waited for, so the pool is free to reset.
        unsafe {
            raw.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty())
                .and_then(|()| raw.begin_command_buffer(self.buffer, &begin))
        }
        .map_err(GpuError::call(|| format!("begin recording '{}'", self.name)))?;

        let mut recorder = Recorder::new(self.buffer, &self.device, hazards);
        record(&mut recorder)?;
        let kept = recorder.finish();

        let buffers = [self.buffer];
        let (waited, stages) = semaphores.wait.unzip();
        let mut submit = vk::SubmitInfo::default().command_buffers(&buffers);
        // An empty list that is somewhere is a warning to the layer.
        if waited.is_some() {
            submit = submit.wait_semaphores(waited.as_slice()).wait_dst_stage_mask(stages.as_slice());
        }
        if semaphores.signal.is_some() {
            submit = submit.signal_semaphores(semaphores.signal.as_slice());
        }
        let submitted = self.device.with_queue(|queue| {
            // SAFETY: everything recorded is kept until the wait ends; no submission is using the fence, and no other
            // thread the queue.
            unsafe {
                raw.end_command_buffer(self.buffer)
                    .and_then(|()| raw.reset_fences(&[self.fence]))
                    .and_then(|()| raw.queue_submit(queue, &[submit], self.fence))
            }
        });
        submitted.map_err(GpuError::call(|| format!("submit '{}'", self.name)))?;
        self.in_flight = Some(kept);
        Ok(())
    }

    /// Waits until the device is done with the last submission; while the answer is held, none follows.
    pub fn idle(&mut self) -> Result<Idle<'_>, GpuError> {
        self.wait()?;
        Ok(Idle(PhantomData))
    }

    /// Waits until the device is done with the last submission.
    pub(super) fn wait(&mut self) -> Result<(), GpuError> {
        if self.in_flight.is_none() {
            return Ok(());
        }
        // SAFETY: the fence was given to a submission.
        let mut waited = unsafe { self.device.raw.wait_for_fences(&[self.fence], true, u64::MAX) };
        if waited.is_ok() && self.device.is_gpu_assisted() {
            // Layer 1.4.309 reads what kernels did in a thread of its own, which the fence does not wait for, and
            // forgets it with the command buffer. SAFETY: the device is alive; no other thread uses the queue.
            waited = self.device.with_queue(|queue| unsafe { self.device.raw.queue_wait_idle(queue) });
        }
        if waited.is_err() {
            // Work may be left in flight, which must not outlive its resources. On a lost device there is none, and
            // this fails too.
            // SAFETY: the device is alive; no other thread uses its queue.
            let _ = self.device.with_queue(|_| unsafe { self.device.raw.device_wait_idle() });
        }
        self.in_flight = None;
        waited.map_err(GpuError::call(|| format!("run '{}'", self.name)))
    }
}

impl Drop for Commands {
    fn drop(&mut self) {
        // A lost device runs nothing more, and there is nobody to report it to.
        let _ = self.wait();
        // SAFETY: nothing is in flight; null handles are ignored.
        unsafe {
            self.device.raw.destroy_fence(self.fence, None);
            self.device.raw.destroy_command_pool(self.pool, None);
        }
    }
}
