//! Cases of single rays at single solids.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec3;

use super::judge::{Judge, Tally, size, stored_vector};
use super::solids::{direction, grazing, middle, placed, ray, rays_at, usual};
use super::{Case, Measured, Subject};
use crate::scene::{Solid, SolidKind};
use crate::tracer::probe::{From, ProbeHit, ProbeRay};
use crate::tracer::{Precision, TracerError};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (index, exponent) in (-6..=6).enumerate() {
        cases.push(of_usual(format!("SC-{}", index + 1), move |solid| {
            (placed(solid, 10f64.powi(exponent), DVec3::ZERO), 4.0)
        }));
    }
    for (index, shift) in [1e3, 1e5, 1e6, 1e7].into_iter().enumerate() {
        let away = DVec3::new(0.8, -0.48, 0.36) * shift;
        cases.push(of_usual(format!("TR-{}", index + 1), move |solid| (placed(solid, 1.0, away), 4.0)));
    }
    for exponent in 1..=7 {
        cases.push(of_usual(format!("DS-{exponent}"), move |solid| (solid.clone(), 10f64.powi(exponent))));
    }
    for (index, clearance) in [1e-3, -1e-3, 1e-5, -1e-5, 1e-7, -1e-7].into_iter().enumerate() {
        cases.push(grazing_case(index + 1, clearance));
    }
    cases.extend(thin_cylinders());
    cases.extend(flat_boxes());
    cases.extend(box_edges());
    cases.extend(cones());
    for (index, kind) in SolidKind::ALL.into_iter().enumerate() {
        cases.push(of_kind(format!("IN-{}", index + 1), kind, |solid, count, precision| {
            rays_at(solid, 0.1, count, precision)
        }));
    }
    for (index, kind) in SolidKind::ALL.into_iter().enumerate() {
        cases.push(Case::of_kernel(format!("ON-{}", index + 1), move |subject| leaving(subject, kind)));
    }
    cases.push(Case::of_kernel("RD-0", without_direction));
    cases
}

fn count(subject: &Subject) -> usize {
    if subject.is_quick { 1_000 } else { 50_000 }
}

/// Casts the rays and validates the hits.
fn judged(
    subject: &Subject,
    solid: &Solid,
    rays: impl FnOnce(&Solid, Precision) -> Vec<ProbeRay>,
    tally: &mut Tally,
) -> Result<(), TracerError> {
    let judge = Judge::new(solid, subject.kernel);
    let rays = rays(&judge.solid, subject.kernel.precision());
    let hits = subject.probe()?.cast(std::slice::from_ref(&judge.solid), &rays)?;
    rays.iter().zip(&hits).for_each(|(ray, hit)| judge.judge(tally, ray, hit.as_ref()));
    Ok(())
}

/// Solids of every kind, made from the usual ones, with the distance that they are seen from, in sizes.
fn of_usual(id: String, make: impl Fn(&Solid) -> (Solid, f64) + 'static) -> Case {
    Case::of_kernel(id, move |subject| {
        let (mut tally, count) = (Tally::default(), count(subject));
        for solid in usual() {
            let (solid, distance) = make(&solid);
            judged(subject, &solid, |solid, precision| rays_at(solid, distance, count, precision), &mut tally)?;
        }
        // Two thirds of the rays are aimed at the half of a sphere that the leanest of the solids fills a fifth of.
        Ok(tally.measured(count / 2))
    })
}

fn of_kind(id: String, kind: SolidKind, rays: impl Fn(&Solid, usize, Precision) -> Vec<ProbeRay> + 'static) -> Case {
    Case::of_kernel(id, move |subject| {
        let (mut tally, count) = (Tally::default(), count(subject));
        judged(subject, &usual()[kind as usize], |solid, precision| rays(solid, count, precision), &mut tally)?;
        Ok(tally.measured(count / 10))
    })
}

/// One solid with rays that are all given, so many of them hits.
fn exact(id: &str, solid: Solid, rays: Vec<(DVec3, DVec3)>, least_hits: usize) -> Case {
    Case::of_kernel(id, move |subject| {
        let mut tally = Tally::default();
        let rays = |_: &Solid, precision: Precision| {
            let ray = |&(origin, direction): &(DVec3, DVec3)| ProbeRay {
                origin: stored_vector(origin, precision),
                direction: stored_vector(direction, precision),
                solid: 0,
                from: From::Space,
            };
            rays.iter().map(ray).collect()
        };
        judged(subject, &solid, rays, &mut tally)?;
        Ok(tally.measured(least_hits))
    })
}

