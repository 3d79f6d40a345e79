use super::{Interval, RecentredLine};
use crate::reference::double_double::{DoubleDouble, DoubleDouble3};
use crate::reference::ray::Face;

/// About its centre.
pub struct Sphere {
    radius: DoubleDouble,
}

impl Sphere {
    pub fn new(radius: f64) -> Self {
        Self { radius: radius.into() }
    }

    /// Half chord by Pythagoras, from the closest point to either end.
    pub fn interval(&self, line: &RecentredLine) -> Option<Interval> {
        let half_chord_squared = self.radius * self.radius - line.closest.length_squared();
        if half_chord_squared < DoubleDouble::ZERO {
            return None;
        }
        let s = (half_chord_squared / line.direction_squared).sqrt();
        Some(Interval::new(-s, Face::Curved, s, Face::Curved))
    }

    pub fn depth(&self, point: DoubleDouble3) -> f64 {
        (self.radius - point.length_squared().sqrt()).rounded()
    }
}
