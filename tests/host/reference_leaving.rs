//! Rays that leave a hit: a surface is neither met again nor lost.

use crate::oracle::{Subject, U, primitive, ray};
use crate::random::Random;
use glam::DVec3;
use zerkalo::reference::{OriginSurface, Side, Solids};
use zerkalo::scene::{Solid, SolidKind};

const SOLIDS: u64 = 400;
const RAYS_A_SOLID: u32 = 10;
const LEAVING_A_HIT: u32 = 100;

#[test]
fn a_ray_leaving_outwards_never_meets_its_solid_nor_one_that_touches_it_there() {
    for kind in SolidKind::ALL {
        let (mut outside_hits, mut leaving, mut met) = (0, 0, Vec::new());
        for seed in 0..SOLIDS {
            let mut random = Random(seed);
            let subject = Subject::new(random.solid(kind));
            // The twin has no exclusion: only the bound on the hit point's rounding keeps it from being met.
            let twins = Solids::new(&[primitive(subject.solid.clone()), primitive(subject.solid.clone())]);
            for _ in 0..RAYS_A_SOLID {
                let incoming = random.ray_at(&subject);
                let Some(hit) = twins.nearest(&incoming, OriginSurface::Free) else { continue };
                assert_eq!(hit.primitive, 0, "a tie goes to the lowest index");
                if hit.side == Side::Inside {
                    continue;
                }
                outside_hits += 1;
                for _ in 0..LEAVING_A_HIT {
                    let direction = random.direction_into(hit.normal);
                    leaving += 1;
                    let again = twins.nearest(&ray(hit.point, direction), hit.origin_surface());
                    met.extend(again.map(|again| format!("{again:?} from {hit:?} of {:?}", subject.solid)));
                }
            }
        }
        println!("{}: {leaving} rays left {outside_hits} hits, {} met it again", kind.name(), met.len());
        assert_eq!(met.first(), None);
        assert!(leaving > 50_000, "only {leaving} rays from {} hits", kind.name());
    }
}

#[test]
fn a_ray_leaving_inwards_meets_the_exit_of_its_solid() {
    for kind in SolidKind::ALL {
        let (mut leaving, mut lost) = (0, 0);
        for seed in 0..SOLIDS {
            let mut random = Random(seed);
            let subject = Subject::new(random.solid(kind));
            let alone = Solids::new(&[primitive(subject.solid.clone())]);
            for _ in 0..RAYS_A_SOLID {
                let incoming = random.ray_at(&subject);
                let Some(mut hit) =
                    alone.nearest(&incoming, OriginSurface::Free).filter(|hit| hit.side == Side::Inside)
                else {
                    continue;
                };
                for _ in 0..LEAVING_A_HIT {
                    let direction = random.direction_into(hit.normal);
                    leaving += 1;
                    let Some(exit) = alone.nearest(&ray(hit.point, direction), hit.origin_surface()) else {
                        lost += 1;
                        break;
                    };
                    assert_eq!(exit.side, Side::Inside);
                    assert!(exit.t >= 0.0 && exit.normal.is_finite());
                    // Rounding of the hit points does not pile up. A point that rounding put outside the base may slide
                    // past a cone's rim, by 1/sin of the angle between base and side.
                    let rim_sine = match subject.solid {
                        Solid::Cone { half_angle_degrees, .. } => half_angle_degrees.to_radians().cos(),
                        _ => 1.0,
                    };
                    let tolerance = 8.0 * U * (exit.point.abs().max_element() + subject.size) / rim_sine;
                    let error = subject.distance(exit.point);
                    assert!(
                        error <= tolerance,
                        "{exit:?} is {error} off: {direction:?} from {hit:?} in {:?}",
                        subject.solid
                    );
                    hit = exit;
                }
            }
        }
        println!("{}: {leaving} rays inwards, {lost} lost", kind.name());
        assert_eq!(lost, 0);
        assert!(leaving > 20_000, "only {leaving} rays in {}", kind.name());
    }
}

#[test]
fn a_ray_through_the_contact_of_two_spheres_meets_one_of_them() {
    let spheres = [0.0, 2.0].map(|x| primitive(Solid::Sphere { center: DVec3::new(x, 0.0, 0.0), radius: 1.0 }));
    let solids = Solids::new(&spheres);
    let mut random = Random(7);
    for _ in 0..10_000 {
        let origin = random.unit_vector() * 10.0;
        if origin.x.abs() < 2.0 {
            // A ray nearly in the plane between the spheres may touch the contact alone.
            continue;
        }
        let through = ray(origin, (DVec3::X - origin).normalize());
        assert!(solids.nearest(&through, OriginSurface::Free).is_some(), "{through:?} leaks");
    }
}
