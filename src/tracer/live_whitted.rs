//! The accurate kernel or the plain one with a scene that changes: what stays the same is neither made nor uploaded
//! again.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::NoUninit;

use super::course::WORKGROUP;
use super::pixels::check_picture;
use super::whitted::{WhittedScene, check_precision};
use super::whitted_pipeline::{WhittedPipeline, shader_of};
use super::whitted_records::{SolidRecords, WhittedRecords};
use super::{Kernel, Settings, TracerError};
use crate::gpu::{BindingSet, Builds, Device, GpuError, Recorder, Resource, Shader, Texel, Use};
use crate::plan::{Precision, TraversalCost, scene_space_within};
use crate::scene::{Extent, Primitive, Scene};
use crate::settings::sampling::Sampling;

/// The kernel with the state that it began last.
pub(super) struct LiveWhitted {
    kernel: Kernel,
    device: Arc<Device>,
    builds: Builds,
    begun: Option<OnDevice>,
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
}

impl Primitives {
    fn of(primitives: &[Primitive]) -> Self {
        Self { list: primitives.to_vec(), extent: Extent::of(primitives), cost: TraversalCost::of(primitives) }
    }
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

/// A state of the scene.
pub(super) struct WhittedState {
    pub scene: WhittedScene,
    primitives: Arc<Primitives>,
}

impl PartialEq for WhittedState {
    /// Whether their pictures are the same.
    fn eq(&self, other: &Self) -> bool {
        self.scene == other.scene
    }
}

impl LiveWhitted {
    pub fn new(device: &Arc<Device>, kernel: Kernel, builds: &Builds) -> Self {
        Self { kernel, device: device.clone(), builds: builds.clone(), begun: None }
    }

    /// The program's own that is built into it, or that a build took the place of.
    pub fn shader(&self) -> &'static Shader {
        shader_of(&self.device, self.kernel, WORKGROUP)
    }

    /// From other builds from now on; binding sets made before are out of date.
    ///
    /// # Errors
    /// The device does not take them; it stays as it is.
    pub fn rebuild(&mut self, builds: &Builds) -> Result<(), GpuError> {
        if let Some(begun) = &mut self.begun {
            begun.pipeline = begun.pipeline.rebuilt(&self.device, builds)?;
        }
        self.builds = builds.clone();
        Ok(())
    }

    /// # Errors
    /// The kernel cannot take the scene on this device.
    pub fn prepare(
        &self,
        scene: &Scene,
        settings: &Settings,
        sampling: Sampling,
        size: [u32; 2],
    ) -> Result<WhittedState, TracerError> {
        let precision = self.kernel.precision();
        check_precision(&self.device, precision)?;
        let same = self.begun.as_ref().filter(|begun| begun.primitives.list == scene.primitives);
        let primitives =
            same.map_or_else(|| Arc::new(Primitives::of(&scene.primitives)), |begun| begun.primitives.clone());
        let frame = scene_space_within(scene, &primitives.extent, self.kernel);
        let last = self.begun.as_ref().map(|begun| &begun.records.solids).filter(|solids| solids.frame == frame);
        let solids = match last {
            Some(solids) if same.is_some() => solids.clone(),
            _ => Arc::new(SolidRecords::of(&scene.primitives, frame, precision, last.map(Arc::as_ref))),
        };
        let records = WhittedRecords::with(scene, solids, precision, size);
        let max_depth = settings.max_depth.unwrap_or(scene.max_depth);
        // Of what a window shows, nothing is traced again that took too long.
        let pixels = primitives.cost.pixels_per_invocation(scene.lights.len(), max_depth, 1);
        let scene =
            WhittedScene::with(&self.device, scene, records, self.kernel, settings.approximations, max_depth, size)?;
        let scene = scene.with_pixels_per_invocation(pixels);
        let scene = if settings.without_boxes { scene.without_boxes() } else { scene };
        check_picture(self.device.description(), sampling.traced_size(size))?;
        Ok(WhittedState { scene: scene.sampled(sampling, size), primitives })
    }

    /// Takes up a state: where the arrays keep their lengths, by what differs in them.
    pub fn begin(&mut self, recorder: &mut Recorder, state: &WhittedState) -> Result<Begun, GpuError> {
        let WhittedState { scene, primitives } = state;
        let precision = self.kernel.precision();
        let update = self.begun.as_ref().and_then(|last| differing(&last.records, &scene.records, precision));
        let mut begun = Begun::default();
        let (last_pipeline, last_arrays) = match self.begun.take() {
            Some(last) => (Some(last.pipeline), last.arrays),
            None => (None, Vec::new()),
        };
        let arrays = if let Some(update) = update {
            for (array, parts) in last_arrays.iter().zip(&update).filter(|(_, parts)| !parts.is_empty()) {
                recorder.make_ready(array, Use::CopyTarget);
                recorder.update(array, parts.iter().map(|(offset, bytes)| (*offset, &bytes[..])));
                recorder.make_ready(array, Use::ShaderRead);
            }
            begun.uploaded = bytes_of(&update);
            last_arrays
        } else {
            begun.uploaded = scene.bytes();
            begun.needs_binding = true;
            begun.dropped = last_arrays;
            scene.upload(&self.device)?
        };
        let pipeline = match last_pipeline {
            Some(last) if last.serves(scene, WORKGROUP) => last,
            Some(last) => {
                begun.needs_binding = true;
                last.replaced(&self.device, scene, WORKGROUP)?
            }
            None => WhittedPipeline::new(&self.device, &self.builds, scene, WORKGROUP)?,
        };
        let (records, primitives) = (scene.records.clone(), primitives.clone());
        self.begun = Some(OnDevice { pipeline, arrays, records, primitives });
        Ok(begun)
    }

    /// The kernel writing into `picture`; `None` before its first state.
    pub fn bind(&self, picture: &Resource) -> Result<Option<Arc<BindingSet>>, GpuError> {
        self.begun.as_ref().map(|begun| begun.pipeline.bind(picture, &begun.arrays)).transpose()
    }

    /// That of the state begun last.
    pub fn pipeline(&self) -> Option<&WhittedPipeline> {
        self.begun.as_ref().map(|begun| &begun.pipeline)
    }
}

/// Of one array: offsets and what is to be written there, bytes.
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
