//! An algorithm on a device, with the scene that it draws: what the headless [`Tracer`](super::Tracer) and the window's
//! [`Canvas`](super::Canvas) both drive.

use std::sync::Arc;

use super::course::CourseRenderer;
use super::pixels::pixel_buffer;
use super::ssr::SsrRenderer;
use super::tiles::Tile;
use super::whitted::WhittedRenderer;
use super::{Kernel, Settings, TracerError};
use crate::gpu::{BindingSet, Builds, Device, GpuError, Recorder, Resource, Shader, StorageImage};
use crate::scene::Scene;

/// What an algorithm does on a device. Scenes come in states: one is prepared on the host, taken up by a submission,
/// and drawn until the next is taken up.
pub(super) trait Algorithm {
    /// A scene as the kernels take it, for a picture of one size.
    type State: State;

    fn kernel(&self) -> Kernel;

    /// The program's own shaders that are built into it, or that builds took the places of.
    fn shaders(&self) -> Vec<&'static Shader>;

    /// Draws from other builds from now on; binding sets made before are out of date.
    ///
    /// # Errors
    /// The device does not take them; the last builds go on.
    fn rebuild(&mut self, builds: &Builds) -> Result<(), GpuError>;

    /// What pictures are drawn into.
    fn target(&self) -> TargetKind;

    /// # Errors
    /// The algorithm cannot draw the scene so on this device.
    fn prepare(&self, scene: &Scene, settings: &Settings) -> Result<Self::State, TracerError>;

    /// Compiles what draws a state, and keeps nothing of it.
    fn compile(&self, state: &Self::State) -> Result<(), GpuError>;
    /// Brings a state to the device; what is there of the last one and still fits is kept.
    fn take_up(&mut self, recorder: &mut Recorder, state: &Self::State) -> Result<TakenUp, GpuError>;

    /// Draws into `picture`, of its [target's](Algorithm::target) kind; `None` before the first state.
    fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError>;

    /// Traces one sample of each pixel of parts of a tile, both in pixels, the parts from the tile's top left. Where it
    /// is not the first, those before are there.
    fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, state: &Self::State, sample: Sample);

    /// From now on each pixel is traced by itself, not several by an invocation in turn; returns whether that is
    /// another way than before, for which binding sets are out of date.
    fn trace_one_by_one(&mut self) -> Result<bool, GpuError> {
        Ok(false)
    }
}

/// What a driver asks of a state.
pub(super) trait State: PartialEq {
    /// Runs over each pixel, of one sample or, by path tracing, of several.
    fn samples(&self) -> u32;

    /// Samples of each pixel that the kernel counts after these runs.
    fn ended_samples(&self) -> u32 {
        self.samples()
    }

    /// Which samples path tracing takes from now on; nothing to others.
    fn set_run(&mut self, _run: Run) {}

    /// Linear RGB.
    fn background(&self) -> [f32; 3];

    /// Whether colours are known beyond `f32`; then the picture can be what they [lose](State::write_remainder) by it.
    fn has_remainder(&self) -> bool {
        false
    }

    fn write_remainder(&mut self, _is_remainder: bool) {}
}

/// Samples of each pixel that path tracing takes at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Run {
    pub first_sample: u32,
    pub samples: u32,
    /// Of its random numbers.
    pub seed: u32,
}

/// One sample of each pixel of some parts of a tile.
#[derive(Clone, Copy)]
pub(super) struct Sample<'a> {
    pub index: u32,
    pub tile: Tile,
    pub parts: &'a [Tile],
}

/// What it took to take up a state.
#[derive(Default)]
pub(super) struct TakenUp {
    /// Bytes.
    pub uploaded: u64,
    /// Whether binding sets made before are out of date.
    pub needs_binding: bool,
    /// Used no more.
    pub dropped: Vec<Resource>,
}

/// What an algorithm draws a picture into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TargetKind {
    Image,
    /// A buffer of pixels, row by row.
    Pixels,
}

impl TargetKind {
    /// For a picture, or a tile of one, of so many pixels.
    pub fn make(self, device: &Arc<Device>, name: &str, [width, height]: [u32; 2]) -> Result<Resource, GpuError> {
        Ok(match self {
            Self::Image => Resource::from(&Arc::new(StorageImage::new(device, name, width, height)?)),
            Self::Pixels => pixel_buffer(device, name, [width, height])?,
        })
    }
}

/// What pictures an algorithm is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MadeFor {
    /// One picture, waited for: compiled for its scene alone, and traced again where an invocation took too much.
    Headless,
    /// A scene that is edited while it is drawn: compiled for what may come, where that costs little.
    Live,
}

/// An [`Algorithm`] with the state that it draws and the one that is to come.
struct Staged<A: Algorithm> {
    algorithm: A,
    /// Taken up last.
    current: Option<A::State>,
    next: Option<A::State>,
}

