//! What is drawn: plain `f64` data, validated, without a word of Vulkan.
//!
//! World frame: right-handed, y up, as the course work uses it. Lengths are in world units, angles in degrees
//! (the unit is in the field's name), colours and intensities are linear RGB.

mod animation;
mod bounding_sphere;
mod bounds;
mod camera;
mod close_up;
mod edit;
mod error;
pub mod format;
pub mod gallery;
mod light;
mod material;
mod primitive;
mod scene_space;
mod text;
mod validate;

pub(crate) use animation::fields as animated_fields;
pub use animation::{Interpolation, Keyframe, Part, Track, Value, picture_at};
pub use bounding_sphere::{BoundingSphere, farthest_coordinate};
pub use bounds::Bounds;
pub use camera::{Camera, Projection};
pub(crate) use close_up::{BoxNearby, Curve, CylinderNearby, SphereNearby};
pub(crate) use edit::rotation_of;
pub use edit::{COURSE_PRIMITIVE_LIMIT, TooManyPrimitives, world_from_box};
pub use error::SceneError;
pub use light::Light;
pub use material::Material;
pub use primitive::{Primitive, Solid, SolidKind};
pub use scene_space::SceneSpace;
pub(crate) use scene_space::{Extent, two_sum};
pub use validate::{DEPTH_LIMIT, LIGHT_LIMIT, PRIMITIVE_LIMIT};

use glam::DVec3;

/// Everything a picture depends on but its size, and what changes with time.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Where rays start, world frame.
    pub camera: Camera,
    /// Linear RGB seen where a primary ray meets nothing.
    pub background: DVec3,
    /// I_a of equation 1.19, linear RGB: multiplies every material's ambient part.
    pub ambient_light: DVec3,
    /// Largest number of generations of a ray: 1 is the primary ray alone.
    pub max_depth: u32,
    /// In file order; at most [`LIGHT_LIMIT`].
    pub lights: Vec<Light>,
    /// In file order; a tie between two primitives of one kind goes to the earlier one.
    pub primitives: Vec<Primitive>,
    /// What of all that changes with time; see [`Scene::go_to`].
    pub animation: Vec<Track>,
}

impl Scene {
    /// Whether any material lets light through.
    pub fn has_transmission(&self) -> bool {
        self.primitives.iter().any(|primitive| primitive.material.transmission > 0.0)
    }
}

impl Default for Scene {
    /// The course's start state: its camera, its one light, no primitives.
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            background: DVec3::new(0.1, 0.2, 0.3),
            ambient_light: DVec3::ONE,
            max_depth: 20,
            lights: vec![Light::default()],
            primitives: Vec::new(),
            animation: Vec::new(),
        }
    }
}
