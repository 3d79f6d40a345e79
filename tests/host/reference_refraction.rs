//! Refraction by the reference, against closed forms: where a ray comes out is told by a target too small to be met by
//! chance.

use crate::reference_pictures::look;
use crate::scenes::{material, primitive, sphere};
use glam::DVec3;
use zerkalo::scene::{Light, Material, Scene, Solid};

const TRANSMISSION: f64 = 0.9;

fn glass(refractive_index: f64) -> Material {
    Material {
        reflection: Some(0.0),
        transmission: TRANSMISSION,
        refractive_index,
        ..Material::of_course(DVec3::ONE, 0.0, 0.0, 0.0)
    }
}

/// Without lights and before black, so that what is seen is the target.
fn dark(solids: Vec<(Solid, Material)>) -> Scene {
    let primitives = solids.into_iter().map(|(solid, material)| primitive(solid, material)).collect();
    Scene { background: DVec3::ZERO, lights: vec![], primitives, ..Scene::default() }
}

/// Whether a ray through these solids, crossing so many surfaces, meets a target of this radius at a place.
fn meets(
    solids: &[(Solid, Material)],
    origin: DVec3,
    direction: DVec3,
    target: DVec3,
    radius: f64,
    surfaces: i32,
) -> bool {
    let mut all = solids.to_vec();
    all.push((sphere(target, radius), material(1.0, 0.0, 0.0)));
    let seen = look(&dark(all), origin, direction.normalize()).color;
    let expected = TRANSMISSION.powi(surfaces) * DVec3::new(0.3, 0.5, 0.7);
    (seen - expected).length() < 1e-14
}

#[test]
fn a_ball_lens_bends_by_twice_the_difference_of_the_angles() {
    for refractive_index in [1.0 + 1e-7, 1.33, 1.5, 2.4, 10.0] {
        for height in [1e-4, 0.1, 0.5, 0.9, 0.999] {
            let (outside, inside) = (f64::asin(height), f64::asin(height / refractive_index));
            let deflection = 2.0 * (outside - inside);
            // The ray leaves at this angle from the axis, seen from the centre.
            let from_ahead = 2.0 * inside - outside;
            let exit = DVec3::new(0.0, from_ahead.sin(), from_ahead.cos());
            let direction = DVec3::new(0.0, -deflection.sin(), deflection.cos());
            let lens = [(sphere(DVec3::ZERO, 1.0), glass(refractive_index))];
            let origin = DVec3::new(0.0, height, -5.0);
            let target = exit + 3.0 * direction;
            assert!(meets(&lens, origin, DVec3::Z, target, 3e-10, 2), "{refractive_index} {height}");
            let beside = target + 1e-8 * DVec3::X;
            assert!(!meets(&lens, origin, DVec3::Z, beside, 1e-9, 2), "the target is small");
        }
    }
}

/// Near the axis a ball's focal length, from its centre, is nR / (2(n − 1)).
#[test]
fn a_ball_lens_has_its_focal_length() {
    for refractive_index in [1.2, 1.5, 1.8] {
        let focus = DVec3::Z * (refractive_index / (2.0 * (refractive_index - 1.0)));
        for height in [1e-5, -1e-5] {
            // The aberration is of the third order of the height.
            let lens = [(sphere(DVec3::ZERO, 1.0), glass(refractive_index))];
            assert!(meets(&lens, DVec3::new(height, 0.0, -9.0), DVec3::Z, focus, 1e-13, 2), "{refractive_index}");
        }
    }
}

#[test]
fn a_slab_shifts_a_ray_and_leaves_its_direction() {
    let thickness = 2.0;
    let slab = |refractive_index| {
        let half_size = DVec3::new(1e3, thickness / 2.0, 1e3);
        [(Solid::Box { center: DVec3::ZERO, half_size, rotation_degrees: DVec3::ZERO }, glass(refractive_index))]
    };
    for refractive_index in [0.9, 1.0, 1.5, 3.0] {
        for angle in [0.0, 0.3, 0.9] {
            let (sine, cosine) = f64::sin_cos(angle);
            let direction = DVec3::new(sine, -cosine, 0.0);
            let inner = f64::asin(sine / refractive_index);
            let exit = DVec3::new(sine / cosine * 4.0 + thickness * inner.tan(), -1.0, 0.0);
            let (origin, target) = (DVec3::Y * 5.0, exit + 7.0 * direction);
            assert!(meets(&slab(refractive_index), origin, direction, target, 1e-13, 2), "{refractive_index} {angle}");
        }
    }
}

