//! The records of `glsl/records/scene.glsl`, filled from a scene.
//!
//! Every record is rows of four reals, so they are computed in `f64` here and, for the `f32` kernel, narrowed number by
//! number. What an `f32` cannot hold and the kernel needs (an axis, the midpoint of two ends) is given as a number
//! and its error.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use rayon::prelude::*;

use super::hierarchy::{self, GROUP, Level};
use super::proxies::{level_rows, nothing, proxy};
use super::rows::{row, unit};
use crate::plan::{LightFeatures, Media, Precision, VIEW_ROWS, is_rotated, may_be_in_a_solid, solid_row_count};
use crate::scene::{
    BoundingSphere, Bounds, BoxNearby, Camera, CylinderNearby, Light, Material, Primitive, Projection, Scene,
    SceneSpace, Solid, SolidKind, SphereNearby, two_sum, world_from_box,
};
use crate::settings::sampling::sample_place;

/// What the kernel's buffers hold.
#[derive(Debug, Clone)]
pub struct WhittedRecords {
    /// `View`, then the lights.
    pub view_and_lights: Vec<[f64; 4]>,
    /// Number of lights that give any light: the first ones.
    pub light_count: u32,
    /// Number of all lights.
    pub light_sphere_count: u32,
    /// What the scene asks for; which rows there are depends on that.
    pub light: LightFeatures,
    /// Shared by pictures whose primitives and frame are the same.
    pub solids: Arc<SolidRecords>,
}

impl PartialEq for WhittedRecords {
    fn eq(&self, other: &Self) -> bool {
        let Self { view_and_lights, light_count, light_sphere_count: _, light, solids } = self;
        (view_and_lights, *light_count, light) == (&other.view_and_lights, other.light_count, &other.light)
            && (Arc::ptr_eq(solids, &other.solids) || *solids == other.solids)
    }
}

impl WhittedRecords {
    /// For a picture of `width`×`height` pixels; `precision` is that of the kernel.
    pub fn of(scene: &Scene, frame: SceneSpace, precision: Precision, size: [u32; 2]) -> Self {
        let light = LightFeatures::of(scene);
        let solids = SolidRecords::of(&scene.primitives, light, frame, precision, None);
        Self::with(scene, light, Arc::new(solids), precision, size)
    }

    /// With records of the scene's primitives that are there already.
    pub(super) fn with(
        scene: &Scene,
        light: LightFeatures,
        solids: Arc<SolidRecords>,
        precision: Precision,
        [width, height]: [u32; 2],
    ) -> Self {
        let may_be_in_medium = light.media == Media::Nested && may_be_in_a_solid(scene);
        let mut view_and_lights = view(scene, may_be_in_medium, solids.frame, precision, [width, height]).to_vec();
        let (shining, dark): (Vec<_>, Vec<_>) = scene.lights.iter().partition(|light| light.intensity != DVec3::ZERO);
        let rows = |each: &&Light| light_rows(each, solids.frame).into_iter().take(light.light_rows());
        view_and_lights.extend(shining.iter().chain(&dark).flat_map(rows));
        let light_sphere_count = scene.lights.len() as u32;
        Self { view_and_lights, light_count: shining.len() as u32, light_sphere_count, light, solids }
    }