/// An algorithm of whichever kind, on a device, with its scene.
pub(super) trait Renderer {
    /// See [`Algorithm::kernel`].
    fn kernel(&self) -> Kernel;
    /// See [`Algorithm::shaders`].
    fn shaders(&self) -> Vec<&'static Shader>;
    /// See [`Algorithm::rebuild`].
    fn rebuild(&mut self, builds: &Builds) -> Result<(), GpuError>;
    /// See [`Algorithm::target`].
    fn target(&self) -> TargetKind;
    /// Prepares a scene, if its picture is another than the one drawn or prepared last; even then, if `again`.
    ///
    /// # Errors
    /// As of [`Algorithm::prepare`]; what was prepared stays.
    fn prepare(&mut self, scene: &Scene, settings: &Settings, again: bool) -> Result<(), TracerError>;
    /// See [`Algorithm::compile`], of the scene prepared; nothing without one.
    fn compile_next(&self) -> Result<(), GpuError>;
    /// Whether a scene is prepared and not yet taken up.
    fn has_next(&self) -> bool;
    /// Takes up the scene prepared, if there is one.
    fn take_up(&mut self, recorder: &mut Recorder) -> Result<Option<TakenUp>, GpuError>;
    /// Forgets which scenes were prepared and drawn.
    fn forget(&mut self);
    /// See [`Algorithm::bind`].
    fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError>;
    /// Samples a pixel of the scene taken up; `None` without one.
    fn samples(&self) -> Option<u32>;
    /// Background of the scene prepared last, linear RGB; `None` without one.
    fn background(&self) -> Option<[f32; 3]>;
    /// See [`Algorithm::record`]; nothing without a scene.
    fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, sample: Sample);
    /// See [`Algorithm::trace_one_by_one`].
    fn trace_one_by_one(&mut self) -> Result<bool, GpuError>;
    /// See [`State::ended_samples`]; `None` without a scene.
    fn ended_samples(&self) -> Option<u32>;
    /// See [`State::set_run`], of the scene taken up.
    fn set_run(&mut self, run: Run);
    /// See [`State::has_remainder`].
    fn has_remainder(&self) -> bool;
    /// See [`State::write_remainder`], of the scene taken up.
    fn write_remainder(&mut self, is_remainder: bool);
}

/// The renderer of a kernel, made from these builds.
pub(super) fn renderer(
    device: &Arc<Device>,
    kernel: Kernel,
    builds: &Builds,
    made_for: MadeFor,
) -> Result<Box<dyn Renderer>, GpuError> {
    fn staged<A: Algorithm + 'static>(algorithm: A) -> Box<dyn Renderer> {
        Box::new(Staged { algorithm, current: None, next: None })
    }
    Ok(match kernel {
        Kernel::Course => staged(CourseRenderer::new(device, builds, made_for)),
        Kernel::Ssr => staged(SsrRenderer::new(device, builds, made_for)),
        Kernel::Plain | Kernel::Whitted(_) | Kernel::Path(_) => {
            staged(WhittedRenderer::new(device, kernel, builds, made_for))
        }
    })
}

impl<A: Algorithm> Renderer for Staged<A> {
    fn kernel(&self) -> Kernel {
        self.algorithm.kernel()
    }

    fn shaders(&self) -> Vec<&'static Shader> {
        self.algorithm.shaders()
    }

    fn rebuild(&mut self, builds: &Builds) -> Result<(), GpuError> {
        self.algorithm.rebuild(builds)
    }

    fn target(&self) -> TargetKind {
        self.algorithm.target()
    }

    fn prepare(&mut self, scene: &Scene, settings: &Settings, again: bool) -> Result<(), TracerError> {
        let wanted = self.algorithm.prepare(scene, settings)?;
        if again || self.next.as_ref().or(self.current.as_ref()) != Some(&wanted) {
            self.next = Some(wanted);
        }
        Ok(())
    }

    fn compile_next(&self) -> Result<(), GpuError> {
        self.next.as_ref().map_or(Ok(()), |next| self.algorithm.compile(next))
    }

    fn has_next(&self) -> bool {
        self.next.is_some()
    }

    fn take_up(&mut self, recorder: &mut Recorder) -> Result<Option<TakenUp>, GpuError> {
        let Some(state) = self.next.take() else { return Ok(None) };
        let taken_up = self.algorithm.take_up(recorder, &state)?;
        self.current = Some(state);
        Ok(Some(taken_up))
    }

    fn forget(&mut self) {
        (self.current, self.next) = (None, None);
    }

    fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError> {
        self.algorithm.bind(picture)
    }

    fn samples(&self) -> Option<u32> {
        self.current.as_ref().map(State::samples)
    }

    fn background(&self) -> Option<[f32; 3]> {
        self.next.as_ref().or(self.current.as_ref()).map(State::background)
    }

    fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, sample: Sample) {
        if let Some(state) = &self.current {
            self.algorithm.record(recorder, set, state, sample);
        }
    }

    fn trace_one_by_one(&mut self) -> Result<bool, GpuError> {
        self.algorithm.trace_one_by_one()
    }

    fn ended_samples(&self) -> Option<u32> {
        self.current.as_ref().map(State::ended_samples)
    }

    fn set_run(&mut self, run: Run) {
        if let Some(state) = &mut self.current {
            state.set_run(run);
        }
    }

    fn has_remainder(&self) -> bool {
        self.current.as_ref().is_some_and(State::has_remainder)
    }

    fn write_remainder(&mut self, is_remainder: bool) {
        if let Some(state) = &mut self.current {
            state.write_remainder(is_remainder);
        }
    }
}
