//! Ray against one solid: every solid is convex, so a ray's line meets it in one interval with a face at each end.
//!
//! The line is first recentred at its point closest to the solid's anchor (docs/numerics.md, "One idea for all four
//! solids"), then the interval is solved about that point. All of it is done in double-double: the answer is that of
//! the stored ray and solid, rounded once, for silhouettes, needle cones and origins 10¹² radii away alike.

mod cone;
mod cylinder;
mod oriented_box;
mod sphere;

use glam::DVec3;

use super::double_double::{DoubleDouble, DoubleDouble3};
use super::ray::{Face, Ray, Side};
use crate::scene::Solid;
use cone::Cone;
use cylinder::Cylinder;
use oriented_box::OrientedBox;
use sphere::Sphere;

/// 2⁻⁵³: half the distance from 1 to the next `f64`.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// Bounds the error of a computed distance to a surface, relative to |origin| + size: 2⁻⁸⁰, which leaves 24 of the
/// solve's 104 bits to the number of its steps and to the needle cones' conditioning.
const SOLVE_ERROR: f64 = UNIT_ROUNDOFF * UNIT_ROUNDOFF * 67_108_864.0;

/// Bounds the distance of a rounded hit point to any surface through the exact one, relative to |point| + size
/// (docs/numerics.md, "Leaving a surface").
const SURFACE_ERROR: f64 = 8.0 * UNIT_ROUNDOFF;

/// A ray's line about its point closest to a solid's anchor.
struct RecentredLine {
    /// That point, from the anchor, world axes.
    closest: DoubleDouble3,
    direction: DoubleDouble3,
    direction_squared: DoubleDouble,
    /// The ray's t there.
    t_closest: DoubleDouble,
}

impl RecentredLine {
    fn new(ray: &Ray, anchor: DoubleDouble3) -> Self {
        let direction = DoubleDouble3::from(ray.direction);
        let direction_squared = direction.length_squared();
        let origin = DoubleDouble3::from(ray.origin) - anchor;
        let t_closest = -origin.dot(direction) / direction_squared;
        Self { closest: origin + direction * t_closest, direction, direction_squared, t_closest }
    }
}

/// One end of the interval in which a line is inside a solid.
#[derive(Clone, Copy)]
struct End {
    /// From the recentred line's closest point, in lengths of the direction.
    s: DoubleDouble,
    face: Face,
}

/// Where a line is inside a solid or inside one of the solids it is an intersection of; may be empty (near > far) or
/// unbounded.
#[derive(Clone, Copy)]
struct Interval {
    near: End,
    far: End,
}

impl Interval {
    fn new(near: DoubleDouble, near_face: Face, far: DoubleDouble, far_face: Face) -> Self {
        Self { near: End { s: near, face: near_face }, far: End { s: far, face: far_face } }
    }

    /// The line lies inside altogether; the faces are never reached.
    fn whole_line() -> Self {
        Self::new(DoubleDouble::NEG_INFINITY, Face::Curved, DoubleDouble::INFINITY, Face::Curved)
    }

    /// The part inside both. At a tie, to `f64` since equal ends differ by double-double rounding, `self` gives the
    /// face.
    fn intersection(self, other: Self) -> Self {
        Self {
            near: if other.near.s.rounded() > self.near.s.rounded() { other.near } else { self.near },
            far: if other.far.s.rounded() < self.far.s.rounded() { other.far } else { self.far },
        }
    }

    /// The part of a line between two parallel planes, `offset` and `slope` being the line's coordinate across them at
    /// its closest point and per length of its direction; none where a parallel line stays outside.
    fn between_planes(
        offset: DoubleDouble,
        slope: DoubleDouble,
        (low, low_face): (DoubleDouble, Face),
        (high, high_face): (DoubleDouble, Face),
    ) -> Option<Self> {
        if slope == DoubleDouble::ZERO {
            return (low <= offset && offset <= high).then(Self::whole_line);
        }
        let at = |plane: DoubleDouble| (plane - offset) / slope;
        Some(if slope > DoubleDouble::ZERO {
            Self::new(at(low), low_face, at(high), high_face)
        } else {
            Self::new(at(high), high_face, at(low), low_face)
        })
    }
}

enum Shape {
    Sphere(Sphere),
    Box(OrientedBox),
    Cylinder(Cylinder),
    Cone(Cone),
}

/// A solid with the constants its intersection needs.
pub(super) struct PreparedSolid {
    shape: Shape,
    /// Centre, or apex of a cone, from the origin of rays.
    anchor: DoubleDouble3,
    /// The largest of the solid's lengths.
    size: f64,
    /// No point of the solid is farther from the anchor.
    bounding_radius: f64,
}

/// The first hit of a ray on a known solid.
pub(super) struct SolidHit {
    pub t: f64,
    pub point: DVec3,
    /// Unit normal towards the side the ray came from.
    pub normal: DVec3,
    pub face: Face,
    pub side: Side,
}

