//! The accurate kernel, `glsl/whitted.comp`: its pipeline with a scene on the device.

use std::sync::Arc;

use glam::DVec3;

use super::chunks::Part;
use super::whitted_records::{KernelFrame, WhittedFrame, WhittedRecords};
use super::{Kernel, TracerError};
use crate::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, ComputePipeline, Device, DeviceKind, FloatWidth, GpuError,
    PipelineDescription, Recorder, Resource, arithmetic, shaders,
};
use crate::plan::{Cuts, Precision};
use crate::scene::Scene;

impl Precision {
    /// Of a solid, in kernel lengths: the rounding errors of its squares are still normal numbers.
    pub(super) fn smallest_length(self) -> f64 {
        match self {
            Self::F32 => 2f64.powi(-50),
            Self::F64 => 2f64.powi(-480),
        }
    }

    /// A vector and its error as the nearest vector of this precision and what is missing.
    pub(super) fn split(self, (vector, error): (DVec3, DVec3)) -> (DVec3, DVec3) {
        match self {
            Self::F32 => {
                let nearest = vector.as_vec3().as_dvec3();
                (nearest, (vector - nearest) + error)
            }
            Self::F64 => (vector, error),
        }
    }

    /// Of four numbers.
    fn row_bytes(self) -> u64 {
        match self {
            Self::F32 => 16,
            Self::F64 => 32,
        }
    }

    /// Rows as the kernel reads them.
    pub(super) fn bytes(self, rows: &[[f64; 4]]) -> Vec<u8> {
        match self {
            Self::F32 => rows.iter().flatten().flat_map(|&number| (number as f32).to_ne_bytes()).collect(),
            Self::F64 => bytemuck::cast_slice(rows).to_vec(),
        }
    }
}

/// Bindings 1 to 7 of `glsl/whitted/scene.glsl`.
pub const SCENE_BINDINGS: [BindingKind; 7] = [BindingKind::Records; 7];

/// Specialization constants 0 to 4: how products are made exact, and which kinds of solids there are.
///
/// # Errors
/// The device fails when its arithmetic is tried.
pub fn scene_constants(device: &Arc<Device>, precision: Precision, counts: [u32; 4]) -> Result<[u32; 5], GpuError> {
    let width = match precision {
        Precision::F32 => FloatWidth::F32,
        Precision::F64 => FloatWidth::F64,
    };
    let [spheres, boxes, cylinders, cones] = counts.map(|count| u32::from(count > 0));
    Ok([u32::from(arithmetic(device, width)?.fused_fma), spheres, boxes, cylinders, cones])
}

/// Specialization constant 7: the turns of loops that an invocation may take.
fn loop_turns(device: &Device) -> u32 {
    match device.description().kind {
        // Below Mesa's 65535 by more than a last search among all kinds takes to end.
        DeviceKind::Cpu => 60_000,
        DeviceKind::Discrete | DeviceKind::Integrated | DeviceKind::Virtual | DeviceKind::Other => u32::MAX,
    }
}

/// Refuses a precision that the device does not have.
pub fn check_precision(device: &Device, precision: Precision) -> Result<(), TracerError> {
    let description = device.description();
    if precision == Precision::F64 && !description.float64 {
        return Err(TracerError::Refused(format!(
            "device '{}' cannot calculate in f64 (it lacks shaderFloat64); --precision f32 works there",
            description.name
        )));
    }
    Ok(())
}

/// Refuses arrays larger than the device lets a kernel see.
fn check_size(device: &Device, records: &WhittedRecords, precision: Precision) -> Result<(), TracerError> {
    let limit = device.description().max_storage_bytes;
    for (name, rows) in records.buffers() {
        let bytes = rows.len() as u64 * precision.row_bytes();
        if bytes > limit {
            return Err(TracerError::Refused(format!(
                "the scene is too large for device '{}': its {name} take {bytes} B in {}, and a kernel sees {limit} B there",
                device.description().name,
                precision.name()
            )));
        }
    }
    Ok(())
}

/// The storage buffers, in the order of their bindings.
///
/// # Errors
/// An array larger than the device lets a kernel see.
pub fn upload_scene(
    device: &Arc<Device>,
    records: &WhittedRecords,
    precision: Precision,
) -> Result<Vec<Resource>, TracerError> {
    check_size(device, records, precision)?;
    Ok(upload(device, records, precision)?)
}

fn upload(device: &Arc<Device>, records: &WhittedRecords, precision: Precision) -> Result<Vec<Resource>, GpuError> {
    let upload = |(name, rows): (&str, &[[f64; 4]])| {
        let bytes = precision.bytes(rows);
        // An array of none still has to be bound: as one record of zeros, which no count reaches.
        let mut buffer = Buffer::new(device, name, BufferKind::Records, (bytes.len() as u64).max(EMPTY_ARRAY_BYTES))?;
        buffer.write(&bytes)?;
        Ok(Resource::from(&Arc::new(buffer)))
    };
    records.buffers().into_iter().map(upload).collect()
}

