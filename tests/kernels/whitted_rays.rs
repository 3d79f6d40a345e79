//! The accurate kernel's hits against the reference's, ray by ray, by the tolerances of docs/numerics.md.
//!
//! `ZERKALO_RAYS=10000000 cargo test --release --test whitted_rays` is the release check: so many rays a solid.

use crate::common::TestDevice;
use crate::oracle::{self, Subject};
use crate::probe::cases::Case;
use crate::probe::{From, Probe, ProbeHit, ProbeRay, stored_vector, surface};
use crate::random::Random;
use glam::DVec3;
use rayon::prelude::*;
use zerkalo::reference::{Face, Hit, OriginSurface, Side};
use zerkalo::scene::{Solid, SolidKind};
use zerkalo::tracer::{Kernel, Precision};

const RAYS_A_SOLID: usize = 32;
const SOLIDS_A_BATCH: usize = 4_000;

/// A solid's kind in the normal run.
const RAYS: usize = 128_000;

fn batches() -> u64 {
    let rays = std::env::var("ZERKALO_RAYS").map_or(RAYS, |rays| rays.parse().expect("a number of rays"));
    rays.div_ceil(RAYS_A_SOLID * SOLIDS_A_BATCH) as u64
}

/// What was found. Errors are in units of their tolerances.
#[derive(Debug, Default, Clone)]
struct Tally {
    rays: u64,
    hits: u64,
    inside: u64,
    near_silhouettes: u64,
    wrong_outside_band: u64,
    wrong_inside_band: u64,
    wrong_face: u64,
    not_finite: u64,
    worst_t: f64,
    worst_point: f64,
    worst_normal: f64,
    worst_length: f64,
    first_bad: Option<String>,
    first_wrong: Option<String>,
}