/// Past a sphere and a cylinder, or through their rims.
fn grazing_case(number: usize, clearance: f64) -> Case {
    Case::of_kernel(format!("GR-{number}"), move |subject| {
        let (mut tally, count) = (Tally::default(), count(subject));
        for kind in [SolidKind::Sphere, SolidKind::Cylinder] {
            let rays = |solid: &Solid, precision| grazing(solid, 4.0, clearance, count, precision);
            judged(subject, &usual()[kind as usize], rays, &mut tally)?;
        }
        // Within 10⁻⁷ an f32 does not distinguish a hit from a miss.
        let is_decided = clearance.abs() > 1e-6 || subject.kernel.precision() == Precision::F64;
        Ok(tally.measured(if clearance < 0.0 && is_decided { 2 * count } else { 0 }))
    })
}

fn thin_cylinders() -> Vec<Case> {
    let axis = DVec3::new(0.36, -0.48, 0.8);
    let thin = |number: usize, ratio: f64| {
        let solid = Solid::Cylinder { ends: [-axis, axis], radius: 2.0 * ratio };
        Case::of_kernel(format!("TC-{number}"), move |subject| {
            let (mut tally, count) = (Tally::default(), count(subject));
            let rays = |_: &Solid, precision| {
                // Oblique, at the axis and up to one and a half radii beside it.
                (0..count)
                    .map(|index| {
                        let origin = direction(index, count) * 4.0;
                        let along = axis * (1.8 * (index * 7 % count) as f64 / count as f64 - 0.9);
                        let beside = (along - origin).cross(axis).normalize();
                        let share = 3.0 * (index * 13 % count) as f64 / count as f64 - 1.5;
                        ray(origin, along + beside * (2.0 * ratio * share), precision)
                    })
                    .collect()
            };
            judged(subject, &solid, rays, &mut tally)?;
            // At 10⁻⁶ an f32 ray cannot be aimed as well as that.
            Ok(tally.measured(count / 20))
        })
    };
    let upright = Solid::Cylinder { ends: [DVec3::NEG_Y, DVec3::Y], radius: 1.0 };
    let down = |x: f64| (DVec3::new(x, 5.0, 0.0), DVec3::NEG_Y);
    let parallel = vec![down(0.0), down(1.0 - 1e-6), down(1.0 + 1e-6), down(-(1.0 - 1e-6)), down(0.5)];
    let disc = Solid::Cylinder { ends: [-axis * 0.01, axis * 0.01], radius: 1.0 };
    let at_disc = Case::of_kernel("TC-5", move |subject| {
        let (mut tally, count) = (Tally::default(), count(subject));
        judged(subject, &disc, |solid, precision| rays_at(solid, 4.0, count, precision), &mut tally)?;
        Ok(tally.measured(count / 10))
    });
    vec![thin(1, 1e-2), thin(2, 1e-4), thin(3, 1e-6), exact("TC-4", upright, parallel, 4), at_disc]
}

fn flat_boxes() -> Vec<Case> {
    let flat = |number: usize, half_thickness: f64| {
        let solid = Solid::Box {
            center: DVec3::new(0.5, -0.25, 0.125),
            half_size: DVec3::new(1.0, half_thickness, 0.75),
            rotation_degrees: DVec3::new(20.0, 35.0, 50.0),
        };
        Case::of_kernel(format!("FB-{number}"), move |subject| {
            let (mut tally, count) = (Tally::default(), count(subject));
            judged(subject, &solid, |solid, precision| rays_at(solid, 4.0, count, precision), &mut tally)?;
            Ok(tally.measured(count / 10))
        })
    };
    vec![flat(1, 1e-3), flat(2, 1e-6), flat(3, 0.0)]
}

