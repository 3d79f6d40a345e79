//! The course's kernel, `glsl/course.comp`: its pipeline and the scene it draws.

use std::sync::Arc;

use bytemuck::NoUninit;

use super::TracerError;
use super::parts::Part;
use super::records::{CoursePushConstants, PrimitiveRecords};
use crate::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, ComputePipeline, Device, Dispatch, GpuError, PipelineDescription,
    Recorder, Resource, Shader, Use,
};
use crate::scene::{COURSE_PRIMITIVE_LIMIT, Light, Scene};

/// `MAX_PRIMITIVES` of `glsl/course/interface.glsl`: the course work's limit, over all kinds together.
pub const MAX_PRIMITIVES: usize = COURSE_PRIMITIVE_LIMIT;

/// Bindings of `glsl/course/bindings.glsl`: the picture, then spheres, boxes, cylinders and cones.
pub const BINDINGS: [BindingKind; 5] =
    [BindingKind::Picture, BindingKind::Uniform, BindingKind::Uniform, BindingKind::Uniform, BindingKind::Uniform];

/// Pixels of a workgroup. lavapipe packs eight neighbours along x into one SIMD register, GPUs take 32 or 64
/// invocations at a time, which lie nearest to each other in a square.
pub const WORKGROUP: [u32; 2] = [8, 8];

/// A scene as the kernel takes it.
#[derive(Debug, PartialEq)]
pub(super) struct CourseScene {
    pub frame: CoursePushConstants,
    pub primitives: PrimitiveRecords,
}

impl CourseScene {
    /// For a picture of `width`×`height` pixels and `max_depth` generations at most.
    ///
    /// # Errors
    /// The kernel cannot take the scene.
    pub fn new(scene: &Scene, max_depth: u32, [width, height]: [u32; 2]) -> Result<Self, TracerError> {
        let [light] = &scene.lights[..] else {
            return Err(TracerError::Refused(format!(
                "the course kernel needs exactly one light, and the scene has {}",
                scene.lights.len()
            )));
        };
        if light.radius != Light::COURSE_RADIUS {
            return Err(TracerError::Refused(format!(
                "the course kernel's light has a radius of {}, and the scene's of {}",
                Light::COURSE_RADIUS,
                light.radius
            )));
        }
        if scene.primitives.len() > MAX_PRIMITIVES {
            return Err(TracerError::Refused(format!(
                "the course kernel takes at most {MAX_PRIMITIVES} primitives, and the scene has {}",
                scene.primitives.len()
            )));
        }
        let primitives = PrimitiveRecords::of(scene);
        Ok(Self {
            frame: CoursePushConstants::new(scene, light, primitives.counts(), max_depth, width, height),
            primitives,
        })
    }
}

/// The pipeline with a scene's primitives on the device.
pub(super) struct CourseKernel {
    pipeline: Arc<ComputePipeline>,
    arrays: [Resource; 4],
    /// What the arrays hold.
    primitives: PrimitiveRecords,
    max_depth: u32,
    workgroup: [u32; 2],
}

impl CourseKernel {
    /// `max_depth`: the most generations that any frame will ask for.
    pub fn new(
        device: &Arc<Device>,
        shader: &Shader,
        primitives: PrimitiveRecords,
        max_depth: u32,
        workgroup: [u32; 2],
    ) -> Result<Self, GpuError> {
        let description = PipelineDescription {
            shader,
            bindings: &BINDINGS,
            push_constant_bytes: size_of::<CoursePushConstants>() as u32,
            constants: &[max_depth, workgroup[0], workgroup[1]],
        };
        let pipeline = ComputePipeline::new(device, &description)?;
        Ok(Self { pipeline, arrays: upload(device, &primitives)?, primitives, max_depth, workgroup })
    }

    /// Whether its pipeline is the one that these need.
    pub fn fits(&self, max_depth: u32, workgroup: [u32; 2]) -> bool {
        (self.max_depth, self.workgroup) == (max_depth, workgroup)
    }

    /// Its pipeline with other primitives.
    pub fn with(&self, device: &Arc<Device>, primitives: PrimitiveRecords) -> Result<Self, GpuError> {
        let arrays = upload(device, &primitives)?;
        Ok(Self { pipeline: self.pipeline.clone(), arrays, primitives, ..*self })
    }

    /// The kernel writing into `picture`.
    pub fn bind(&self, picture: &Resource) -> Result<Arc<BindingSet>, GpuError> {
        let resources = [picture.clone()].into_iter().chain(self.arrays.clone()).collect::<Vec<_>>();
        BindingSet::new(&self.pipeline, &resources)
    }

    /// Puts other primitives in the arrays' place, record by record where they differ; returns the bytes written.
    pub fn update(&mut self, recorder: &mut Recorder, primitives: &PrimitiveRecords) -> u64 {
        let (old, new) = (self.primitives.arrays(), primitives.arrays());
        let mut written = 0;
        for ((array, old), (new, record_bytes)) in self.arrays.iter().zip(old.map(|(old, _)| old)).zip(new) {
            let differing: Vec<_> = differing_records(old, new, record_bytes).collect();
            if differing.is_empty() {
                continue;
            }
            written += (differing.len() * record_bytes) as u64;
            recorder.make_ready(array, Use::CopyTarget);
            recorder.update(array, differing);
            recorder.make_ready(array, Use::ShaderRead);
        }
        self.primitives = primitives.clone();
        written
    }

    /// Traces these parts of the picture.
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, frame: &CoursePushConstants, parts: &[Part]) {
        let parts: Vec<_> = parts.iter().map(|part| Dispatch::flat(&self.pipeline, part.first, part.groups)).collect();
        recorder.dispatch_parts(set, bytemuck::bytes_of(frame), &parts);
    }

    /// The workgroups that cover so many pixels.
    pub fn groups(&self, [width, height]: [u32; 2]) -> [u32; 2] {
        [width.div_ceil(self.workgroup[0]), height.div_ceil(self.workgroup[1])]
    }
}

/// The records of `new` that are not in their places in `old`, with their offsets in bytes.
fn differing_records<'a>(old: &'a [u8], new: &'a [u8], record_bytes: usize) -> impl Iterator<Item = (u64, &'a [u8])> {
    let records = new.chunks_exact(record_bytes).enumerate().map(move |(index, record)| (index * record_bytes, record));
    let differing = records.filter(move |&(offset, record)| old.get(offset..offset + record_bytes) != Some(record));
    differing.map(|(offset, record)| (offset as u64, record))
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

#[cfg(test)]
mod tests {
    use super::differing_records;

    #[test]
    fn only_records_that_differ_are_written() {
        let at = |old: &[u8], new: &[u8]| {
            differing_records(old, new, 2).map(|(offset, record)| (offset, record.to_vec())).collect::<Vec<_>>()
        };
        assert_eq!(at(&[1, 2, 3, 4], &[1, 2, 3, 4]), []);
        assert_eq!(at(&[1, 2, 3, 4], &[1, 2, 3, 5]), [(2, vec![3, 5])]);
        assert_eq!(at(&[1, 2], &[1, 2, 3, 4]), [(2, vec![3, 4])], "a new one");
        assert_eq!(at(&[1, 2, 3, 4], &[3, 4]), [(0, vec![3, 4])], "one less: the count leaves out the last");
    }
}
