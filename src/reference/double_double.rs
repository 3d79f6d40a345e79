//! Double-double arithmetic: numbers of about 106 significant bits as unevaluated sums of two `f64`.
//!
//! Algorithms and error bounds: Joldeş, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of
//! double-word arithmetic", ACM TOMS 44(2), 2017; u = 2⁻⁵³ below. They hold while no product falls under 2⁻⁹⁶⁹ or
//! overflows: lengths from about 1e-130 to 1e130 are safe in every formula of this module's users.

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

/// hi + lo with |lo| ≤ ½ulp(hi); the order of the pairs is therefore the order of the numbers.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// a + b exactly, as rounded sum and error (Knuth's TwoSum).
#[inline]
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let b_part = hi - a;
    let a_part = hi - b_part;
    DoubleDouble { hi, lo: (a - a_part) + (b - b_part) }
}

/// a + b exactly, where |a| ≥ |b| or a = 0 (Dekker's Fast2Sum).
#[inline]
fn fast_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// a·b exactly, as rounded product and error; `mul_add` is fused on every target, in software if need be.
#[inline]
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    DoubleDouble { hi, lo: a.mul_add(b, -hi) }
}

impl DoubleDouble {
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };
    /// For comparisons only: arithmetic on it yields NaN.
    pub const INFINITY: Self = Self { hi: f64::INFINITY, lo: 0.0 };
    pub const NEG_INFINITY: Self = Self { hi: f64::NEG_INFINITY, lo: 0.0 };

    /// hi + lo, for constants known to more digits than an `f64` holds.
    pub const fn from_parts(hi: f64, lo: f64) -> Self {
        Self { hi, lo }
    }

    /// The nearest `f64`.
    #[inline]
    pub fn rounded(self) -> f64 {
        self.hi
    }

    #[inline]
    pub fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    #[inline]
    pub fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// Square root of a number ≥ 0, relative error below 4u².
    #[inline]
    pub fn sqrt(self) -> Self {
        if self.hi == 0.0 {
            return Self::ZERO;
        }
        let root = self.hi.sqrt();
        let remainder = (-root).mul_add(root, self.hi);
        fast_two_sum(root, (remainder + self.lo) / (2.0 * root))
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

/// AccurateDWPlusDW: relative error below 3.01u², also under cancellation.
impl Add for DoubleDouble {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let high = two_sum(self.hi, other.hi);
        let low = two_sum(self.lo, other.lo);
        let sum = fast_two_sum(high.hi, high.lo + low.hi);
        fast_two_sum(sum.hi, low.lo + sum.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// DWTimesDW3: relative error below 4u².
impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let high = two_product(self.hi, other.hi);
        let cross = self.lo.mul_add(other.hi, self.hi.mul_add(other.lo, self.lo * other.lo));
        fast_two_sum(high.hi, high.lo + cross)
    }
}

/// DWTimesFP3: relative error below 2u².
impl Mul<f64> for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        let high = two_product(self.hi, other);
        fast_two_sum(high.hi, self.lo.mul_add(other, high.lo))
    }
}

/// DWDivDW2: relative error below 15u².
impl Div for DoubleDouble {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let remainder = self - other * quotient;
        fast_two_sum(quotient, remainder.hi / other.hi)
    }
}

/// A vector of double-double components, in the frame its name says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble3 {
    pub x: DoubleDouble,
    pub y: DoubleDouble,
    pub z: DoubleDouble,
}

impl DoubleDouble3 {
    #[inline]
    pub fn new(x: DoubleDouble, y: DoubleDouble, z: DoubleDouble) -> Self {
        Self { x, y, z }
    }

    #[inline]
    pub fn dot(self, other: Self) -> DoubleDouble {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    #[inline]
    pub fn length_squared(self) -> DoubleDouble {
        self.dot(self)
    }

    pub fn normalized(self) -> Self {
        self * (DoubleDouble::ONE / self.length_squared().sqrt())
    }

    /// Each component to the nearest `f64`.
    #[inline]
    pub fn rounded(self) -> DVec3 {
        DVec3::new(self.x.rounded(), self.y.rounded(), self.z.rounded())
    }
}

impl From<DVec3> for DoubleDouble3 {
    #[inline]
    fn from(vector: DVec3) -> Self {
        Self::new(vector.x.into(), vector.y.into(), vector.z.into())
    }
}

impl Neg for DoubleDouble3 {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl Add for DoubleDouble3 {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for DoubleDouble3 {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Mul<DoubleDouble> for DoubleDouble3 {
    type Output = Self;
    #[inline]
    fn mul(self, factor: DoubleDouble) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}
