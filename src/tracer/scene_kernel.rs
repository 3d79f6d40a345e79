use std::sync::Arc;

use super::chunks::Part;
use super::course::{CourseKernel, CourseScene};
use super::records::FrameRecord;
use super::whitted::{Precision, WhittedKernel};
use super::{Kernel, Settings, TracerError};
use crate::gpu::{BindingSet, Device, GpuError, Recorder, Resource, shaders};
use crate::scene::Scene;

/// A kernel with the scene that it draws.
pub(super) enum SceneKernel {
    /// The frame is of the whole picture.
    Course {
        kernel: CourseKernel,
        frame: Box<FrameRecord>,
    },
    Whitted(WhittedKernel),
}

impl SceneKernel {
    /// # Errors
    /// The kernel cannot take the scene on this device.
    pub fn new(device: &Arc<Device>, scene: &Scene, settings: &Settings, max_depth: u32) -> Result<Self, TracerError> {
        let &Settings { width, height, workgroup, .. } = settings;
        Ok(match settings.kernel {
            Kernel::Course => {
                let CourseScene { frame, primitives } = CourseScene::new(scene, max_depth, [width, height])?;
                let kernel = CourseKernel::new(device, &shaders::COURSE, primitives, max_depth, workgroup)?;
                Self::Course { kernel, frame: Box::new(frame) }
            }
            Kernel::Plain => {
                let shader = &shaders::WHITTED_PLAIN;
                Self::Whitted(WhittedKernel::new(
                    device,
                    scene,
                    shader,
                    Precision::F32,
                    max_depth,
                    [width, height],
                    workgroup,
                )?)
            }
            Kernel::Whitted(precision) => {
                let shader = match precision {
                    Precision::F32 => &shaders::WHITTED_F32,
                    Precision::F64 => &shaders::WHITTED_F64,
                };
                Self::Whitted(WhittedKernel::new(
                    device,
                    scene,
                    shader,
                    precision,
                    max_depth,
                    [width, height],
                    workgroup,
                )?)
            }
        })
    }

    /// The kernel writing into `picture`.
    pub fn bind(&self, picture: &Resource) -> Result<Arc<BindingSet>, GpuError> {
        match self {
            Self::Course { kernel, .. } => kernel.bind(picture),
            Self::Whitted(kernel) => kernel.bind(picture),
        }
    }

    /// The workgroups that cover so many pixels.
    pub fn groups(&self, size: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Course { kernel, .. } => kernel.groups(size),
            Self::Whitted(kernel) => kernel.groups(size),
        }
    }

    /// See [`Tracer::draw_remainder`](super::Tracer::draw_remainder).
    pub fn write_remainder(&mut self, remainder: bool) {
        if let Self::Whitted(kernel) = self {
            kernel.write_remainder(remainder);
        }
    }

    /// Whether colours lose anything by rounding to `f32`.
    pub fn has_remainder(&self) -> bool {
        matches!(self, Self::Whitted(_))
    }

    /// Traces a part of the tile whose corner is at these pixels of the picture.
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, [x, y]: [u32; 2], part: Part) {
        match self {
            Self::Course { kernel, frame } => kernel.record(recorder, set, &frame.at_tile(x, y), &[part]),
            Self::Whitted(kernel) => kernel.record(recorder, set, [x, y], part),
        }
    }
}
