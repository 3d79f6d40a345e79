//! A kernel whose scene changes.

use std::sync::Arc;

use super::course::{CourseKernel, CourseScene, WORKGROUP};
use super::live_whitted::{Begun, LiveWhitted, WhittedState};
use super::parts::Part;
use super::records::PrimitiveRecords;
use super::{Kernel, Settings, TracerError};
use crate::gpu::{BindingSet, Builds, Device, GpuError, Recorder, Resource, Shader, shaders};
use crate::plan::{MOST_PIXELS, Precision};
use crate::scene::{DEPTH_LIMIT, Scene};
use crate::settings::sampling::Sampling;

/// What a picture is traced by, pixels along x and y: workgroups below each other, as many as an invocation has pixels
/// at most.
pub(super) const BLOCK: [u32; 2] = [WORKGROUP[0], MOST_PIXELS * WORKGROUP[1]];

pub(super) enum LiveKernel {
    Course(CourseKernel),
    Whitted(LiveWhitted),
}

/// A state of the scene as a kernel takes it.
#[derive(PartialEq)]
pub(super) enum State {
    Course(Box<CourseScene>),
    Whitted(Box<WhittedState>),
}

impl LiveKernel {
    pub fn new(device: &Arc<Device>, kernel: Kernel, builds: &Builds) -> Result<Self, GpuError> {
        Ok(match kernel {
            Kernel::Course => {
                let none = PrimitiveRecords::default();
                let shader = builds.of(&shaders::COURSE);
                Self::Course(CourseKernel::new(device, shader, none, DEPTH_LIMIT, WORKGROUP)?)
            }
            Kernel::Plain | Kernel::Whitted(Precision::F32 | Precision::F64) => {
                Self::Whitted(LiveWhitted::new(device, kernel, builds))
            }
        })
    }

    /// The program's own that is built into it, or that a build took the place of.
    pub fn shader(&self) -> &'static Shader {
        match self {
            Self::Course(_) => &shaders::COURSE,
            Self::Whitted(live) => live.shader(),
        }
    }

    /// From other builds from now on; binding sets made before are out of date.
    ///
    /// # Errors
    /// The device does not take them; it stays as it is.
    pub fn rebuild(&mut self, device: &Arc<Device>, builds: &Builds) -> Result<(), GpuError> {
        match self {
            Self::Course(_) => *self = Self::new(device, Kernel::Course, builds)?,
            Self::Whitted(live) => live.rebuild(builds)?,
        }
        Ok(())
    }

    /// The blocks that cover so many pixels.
    pub fn blocks(size: [u32; 2]) -> [u32; 2] {
        [size[0].div_ceil(BLOCK[0]), size[1].div_ceil(BLOCK[1])]
    }

    /// Whether it draws into a buffer of pixels, and not into an image.
    pub fn draws_pixels(&self) -> bool {
        matches!(self, Self::Whitted(_))
    }

    /// # Errors
    /// The kernel cannot take the scene on this device.
    pub fn prepare(
        &self,
        scene: &Scene,
        settings: &Settings,
        sampling: Sampling,
        size: [u32; 2],
    ) -> Result<State, TracerError> {
        Ok(match self {
            Self::Course(_) => {
                sampling.check_plain().map_err(TracerError::Refused)?;
                let max_depth = settings.max_depth.unwrap_or(scene.max_depth);
                State::Course(Box::new(CourseScene::new(scene, max_depth, size)?))
            }
            Self::Whitted(live) => State::Whitted(Box::new(live.prepare(scene, settings, sampling, size)?)),
        })
    }

    /// Takes up a state that this kernel [prepared](LiveKernel::prepare).
    pub fn begin(&mut self, recorder: &mut Recorder, state: &State) -> Result<Begun, GpuError> {
        match (self, state) {
            (Self::Course(kernel), State::Course(scene)) => {
                Ok(Begun { uploaded: kernel.update(recorder, &scene.primitives), ..Begun::default() })
            }
            (Self::Whitted(live), State::Whitted(state)) => live.begin(recorder, state),
            (Self::Course(_), State::Whitted(_)) | (Self::Whitted(_), State::Course(_)) => Ok(Begun::default()),
        }
    }

    /// The kernel writing into `picture`, [of its sort](LiveKernel::draws_pixels); `None` before its first state.
    pub fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError> {
        match self {
            Self::Course(kernel) => kernel.bind(picture).map(Some),
            Self::Whitted(live) => live.bind(picture),
        }
    }

    /// Traces these parts of the picture, in blocks: the sample with this index of each pixel, the ones before being
    /// there.
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, state: &State, sample: u32, parts: &[Part]) {
        match (self, state) {
            (Self::Course(kernel), State::Course(scene)) => {
                kernel.record(recorder, set, &scene.frame, &in_workgroups(parts, 1));
            }
            (Self::Whitted(live), State::Whitted(state)) => {
                if let Some(pipeline) = live.pipeline() {
                    let parts = in_workgroups(parts, pipeline.pixels);
                    pipeline.record(recorder, set, &state.scene.view_uniforms, sample, &parts);
                }
            }
            (Self::Course(_) | Self::Whitted(_), _) => {}
        }
    }
}

/// Blocks in workgroups, of which each invocation has so many pixels.
fn in_workgroups(blocks: &[Part], pixels: u32) -> Vec<Part> {
    let rows = BLOCK[1] / (WORKGROUP[1] * pixels);
    let part = |part: &Part| Part {
        first: [part.first[0], part.first[1] * rows],
        groups: [part.groups[0], part.groups[1] * rows],
    };
    blocks.iter().map(part).collect()
}

impl State {
    /// Of each pixel.
    pub fn samples(&self) -> u32 {
        match self {
            Self::Course(_) => 1,
            Self::Whitted(state) => state.scene.samples,
        }
    }

    /// Linear RGB.
    pub fn background(&self) -> [f32; 3] {
        match self {
            Self::Course(scene) => scene.frame.background,
            Self::Whitted(state) => state.scene.background,
        }
    }
}
