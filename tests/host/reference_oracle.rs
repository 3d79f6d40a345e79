//! The reference against 384-bit arithmetic over random solids, rays and scales: no violation of any tolerance.

use crate::oracle::{Report, Subject};
use crate::random::Random;
use zerkalo::scene::SolidKind;

const SOLIDS: u64 = 1_000;
const RAYS_A_SOLID: u32 = 12;

fn no_bar_is_broken_by(kind: SolidKind, least_hits: u32) {
    let mut report = Report::default();
    for seed in 0..SOLIDS {
        let mut random = Random(seed);
        let subject = Subject::new(random.solid(kind));
        for _ in 0..RAYS_A_SOLID {
            let ray = random.ray_at(&subject);
            report.judge(&subject, &ray);
        }
    }
    report.require(kind.name(), least_hits);
    assert!(report.inside_hits >= 500, "only {} hits from inside", report.inside_hits);
    assert!(report.silhouette_rays >= 1_000, "only {} rays near silhouettes", report.silhouette_rays);
}

#[test]
fn spheres_break_no_bar() {
    no_bar_is_broken_by(SolidKind::Sphere, 4_000);
}

#[test]
fn boxes_break_no_bar() {
    no_bar_is_broken_by(SolidKind::Box, 4_000);
}

#[test]
fn cylinders_break_no_bar() {
    no_bar_is_broken_by(SolidKind::Cylinder, 4_000);
}

#[test]
fn cones_break_no_bar() {
    no_bar_is_broken_by(SolidKind::Cone, 3_000);
}
