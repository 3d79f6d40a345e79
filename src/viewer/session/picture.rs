//! The picture of the scene as it is now: asked for, waited for, and kept in files.

use std::ops::Range;
use std::time::Instant;

use super::super::action::Kernel;
use super::super::panel::Paths;
use super::super::screen::ScreenError;
use super::super::state::Message;
use super::side::{Answer, Side, Wanted};
use super::{Screenshot, Session};
use crate::frame::Frame;
use crate::scene::Scene;
use crate::tracer::{Canvas, TracerError, limits_of};

impl Session {
    /// Kernels compiled meanwhile take the last ones' places; a broken one is reported, and its last good build goes
    /// on.
    #[cfg(any(debug_assertions, test))]
    pub(super) fn take_kernels(&mut self) {
        let Some(builds) = self.shader_watch.as_ref().and_then(|watch| watch.take()) else { return };
        let Some(screen) = &mut self.screen else { return };
        let canvases = &mut screen.canvases;
        let (mut good, mut errors) = (Vec::new(), Vec::new());
        for build in builds {
            match build {
                Ok(build) => good.push(build),
                Err(error) => errors.push(error),
            }
        }
        let replaced = canvases.iter_mut().try_for_each(|canvas| canvas.replace_shaders(good.iter().cloned()));
        errors.extend(replaced.err().map(|error| error.to_string()));
        // The builds of one kernel have the same mistakes.
        self.shader_error = errors.into_iter().next();
        // The widgets of this frame are drawn already.
        self.wake();
    }

    /// Has the picture of the scene as it is now traced, if it is not yet.
    pub(super) fn ask_for_picture(&mut self) -> Result<(), ScreenError> {
        let (_, size) = self.picture_pixels();
        let Self { state, screen: Some(screen), sides, proxy, .. } = self else { return Ok(()) };
        let kernels: Vec<_> = state.kernels().collect();
        screen.set_sides(kernels.len())?;
        sides.resize_with(kernels.len(), Side::default);
        let limits = limits_of(screen.device().description());
        for (index, (side, kernel)) in sides.iter_mut().zip(kernels).enumerate() {
            let (scene, sampling) = (&*state.shaded_scene(kernel), state.sampling(kernel));
            let wanted = Wanted { index, kernel, scene, sampling, size, limits: &limits, proxy };
            let Answer { is_new, is_traced } = side.ask(screen, &wanted)?;
            self.pictures_traced += u64::from(is_traced);
            // The times are those of the first side.
            if is_new && index == 0 {
                self.frame_times.clear();
            }
        }
        // The precision is chosen at rest, between two pictures.
        if self.state.is_continuous && self.screenshots.is_empty() && self.is_whole() {
            self.trace_again()?;
        }
        Ok(())
    }

    fn trace_again(&mut self) -> Result<(), TracerError> {
        let Some(screen) = &mut self.screen else { return Ok(()) };
        let on_device = |kernel: &Kernel| kernel.description().is_on_device();
        for (canvas, kernel) in
            screen.canvases.iter_mut().zip(self.state.kernels()).filter(|(_, kernel)| on_device(kernel))
        {
            canvas.trace_again(&self.state.shaded_scene(kernel))?;
        }
        Ok(())
    }

    /// Estimates the noise of pictures by path tracing, when they have come far enough since the last time.
    pub(super) fn estimate_noise(&mut self) -> Result<(), ScreenError> {
        let Self { screen: Some(screen), sides, state, .. } = self else { return Ok(()) };
        let statistical = |(_, kernel): &(usize, Kernel)| kernel.description().is_statistical;
        for (index, _) in state.kernels().enumerate().filter(statistical) {
            let (Some(side), Some(canvas)) = (sides.get_mut(index), screen.canvases.get(index)) else { continue };
            if let Some(samples) = canvas.whole_samples().filter(|samples| side.noise.see(*samples)) {
                side.noise.keep(samples, screen.read_back(index)?);
            }
        }
        Ok(())
    }