/// What the origin of a ray is to a solid it may meet.
#[derive(Clone, Copy)]
pub(super) enum Origin {
    /// A point as stored.
    Free,
    /// A rounded point of another solid's surface, which this one's may touch.
    OtherSurface,
    /// A rounded point of this solid's face, left inwards.
    OwnInside(Face),
}

impl PreparedSolid {
    /// `origin`: of rays and hits, world frame.
    pub fn new(solid: &Solid, origin: DVec3) -> Self {
        let from_origin = |place: DoubleDouble3| place - DoubleDouble3::from(origin);
        match *solid {
            Solid::Sphere { center, radius } => Self {
                shape: Shape::Sphere(Sphere::new(radius)),
                anchor: from_origin(center.into()),
                size: radius,
                bounding_radius: radius,
            },
            Solid::Box { center, half_size, rotation_degrees } => Self {
                shape: Shape::Box(OrientedBox::new(half_size, rotation_degrees)),
                anchor: from_origin(center.into()),
                size: half_size.max_element(),
                bounding_radius: half_size.length(),
            },
            Solid::Cylinder { ends, radius } => {
                let [first, second] = ends.map(DoubleDouble3::from);
                let half = DoubleDouble::from(0.5);
                let half_axis = (second - first) * half;
                let half_length = half_axis.length_squared().sqrt();
                Self {
                    shape: Shape::Cylinder(Cylinder::new(half_axis, half_length, radius)),
                    anchor: from_origin((first + second) * half),
                    size: radius.max(half_length.rounded()),
                    bounding_radius: radius.hypot(half_length.rounded()),
                }
            }
            Solid::Cone { apex, axis, height, half_angle_degrees } => {
                let cone = Cone::new(axis, height, half_angle_degrees);
                Self {
                    anchor: from_origin(apex.into()),
                    size: height.max(cone.base_radius()),
                    bounding_radius: height.hypot(cone.base_radius()),
                    shape: Shape::Cone(cone),
                }
            }
        }
    }

    /// First point ahead of the ray's origin: where the ray enters, or leaves if it starts inside.
    ///
    /// An origin within rounding of the surface is on it. The bound is docs/numerics.md's t > 8u(|p|∞ + S)/|n·w|, set
    /// against depths instead: beside an edge the face that the ray leaves by need not be the one that its origin is
    /// on.
    pub fn first_hit(&self, ray: &Ray, origin: Origin) -> Option<SolidHit> {
        let relative_error = match origin {
            Origin::Free => SOLVE_ERROR,
            Origin::OtherSurface => SURFACE_ERROR,
            Origin::OwnInside(face) => return Some(self.exit_from_inside(ray, face)),
        };
        if !self.may_meet(ray) {
            return None;
        }
        let line = RecentredLine::new(ray, self.anchor);
        let interval = self.interval(&line)?;
        if interval.near.s > interval.far.s {
            return None;
        }
        let position_error = self.position_error(ray.origin, relative_error);
        if self.depth(DoubleDouble3::from(ray.origin) - self.anchor) < -position_error {
            let entry = self.hit_at(&line, interval.near, Side::Outside);
            return (entry.t > 0.0).then_some(entry);
        }
        // On the surface or inside, no entry is ahead.
        let exit = self.hit_at(&line, interval.far, Side::Inside);
        (exit.t > 0.0 && self.deepest_ahead(&line, interval) > position_error).then_some(exit)
    }

    /// Where a ray that starts on the inner side of `face` leaves. Rounding may have put its origin a little beyond
    /// this or another face, where the interval is empty or ends behind; but a ray inside a convex solid does leave it:
    /// then it does so where it starts.
    fn exit_from_inside(&self, ray: &Ray, face: Face) -> SolidHit {
        let line = RecentredLine::new(ray, self.anchor);
        match self.interval(&line).map(|interval| self.hit_at(&line, interval.far, Side::Inside)) {
            Some(exit) if exit.t > 0.0 => exit,
            Some(exit) => SolidHit { t: 0.0, point: ray.origin, ..exit },
            None => {
                let from_anchor = DoubleDouble3::from(ray.origin) - self.anchor;
                let normal = self.normal(face, from_anchor, Side::Inside);
                SolidHit { t: 0.0, point: ray.origin, normal, face, side: Side::Inside }
            }
        }
    }

    /// Whether the first hit of a ray whose direction leads from its origin to `target` lies before the target. A
    /// target on this solid's surface, to rounding, is not hidden by it from the side the ray comes from.
    pub fn hides(&self, target: DVec3, ray: &Ray, origin: Origin) -> bool {
        self.first_hit(ray, origin).is_some_and(|hit| {
            let height_of_target = (1.0 - hit.t) * hit.normal.dot(ray.direction).abs();
            height_of_target > self.position_error(target, SURFACE_ERROR)
        })
    }

