//! What the accurate kernel is made for: its specialization constants.

use std::sync::Arc;

use super::whitted_records::WhittedRecords;
use crate::gpu::{Device, DeviceKind, FloatWidth, GpuError, arithmetic};
use crate::plan::{CPU_LOOP_TURNS, Cuts, Precision};

/// What the kernel is made for, apart from its precision and its workgroup.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Requirements {
    /// Which kinds there are: spheres, boxes, cylinders, cones.
    pub kinds: [bool; 4],
    /// Of boxes over the solids of each kind.
    pub levels: [u32; 4],
    pub are_boxes_upright: bool,
    /// The records are those of a close-up.
    pub is_close_up: bool,
    pub highlights: bool,
    /// Whose balls primary rays may see: none, one, or several (2).
    pub balls: u32,
    /// That brighten: as many.
    pub lights: u32,
    pub shadows: bool,
    pub reflections: bool,
    /// Pixels have more than one sample.
    pub samples: bool,
    /// That an invocation traces, one after another.
    pub pixels: u32,
}

impl Requirements {
    pub fn of(records: &WhittedRecords, cuts: &Cuts, max_depth: u32) -> Self {
        let lights = |matter: bool| if matter { records.light_count.min(2) } else { 0 };
        let has_lights = lights(cuts.lights) > 0;
        Self {
            kinds: records.solids.counts.map(|count| count > 0),
            levels: records.solids.levels,
            are_boxes_upright: records.solids.are_boxes_upright,
            is_close_up: records.solids.frame.is_close_up,
            highlights: cuts.highlights && has_lights,
            balls: lights(cuts.balls),
            lights: lights(cuts.lights),
            shadows: cuts.shadows && has_lights,
            reflections: cuts.reflections && max_depth > 1,
            samples: false,
            pixels: 1,
        }
    }

    /// The specialization constants of `glsl/whitted/real.glsl`, `scene.glsl`, `camera.glsl` and `whitted.comp`.
    ///
    /// # Errors
    /// The device fails when its arithmetic is tried.
    pub fn constants(
        &self,
        device: &Arc<Device>,
        precision: Precision,
        [width, height]: [u32; 2],
    ) -> Result<[u32; 21], GpuError> {
        let float_width = match precision {
            Precision::F32 => FloatWidth::F32,
            Precision::F64 => FloatWidth::F64,
        };
        let has_fused_fma = u32::from(arithmetic(device, float_width)?.fused_fma);
        let [spheres, boxes, cylinders, cones] = self.kinds.map(u32::from);
        let [sphere_levels, box_levels, cylinder_levels, cone_levels] = self.levels;
        let &Self { highlights, balls, lights, shadows, reflections, samples, pixels, .. } = self;
        Ok([
            has_fused_fma,
            spheres,
            boxes,
            cylinders,
            cones,
            width,
            height,
            loop_turns(device),
            u32::from(self.are_boxes_upright),
            sphere_levels,
            box_levels,
            cylinder_levels,
            cone_levels,
            u32::from(highlights),
            lights,
            u32::from(shadows),
            u32::from(reflections),
            balls,
            u32::from(samples),
            pixels,
            u32::from(self.is_close_up),
        ])
    }
}

/// Specialization constant 7: the turns of loops that an invocation may take.
fn loop_turns(device: &Device) -> u32 {
    match device.description().kind {
        DeviceKind::Cpu => CPU_LOOP_TURNS,
        DeviceKind::Discrete | DeviceKind::Integrated | DeviceKind::Virtual | DeviceKind::Other => u32::MAX,
    }
}
