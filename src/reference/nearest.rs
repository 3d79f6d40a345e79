use glam::DVec3;

use super::intersect::{Origin, PreparedSolid};
use super::ray::{Hit, OriginSurface, Ray, Side};
use crate::scene::Primitive;

/// A scene's solids, ready to be met by rays; every one is tested against every ray.
pub struct Solids(Vec<PreparedSolid>);

impl Solids {
    /// Primitives keep their order.
    pub fn new(primitives: &[Primitive]) -> Self {
        Self::about(DVec3::ZERO, primitives)
    }

    /// Rays, hits and lights are given relative to this point of the world frame, without a turn.
    pub(super) fn about(origin: DVec3, primitives: &[Primitive]) -> Self {
        Self(primitives.iter().map(|primitive| PreparedSolid::new(&primitive.solid, origin)).collect())
    }

    /// The nearest hit ahead of the ray's origin; a tie goes to the lowest index. A direction of length 0 or a ray that
    /// is not finite meets nothing.
    pub fn nearest(&self, ray: &Ray, origin_surface: OriginSurface) -> Option<Hit> {
        let direction_squared = ray.direction.length_squared();
        if !(direction_squared > 0.0 && direction_squared.is_finite() && ray.origin.is_finite()) {
            return None;
        }
        let mut nearest: Option<Hit> = None;
        for (primitive, solid, origin) in self.reachable(origin_surface) {
            let Some(hit) = solid.first_hit(ray, origin) else { continue };
            if hit.t < nearest.map_or(f64::INFINITY, |nearest| nearest.t) {
                let (t, point, normal) = (hit.t, hit.point, hit.normal);
                nearest = Some(Hit { t, point, normal, primitive, face: hit.face, side: hit.side });
            }
        }
        nearest
    }

    /// How far a point is above the plane of the face that was hit, 0 in it to rounding; `None` of a curved face.
    pub fn height_above(&self, hit: &Hit, place: DVec3) -> Option<f64> {
        self.0[hit.primitive as usize].height_above(hit.face, hit.side, place)
    }

    /// Whether a solid lies between a point and a light; `origin_surface` is the point's.
    pub fn hide(&self, light_position: DVec3, point: DVec3, origin_surface: OriginSurface) -> bool {
        let ray = Ray { origin: point, direction: light_position - point };
        self.reachable(origin_surface).any(|(_, solid, origin)| solid.hides(light_position, &ray, origin))
    }

    /// The solid that a ray leaves first of those that it begins in; a tie goes to the lowest index.
    pub(super) fn innermost(&self, ray: &Ray, origin_surface: OriginSurface) -> Option<u32> {
        let exits = self.reachable(origin_surface).filter_map(|(index, solid, origin)| {
            let hit = solid.first_hit(ray, origin)?;
            (hit.side == Side::Inside).then_some((index, hit.t))
        });
        // One face of two solids is calculated from other numbers for each, and then rounded.
        const ROUNDED: f64 = 1.0 + 8.0 * f64::EPSILON;
        let is_before = |t: f64, first: Option<(u32, f64)>| first.is_none_or(|(_, other)| t * ROUNDED < other);
        let first = exits.fold(None, |first, (index, t)| if is_before(t, first) { Some((index, t)) } else { first });
        first.map(|(index, _)| index)
    }

    /// The solids between a point and a light, each with how many of its surfaces are; `origin_surface` is the point's.
    pub(super) fn between(
        &self,
        light_position: DVec3,
        point: DVec3,
        origin_surface: OriginSurface,
    ) -> impl Iterator<Item = (u32, u32)> {
        let ray = Ray { origin: point, direction: light_position - point };
        self.reachable(origin_surface)
            .map(move |(index, solid, origin)| (index, solid.surfaces_before(light_position, &ray, origin)))
            .filter(|(_, surfaces)| *surfaces > 0)
    }

    /// The solids that a ray can meet at all, with what its origin is to each.
    fn reachable(&self, origin_surface: OriginSurface) -> impl Iterator<Item = (u32, &PreparedSolid, Origin)> {
        (0u32..).zip(&self.0).filter_map(move |(index, solid)| {
            let origin = match origin_surface {
                OriginSurface::Free => Origin::Free,
                OriginSurface::Surface { primitive, .. } if primitive != index => Origin::OtherSurface,
                // A convex solid lies on one side of every tangent plane.
                OriginSurface::Surface { side: Side::Outside, .. } => return None,
                OriginSurface::Surface { side: Side::Inside, face, .. } => Origin::OwnInside(face),
            };
            Some((index, solid, origin))
        })
    }
}