    /// Of the first side that is drawn by path tracing.
    pub(super) fn paths(&self) -> Option<Paths> {
        let index = self.state.kernels().position(|kernel| kernel.description().is_statistical)?;
        let (kernel, canvas) = (self.state.kernels().nth(index)?, self.screen.as_ref()?.canvases.get(index)?);
        let so_far = canvas.samples();
        let error = self.sides.get(index)?.noise.error(so_far);
        Some(Paths { so_far, asked_for: self.state.sampling(kernel).samples, error })
    }

    /// How far the picture shown is and, apart from what is still to be chosen for the scene, the canvas.
    pub(super) fn stage(&self) -> [bool; 4] {
        let canvases = || self.screen.iter().flat_map(|screen| &screen.canvases);
        let (is_whole, is_finished) = (canvases().all(Canvas::is_whole), canvases().all(Canvas::is_finished));
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
        self.screen.as_ref().is_some_and(|screen| {
            let is_traced = screen.canvases.iter().all(is_traced);
            is_traced && screen.canvases.len() == self.sides.len() && self.sides.iter().all(Side::is_settled)
        })
    }

    /// Why a kernel does not draw the scene, of the first side where one does not.
    pub(super) fn refusal(&self) -> Option<&str> {
        self.sides.iter().find_map(|side| side.refusal.as_deref())
    }

    /// Of finished pictures only: until then they wait, and one whose scene has changed meanwhile is not taken.
    pub(super) fn take_screenshots(&mut self) -> Result<(), ScreenError> {
        if self.screenshots.is_empty() {
            return Ok(());
        }
        if let Some(refusal) = self.refusal().map(str::to_owned) {
            self.screenshots.clear();
            self.state.report(refusal);
            self.wake();
            return Ok(());
        }
        let scenes = self.drawn_scenes();
        let asked = self.screenshots.len();
        self.screenshots.retain(|screenshot| screenshot.scenes == scenes);
        if self.screenshots.len() < asked {
            self.state.say(Message::SceneChanged);
            self.wake();
        }
        if self.screenshots.is_empty() || !self.is_finished() {
            return Ok(());
        }
        let Some(frame) = self.shown_picture()? else { return Ok(()) };
        for Screenshot { path, .. } in std::mem::take(&mut self.screenshots) {
            if let Err(error) = frame.save(&path) {
                self.state.report(error);
                self.widgets_due = Some(Instant::now());
            }
        }
        Ok(())
    }

    /// As each side draws it.
    pub(super) fn drawn_scenes(&self) -> Vec<Scene> {
        self.state.kernels().map(|kernel| self.state.shaded_scene(kernel).into_owned()).collect()
    }

    /// The columns of the picture that each of two sides has, pixels.
    pub(super) fn columns(&self) -> Vec<Range<u32>> {
        let (_, [width, _]) = self.picture_pixels();
        let divider = (self.state.divider * f64::from(width)).round() as u32;
        let divider = if self.state.beside.is_some() { divider } else { width };
        vec![0..divider, divider..width]
    }

    /// What is seen, each side's part by itself.
    fn shown_picture(&mut self) -> Result<Option<Frame>, TracerError> {
        let columns = self.columns();
        let Some(screen) = &mut self.screen else { return Ok(None) };
        let mut shown: Option<Frame> = None;
        for (side, columns) in columns.into_iter().enumerate().take(screen.canvases.len()) {
            let frame = screen.read_back(side)?;
            let Some(shown) = &mut shown else {
                shown = Some(frame);
                continue;
            };
            let (width, part) = (frame.width() as usize, columns.start as usize..columns.end as usize);
            let rows = shown.pixels_mut().chunks_exact_mut(width).zip(frame.pixels().chunks_exact(width));
            rows.for_each(|(row, of_side)| row[part.clone()].copy_from_slice(&of_side[part.clone()]));
        }
        Ok(shown)
    }
}
