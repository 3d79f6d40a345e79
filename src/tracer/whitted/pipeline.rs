//! The accurate kernel's pipelines, specialised for what a scene requires.

use std::sync::Arc;
use std::thread::available_parallelism;

use super::super::Kernel;
use super::super::parts::{Grid, Part};
use super::super::renderer::Sample;
use super::super::tiles::Tile;
use super::records::WhittedPushConstants;
use super::scene::{LightSpheres, ViewUniforms, WhittedScene, scene_bindings, unpacked};
use crate::gpu::{
    BindingKind, BindingSet, Builds, ComputePipeline, Device, DeviceKind, Dispatch, GpuError, PipelineDescription,
    Recorder, Resource, Shader, shaders,
};
use crate::plan::{Area, Features, Precision};

/// The kernel, specialised for what a scene requires.
pub(super) struct WhittedPipeline {
    /// For where light spheres may be seen, and where none may; one and the same where a picture is only of either.
    with_light_spheres: Arc<ComputePipeline>,
    without_light_spheres: Arc<ComputePipeline>,
    /// In the pictures that they are for; `Somewhere` is for all.
    light_spheres: LightSpheres,
    kernel: Kernel,
    features: Features,
    workgroup: [u32; 2],
    /// That an invocation traces: workgroups below each other.
    pub pixels: u32,
    /// See [`Part::shares`].
    threads: u32,
    /// What it and those in its place are made from.
    builds: Builds,
}

/// The program's own shader for a kernel on a device.
pub(super) fn shader_of(device: &Device, kernel: Kernel, workgroup: [u32; 2]) -> &'static Shader {
    match (kernel, has_packets(device, workgroup)) {
        (Kernel::Ssr, false) => &shaders::SSR_LIGHT,
        (Kernel::Ssr, true) => &shaders::SSR_LIGHT_PACKETS,
        (Kernel::Whitted(Precision::F64), false) => &shaders::WHITTED_F64,
        (Kernel::Whitted(Precision::F64), true) => &shaders::WHITTED_F64_PACKETS,
        (Kernel::Whitted(Precision::F32), false) => &shaders::WHITTED_F32,
        (Kernel::Whitted(Precision::F32), true) => &shaders::WHITTED_F32_PACKETS,
        (Kernel::Path(Precision::F64), false) => &shaders::PATH_F64,
        (Kernel::Path(Precision::F64), true) => &shaders::PATH_F64_PACKETS,
        (Kernel::Path(Precision::F32), false) => &shaders::PATH_F32,
        (Kernel::Path(Precision::F32), true) => &shaders::PATH_F32_PACKETS,
        (Kernel::Plain | Kernel::Course, false) => &shaders::WHITTED_PLAIN,
        (Kernel::Plain | Kernel::Course, true) => &shaders::WHITTED_PLAIN_PACKETS,
    }
}

/// Packets are of invocations along x.
fn has_packets(device: &Device, workgroup: [u32; 2]) -> bool {
    device.description().packets && workgroup[0].is_multiple_of(8)
}

/// Number of threads of a driver that runs workgroups on CPUs; else 1.
pub fn threads(device: &Device) -> u32 {
    match device.description().kind {
        DeviceKind::Cpu => available_parallelism().map_or(1, |threads| threads.get() as u32),
        DeviceKind::Discrete | DeviceKind::Integrated | DeviceKind::Virtual | DeviceKind::Other => 1,
    }
}

impl WhittedPipeline {
    pub fn new(device: &Arc<Device>, builds: &Builds, scene: &WhittedScene) -> Result<Self, GpuError> {
        let light_spheres = scene.view_uniforms.where_light_spheres_are();
        Self::made(device, builds, scene.kernel, scene.features, light_spheres, scene.workgroup)
    }

    fn made(
        device: &Arc<Device>,
        builds: &Builds,
        kernel: Kernel,
        features: Features,
        light_spheres: LightSpheres,
        workgroup: [u32; 2],
    ) -> Result<Self, GpuError> {
        let precision = kernel.precision();
        let mut bindings = vec![BindingKind::Pixels];
        bindings.extend(scene_bindings(precision));
        if kernel == Kernel::Ssr {
            // What it knows of the surfaces besides their light.
            bindings.extend([BindingKind::Pixels; 3]);
        }
        let pixels = if has_packets(device, workgroup) { features.pixels } else { 1 };
        let shader = builds.of(shader_of(device, kernel, workgroup));
        let push_constant_bytes = size_of::<WhittedPushConstants>() as u32;
        let own = Features { pixels, ..features };
        let with_light_spheres = own.constants(device, precision, workgroup)?;
        let without_light_spheres = Features { light_spheres: 0, ..own }.constants(device, precision, workgroup)?;
        let description =
            |constants| PipelineDescription { shader, bindings: &bindings, push_constant_bytes, constants };
        let first = if light_spheres == LightSpheres::Nowhere { &without_light_spheres } else { &with_light_spheres };
        let with_light_spheres = ComputePipeline::new(device, &description(first))?;
        let without_light_spheres = match light_spheres {
            LightSpheres::Somewhere => with_light_spheres.sibling(&description(&without_light_spheres))?,
            LightSpheres::Nowhere | LightSpheres::Everywhere => with_light_spheres.clone(),
        };
        let (threads, builds) = (threads(device), builds.clone());
        Ok(Self {
            with_light_spheres,
            without_light_spheres,
            light_spheres,
            kernel,
            features,
            workgroup,
            pixels,
            threads,
            builds,
        })
    }

