//! How to draw, apart from the scene.

use crate::algorithm::Kernel;
use crate::plan::{Approximations, Plan, WORKGROUP};
use crate::scene::Scene;
use crate::settings::Numbers;
use crate::settings::sampling::Sampling;

/// How to render, apart from the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// In place of the scene's.
    pub max_depth: Option<u32>,
    /// Largest side of what one submission traces, pixels; heavy scenes take smaller tiles, see
    /// [`tile_side`](crate::plan::tile_side).
    pub max_tile_side: u32,
    /// Pixels of a workgroup along x and y.
    pub workgroup: [u32; 2],
    /// Algorithm and precision.
    pub kernel: Kernel,
    /// What is left out; the course kernel leaves out nothing.
    pub approximations: Approximations,
    /// The accurate kernel goes down no boxes: each ray looks at every solid. Slow; what the boxes may not change is
    /// tested against it.
    pub without_boxes: bool,
    /// That an invocation of the accurate kernel traces one after another, where invocations come in packets: 1 to 8,
    /// in place of what [suits the scene](crate::plan::TraversalCost::pixels_per_invocation). What that may not change
    /// is tested with it.
    pub pixels: Option<u32>,
    /// Samples of each pixel, whose colour is their mean; 1 to 64. The course kernel takes 1. See
    /// [`Sampling`].
    pub samples: u32,
    /// Size of the picture that is traced against the one asked for, to which it is brought by bilinear interpolation;
    /// 1/4 to 1. The course kernel takes 1.
    pub scale: f64,
    /// Of path tracing's random numbers.
    pub seed: u32,
    /// Random numbers that know nothing of each other.
    pub independent_numbers: bool,
    /// By screen-space reflections: in place of the picture, why its reflections may be wrong, in colours.
    pub shows_reasons: bool,
}

impl Settings {
    /// By the course kernel, exactly.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            max_depth: None,
            max_tile_side: 1024,
            workgroup: WORKGROUP,
            kernel: Kernel::Course,
            approximations: Approximations::NONE,
            without_boxes: false,
            pixels: None,
            samples: 1,
            scale: 1.0,
            seed: 0,
            independent_numbers: false,
            shows_reasons: false,
        }
    }

    /// As a plan has it.
    pub fn planned(plan: &Plan) -> Self {
        let [width, height] = plan.size;
        Self {
            max_depth: Some(plan.generations.choice),
            max_tile_side: plan.tile_side.choice,
            workgroup: plan.workgroup.choice,
            kernel: plan.kernel,
            // Those of path tracing come run by run.
            samples: if plan.kernel.description().is_statistical { 1 } else { plan.settings.samples },
            seed: plan.settings.seed,
            independent_numbers: plan.settings.numbers == Numbers::Independent,
            scale: plan.settings.scale,
            approximations: plan.approximations,
            without_boxes: plan.is_without_boxes(),
            ..Self::new(width, height)
        }
    }

    /// The most that a path of the scene goes through.
    pub(super) fn generations(&self, scene: &Scene) -> u32 {
        self.max_depth.unwrap_or(scene.max_depth)
    }

    pub(super) fn sampling(&self) -> Sampling {
        Sampling { samples: self.samples, scale: self.scale }
    }
}
