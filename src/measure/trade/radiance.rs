//! All light that there is, by path tracing: the truth for every algorithm.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::algorithm::Algorithm;
use crate::frame::Frame;
use crate::gpu::Device;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::settings::{RenderSettings, Shading};
use crate::tracer::{Progressive, Settings, TracerError, limits_of};

/// Of the truth. Pictures that are measured have seeds from 0 on, so that its noise knows nothing of theirs and every
/// error is told rather too large: its square by that of the truth's own.
const SEED: u32 = 1 << 31;

/// A path-traced picture.
pub struct Radiance {
    /// Means of the pixels' samples, linear.
    pub frame: Frame,
    /// Root of the mean square over the pixels of each one's estimated standard error, linear, of its worst channel.
    pub standard_error: f64,
}

/// Path-traces a scene on a device by so many samples a pixel, in the precision that the plan chooses for it. `progress`
/// hears of how many there are.
///
/// # Errors
/// The device cannot draw the scene, fails, `progress` stopped it, or the samples are too few to tell their own error:
/// 64 are enough.
pub fn radiance(
    device: &Arc<Device>,
    scene: &Scene,
    shading: Shading,
    size: [u32; 2],
    samples: u32,
    progress: &mut dyn FnMut(u32) -> ControlFlow<()>,
) -> Result<Radiance, TracerError> {
    let settings = RenderSettings { algorithm: Algorithm::Path, seed: SEED, shading, ..RenderSettings::DEFAULT };
    let plan = Plan::for_scene(scene, &settings, size, &limits_of(device.description()));
    let plan = plan.map_err(|error| TracerError::Refused(error.to_string()))?;
    let mut picture = Progressive::new(device, scene, &Settings::planned(&plan))?;
    while picture.samples() < samples {
        let so_far = picture.samples();
        picture.add_run(samples - so_far, &mut |_| progress(so_far))?;
    }
    let error = picture.error();
    let error = error.ok_or_else(|| TracerError::Refused(format!("{samples} samples are too few for a truth")))?;
    Ok(Radiance { frame: picture.frame()?, standard_error: error.rms })
}