    /// The same for pixels that are traced each by itself.
    pub fn one_by_one(&self, device: &Arc<Device>) -> Result<Self, GpuError> {
        let features = Features { pixels: 1, ..self.features };
        Self::made(device, &self.builds, self.kernel, features, self.light_spheres, self.workgroup)
    }

    /// The same from other builds.
    pub fn rebuilt(&self, device: &Arc<Device>, builds: &Builds) -> Result<Self, GpuError> {
        Self::made(device, builds, self.kernel, self.features, self.light_spheres, self.workgroup)
    }

    /// Whether it draws that scene too, as one made for it would.
    pub fn fits(&self, scene: &WhittedScene) -> bool {
        self.serves(scene) && self.features.pixels == scene.features.pixels
    }

    /// Whether it draws that scene too, if perhaps by fewer pixels per invocation.
    pub fn serves(&self, scene: &WhittedScene) -> bool {
        self.pixels_are_served(scene) && self.light_spheres_are_served(scene)
    }

    fn pixels_are_served(&self, scene: &WhittedScene) -> bool {
        let pixels = self.features.pixels;
        let own = (self.kernel, self.features, self.workgroup);
        pixels <= scene.features.pixels && own == (scene.kernel, Features { pixels, ..scene.features }, scene.workgroup)
    }

    fn light_spheres_are_served(&self, scene: &WhittedScene) -> bool {
        [LightSpheres::Somewhere, scene.view_uniforms.where_light_spheres_are()].contains(&self.light_spheres)
    }

    /// In its place, for a scene that it does not fit. Where light spheres come in sight and go out of it, that is once
    /// for all.
    pub fn replaced(&self, device: &Arc<Device>, scene: &WhittedScene) -> Result<Self, GpuError> {
        let is_seen_otherwise = self.pixels_are_served(scene) && !self.light_spheres_are_served(scene);
        let light_spheres =
            if is_seen_otherwise { LightSpheres::Somewhere } else { scene.view_uniforms.where_light_spheres_are() };
        Self::made(device, &self.builds, scene.kernel, scene.features, light_spheres, scene.workgroup)
    }

    /// The kernel reading a scene's arrays and writing into `picture`, a buffer of pixels, and into `more`.
    pub fn bind(
        &self,
        picture: &Resource,
        arrays: &[Resource],
        more: &[Resource],
    ) -> Result<Arc<BindingSet>, GpuError> {
        let resources: Vec<_> = [picture].into_iter().chain(arrays).chain(more).cloned().collect();
        BindingSet::new(&self.with_light_spheres, &resources)
    }

    /// Traces one sample of each pixel of parts of a tile.
    pub fn record(
        &self,
        recorder: &mut Recorder,
        set: &Arc<BindingSet>,
        view_uniforms: &ViewUniforms,
        Sample { index, tile, parts }: Sample,
    ) {
        let &ViewUniforms { frame, light_spheres } = view_uniforms;
        let frame = WhittedPushConstants {
            tile_origin: tile.x | tile.y << 16,
            tile_size: tile.width | tile.height << 16,
            ..if self.kernel.description().is_statistical { frame.at_run(index) } else { frame.at_sample(index) }
        };
        let light_spheres = light_spheres.map(|area| self.part_of(area, &frame));
        let cut = |&part: &Tile| {
            let part = Part::of_pixels(part, self.group());
            light_spheres.map_or_else(|| (None, vec![part]), |area| part.cut(area))
        };
        let (with_light_spheres, others): (Vec<_>, Vec<_>) = parts.iter().map(cut).unzip();
        let with_light_spheres = with_light_spheres.into_iter().flatten().map(|part| (part, &self.with_light_spheres));
        let others = others.into_iter().flatten().map(|part| (part, &self.without_light_spheres));
        let dispatches = |(part, pipeline): (Part, _)| {
            let grids = part.shares(self.threads).into_iter();
            grids.map(move |Grid { first, groups }| Dispatch { pipeline, first, groups })
        };
        let dispatches: Vec<_> = with_light_spheres.chain(others).flat_map(dispatches).collect();
        recorder.dispatch_parts(set, bytemuck::bytes_of(&frame), &dispatches);
    }

    /// What a workgroup traces, pixels.
    fn group(&self) -> [u32; 2] {
        [self.workgroup[0], self.workgroup[1] * self.pixels]
    }

    /// The workgroups of a tile that an area of the picture touches, and perhaps some beyond it.
    fn part_of(&self, area: Area, frame: &WhittedPushConstants) -> Part {
        let pixels = area.pixels(unpacked(frame.image_size));
        let tile = unpacked(frame.tile_origin);
        let group = self.group();
        let first = [0, 1].map(|axis| pixels[axis].start.saturating_sub(tile[axis]) / group[axis]);
        let end = [0, 1].map(|axis| pixels[axis].end.saturating_sub(tile[axis]).div_ceil(group[axis]));
        Part { first, groups: [0, 1].map(|axis| end[axis].saturating_sub(first[axis])) }
    }
}