    /// The buffers of the kernel's own numbers, in the order of their bindings, with their names; the proxies come
    /// after the first.
    pub fn buffers(&self) -> [(&'static str, &[[f64; 4]]); 6] {
        let [spheres, boxes, cylinders, cones] = &self.solids.rows;
        [
            ("view and lights", &self.view_and_lights),
            ("spheres", spheres),
            ("boxes", boxes),
            ("cylinders", cylinders),
            ("cones", cones),
            ("materials", &self.solids.materials),
        ]
    }
}

/// All that the kernel knows of the primitives.
#[derive(Debug, Default, PartialEq)]
pub struct SolidRecords {
    /// Kernel frame that all records are in.
    pub frame: SceneSpace,
    /// The proxies of each kind's solids and the boxes over them, for the search in `f32`.
    pub proxies: Vec<[f32; 4]>,
    /// Spheres, boxes, cylinders, cones, as all that follows by kind.
    pub rows: [Vec<[f64; 4]>; 4],
    /// By slot.
    pub materials: Vec<[f64; 4]>,
    /// Rows of each material.
    pub material_rows: usize,
    /// The slot of each primitive of the scene, or [`NO_SLOT`].
    pub slots: Vec<u32>,
    /// Numbers of spheres, boxes, cylinders and cones.
    pub counts: [u32; 4],
    /// Where each kind's proxies begin, rows.
    pub first_proxies: [u32; 4],
    /// Levels of boxes over the solids.
    pub levels: [u32; 4],
    /// No box is rotated.
    pub are_boxes_axis_aligned: bool,
    orders: [Order; 4],
}

/// Slot of a primitive that is too small for the kernel.
pub const NO_SLOT: u32 = u32::MAX;

/// How the solids of a kind lie.
#[derive(Debug, Default, PartialEq)]
struct Order {
    places: Vec<u32>,
    /// Surface of all boxes when it was chosen.
    surface: f64,
}

/// An order is kept while its boxes have no more than this many times the surface that they had when it was chosen:
/// what a ray looks into scales with it.
const MOST_SURFACE: f64 = 1.5;

impl SolidRecords {
    /// In the order of `last`, of the same frame, for kinds where that still fits: then solids that did not change have
    /// the records that they had, at their positions.
    pub(super) fn of(
        primitives: &[Primitive],
        light: LightFeatures,
        frame: SceneSpace,
        precision: Precision,
        last: Option<&SolidRecords>,
    ) -> Self {
        let slots = vec![NO_SLOT; primitives.len()];
        let material_rows = light.material_rows();
        let mut records = Self { frame, material_rows, are_boxes_axis_aligned: true, slots, ..Self::default() };
        for kind in SolidKind::ALL {
            records.add(kind, primitives, precision, last.map(|last| &last.orders[kind as usize]));
        }
        records
    }

