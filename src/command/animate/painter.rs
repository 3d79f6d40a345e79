//! A scene at one time after another.

use std::mem;
use std::sync::Arc;

use anyhow::Result;

use crate::algorithm::Precision;
use crate::command::interrupt::Listener;
use crate::frame::Frame;
use crate::gpu::Device;
use crate::measure::TimedTracer;
use crate::plan::{Limits, Plan};
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::tracer::{Settings, limits_of};

/// Draws a scene that moves; what is on the device is kept where it fits the next picture.
pub struct Painter<'d> {
    device: &'d Arc<Device>,
    scene: Scene,
    setting: RenderSettings,
    size: [u32; 2],
    limits: Limits,
    /// After the first picture.
    tracer: Option<TimedTracer>,
    has_warned: bool,
}

/// A picture.
pub struct Drawn {
    pub frame: Frame,
    /// `None` where the device has no timestamps.
    pub gpu_time_ns: Option<u64>,
    /// What it was calculated in.
    pub precision: Precision,
    /// No linear channel is changed more by what was left out.
    pub error_bound: f64,
}

impl<'d> Painter<'d> {
    /// Of pictures of a size, pixels.
    pub fn new(device: &'d Arc<Device>, scene: Scene, setting: RenderSettings, size: [u32; 2]) -> Self {
        let limits = limits_of(device.description());
        Self { device, scene, setting, size, limits, tracer: None, has_warned: false }
    }

    /// The picture at a time, s.
    ///
    /// # Errors
    /// The scene is none then, the device fails, or Ctrl-C.
    pub fn draw(&mut self, seconds: f64, listener: &Listener) -> Result<Drawn> {
        self.scene.go_to(seconds)?;
        let scene = self.setting.shading.applied(&self.scene);
        let plan = Plan::for_scene(&scene, &self.setting, self.size, &self.limits)?;
        if let Some(warning) = plan.warning().filter(|_| !self.has_warned) {
            eprintln!("warning: at {seconds} s: {warning}");
            self.has_warned = true;
        }
        let settings = Settings::planned(&plan);
        let mut tracer = match self.tracer.take() {
            Some(mut tracer) => {
                tracer.set_scene(&scene, &settings)?;
                tracer
            }
            None if self.setting.algorithm.description().is_statistical => {
                TimedTracer::of_paths(self.device, &scene, &settings, self.setting.samples)?
            }
            None => TimedTracer::new(self.device, &scene, &settings)?,
        };
        let gpu_time_ns = tracer.draw(&mut || listener.keep_going())?.gpu_time_ns;
        let [width, height] = self.size;
        let frame = mem::replace(&mut tracer.frame, Frame::new(width, height)?);
        self.tracer = Some(tracer);
        Ok(Drawn { frame, gpu_time_ns, precision: settings.kernel.precision(), error_bound: plan.bounds.total() })
    }
}
