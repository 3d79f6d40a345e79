//! Rays in, hits out: a kernel's intersections one by one, so that its accuracy is known ray by ray.

use std::sync::Arc;

use bytemuck::{bytes_of, cast_slice};
use glam::DVec3;

use super::course::{CoursePushConstants, PrimitiveRecords, upload};
use super::whitted::{WhittedPushConstants, WhittedRecords, check_precision, scene_bindings, upload_scene};
use super::{Kernel, TracerError};
use crate::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Commands, ComputePipeline, Device, PipelineDescription, Resource, Use,
    shaders,
};
use crate::plan::{Features, Precision};
use crate::reference::{Face, Side};
use crate::scene::{Light, Primitive, Scene, SceneSpace, Solid, farthest_coordinate};

/// What is known of a probed ray's origin. The course kernel knows nothing of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum From {
    /// No surface: the ray begins anywhere.
    Space,
    /// This solid's surface, left to this side.
    Own(Face, Side),
    /// A surface of another solid that may touch this one.
    Another,
}

/// World frame.
#[derive(Debug, Clone, Copy)]
pub struct ProbeRay {
    /// World frame.
    pub origin: DVec3,
    /// Unit vector, world frame.
    pub direction: DVec3,
    /// Index of the one solid to test.
    pub solid: usize,
    /// Where the ray begins.
    pub from: From,
}

/// World frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbeHit {
    /// Distance from the origin along the ray, world lengths.
    pub t: f64,
    /// World frame.
    pub point: DVec3,
    /// Normal of the surface there, world frame.
    pub normal: DVec3,
    /// Face and side by the accurate model; the course kernel reports neither.
    pub surface: Option<(Face, Side)>,
}

impl ProbeHit {
    /// Whether distance, point and normal are free of infinities and NaNs.
    pub fn is_finite(&self) -> bool {
        self.t.is_finite() && self.point.is_finite() && self.normal.is_finite()
    }
}

/// A kernel's intersections on a device.
pub struct Probe {
    kernel: Kernel,
    pipeline: Arc<ComputePipeline>,
    device: Arc<Device>,
}

/// Rows of `ProbeRay` and `ProbeHit` in `glsl/probe/rays.comp`, and in `course_rays.comp`.
const ROWS: usize = 3;
const COURSE_ROWS: usize = 2;

const COURSE_BINDINGS: [BindingKind; 6] = [
    BindingKind::Records,
    BindingKind::Uniform,
    BindingKind::Uniform,
    BindingKind::Uniform,
    BindingKind::Uniform,
    BindingKind::Storage,
];

impl Probe {
    /// # Errors
    /// The device lacks the kernel's precision, or fails.
    pub fn new(device: &Arc<Device>, kernel: Kernel) -> Result<Self, TracerError> {
        let pipeline = match kernel {
            Kernel::Course => ComputePipeline::new(
                device,
                &PipelineDescription {
                    shader: &shaders::PROBE_COURSE_RAYS,
                    bindings: &COURSE_BINDINGS,
                    push_constant_bytes: size_of::<CoursePushConstants>() as u32,
                    constants: &[],
                },
            )?,
            Kernel::Plain | Kernel::Ssr | Kernel::Whitted(_) | Kernel::Path(_) => {
                let precision = kernel.precision();
                check_precision(device, precision)?;
                let features = Features { kinds: [true; 4], ..Features::default() };
                let mut bindings = vec![BindingKind::Records];
                bindings.extend(scene_bindings(precision));
                bindings.push(BindingKind::Storage);
                let description = PipelineDescription {
                    shader: match kernel {
                        Kernel::Whitted(Precision::F64) | Kernel::Path(Precision::F64) => &shaders::PROBE_RAYS_F64,
                        Kernel::Ssr | Kernel::Whitted(Precision::F32) | Kernel::Path(Precision::F32) => {
                            &shaders::PROBE_RAYS_F32
                        }
                        Kernel::Plain | Kernel::Course => &shaders::PROBE_RAYS_PLAIN,
                    },
                    bindings: &bindings,
                    push_constant_bytes: size_of::<WhittedPushConstants>() as u32,
                    constants: &features.constants(device, precision, [64, 1])?,
                };
                ComputePipeline::new(device, &description)?
            }
        };
        Ok(Self { kernel, pipeline, device: device.clone() })
    }