/// Rays in a face's plane, which is not inside, rays with ±0 across a slab, and rays at edges and corners.
fn box_edges() -> Vec<Case> {
    let cube = || Solid::Box { center: DVec3::ZERO, half_size: DVec3::ONE, rotation_degrees: DVec3::ZERO };
    let along_z = |x: f64, zero: f64| (DVec3::new(x, 0.25, -4.0), DVec3::new(zero, 0.0, 1.0));
    let diagonal = |x: f64, y: f64| DVec3::new(x, y, 0.0) * FRAC_1_SQRT_2;
    let edges = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    let at_edges = edges.map(|(x, y)| (DVec3::new(4.0 * x, 4.0 * y, 0.25), diagonal(-x, -y)));
    let at_corners = edges.map(|(x, y)| (DVec3::new(4.0 * x, 4.0 * y, -4.0), DVec3::new(-x, -y, 1.0).normalize()));
    vec![
        exact("BX-1", cube(), vec![along_z(1.0, 0.0)], 1),
        exact("BX-2", cube(), vec![along_z(1.0, -0.0)], 1),
        exact("BX-3", cube(), vec![along_z(-1.0, 0.0)], 1),
        exact("BX-4", cube(), vec![along_z(-1.0, -0.0)], 1),
        exact("BX-5", cube(), vec![along_z(0.5, 0.0), along_z(-0.5, -0.0), along_z(1.0f64.next_up() + 1e-6, 0.0)], 2),
        exact("BX-6", cube(), at_edges.to_vec(), 4),
        exact("BX-7", cube(), at_corners.to_vec(), 4),
    ]
}

fn cones() -> Vec<Case> {
    let angled = |number: usize, half_angle_degrees: f64| {
        let axis = DVec3::new(0.36, -0.48, 0.8);
        let tangent = half_angle_degrees.to_radians().tan();
        // Of size 1, whether a needle or a disc.
        let height = if tangent > 1.0 { 1.0 / tangent } else { 1.0 };
        let solid = Solid::Cone { apex: -0.5 * height * axis, axis, height, half_angle_degrees };
        Case::of_kernel(format!("KN-{number}"), move |subject| {
            let (mut tally, count) = (Tally::default(), count(subject));
            let rays = |solid: &Solid, precision| {
                let radius = height * tangent;
                let aimed = |index: usize| {
                    let origin = direction(index, count) * 4.0;
                    let along = axis * (height * ((index * 7 % count) as f64 / count as f64 - 0.5));
                    let beside = (along - origin).cross(axis).normalize();
                    ray(
                        origin,
                        along + beside * (radius * (1.5 * (index * 13 % count) as f64 / count as f64 - 0.75)),
                        precision,
                    )
                };
                let mut rays: Vec<_> = (0..count / 2).map(aimed).collect();
                rays.extend(rays_at(solid, 4.0, count / 2, precision));
                rays
            };
            judged(subject, &solid, rays, &mut tally)?;
            Ok(tally.measured(count / 20))
        })
    };
    let upright = |cosine: f64, height: f64| Solid::Cone {
        apex: DVec3::ZERO,
        axis: DVec3::Z,
        height,
        half_angle_degrees: cosine.acos().to_degrees(),
    };
    let beside_axis = |offset: f64| (DVec3::new(offset, 0.0, -3.0), DVec3::Z);
    // cos α = 0.6, so the base at height 1 has radius 4/3.
    let rim = |share: f64| (DVec3::new(4.0 / 3.0 * share, 0.0, 5.0), DVec3::NEG_Z);
    vec![
        angled(1, 1e-3),
        angled(2, 0.1),
        angled(3, 89.0),
        angled(4, 89.9),
        exact("KN-5", upright(0.6, 1.0), vec![beside_axis(0.0), beside_axis(1e-6), beside_axis(-1e-6)], 3),
        known_t(),
        // Only the nappe that is not there is on the way.
        exact(
            "KN-7",
            upright(0.6, 1.0),
            vec![(DVec3::new(-3.0, 0.0, -1.0), DVec3::X), (DVec3::new(0.5, -3.0, -0.5), DVec3::Y)],
            0,
        ),
        // The first root is on the other nappe, the second on this one.
        exact(
            "KN-8",
            upright(0.6, 3.0),
            vec![
                (DVec3::new(0.0, 0.0, -1.0), DVec3::new(0.6, 0.0, 0.8)),
                (DVec3::new(0.5, 0.0, -1.0), DVec3::new(0.28, 0.0, 0.96)),
            ],
            2,
        ),
        exact("KN-9", upright(0.6, 1.0), vec![(DVec3::new(0.25, 0.25, 4.0), DVec3::NEG_Z)], 1),
        exact("KN-10", upright(0.6, 1.0), vec![rim(1.0 - 1e-5), rim(1.0 + 1e-5), rim(-1.0 + 1e-5)], 2),
    ]
}

