//! From what the window knows to what it shows.

use std::io;
use std::time::{Duration, Instant};

use super::super::action::Kernel;
use super::super::observer::{Observation, widgets};
use super::super::panel::{Readings, Shown, style};
use super::super::screen::{Screen, ScreenError, Widgets};
use super::super::state::Dialog;
use super::super::{camera_motion, highlight, preferences};
use super::{Losses, NextFrame, Session, new_egui, open_screen};
use crate::gpu::GpuError;
use crate::tracer::Canvas;

/// A step of the camera while a key is held covers at most this, however long the frame before took.
const LONGEST_STEP: Duration = Duration::from_millis(250);

/// A picture that takes long is shown as it grows, so often.
const GROWING_PERIOD: Duration = Duration::from_millis(100);

/// A window that takes no image is asked again after this: it may be hidden without having said so.
const RETRY_PERIOD: Duration = Duration::from_millis(250);

/// Where neither picture nor widgets are: a line at the picture's edge at most.
const BACKGROUND: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

impl Session {
    /// Draws a frame; a lost device is replaced once.
    pub fn paint(&mut self) -> Result<NextFrame, ScreenError> {
        match self.try_paint() {
            Err(error) if error.is_device_lost() && !self.losses.is_fresh => {
                self.keep_work();
                self.losses = Losses { count: self.losses.count + 1, is_fresh: true };
                // The window cannot serve two: the old one is gone before the new one is made.
                let builds = self.screen.take().map(|screen| screen.builds()).unwrap_or_default();
                self.screen = Some(open_screen(&self.window, &self.state, &self.options, &builds, &self.messages)?);
                // The new device has none of the textures that the old context has reported.
                (self.context, self.egui) = new_egui(&self.window, self.options.is_observed);
                self.sides.clear();
                self.wake();
                Ok(NextFrame::AtOnce)
            }
            painted => painted,
        }
    }

    fn try_paint(&mut self) -> Result<NextFrame, ScreenError> {
        if !self.is_recovering() {
            self.recovery.note(&self.state.document);
        }
        let size = self.window.inner_size();
        let Some(screen) = &mut self.screen else { return Ok(NextFrame::Whenever) };
        if size.width == 0 || size.height == 0 || !screen.prepare([size.width, size.height])? {
            return Ok(NextFrame::Whenever);
        }
        if self.is_only_tracing() {
            self.trace()?;
        } else {
            self.show()?;
        }
        self.frames += 1;
        if self.options.lose_device_after == Some(self.frames) {
            let result = ash::vk::Result::ERROR_DEVICE_LOST;
            return Err(GpuError::Call { operation: "go on, as asked".into(), result }.into());
        }
        Ok(self.next_frame())
    }

    /// Whether there is nothing new to look at yet.
    fn is_only_tracing(&self) -> bool {
        let is_due = self.widgets_due.is_some_and(|due| due <= Instant::now());
        let is_worth_a_look = |screen: &Screen| {
            let is_growing = screen.canvases.iter().any(Canvas::is_growing);
            is_growing && self.last_frame.elapsed() >= GROWING_PERIOD || !screen.is_tracing()
        };
        self.is_occluded || !is_due && !self.screen.as_ref().is_none_or(is_worth_a_look)
    }

    fn trace(&mut self) -> Result<(), ScreenError> {
        let stage_before = self.stage();
        let Some(screen) = &mut self.screen else { return Ok(()) };
        screen.trace()?;
        self.estimate_noise()?;
        // While picture follows picture, the next one shows the last one's time.
        let has_news = self.take_times() && !self.state.is_continuous;
        if has_news || self.stage() != stage_before {
            self.wake();
        }
        Ok(())
    }

    fn show(&mut self) -> Result<(), ScreenError> {
        self.widgets_due = None;
        if self.state.dialog.is_some() {
            self.input.let_go();
        }
        let stage_before = self.stage();
        self.fly();
        self.play();
        let (mut widgets, observation, repaint_delay) = self.run_widgets();
        let next_picture = self.state.document.timeline().until_next_picture();
        let delay = next_picture.map_or(repaint_delay, |next_picture| next_picture.min(repaint_delay));
        self.widgets_due = Instant::now().checked_add(delay);
        #[cfg(any(debug_assertions, test))]
        self.take_kernels();
        self.ask_for_picture()?;
        self.present(&mut widgets)?;
        self.take_screenshots()?;
        self.show_title();
        self.observe(observation)?;
        let is_next_due = self.state.is_continuous && self.state.kernel.description().is_on_device() && self.is_whole();
        if self.stage() != stage_before || is_next_due {
            // The widgets have shown what was, or a screenshot has held up the next picture.
            self.wake();
        }
        Ok(())
    }

    /// The widgets are to be drawn with the next frame.
    pub fn wake(&mut self) {
        self.widgets_due = Some(Instant::now());
    }