    /// Casts each ray at its one solid. What the kernel's numbers cannot hold is rounded to the nearest.
    ///
    /// # Panics
    /// For the accurate kernels all solids are of one kind, and none is too small for the precision.
    pub fn cast(&self, solids: &[Solid], rays: &[ProbeRay]) -> Result<Vec<Option<ProbeHit>>, TracerError> {
        match self.kernel {
            Kernel::Course => self.cast_by_course(solids, rays),
            Kernel::Plain | Kernel::Ssr | Kernel::Whitted(_) | Kernel::Path(_) => self.cast_by_whitted(solids, rays),
        }
    }

    fn cast_by_whitted(&self, solids: &[Solid], rays: &[ProbeRay]) -> Result<Vec<Option<ProbeHit>>, TracerError> {
        let precision = self.kernel.precision();
        let farthest_origin = rays.iter().map(|ray| ray.origin.abs().max_element()).fold(0.0, f64::max);
        let scene = scene_of(solids);
        let reach = (farthest_coordinate(&scene.primitives, DVec3::ZERO).max(farthest_origin) / 2.0) as f32;
        let scene_space = SceneSpace::world(reach.next_up());
        let records = WhittedRecords::of(&scene, scene_space, precision, [1, 1]);
        assert_eq!(
            records.solids.counts.iter().sum::<u32>() as usize,
            solids.len(),
            "a solid is too small for the kernel"
        );
        let rows: Vec<[[f64; 4]; ROWS]> =
            rays.iter().map(|ray| ray_rows(ray, records.solids.slots[ray.solid])).collect();
        let frame = WhittedPushConstants {
            counts: records.solids.counts,
            first_proxies: records.solids.first_proxies,
            tile_origin: 0,
            image_size: 0,
            depth: 1,
            light_count: 0,
            reach: scene_space.reach,
            writes_remainder: 0,
            min_throughput: 0.0,
            min_shadowed: 0.0,
            sample_place: [0, 0],
            samples_before: 0,
            sample_weight: 1.0,
            tile_size: 0,
            light_sphere_count: 0,
            seed: 0,
            samples_at_once: 1,
            padding: [0; 2],
        };
        let scene = upload_scene(&self.device, &records, precision)?;
        let bytes = precision.bytes(cast_slice(&rows));
        let hits = self.run(&bytes, bytes.len(), &scene, bytes_of(&frame), rays.len())?;
        let hits: Vec<f64> = match precision {
            Precision::F32 => floats(&hits),
            Precision::F64 => bytemuck::pod_collect_to_vec(&hits),
        };
        Ok(hits.chunks_exact(4 * ROWS).map(hit_of).collect())
    }

    /// The course kernel searches all of its scene: a scene a solid.
    fn cast_by_course(&self, solids: &[Solid], rays: &[ProbeRay]) -> Result<Vec<Option<ProbeHit>>, TracerError> {
        let mut hits = vec![None; rays.len()];
        for (index, solid) in solids.iter().enumerate() {
            let scene = scene_of(std::slice::from_ref(solid));
            let records = PrimitiveRecords::of(&scene);
            let own: Vec<_> = rays.iter().enumerate().filter(|(_, ray)| ray.solid == index).collect();
            if own.is_empty() {
                continue;
            }
            // In place of the depth, the kernel reads how many rays there are.
            let frame = CoursePushConstants::new(&scene, &Light::default(), records.counts(), own.len() as u32, 1, 1);
            let rows: Vec<[f32; 4 * COURSE_ROWS]> = own
                .iter()
                .map(|(_, ray)| {
                    let ([x, y, z], [dx, dy, dz]) = (ray.origin.as_vec3().into(), ray.direction.as_vec3().into());
                    [x, y, z, 0.0, dx, dy, dz, 0.0]
                })
                .collect();
            let bytes: &[u8] = cast_slice(&rows);
            let found =
                floats(&self.run(bytes, bytes.len(), &upload(&self.device, &records)?, bytes_of(&frame), own.len())?);
            for ((place, _), hit) in own.iter().zip(found.chunks_exact(4 * COURSE_ROWS)) {
                let &[x, y, z, t, nx, ny, nz, is_hit] = hit else { unreachable!("a chunk is that long") };
                hits[*place] = (is_hit == 1.0).then_some(ProbeHit {
                    t,
                    point: DVec3::new(x, y, z),
                    normal: DVec3::new(nx, ny, nz),
                    surface: None,
                });
            }
        }
        Ok(hits)
    }

