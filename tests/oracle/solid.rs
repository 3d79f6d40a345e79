//! The four solids in 384 bits, by textbook equations in the world frame: no recentring, no intervals.
//!
//! A crossing is a root of a surface's equation that lies within that face's bounds; the first hit is the least root
//! ahead. (The reference intersects convex intervals instead, so that the two share no reasoning.)

use glam::DVec3;
use zerkalo::reference::{Face, Ray};
use zerkalo::scene::Solid;

use super::real::{Real, Vector, absolute, larger, real, smaller, square_root};

/// A point where a line passes through a solid's surface.
#[derive(Debug, Clone)]
pub struct Crossing {
    pub t: Real,
    pub face: Face,
    /// Outward, unit.
    pub normal: Vector,
}

/// A stored solid, exactly; `grown_by` moves its whole surface outwards.
pub enum TrueSolid {
    Sphere { center: Vector, radius: Real },
    Box { center: Vector, half_size: [Real; 3], axes: Vec<Vector> },
    Cylinder { center: Vector, axis: Vector, half_length: Real, radius: Real },
    Cone { apex: Vector, axis: Vector, height: Real, sin: Real, cos: Real },
}

impl TrueSolid {
    pub fn new(solid: &Solid, grown_by: f64) -> Self {
        let growth = real(grown_by);
        match *solid {
            Solid::Sphere { center, radius } => {
                Self::Sphere { center: Vector::new(center), radius: real(radius) + growth }
            }
            Solid::Box { center, half_size, rotation_degrees } => Self::Box {
                center: Vector::new(center),
                half_size: half_size.to_array().map(|half| real(half) + &growth),
                axes: DVec3::AXES.into_iter().map(|axis| turned(axis, rotation_degrees)).collect(),
            },
            Solid::Cylinder { ends, radius } => {
                let [first, second] = ends.map(Vector::new);
                let axis = second.minus(&first);
                Self::Cylinder {
                    center: first.plus(&real(0.5), &axis),
                    half_length: axis.length() / real(2.0) + &growth,
                    axis: axis.unit(),
                    radius: real(radius) + growth,
                }
            }
            Solid::Cone { apex, axis, height, half_angle_degrees } => {
                let (sin, cos) = sin_cos(half_angle_degrees);
                let axis = Vector::new(axis).unit();
                let apex_shift = &growth / &sin;
                Self::Cone {
                    apex: Vector::new(apex).plus(&-apex_shift.clone(), &axis),
                    axis,
                    height: real(height) + apex_shift + growth,
                    sin,
                    cos,
                }
            }
        }
    }

    /// All crossings of the ray's whole line, in no order.
    pub fn crossings(&self, ray: &Ray) -> Vec<Crossing> {
        let (origin, direction) = (Vector::new(ray.origin), Vector::new(ray.direction));
        let mut crossings = Vec::new();
        let mut add = |t: Real, face: Face, normal: Vector| crossings.push(Crossing { t, face, normal });
        match self {
            Self::Sphere { center, radius } => {
                let from = origin.minus(center);
                let (a, b) = (direction.dot(&direction), from.dot(&direction));
                for t in roots(&a, &b, &(from.dot(&from) - radius * radius)) {
                    let normal = from.plus(&t, &direction).unit();
                    add(t, Face::Curved, normal);
                }
            }
            Self::Box { center, half_size, axes } => {
                let from = origin.minus(center);
                for axis in 0..3 {
                    let slope = direction.dot(&axes[axis]);
                    if slope == real(0.0) {
                        continue;
                    }
                    for (positive, sign) in [(false, -1.0), (true, 1.0)] {
                        let t = (real(sign) * &half_size[axis] - from.dot(&axes[axis])) / &slope;
                        let point = from.plus(&t, &direction);
                        let within = |other: usize| absolute(&point.dot(&axes[other])) <= half_size[other];
                        if (0..3).filter(|&other| other != axis).all(within) {
                            add(t, Face::Slab { axis: axis as u8, positive }, axes[axis].times(&real(sign)));
                        }
                    }
                }
            }
            Self::Cylinder { center, axis, half_length, radius } => {
                let from = origin.minus(center);
                // The distance from the axis is |x × axis|.
                let (moment, turning) = (from.cross(axis), direction.cross(axis));
                let c = moment.dot(&moment) - radius * radius;
                for t in roots(&turning.dot(&turning), &moment.dot(&turning), &c) {
                    let point = from.plus(&t, &direction);
                    let along = point.dot(axis);
                    if absolute(&along) <= *half_length {
                        add(t, Face::Curved, point.plus(&-along, axis).unit());
                    }
                }
                let slope = direction.dot(axis);
                if slope != real(0.0) {
                    for (end, sign) in [(0, -1.0), (1, 1.0)] {
                        let t = (real(sign) * half_length - from.dot(axis)) / &slope;
                        if from.plus(&t, &direction).cross(axis).length() <= *radius {
                            add(t, Face::End(end), axis.times(&real(sign)));
                        }
                    }
                }
            }
            Self::Cone { apex, axis, height, sin, cos } => {
                let from = origin.minus(apex);
                let (along, slope) = (from.dot(axis), direction.dot(axis));
                let cos2 = cos * cos;
                // (x·axis)² = cos²α·x·x
                let a = &cos2 * direction.dot(&direction) - &slope * &slope;
                let b = &cos2 * from.dot(&direction) - &along * &slope;
                let c = &cos2 * from.dot(&from) - &along * &along;
                for t in roots(&a, &b, &c) {
                    let point = from.plus(&t, &direction);
                    let z = point.dot(axis);
                    if z >= real(0.0) && z <= *height {
                        let radial = point.plus(&-z, axis);
                        let length = radial.length();
                        let normal = if length == real(0.0) {
                            axis.times(&real(-1.0))
                        } else {
                            radial.times(&(cos / length)).plus(&-sin.clone(), axis)
                        };
                        add(t, Face::Curved, normal);
                    }
                }
                if slope != real(0.0) {
                    let t = (height - &along) / &slope;
                    let radius = from.plus(&t, &direction).cross(axis).length();
                    if radius * cos <= height * sin {
                        add(t, Face::Base, axis.clone());
                    }
                }
            }
        }
        crossings
    }

