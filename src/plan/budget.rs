//! What an allowed error buys (docs/light-model.md, "What an allowed error leaves out").
//!
//! A pixel is Σ T·E over the generations of its rays, T being the product of the weights met before. Three things may
//! be left out of it, each for a part of the allowed error, and the parts add up: none of them turns a ray, so one cut
//! leaves the weights and the bounds of the others as they are. Where sums are clamped at the largest number, errors
//! only shrink, for a clamp brings no two numbers farther apart.
//!
//! The bounds are on the change of each linear channel of a pixel against the same kernel without cuts.

use std::collections::HashSet;

use glam::DVec3;
use serde::Serialize;

use super::Precision;
use super::ceiling::{Surface, ceilings};
use crate::scene::{Material, Scene};

/// What a kernel leaves out. The numbers are `f32` for kernels of either precision.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Approximations {
    /// A path ends as soon as its weight is not above that; below 1.
    #[serde(rename = "least_weight")]
    pub min_throughput: f32,
    /// No shadow ray is traced for light whose channels, times the path's weight, are all at most that; half of such
    /// light counts, so that the error is at most half of it whether a solid is in the way or not.
    #[serde(rename = "least_shadowed")]
    pub min_shadowed: f32,
    /// Whether there are highlights.
    pub highlights: bool,
    /// Whether the camera may see light spheres.
    #[serde(rename = "balls")]
    pub light_spheres: bool,
    /// Whether there is light that brightens anything.
    pub lights: bool,
    /// Whether solids may hide lights.
    pub shadows: bool,
    /// Whether anything is reflected.
    pub reflections: bool,
}

impl Approximations {
    /// An exact picture.
    pub const NONE: Self = Self {
        min_throughput: 0.0,
        min_shadowed: 0.0,
        highlights: true,
        light_spheres: true,
        lights: true,
        shadows: true,
        reflections: true,
    };
}

/// The largest change of a linear channel by each cut.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Bounds {
    /// By leaving out all highlights.
    pub highlights: f64,
    /// By ending paths at [`Approximations::min_throughput`].
    pub generations: f64,
    /// By tracing no shadow rays below [`Approximations::min_shadowed`].
    pub shadows: f64,
}

impl Bounds {
    /// By all cuts together.
    pub fn total(&self) -> f64 {
        self.highlights + self.generations + self.shadows
    }
}

/// What light there is in a scene and what becomes of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Transport {
    background: DVec3,
    ambient_light: DVec3,
    /// Most that reaches a point from each light that gives any, linear RGB.
    intensities: Vec<DVec3>,
    /// Each once.
    materials: Vec<Material>,
}

impl Transport {
    pub fn of(scene: &Scene) -> Self {
        let mut seen = HashSet::new();
        let mut is_new = |material: &Material| {
            let Material {
                color,
                ambient,
                diffuse,
                specular,
                reflection: _,
                shininess,
                transmission,
                refractive_index,
            } = *material;
            let weights = [ambient, diffuse, specular, material.reflection(), transmission];
            let numbers = color.to_array().into_iter().chain(weights).chain([shininess, refractive_index]);
            seen.insert(numbers.map(f64::to_bits).collect::<Vec<_>>())
        };
        let materials = scene.primitives.iter().map(|primitive| &primitive.material);
        // At no distance, the light is divided by the constant alone.
        let intensities = scene.lights.iter().map(|light| light.intensity / light.distance_constant.unwrap_or(1.0));
        Self {
            background: scene.background,
            ambient_light: scene.ambient_light,
            intensities: intensities.filter(|&intensity| intensity != DVec3::ZERO).collect(),
            materials: materials.filter(|material| is_new(material)).cloned().collect(),
        }
    }

    /// Whether any light can brighten any surface in any channel.
    pub fn has_light_that_matters(&self) -> bool {
        let received = self.most_received(true);
        self.intensities.iter().any(|&intensity| received * intensity != DVec3::ZERO)
    }

    /// Whether any surface shows highlights, if it is lit.
    pub fn has_specular(&self) -> bool {
        self.materials.iter().any(|material| material.specular > 0.0)
    }

    /// Whether any surface lets light through.
    pub fn has_transmission(&self) -> bool {
        self.materials.iter().any(|material| material.transmission > 0.0)
    }

    /// The most that the rays of the next generation weigh together.
    pub fn largest_gain(&self) -> f64 {
        self.materials.iter().map(gain).fold(0.0, f64::max)
    }

    fn largest_shininess(&self) -> f64 {
        self.materials.iter().map(|material| material.shininess).fold(1.0, f64::max)
    }

    /// No ray of `depth` generations is brighter in any channel.
    pub fn ceiling(&self, depth: u32) -> f64 {
        self.ceilings(depth, true)[depth as usize].max_element()
    }