    fn add(&mut self, kind: SolidKind, primitives: &[Primitive], precision: Precision, last: Option<&Order>) {
        let frame = self.frame;
        let is_counted = |(_, primitive): &(u32, &Primitive)| {
            // Below that, squares leave the kernel's range; against the scene it is nothing that a pixel could show.
            let reach = BoundingSphere::of(&primitive.solid).radius * frame.scale;
            primitive.solid.kind() == kind && reach >= precision.smallest_length()
        };
        let primitives: Vec<_> = (0_u32..).zip(primitives).filter(is_counted).collect();
        let bounds: Vec<_> = primitives.par_iter().map(|(_, primitive)| Bounds::of(&primitive.solid, frame)).collect();
        let (order, bounds, levels) = ordered(bounds, last);
        let ordered = || order.places.par_iter().map(|&place| primitives[place as usize]);

        let first_slot = (self.materials.len() / self.material_rows) as u32;
        for (slot, (primitive, _)) in (first_slot..).zip(order.places.iter().map(|&place| primitives[place as usize])) {
            self.slots[primitive as usize] = slot;
        }
        self.counts[kind as usize] = bounds.len() as u32;
        self.levels[kind as usize] = levels.len() as u32;
        self.first_proxies[kind as usize] = self.proxies.len() as u32;
        self.proxies.par_extend(
            ordered().zip(&bounds).flat_map_iter(|((_, primitive), bounds)| proxy(&primitive.solid, *bounds, frame)),
        );
        let missing = bounds.len().next_multiple_of(GROUP) - bounds.len();
        self.proxies.extend(std::iter::repeat_n(nothing(kind), missing).flatten());
        for (height, level) in (1..).zip(&levels) {
            self.proxies.extend(level_rows(level, height, frame));
        }
        self.are_boxes_axis_aligned &= !ordered().any(|(_, primitive)| is_rotated(&primitive.solid));
        let rows = &mut self.rows[kind as usize];
        rows.par_extend(ordered().flat_map_iter(|(_, primitive)| solid_rows(&primitive.solid, frame, precision)));
        let material_rows = self.material_rows;
        self.materials.par_extend(ordered().flat_map_iter(|(index, Primitive { material, solid, .. })| {
            material_rows_of(material, index, solid).into_iter().take(material_rows)
        }));
        // Slots of nothing make the group whole.
        rows.extend(vec![[0.0; 4]; missing * solid_row_count(kind, frame.is_close_up)]);
        self.materials.extend(vec![[0.0; 4]; missing * self.material_rows]);
        self.orders[kind as usize] = order;
    }
}

/// The last order or, where that does not fit, a new one; with the bounds in it and the levels over them.
fn ordered(bounds: Vec<Bounds>, last: Option<&Order>) -> (Order, Vec<Bounds>, Vec<Level>) {
    let built = |places: Vec<u32>| {
        let ordered: Vec<_> = places.par_iter().map(|&place| bounds[place as usize]).collect();
        let levels = hierarchy::levels(&ordered);
        let surface: f64 = levels.iter().flat_map(|level| &level.boxes).map(half_surface).sum();
        (Order { places, surface }, ordered, levels)
    };
    if hierarchy::level_count(bounds.len()) == 0 {
        return built((0..bounds.len() as u32).collect());
    }
    if let Some(last) = last.filter(|last| last.places.len() == bounds.len()) {
        let (order, bounds, levels) = built(last.places.clone());
        if order.surface <= MOST_SURFACE * last.surface {
            // Its measure stays that of when it was chosen, or it would get worse step by step.
            return (Order { surface: last.surface, ..order }, bounds, levels);
        }
    }
    built(hierarchy::order(&bounds))
}

fn half_surface(bounds: &Bounds) -> f64 {
    let side = bounds.high - bounds.low;
    side.x * side.y + side.y * side.z + side.z * side.x
}

/// `Sphere`, `Box`, `Cylinder` or `Cone`.
fn solid_rows(solid: &Solid, frame: SceneSpace, precision: Precision) -> Vec<[f64; 4]> {
    let scale = frame.scale;
    match *solid {
        Solid::Sphere { center, radius } if frame.is_close_up => {
            let SphereNearby { anchor, curve } = SphereNearby::of(frame.point(center), radius * scale);
            let (slope, slope_error) = precision.split((curve.slope, DVec3::ZERO));
            vec![row(anchor, radius * scale), row(slope, curve.offset), row(slope_error, 0.0)]
        }
        Solid::Sphere { center, radius } => vec![row(frame.point(center), radius * scale)],
        Solid::Box { center, half_size, rotation_degrees } => {
            let axes = world_from_box(rotation_degrees);
            let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| precision.split((axis, DVec3::ZERO)));
            let half_size = half_size * scale;
            let center = frame.point(center);
            let (anchor, low, high) = if frame.is_close_up {
                let BoxNearby { anchor, low, high } = BoxNearby::of(center, half_size, axes);
                (anchor, low, high)
            } else {
                (center, DVec3::ZERO, half_size)
            };
            vec![
                row(anchor, half_size.max_element()),
                row(x.0, high.x),
                row(y.0, high.y),
                row(z.0, high.z),
                row(x.1, low.x),
                row(y.1, low.y),
                row(z.1, low.z),
            ]
        }
        Solid::Cylinder { ends: [a, b], radius } => {
            let (half_a, half_b) = (frame.point(a) * 0.5, frame.point(b) * 0.5);
            let (center, center_error) = precision.split(two_sum(half_a, half_b));
            let half_axis = two_sum(half_b, -half_a);
            let half_length = half_axis.0.length();
            let (axis, axis_error) = precision.split(unit(half_axis));
            let radius = radius * scale;
            if frame.is_close_up {
                let nearby = CylinderNearby::of(half_a + half_b, unit(half_axis).0, radius, half_length);
                let CylinderNearby { anchor, low, high, curve, reach } = nearby;
                let (slope, slope_error) = precision.split((curve.slope, DVec3::ZERO));
                return vec![
                    row(anchor, radius),
                    row(slope, high),
                    row(axis, low),
                    row(axis_error, reach),
                    row(slope_error, curve.offset),
                ];
            }
            vec![
                row(center, radius),
                row(center_error, half_length),
                row(axis, radius.max(half_length)),
                row(axis_error, radius.hypot(half_length)),
            ]
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let (sine, cosine) = half_angle_degrees.to_radians().sin_cos();
            let (axis, axis_error) = precision.split(unit((axis, DVec3::ZERO)));
            let height = height * scale;
            let base_radius = height * sine / cosine;
            vec![
                row(frame.point(apex), height),
                row(axis, height.max(base_radius)),
                row(axis_error, height.hypot(base_radius)),
                [sine, cosine, 0.0, 0.0],
            ]
        }
    }
}