    /// How many of its surfaces a ray, whose direction leads from its origin to `target`, crosses before the target. As
    /// in [`PreparedSolid::hides`], those on which the target lies are not.
    pub fn surfaces_before(&self, target: DVec3, ray: &Ray, origin: Origin) -> u32 {
        if !self.hides(target, ray, origin) {
            return 0;
        }
        let line = RecentredLine::new(ray, self.anchor);
        let is_from_inside = self.first_hit(ray, origin).is_some_and(|hit| hit.side == Side::Inside);
        match self.interval(&line) {
            Some(interval) if !is_from_inside => {
                let beyond_exit = 1.0 - (line.t_closest + interval.far.s).rounded();
                let leaves = beyond_exit * ray.direction.length() > self.position_error(target, SURFACE_ERROR);
                1 + u32::from(leaves)
            }
            _ => 1,
        }
    }

    /// How far a point is from the plane of a face, on this side of it; `None` of a curved face. A point that lies in
    /// the plane to rounding is not on either side: 0.
    pub fn height_above(&self, face: Face, side: Side, place: DVec3) -> Option<f64> {
        let from_anchor = DoubleDouble3::from(place) - self.anchor;
        let beyond = match (&self.shape, face) {
            (Shape::Box(oriented_box), Face::Slab { axis, positive }) => {
                oriented_box.beyond(axis, positive, from_anchor)
            }
            (Shape::Cylinder(cylinder), Face::End(end)) => cylinder.beyond(end, from_anchor),
            (Shape::Cone(cone), Face::Base) => cone.beyond_base(from_anchor),
            _ => return None,
        };
        let height = match side {
            Side::Outside => beyond.rounded(),
            Side::Inside => -beyond.rounded(),
        };
        let is_in_plane = height.abs() <= self.position_error(place, SURFACE_ERROR);
        Some(if is_in_plane { 0.0 } else { height })
    }

    /// How far a point that was computed to lie on this solid's surface may be off it.
    fn position_error(&self, point: DVec3, relative_error: f64) -> f64 {
        relative_error * (point.abs().max_element() + self.size)
    }

    /// At least half of the greatest depth that the line reaches from its origin on: depth is concave along a chord,
    /// and this is the depth at its midpoint.
    fn deepest_ahead(&self, line: &RecentredLine, interval: Interval) -> f64 {
        let start = interval.near.s.max(-line.t_closest);
        let middle = (start + interval.far.s) * 0.5;
        self.depth(line.closest + line.direction * middle)
    }

    /// Distance from a point inside to the surface; negative outside, where its size is at most the distance.
    fn depth(&self, from_anchor: DoubleDouble3) -> f64 {
        match &self.shape {
            Shape::Sphere(sphere) => sphere.depth(from_anchor),
            Shape::Box(oriented_box) => oriented_box.depth(from_anchor),
            Shape::Cylinder(cylinder) => cylinder.depth(from_anchor),
            Shape::Cone(cone) => cone.depth(from_anchor),
        }
    }

    /// A quick `f64` test that says no only where the line passes the bounding sphere, or the ray leads away from it.
    fn may_meet(&self, ray: &Ray) -> bool {
        let anchor = self.anchor.rounded();
        let origin = ray.origin - anchor;
        let projection = origin.dot(ray.direction);
        let closest = origin - ray.direction * (projection / ray.direction.length_squared());
        // Rounding: anchor and difference u each, closest point below 8u·|origin|.
        let reach = self.bounding_radius + 16.0 * UNIT_ROUNDOFF * (origin.length() + anchor.length() + self.size);
        let reach_squared = reach * reach;
        let passes = closest.length_squared() > reach_squared;
        let leads_away = projection > 0.0 && origin.length_squared() > reach_squared;
        !(passes || leads_away)
    }

    fn interval(&self, line: &RecentredLine) -> Option<Interval> {
        match &self.shape {
            Shape::Sphere(sphere) => sphere.interval(line),
            Shape::Box(oriented_box) => oriented_box.interval(line),
            Shape::Cylinder(cylinder) => cylinder.interval(line),
            Shape::Cone(cone) => cone.interval(line),
        }
    }

    fn hit_at(&self, line: &RecentredLine, end: End, side: Side) -> SolidHit {
        let from_anchor = line.closest + line.direction * end.s;
        SolidHit {
            t: (line.t_closest + end.s).rounded(),
            point: (self.anchor + from_anchor).rounded(),
            normal: self.normal(end.face, from_anchor, side),
            face: end.face,
            side,
        }
    }

    /// Unit normal towards `side` at a point of a face.
    fn normal(&self, face: Face, from_anchor: DoubleDouble3, side: Side) -> DVec3 {
        let outward = match (&self.shape, face) {
            (Shape::Box(oriented_box), Face::Slab { axis, positive }) => oriented_box.normal(axis, positive),
            (Shape::Cylinder(cylinder), Face::End(end)) => cylinder.end_normal(end),
            (Shape::Cylinder(cylinder), _) => cylinder.body_normal(from_anchor),
            (Shape::Cone(cone), Face::Base) => cone.base_normal(),
            (Shape::Cone(cone), _) => cone.side_normal(from_anchor),
            (Shape::Sphere(_) | Shape::Box(_), _) => from_anchor.normalized().rounded(),
        };
        match side {
            Side::Outside => outward,
            Side::Inside => -outward,
        }
    }
}
