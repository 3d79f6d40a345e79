//! Pictures of many scenes by few pipelines: to make one takes longer than to draw a small picture.

use std::ops::ControlFlow;

use glam::DVec3;
use zerkalo::frame::Frame;
use zerkalo::plan::{Features, MOST_PIXELS, TraversalCost, scene_space};
use zerkalo::scene::Scene;
use zerkalo::tracer::whitted::WhittedRecords;
use zerkalo::tracer::{Kernel, Settings, Tracer};

use crate::common::TestDevice;

/// One for each pipeline that the pictures take.
pub struct Tracers<'a> {
    device: &'a TestDevice,
    kept: Vec<(Made, Tracer)>,
}

/// What a tracer is made for and keeps from scene to scene.
#[derive(PartialEq)]
struct Made {
    kernel: Kernel,
    features: Features,
    size: [u32; 2],
    workgroup: [u32; 2],
    without_boxes: bool,
    has_samples: bool,
}

impl Made {
    fn of(scene: &Scene, settings: &Settings) -> Self {
        let &Settings { kernel, width, height, workgroup, without_boxes, samples, pixels, .. } = settings;
        let depth = settings.max_depth.unwrap_or(scene.max_depth);
        let records = WhittedRecords::of(scene, scene_space(scene, kernel), kernel.precision(), [width, height]);
        let unknown = if without_boxes { 1 } else { MOST_PIXELS };
        let with_pixels_per_invocation =
            || TraversalCost::of(&scene.primitives).pixels_per_invocation(scene.lights.len(), depth, unknown);
        let features = Features {
            pixels: pixels.unwrap_or_else(with_pixels_per_invocation),
            ..Features::of(&records, kernel.description(), &settings.approximations, depth)
        };
        Self { kernel, features, size: [width, height], workgroup, without_boxes, has_samples: samples > 1 }
    }
}

impl<'a> Tracers<'a> {
    pub fn new(device: &'a TestDevice) -> Self {
        Self { device, kept: Vec::new() }
    }

    /// Ready to draw the scene.
    fn tracer(&mut self, scene: &Scene, settings: &Settings) -> &mut Tracer {
        let made = Made::of(scene, settings);
        if let Some(place) = self.kept.iter().position(|(other, _)| *other == made) {
            let tracer = &mut self.kept[place].1;
            tracer.set_scene(scene, settings).unwrap();
            return tracer;
        }
        let tracer = Tracer::new(self.device, scene, settings).unwrap();
        self.kept.push((made, tracer));
        &mut self.kept.last_mut().expect("it was put there").1
    }

    pub fn draw(&mut self, scene: &Scene, settings: &Settings) -> Frame {
        let tracer = self.tracer(scene, settings);
        let mut frame = tracer.frame().unwrap();
        tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
        frame
    }

    /// Linear RGB.
    pub fn draw_f64(&mut self, scene: &Scene, settings: &Settings) -> Vec<DVec3> {
        self.tracer(scene, settings).render_f64().unwrap()
    }
}