    /// The first crossing ahead of the ray's origin; of two at once, as on a plate without thickness, the entering one.
    pub fn first_hit(&self, ray: &Ray) -> Option<Crossing> {
        let direction = Vector::new(ray.direction);
        let enters = |crossing: &Crossing| crossing.normal.dot(&direction) < real(0.0);
        let ahead = self.crossings(ray).into_iter().filter(|crossing| crossing.t > real(0.0));
        ahead.reduce(|best, other| {
            if other.t < best.t || (other.t == best.t && enters(&other) && !enters(&best)) { other } else { best }
        })
    }

    /// Distance of a point from the surface, ≥ 0 on either side.
    pub fn distance(&self, point: &Vector) -> Real {
        match self {
            Self::Sphere { center, radius } => absolute(&(point.minus(center).length() - radius)),
            Self::Box { center, half_size, axes } => {
                let from = point.minus(center);
                distance_from_box([0, 1, 2].map(|i| absolute(&from.dot(&axes[i])) - &half_size[i]).to_vec())
            }
            Self::Cylinder { center, axis, half_length, radius } => {
                let from = point.minus(center);
                distance_from_box(vec![from.cross(axis).length() - radius, absolute(&from.dot(axis)) - half_length])
            }
            Self::Cone { apex, axis, height, sin, cos } => {
                let from = point.minus(apex);
                let (radius, z) = (from.cross(axis).length(), from.dot(axis));
                let slant = height / cos;
                // In the half-plane (radius, z): the side leads from (0, 0) along (sin, cos), the base is at z =
                // height.
                let along_side = smaller(larger(&radius * sin + &z * cos, real(0.0)), slant);
                let side = length_2d(&radius - &along_side * sin, &z - &along_side * cos);
                let beyond_rim = larger(&radius - height * sin / cos, real(0.0));
                smaller(side, length_2d(beyond_rim, z - height))
            }
        }
    }
}

/// Real roots of a·t² + 2b·t + c.
fn roots(a: &Real, b: &Real, c: &Real) -> Vec<Real> {
    let zero = real(0.0);
    if *a == zero {
        return if *b == zero { vec![] } else { vec![-c.clone() / (real(2.0) * b)] };
    }
    let discriminant = b * b - a * c;
    if discriminant < zero {
        return vec![];
    }
    let root = square_root(&discriminant);
    vec![(-b.clone() - &root) / a, (-b.clone() + root) / a]
}

/// From the surface of a box, given by how far a point is beyond each pair of sides.
fn distance_from_box(beyond: Vec<Real>) -> Real {
    let zero = real(0.0);
    if beyond.iter().all(|excess| *excess <= zero) {
        return -beyond.into_iter().reduce(larger).expect("a box has sides");
    }
    let squares = beyond.into_iter().filter(|excess| *excess > zero).map(|excess| &excess * &excess);
    square_root(&squares.reduce(|a, b| a + b).expect("one side is exceeded"))
}

fn length_2d(x: Real, y: Real) -> Real {
    square_root(&(&x * &x + &y * &y))
}

fn sin_cos(angle_degrees: f64) -> (Real, Real) {
    real(angle_degrees).sin_cos_unit(360)
}

/// Rx(−a)·Ry(−b)·Rz(−c) on a vector, one turn after the other.
fn turned(vector: DVec3, rotation_degrees: DVec3) -> Vector {
    let mut turned = Vector::new(vector);
    for (axis, angle_degrees) in rotation_degrees.to_array().into_iter().enumerate().rev() {
        let (sin, cos) = sin_cos(-angle_degrees);
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let (x, y) = (turned.0[i].clone(), turned.0[j].clone());
        turned.0[i] = &x * &cos - &y * &sin;
        turned.0[j] = x * sin + y * cos;
    }
    turned
}
