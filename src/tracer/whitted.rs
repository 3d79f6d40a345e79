//! The accurate kernel, `glsl/whitted.comp`: its pipeline with a scene on the device.

use std::sync::Arc;

use glam::DVec3;

use super::TracerError;
use super::chunks::Part;
use super::whitted_records::{KernelFrame, WhittedFrame, WhittedRecords};
use crate::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, ComputePipeline, Device, DeviceKind, FloatWidth, GpuError,
    PipelineDescription, Recorder, Resource, Shader, arithmetic,
};
use crate::scene::Scene;

/// What the kernel calculates in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    #[default]
    F32,
    F64,
}

impl Precision {
    /// Half the distance from 1 to the next number.
    pub fn unit_roundoff(self) -> f64 {
        match self {
            Self::F32 => f64::from(f32::EPSILON) / 2.0,
            Self::F64 => f64::EPSILON / 2.0,
        }
    }

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

    /// Rows as the kernel reads them.
    pub(super) fn bytes(self, rows: &[[f64; 4]]) -> Vec<u8> {
        match self {
            Self::F32 => rows.iter().flatten().flat_map(|&number| (number as f32).to_ne_bytes()).collect(),
            Self::F64 => bytemuck::cast_slice(rows).to_vec(),
        }
    }

    /// The word of the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
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

/// The storage buffers, in the order of their bindings.
///
/// # Errors
/// An array larger than the device lets a kernel see.
pub fn upload_scene(
    device: &Arc<Device>,
    records: &WhittedRecords,
    precision: Precision,
) -> Result<Vec<Resource>, TracerError> {
    let upload = |(name, rows): (&str, &[[f64; 4]])| {
        let bytes = precision.bytes(rows);
        let limit = device.description().max_storage_bytes;
        if bytes.len() as u64 > limit {
            return Err(TracerError::Refused(format!(
                "the scene is too large for device '{}': its {name} take {} B in {}, and a kernel sees {limit} B there",
                device.description().name,
                bytes.len(),
                precision.name()
            )));
        }
        // An array of none still has to be bound: as one record of zeros, which no count reaches.
        let mut buffer = Buffer::new(device, name, BufferKind::Records, (bytes.len() as u64).max(EMPTY_ARRAY_BYTES))?;
        buffer.write(&bytes)?;
        Ok(Resource::from(&Arc::new(buffer)))
    };
    records.buffers().into_iter().map(upload).collect()
}

/// The largest record: seven rows of four doubles.
const EMPTY_ARRAY_BYTES: u64 = 7 * 32;

/// The pipeline with a scene on the device.
pub(super) struct WhittedKernel {
    pipeline: Arc<ComputePipeline>,
    scene: Vec<Resource>,
    /// Of the whole picture.
    frame: WhittedFrame,
    workgroup: [u32; 2],
}

impl WhittedKernel {
    /// `shader`: a build of `glsl/whitted.comp` for `precision`.
    ///
    /// # Errors
    /// The device lacks the precision, or has no room for the scene.
    pub fn new(
        device: &Arc<Device>,
        scene: &Scene,
        shader: &Shader,
        precision: Precision,
        max_depth: u32,
        [width, height]: [u32; 2],
        workgroup: [u32; 2],
    ) -> Result<Self, TracerError> {
        check_precision(device, precision)?;
        let records = WhittedRecords::of(scene, KernelFrame::of(scene), precision, [width, height]);
        let [fma, spheres, boxes, cylinders, cones] = scene_constants(device, precision, records.counts)?;
        let mut bindings = vec![BindingKind::Picture];
        bindings.extend(SCENE_BINDINGS);
        let description = PipelineDescription {
            shader,
            bindings: &bindings,
            push_constant_bytes: size_of::<WhittedFrame>() as u32,
            constants: &[fma, spheres, boxes, cylinders, cones, workgroup[0], workgroup[1], loop_turns(device)],
        };
        Ok(Self {
            scene: upload_scene(device, &records, precision)?,
            pipeline: ComputePipeline::new(device, &description)?,
            frame: WhittedFrame {
                counts: records.counts,
                tile_origin: 0,
                image_size: width | height << 16,
                depth: max_depth,
                light_count: records.light_count,
                writes_remainder: 0,
            },
            workgroup,
        })
    }

    /// The kernel writing into `picture`.
    pub fn bind(&self, picture: &Resource) -> Result<Arc<BindingSet>, GpuError> {
        let resources: Vec<_> = [picture].into_iter().chain(&self.scene).cloned().collect();
        BindingSet::new(&self.pipeline, &resources)
    }

    /// Writes what colours lose by rounding to `f32` from now on, or the colours again.
    pub fn write_remainder(&mut self, remainder: bool) {
        self.frame.writes_remainder = u32::from(remainder);
    }

    /// Traces a part of the tile at (x, y).
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, [x, y]: [u32; 2], part: Part) {
        let frame = WhittedFrame { tile_origin: x | y << 16, ..self.frame };
        let part = ([part.first[0], part.first[1], 0], [part.groups[0], part.groups[1], 1]);
        recorder.dispatch_parts(&self.pipeline, set, bytemuck::bytes_of(&frame), [part]);
    }

    /// The workgroups that cover so many pixels.
    pub fn groups(&self, [width, height]: [u32; 2]) -> [u32; 2] {
        [width.div_ceil(self.workgroup[0]), height.div_ceil(self.workgroup[1])]
    }
}
