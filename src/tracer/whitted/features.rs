//! The accurate kernel's specialization constants.

use std::sync::Arc;

use super::records::WhittedRecords;
use crate::algorithm::Description;
use crate::gpu::{Device, DeviceKind, FloatWidth, GpuError, arithmetic};
use crate::plan::{
    Approximations, CPU_MAX_ITERATIONS, Features, LightFeatures, Precision, lights_told_apart, most_pending,
};

impl Features {
    /// Features of an exact picture, or of what `approximations` leave of it, as a scene's records have it.
    pub fn of(
        records: &WhittedRecords,
        algorithm: &Description,
        approximations: &Approximations,
        max_depth: u32,
    ) -> Self {
        let lights = |matter: bool, count: u32| if matter { count.min(2) } else { 0 };
        let has_lights = approximations.lights && records.light_count > 0;
        let media = records.light.media.seen_by(max_depth);
        Self {
            kinds: records.solids.counts.map(|count| count > 0),
            levels: records.solids.levels,
            are_boxes_axis_aligned: records.solids.are_boxes_axis_aligned,
            is_close_up: records.solids.frame.is_close_up,
            highlights: approximations.highlights && has_lights,
            light_spheres: lights(approximations.light_spheres, records.light_sphere_count),
            lights: if has_lights { lights_told_apart(algorithm, records.light_count) } else { 0 },
            shadows: approximations.shadows && has_lights,
            reflections: approximations.reflections && max_depth > 1,
            samples: false,
            pixels: 1,
            light: LightFeatures { media, ..records.light },
            pending: most_pending(media, max_depth),
            independent_numbers: false,
        }
    }

    /// The specialization constants of `glsl/whitted.comp`, `glsl/path.comp` and what they include, in the order of
    /// their numbers.
    ///
    /// # Errors
    /// The device fails when its arithmetic is tested.
    pub fn constants(
        &self,
        device: &Arc<Device>,
        precision: Precision,
        [width, height]: [u32; 2],
    ) -> Result<[u32; 27], GpuError> {
        let float_width = match precision {
            Precision::F32 => FloatWidth::F32,
            Precision::F64 => FloatWidth::F64,
        };
        let has_fused_fma = u32::from(arithmetic(device, float_width)?.fused_fma);
        let [spheres, boxes, cylinders, cones] = self.kinds.map(u32::from);
        let [sphere_levels, box_levels, cylinder_levels, cone_levels] = self.levels;
        let &Self { highlights, light_spheres, lights, shadows, reflections, samples, pixels, light, pending, .. } =
            self;
        Ok([
            has_fused_fma,
            spheres,
            boxes,
            cylinders,
            cones,
            width,
            height,
            max_iterations(device),
            u32::from(self.are_boxes_axis_aligned),
            sphere_levels,
            box_levels,
            cylinder_levels,
            cone_levels,
            u32::from(highlights),
            lights,
            u32::from(shadows),
            u32::from(reflections),
            light_spheres,
            u32::from(samples),
            pixels,
            u32::from(self.is_close_up),
            u32::from(light.shininess),
            u32::from(light.attenuation),
            u32::from(light.ambient_light),
            light.media as u32,
            pending,
            u32::from(self.independent_numbers),
        ])
    }
}

/// Specialization constant 7: the iterations of loops that an invocation may take; 0 for any number.
fn max_iterations(device: &Device) -> u32 {
    match device.description().kind {
        DeviceKind::Cpu => CPU_MAX_ITERATIONS,
        DeviceKind::Discrete | DeviceKind::Integrated | DeviceKind::Virtual | DeviceKind::Other => 0,
    }
}
