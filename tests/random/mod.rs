//! Chance that can be repeated.

use glam::DVec3;

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.uniform(0.0, 1.0) < probability
    }

    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 * f64::EPSILON / 2.0
    }

    /// 10^U(low, high)
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.uniform(low, high))
    }

    pub fn vector(&mut self, mut component: impl FnMut(&mut Self) -> f64) -> DVec3 {
        DVec3::new(component(self), component(self), component(self))
    }

    pub fn unit_vector(&mut self) -> DVec3 {
        loop {
            let candidate = self.vector(|random| random.uniform(-1.0, 1.0));
            if (1e-3..=1.0).contains(&candidate.length()) {
                return candidate.normalize();
            }
        }
    }
}
