//! An arbitrary-precision judge of single rays, and the tolerances of docs/numerics.md.

pub mod rays;
mod real;
mod solid;

use std::fmt;

use glam::DVec3;
use zerkalo::reference::{Hit, OriginSurface, Ray, Side, Solids};
use zerkalo::scene::{Material, Primitive, Solid};

use real::{Vector, real, to_f64};
use solid::{Crossing, TrueSolid};

/// 2⁻⁵³
pub const U: f64 = f64::EPSILON / 2.0;

pub fn primitive(solid: Solid) -> Primitive {
    Primitive { name: None, solid, material: Material::default() }
}

pub fn ray(origin: DVec3, direction: DVec3) -> Ray {
    Ray { origin, direction }
}

/// A solid as the reference and as the oracle see it.
pub struct Subject {
    pub solid: Solid,
    pub size: f64,
    reference: Solids,
    exact: TrueSolid,
    /// With the surface moved out and in by 10⁻⁶ of the size.
    grown: TrueSolid,
    shrunk: TrueSolid,
}

impl Subject {
    pub fn new(solid: Solid) -> Self {
        let size = size(&solid);
        Self {
            size,
            reference: Solids::new(&[primitive(solid.clone())]),
            exact: TrueSolid::new(&solid, 0.0),
            grown: TrueSolid::new(&solid, 1e-6 * size),
            shrunk: TrueSolid::new(&solid, -1e-6 * size),
            solid,
        }
    }

    /// A free ray by the reference.
    pub fn cast(&self, ray: &Ray) -> Option<Hit> {
        self.reference.nearest(ray, OriginSurface::Free)
    }

    /// Distance of a point from the surface.
    pub fn distance(&self, point: DVec3) -> f64 {
        to_f64(&self.exact.distance(&Vector::new(point)))
    }

    /// The radius of a ball about [`rays::middle`] that is about as large as the solid holds.
    pub fn least_length(&self) -> f64 {
        match self.solid {
            Solid::Sphere { radius, .. } => radius,
            Solid::Box { half_size, .. } => half_size.min_element(),
            Solid::Cylinder { ends: [first, second], radius } => radius.min((second - first).length() / 2.0),
            Solid::Cone { height, half_angle_degrees, .. } => height / 2.0 * half_angle_degrees.to_radians().sin(),
        }
    }

    /// Whether hit or miss hangs on less than `distance`: the solid grown by it is hit, shrunk by it missed. What is no
    /// thicker than that shrinks to nothing.
    pub fn is_within_band(&self, distance: f64, ray: &Ray) -> bool {
        let is_hit = |grown_by: f64| TrueSolid::new(&self.solid, grown_by).first_hit(ray).is_some();
        is_hit(distance) != (distance < self.inner_radius() && is_hit(-distance))
    }

    /// Of the largest ball that the solid holds.
    fn inner_radius(&self) -> f64 {
        match self.solid {
            Solid::Cone { height, half_angle_degrees, .. } => {
                let sin = half_angle_degrees.to_radians().sin();
                height * sin / (1.0 + sin)
            }
            _ => self.least_length(),
        }
    }
}

/// The largest of a solid's lengths.
pub fn size(solid: &Solid) -> f64 {
    match *solid {
        Solid::Sphere { radius, .. } => radius,
        Solid::Box { half_size, .. } => half_size.max_element(),
        Solid::Cylinder { ends: [first, second], radius } => radius.max((second - first).length() / 2.0),
        Solid::Cone { height, half_angle_degrees, .. } => height.max(height * half_angle_degrees.to_radians().tan()),
    }
}

/// Centre, or apex of a cone.
pub fn anchor(solid: &Solid) -> DVec3 {
    match *solid {
        Solid::Sphere { center, .. } | Solid::Box { center, .. } => center,
        Solid::Cylinder { ends: [first, second], .. } => (first + second) / 2.0,
        Solid::Cone { apex, .. } => apex,
    }
}

