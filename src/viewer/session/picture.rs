//! The picture of the scene as it is now: asked for, waited for, and kept in files.

use std::time::Instant;

use super::super::action::Kernel;
use super::super::options::Wake;
use super::super::own_kernel::OwnKernel;
use super::super::reference_worker::ReferenceWorker;
use super::super::screen::ScreenError;
use super::super::state::Message;
use super::{Reference, Screenshot, Session};
use crate::plan::{Limits, Plan, PlanError};
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::tracer::{Canvas, Settings, TracerError, limits_of};

impl Session {
    /// Kernels compiled meanwhile take the last ones' places; a broken one is reported, and its last good build goes
    /// on.
    #[cfg(debug_assertions)]
    pub(super) fn take_kernels(&mut self) {
        let Some(builds) = self.shader_watch.as_ref().and_then(|watch| watch.take()) else { return };
        let Some(screen) = &mut self.screen else { return };
        let replaced = builds.into_iter().map(|build| {
            let replaced = screen.canvas.replace_shader(build?);
            replaced.map_err(|error| error.to_string())
        });
        // The builds of one kernel have the same mistakes.
        self.shader_error = replaced.filter_map(Result::err).reduce(|first, _| first);
        // The widgets of this frame are drawn already.
        self.wake();
    }

    /// Has the picture of the scene as it is now traced, if it is not yet.
    pub(super) fn ask_for_picture(&mut self) -> Result<(), ScreenError> {
        let (_, size) = self.picture_pixels();
        let Some(screen) = &mut self.screen else { return Ok(()) };
        if size != screen.canvas.size() {
            screen.canvas.resize(&mut screen.in_flight, size)?;
            self.frame_times.clear();
            self.reference.shown = None;
        }
        if screen.canvas.set_sampling(&mut screen.in_flight, self.state.sampling())? {
            self.frame_times.clear();
        }
        let limits = limits_of(screen.canvas.device().description());
        let asked = self.ask_at_precision(&limits, size);
        self.refusal = match asked {
            Ok(()) => None,
            Err(TracerError::Refused(reason)) => Some(reason),
            Err(error) => return Err(error.into()),
        };
        Ok(())
    }

    fn ask_at_precision(&mut self, limits: &Limits, size: [u32; 2]) -> Result<(), TracerError> {
        let refused = |error: PlanError| TracerError::Refused(error.to_string());
        self.choose_precision(limits, size, false).map_err(refused)?;
        self.ask_kernel(limits, size)?;
        // The scene did not change since the last frame.
        let is_at_rest = self.screen.as_ref().is_some_and(|screen| screen.canvas.is_whole());
        if is_at_rest && !self.is_precision_known {
            self.choose_precision(limits, size, true).map_err(refused)?;
            self.ask_kernel(limits, size)?;
        }
        Ok(())
    }

    fn ask_kernel(&mut self, limits: &Limits, size: [u32; 2]) -> Result<(), TracerError> {
        let scene = &*self.state.shaded_scene();
        let chosen = self.chosen.as_ref().map(|chosen| chosen.precision);
        if !self.state.kernel.description().is_on_device() {
            return self.ask_for_reference();
        }
        let settings = self.state.kernel.settings();
        // With the precision chosen already, no pixels are tried for it.
        let settings = RenderSettings { precision: chosen.or(settings.precision), ..settings };
        let settings = match self.state.kernel {
            // What a plan leaves out is another thing for every scene, and a kernel would be compiled at every edit.
            Kernel::Own(OwnKernel { algorithm, .. }) => {
                let precision = settings.precision.unwrap_or(algorithm.description().precisions[0]);
                let kernel = algorithm.kernel(precision);
                let kernel = kernel.ok_or_else(|| TracerError::Refused(format!("no {} there", precision.name())))?;
                Settings { kernel, ..Settings::new(size[0], size[1]) }
            }
            Kernel::BySetting(_) => {
                let plan = Plan::for_scene(scene, &settings, size, limits);
                Settings::planned(&plan.map_err(|error| TracerError::Refused(error.to_string()))?)
            }
        };
        self.reference = Reference::default();
        let Some(screen) = &mut self.screen else { return Ok(()) };
        if screen.canvas.use_kernel(settings.kernel)? {
            self.frame_times.clear();
        }
        screen.canvas.set_settings(settings);
        screen.canvas.show(scene)?;
        // The precision is chosen at rest, between two pictures.
        if self.state.is_continuous && self.screenshots.is_empty() && self.is_precision_known {
            screen.canvas.trace_again(scene)?;
        }
        Ok(())
    }

    fn ask_for_reference(&mut self) -> Result<(), TracerError> {
        let Some(screen) = &mut self.screen else { return Ok(()) };
        let scene = &*self.state.shaded_scene();
        let size = screen.canvas.size();
        let Reference { worker, shown, failure } = &mut self.reference;
        match worker.as_ref().filter(|worker| worker.size == size).and_then(ReferenceWorker::take) {
            Some(Ok(frame)) => {
                screen.canvas.put(&mut screen.in_flight, &frame)?;
                self.pictures_traced += 1;
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
            let proxy = self.proxy.clone();
            let wake = move || {
                // A loop that has ended needs no waking.
                let _ = proxy.send_event(Wake::News);
            };
            *worker = Some(ReferenceWorker::start(scene.clone(), size, wake));
        }
        Ok(())
    }

    /// How far the picture shown is and, apart from what is still to be chosen for the scene, the canvas.
    pub(super) fn stage(&self) -> [bool; 4] {
        let canvas = self.screen.as_ref().map(|screen| &screen.canvas);
        let (is_whole, is_finished) = (canvas.is_some_and(Canvas::is_whole), canvas.is_some_and(Canvas::is_finished));
        [self.is_whole(), self.is_finished(), is_whole, is_finished]
    }

    /// Whether the picture shown is all of the scene as it is now.
    pub(super) fn is_whole(&self) -> bool {
        self.is_shown(Canvas::is_whole)
    }

    /// Whether it is, and has all samples.
    pub(super) fn is_finished(&self) -> bool {
        self.is_shown(Canvas::is_finished)
    }

    fn is_shown(&self, is_traced: impl Fn(&Canvas) -> bool) -> bool {
        let is_traced = self.screen.as_ref().is_some_and(|screen| is_traced(&screen.canvas));
        self.refusal.is_none() && self.reference.worker.is_none() && self.is_precision_known && is_traced
    }

    /// Of finished pictures only: until then they wait, and one whose scene has changed meanwhile is not taken.
    pub(super) fn take_screenshots(&mut self) -> Result<(), ScreenError> {
        if self.screenshots.is_empty() {
            return Ok(());
        }
        if let Some(refusal) = self.refusal.clone() {
            self.screenshots.clear();
            self.state.report(refusal);
            self.wake();
            return Ok(());
        }
        let scene = self.state.shaded_scene();
        let asked = self.screenshots.len();
        self.screenshots.retain(|screenshot| screenshot.scene == *scene);
        if self.screenshots.len() < asked {
            self.state.say(Message::SceneChanged);
            self.wake();
        }
        if self.screenshots.is_empty() || !self.is_finished() {
            return Ok(());
        }
        let Some(screen) = &mut self.screen else { return Ok(()) };
        let frame = screen.canvas.read_back(&mut screen.in_flight)?;
        for Screenshot { path, .. } in std::mem::take(&mut self.screenshots) {
            if let Err(error) = frame.save(&path) {
                self.state.report(error);
                self.widgets_due = Some(Instant::now());
            }
        }
        Ok(())
    }
}
