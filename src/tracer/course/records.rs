//! `repr(C)` mirrors of `glsl/course/interface.glsl`, filled from a scene. Vulkan's layout rules put a `vec3` on 16
//! bytes and let the next scalar follow it at 12; the `_pad` fields are the gaps. tests/kernels/record_layout.rs proves
//! both sides alike.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat3, Vec3};

use crate::scene::{Camera, Light, Material, Projection, Scene, Solid, world_from_box};

/// `Material`
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct MaterialRecord {
    /// Linear RGB.
    pub color: [f32; 3],
    /// Gap of the layout, 0.
    pub _pad0: u32,
    /// Ambient, diffuse and specular.
    pub coefficients: [f32; 3],
    /// Gap of the layout, 0.
    pub _pad1: u32,
}

/// `Sphere`
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct SphereRecord {
    /// World frame.
    pub center: [f32; 3],
    /// World lengths.
    pub radius: f32,
    /// Material of the whole surface.
    pub material: MaterialRecord,
}

/// `Box`
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct BoxRecord {
    /// Centre, world frame.
    pub position: [f32; 3],
    /// Gap of the layout, 0.
    pub _pad0: u32,
    /// Halves of the edges, world lengths.
    pub half_size: [f32; 3],
    /// Gap of the layout, 0.
    pub _pad1: u32,
    /// Columns, each padded to 16 bytes.
    pub box_from_world: [[f32; 4]; 3],
    /// Material of the whole surface.
    pub material: MaterialRecord,
}

/// `Cylinder`
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct CylinderRecord {
    /// Centre of a base, world frame.
    pub end_a: [f32; 3],
    /// Gap of the layout, 0.
    pub _pad0: u32,
    /// Centre of the other base, world frame.
    pub end_b: [f32; 3],
    /// World lengths.
    pub radius: f32,
    /// Material of the whole surface.
    pub material: MaterialRecord,
}

/// `Cone`
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct ConeRecord {
    /// World frame.
    pub apex: [f32; 3],
    /// Cosine of the angle between axis and side.
    pub half_angle_cosine: f32,
    /// Unit vector from the apex to the base, world frame.
    pub axis: [f32; 3],
    /// From the apex to the base, world lengths.
    pub height: f32,
    /// Material of the whole surface.
    pub material: MaterialRecord,
}

/// `LightSource`
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct LightRecord {
    /// World frame.
    pub position: [f32; 3],
    /// Gap of the layout, 0.
    pub _pad0: u32,
    /// Linear RGB.
    pub intensity: [f32; 3],
    /// Gap of the layout, 0.
    pub _pad1: u32,
}

/// `Frame`: the push constants.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct CoursePushConstants {
    /// World frame.
    pub camera_position: [f32; 3],
    /// Pixels, x | y << 16.
    pub tile_origin: u32,
    /// Unit vector to the left of the picture, world frame.
    pub camera_s: [f32; 3],
    /// Pixels, width | height << 16.
    pub image_size: u32,
    /// Unit vector up, world frame.
    pub camera_u: [f32; 3],
    /// Generations to trace.
    pub depth: i32,
    /// Unit vector against the viewing direction, world frame.
    pub camera_f: [f32; 3],
    /// −1: the course's window [−3,1]²; 0: the centred window [−1,1]².
    pub window_low: f32,
    /// The only light of the course kernel.
    pub light: LightRecord,
    /// Linear RGB.
    pub background: [f32; 3],
    /// Spheres, boxes, cylinders, cones.
    pub counts: [i32; 4],
    /// Tangent of half the vertical field of view.
    pub half_fov_tangent: f32,
}

const _: () = {
    assert!(size_of::<MaterialRecord>() == 32);
    assert!(size_of::<SphereRecord>() == 48);
    assert!(size_of::<BoxRecord>() == 112);
    assert!(size_of::<CylinderRecord>() == 64);
    assert!(size_of::<ConeRecord>() == 64);
    assert!(std::mem::offset_of!(CoursePushConstants, light) == 64);
    assert!(std::mem::offset_of!(CoursePushConstants, counts) == 108);
    assert!(size_of::<CoursePushConstants>() == 128);
};

/// The records of all primitives, by kind, each kind in file order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PrimitiveRecords {
    /// In the order of the scene's file.
    pub spheres: Vec<SphereRecord>,
    /// In the order of the scene's file.
    pub boxes: Vec<BoxRecord>,
    /// In the order of the scene's file.
    pub cylinders: Vec<CylinderRecord>,
    /// In the order of the scene's file.
    pub cones: Vec<ConeRecord>,
}

