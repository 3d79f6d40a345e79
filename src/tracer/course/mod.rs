//! The course's kernel, `glsl/course.comp`: its pipeline and the scene it draws.

mod records;

use std::sync::Arc;

use bytemuck::NoUninit;

use super::parts::Part;
use super::renderer::{Algorithm, MadeFor, Sample, State, TakenUp, TargetKind};
use super::{Kernel, Settings, TracerError};
use crate::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Builds, ComputePipeline, Device, Dispatch, GpuError,
    PipelineDescription, Recorder, Resource, Shader, Use, shaders,
};
use crate::plan::{LightFeatures, Media};
use crate::scene::{COURSE_PRIMITIVE_LIMIT, DEPTH_LIMIT, Light, Primitive, Scene};

pub use records::{
    BoxRecord, ConeRecord, CoursePushConstants, CylinderRecord, LightRecord, MaterialRecord, PrimitiveRecords,
    SphereRecord,
};

/// `MAX_PRIMITIVES` of `glsl/course/interface.glsl`: the course work's limit, over all kinds together.
pub const MAX_PRIMITIVES: usize = COURSE_PRIMITIVE_LIMIT;

/// Bindings of `glsl/course/bindings.glsl`: the picture, then spheres, boxes, cylinders and cones.
pub const BINDINGS: [BindingKind; 5] =
    [BindingKind::Picture, BindingKind::Uniform, BindingKind::Uniform, BindingKind::Uniform, BindingKind::Uniform];

/// A scene as the kernel takes it.
#[derive(Debug, PartialEq)]
pub(super) struct CourseScene {
    /// Record of the whole picture.
    frame: CoursePushConstants,
    primitives: PrimitiveRecords,
    workgroup: [u32; 2],
}

impl CourseScene {
    /// # Errors
    /// The kernel cannot take the scene, or not with these settings.
    fn new(scene: &Scene, settings: &Settings) -> Result<Self, TracerError> {
        let &Settings { width, height, workgroup, .. } = settings;
        settings.sampling().check_plain().map_err(TracerError::Refused)?;
        let refused = |reason| TracerError::Refused(format!("the course kernel {reason}"));
        let light = drawable(scene).map_err(refused)?;
        let primitives = PrimitiveRecords::of(scene);
        let generations = settings.generations(scene);
        let frame = CoursePushConstants::new(scene, light, primitives.counts(), generations, width, height);
        Ok(Self { frame, primitives, workgroup })
    }
}

/// Whether the kernel takes a scene; the reason is about the kernel, and a part of a line.
pub fn check(scene: &Scene) -> Result<(), String> {
    drawable(scene).map(drop)
}

/// The light of a scene that the kernel takes.
fn drawable(scene: &Scene) -> Result<&Light, String> {
    let [light] = &scene.lights[..] else {
        return Err(format!("needs exactly one light, and the scene has {}", scene.lights.len()));
    };
    if light.radius != Light::COURSE_RADIUS {
        return Err(format!("has a light of radius {}, and the scene's is {}", Light::COURSE_RADIUS, light.radius));
    }
    if scene.primitives.len() > MAX_PRIMITIVES {
        return Err(format!("takes at most {MAX_PRIMITIVES} primitives, and the scene has {}", scene.primitives.len()));
    }
    let LightFeatures { attenuation, ambient_light, shininess, media } = LightFeatures::of(scene);
    let is_own = |primitive: &Primitive| primitive.material.reflection() != primitive.material.specular;
    let beyond = match () {
        () if attenuation => "a light's distance_constant",
        () if ambient_light => "ambient_light other than 1",
        () if shininess => "shininess other than 5",
        () if media != Media::None => "transmission",
        () if scene.primitives.iter().any(is_own) => "reflection other than specular",
        () => return Ok(light),
    };
    Err(format!("knows no {beyond}, and the scene has it"))
}

impl State for CourseScene {
    fn samples(&self) -> u32 {
        1
    }

    fn background(&self) -> [f32; 3] {
        self.frame.background
    }
}

/// The kernel on a device.
pub(super) struct CourseRenderer {
    device: Arc<Device>,
    builds: Builds,
    made_for: MadeFor,
    /// From the first scene on.
    on_device: Option<OnDevice>,
}

/// The pipeline with a scene's primitives.
struct OnDevice {
    pipeline: Arc<ComputePipeline>,
    arrays: [Resource; 4],
    /// What the arrays hold.
    primitives: PrimitiveRecords,
    /// The most generations that a picture may ask of the pipeline.
    max_depth: u32,
    workgroup: [u32; 2],
}

