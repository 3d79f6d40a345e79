//! How bright a ray can be at most, channel by channel.

use glam::DVec3;

use crate::scene::Scene;

/// What one kind of hit can send back at most: its own light, and the weight of what it mirrors and lets through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Surface {
    /// Weight of all rays of the next generation together.
    pub gain: f64,
    /// Linear RGB.
    pub local_radiance: DVec3,
}

/// The largest channel of the background and of the lights.
pub(super) fn brightest_source(scene: &Scene) -> f64 {
    let lights = scene.lights.iter().map(|light| light.intensity.max_element());
    lights.fold(scene.background.max_element(), f64::max)
}

/// Vₙ for n = 0…`depth`: no ray of n generations is brighter, in linear RGB.
///
/// V₀ = 0, and Vₙ = max(background, maxₘ(Eₘ + gₘ·Vₙ₋₁)): a ray ends in the background, or meets a surface m and goes
/// on, mirrored and refracted, with a gain of g = reflection + transmission and n − 1 generations left. For one surface
/// that is E·(1 − kⁿ)/(1 − k), or n·E at k = 1; for several it is less than the largest E with the largest k.
pub(super) fn ceilings(background: DVec3, surfaces: &[Surface], depth: u32) -> Vec<DVec3> {
    let mut ceilings = vec![DVec3::ZERO; depth as usize + 1];
    for channel in 0..3 {
        let lines =
            surfaces.iter().map(|surface| Line { slope: surface.gain, height: surface.local_radiance[channel] });
        let lines = highest_lines(lines.collect());
        let mut highest = 0;
        let mut ceiling = 0.0;
        for bound in &mut ceilings[1..] {
            // The ceiling only rises, and steeper lines are the highest farther on.
            while highest + 1 < lines.len() && lines[highest + 1].at(ceiling) >= lines[highest].at(ceiling) {
                highest += 1;
            }
            let reflected = lines.get(highest).map_or(0.0, |line| line.at(ceiling));
            ceiling = f64::max(background[channel], reflected * ROUNDED_UP).min(f64::MAX);
            bound[channel] = ceiling;
        }
    }
    ceilings
}

/// More than the rounding of one step loses: a product, a sum and the choice of the line, some 2⁻⁵³ each.
const ROUNDED_UP: f64 = 1.0 + f64::EPSILON * 16.0;

/// Of what a surface sends back against what comes from its mirror direction.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Line {
    slope: f64,
    height: f64,
}

impl Line {
    fn at(self, x: f64) -> f64 {
        self.height + self.slope * x
    }
}

/// Those that are the highest of all for some x ≥ 0, by rising slope (the upper envelope, by Andrew's monotone chain).
fn highest_lines(mut lines: Vec<Line>) -> Vec<Line> {
    lines.sort_by(|a, b| a.slope.total_cmp(&b.slope).then(a.height.total_cmp(&b.height)));
    let mut envelope: Vec<Line> = Vec::new();
    for line in lines {
        while let Some(&last) = envelope.last() {
            let is_below_from_the_start = last.height <= line.height;
            let is_passed_before_it_leads = envelope.iter().nth_back(1).is_some_and(|before| {
                (before.height - line.height) * (last.slope - before.slope)
                    <= (before.height - last.height) * (line.slope - before.slope)
            });
            if !(is_below_from_the_start || is_passed_before_it_leads) {
                break;
            }
            envelope.pop();
        }
        envelope.push(line);
    }
    envelope
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(gain: f64, local_radiance: f64) -> Surface {
        Surface { gain, local_radiance: DVec3::new(local_radiance, 2.0 * local_radiance, 0.0) }
    }

    fn is_just_above(bound: f64, value: f64) -> bool {
        bound >= value && bound <= value * (1.0 + 1e-11)
    }

    #[test]
    fn one_surface_gives_the_geometric_sum_and_a_perfect_mirror_the_number_of_generations() {
        let half = ceilings(DVec3::ZERO, &[surface(0.5, 3.0)], 1000);
        let perfect = ceilings(DVec3::ZERO, &[surface(1.0, 3.0)], 1000);
        for n in [0, 1, 2, 7, 1000] {
            let sum = 3.0 * (1.0 - 0.5f64.powi(n)) / (1.0 - 0.5);
            assert!(is_just_above(half[n as usize].x, sum) && is_just_above(half[n as usize].y, 2.0 * sum), "{n}");
            assert_eq!(half[n as usize].z, 0.0);
            assert!(is_just_above(perfect[n as usize].x, 3.0 * f64::from(n)), "{n}");
        }
    }

    #[test]
    fn a_bright_background_is_the_ceiling_of_dim_surfaces() {
        let dim = ceilings(DVec3::splat(9.0), &[surface(0.5, 1.0)], 10);
        assert!(dim[0] == DVec3::ZERO && dim[1..].iter().all(|bound| bound.x == 9.0));
        assert_eq!(ceilings(DVec3::ONE, &[], 3)[3], DVec3::ONE);
    }

    /// The envelope against the definition, on surfaces, many of them never the brightest, some twice the same.
    #[test]
    fn several_surfaces_give_the_brightest_chain_of_them() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..300 {
            let count = 1 + (random() * 12.0) as usize;
            let mut surfaces: Vec<_> = (0..count).map(|_| surface(random(), random().powi(3))).collect();
            surfaces.push(surfaces[0]);
            surfaces.push(surface(1.0, if random() < 0.5 { 0.0 } else { 0.01 * random() }));
            let bounds = ceilings(DVec3::splat(0.01), &surfaces, 60);
            let mut expected = 0.0;
            for bound in &bounds[1..] {
                let reflected = surfaces.iter().map(|surface| surface.local_radiance.x + surface.gain * expected);
                expected = reflected.fold(0.01, f64::max);
                assert!(is_just_above(bound.x, expected), "{bound} is not {expected}: {surfaces:?}");
            }
        }
    }
}
