//! A kernel whose scene changes.

use std::sync::Arc;

use super::chunks::Part;
use super::course::{CourseKernel, CourseScene, WORKGROUP};
use super::records::PrimitiveRecords;
use super::whitted::{WhittedPipeline, WhittedScene};
use super::{Kernel, TracerError};
use crate::gpu::{BindingSet, Device, GpuError, Recorder, Resource, Shader};
use crate::plan::{Cuts, Precision};
use crate::scene::{DEPTH_LIMIT, Scene};

pub(super) enum LiveKernel {
    Course(CourseKernel),
    Whitted(LiveWhitted),
}

/// The accurate kernel or the plain one. A state's arrays are made anew: the camera is their origin, so that nearly
/// every change is a change of them all.
pub(super) struct LiveWhitted {
    kernel: Kernel,
    device: Arc<Device>,
    /// With the arrays, since the first state was begun.
    begun: Option<(WhittedPipeline, Vec<Resource>)>,
}

/// A state of the scene as a kernel takes it.
#[derive(PartialEq)]
pub(super) enum State {
    Course(Box<CourseScene>),
    Whitted(Box<WhittedScene>),
}

/// What it took to begin a picture of another state.
#[derive(Default)]
pub(super) struct Begun {
    /// Bytes.
    pub uploaded: u64,
    /// Whether binding sets made before are out of date.
    pub needs_binding: bool,
    /// Used no more.
    pub dropped: Vec<Resource>,
}

impl LiveKernel {
    /// `course`: a build of `glsl/course.comp`, for the course kernel.
    pub fn new(device: &Arc<Device>, kernel: Kernel, course: &Shader) -> Result<Self, GpuError> {
        Ok(match kernel {
            Kernel::Course => {
                let none = PrimitiveRecords::default();
                Self::Course(CourseKernel::new(device, course, none, DEPTH_LIMIT, WORKGROUP)?)
            }
            Kernel::Plain | Kernel::Whitted(Precision::F32 | Precision::F64) => {
                Self::Whitted(LiveWhitted { kernel, device: device.clone(), begun: None })
            }
        })
    }

    /// The workgroups that cover so many pixels.
    pub fn groups(size: [u32; 2]) -> [u32; 2] {
        [size[0].div_ceil(WORKGROUP[0]), size[1].div_ceil(WORKGROUP[1])]
    }

    /// # Errors
    /// The kernel cannot take the scene on this device.
    pub fn prepare(&self, scene: &Scene, size: [u32; 2]) -> Result<State, TracerError> {
        Ok(match self {
            Self::Course(_) => State::Course(Box::new(CourseScene::new(scene, scene.max_depth, size)?)),
            Self::Whitted(LiveWhitted { kernel, device, .. }) => {
                State::Whitted(Box::new(WhittedScene::new(device, scene, *kernel, Cuts::NONE, scene.max_depth, size)?))
            }
        })
    }

    /// Takes up a state that this kernel [prepared](LiveKernel::prepare).
    pub fn begin(&mut self, recorder: &mut Recorder, state: &State) -> Result<Begun, GpuError> {
        match (self, state) {
            (Self::Course(kernel), State::Course(scene)) => {
                Ok(Begun { uploaded: kernel.update(recorder, &scene.primitives), ..Begun::default() })
            }
            (Self::Whitted(live), State::Whitted(scene)) => live.begin(scene),
            (Self::Course(_), State::Whitted(_)) | (Self::Whitted(_), State::Course(_)) => Ok(Begun::default()),
        }
    }

    /// The kernel writing into `picture`; `None` before its first state.
    pub fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError> {
        match self {
            Self::Course(kernel) => kernel.bind(picture).map(Some),
            Self::Whitted(live) => {
                live.begun.as_ref().map(|(pipeline, arrays)| pipeline.bind(picture, arrays)).transpose()
            }
        }
    }

    /// Traces these parts of the picture.
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, state: &State, parts: &[Part]) {
        match (self, state) {
            (Self::Course(kernel), State::Course(scene)) => kernel.record(recorder, set, &scene.frame, parts),
            (Self::Whitted(LiveWhitted { begun: Some((pipeline, _)), .. }), State::Whitted(scene)) => {
                pipeline.record(recorder, set, &scene.frame, parts);
            }
            (Self::Course(_) | Self::Whitted(_), _) => {}
        }
    }
}

impl LiveWhitted {
    fn begin(&mut self, scene: &WhittedScene) -> Result<Begun, GpuError> {
        let arrays = scene.upload(&self.device)?;
        let last = self.begun.take();
        let (pipeline, dropped) = match last {
            Some((pipeline, arrays)) if pipeline.fits(scene, WORKGROUP) => (pipeline, arrays),
            last => {
                let dropped = last.map(|(_, arrays)| arrays).unwrap_or_default();
                (WhittedPipeline::new(&self.device, scene, WORKGROUP)?, dropped)
            }
        };
        self.begun = Some((pipeline, arrays));
        Ok(Begun { uploaded: scene.bytes(), needs_binding: true, dropped })
    }
}

impl State {
    /// Linear RGB.
    pub fn background(&self) -> [f32; 3] {
        match self {
            Self::Course(scene) => scene.frame.background,
            Self::Whitted(scene) => scene.background,
        }
    }
}