impl CourseRenderer {
    /// Generations that the kernel is compiled for.
    fn max_depth(&self, state: &CourseScene) -> u32 {
        match self.made_for {
            MadeFor::Headless => state.frame.depth as u32,
            MadeFor::Live => DEPTH_LIMIT,
        }
    }

    pub fn new(device: &Arc<Device>, builds: &Builds, made_for: MadeFor) -> Self {
        Self { device: device.clone(), builds: builds.clone(), made_for, on_device: None }
    }
}

impl Algorithm for CourseRenderer {
    type State = CourseScene;

    fn kernel(&self) -> Kernel {
        Kernel::Course
    }

    fn shaders(&self) -> Vec<&'static Shader> {
        vec![&shaders::COURSE]
    }

    fn rebuild(&mut self, builds: &Builds) -> Result<(), GpuError> {
        if let Some(OnDevice { pipeline, max_depth, workgroup, .. }) = &mut self.on_device {
            *pipeline = made(&self.device, builds, *max_depth, *workgroup)?;
        }
        self.builds = builds.clone();
        Ok(())
    }

    fn target(&self) -> TargetKind {
        TargetKind::Image
    }

    fn prepare(&self, scene: &Scene, settings: &Settings) -> Result<CourseScene, TracerError> {
        CourseScene::new(scene, settings)
    }

    fn compile(&self, state: &CourseScene) -> Result<(), GpuError> {
        made(&self.device, &self.builds, self.max_depth(state), state.workgroup).map(drop)
    }

    fn take_up(&mut self, recorder: &mut Recorder, state: &CourseScene) -> Result<TakenUp, GpuError> {
        let &CourseScene { ref primitives, workgroup, .. } = state;
        let max_depth = self.max_depth(state);
        let Some(on_device) = &mut self.on_device else {
            let pipeline = made(&self.device, &self.builds, max_depth, workgroup)?;
            let (arrays, primitives) = (upload(&self.device, primitives)?, primitives.clone());
            let uploaded = primitives.arrays().iter().map(|(bytes, _)| bytes.len() as u64).sum();
            self.on_device = Some(OnDevice { pipeline, arrays, primitives, max_depth, workgroup });
            return Ok(TakenUp { uploaded, needs_binding: true, dropped: Vec::new() });
        };
        let needs_binding = (on_device.max_depth, on_device.workgroup) != (max_depth, workgroup);
        if needs_binding {
            on_device.pipeline = made(&self.device, &self.builds, max_depth, workgroup)?;
            (on_device.max_depth, on_device.workgroup) = (max_depth, workgroup);
        }
        Ok(TakenUp { uploaded: on_device.update(recorder, primitives), needs_binding, dropped: Vec::new() })
    }

    fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError> {
        let bind = |OnDevice { pipeline, arrays, .. }: &OnDevice| {
            let resources = [picture].into_iter().chain(arrays).cloned().collect::<Vec<_>>();
            BindingSet::new(pipeline, &resources)
        };
        self.on_device.as_ref().map(bind).transpose()
    }

    fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, state: &CourseScene, sample: Sample) {
        let Some(OnDevice { pipeline, workgroup, .. }) = &self.on_device else { return };
        let dispatch = |&part| {
            let Part { first, groups } = Part::of_pixels(part, *workgroup);
            Dispatch::flat(pipeline, first, groups)
        };
        let parts: Vec<_> = sample.parts.iter().map(dispatch).collect();
        let frame = state.frame.at_tile(sample.tile.x, sample.tile.y);
        recorder.dispatch_parts(set, bytemuck::bytes_of(&frame), &parts);
    }
}

/// The pipeline for pictures of at most so many generations.
fn made(
    device: &Arc<Device>,
    builds: &Builds,
    max_depth: u32,
    workgroup: [u32; 2],
) -> Result<Arc<ComputePipeline>, GpuError> {
    let description = PipelineDescription {
        shader: builds.of(&shaders::COURSE),
        bindings: &BINDINGS,
        push_constant_bytes: size_of::<CoursePushConstants>() as u32,
        constants: &[max_depth, workgroup[0], workgroup[1]],
    };
    ComputePipeline::new(device, &description)
}

impl OnDevice {
    /// Puts other primitives in the arrays' place, record by record where they differ; returns the bytes written.
    fn update(&mut self, recorder: &mut Recorder, primitives: &PrimitiveRecords) -> u64 {
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
}

/// The records of `new` that are not at their positions in `old`, with their offsets in bytes.
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
