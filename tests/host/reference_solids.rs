//! Closed forms and the release catalogue of docs/numerics.md, a ray at a time. DG (refused at load) is the scene
//! module's.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use crate::oracle::rays::middle;
use crate::oracle::{Report, Subject, U, primitive, ray};
use crate::random::Random;
use glam::DVec3;
use zerkalo::reference::{Face, Ray, Side};
use zerkalo::scene::{Solid, SolidKind};

const ORIGIN: DVec3 = DVec3::ZERO;

fn sphere(radius: f64) -> Subject {
    Subject::new(Solid::Sphere { center: ORIGIN, radius })
}

fn straight_box(half_size: DVec3) -> Subject {
    Subject::new(Solid::Box { center: ORIGIN, half_size, rotation_degrees: DVec3::ZERO })
}

/// About the y axis.
fn cylinder(half_length: f64, radius: f64) -> Subject {
    Subject::new(Solid::Cylinder { ends: [DVec3::NEG_Y * half_length, DVec3::Y * half_length], radius })
}

/// Apex at the origin.
fn cone(axis: DVec3, height: f64, half_angle_degrees: f64) -> Subject {
    Subject::new(Solid::Cone { apex: ORIGIN, axis, height, half_angle_degrees })
}

/// One of each kind, all oblique, of size about 1, moved and scaled.
fn oblique(kind: SolidKind, position: DVec3, scale: f64) -> Subject {
    let axis = DVec3::new(0.48, 0.6, 0.64);
    Subject::new(match kind {
        SolidKind::Sphere => Solid::Sphere { center: position, radius: scale },
        SolidKind::Box => Solid::Box {
            center: position,
            half_size: DVec3::new(1.0, 0.7, 0.4) * scale,
            rotation_degrees: DVec3::new(20.0, 35.0, 50.0),
        },
        SolidKind::Cylinder => Solid::Cylinder { ends: [position, position + axis * 2.0 * scale], radius: 0.5 * scale },
        SolidKind::Cone => Solid::Cone { apex: position, axis, height: scale, half_angle_degrees: 30.0 },
    })
}

/// `count` rays from `distance` sizes away, a half of them close to the silhouette.
fn judge_from_distance(report: &mut Report, subject: &Subject, distance: f64, count: u32, random: &mut Random) {
    let middle = middle(&subject.solid);
    for _ in 0..count {
        let origin = middle + random.unit_vector() * distance * subject.size;
        let ray = random.ray_from(subject, origin);
        report.judge(subject, &ray);
    }
}

#[track_caller]
fn assert_hit(subject: &Subject, ray: Ray, t: f64, face: Face, side: Side, normal: DVec3) {
    let hit = subject.cast(&ray).expect("a hit");
    assert!((hit.t - t).abs() <= 4.0 * U * t.abs(), "t {} instead of {t}", hit.t);
    assert_eq!((hit.face, hit.side), (face, side));
    assert!((hit.normal - normal).length() <= 8.0 * U, "normal {} instead of {normal}", hit.normal);
    assert!(subject.distance(hit.point) <= 4.0 * U * subject.size);
}

#[track_caller]
fn assert_miss(subject: &Subject, ray: Ray) {
    assert_eq!(subject.cast(&ray), None);
}

#[test]
fn sc_every_scale_from_1e_minus_6_to_1e6_meets_every_bar() {
    for kind in SolidKind::ALL {
        for exponent in -6..=6 {
            let (mut report, mut random) = (Report::default(), Random(exponent as u64));
            let scale = 10f64.powi(exponent);
            judge_from_distance(&mut report, &oblique(kind, DVec3::ONE * scale, scale), 5.0, 100, &mut random);
            report.require(&format!("SC {} ×1e{exponent}", kind.name()), 40);
        }
    }
}

#[test]
fn tr_moved_by_up_to_1e7_sizes_every_bar_is_met() {
    for kind in SolidKind::ALL {
        for shift in [1e3, 1e5, 1e6, 1e7] {
            let (mut report, mut random) = (Report::default(), Random(shift as u64));
            let position = DVec3::new(shift, -shift, 0.7 * shift);
            judge_from_distance(&mut report, &oblique(kind, position, 1.0), 5.0, 200, &mut random);
            report.require(&format!("TR {} +{shift:e}", kind.name()), 80);
        }
    }
}

