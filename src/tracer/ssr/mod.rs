//! Screen-space reflections, `glsl/ssr/`: the accurate kernel's first generation, whose mirrored rays then find no more
//! than the camera sees (docs/screen-space.md).

mod passes;
mod surfaces;

use std::sync::Arc;

use super::pixels::check_picture;
use super::renderer::{Algorithm, MadeFor, Sample, State, TakenUp, TargetKind};
use super::tiles::Tile;
use super::whitted::{WhittedRenderer, WhittedState};
use super::{Kernel, Settings, TracerError};
use crate::gpu::{BindingSet, Builds, Device, GpuError, Recorder, Resource, Shader, Use, shaders};
use crate::scene::Scene;
use passes::{DepthPyramid, Reflections, Variant};
use surfaces::Surfaces;

/// The kernels with the scene that they took up last.
pub(super) struct SsrRenderer {
    light: WhittedRenderer,
    pyramid: Option<DepthPyramid>,
    on_device: Option<OnDevice>,
    device: Arc<Device>,
    builds: Builds,
}

/// What a state takes on the device besides the scene's arrays.
struct OnDevice {
    surfaces: Surfaces,
    light_set: Arc<BindingSet>,
    pyramid_set: Arc<BindingSet>,
    reflections: Reflections,
}

/// A scene for a whole picture.
#[derive(PartialEq)]
pub(super) struct SsrState {
    /// Its first generation.
    light: WhittedState,
    size: [u32; 2],
    generations: u32,
    shows_reasons: bool,
}

impl SsrState {
    /// Whether a ray goes on from any surface.
    fn has_reflections(&self) -> bool {
        self.light.has_mirrors() && self.generations > 1
    }

    fn variant(&self) -> Variant {
        Variant::of(self.light.features(), self.has_reflections(), self.shows_reasons)
    }
}

impl State for SsrState {
    fn samples(&self) -> u32 {
        1
    }

    fn background(&self) -> [f32; 3] {
        self.light.background()
    }
}

impl SsrRenderer {
    pub fn new(device: &Arc<Device>, builds: &Builds, made_for: MadeFor) -> Self {
        let light = WhittedRenderer::new(device, Kernel::Ssr, builds, made_for);
        Self { light, pyramid: None, on_device: None, device: device.clone(), builds: builds.clone() }
    }

    /// The light pass drawing into the surfaces; `None` before the first state.
    fn bind_light(&self, surfaces: &Surfaces) -> Result<Option<Arc<BindingSet>>, GpuError> {
        self.light.bind_with(&surfaces.radiances, &surfaces.geometry())
    }

    /// By another pipeline of the light pass.
    fn bind_light_again(&mut self) -> Result<(), GpuError> {
        let Some(last) = &self.on_device else { return Ok(()) };
        let light_set = self.bind_light(&last.surfaces)?;
        if let Some((last, light_set)) = self.on_device.as_mut().zip(light_set) {
            last.light_set = light_set;
        }
        Ok(())
    }
}

impl Algorithm for SsrRenderer {
    type State = SsrState;

    fn kernel(&self) -> Kernel {
        Kernel::Ssr
    }

    fn shaders(&self) -> Vec<&'static Shader> {
        [self.light.shaders(), vec![&shaders::SSR_DEPTHS, &shaders::SSR_REFLECT]].concat()
    }

    fn rebuild(&mut self, builds: &Builds) -> Result<(), GpuError> {
        if let Some(last) = &mut self.on_device {
            let pyramid = DepthPyramid::new(&self.device, builds)?;
            let pyramid_set = pyramid.bind(&last.surfaces)?;
            let reflections = Reflections::new(&self.device, builds, last.reflections.variant)?;
            self.light.rebuild(builds)?;
            (last.pyramid_set, last.reflections, self.pyramid) = (pyramid_set, reflections, Some(pyramid));
        } else {
            self.light.rebuild(builds)?;
        }
        self.builds = builds.clone();
        self.bind_light_again()
    }

    fn target(&self) -> TargetKind {
        TargetKind::Pixels
    }

    fn prepare(&self, scene: &Scene, settings: &Settings) -> Result<SsrState, TracerError> {
        settings.sampling().check_plain().map_err(TracerError::Refused)?;
        let size = [settings.width, settings.height];
        // The pyramid takes less.
        check_picture(self.device.description(), size, "the ssr algorithm draws it whole")?;
        let first_generation = Settings { max_depth: Some(1), ..settings.clone() };
        Ok(SsrState {
            light: self.light.prepare(scene, &first_generation)?,
            size,
            generations: settings.generations(scene),
            shows_reasons: settings.shows_reasons,
        })
    }

    fn compile(&self, state: &SsrState) -> Result<(), GpuError> {
        self.light.compile(&state.light)?;
        DepthPyramid::new(&self.device, &self.builds)?;
        Reflections::new(&self.device, &self.builds, state.variant()).map(drop)
    }

    fn take_up(&mut self, recorder: &mut Recorder, state: &SsrState) -> Result<TakenUp, GpuError> {
        let mut taken_up = self.light.take_up(recorder, &state.light)?;
        let pyramid = match &self.pyramid {
            Some(pyramid) => pyramid,
            None => self.pyramid.insert(DepthPyramid::new(&self.device, &self.builds)?),
        };
        let (last_surfaces, last_reflections) = match self.on_device.take() {
            Some(OnDevice { surfaces, reflections, .. }) => (Some(surfaces), Some(reflections)),
            None => (None, None),
        };
        let surfaces = match last_surfaces {
            Some(last) if last.size == state.size => last,
            other => {
                taken_up.dropped.extend(other.into_iter().flat_map(|last| last.resources()));
                taken_up.needs_binding = true;
                Surfaces::new(&self.device, state.size)?
            }
        };
        let pyramid_set = pyramid.bind(&surfaces)?;
        let reflections = match last_reflections.filter(|last| last.variant == state.variant()) {
            Some(last) => last,
            None => {
                taken_up.needs_binding = true;
                Reflections::new(&self.device, &self.builds, state.variant())?
            }
        };
        let light_set = self.bind_light(&surfaces)?;
        self.on_device = light_set.map(|light_set| OnDevice { surfaces, light_set, pyramid_set, reflections });
        Ok(taken_up)
    }

    /// The pass that draws the picture; the others draw into what it reads.
    fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError> {
        let Some(OnDevice { surfaces, reflections, .. }) = &self.on_device else { return Ok(None) };
        reflections.bind(picture, self.light.arrays(), surfaces).map(Some)
    }

    /// All of the picture at once, whatever the parts.
    fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, state: &SsrState, sample: Sample) {
        let (Some(last), Some(pyramid)) = (&self.on_device, &self.pyramid) else { return };
        let OnDevice { surfaces, light_set, pyramid_set, reflections } = last;
        let tile = Tile::whole(state.size);
        let all = surfaces.resources();
        all.iter().for_each(|surface| recorder.make_ready(surface, Use::ShaderWrite));
        self.light.record(recorder, light_set, &state.light, Sample { tile, parts: &[tile], ..sample });
        if state.has_reflections() {
            pyramid.record(recorder, pyramid_set, surfaces);
        }
        all.iter().for_each(|surface| recorder.make_ready(surface, Use::ShaderRead));
        reflections.record(recorder, set, state.light.push_constants(), state.generations, tile);
    }

    fn trace_one_by_one(&mut self) -> Result<bool, GpuError> {
        let is_other = self.light.trace_one_by_one()?;
        if is_other {
            self.bind_light_again()?;
        }
        Ok(is_other)
    }
}