/// cos α = 0.6, a ray parallel to the side: its one root is t = 65/24 = 2.70833.
fn known_t() -> Case {
    let apex_at = |z: f64| DVec3::new(0.0, 0.0, z);
    Case::of_kernel("KN-6", move |subject| {
        let solid = Solid::Cone {
            apex: apex_at(0.0),
            axis: DVec3::Z,
            height: 10.0,
            half_angle_degrees: 0.6_f64.acos().to_degrees(),
        };
        let mut tally = Tally::default();
        let rays = |_: &Solid, precision| {
            [1.0, 2.0, 3.0]
                .map(|x| {
                    ray(DVec3::new(-x, 0.0, 4.0), DVec3::new(-x, 0.0, 4.0) + DVec3::new(0.8, 0.0, -0.6), precision)
                })
                .to_vec()
        };
        judged(subject, &solid, rays, &mut tally)?;
        Ok(tally.measured(3))
    })
}

/// Rays that leave a kernel's own hits outwards must not meet the solid again: at scales 10⁻³, 1 and 10³, since fixed
/// offsets are right at one of them at best.
fn leaving(subject: &Subject, kind: SolidKind) -> Result<Vec<Measured>, TracerError> {
    let (mut left, mut met_again, mut skipped) = (0, 0, 0);
    for scale in [1e-3, 1.0, 1e3] {
        let judge = Judge::new(&placed(&usual()[kind as usize], scale, DVec3::ZERO), subject.kernel);
        let solids = std::slice::from_ref(&judge.solid);
        let rays = rays_at(&judge.solid, 4.0, count(subject), subject.kernel.precision());
        let hits = subject.probe()?.cast(solids, &rays)?;
        let leaving: Vec<_> =
            hits.iter().flatten().enumerate().map(|(index, hit)| leave(subject, hit, index)).collect();
        let again = subject.probe()?.cast(solids, &leaving)?;
        left += leaving.len();
        met_again += again.iter().flatten().count();
        // A ray that starts this far off may have passed what it should have met.
        let far = 1e-2 * size(&judge.solid);
        skipped +=
            hits.iter().flatten().zip(&leaving).filter(|(hit, ray)| (ray.origin - hit.point).length() > far).count();
    }
    Ok(vec![
        Measured::none_of("rays that meet again what they leave", met_again),
        Measured::none_of("rays that start far off what they leave", skipped),
        Measured::none_of("hits too few to prove anything", (count(subject) / 2).saturating_sub(left)),
    ])
}

/// As the kernel itself goes on from a hit: the course's started 0.02 off the surface.
fn leave(subject: &Subject, hit: &ProbeHit, index: usize) -> ProbeRay {
    let precision = subject.kernel.precision();
    let sample = direction(index * 31 % 997, 997);
    let height = sample.dot(hit.normal);
    // Every third nearly along the surface.
    let outwards =
        if index.is_multiple_of(3) { sample - hit.normal * (height - 1e-5) } else { sample * height.signum() };
    let (origin, from) = match hit.surface {
        None => (hit.point + 0.02 * hit.normal, From::Space),
        Some((face, side)) => (hit.point, From::Own(face, side)),
    };
    let direction = stored_vector(outwards.normalize(), precision);
    ProbeRay { origin: stored_vector(origin, precision), direction, solid: 0, from }
}

/// A miss, from outside and from inside; that the dispatch comes back at all is a part of it.
fn without_direction(subject: &Subject) -> Result<Vec<Measured>, TracerError> {
    let mut met = 0;
    for solid in usual() {
        let judge = Judge::new(&solid, subject.kernel);
        let origins = [DVec3::NEG_Z * 4.0, middle(&judge.solid)];
        let directions = [DVec3::ZERO, DVec3::NAN, DVec3::new(0.0, f64::NAN, 1.0)];
        let rays: Vec<_> = origins
            .iter()
            .flat_map(|&origin| directions.map(|direction| ProbeRay { origin, direction, solid: 0, from: From::Space }))
            .collect();
        met += subject.probe()?.cast(std::slice::from_ref(&judge.solid), &rays)?.iter().flatten().count();
    }
    Ok(vec![Measured::none_of("rays without a direction that meet something", met)])
}
