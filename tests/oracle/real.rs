//! 384-bit floating-point numbers and vectors of them.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use glam::DVec3;

/// The widest cancellation met here, twice the difference of 10¹² radii squared and a needle cone's sine squared,
/// takes about 230 bits.
const BITS: usize = 384;

pub type Real = FBig<HalfEven>;

pub fn real(value: f64) -> Real {
    Real::try_from(value).expect("the oracle takes finite numbers").with_precision(BITS).value()
}

pub fn to_f64(value: &Real) -> f64 {
    value.to_f64().value()
}

pub fn square_root(value: &Real) -> Real {
    value.sqrt()
}

pub fn larger(a: Real, b: Real) -> Real {
    if a < b { b } else { a }
}

pub fn smaller(a: Real, b: Real) -> Real {
    if a < b { a } else { b }
}

pub fn absolute(value: &Real) -> Real {
    if *value < real(0.0) { -value.clone() } else { value.clone() }
}

#[derive(Debug, Clone)]
pub struct Vector(pub [Real; 3]);

impl Vector {
    pub fn new(vector: DVec3) -> Self {
        Self(vector.to_array().map(real))
    }

    pub fn dot(&self, other: &Self) -> Real {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        a * x + b * y + c * z
    }

    pub fn cross(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    pub fn minus(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Self([a - x, b - y, c - z])
    }

    /// self + factor·other
    pub fn plus(&self, factor: &Real, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Self([a + factor * x, b + factor * y, c + factor * z])
    }

    pub fn times(&self, factor: &Real) -> Self {
        Self(self.0.each_ref().map(|component| component * factor))
    }

    pub fn length(&self) -> Real {
        square_root(&self.dot(self))
    }

    pub fn unit(&self) -> Self {
        self.times(&(real(1.0) / self.length()))
    }
}