/// The largest record: seven rows of four doubles.
const EMPTY_ARRAY_BYTES: u64 = 7 * 32;

/// A scene as the kernel takes it.
#[derive(PartialEq)]
pub(super) struct WhittedScene {
    kernel: Kernel,
    records: WhittedRecords,
    cuts: Cuts,
    /// Of the whole picture.
    pub frame: WhittedFrame,
    /// Linear RGB.
    pub background: [f32; 3],
}

impl WhittedScene {
    /// For a picture of `width`×`height` pixels and `max_depth` generations at most.
    ///
    /// # Errors
    /// The device lacks the kernel's precision, or lets no kernel see so many primitives.
    pub fn new(
        device: &Device,
        scene: &Scene,
        kernel: Kernel,
        cuts: Cuts,
        max_depth: u32,
        [width, height]: [u32; 2],
    ) -> Result<Self, TracerError> {
        let precision = kernel.precision();
        check_precision(device, precision)?;
        let records = WhittedRecords::of(scene, KernelFrame::of(scene), precision, [width, height]);
        check_size(device, &records, precision)?;
        let frame = WhittedFrame {
            counts: records.counts,
            tile_origin: 0,
            image_size: width | height << 16,
            depth: max_depth,
            light_count: records.light_count,
            writes_remainder: 0,
            least_weight: cuts.least_weight,
            least_shadowed: cuts.least_shadowed,
        };
        Ok(Self { kernel, records, cuts, frame, background: scene.background.as_vec3().to_array() })
    }

    pub fn upload(&self, device: &Arc<Device>) -> Result<Vec<Resource>, GpuError> {
        upload(device, &self.records, self.kernel.precision())
    }

    /// Of all arrays.
    pub fn bytes(&self) -> u64 {
        let rows: usize = self.records.buffers().iter().map(|(_, rows)| rows.len()).sum();
        rows as u64 * self.kernel.precision().row_bytes()
    }

    /// Which kinds of solids there are.
    fn kinds(&self) -> [bool; 4] {
        self.records.counts.map(|count| count > 0)
    }
}

/// The kernel, specialised for scenes with the same kinds of solids, and with highlights or without.
pub(super) struct WhittedPipeline {
    pipeline: Arc<ComputePipeline>,
    kinds: [bool; 4],
    kernel: Kernel,
    highlights: bool,
    workgroup: [u32; 2],
}

impl WhittedPipeline {
    pub fn new(device: &Arc<Device>, scene: &WhittedScene, workgroup: [u32; 2]) -> Result<Self, GpuError> {
        let [fma, spheres, boxes, cylinders, cones] =
            scene_constants(device, scene.kernel.precision(), scene.records.counts)?;
        let mut bindings = vec![BindingKind::Picture];
        bindings.extend(SCENE_BINDINGS);
        let description = PipelineDescription {
            shader: match scene.kernel {
                Kernel::Whitted(Precision::F64) => &shaders::WHITTED_F64,
                Kernel::Whitted(Precision::F32) => &shaders::WHITTED_F32,
                Kernel::Plain | Kernel::Course => &shaders::WHITTED_PLAIN,
            },
            bindings: &bindings,
            push_constant_bytes: size_of::<WhittedFrame>() as u32,
            constants: &[
                fma,
                spheres,
                boxes,
                cylinders,
                cones,
                workgroup[0],
                workgroup[1],
                loop_turns(device),
                u32::from(scene.cuts.highlights),
            ],
        };
        let pipeline = ComputePipeline::new(device, &description)?;
        Ok(Self { pipeline, kinds: scene.kinds(), kernel: scene.kernel, highlights: scene.cuts.highlights, workgroup })
    }

    /// Whether it draws that scene too.
    pub fn fits(&self, scene: &WhittedScene, workgroup: [u32; 2]) -> bool {
        let &Self { kinds, kernel, highlights, workgroup: own_workgroup, .. } = self;
        let of_scene = (scene.kinds(), scene.kernel, scene.cuts.highlights, workgroup);
        (kinds, kernel, highlights, own_workgroup) == of_scene
    }

    /// The kernel reading a scene's arrays and writing into `picture`.
    pub fn bind(&self, picture: &Resource, arrays: &[Resource]) -> Result<Arc<BindingSet>, GpuError> {
        let resources: Vec<_> = [picture].into_iter().chain(arrays).cloned().collect();
        BindingSet::new(&self.pipeline, &resources)
    }

    /// Traces these parts of the picture.
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, frame: &WhittedFrame, parts: &[Part]) {
        let parts = parts.iter().map(|part| ([part.first[0], part.first[1], 0], [part.groups[0], part.groups[1], 1]));
        recorder.dispatch_parts(&self.pipeline, set, bytemuck::bytes_of(frame), parts);
    }

    /// The workgroups that cover so many pixels.
    pub fn groups(&self, [width, height]: [u32; 2]) -> [u32; 2] {
        [width.div_ceil(self.workgroup[0]), height.div_ceil(self.workgroup[1])]
    }
}
