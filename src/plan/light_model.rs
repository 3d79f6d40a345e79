//! Which parts of the light model a scene has beyond the course work's.

use glam::DVec3;
use rayon::prelude::*;

use super::solids::{outside_by, size};
use super::{Decision, Line, Reason};
use crate::scene::{Bounds, Material, Primitive, Scene, SceneSpace, Solid};

/// What of the light model is compiled in.
#[derive(Debug, Clone, PartialEq)]
pub struct LightModel {
    /// Whether a highlight has another exponent than the course work's.
    pub shininess: Decision<bool>,
    /// Whether a light fades with distance.
    pub attenuation: Decision<bool>,
    /// Whether the ambient light is not white of 1.
    pub ambient_light: Decision<bool>,
    /// What lets light through.
    pub media: Decision<Media>,
}

/// What lets light through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Media {
    /// Nothing.
    #[default]
    None,
    /// Solids that touch no others, and do not hold the camera: what is outside of them is empty.
    Apart,
    /// Solids that may touch others, or hold the camera.
    Nested,
}

impl LightModel {
    /// In the order in which a ray meets them.
    pub(super) fn lines(&self) -> [Line; 4] {
        let Self { shininess, attenuation, ambient_light, media } = self;
        let line = |what, decision: &Decision<bool>, saves| {
            let saves = (!decision.choice).then_some(saves);
            Line::new(what, if decision.choice { "yes" } else { "none" }, decision, saves)
        };
        let refraction = match media.choice {
            Media::None => "none",
            Media::Apart => "yes",
            Media::Nested => "yes, nested",
        };
        let saved = match media.choice {
            Media::None => Some("the refracted rays, and those that wait"),
            Media::Apart => Some("a search for what is outside of a solid that a ray leaves"),
            Media::Nested => None,
        };
        [
            line("own exponents", shininess, "powers by squares and square roots"),
            line("attenuation", attenuation, "a division for every light at every hit"),
            line("ambient light", ambient_light, "its product with every material"),
            Line::new("refraction", refraction, media, saved),
        ]
    }

    /// `features`: the scene's.
    pub(super) fn decide(scene: &Scene, features: LightFeatures, generations: u32) -> Self {
        let LightFeatures { shininess, attenuation, ambient_light, media } = features;
        let fading = scene.lights.iter().filter(|light| light.distance_constant.is_some()).count();
        let solids = scene.primitives.iter().filter(|primitive| primitive.material.transmission > 0.0).count();
        let of = |choice, yes, no| Decision { choice, reason: if choice { yes } else { no } };
        let media_reason = match media {
            Media::None => Reason::NothingTransmits,
            Media::Nested if generations == 1 => Reason::NothingIsRefracted,
            Media::Apart => Reason::MediaLieApart { solids },
            Media::Nested => Reason::MediaMayTouch { solids },
        };
        let media = media.seen_by(generations);
        Self {
            shininess: of(shininess, Reason::OwnExponents, Reason::ExponentIsFive),
            attenuation: of(attenuation, Reason::LightsFade { lights: fading }, Reason::NoLightFades),
            ambient_light: of(ambient_light, Reason::AmbientLightIsColored, Reason::AmbientLightIsWhite),
            media: Decision { choice: media, reason: media_reason },
        }
    }
}

/// What kernels are compiled for of the light model, and what rows their records have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LightFeatures {
    /// Some specular material has another exponent than the course work's.
    pub shininess: bool,
    /// Some light fades with distance.
    pub attenuation: bool,
    /// The ambient light is not white of 1.
    pub ambient_light: bool,
    /// What lets light through.
    pub media: Media,
}

impl LightFeatures {
    /// Those that a scene asks for.
    pub fn of(scene: &Scene) -> Self {
        Self::of_primitives(&scene.primitives).in_scene(scene)
    }

    /// Those that primitives ask for by themselves: they stay as long as these do. Takes time by the number of
    /// primitives, times that of the transparent ones.
    pub(crate) fn of_primitives(primitives: &[Primitive]) -> Self {
        let has_own_shininess = |primitive: &Primitive| {
            let Primitive { material, .. } = primitive;
            material.specular > 0.0 && material.shininess_256() != COURSE_SHININESS_256
        };
        Self { shininess: primitives.par_iter().any(has_own_shininess), media: media(primitives), ..Self::default() }
    }

    /// Of these primitives' features, all of a scene with them.
    pub(crate) fn in_scene(self, scene: &Scene) -> Self {
        Self {
            attenuation: scene.lights.iter().any(|light| light.distance_constant.is_some()),
            ambient_light: scene.ambient_light != DVec3::ONE,
            media: if self.media == Media::Apart && may_be_in_a_solid(scene) { Media::Nested } else { self.media },
            ..self
        }
    }

    /// Rows of a material's record.
    pub(crate) fn material_rows(self) -> usize {
        if self.shininess || self.media != Media::None { 3 } else { 2 }
    }

    /// Rows of a light's record.
    pub(crate) fn light_rows(self) -> usize {
        if self.attenuation { 3 } else { 2 }
    }
}

const COURSE_SHININESS_256: u32 = (Material::COURSE_SHININESS * 256.0) as u32;

impl Media {
    /// For paths of so many generations: those of one ask for nothing outside.
    pub(crate) fn seen_by(self, generations: u32) -> Self {
        if generations == 1 { self.min(Self::Apart) } else { self }
    }
}

/// Pairs of solids that are looked at, at most: more take longer than what that saves.
const MOST_PAIRS: usize = 1 << 22;

fn media(primitives: &[Primitive]) -> Media {
    let lets_through = |index: &usize| primitives[*index].material.transmission > 0.0;
    let transparent: Vec<usize> = (0..primitives.len()).filter(lets_through).collect();
    if transparent.is_empty() {
        return Media::None;
    }
    if transparent.len().saturating_mul(primitives.len()) > MOST_PAIRS {
        return Media::Nested;
    }
    let world = SceneSpace::world(1.0);
    let bounds: Vec<Bounds> = primitives.par_iter().map(|primitive| Bounds::of(&primitive.solid, world)).collect();
    let is_alone = |&index: &usize| {
        !bounds.iter().enumerate().any(|(other, around)| other != index && around.touches(&bounds[index]))
    };
    if transparent.par_iter().all(is_alone) { Media::Apart } else { Media::Nested }
}

/// Whether the camera may be in a solid; then a primary ray has to find out what it begins in.
pub(crate) fn may_be_in_a_solid(scene: &Scene) -> bool {
    let camera = scene.camera.position;
    // Kernels take an origin within 8u of size and position for inside: 5e-7 in f32.
    const SURELY: f64 = 1e-5;
    let may_hold = |solid: &Solid| {
        let place = camera.abs().max_element().max((camera - solid.position()).length());
        outside_by(solid, camera) <= SURELY * (size(solid) + place)
    };
    scene.primitives.par_iter().any(|primitive| may_hold(&primitive.solid))
}