    /// The bytes that the kernel writes for so many rays.
    fn run(
        &self,
        rays: &[u8],
        hit_bytes: usize,
        scene: &[Resource],
        frame: &[u8],
        count: usize,
    ) -> Result<Vec<u8>, TracerError> {
        let mut ray_buffer = Buffer::new(&self.device, "rays", BufferKind::Records, rays.len() as u64)?;
        ray_buffer.write(rays)?;
        let hits = Arc::new(Buffer::new(&self.device, "hits", BufferKind::Storage, hit_bytes as u64)?);
        let hit_resource = Resource::from(&hits);
        let mut resources = vec![Resource::from(&Arc::new(ray_buffer))];
        resources.extend(scene.iter().cloned());
        resources.push(hit_resource.clone());
        let set = BindingSet::new(&self.pipeline, &resources)?;
        let mut commands = Commands::new(&self.device, "probe rays")?;
        commands.run(|recorder| {
            recorder.dispatch(&self.pipeline, &set, frame, [count.div_ceil(64) as u32, 1, 1]);
            recorder.make_ready(&hit_resource, Use::HostRead);
            Ok(())
        })?;
        Ok(hits.bytes(&commands.idle()?)?.to_vec())
    }
}

fn scene_of(solids: &[Solid]) -> Scene {
    let primitive = |solid: &Solid| Primitive { name: None, solid: solid.clone(), material: Default::default() };
    Scene { primitives: solids.iter().map(primitive).collect(), ..Scene::default() }
}

fn floats(bytes: &[u8]) -> Vec<f64> {
    bytemuck::pod_collect_to_vec::<u8, f32>(bytes).into_iter().map(f64::from).collect()
}

fn ray_rows(ray: &ProbeRay, slot: u32) -> [[f64; 4]; ROWS] {
    let (origin_surface, face, side) = match ray.from {
        From::Space => (-1.0, Face::Curved, Side::Outside),
        From::Own(face, side) => (0.0, face, side),
        From::Another => (1.0, Face::Curved, Side::Outside),
    };
    let face = match face {
        Face::Curved => 0,
        Face::Slab { axis, positive } => 1 + 2 * axis + u8::from(positive),
        Face::End(end) => 7 + end,
        Face::Base => 9,
    };
    let inside = f64::from(u8::from(side == Side::Inside));
    [
        ray.origin.extend(f64::from(slot)).to_array(),
        ray.direction.extend(origin_surface).to_array(),
        [face.into(), inside, 0.0, 0.0],
    ]
}

fn hit_of(numbers: &[f64]) -> Option<ProbeHit> {
    let &[x, y, z, t, nx, ny, nz, primitive, face, inside, ..] = numbers else { unreachable!("a chunk is longer") };
    let face = match face as u8 {
        0 => Face::Curved,
        slab @ 1..=6 => Face::Slab { axis: (slab - 1) / 2, positive: slab % 2 == 0 },
        end @ 7..=8 => Face::End(end - 7),
        _ => Face::Base,
    };
    let side = if inside == 1.0 { Side::Inside } else { Side::Outside };
    (primitive >= 0.0).then_some(ProbeHit {
        t,
        point: DVec3::new(x, y, z),
        normal: DVec3::new(nx, ny, nz),
        surface: Some((face, side)),
    })
}