#[test]
fn ds_from_up_to_1e7_sizes_away_every_bar_is_met() {
    for kind in SolidKind::ALL {
        for exponent in 1..=7 {
            let (mut report, mut random) = (Report::default(), Random(exponent as u64));
            judge_from_distance(&mut report, &oblique(kind, DVec3::ONE, 1.0), 10f64.powi(exponent), 200, &mut random);
            report.require(&format!("DS {} D/S 1e{exponent}", kind.name()), 80);
        }
    }
}

#[test]
fn gr_a_clearance_of_1e_minus_7_decides_hit_or_miss() {
    let tilted = cone(DVec3::NEG_Y, 1.0, 45.0);
    for clearance in [1e-3, 1e-5, 1e-7] {
        for (subject, height) in
            [(sphere(1.0), 1.0), (cylinder(1.0, 1.0), 1.0), (straight_box(DVec3::ONE), 1.0), (sphere(1e-3), 1e-3)]
        {
            let grazing = |height| ray(DVec3::new(-10.0, height, 0.0), DVec3::X);
            let hit = subject.cast(&grazing(height * (1.0 - clearance))).expect("a hit below the silhouette");
            assert!(hit.normal.is_finite() && hit.t.is_finite());
            assert_miss(&subject, grazing(height * (1.0 + clearance)));
        }
        // In the plane y = −0.5 the cone's silhouette is at z = ±0.5 for rays along x.
        let grazing = |z| ray(DVec3::new(-10.0, -0.5, z), DVec3::X);
        assert!(tilted.cast(&grazing(0.5 * (1.0 - clearance))).is_some());
        assert_miss(&tilted, grazing(0.5 * (1.0 + clearance)));
    }
}

#[test]
fn tc_thin_oblique_cylinders_meet_every_bar() {
    for thinness in [1e-2, 1e-4, 1e-6] {
        let (mut report, mut random) = (Report::default(), Random(1));
        let ends = [DVec3::new(0.3, -0.2, 0.9), DVec3::new(-0.1, 0.7, 0.2)];
        let subject = Subject::new(Solid::Cylinder { ends, radius: thinness * (ends[1] - ends[0]).length() });
        judge_from_distance(&mut report, &subject, 10.0, 400, &mut random);
        let [first, second] = ends;
        for _ in 0..400 {
            let target = first + (second - first) * random.uniform(0.0, 1.0);
            let off_axis = random.unit_vector() * thinness * random.uniform(0.0, 1.2);
            let origin = target + random.unit_vector() * random.magnitude(-3.0, 3.0);
            report.judge(&subject, &ray(origin, (target + off_axis - origin).normalize()));
        }
        report.require(&format!("TC r/len {thinness:e}"), 150);
    }
}

#[test]
fn tc_a_ray_along_the_axis_meets_the_cap_with_its_exact_normal() {
    for direction in [DVec3::NEG_Y, DVec3::Y] {
        for (offset, is_hit) in [(0.0, true), (1.0 - 1e-6, true), (1.0 + 1e-6, false)] {
            let along = ray(DVec3::new(offset, -5.0 * direction.y, 0.0), direction);
            let hit = cylinder(2.0, 1.0).cast(&along);
            assert_eq!(hit.map(|hit| (hit.t, hit.normal)), is_hit.then_some((3.0, -direction)));
        }
    }
    let (mut report, mut random) = (Report::default(), Random(2));
    judge_from_distance(&mut report, &cylinder(0.01, 1.0), 10.0, 400, &mut random);
    report.require("TC disc r/len 50", 100);
}

#[test]
fn tc_a_ray_parallel_to_an_oblique_axis_passes_from_cap_to_cap() {
    let (mut report, mut random) = (Report::default(), Random(3));
    let subject = Subject::new(Solid::course_default(SolidKind::Cylinder));
    for _ in 0..200 {
        let origin = DVec3::new(-3.0, 0.0, -3.0) + random.unit_vector();
        report.judge(&subject, &ray(origin, DVec3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2)));
    }
    report.require("TC parallel to an oblique axis", 100);
}

#[test]
fn fb_thin_plates_are_met_on_both_faces() {
    for thickness in [1e-3, 1e-6, 0.0] {
        let half_size = DVec3::new(1.0, thickness, 1.0);
        for direction in [DVec3::Y, DVec3::NEG_Y] {
            let face = Face::Slab { axis: 1, positive: direction.y < 0.0 };
            let down = ray(DVec3::new(0.3, -2.0 * direction.y, 0.4), direction);
            assert_hit(&straight_box(half_size), down, 2.0 - thickness, face, Side::Outside, -direction);
        }
        let rotation_degrees = DVec3::new(10.0, 20.0, 30.0);
        let subject = Subject::new(Solid::Box { center: DVec3::ONE, half_size, rotation_degrees });
        let (mut report, mut random) = (Report::default(), Random(4));
        judge_from_distance(&mut report, &subject, 10.0, 400, &mut random);
        report.require(&format!("FB half thickness {thickness:e}"), 100);
    }
}