    /// The least that a ray of the next generation weighs; 1 where there is none.
    fn least_weight(&self) -> f64 {
        let weights = self.materials.iter().flat_map(|material| [material.reflection(), material.transmission]);
        weights.filter(|&weight| weight > 0.0).fold(1.0, f64::min)
    }

    /// The largest factor between a light's intensity and what a surface sends back of it: kd·C + ks.
    fn most_received(&self, highlights: bool) -> DVec3 {
        self.materials.iter().map(|material| received(material, highlights)).fold(DVec3::ZERO, DVec3::max)
    }

    fn ceilings(&self, depth: u32, highlights: bool) -> Vec<DVec3> {
        let intensity: DVec3 = self.intensities.iter().sum();
        let surface = |material: &Material| Surface {
            gain: gain(material),
            local_radiance: material.ambient * material.color * self.ambient_light
                + received(material, highlights) * intensity,
        };
        ceilings(self.background, &self.materials.iter().map(surface).collect::<Vec<_>>(), depth)
    }

    /// The most that all highlights on a path add.
    fn highlight_ceiling(&self, depth: u32) -> f64 {
        let intensity: DVec3 = self.intensities.iter().sum();
        let surface =
            |material: &Material| Surface { gain: gain(material), local_radiance: material.specular * intensity };
        let surfaces: Vec<_> = self.materials.iter().map(surface).collect();
        ceilings(DVec3::ZERO, &surfaces, depth)[depth as usize].max_element()
    }
}

/// What the mirrored and the refracted ray weigh together.
fn gain(material: &Material) -> f64 {
    material.reflection() + material.transmission
}

/// kd·C + ks, or without highlights kd·C.
fn received(material: &Material, highlights: bool) -> DVec3 {
    material.diffuse * material.color + if highlights { material.specular } else { 0.0 }
}

/// Part of the allowed error for which highlights go, if they all fit in it: they are cheap, and sharp to the eye.
const HIGHLIGHTS_SHARE: f64 = 0.25;

/// Part of the rest for generations where both they and shadow rays can be cut. A halved budget costs a generation or
/// two of many; a doubled one saves shadow rays of faint light only.
const GENERATIONS_SHARE: f64 = 0.75;

/// An allowed error, spent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spent {
    pub approximations: Approximations,
    pub bounds: Bounds,
    /// No path has a weight above `Approximations::min_throughput` after so many generations.
    pub generations: u32,
}

/// Approximations whose bounds add up to at most `error`, for paths of `depth` generations at most.
pub(super) fn spend(
    transport: &Transport,
    error: f64,
    depth: u32,
    precision: Precision,
    traces_shadow_rays: bool,
    has_highlights: bool,
) -> Spent {
    let exact = Approximations { highlights: has_highlights, ..Approximations::NONE };
    let mut spent = Spent { approximations: exact, bounds: Bounds::default(), generations: depth };
    if error == 0.0 {
        return spent;
    }
    let slack = 1.0 + rounding_slack(transport, depth, precision);
    // In the numbers of the model; with the kernel's rounding, and that of the few sums here, it is `error`.
    let mut left = error * (1.0 - 16.0 * f64::EPSILON) / slack;

    if has_highlights {
        let bound = transport.highlight_ceiling(depth);
        if bound <= HIGHLIGHTS_SHARE * left {
            spent.approximations.highlights = false;
            spent.bounds.highlights = bound * slack;
            left -= bound;
        }
    }

    let for_generations = if traces_shadow_rays { GENERATIONS_SHARE * left } else { left };
    if let Some(cut) = cut_generations(transport, for_generations, depth, spent.approximations.highlights) {
        // The kernel's weight may be smaller than the true one by the slack.
        let min_throughput = rounded_down(cut.weight / slack);
        if min_throughput > 0.0 {
            spent.approximations.min_throughput = min_throughput;
            spent.bounds.generations = cut.bound * slack;
            spent.generations = cut.generations;
            left -= cut.bound;
        }
    }

    if traces_shadow_rays {
        let shadows = Shadows::new(transport, spent.generations, spent.approximations.highlights);
        let min_shadowed = rounded_down(shadows.least_within(left));
        spent.approximations.min_shadowed = min_shadowed;
        spent.bounds.shadows = shadows.bound(f64::from(min_shadowed)) * slack;
    }
    spent
}

/// How much a kernel's numbers may exceed the model's, relatively: a weight is rounded twice a generation (the stored
/// reflection or transmission, the product), and what a light sends is a sum over lights of products of a few factors,
/// among them a cosine that is off by some 8u, raised to the highlight's exponent.
fn rounding_slack(transport: &Transport, depth: u32, precision: Precision) -> f64 {
    let of_highlight = 8.0 * transport.largest_shininess();
    (4.0 * f64::from(depth) + transport.intensities.len() as f64 + 32.0 + of_highlight) * precision.unit_roundoff()
}

/// The largest `f32` that is not above and a normal number, or 0.
fn rounded_down(value: f64) -> f32 {
    let nearest = value.min(f64::from(f32::MAX)) as f32;
    let below = if f64::from(nearest) > value { nearest.next_down() } else { nearest };
    if below < f32::MIN_POSITIVE { 0.0 } else { below }
}