impl Tally {
    fn plus(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            hits: self.hits + other.hits,
            inside: self.inside + other.inside,
            near_silhouettes: self.near_silhouettes + other.near_silhouettes,
            wrong_outside_band: self.wrong_outside_band + other.wrong_outside_band,
            wrong_inside_band: self.wrong_inside_band + other.wrong_inside_band,
            wrong_face: self.wrong_face + other.wrong_face,
            not_finite: self.not_finite + other.not_finite,
            worst_t: self.worst_t.max(other.worst_t),
            worst_point: self.worst_point.max(other.worst_point),
            worst_normal: self.worst_normal.max(other.worst_normal),
            worst_length: self.worst_length.max(other.worst_length),
            first_bad: self.first_bad.or(other.first_bad),
            first_wrong: self.first_wrong.or(other.first_wrong),
        }
    }

    fn judge(&mut self, case: &Case, precision: Precision, ray: &ProbeRay, hit: Option<ProbeHit>) {
        let u = precision.unit_roundoff();
        let truth = case.cast(ray, OriginSurface::Free);
        self.rays += 1;
        self.hits += u64::from(hit.is_some());
        let (hit, truth) = match (hit, truth) {
            (None, None) => return,
            (Some(hit), Some(truth)) => (hit, truth),
            (hit, truth) => {
                // Rare, so that the oracle may judge.
                let ray_64 = oracle::ray(ray.origin, ray.direction);
                if Subject::new(case.solid.clone()).is_within_band(8.0 * u * case.size, &ray_64) {
                    self.wrong_inside_band += 1;
                } else {
                    self.wrong_outside_band += 1;
                    self.first_wrong
                        .get_or_insert(format!("{hit:?} instead of {truth:?}: {ray:?} at {:?}", case.solid));
                }
                return;
            }
        };
        if !hit.is_finite() {
            self.not_finite += 1;
            self.remember(format!("{hit:?}: {ray:?} at {:?}", case.solid));
            return;
        }
        self.inside += u64::from(surface(&hit).1 == Side::Inside);
        self.compare(case, precision, ray, &hit, &truth);
    }

    fn compare(&mut self, case: &Case, precision: Precision, ray: &ProbeRay, hit: &ProbeHit, truth: &Hit) {
        let u = precision.unit_roundoff();
        let half_ulp = ulp(precision, hit.t) / 2.0;
        let t_bar = half_ulp + 4.0 * u * case.size;
        let cosine = truth.normal.dot(ray.direction).abs();
        let t_error = match precision {
            Precision::F32 => case.distance(ray.origin, hit.t * ray.direction),
            // To first order; the reference's t is itself rounded.
            Precision::F64 => ((hit.t - truth.t).abs() * cosine - half_ulp).max(0.0),
        };
        let point_bar = 4.0 * u * (oracle::anchor(&case.solid).abs().max_element() + case.size);
        let point_error = match precision {
            Precision::F32 => case.distance(hit.point, DVec3::ZERO),
            Precision::F64 => truth.normal.dot(hit.point - truth.point).abs(),
        };
        if surface(hit) != (truth.face, truth.side) {
            // At an edge both faces are right, to the tolerance of t.
            if (hit.t - truth.t).abs() > 2.0 * t_bar / cosine.max(1e-300) && t_error > t_bar {
                self.wrong_face += 1;
                self.remember(format!("{hit:?} instead of {truth:?}: {ray:?} at {:?}", case.solid));
            }
            return;
        }
        let t_share = t_error / t_bar;
        let point_share = point_error / point_bar;
        // Beyond the catalogue's distances a pair of numbers no longer holds the way: it keeps it to u², which across
        // an axis, at a radius r and a distance t from it, is u²·t/r of the direction.
        let reach = hit.t / radius_at(&case.solid, truth.point);
        let beyond = if reach > FARTHEST { u * u * reach } else { 0.0 };
        // A round side that the ray leaves by less than that has a clearance r·cos²θ/2 below H's band of 8u·r, where
        // not even hit or miss is certain, and the tolerance is no smaller than cosθ itself.
        let is_decided = truth.face != Face::Curved || cosine >= (16.0 * u).sqrt();
        let normal_error = if is_decided { (hit.normal - truth.normal).length() * cosine } else { 0.0 };
        let normal_share = normal_error / (8.0 * u + beyond);
        self.worst_t = self.worst_t.max(t_share);
        self.worst_point = self.worst_point.max(point_share);
        self.worst_normal = self.worst_normal.max(normal_share);
        self.worst_length = self.worst_length.max((hit.normal.length() - 1.0).abs() / (4.0 * u));
        if t_share > 1.0 {
            self.remember(format!("T {t_share}: {hit:?} instead of {truth:?}: {ray:?} at {:?}", case.solid));
        }
    }

    fn remember(&mut self, description: String) {
        self.first_bad.get_or_insert(description);
    }
}

/// Distance of a point on a curved side from the axis; of other surfaces, which have none, infinite.
fn radius_at(solid: &Solid, point: DVec3) -> f64 {
    match *solid {
        Solid::Cylinder { radius, .. } => radius,
        Solid::Cone { apex, axis, .. } => {
            let from_apex = point - apex;
            (from_apex - axis * from_apex.dot(axis)).length()
        }
        Solid::Sphere { .. } | Solid::Box { .. } => f64::INFINITY,
    }
}

/// Of the catalogue's distances in radii.
const FARTHEST: f64 = 1e7;

/// From |t| to the next larger number.
fn ulp(precision: Precision, t: f64) -> f64 {
    match precision {
        Precision::F32 => f64::from((t.abs() as f32).next_up()) - t.abs(),
        Precision::F64 => t.abs().next_up() - t.abs(),
    }
}

fn cases(kind: SolidKind, precision: Precision, batch: u64) -> Vec<Case> {
    let mut random = Random(batch << 8 | kind as u64);
    (0..SOLIDS_A_BATCH).map(|_| Case::random(&mut random, kind, precision)).collect()
}

fn solids(cases: &[Case]) -> Vec<Solid> {
    cases.iter().map(|case| case.solid.clone()).collect()
}