#[test]
fn bx_a_ray_in_the_plane_of_a_face_meets_the_box_whatever_the_sign_of_zero() {
    let unit_box = straight_box(DVec3::ONE);
    let entry = Face::Slab { axis: 0, positive: false };
    for height in [-1.0, 1.0] {
        for zero in [0.0, -0.0] {
            let sliding = |height| ray(DVec3::new(-3.0, height, 0.0), DVec3::new(1.0, zero, zero));
            assert_hit(&unit_box, sliding(height), 2.0, entry, Side::Outside, DVec3::NEG_X);
            assert_miss(&unit_box, sliding(height * (1.0 + f64::EPSILON)));
        }
    }
}

#[test]
fn bx_a_ray_at_an_edge_or_a_corner_meets_the_lowest_axis_in_every_mirror_image() {
    let unit_box = straight_box(DVec3::ONE);
    for (direction, axis) in [(DVec3::new(1.0, 1.0, 0.0), 0), (DVec3::new(0.0, 1.0, 1.0), 1), (DVec3::ONE, 0)] {
        for mirror in (0..8).map(|bits| {
            DVec3::select(glam::BVec3::from_array([0, 1, 2].map(|i| bits >> i & 1 == 1)), DVec3::NEG_ONE, DVec3::ONE)
        }) {
            let direction = direction * mirror;
            let face = Face::Slab { axis, positive: direction[axis as usize] < 0.0 };
            let mut normal = DVec3::ZERO;
            normal[axis as usize] = -direction[axis as usize];
            assert_hit(&unit_box, ray(-3.0 * direction, direction), 2.0, face, Side::Outside, normal);
        }
    }
    // An edge met at 8/5, where neither axis' arithmetic is exact.
    let oblique = ray(DVec3::new(-4.2, -2.6, 0.0), DVec3::new(2.0, 1.0, 0.0));
    assert_hit(&unit_box, oblique, 1.6, Face::Slab { axis: 0, positive: false }, Side::Outside, DVec3::NEG_X);
}

#[test]
fn kn_needles_and_discs_meet_every_bar() {
    for half_angle_degrees in [1e-3, 0.1, 89.0, 89.9] {
        let (mut report, mut random) = (Report::default(), Random(5));
        let axis = DVec3::new(0.48, 0.6, 0.64);
        let solid = Solid::Cone { apex: DVec3::new(0.1, 0.2, 0.3), axis, height: 1.0, half_angle_degrees };
        let subject = Subject::new(solid);
        judge_from_distance(&mut report, &subject, 10.0, 400, &mut random);
        for _ in 0..400 {
            let height = random.magnitude(-6.0, 0.0);
            let off_axis = random.unit_vector() * height * half_angle_degrees.to_radians().tan().min(10.0);
            let target = DVec3::new(0.1, 0.2, 0.3) + axis * height + off_axis;
            let origin = target + random.unit_vector() * random.magnitude(-3.0, 3.0);
            report.judge(&subject, &ray(origin, (target - origin).normalize()));
        }
        report.require(&format!("KN half-angle {half_angle_degrees}°"), 200);
    }
}

#[test]
fn kn_a_ray_across_the_axis_hits_just_below_the_apex_and_misses_just_above() {
    for half_angle_degrees in [1e-3, 0.1, 45.0, 89.0, 89.9] {
        let subject = cone(DVec3::NEG_Y, 1.0, half_angle_degrees);
        let across = |height| ray(DVec3::new(-5.0, height, 0.0), DVec3::X);
        let hit = subject.cast(&across(-1e-6)).expect("a hit below the apex");
        assert!(hit.normal.is_finite() && (hit.normal.length() - 1.0).abs() <= 4.0 * U);
        assert_miss(&subject, across(1e-6));
    }
}

#[test]
fn kn_a_ray_onto_the_apex_along_the_axis_gets_the_reversed_axis() {
    let subject = cone(DVec3::NEG_Y, 1.0, 25.0);
    assert_hit(&subject, ray(DVec3::Y * 4.0, DVec3::NEG_Y), 4.0, Face::Curved, Side::Outside, DVec3::Y);
}

