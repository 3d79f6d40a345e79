//! The picture, or one side of it: what is asked of the kernel that draws it, and what came of that.

use winit::event_loop::EventLoopProxy;

use super::super::action::Kernel;
use super::super::options::Wake;
use super::super::own_kernel::OwnKernel;
use super::super::reference_worker::ReferenceWorker;
use super::super::screen::Screen;
use super::noise::Noise;
use super::precision::Chosen;
use crate::plan::{Limits, Plan, PlanError};
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::settings::sampling::Sampling;
use crate::tracer::{Settings, TracerError};

#[derive(Default)]
pub(super) struct Side {
    /// Choice of precision; `None` where the kernel has none.
    pub chosen: Option<Chosen>,
    /// Whether that is to be made for the scene as it is, once it does not change.
    pub lacks_precision: bool,
    pub refusal: Option<String>,
    pub reference: Reference,
    pub noise: Noise,
}

/// The accurate picture, asked for and shown.
#[derive(Default)]
pub(super) struct Reference {
    pub worker: Option<ReferenceWorker>,
    shown: Option<(Scene, [u32; 2])>,
    /// Why there is no picture of this scene at this size.
    failure: Option<(Scene, [u32; 2], String)>,
}

/// What is asked of a side.
pub(super) struct Wanted<'a> {
    /// Of the side, from the left.
    pub index: usize,
    pub kernel: Kernel,
    /// As the kernel draws it.
    pub scene: &'a Scene,
    pub sampling: Sampling,
    /// Pixels.
    pub size: [u32; 2],
    pub limits: &'a Limits,
    pub proxy: &'a EventLoopProxy<Wake>,
}

/// What came of asking.
#[derive(Default)]
pub(super) struct Answer {
    /// The pictures before were of another size or by another kernel.
    pub is_new: bool,
    /// One came from the CPU.
    pub is_traced: bool,
}

impl Side {
    /// Has the picture traced on the side's canvas, if it is not yet.
    ///
    /// # Errors
    /// The device fails; what the kernel cannot do is in [`Side::refusal`].
    pub fn ask(&mut self, screen: &mut Screen, wanted: &Wanted) -> Result<Answer, TracerError> {
        let mut answer = Answer::default();
        let canvas = &mut screen.canvases[wanted.index];
        if wanted.size != canvas.size() {
            canvas.resize(&mut screen.in_flight, wanted.size)?;
            self.reference.shown = None;
            answer.is_new = true;
        }
        self.refusal = match self.ask_at_precision(screen, wanted, &mut answer) {
            Ok(()) => None,
            Err(TracerError::Refused(reason)) => Some(reason),
            Err(error) => return Err(error),
        };
        Ok(answer)
    }

    fn ask_at_precision(
        &mut self,
        screen: &mut Screen,
        wanted: &Wanted,
        answer: &mut Answer,
    ) -> Result<(), TracerError> {
        self.choose_precision(wanted, false).map_err(refused)?;
        self.ask_kernel(screen, wanted, answer)?;
        // The scene did not change since the last frame.
        if self.lacks_precision && screen.canvases[wanted.index].is_whole() {
            self.choose_precision(wanted, true).map_err(refused)?;
            self.ask_kernel(screen, wanted, answer)?;
        }
        Ok(())
    }

    fn ask_kernel(&mut self, screen: &mut Screen, wanted: &Wanted, answer: &mut Answer) -> Result<(), TracerError> {
        let &Wanted { index, kernel, scene, sampling, size, limits, .. } = wanted;
        if !kernel.description().is_on_device() {
            answer.is_traced |= self.ask_for_reference(screen, wanted)?;
            return Ok(());
        }
        let settings = kernel.settings();
        // With the precision chosen already, no pixels are tried for it.
        let chosen = self.chosen.as_ref().map(|chosen| chosen.precision);
        let settings = RenderSettings { precision: chosen.or(settings.precision), ..settings };
        let settings = match kernel {
            // What a plan leaves out is another thing for every scene, and a kernel would be compiled at every edit.
            Kernel::Own(OwnKernel { algorithm, .. }) => {
                let precision = settings.precision.unwrap_or(algorithm.description().precisions[0]);
                let kernel = algorithm.kernel(precision);
                let kernel = kernel.ok_or_else(|| TracerError::Refused(format!("no {} there", precision.name())))?;
                Settings { kernel, ..Settings::new(size[0], size[1]) }
            }
            Kernel::BySetting(_) => {
                Settings::planned(&Plan::for_scene(scene, &settings, size, limits).map_err(refused)?)
            }
        };
        self.reference = Reference::default();
        let canvas = &mut screen.canvases[index];
        answer.is_new |= canvas.use_kernel(settings.kernel)?;
        answer.is_new |= canvas.set_sampling(&mut screen.in_flight, sampling)?;
        canvas.set_settings(settings);
        canvas.show(scene)
    }

    /// Returns whether a picture came.
    fn ask_for_reference(&mut self, screen: &mut Screen, wanted: &Wanted) -> Result<bool, TracerError> {
        let &Wanted { index, scene, size, proxy, .. } = wanted;
        let Reference { worker, shown, failure } = &mut self.reference;
        let mut is_traced = false;
        match worker.as_ref().filter(|worker| worker.size == size).and_then(ReferenceWorker::take) {
            Some(Ok(frame)) => {
                screen.put(index, &frame)?;
                is_traced = true;
                *shown = worker.take().map(|worker| (worker.scene.clone(), worker.size));
            }
            Some(Err(reason)) => {
                *failure = worker.take().map(|worker| (worker.scene.clone(), worker.size, reason));
            }
            None => {}
        }
        let is_current = |of: &(Scene, [u32; 2])| of.0 == *scene && of.1 == size;
        let is_asked = worker.as_ref().is_some_and(|worker| worker.scene == *scene && worker.size == size);
        let failed = failure.as_ref().filter(|failure| failure.0 == *scene && failure.1 == size);
        if let Some((_, _, reason)) = failed {
            return Err(TracerError::Refused(reason.clone()));
        }
        if shown.as_ref().is_some_and(is_current) {
            *worker = None;
        } else if !is_asked {
            let proxy = proxy.clone();
            let wake = move || {
                // A loop that has ended needs no waking.
                let _ = proxy.send_event(Wake::News);
            };
            *worker = Some(ReferenceWorker::start(scene.clone(), size, wake));
        }
        Ok(is_traced)
    }

    /// Whether the picture is as it should be, once the canvas has traced what it was asked for.
    pub fn is_settled(&self) -> bool {
        self.refusal.is_none() && self.reference.worker.is_none() && !self.lacks_precision
    }
}

fn refused(error: PlanError) -> TracerError {
    TracerError::Refused(error.to_string())
}
