//! The passes behind the light pass.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};

use super::super::parts::{Grid, Part};
use super::super::tiles::Tile;
use super::super::whitted::{WhittedPushConstants, scene_bindings, threads};
use super::surfaces::{Surfaces, levels};
use crate::gpu::{
    BindingKind, BindingSet, Builds, ComputePipeline, Device, Dispatch, GpuError, PipelineDescription, Recorder,
    Resource, Use, shaders,
};
use crate::plan::{Features, Precision, WORKGROUP};

/// `Push` of `glsl/ssr/depths.comp`: cells.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct DepthsPushConstants {
    size: [u32; 2],
    first: u32,
    next_first: u32,
}

/// `glsl/ssr/depths.comp`: the nearest and the farthest of the blocks of a picture.
pub(super) struct DepthPyramid {
    pipeline: Arc<ComputePipeline>,
}

impl DepthPyramid {
    pub fn new(device: &Arc<Device>, builds: &Builds) -> Result<Self, GpuError> {
        let description = PipelineDescription {
            shader: builds.of(&shaders::SSR_DEPTHS),
            bindings: &[BindingKind::Pixels],
            push_constant_bytes: size_of::<DepthsPushConstants>() as u32,
            constants: &WORKGROUP,
        };
        Ok(Self { pipeline: ComputePipeline::new(device, &description)? })
    }

    pub fn bind(&self, surfaces: &Surfaces) -> Result<Arc<BindingSet>, GpuError> {
        BindingSet::new(&self.pipeline, std::slice::from_ref(&surfaces.depths))
    }

    /// Level by level, each from that before.
    pub fn record(&self, recorder: &mut Recorder, set: &Arc<BindingSet>, surfaces: &Surfaces) {
        let mut first = 0;
        for (size, next_size) in levels(surfaces.size).zip(levels(surfaces.size).skip(1)) {
            let next_first = first + size[0] * size[1];
            let frame = DepthsPushConstants { size, first, next_first };
            let [columns, rows] = [0, 1].map(|axis| next_size[axis].div_ceil(WORKGROUP[axis]));
            recorder.make_ready(&surfaces.depths, Use::ShaderWrite);
            recorder.dispatch(&self.pipeline, set, bytemuck::bytes_of(&frame), [columns, rows, 1]);
            first = next_first;
        }
    }
}

/// What `glsl/ssr/reflect.comp` is compiled for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Variant {
    features: Features,
    shows_reasons: bool,
}

impl Variant {
    /// For what the light pass has, and whether rays go on from there.
    pub fn of(light: Features, reflections: bool, shows_reasons: bool) -> Self {
        Self { features: Features { reflections, light_spheres: 0, pixels: 1, ..light }, shows_reasons }
    }
}

/// `glsl/ssr/reflect.comp`: the picture, from what the camera sees.
pub(super) struct Reflections {
    pub variant: Variant,
    pipeline: Arc<ComputePipeline>,
    threads: u32,
}

impl Reflections {
    pub fn new(device: &Arc<Device>, builds: &Builds, variant: Variant) -> Result<Self, GpuError> {
        let mut bindings = vec![BindingKind::Pixels];
        bindings.extend(scene_bindings(Precision::F32));
        bindings.extend([BindingKind::PixelsRead; 4]);
        let mut constants = variant.features.constants(device, Precision::F32, WORKGROUP)?.to_vec();
        constants.push(u32::from(variant.shows_reasons));
        let description = PipelineDescription {
            shader: builds.of(&shaders::SSR_REFLECT),
            bindings: &bindings,
            push_constant_bytes: size_of::<WhittedPushConstants>() as u32,
            constants: &constants,
        };
        Ok(Self { variant, pipeline: ComputePipeline::new(device, &description)?, threads: threads(device) })
    }

    /// From a scene's arrays and its surfaces into a picture, a buffer of pixels.
    pub fn bind(
        &self,
        picture: &Resource,
        arrays: &[Resource],
        surfaces: &Surfaces,
    ) -> Result<Arc<BindingSet>, GpuError> {
        let mut resources = vec![picture.clone()];
        resources.extend_from_slice(arrays);
        resources.extend(surfaces.geometry());
        resources.push(surfaces.radiances.clone());
        BindingSet::new(&self.pipeline, &resources)
    }

    /// All of the picture, whose first generation the push constants are for.
    pub fn record(
        &self,
        recorder: &mut Recorder,
        set: &Arc<BindingSet>,
        frame: WhittedPushConstants,
        generations: u32,
        picture: Tile,
    ) {
        let frame = WhittedPushConstants { depth: generations, ..frame };
        let shares = Part::of_pixels(picture, WORKGROUP).shares(self.threads).into_iter();
        let dispatches: Vec<_> =
            shares.map(|Grid { first, groups }| Dispatch { pipeline: &self.pipeline, first, groups }).collect();
        recorder.dispatch_parts(set, bytemuck::bytes_of(&frame), &dispatches);
    }
}