impl PrimitiveRecords {
    /// Records of a scene's primitives, rounded to `f32`.
    pub fn of(scene: &Scene) -> Self {
        let mut records = Self::default();
        for primitive in &scene.primitives {
            let material = MaterialRecord::of(&primitive.material);
            match primitive.solid {
                Solid::Sphere { center, radius } => {
                    records.spheres.push(SphereRecord { center: narrow(center), radius: radius as f32, material });
                }
                Solid::Box { center, half_size, rotation_degrees } => records.boxes.push(BoxRecord {
                    position: narrow(center),
                    _pad0: 0,
                    half_size: narrow(half_size),
                    _pad1: 0,
                    box_from_world: padded_columns(box_from_world(rotation_degrees)),
                    material,
                }),
                Solid::Cylinder { ends: [a, b], radius } => records.cylinders.push(CylinderRecord {
                    end_a: narrow(a),
                    _pad0: 0,
                    end_b: narrow(b),
                    radius: radius as f32,
                    material,
                }),
                Solid::Cone { apex, axis, height, half_angle_degrees } => records.cones.push(ConeRecord {
                    apex: narrow(apex),
                    half_angle_cosine: half_angle_degrees.to_radians().cos() as f32,
                    axis: narrow(axis),
                    height: height as f32,
                    material,
                }),
            }
        }
        records
    }

    /// The bytes of each kind's array, with the bytes of one record.
    pub(super) fn arrays(&self) -> [(&[u8], usize); 4] {
        [
            (bytemuck::cast_slice(&self.spheres), size_of::<SphereRecord>()),
            (bytemuck::cast_slice(&self.boxes), size_of::<BoxRecord>()),
            (bytemuck::cast_slice(&self.cylinders), size_of::<CylinderRecord>()),
            (bytemuck::cast_slice(&self.cones), size_of::<ConeRecord>()),
        ]
    }

    /// Spheres, boxes, cylinders, cones.
    pub fn counts(&self) -> [i32; 4] {
        [self.spheres.len(), self.boxes.len(), self.cylinders.len(), self.cones.len()].map(|count| count as i32)
    }
}

impl MaterialRecord {
    fn of(material: &Material) -> Self {
        let coefficients = DVec3::new(material.ambient, material.diffuse, material.specular);
        Self { color: narrow(material.color), _pad0: 0, coefficients: narrow(coefficients), _pad1: 0 }
    }
}

impl LightRecord {
    fn of(light: &Light) -> Self {
        Self { position: narrow(light.position), _pad0: 0, intensity: narrow(light.intensity), _pad1: 0 }
    }
}

impl CoursePushConstants {
    /// The record of a whole picture of `width`×`height` pixels, for tiles to set their origin in.
    pub fn new(scene: &Scene, light: &Light, counts: [i32; 4], depth: u32, width: u32, height: u32) -> Self {
        let basis = CameraBasis::of(&scene.camera);
        Self {
            camera_position: narrow(scene.camera.position),
            tile_origin: packed(0, 0),
            camera_s: basis.s.to_array(),
            image_size: packed(width, height),
            camera_u: basis.u.to_array(),
            depth: depth as i32,
            camera_f: basis.f.to_array(),
            window_low: match scene.camera.projection {
                Projection::Centered => 0.0,
                Projection::Course => -1.0,
            },
            light: LightRecord::of(light),
            background: narrow(scene.background),
            counts,
            half_fov_tangent: (scene.camera.vertical_fov_degrees.to_radians() / 2.0).tan() as f32,
        }
    }

    /// The record of the tile whose first pixel is this.
    pub(super) fn at_tile(mut self, x: u32, y: u32) -> Self {
        self.tile_origin = packed(x, y);
        self
    }
}

/// The course's camera frame: unit vectors to the left, up and backwards; in the shader's own precision and order of
/// operations, since the course computed it there.
struct CameraBasis {
    s: Vec3,
    u: Vec3,
    f: Vec3,
}

impl CameraBasis {
    fn of(camera: &Camera) -> Self {
        let unit = |v: Vec3| v * (1.0 / (v.z * v.z + v.y * v.y + v.x * v.x).sqrt());
        let f = -unit(camera.direction.normalize().as_vec3());
        let s = unit(f.cross(camera.up.as_vec3()));
        Self { s, u: s.cross(f), f }
    }
}

/// The transpose of `world_from_box`, multiplied in `f32` as the course did.
fn box_from_world(degrees: DVec3) -> Mat3 {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| world_from_box(degrees * axis).as_mat3());
    (x * y * z).transpose()
}

fn padded_columns(matrix: Mat3) -> [[f32; 4]; 3] {
    [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column| column.extend(0.0).to_array())
}

fn narrow(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

/// Two numbers below 2¹⁶ in one word.
fn packed(low: u32, high: u32) -> u32 {
    low | high << 16
}
