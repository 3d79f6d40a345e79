//! The accurate kernel's intersections a ray at a time: `glsl/probe/rays.comp`.
#![allow(dead_code, reason = "each test crate takes what it needs")]

pub mod cases;

use std::sync::Arc;

use bytemuck::{bytes_of, cast_slice};
use glam::DVec3;
use zerkalo::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Commands, ComputePipeline, Device, PipelineDescription, Resource, Use,
    shaders,
};
use zerkalo::reference::{Face, Side};
use zerkalo::scene::{Primitive, Scene, Solid};
use zerkalo::tracer::{
    KernelFrame, Precision, SCENE_BINDINGS, WhittedFrame, WhittedRecords, scene_constants, upload_scene,
};

/// What is known of a probed ray's origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum From {
    Space,
    /// This solid's surface.
    Own(Face, Side),
    /// A surface of another solid that may touch this one.
    Another,
}

#[derive(Debug, Clone, Copy)]
pub struct ProbeRay {
    pub origin: DVec3,
    pub direction: DVec3,
    /// Index of the solid to try.
    pub solid: usize,
    pub from: From,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbeHit {
    pub t: f64,
    pub point: DVec3,
    pub normal: DVec3,
    pub face: Face,
    pub side: Side,
}

impl ProbeHit {
    pub fn is_finite(&self) -> bool {
        self.t.is_finite() && self.point.is_finite() && self.normal.is_finite()
    }
}

/// The nearest number of a precision.
pub fn stored(precision: Precision, value: f64) -> f64 {
    match precision {
        Precision::F32 => f64::from(value as f32),
        Precision::F64 => value,
    }
}

pub fn stored_vector(precision: Precision, vector: DVec3) -> DVec3 {
    DVec3::from_array(vector.to_array().map(|value| stored(precision, value)))
}

pub struct Probe<'d> {
    device: &'d Arc<Device>,
    pub precision: Precision,
    pipeline: Arc<ComputePipeline>,
}

const ROWS: usize = 3;
type Record = [[f64; 4]; ROWS];

impl<'d> Probe<'d> {
    pub fn new(device: &'d Arc<Device>, precision: Precision) -> Self {
        let mut bindings = vec![BindingKind::Records];
        bindings.extend(SCENE_BINDINGS);
        bindings.push(BindingKind::Storage);
        let description = PipelineDescription {
            shader: match precision {
                Precision::F32 => &shaders::PROBE_RAYS_F32,
                Precision::F64 => &shaders::PROBE_RAYS_F64,
            },
            bindings: &bindings,
            push_constant_bytes: size_of::<WhittedFrame>() as u32,
            constants: &scene_constants(device, precision, [1; 4]).unwrap(),
        };
        Self { device, precision, pipeline: ComputePipeline::new(device, &description).unwrap() }
    }

    /// Casts each ray at its one solid; all solids are of one kind, in numbers that the precision stores exactly.
    pub fn cast(&self, solids: &[Solid], rays: &[ProbeRay]) -> Vec<Option<ProbeHit>> {
        let Self { device, precision, pipeline } = self;
        let primitive = |solid: &Solid| Primitive { name: None, solid: solid.clone(), material: Default::default() };
        let scene = Scene { primitives: solids.iter().map(primitive).collect(), ..Scene::default() };
        let records = WhittedRecords::of(&scene, KernelFrame::WORLD, *precision, [1, 1]);
        assert_eq!(records.counts.iter().sum::<u32>() as usize, solids.len());

        let rows: Vec<Record> = rays.iter().map(ray_rows).collect();
        let bytes = self.bytes(cast_slice(&rows));
        let mut ray_buffer = Buffer::new(device, "rays", BufferKind::Records, bytes.len() as u64).unwrap();
        ray_buffer.write(&bytes).unwrap();
        let mut hits = Buffer::new(device, "hits", BufferKind::Storage, bytes.len() as u64).unwrap();
        hits.write(&vec![0xFF; bytes.len()]).unwrap();
        let hits = Arc::new(hits);
        let hit_resource = Resource::from(&hits);
        let mut resources = vec![Resource::from(&Arc::new(ray_buffer))];
        resources.extend(upload_scene(device, &records, *precision).unwrap());
        resources.push(hit_resource.clone());
        let set = BindingSet::new(pipeline, &resources).unwrap();
        let frame = WhittedFrame {
            counts: records.counts,
            tile_origin: 0,
            image_size: 0,
            depth: 1,
            light_count: 0,
            writes_remainder: 0,
        };
        Commands::new(device, "probe rays")
            .unwrap()
            .run(|recorder| {
                recorder.dispatch(pipeline, &set, bytes_of(&frame), [rays.len().div_ceil(64) as u32, 1, 1]);
                recorder.make_ready(&hit_resource, Use::HostRead);
                Ok(())
            })
            .unwrap();
        self.numbers(hits.bytes().unwrap()).chunks_exact(4 * ROWS).map(hit_of).collect()
    }

    fn bytes(&self, numbers: &[f64]) -> Vec<u8> {
        match self.precision {
            Precision::F32 => numbers.iter().flat_map(|&number| (number as f32).to_ne_bytes()).collect(),
            Precision::F64 => cast_slice(numbers).to_vec(),
        }
    }

    fn numbers(&self, bytes: &[u8]) -> Vec<f64> {
        match self.precision {
            Precision::F32 => cast_slice::<_, f32>(bytes).iter().map(|&number| number.into()).collect(),
            Precision::F64 => cast_slice(bytes).to_vec(),
        }
    }
}

fn ray_rows(ray: &ProbeRay) -> Record {
    let (departure, face, side) = match ray.from {
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
        ray.origin.extend(ray.solid as f64).to_array(),
        ray.direction.extend(departure).to_array(),
        [face.into(), inside, 0.0, 0.0],
    ]
}

fn hit_of(numbers: &[f64]) -> Option<ProbeHit> {
    let [x, y, z, t, nx, ny, nz, primitive, face, inside, ..] = *numbers else { panic!("a short record") };
    let face = match face as u8 {
        0 => Face::Curved,
        slab @ 1..=6 => Face::Slab { axis: (slab - 1) / 2, positive: slab % 2 == 0 },
        end @ 7..=8 => Face::End(end - 7),
        _ => Face::Base,
    };
    assert!(primitive >= -1.0, "the kernel wrote no hit: {numbers:?}");
    (primitive >= 0.0).then_some(ProbeHit {
        t,
        point: DVec3::new(x, y, z),
        normal: DVec3::new(nx, ny, nz),
        face,
        side: if inside == 1.0 { Side::Inside } else { Side::Outside },
    })
}
