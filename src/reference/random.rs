/// Independent numbers, uniform in [0, 1): Salmon, Moraes, Dror and Shaw's Philox4x32-10 (2011).
///
/// It encrypts a counter. Seed, pixel, sample and place in the sequence are the key and the counter, so no two samples
/// ever share a number, and a sample's numbers do not depend on which thread draws it.
pub(super) struct Random {
    key: [u32; 2],
    /// Pixel, its upper half, sample, block within the sample.
    counter: [u32; 4],
    /// A block gives two numbers; the second of the last one, where it is not yet drawn.
    second: Option<f64>,
}

impl Random {
    /// The numbers of one sample of one pixel.
    pub fn of_sample(seed: u64, pixel: u64, sample: u32) -> Self {
        let [pixel_low, pixel_high] = halves(pixel);
        Self { key: halves(seed), counter: [pixel_low, pixel_high, sample, 0], second: None }
    }

    /// A multiple of 2⁻⁵³.
    pub fn number(&mut self) -> f64 {
        if let Some(number) = self.second.take() {
            return number;
        }
        let [a, b, c, d] = philox(self.counter, self.key);
        self.counter[3] = self.counter[3].wrapping_add(1);
        self.second = Some(fraction(c, d));
        fraction(a, b)
    }
}

/// The lower half first.
fn halves(whole: u64) -> [u32; 2] {
    [whole as u32, (whole >> 32) as u32]
}

/// 53 of the 64 bits as a number in [0, 1).
fn fraction(high: u32, low: u32) -> f64 {
    const STEPS: f64 = (1_u64 << 53) as f64;
    let bits = u64::from(high) << 32 | u64::from(low);
    (bits >> 11) as f64 / STEPS
}

fn philox(counter: [u32; 4], key: [u32; 2]) -> [u32; 4] {
    const ROUNDS: u32 = 10;
    const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
    const KEY_STEPS: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
    let (mut block, mut key) = (counter, key);
    for _ in 0..ROUNDS {
        let [low_0, high_0] = halves(u64::from(MULTIPLIERS[0]) * u64::from(block[0]));
        let [low_1, high_1] = halves(u64::from(MULTIPLIERS[1]) * u64::from(block[2]));
        block = [high_1 ^ block[1] ^ key[0], low_1, high_0 ^ block[3] ^ key[1], low_0];
        key = [key[0].wrapping_add(KEY_STEPS[0]), key[1].wrapping_add(KEY_STEPS[1])];
    }
    block
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of Random123, its authors' library: `kat_vectors`.
    #[test]
    fn blocks_are_those_that_its_authors_publish() {
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox([u32::MAX; 4], [u32::MAX; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        let counter = [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344];
        let expected = [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1];
        assert_eq!(philox(counter, [0xa409_3822, 0x299f_31d0]), expected);
    }

    #[test]
    fn numbers_are_uniform_and_differ_with_seed_pixel_and_sample() {
        const COUNT: u32 = 100_000;
        let mut random = Random::of_sample(1, 2, 3);
        let numbers: Vec<f64> = (0..COUNT).map(|_| random.number()).collect();
        assert!(numbers.iter().all(|number| (0.0..1.0).contains(number)));
        // The mean of xⁿ is 1 / (n + 1), and its variance 1 / (2n + 1) less that squared.
        for power in 1..=4 {
            let mean = numbers.iter().map(|number| number.powi(power)).sum::<f64>() / f64::from(COUNT);
            let expected = 1.0 / f64::from(power + 1);
            let variance = 1.0 / f64::from(2 * power + 1) - expected * expected;
            assert!((mean - expected).abs() < 4.0 * (variance / f64::from(COUNT)).sqrt(), "{power}: {mean}");
        }
        let beginnings = [(1, 2, 3), (2, 2, 3), (1 << 32, 2, 3), (1, 3, 3), (1, 2 << 32, 3), (1, 2, 4)]
            .map(|(seed, pixel, sample)| Random::of_sample(seed, pixel, sample).number().to_bits());
        let different: std::collections::HashSet<u64> = beginnings.into_iter().collect();
        assert_eq!(different.len(), beginnings.len());
    }
}