/// Where paths end.
struct GenerationCut {
    /// As soon as they weigh no more than that.
    weight: f64,
    bound: f64,
    /// None is longer.
    generations: u32,
}

/// The largest weight τ for whose sake no pixel loses more than `error`; None where no path gets light enough.
///
/// With k the least weight of a ray of the next generation and K the largest gain, a path's weight after m hits is from
/// kᵐ to Kᵐ. So where τ < kᵐ⁻¹ none is cut before it has met m surfaces: it weighs at most min(τ, Kᵐ) then, and has
/// `depth` − m generations to go, whose ceiling is known.
///
/// Where surfaces refract, a pixel has many paths. Those cut lie on different branches, so that together they weigh no
/// more than all of generation m, Kᵐ, or, where K is above 1, all of the last one.
fn cut_generations(transport: &Transport, error: f64, depth: u32, highlights: bool) -> Option<GenerationCut> {
    let (least, largest) = (transport.least_weight(), transport.largest_gain());
    let branches = transport.has_transmission();
    if least == 1.0 || largest == 0.0 {
        return None;
    }
    let ceilings = transport.ceilings(depth, highlights);
    // Below a power by more than its rounding.
    let below = |power: f64| power * (1.0 - 2f64.powi(-20));
    let (mut least_power, mut largest_power) = (1.0, 1.0);
    for hits in 1..depth {
        let uncut_power = below(least_power);
        least_power *= least;
        largest_power *= largest;
        let ceiling = ceilings[(depth - hits) as usize].max_element();
        let together = if branches { largest_power.max(largest.powi(depth as i32 - 1)) } else { largest_power };
        let weight = match together * ceiling <= error {
            true => uncut_power,
            false if branches => 0.0,
            false => uncut_power.min(error / ceiling),
        };
        if weight >= least_power {
            let bound = if branches { together } else { weight.min(largest_power) } * ceiling;
            return Some(GenerationCut { weight, bound, generations: longest(largest, weight, depth) });
        }
    }
    None
}

/// Generations of a path that keeps the largest weight, up to where it is not above `weight`.
fn longest(largest_gain: f64, weight: f64, depth: u32) -> u32 {
    let mut power = 1.0;
    for reflections in 1..depth {
        power *= largest_gain;
        if power <= weight {
            return reflections;
        }
    }
    depth
}

/// What leaving out shadow rays can change.
struct Shadows {
    /// Most that any surface sends back of each light.
    direct: Vec<DVec3>,
    largest_gain: f64,
    /// Whether a path may go on by two rays.
    branches: bool,
    generations: u32,
}

impl Shadows {
    fn new(transport: &Transport, generations: u32, highlights: bool) -> Self {
        let received = transport.most_received(highlights);
        let direct = transport.intensities.iter().map(|&intensity| received * intensity).collect();
        let (largest_gain, branches) = (transport.largest_gain(), transport.has_transmission());
        Self { direct, largest_gain, branches, generations }
    }

    /// ½·Σ min(Nᵍ·ε, Kᵍ·direct) over generations g and lights, N being the rays by which a path may go on: half of each
    /// light's part, which is at most ε where a shadow ray is left out.
    fn bound(&self, min_shadowed: f64) -> f64 {
        let mut sum = DVec3::ZERO;
        let (mut weight, mut paths) = (1.0, 1.0);
        for _ in 0..self.generations {
            let left_out = DVec3::splat(paths * min_shadowed);
            let of_lights = self.direct.iter().map(|&direct| left_out.min(weight * direct));
            sum += of_lights.sum::<DVec3>();
            weight *= self.largest_gain;
            paths *= if self.branches { 2.0 } else { 1.0 };
        }
        0.5 * sum.max_element()
    }

    /// About the largest ε whose bound is within `error`, never above; infinite where all shadows fit.
    fn least_within(&self, error: f64) -> f64 {
        let largest = self.direct.iter().map(|direct| direct.max_element()).fold(0.0, f64::max);
        if self.bound(largest) <= error {
            return f64::INFINITY;
        }
        // The bound is at most ½·ε for each light in each generation of a single path, and at least half of one ε.
        let of_one_path = 2.0 * error / (f64::from(self.generations) * self.direct.len() as f64);
        let mut low = if self.branches { 0.0 } else { of_one_path };
        let mut high = (2.0 * error).min(largest);
        // Rays of many branches make the bound that many times steeper.
        let halvings = if self.branches { HALVINGS + self.generations } else { HALVINGS };
        for _ in 0..halvings {
            let middle = 0.5 * (low + high);
            if self.bound(middle) <= error { low = middle } else { high = middle }
        }
        low
    }
}

/// From a factor of 64 lights times 1000 generations to a thousandth.
const HALVINGS: u32 = 26;
