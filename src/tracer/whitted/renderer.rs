//! The accurate kernel or the plain one with a scene that changes: what stays the same is neither made nor uploaded
//! again.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::NoUninit;

use super::super::renderer::{Algorithm, MadeFor, Run, Sample, State, TakenUp, TargetKind};
use super::super::{Kernel, Settings, TracerError};
use super::pipeline::{WhittedPipeline, shader_of};
use super::records::{SolidRecords, WhittedPushConstants, WhittedRecords};
use super::scene::{WhittedScene, check_precision};
use crate::gpu::{BindingSet, Builds, Device, GpuError, Recorder, Resource, Shader, Texel, Use};
use crate::plan::{Features, LightFeatures, MOST_PIXELS, Precision, TraversalCost, WORKGROUP, scene_space_within};
use crate::scene::{Extent, Primitive, Scene};

/// The kernel with the scene that it took up last.
pub struct WhittedRenderer {
    kernel: Kernel,
    device: Arc<Device>,
    builds: Builds,
    made_for: MadeFor,
    on_device: Option<OnDevice>,
}

/// A state whose arrays the device has.
struct OnDevice {
    pipeline: WhittedPipeline,
    arrays: Vec<Resource>,
    /// What the arrays hold.
    records: WhittedRecords,
    primitives: Arc<Primitives>,
}

/// The primitives of a scene with what they alone decide.
struct Primitives {
    list: Vec<Primitive>,
    extent: Extent,
    cost: TraversalCost,
    light: LightFeatures,
    has_mirrors: bool,
}

impl Primitives {
    fn of(primitives: &[Primitive]) -> Self {
        Self {
            list: primitives.to_vec(),
            extent: Extent::of(primitives),
            cost: TraversalCost::of(primitives),
            light: LightFeatures::of_primitives(primitives),
            has_mirrors: primitives.iter().any(|primitive| primitive.material.reflection() > 0.0),
        }
    }
}

/// A state of the scene.
pub struct WhittedState {
    scene: WhittedScene,
    primitives: Arc<Primitives>,
}

impl PartialEq for WhittedState {
    /// Whether their pictures are the same.
    fn eq(&self, other: &Self) -> bool {
        self.scene == other.scene
    }
}

impl State for WhittedState {
    fn samples(&self) -> u32 {
        self.scene.samples
    }

    fn background(&self) -> [f32; 3] {
        self.scene.background
    }

    fn has_remainder(&self) -> bool {
        self.scene.kernel.precision() == Precision::F64
    }

    fn ended_samples(&self) -> u32 {
        if self.scene.kernel.description().is_statistical {
            self.scene.samples * self.scene.view_uniforms.frame.samples_at_once
        } else {
            self.scene.samples
        }
    }

    fn set_run(&mut self, run: Run) {
        let frame = &mut self.scene.view_uniforms.frame;
        (frame.samples_before, frame.samples_at_once, frame.seed) = (run.first_sample, run.samples, run.seed);
    }

    fn write_remainder(&mut self, is_remainder: bool) {
        self.scene.view_uniforms.frame.writes_remainder = u32::from(is_remainder);
    }
}

impl WhittedState {
    /// Whether any surface mirrors.
    pub fn has_mirrors(&self) -> bool {
        self.primitives.has_mirrors
    }

    /// What the kernel is compiled for.
    pub fn features(&self) -> Features {
        self.scene.features
    }

    /// For the whole picture in one tile.
    pub fn push_constants(&self) -> WhittedPushConstants {
        self.scene.view_uniforms.frame
    }
}

impl WhittedRenderer {
    pub fn new(device: &Arc<Device>, kernel: Kernel, builds: &Builds, made_for: MadeFor) -> Self {
        Self { kernel, device: device.clone(), builds: builds.clone(), made_for, on_device: None }
    }

    /// The arrays of the scene taken up last, in the order of their bindings; none before the first.
    pub fn arrays(&self) -> &[Resource] {
        self.on_device.as_ref().map_or(&[], |last| &last.arrays)
    }

    /// Draws into `picture` and, of kernels that bind more, into that; `None` before the first state.
    pub fn bind_with(&self, picture: &Resource, more: &[Resource]) -> Result<Option<Arc<BindingSet>>, GpuError> {
        self.on_device.as_ref().map(|last| last.pipeline.bind(picture, &last.arrays, more)).transpose()
    }