    /// Takes in the times of the pictures that came to their end; whether there were any.
    fn take_times(&mut self) -> bool {
        let Some(screen) = &mut self.screen else { return false };
        let mut canvases = screen.canvases.iter_mut().map(Canvas::take_finished);
        let finished = canvases.next().unwrap_or_default();
        let beside = canvases.map(|finished| finished.len()).sum::<usize>();
        self.pictures_traced += (finished.len() + beside) as u64;
        // How fast pictures follow each other: what is added to one at rest holds up none.
        let pictures = finished.iter().filter(|finished| finished.sample == 0);
        pictures.for_each(|finished| self.frame_times.push(finished.gpu_time_ns));
        let has_news = !finished.is_empty() || beside > 0;
        self.losses.is_fresh &= !has_news;
        has_news
    }

    /// Moves the camera by the keys held.
    fn fly(&mut self) {
        let now = Instant::now();
        let last_frame = std::mem::replace(&mut self.last_frame, now);
        let flight = self.input.flight();
        // The first frame of a flight begins it: what was before it was no flight.
        if let Some(flight) = flight.filter(|_| std::mem::replace(&mut self.is_flying, true)) {
            let (step, speed) = ((now - last_frame).min(LONGEST_STEP), self.state.preferences.fly_speed);
            camera_motion::fly(self.state.document.camera_mut(), flight, step.as_secs_f64(), speed);
        }
        self.is_flying = flight.is_some();
    }

    /// Lets time go on while it is played, from one whole picture to the next: those that would come too late are left
    /// out. A screenshot is of the time at which it was asked for.
    fn play(&mut self) {
        let is_playing = self.state.document.timeline().is_playing;
        let [_, _, is_whole, _] = self.stage();
        if is_playing && (!is_whole || !self.screenshots.is_empty()) && self.refusal().is_none() {
            return;
        }
        let last = std::mem::replace(&mut self.played_at, is_playing.then(Instant::now));
        if let Some(last) = last {
            self.state.play(last.elapsed());
        }
    }

    /// Draws the widgets and does what they ask; returns with them when they want to be drawn again.
    fn run_widgets(&mut self) -> (Widgets, Option<Observation>, Duration) {
        style(&self.context, &self.state.preferences);
        let input = self.egui.take_egui_input(&self.window);
        let context = self.context.clone();
        let mut shown = Shown { actions: Vec::new(), picture: self.picture, is_settled: true };
        let mut output = context.run_ui(input, |ui| {
            // egui may need a second pass to lay out a frame; what either asks for is to be done.
            let mut actions = std::mem::take(&mut shown.actions);
            shown = self.show_panel(ui);
            actions.append(&mut shown.actions);
            shown.actions = actions;
        });
        self.picture = shown.picture;
        let pixels_per_point = output.pixels_per_point;
        let observation = self.observer.is_some().then(|| {
            let mut observation = Observation::of(&self.state, &shown, pixels_per_point);
            let tree = output.platform_output.accesskit_update.as_ref();
            observation.widgets = tree.map(|tree| widgets(tree, pixels_per_point)).unwrap_or_default();
            observation
        });
        let is_asked = !shown.actions.is_empty();
        shown.actions.into_iter().for_each(|action| self.apply(action));
        if shown.is_settled && !self.input.is_busy() {
            self.state.document.end_run();
        }
        self.egui.handle_platform_output(&self.window, std::mem::take(&mut output.platform_output));
        let viewport = output.viewport_output.get(&egui::ViewportId::ROOT);
        // What was asked for is seen in the next frame.
        let delay = viewport.map_or(Duration::MAX, |viewport| viewport.repaint_delay);
        let delay = if is_asked { Duration::ZERO } else { delay };
        let primitives = context.tessellate(std::mem::take(&mut output.shapes), pixels_per_point);
        // Emptied at once: a delta dropped with something in it, as by an error on the way, panics in debug builds.
        let (textures, freed) = (&mut output.textures_delta.set, &mut output.textures_delta.free);
        let textures = textures.drain().flat_map(|(id, deltas)| deltas.into_iter().map(move |delta| (id, delta)));
        let textures = textures.collect();
        let freed_textures = freed.drain().collect();
        (Widgets { textures, freed_textures, primitives, pixels_per_point }, observation, delay)
    }

    fn show_panel(&mut self, ui: &mut egui::Ui) -> Shown {
        let (_, picture_size) = self.picture_pixels();
        let canvases = self.screen.iter().flat_map(|screen| &screen.canvases);
        let progress = self.sides.iter().zip(canvases).filter_map(|(side, canvas)| match &side.reference.worker {
            Some(worker) => Some(worker.progress()),
            None => canvas.progress(),
        });
        let (paths, refusal) = (self.paths(), self.refusal().map(str::to_owned));
        let chosen = self.sides.first().and_then(|side| side.chosen.as_ref());
        let mut warnings = self.sides.iter().filter_map(|side| side.chosen.as_ref()?.warning.as_deref());
        let readings = Readings {
            device: self.screen.as_ref().map_or("", |screen| &screen.device().description().name),
            picture_size,
            frame_times: &self.frame_times,
            progress: progress.reduce(f32::min),
            paths,
            refusal: refusal.as_deref(),
            precision: chosen.map(|chosen| chosen.precision),
            warning: warnings.next(),
            shader_error: self.shader_error.as_deref(),
        };
        let shown = self.panel.show(ui, &self.state, &readings);
        if let Some(index) = self.state.document.selection() {
            let scene = self.state.document.shown_scene();
            let (corner, size) = self.picture_pixels();
            let scale = ui.ctx().pixels_per_point();
            // Where the picture's pixels are, which the free place may miss by half of one.
            let corner = egui::pos2(corner[0] as f32, corner[1] as f32) / scale;
            let place = egui::Rect::from_min_size(corner, egui::vec2(size[0] as f32, size[1] as f32) / scale);
            highlight::draw(ui.painter(), place, size, &scene.camera, &scene.primitives[index].solid);
        }
        shown
    }