#[test]
fn kn_a_ray_parallel_to_the_side_is_solved_linearly() {
    // cosα = 0.6 and d at α to the axis −z: a = 0. From (−3, 0, 1): ρ = 0.8·t − 3 → −4/3·z at t = 65/24.
    let subject = cone(DVec3::NEG_Z, 1.0, 0.6f64.acos().to_degrees());
    let parallel = ray(DVec3::new(-3.0, 0.0, 1.0), DVec3::new(0.8, 0.0, -0.6));
    let hit = subject.cast(&parallel).expect("a hit");
    assert!((hit.t - 65.0 / 24.0).abs() < 1e-15 * 24.0, "{}", hit.t);
    assert!((hit.normal - DVec3::new(-0.6, 0.0, 0.8)).length() < 1e-15);
    let mut report = Report::default();
    report.judge(&subject, &parallel);
    // At 45° sine and cosine are equal to the last bit, so that a is an exact zero.
    let diagonal = cone(DVec3::NEG_Y, 1.0, 45.0);
    for (z, x) in [(0.0, -2.0), (0.25, -2.0), (0.1, -1.5), (0.0, -3.0)] {
        report.judge(&diagonal, &ray(DVec3::new(x, 1.0, z), DVec3::new(1.0, -1.0, 0.0)));
        report.judge(&diagonal, &ray(DVec3::new(x, -1.0 - x, z), DVec3::new(-1.0, -1.0, 0.0)));
        report.judge(&diagonal, &ray(DVec3::new(x, -3.0, z), DVec3::new(1.0, 1.0, 0.0)));
    }
    report.require("KN parallel to the side", 5);
}

#[test]
fn kn_the_second_root_counts_where_the_first_is_on_the_mirror_nappe() {
    // Straight down at x = 1/4 beside the apex: the mirror nappe at y = 1/4 is passed, the side met at y = −1/4.
    let down = ray(DVec3::new(0.25, 3.0, 0.0), DVec3::NEG_Y);
    let normal = DVec3::new(1.0, 1.0, 0.0) / SQRT_2;
    assert_hit(&cone(DVec3::NEG_Y, 1.0, 45.0), down, 3.25, Face::Curved, Side::Outside, normal);
}

#[test]
fn kn_the_mirror_nappe_is_no_solid() {
    let subject = cone(DVec3::NEG_Y, 1.0, 45.0);
    assert_miss(&subject, ray(DVec3::new(-3.0, 0.5, 0.0), DVec3::X));
    assert_miss(&subject, ray(DVec3::new(-3.0, 0.2, 0.1), DVec3::new(0.9, 0.1, 0.0)));
}

#[test]
fn kn_the_base_is_met_from_below_up_to_its_rim() {
    let subject = cone(DVec3::NEG_Y, 1.0, 45.0);
    let up = |x| ray(DVec3::new(x, -4.0, 0.0), DVec3::Y);
    for x in [0.0, 0.5, -0.5, 1.0 - 1e-12] {
        assert_hit(&subject, up(x), 3.0, Face::Base, Side::Outside, DVec3::NEG_Y);
    }
    assert_miss(&subject, up(1.0 + 1e-12));
    // From inside the base is left downwards.
    let from_inside = ray(DVec3::new(0.1, -0.5, 0.0), DVec3::NEG_Y);
    assert_hit(&subject, from_inside, 0.5, Face::Base, Side::Inside, DVec3::Y);
}

#[test]
fn in_from_inside_the_exit_is_met_with_its_normal_turned_inwards() {
    let inside = Side::Inside;
    let x_face = Face::Slab { axis: 0, positive: true };
    assert_hit(&sphere(2.0), ray(ORIGIN, DVec3::X), 2.0, Face::Curved, inside, DVec3::NEG_X);
    assert_hit(&straight_box(DVec3::splat(2.0)), ray(ORIGIN, DVec3::X), 2.0, x_face, inside, DVec3::NEG_X);
    assert_hit(&cylinder(2.0, 2.0), ray(ORIGIN, DVec3::X), 2.0, Face::Curved, inside, DVec3::NEG_X);
    assert_hit(&cylinder(2.0, 2.0), ray(ORIGIN, DVec3::Y), 2.0, Face::End(1), inside, DVec3::NEG_Y);
    let slanted = DVec3::new(-1.0, -1.0, 0.0) / SQRT_2;
    let in_cone = ray(DVec3::NEG_Y * 0.5, DVec3::X);
    assert_hit(&cone(DVec3::NEG_Y, 1.0, 45.0), in_cone, 0.5, Face::Curved, inside, slanted);
}