    /// That an invocation traces one after another.
    fn pixels(&self, scene: &Scene, settings: &Settings, cost: &TraversalCost) -> u32 {
        // Its invocations trace several samples of a pixel instead.
        if self.kernel.description().is_statistical {
            return 1;
        }
        // A headless picture is traced again where an invocation took too much; one that a window shows is not.
        // Without boxes, a search among more solids than are looked at is long.
        let unknown = match self.made_for {
            MadeFor::Headless if !settings.without_boxes => MOST_PIXELS,
            MadeFor::Headless | MadeFor::Live => 1,
        };
        let suiting = || cost.pixels_per_invocation(scene.lights.len(), settings.generations(scene), unknown);
        settings.pixels.unwrap_or_else(suiting)
    }

    /// The pipeline for a scene, and whether it is another than the last one.
    fn pipeline_for(
        &self,
        last: Option<WhittedPipeline>,
        scene: &WhittedScene,
    ) -> Result<(WhittedPipeline, bool), GpuError> {
        let Some(last) = last else { return Ok((WhittedPipeline::new(&self.device, &self.builds, scene)?, true)) };
        let is_kept = match self.made_for {
            MadeFor::Headless => last.fits(scene),
            MadeFor::Live => last.serves(scene),
        };
        Ok(if is_kept { (last, false) } else { (last.replaced(&self.device, scene)?, true) })
    }
}

impl Algorithm for WhittedRenderer {
    type State = WhittedState;

    fn kernel(&self) -> Kernel {
        self.kernel
    }

    fn shaders(&self) -> Vec<&'static Shader> {
        vec![shader_of(&self.device, self.kernel, WORKGROUP)]
    }

    fn rebuild(&mut self, builds: &Builds) -> Result<(), GpuError> {
        if let Some(on_device) = &mut self.on_device {
            on_device.pipeline = on_device.pipeline.rebuilt(&self.device, builds)?;
        }
        self.builds = builds.clone();
        Ok(())
    }

    fn target(&self) -> TargetKind {
        TargetKind::Pixels
    }

    fn prepare(&self, scene: &Scene, settings: &Settings) -> Result<WhittedState, TracerError> {
        let precision = self.kernel.precision();
        check_precision(&self.device, precision)?;
        let same = self.on_device.as_ref().filter(|last| last.primitives.list == scene.primitives);
        let primitives =
            same.map_or_else(|| Arc::new(Primitives::of(&scene.primitives)), |last| last.primitives.clone());
        let frame = scene_space_within(scene, &primitives.extent, self.kernel);
        let light = primitives.light.in_scene(scene);
        let last = self.on_device.as_ref().map(|last| &last.records.solids).filter(|solids| solids.frame == frame);
        let solids = match last {
            Some(solids) if same.is_some() => solids.clone(),
            _ => Arc::new(SolidRecords::of(&scene.primitives, light, frame, precision, last.map(Arc::as_ref))),
        };
        let records = WhittedRecords::with(scene, light, solids, precision, [settings.width, settings.height]);
        let pixels = self.pixels(scene, settings, &primitives.cost);
        Ok(WhittedState { scene: WhittedScene::new(&self.device, scene, records, settings, pixels)?, primitives })
    }

    fn compile(&self, state: &WhittedState) -> Result<(), GpuError> {
        WhittedPipeline::new(&self.device, &self.builds, &state.scene).map(drop)
    }

    /// Where the arrays keep their lengths, by what differs in them.
    fn take_up(&mut self, recorder: &mut Recorder, state: &WhittedState) -> Result<TakenUp, GpuError> {
        let WhittedState { scene, primitives } = state;
        let precision = self.kernel.precision();
        let update = self.on_device.as_ref().and_then(|last| differing(&last.records, &scene.records, precision));
        let mut taken_up = TakenUp::default();
        let (last_pipeline, last_arrays) = match self.on_device.take() {
            Some(last) => (Some(last.pipeline), last.arrays),
            None => (None, Vec::new()),
        };
        let arrays = if let Some(update) = update {
            for (array, parts) in last_arrays.iter().zip(&update).filter(|(_, parts)| !parts.is_empty()) {
                recorder.make_ready(array, Use::CopyTarget);
                recorder.update(array, parts.iter().map(|(offset, bytes)| (*offset, &bytes[..])));
                recorder.make_ready(array, Use::ShaderRead);
            }
            taken_up.uploaded = bytes_of(&update);
            last_arrays
        } else {
            taken_up.uploaded = scene.bytes();
            taken_up.needs_binding = true;
            taken_up.dropped = last_arrays;
            scene.upload(&self.device)?
        };
        let (pipeline, is_other) = self.pipeline_for(last_pipeline, scene)?;
        taken_up.needs_binding |= is_other;
        let (records, primitives) = (scene.records.clone(), primitives.clone());
        self.on_device = Some(OnDevice { pipeline, arrays, records, primitives });
        Ok(taken_up)
    }

    fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError> {
        self.bind_with(picture, &[])
    }

    fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, state: &WhittedState, sample: Sample) {
        if let Some(OnDevice { pipeline, .. }) = &self.on_device {
            pipeline.record(recorder, set, &state.scene.view_uniforms, sample);
        }
    }

    fn trace_one_by_one(&mut self) -> Result<bool, GpuError> {
        let Some(OnDevice { pipeline, .. }) = self.on_device.as_mut().filter(|last| last.pipeline.pixels > 1) else {
            return Ok(false);
        };
        *pipeline = pipeline.one_by_one(&self.device)?;
        Ok(true)
    }
}