/// Rays at each solid from two places, and whether each is near the silhouette.
fn fans(cases: &[Case], precision: Precision, batch: u64) -> Vec<(ProbeRay, bool)> {
    let at_case = |(index, case): (usize, &Case)| {
        let mut random = Random(batch << 32 | index as u64);
        let half = RAYS_A_SOLID as u32 / 2;
        [(); 2].map(|()| case.fan(&mut random, precision, index, half)).concat()
    };
    cases.par_iter().enumerate().flat_map_iter(at_case).collect()
}

fn tally(kind: SolidKind, precision: Precision, case: impl Fn(&mut Random, SolidKind, Precision) -> Case) -> Tally {
    let device = TestDevice::open();
    let probe = Probe::new(&device, Kernel::Whitted(precision)).unwrap();
    let mut tally = Tally::default();
    for batch in 0..batches() {
        let mut random = Random(batch << 8 | kind as u64);
        let cases: Vec<_> = (0..SOLIDS_A_BATCH).map(|_| case(&mut random, kind, precision)).collect();
        let fans = fans(&cases, precision, batch);
        tally.near_silhouettes += fans.iter().filter(|(_, is_near)| *is_near).count() as u64;
        let rays: Vec<_> = fans.into_iter().map(|(ray, _)| ray).collect();
        let hits = probe.cast(&solids(&cases), &rays).unwrap();
        let judged = rays.par_iter().zip(hits).fold(Tally::default, |mut tally, (ray, hit)| {
            tally.judge(&cases[ray.solid], precision, ray, hit);
            tally
        });
        tally = tally.plus(judged.reduce(Tally::default, Tally::plus));
    }
    println!("{} {}: {tally:#?}", kind.name(), precision.name());
    tally
}

fn bars_are_kept_by(kind: SolidKind, precision: Precision) {
    let tally = tally(kind, precision, Case::random);
    assert_eq!((tally.wrong_outside_band, tally.not_finite, tally.wrong_face), (0, 0, 0), "{tally:#?}");
    assert!(tally.hits * 10 > tally.rays * 3, "only {} hits of {} rays", tally.hits, tally.rays);
    assert!(tally.inside * 50 > tally.rays, "only {} hits from inside", tally.inside);
    assert!(tally.near_silhouettes * 5 > tally.rays * 2, "only {} near silhouettes", tally.near_silhouettes);
    let worst = [tally.worst_t, tally.worst_point, tally.worst_normal, tally.worst_length];
    assert!(worst.into_iter().all(|worst| worst <= 1.0), "{tally:#?}");
}

#[test]
fn f32_spheres_break_no_bar() {
    bars_are_kept_by(SolidKind::Sphere, Precision::F32);
}

#[test]
fn f32_boxes_break_no_bar() {
    bars_are_kept_by(SolidKind::Box, Precision::F32);
}

#[test]
fn f32_cylinders_break_no_bar() {
    bars_are_kept_by(SolidKind::Cylinder, Precision::F32);
}

#[test]
fn f32_cones_break_no_bar() {
    bars_are_kept_by(SolidKind::Cone, Precision::F32);
}

#[test]
fn f64_solids_break_no_bar() {
    for kind in SolidKind::ALL {
        bars_are_kept_by(kind, Precision::F64);
    }
}

/// In the kernel's frame the bounds of the search are as narrow as in a picture, and narrower than the world's reach
/// makes them above.
#[test]
fn the_search_s_outlines_lose_no_hit() {
    for precision in [Precision::F32, Precision::F64] {
        for kind in SolidKind::ALL {
            let tally = tally(kind, precision, Case::in_scene_space);
            assert_eq!((tally.wrong_outside_band, tally.not_finite), (0, 0), "{tally:#?}");
            assert!(tally.hits * 10 > tally.rays * 3, "only {} hits of {} rays", tally.hits, tally.rays);
        }
    }
}

/// Rays that leave the kernel's own hits, from where it found them and to the side it found them on.
fn leaving(
    hits: &[(usize, ProbeHit)],
    precision: Precision,
    seed: u64,
    from: impl Fn(&ProbeHit) -> From,
) -> Vec<ProbeRay> {
    let mut random = Random(seed);
    let ray = |&(solid, ref hit): &(usize, ProbeHit)| {
        let direction = loop {
            let direction = random.direction_into(hit.normal);
            if direction.length() > 0.1 {
                break stored_vector(precision, direction.normalize());
            }
        };
        ProbeRay { origin: hit.point, direction, solid, from: from(hit) }
    };
    hits.iter().map(ray).collect()
}