/// `Material`; its last row is there only where some scene's material needs it.
fn material_rows_of(material: &Material, primitive: u32, solid: &Solid) -> [[f64; 4]; 3] {
    let refractive_index = if solid.is_plate() { 0.0 } else { material.refractive_index };
    [
        row(material.color, material.ambient),
        [material.diffuse, material.specular, f64::from(primitive), material.reflection()],
        [f64::from(material.shininess_256()), material.transmission, refractive_index, 0.0],
    ]
}

/// `Light`; its last row is there only where some light fades with distance.
fn light_rows(light: &Light, frame: SceneSpace) -> [[f64; 4]; 3] {
    let (position, radius) = frame.light(light);
    [row(position, radius), row(light.intensity, 0.0), row(light.fading(frame.scale), 0.0)]
}

/// `View`
fn view(
    scene: &Scene,
    may_be_in_medium: bool,
    frame: SceneSpace,
    precision: Precision,
    [width, height]: [u32; 2],
) -> [[f64; 4]; VIEW_ROWS] {
    let Camera { position, direction, up, vertical_fov_degrees, projection } = scene.camera;
    let (position, position_error) = precision.split(frame.exact_point(position));
    let unit = |vector| unit((vector, DVec3::ZERO)).0;
    let ahead = unit(direction);
    let left = unit(unit(up).cross(ahead));
    let half_height = (vertical_fov_degrees.to_radians() / 2.0).tan();
    let half_width = half_height * f64::from(width) / f64::from(height);
    let window_low = match projection {
        Projection::Centered => 0.0,
        Projection::Course => -1.0,
    };
    [
        row(left, half_width),
        row(ahead.cross(left), half_height),
        row(ahead, window_low),
        row(scene.background, 0.0),
        row(position, f64::from(u8::from(may_be_in_medium))),
        row(position_error, 0.0),
        row(scene.ambient_light, 0.0),
    ]
}

/// `WhittedPushConstants`: the push constants.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct WhittedPushConstants {
    /// Spheres, boxes, cylinders, cones.
    pub counts: [u32; 4],
    /// Where their proxies begin, rows.
    pub first_proxies: [u32; 4],
    /// Pixels, x | y << 16.
    pub tile_origin: u32,
    /// Pixels, width | height << 16.
    pub image_size: u32,
    /// Generations to trace.
    pub depth: u32,
    /// Lights that give any light; those that give none follow them.
    pub light_count: u32,
    /// Half of the largest coordinate of a solid or of a ray's origin, kernel lengths.
    pub reach: f32,
    /// Not 0: the picture is what each colour loses by rounding to `f32`.
    pub writes_remainder: u32,
    /// [`Approximations::min_throughput`](crate::plan::Approximations).
    pub min_throughput: f32,
    /// [`Approximations::min_shadowed`](crate::plan::Approximations).
    pub min_shadowed: f32,
    /// In the pixel, sub-pixels from its top left.
    pub sample_place: [u32; 2],
    /// Samples of each pixel that the picture is the mean of.
    pub samples_before: u32,
    /// Weight of this sample in the mean.
    pub sample_weight: f32,
    /// Pixels, width | height << 16.
    pub tile_size: u32,
    /// Number of all lights.
    pub light_sphere_count: u32,
    /// Of the random numbers of path tracing.
    pub seed: u32,
    /// Samples of a pixel in one run of path tracing.
    pub samples_at_once: u32,
    /// The block's vectors of four numbers align it.
    pub padding: [u32; 2],
}

impl WhittedPushConstants {
    /// For the run with this index, where pixels have several: one sample each, through a fixed place of the pixel.
    pub(super) fn at_sample(self, index: u32) -> Self {
        let sample_weight = 1.0 / (index + 1) as f32;
        Self { sample_place: sample_place(index), samples_before: index, sample_weight, ..self }
    }

    /// The same of path tracing.
    pub(super) fn at_run(self, index: u32) -> Self {
        let samples_before = self.samples_before + index * self.samples_at_once;
        Self { samples_before, sample_weight: 1.0 / (index + 1) as f32, ..self }
    }
}