/// Changes of one array: offsets and what is to be written there, bytes.
type Parts = Vec<(u64, Vec<u8>)>;

/// More than that differing is uploaded anew. Vulkan's limit for one part.
const MOST_BYTES: u64 = 65536;

fn bytes_of(update: &[Parts]) -> u64 {
    update.iter().flatten().map(|(_, bytes)| bytes.len() as u64).sum()
}

/// What of each array differs, in the order of their bindings: numbers of the view and the lights, rows of the others.
/// `None` where an array has another length, or more differs than an update takes.
fn differing(old: &WhittedRecords, new: &WhittedRecords, precision: Precision) -> Option<Vec<Parts>> {
    let number_bytes = precision.row_bytes() / 4;
    let [(_, old_view), old_rows @ ..] = old.buffers();
    let [(_, new_view), new_rows @ ..] = new.buffers();
    let (old_numbers, new_numbers) = (old_view.as_flattened(), new_view.as_flattened());
    let part = |run: Range<usize>| (run.start as u64 * number_bytes, precision.bytes(&new_numbers[run]));
    let view = runs(old_numbers, new_numbers)?.into_iter().map(part).collect();
    if Arc::ptr_eq(&old.solids, &new.solids) {
        return Some(vec![view]);
    }
    let proxies = &new.solids.proxies;
    let part = |run: Range<usize>| (run.start as u64 * Texel::BYTES, bytemuck::cast_slice(&proxies[run]).to_vec());
    let proxies = runs(&old.solids.proxies, proxies)?.into_iter().map(part).collect();
    let mut update: Vec<Parts> = vec![view, proxies];
    for ((_, old), (_, new)) in old_rows.into_iter().zip(new_rows) {
        let part =
            |run: Range<usize>| (run.start as u64 * precision.row_bytes(), precision.bytes(new[run].as_flattened()));
        update.push(runs(old, new)?.into_iter().map(part).collect());
    }
    (bytes_of(&update) <= MOST_BYTES).then_some(update)
}

/// Where two arrays of one length differ in their bits.
fn runs<T: NoUninit>(old: &[T], new: &[T]) -> Option<Vec<Range<usize>>> {
    if old.len() != new.len() {
        return None;
    }
    let mut runs: Vec<Range<usize>> = Vec::new();
    let differing = (0..new.len()).filter(|&i| bytemuck::bytes_of(&old[i]) != bytemuck::bytes_of(&new[i]));
    for place in differing {
        match runs.last_mut().filter(|run| run.end == place) {
            Some(run) => run.end += 1,
            None => runs.push(place..place + 1),
        }
    }
    Some(runs)
}

#[cfg(test)]
mod tests {
    use super::runs;

    #[test]
    fn neighbours_that_differ_are_one_part() {
        assert_eq!(runs(&[1, 2, 3, 4, 5], &[1, 0, 0, 4, 0]), Some(vec![1..3, 4..5]));
        assert_eq!(runs(&[0.0, 1.0, 1.0], &[-0.0, 1.0, 2.0]), Some(vec![0..1, 2..3]), "by their bits");
        assert_eq!(runs(&[1, 2], &[1, 2]), Some(vec![]));
        assert_eq!(runs(&[1, 2], &[1]), None);
    }
}