#[test]
fn on_exactly_on_a_surface_only_the_exit_is_ahead() {
    let x_face = |positive| Face::Slab { axis: 0, positive };
    let on_sphere = DVec3::new(3.0, 4.0, 0.0);
    assert_hit(&sphere(5.0), ray(on_sphere, -on_sphere), 2.0, Face::Curved, Side::Inside, on_sphere / 5.0);
    assert_miss(&sphere(5.0), ray(on_sphere, on_sphere));
    let corner = straight_box(DVec3::ONE);
    assert_hit(&corner, ray(DVec3::X, DVec3::NEG_X), 2.0, x_face(false), Side::Inside, DVec3::X);
    assert_miss(&corner, ray(DVec3::X, DVec3::X));
    let on_body = DVec3::new(3.0, 0.5, 4.0);
    let across = DVec3::new(-3.0, 0.0, -4.0);
    assert_hit(&cylinder(1.0, 5.0), ray(on_body, across), 2.0, Face::Curved, Side::Inside, -across / 5.0);
    assert_miss(&cylinder(1.0, 5.0), ray(on_body, -across));
    let subject = cone(DVec3::NEG_Y, 1.0, 45.0);
    let on_side = DVec3::new(0.5, -0.5, 0.0);
    let slanted = DVec3::new(1.0, -1.0, 0.0) / SQRT_2;
    assert_hit(&subject, ray(on_side, DVec3::NEG_X), 1.0, Face::Curved, Side::Inside, slanted);
    assert_miss(&subject, ray(on_side, DVec3::X));
    let on_base = DVec3::new(0.0, -1.0, 0.0);
    assert_hit(
        &subject,
        ray(on_base, DVec3::new(1.0, 1.0, 0.0)),
        0.5,
        Face::Curved,
        Side::Inside,
        -DVec3::new(1.0, 1.0, 0.0) / SQRT_2,
    );
    assert_miss(&subject, ray(on_base, DVec3::NEG_Y));
}

#[test]
fn rd_a_direction_of_length_zero_or_nan_meets_nothing() {
    for direction in [DVec3::ZERO, DVec3::NAN, DVec3::splat(f64::INFINITY), DVec3::new(f64::NAN, 1.0, 0.0)] {
        for kind in SolidKind::ALL {
            let subject = Subject::new(Solid::course_default(kind));
            assert_miss(&subject, ray(DVec3::new(0.0, -0.5, 0.0), direction));
            assert_miss(&subject, ray(direction - 3.0, DVec3::X * f64::NAN));
        }
    }
}

#[test]
fn a_solid_behind_the_origin_is_never_met() {
    for kind in SolidKind::ALL {
        let subject = oblique(kind, ORIGIN, 1.0);
        let mut random = Random(6);
        let mut hits = 0;
        for _ in 0..2_000 {
            let towards = random.ray_at(&subject);
            let reversed = Ray { direction: -towards.direction, ..towards };
            let is_outside = subject.cast(&towards).is_some_and(|hit| hit.side == Side::Outside);
            if is_outside {
                hits += 1;
                assert_miss(&subject, reversed);
            }
        }
        assert!(hits > 500, "only {hits} hits");
    }
}

#[test]
fn denormal_sizes_yield_no_nan() {
    let tiny = f64::MIN_POSITIVE / 16.0;
    for solid in [
        Solid::Sphere { center: ORIGIN, radius: tiny },
        Solid::Box { center: ORIGIN, half_size: DVec3::splat(tiny), rotation_degrees: DVec3::splat(10.0) },
        Solid::Cylinder { ends: [DVec3::X * tiny, DVec3::NEG_X * tiny], radius: tiny },
        Solid::Cone { apex: ORIGIN, axis: DVec3::X, height: tiny, half_angle_degrees: 30.0 },
    ] {
        let reference = zerkalo::reference::Solids::new(&[primitive(solid.clone())]);
        let ray = ray(DVec3::new(-1.0, 0.0, 0.0), DVec3::X);
        let hit = reference.nearest(&ray, zerkalo::reference::OriginSurface::Free);
        assert!(hit.is_none_or(|hit| hit.t.is_finite() && hit.point.is_finite()), "{solid:?}: {hit:?}");
    }
}
