//! The course's kernel, `glsl/course.comp`: its pipeline and the scene it draws.

use std::sync::Arc;

use bytemuck::NoUninit;

use super::TracerError;
use super::records::{FrameRecord, PrimitiveRecords};
use crate::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, ComputePipeline, Device, GpuError, PipelineDescription, Recorder,
    Resource, shaders,
};
use crate::scene::{COURSE_PRIMITIVE_LIMIT, Scene};

/// `MAX_PRIMITIVES` of `glsl/interface.glsl`: the course work's limit, over all kinds together.
pub const MAX_PRIMITIVES: usize = COURSE_PRIMITIVE_LIMIT;

/// Bindings of `glsl/course/bindings.glsl`: the picture, then spheres, boxes, cylinders and cones.
pub const BINDINGS: [BindingKind; 5] =
    [BindingKind::Picture, BindingKind::Uniform, BindingKind::Uniform, BindingKind::Uniform, BindingKind::Uniform];

/// Pixels of a workgroup. lavapipe packs eight neighbours along x into one SIMD register, GPUs take 32 or 64
/// invocations at a time, which lie nearest to each other in a square.
pub const WORKGROUP: [u32; 2] = [8, 8];

/// The pipeline with one scene bound to it.
pub(super) struct CourseKernel {
    pipeline: ComputePipeline,
    set: BindingSet,
    frame: FrameRecord,
    workgroup: [u32; 2],
}

impl CourseKernel {
    /// `max_depth` generations at most.
    pub fn new(
        device: &Arc<Device>,
        scene: &Scene,
        max_depth: u32,
        [width, height]: [u32; 2],
        workgroup: [u32; 2],
        picture: &Resource,
    ) -> Result<Self, TracerError> {
        let [light] = &scene.lights[..] else {
            return Err(TracerError::Refused(format!(
                "the course kernel needs exactly one light, and the scene has {}",
                scene.lights.len()
            )));
        };
        if scene.primitives.len() > MAX_PRIMITIVES {
            return Err(TracerError::Refused(format!(
                "the course kernel takes at most {MAX_PRIMITIVES} primitives, and the scene has {}",
                scene.primitives.len()
            )));
        }

        let pipeline = ComputePipeline::new(
            device,
            &PipelineDescription {
                shader: &shaders::COURSE,
                bindings: &BINDINGS,
                push_constant_bytes: size_of::<FrameRecord>() as u32,
                constants: &[max_depth, workgroup[0], workgroup[1]],
            },
        )?;
        let records = PrimitiveRecords::of(scene);
        let resources = [picture.clone()].into_iter().chain(upload(device, &records)?).collect::<Vec<_>>();
        let set = BindingSet::new(&pipeline, &resources)?;
        let frame = FrameRecord::new(scene, light, records.counts(), max_depth, width, height);
        Ok(Self { pipeline, set, frame, workgroup })
    }

    /// Traces the tile at `x`, `y` of the picture into the bound image.
    pub fn record<'a>(&'a self, recorder: &mut Recorder<'a>, [x, y]: [u32; 2], [width, height]: [u32; 2]) {
        let groups = [width.div_ceil(self.workgroup[0]), height.div_ceil(self.workgroup[1]), 1];
        recorder.dispatch(&self.pipeline, &self.set, bytemuck::bytes_of(&self.frame.at_tile(x, y)), groups);
    }
}

/// The four uniform buffers, in the order of their bindings.
pub fn upload(device: &Arc<Device>, records: &PrimitiveRecords) -> Result<[Resource; 4], GpuError> {
    Ok([
        uniform_array(device, "spheres", &records.spheres)?,
        uniform_array(device, "boxes", &records.boxes)?,
        uniform_array(device, "cylinders", &records.cylinders)?,
        uniform_array(device, "cones", &records.cones)?,
    ])
}

/// The block is as long as the shader declares it however few records there are: Vulkan asks for that.
fn uniform_array<T: NoUninit>(device: &Arc<Device>, name: &str, records: &[T]) -> Result<Resource, GpuError> {
    let mut buffer = Buffer::new(device, name, BufferKind::Uniform, (MAX_PRIMITIVES * size_of::<T>()) as u64)?;
    buffer.write(bytemuck::cast_slice(records))?;
    Ok(Resource::from(&Arc::new(buffer)))
}
