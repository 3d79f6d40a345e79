//! How long the last pictures took.

use std::collections::VecDeque;

/// GPU time of the pictures traced last, oldest first.
#[derive(Debug, Clone, Default)]
pub struct FrameTimes {
    samples_ns: VecDeque<u64>,
}

impl FrameTimes {
    /// Enough for a 99th percentile that is not the maximum.
    pub const CAPACITY: usize = 240;

    /// Takes the place of the oldest where there are [`FrameTimes::CAPACITY`] already.
    pub fn push(&mut self, gpu_time_ns: u64) {
        if self.samples_ns.len() == Self::CAPACITY {
            self.samples_ns.pop_front();
        }
        self.samples_ns.push_back(gpu_time_ns);
    }

    /// Times of another picture say nothing of this one.
    pub fn clear(&mut self) {
        self.samples_ns.clear();
    }

    /// Oldest first.
    pub fn samples_ns(&self) -> impl ExactSizeIterator<Item = u64> + '_ {
        self.samples_ns.iter().copied()
    }

    /// The smallest sample that at least `percent` % of them do not exceed (nearest rank); `None` without samples.
    pub fn percentile_ns(&self, percent: u32) -> Option<u64> {
        let mut sorted: Vec<u64> = self.samples_ns.iter().copied().collect();
        sorted.sort_unstable();
        let rank = (sorted.len() * percent as usize).div_ceil(100).max(1);
        sorted.get(rank - 1).copied()
    }

    /// Pictures in a second at the median time: always finite and above 0, or `None`.
    pub fn frames_per_second(&self) -> Option<f64> {
        self.percentile_ns(50).map(|median_ns| 1e9 / median_ns.max(1) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_samples_there_is_no_figure() {
        let times = FrameTimes::default();
        assert_eq!((times.percentile_ns(50), times.frames_per_second()), (None, None));
    }

    #[test]
    fn percentiles_are_samples_by_nearest_rank() {
        let mut times = FrameTimes::default();
        (1..=100).rev().for_each(|time| times.push(time));
        assert_eq!(
            (times.percentile_ns(50), times.percentile_ns(99), times.percentile_ns(100)),
            (Some(50), Some(99), Some(100))
        );
        times.clear();
        times.push(7);
        assert_eq!((times.percentile_ns(1), times.percentile_ns(99)), (Some(7), Some(7)));
    }

    #[test]
    fn only_the_last_are_kept_and_a_time_of_zero_gives_no_infinity() {
        let mut times = FrameTimes::default();
        times.push(u64::MAX);
        (0..FrameTimes::CAPACITY).for_each(|_| times.push(0));
        assert_eq!(times.percentile_ns(100), Some(0));
        assert!(times.frames_per_second().is_some_and(|fps| fps.is_finite() && fps > 0.0));
    }
}