/// What was found over many rays. Errors are in units of their tolerances: above 1 is a violation.
#[derive(Debug, Default)]
pub struct Report {
    pub rays: u32,
    pub hits: u32,
    pub inside_hits: u32,
    /// Rays whose hit or miss would change if the solid's size did by 10⁻⁶ of itself.
    pub silhouette_rays: u32,
    /// Hit or miss that differs from the truth though the ray clears the silhouette by more than the band.
    pub wrong_outside_band: u32,
    pub wrong_inside_band: u32,
    pub wrong_face_or_side: u32,
    /// |sdf(o + t·d)| over ½ulp(t)·|d| + 4uS
    pub worst_t: f64,
    /// |sdf(p)| over 4u(|c|∞ + S)
    pub worst_point: f64,
    /// |n − true n| over 8u/|cosθ|
    pub worst_normal: f64,
    /// ||n| − 1| over 4u
    pub worst_length: f64,
    pub first_bad: Option<String>,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "{} rays, {} hits ({} inside), {} near silhouettes; wrong {} outside and {} inside the band, {} faces; worst \
             T {:.3}, P {:.3}, N {:.3}, |n| {:.3}",
            self.rays,
            self.hits,
            self.inside_hits,
            self.silhouette_rays,
            self.wrong_outside_band,
            self.wrong_inside_band,
            self.wrong_face_or_side,
            self.worst_t,
            self.worst_point,
            self.worst_normal,
            self.worst_length
        )
    }
}

impl Report {
    /// Casts a ray with the reference and compares with the truth.
    pub fn judge(&mut self, subject: &Subject, ray: &Ray) -> Option<Hit> {
        let hit = subject.cast(ray);
        let truth = subject.exact.first_hit(ray);
        self.rays += 1;
        self.hits += u32::from(hit.is_some());
        if subject.grown.first_hit(ray).is_some() != subject.shrunk.first_hit(ray).is_some() {
            self.silhouette_rays += 1;
        }
        self.compare(subject, ray, hit, truth);
        hit
    }

    fn compare(&mut self, subject: &Subject, ray: &Ray, hit: Option<Hit>, truth: Option<Crossing>) {
        let Subject { solid, exact, size, .. } = subject;
        let (hit, truth) = match (hit, truth) {
            (None, None) => return,
            (Some(hit), Some(truth)) => (hit, truth),
            _ if subject.is_within_band(8.0 * U * size, ray) => {
                self.wrong_inside_band += 1;
                return;
            }
            (hit, _) => {
                self.wrong_outside_band += 1;
                self.remember(format!("{hit:?} is wrong: {solid:?} {ray:?}"));
                return;
            }
        };
        self.inside_hits += u32::from(hit.side == Side::Inside);
        let direction = Vector::new(ray.direction);
        let leaves = truth.normal.dot(&direction) > real(0.0);
        if hit.face != truth.face || leaves != (hit.side == Side::Inside) {
            self.wrong_face_or_side += 1;
            self.remember(format!("{hit:?} should be {:?}, leaving {leaves}: {solid:?} {ray:?}", truth.face));
            return;
        }
        let at_t = Vector::new(ray.origin).plus(&real(hit.t), &direction);
        let t_bar = ulp(hit.t) / 2.0 * ray.direction.length() + 4.0 * U * size;
        let t_error = to_f64(&exact.distance(&at_t)) / t_bar;
        let point_bar = 4.0 * U * (anchor(solid).abs().max_element() + size);
        let point_error = to_f64(&exact.distance(&Vector::new(hit.point))) / point_bar;
        let true_normal = if leaves { truth.normal.times(&real(-1.0)) } else { truth.normal };
        let normal = Vector::new(hit.normal);
        let cosine = to_f64(&(true_normal.dot(&direction) / direction.length())).abs();
        let normal_error = to_f64(&normal.minus(&true_normal).length()) * cosine / (8.0 * U);
        let length_error = to_f64(&(normal.length() - real(1.0))).abs() / (4.0 * U);
        if [t_error, point_error, normal_error, length_error].into_iter().any(|error| error.is_nan() || error > 1.0) {
            self.remember(format!(
                "T {t_error} P {point_error} N {normal_error} |n| {length_error}: {hit:?} {solid:?} {ray:?}"
            ));
        }
        self.worst_t = self.worst_t.max(t_error);
        self.worst_point = self.worst_point.max(point_error);
        self.worst_normal = self.worst_normal.max(normal_error);
        self.worst_length = self.worst_length.max(length_error);
    }

    /// Prints the figures; fails on any violation and on too few hits.
    pub fn require(&self, title: &str, least_hits: u32) {
        println!("{title}: {self}");
        assert_eq!(self.first_bad, None, "{title}: {self}");
        assert!(self.hits >= least_hits, "{title}: only {} hits, {least_hits} wanted", self.hits);
    }

    fn remember(&mut self, description: String) {
        self.first_bad.get_or_insert(description);
    }
}

/// From |t| to the next larger `f64`.
pub fn ulp(t: f64) -> f64 {
    t.abs().next_up() - t.abs()
}