fn no_surface_is_met_again_nor_lost(kind: SolidKind, precision: Precision) {
    let device = TestDevice::open();
    let probe = Probe::new(&device, Kernel::Whitted(precision)).unwrap();
    let (mut outwards, mut met_again, mut met_twin) = (0, 0, 0);
    let (mut inwards, mut lost, mut off_surface) = (0, 0, 0);
    let mut first_bad = None;
    for batch in 0..batches() {
        let cases = cases(kind, precision, batch);
        let solids = solids(&cases);
        let rays: Vec<_> = fans(&cases, precision, batch).into_iter().map(|(ray, _)| ray).collect();
        let hits =
            rays.iter().zip(probe.cast(&solids, &rays).unwrap()).filter_map(|(ray, hit)| Some((ray.solid, hit?)));
        let (outside, inside): (Vec<_>, Vec<_>) = hits.partition(|(_, hit)| surface(hit).1 == Side::Outside);

        let own = |hit: &ProbeHit| {
            let (face, side) = surface(hit);
            From::Own(face, side)
        };
        outwards += outside.len();
        let left = leaving(&outside, precision, batch, own);
        met_again += probe.cast(&solids, &left).unwrap().iter().flatten().count();
        // A solid in the same place has no exclusion: only the bound on the hit point's rounding keeps it away.
        let left = leaving(&outside, precision, batch + 1, |_| From::Another);
        for ((ray, again), start) in left.iter().zip(probe.cast(&solids, &left).unwrap()).zip(&outside) {
            met_twin += usize::from(again.is_some());
            if again.is_some() {
                first_bad.get_or_insert(format!("{again:?} by {ray:?} from {start:?} of {:?}", solids[ray.solid]));
            }
        }

        inwards += inside.len();
        let left = leaving(&inside, precision, batch + 2, own);
        for (ray, exit) in left.iter().zip(probe.cast(&solids, &left).unwrap()) {
            let Some(exit) = exit.filter(|exit| exit.is_finite() && surface(exit).1 == Side::Inside && exit.t >= 0.0)
            else {
                lost += 1;
                continue;
            };
            // A point that rounding put outside the base may slide past a cone's rim, by 1/sin of the angle there.
            let rim_sine = match solids[ray.solid] {
                Solid::Cone { half_angle_degrees, .. } => half_angle_degrees.to_radians().cos(),
                _ => 1.0,
            };
            let size = cases[ray.solid].size;
            let tolerance = 8.0 * precision.unit_roundoff() * (exit.point.abs().max_element() + size) / rim_sine;
            if precision == Precision::F32 && cases[ray.solid].distance(exit.point, DVec3::ZERO) > tolerance {
                off_surface += 1;
                first_bad.get_or_insert(format!("{exit:?} is off {:?}: {ray:?}", solids[ray.solid]));
            }
        }
    }
    println!(
        "{} {}: {outwards} left outwards, {met_again} met it again, {met_twin} a twin; {inwards} inwards, {lost} lost, \
         {off_surface} off the surface",
        kind.name(),
        precision.name()
    );
    assert_eq!((met_again, met_twin, lost, off_surface), (0, 0, 0, 0), "{first_bad:?}");
    assert!(outwards > 20_000 && inwards > 3_000, "{outwards} and {inwards} are too few");
}

#[test]
fn f32_rays_leaving_a_surface_neither_meet_it_again_nor_lose_it() {
    SolidKind::ALL.into_iter().for_each(|kind| no_surface_is_met_again_nor_lost(kind, Precision::F32));
}

#[test]
fn f64_rays_leaving_a_surface_neither_meet_it_again_nor_lose_it() {
    SolidKind::ALL.into_iter().for_each(|kind| no_surface_is_met_again_nor_lost(kind, Precision::F64));
}
