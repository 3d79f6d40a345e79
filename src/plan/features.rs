//! What a plan has the kernel compiled for.

use rayon::prelude::*;

use super::solids::is_rotated;
use super::{LightFeatures, Media, Plan, Structure};
use crate::algorithm::{Description, Precision};
use crate::scene::{BoundingSphere, Primitive, SceneSpace, SolidKind};
use crate::settings::Numbers;

/// What the accurate kernel is compiled for, apart from its precision and its workgroup: its specialization constants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Features {
    /// Which kinds there are: spheres, boxes, cylinders, cones.
    pub kinds: [bool; 4],
    /// Levels of boxes over the solids of each kind.
    pub levels: [u32; 4],
    /// No box is rotated against the world's axes.
    pub are_boxes_axis_aligned: bool,
    /// The records are those of a close-up.
    pub is_close_up: bool,
    /// Lights leave highlights on specular surfaces.
    pub highlights: bool,
    /// Whose light spheres primary rays may see: none, one, or several (2).
    pub light_spheres: u32,
    /// That brighten: none, one, several (2), or many (3), of which a hit's shadow ray goes to one by chance.
    pub lights: u32,
    /// Shadow rays are traced.
    pub shadows: bool,
    /// Rays have more than one generation.
    pub reflections: bool,
    /// Pixels have more than one sample.
    pub samples: bool,
    /// That an invocation traces, one after another.
    pub pixels: u32,
    /// Parts of the light model beyond the course work's.
    pub light: LightFeatures,
    /// Rays that may wait while a path goes on by another, at most; 1 where none does.
    pub pending: u32,
    /// The random numbers of path tracing know nothing of each other.
    pub independent_numbers: bool,
}

/// The solids that the kernel sees of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kept {
    /// Number of solids of each kind.
    pub counts: [usize; 4],
    pub rotated_boxes: usize,
}

impl Kept {
    /// Without those so small that their squares leave the range of the precision: against the scene they are nothing
    /// that a pixel could show.
    pub fn of(primitives: &[Primitive], precision: Precision, space: &SceneSpace) -> Self {
        let least = precision.smallest_length() / space.scale;
        let is_kept = |primitive: &&Primitive| BoundingSphere::of(&primitive.solid).radius >= least;
        let one = |primitive: &Primitive| {
            let mut counts = [0; 4];
            counts[primitive.solid.kind() as usize] = 1;
            Self { counts, rotated_boxes: usize::from(is_rotated(&primitive.solid)) }
        };
        let none = || Self { counts: [0; 4], rotated_boxes: 0 };
        let sum = |a: Self, b: Self| Self {
            counts: std::array::from_fn(|kind| a.counts[kind] + b.counts[kind]),
            rotated_boxes: a.rotated_boxes + b.rotated_boxes,
        };
        primitives.par_iter().filter(is_kept).map(one).reduce(none, sum)
    }
}

impl Plan {
    /// As the kernel is compiled on a device whose invocations come in packets; on others an invocation has one pixel.
    pub fn features(&self) -> Features {
        let levels = |structure: &Structure| match *structure {
            Structure::None => 0,
            Structure::Hierarchy { levels } => levels,
        };
        Features {
            kinds: SolidKind::ALL.map(|kind| self.counts[kind as usize] > 0),
            levels: self.structures.choice.each_ref().map(levels),
            are_boxes_axis_aligned: self.axis_aligned_boxes.choice,
            is_close_up: self.close_up.is_some(),
            highlights: self.highlights.choice,
            light_spheres: if self.light_spheres.choice > 0 { self.all_lights.min(2) as u32 } else { 0 },
            lights: lights_told_apart(self.kernel.description(), self.lights.choice as u32),
            shadows: self.shadows.choice,
            reflections: self.generations.choice > 1,
            samples: self.settings.samples > 1,
            pixels: self.pixels.choice,
            light: LightFeatures {
                shininess: self.light_model.shininess.choice,
                attenuation: self.light_model.attenuation.choice,
                ambient_light: self.light_model.ambient_light.choice,
                media: self.light_model.media.choice,
            },
            pending: most_pending(self.light_model.media.choice, self.generations.choice),
            independent_numbers: self.settings.numbers == Numbers::Independent,
        }
    }
}

/// From so many lights on, path tracing chooses one a hit: docs/path-tracing.md has the figures.
const MANY_LIGHTS: u32 = 3;

/// What a kernel is compiled for that has so many lights, see [`Features::lights`].
pub(crate) fn lights_told_apart(algorithm: &Description, lights: u32) -> u32 {
    if algorithm.is_statistical && lights >= MANY_LIGHTS { 3 } else { lights.min(2) }
}

/// A path may leave one ray behind in each generation but the last.
pub(crate) fn most_pending(media: Media, generations: u32) -> u32 {
    if media == Media::None { 1 } else { (generations - 1).max(1) }
}
