//! What the kernels make of a scene: a picture, and where each is off the reference.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::trade::Truth;
use super::{ComparisonError, ErrorDomain, ImageError, TimedTracer, error_map, image_error};
use crate::algorithm::Algorithm;
use crate::frame::{Frame, FrameError};
use crate::gpu::Device;
use crate::plan::{Plan, PlanError, Precision};
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::tracer::{Settings, TracerError, limits_of};

/// A scene by several kernels.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneMaps {
    /// By the accurate kernel in `f32`.
    pub picture: Frame,
    /// One a kernel; the first is that of `picture`.
    pub maps: Vec<KernelMap>,
}

/// A kernel, exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct KernelMap {
    /// What the kernel was asked for.
    pub setting: RenderSettings,
    /// Or why it does not draw this scene on this device.
    pub drawn: Result<Drawn, String>,
}

/// How far a picture is from the reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// Error of each pixel as a colour, dark where it is small.
    pub map: Frame,
    /// Error of linear values, as `zerkalo compare` reports it.
    pub error: ImageError,
}

/// Why there is none.
#[derive(Debug, thiserror::Error)]
pub enum SceneMapsError {
    /// A kernel could not draw.
    #[error(transparent)]
    Tracer(#[from] TracerError),
    /// There is no plan of the scene.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A frame of a size that cannot be, or no memory for it.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// The pictures cannot be compared.
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
}

/// The kernels whose errors are drawn; the first also makes the picture.
fn settings() -> [RenderSettings; 4] {
    let whitted = |precision| RenderSettings { precision: Some(precision), ..RenderSettings::default() };
    let f32 = RenderSettings { precision: Some(Precision::F32), ..RenderSettings::default() };
    [
        whitted(Precision::F32),
        whitted(Precision::F64),
        RenderSettings { algorithm: Algorithm::Plain, ..f32 },
        RenderSettings { algorithm: Algorithm::Course, precision: None, ..f32 },
    ]
}

/// `keep_going` can stop the work after a tile.
///
/// # Errors
/// The accurate kernel cannot draw the scene on this device, the device fails, or `keep_going` breaks.
pub fn scene_maps(
    device: &Arc<Device>,
    scene: &Scene,
    truth: &Truth,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<SceneMaps, SceneMapsError> {
    let (width, height) = (truth.frame.width(), truth.frame.height());
    let limits = limits_of(device.description());
    let mut draw = |setting: &RenderSettings| -> Result<Frame, SceneMapsError> {
        let plan = Plan::for_scene(scene, setting, [width, height], &limits)?;
        let mut tracer = TimedTracer::new(device, scene, &Settings::planned(&plan))?;
        tracer.draw(keep_going)?;
        Ok(tracer.frame)
    };
    let drawn = |frame: &Frame| -> Result<Drawn, SceneMapsError> {
        let error = image_error(&truth.frame, frame, ErrorDomain::Linear, None)?;
        Ok(Drawn { map: error_map(&truth.frame, frame)?, error })
    };
    let [accurate, others @ ..] = settings();
    let picture = draw(&accurate)?;
    let mut maps = vec![KernelMap { setting: accurate, drawn: Ok(drawn(&picture)?) }];
    for setting in others {
        let drawn = match draw(&setting) {
            Ok(frame) => Ok(drawn(&frame)?),
            // What this kernel alone cannot do.
            Err(SceneMapsError::Plan(error)) => Err(error.to_string()),
            Err(SceneMapsError::Tracer(error @ (TracerError::Refused(_) | TracerError::LoopLimitReached { .. }))) => {
                Err(error.to_string())
            }
            Err(error) => return Err(error),
        };
        maps.push(KernelMap { setting, drawn });
    }
    Ok(SceneMaps { picture, maps })
}
