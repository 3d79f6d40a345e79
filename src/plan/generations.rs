//! How many generations a path goes through.

use glam::DVec3;

use super::budget::{Spent, Transport};
use super::{Decision, Reason};
use crate::scene::{Material, Scene};
use crate::settings::RenderSettings;

/// Those that a picture without an error needs.
pub(super) fn generations(
    scene: &Scene,
    settings: &RenderSettings,
    transport: &Transport,
    is_lone: bool,
) -> Decision<u32> {
    let asked = match settings.max_depth {
        Some(depth) => Decision { choice: depth, reason: Reason::Asked },
        None => Decision { choice: scene.max_depth, reason: Reason::SceneSays },
    };
    let row = settings.algorithm.description();
    if !row.is_specialized {
        return asked;
    }
    // Paths by chance go on from matt surfaces, too, and need no light of a surface's own to bring something back.
    let (goes_on, is_black) = if row.is_statistical {
        (scene.primitives.iter().any(|primitive| gain(&primitive.material) > 0.0), false)
    } else {
        (transport.largest_gain() > 0.0, transport.ceiling(asked.choice) == 0.0)
    };
    let (choice, reason) = if scene.primitives.is_empty() {
        (1, Reason::NoSolids)
    } else if !goes_on {
        (1, if transport.has_specular() { Reason::NothingReflects } else { Reason::NothingIsSpecular })
    } else if is_black || (is_lone && scene.background == DVec3::ZERO) {
        (1, Reason::ReflectionsAreBlack)
    } else if is_lone {
        (2, Reason::LoneSolidMirrorsBackground)
    } else {
        return asked;
    };
    if choice < asked.choice { Decision { choice, reason } } else { asked }
}

/// The most of the light that a surface gets which goes on from it by a path, highlights left aside.
fn gain(material: &Material) -> f64 {
    material.diffuse * material.color.max_element() + material.reflection() + material.transmission
}

/// The first primitive that does not conserve energy, highlights left aside, and by how much.
pub(super) fn energy_gain(scene: &Scene) -> Option<(usize, f64)> {
    let gains = scene.primitives.iter().map(|primitive| gain(&primitive.material));
    // Coefficients that are meant to add up to 1 may be above it by their rounding.
    gains.enumerate().find(|(_, gain)| *gain > 1.0 + 1e-9)
}

/// The generations that the allowed error leaves.
pub(super) fn approximated_generations(exact: Decision<u32>, spent: &Spent) -> Decision<u32> {
    let Spent { approximations, bounds, generations } = *spent;
    if approximations.min_throughput == 0.0 {
        return exact;
    }
    let reason = Reason::PathsFade {
        min_throughput: approximations.min_throughput,
        of: exact.choice,
        bound: bounds.generations,
    };
    Decision { choice: generations, reason }
}