/// A ray that enters a block by one face and comes to the next beyond the critical angle goes on as if mirrored there.
#[test]
fn beyond_the_critical_angle_all_is_reflected() {
    let block =
        [(Solid::Box { center: DVec3::ZERO, half_size: DVec3::ONE, rotation_degrees: DVec3::ZERO }, glass(1.5))];
    // In through the face at z = −1 at 45°, mirrored by the one at y = −1, out through the one at z = 1.
    let (enters, inner) = (DVec3::new(0.0, -0.5, -1.0), f64::asin(std::f64::consts::FRAC_1_SQRT_2 / 1.5));
    let outer = DVec3::new(0.0, -1.0, 1.0).normalize();
    let falls = 2.0 * inner.tan();
    let exit = DVec3::new(0.0, -1.0 + (falls - 0.5), 1.0);
    let (origin, direction) = (enters - 4.0 * outer, DVec3::new(0.0, -outer.y, outer.z));
    assert!(meets(&block, origin, outer, exit + 2.0 * direction, 1e-13, 3), "twice let through, once mirrored");
}

#[test]
fn equal_glass_within_glass_is_not_seen_and_no_bending_is_exact() {
    let ball = |radius, refractive_index| (sphere(DVec3::ZERO, radius), glass(refractive_index));
    let (origin, direction) = (DVec3::new(0.1, 0.3, -6.0), DVec3::new(0.01, -0.02, 1.0));
    // Through a sphere of air, straight on to the bit: the target has no room for a rounded ray.
    let target = origin + 12.0 * direction.normalize();
    assert!(meets(&[ball(1.0, 1.0)], origin, direction, target, 1e-14, 2));
    // What bends a ray is the difference of the two refractive indices.
    let (outside, inside) = (f64::asin(0.5), f64::asin(0.5 / 1.5));
    let (deflection, from_ahead) = (2.0 * (outside - inside), 2.0 * inside - outside);
    let exit = DVec3::new(0.0, from_ahead.sin(), from_ahead.cos());
    let target = exit + 3.0 * DVec3::new(0.0, -deflection.sin(), deflection.cos());
    let nested = [ball(1.0, 1.5), ball(0.6, 1.5), ball(0.4, 1.5)];
    assert!(meets(&nested, DVec3::new(0.0, 0.5, -5.0), DVec3::Z, target, 1e-12, 6));
}

/// The light is weakened at each surface that it crosses: twice by a solid, once by a plate, and once by the solid that it
/// is in.
#[test]
fn shadows_of_glass_let_light_through() {
    let floor = (
        Solid::Box { center: DVec3::NEG_Y, half_size: DVec3::new(9.0, 0.5, 9.0), rotation_degrees: DVec3::ZERO },
        material(0.0, 1.0, 0.0),
    );
    let seen = |solids: Vec<(Solid, Material)>, light: DVec3| {
        let lights = vec![Light { position: light, radius: 0.0, ..Light::default() }];
        let scene = Scene { lights, ..dark([vec![floor.clone()], solids].concat()) };
        look(&scene, DVec3::new(0.0, 3.0, -4.0), DVec3::new(0.0, -3.5, 4.0).normalize()).color
    };
    let above = DVec3::Y * 8.0;
    let bare = seen(vec![], above);
    let ball = (sphere(DVec3::Y * 4.0, 1.0), glass(1.7));
    let plate =
        Solid::Box { center: DVec3::Y * 6.0, half_size: DVec3::new(1.0, 0.0, 1.0), rotation_degrees: DVec3::ZERO };
    let cases =
        [(vec![ball.clone()], above, 2), (vec![(plate, glass(1.7))], above, 1), (vec![ball], DVec3::Y * 4.0, 1)];
    for (solids, light, surfaces) in cases {
        let expected = TRANSMISSION.powi(surfaces) * bare;
        let seen = seen(solids, light);
        assert!((seen - expected).length() < 1e-14, "{seen} is not {expected}");
    }
}