    fn present(&mut self, widgets: &mut Widgets) -> Result<(), ScreenError> {
        let (corner, _) = self.picture_pixels();
        let (is_whole_before, columns) = (self.is_whole(), self.columns());
        let Some(screen) = &mut self.screen else { return Ok(()) };
        let is_shown = screen.show(widgets, BACKGROUND, corner, &columns)?;
        self.estimate_noise()?;
        if self.take_times() && !self.state.is_continuous {
            self.wake();
        }
        if !is_shown {
            self.widgets_due = Some(Instant::now() + RETRY_PERIOD);
        }
        let input_at = self.latency.input_at.take();
        if !is_whole_before && self.latency.changed_at.is_none() {
            self.latency.changed_at = input_at;
        }
        if self.is_whole()
            && let Some(changed_at) = self.latency.changed_at.take()
            && self.observer.is_some()
            && let Some(screen) = &mut self.screen
        {
            // Only who asks for the figure pays for it.
            screen.in_flight.wait_for_all()?;
            self.latency.last_ms = Some(changed_at.elapsed().as_secs_f64() * 1e3);
        }
        Ok(())
    }

    /// What the window's frame shows.
    fn show_title(&mut self) {
        let document = &self.state.document;
        let name = document.path().and_then(|path| path.file_name()).map(|name| name.display().to_string());
        let mark = if document.has_unsaved_changes() { "* " } else { "" };
        let name = name.map(|name| name + " — ").unwrap_or_default();
        let title = format!("{mark}{name}zerkalo");
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }

    fn keep_work(&mut self) {
        if !self.is_recovering() {
            self.recovery.keep(&self.state.document);
        }
    }

    /// Whether the last run's unsaved work is still to be decided about: it must not be written over.
    fn is_recovering(&self) -> bool {
        self.state.dialog == Some(Dialog::Recover)
    }

    /// After the last frame: the preferences are kept and, unless the user has decided about it, unsaved work.
    pub fn finish(&mut self) {
        if self.is_quitting && !self.is_recovering() {
            self.recovery.forget();
        } else {
            self.keep_work();
        }
        let size = self.window.inner_size().to_logical::<u32>(self.window.scale_factor());
        if size.width > 0 && size.height > 0 {
            self.state.preferences.window_size = [size.width, size.height];
        }
        if let Some(folder) = &self.options.config_folder {
            // A window that cannot remember its size is still a window.
            let _ = self.state.preferences.save(&preferences::file_in(folder));
        }
    }

    fn observe(&mut self, observation: Option<Observation>) -> io::Result<()> {
        let (is_whole, is_finished) = (self.is_whole(), self.is_finished());
        let refusal = self.refusal().map(str::to_owned);
        let (Some(observer), Some(mut observation), Some(screen)) = (&mut self.observer, observation, &self.screen)
        else {
            return Ok(());
        };
        let size = self.window.inner_size();
        observation.window = [size.width, size.height];
        observation.picture_size = screen.canvases.first().map(Canvas::size).unwrap_or_default();
        observation.is_whole = is_whole;
        observation.is_finished = is_finished;
        observation.pictures_traced = self.pictures_traced;
        observation.latency_ms = self.latency.last_ms;
        observation.gpu_time_ms = self.frame_times.percentile_ns(50).map(|median_ns| median_ns as f64 / 1e6);
        observation.uploaded_bytes = screen.canvases.iter().map(Canvas::uploaded_bytes).sum();
        observation.refusal = refusal;
        let chosen = self.sides.first().and_then(|side| side.chosen.as_ref());
        if let (Kernel::Own(kernel), Some(chosen)) = (self.state.kernel, chosen) {
            observation.kernel = format!("{} {}", kernel.algorithm.name(), chosen.precision.name());
        }
        observation.device_losses = self.losses.count;
        observation.validation_messages = self.messages.count();
        observer.tell(observation)
    }

    fn next_frame(&self) -> NextFrame {
        let is_tracing = self.screen.as_ref().is_some_and(Screen::is_tracing);
        if is_tracing || self.input.flight().is_some() {
            return NextFrame::AtOnce;
        }
        let recovery = self.recovery.due(&self.state.document).filter(|_| !self.is_recovering());
        let widgets_due = self.widgets_due.filter(|_| !self.is_occluded);
        match widgets_due.into_iter().chain(recovery).min() {
            Some(due) if due <= Instant::now() => NextFrame::AtOnce,
            Some(due) => NextFrame::At(due),
            None => NextFrame::Whenever,
        }
    }
}
