//! Statistics of repeated measurements of one time.

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Tukey's far-out fences stand this many interquartile ranges outside the quartiles (J. W. Tukey, Exploratory Data
/// Analysis, 1977, 2C). They ask nothing of the distribution, whose slow side is long for times, and fewer than five
/// samples never reach beyond them.
const FENCE_RANGES: f64 = 3.0;

/// A sample this near to the median, in parts of it, is no outlier whatever the fences: a device whose samples differ
/// by a tick of its clock would else warn of the tick.
const UNREMARKABLE_SHARE: f64 = 0.01;

/// The middle of the sorted samples; of an even number, the mean of both middle ones, rounded down. `None` without
/// samples.
pub fn median(samples_ns: &[u64]) -> Option<u64> {
    median_of_sorted(&sorted(samples_ns))
}

/// First quartile, median and third quartile, between values as in `Summary::quartiles_ns`. `None` without values.
pub fn quartiles(values: &[f64]) -> Option<[f64; 3]> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    (!sorted.is_empty()).then(|| [0.25, 0.5, 0.75].map(|share| quantile(&sorted, share)))
}

/// What one more value of their kind does not exceed with a confidence of 95 %: m + t·s·√(1 + 1/n) of n values of mean m
/// and standard deviation s, t Student's quantile of n − 1 degrees of freedom (Hahn and Meeker, Statistical Intervals,
/// 1991, 4.7), which takes the values for normally distributed. `None` of fewer than two.
pub fn prediction_limit(values: &[f64]) -> Option<f64> {
    let n = values.len() as f64;
    let student = StudentsT::new(0.0, 1.0, n - 1.0).ok()?;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
    Some(mean + student.inverse_cdf(0.95) * (variance * (1.0 + 1.0 / n)).sqrt())
}

/// Samples of one time, nanoseconds, in figures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Samples.
    pub count: usize,
    pub median_ns: u64,
    pub min_ns: u64,
    pub max_ns: u64,
    /// A quarter of the samples is below the first, a quarter above the second; between samples by linear
    /// interpolation (type 7 of Hyndman and Fan, Sample Quantiles in Statistical Packages, 1996).
    pub quartiles_ns: [f64; 2],
    pub mean_ns: f64,
    /// Standard deviation of the samples' distribution (n − 1 in the denominator); one sample has none.
    pub stddev_ns: Option<f64>,
    /// Where in the samples those stand that are beyond [`Summary::fences_ns`] and not within 1 % of the median.
    pub outliers: Vec<usize>,
}

impl Summary {
    /// `None` without samples.
    pub fn of(samples_ns: &[u64]) -> Option<Self> {
        let sorted = sorted(samples_ns);
        let median_ns = median_of_sorted(&sorted)?;
        let count = sorted.len();
        let values: Vec<f64> = sorted.iter().map(|&sample| sample as f64).collect();
        let mean_ns = samples_ns.iter().map(|&sample| sample as f64).sum::<f64>() / count as f64;
        let squares: f64 = samples_ns.iter().map(|&sample| (sample as f64 - mean_ns).powi(2)).sum();
        let mut summary = Self {
            count,
            median_ns,
            min_ns: sorted[0],
            max_ns: sorted[count - 1],
            quartiles_ns: [quantile(&values, 0.25), quantile(&values, 0.75)],
            mean_ns,
            stddev_ns: (count > 1).then(|| (squares / (count - 1) as f64).sqrt()),
            outliers: Vec::new(),
        };
        let is_outlier = |sample: &u64| summary.is_outlier(*sample);
        summary.outliers = (0..count).filter(|&index| is_outlier(&samples_ns[index])).collect();
        Some(summary)
    }

    /// Range of the middle half of the samples: no single sample moves it.
    pub fn interquartile_range_ns(&self) -> f64 {
        self.quartiles_ns[1] - self.quartiles_ns[0]
    }

    /// Three interquartile ranges below the first quartile and above the second.
    pub fn fences_ns(&self) -> [f64; 2] {
        let reach = FENCE_RANGES * self.interquartile_range_ns();
        [self.quartiles_ns[0] - reach, self.quartiles_ns[1] + reach]
    }

    fn is_outlier(&self, sample_ns: u64) -> bool {
        let [low, high] = self.fences_ns();
        let off = sample_ns.abs_diff(self.median_ns) as f64;
        !(low..=high).contains(&(sample_ns as f64)) && off > UNREMARKABLE_SHARE * self.median_ns as f64
    }
}

fn sorted(samples_ns: &[u64]) -> Vec<u64> {
    let mut sorted = samples_ns.to_vec();
    sorted.sort_unstable();
    sorted
}

fn median_of_sorted(sorted: &[u64]) -> Option<u64> {
    let (low, high) = (sorted.len().checked_sub(1)? / 2, sorted.len() / 2);
    Some(sorted[low].midpoint(sorted[high]))
}

/// Quantile of at least one sample.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let (low, high) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    low + (high - low) * place.fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_is_the_middle_or_the_mean_of_two() {
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[7]), Some(7));
        assert_eq!(median(&[9, 1, 5]), Some(5));
        assert_eq!(median(&[1, 2, 8, 100]), Some(5));
        assert_eq!(median(&[u64::MAX, u64::MAX]), Some(u64::MAX));
    }

    #[test]
    fn quartiles_lie_between_values() {
        assert_eq!(quartiles(&[]), None);
        assert_eq!(quartiles(&[2.0]), Some([2.0; 3]));
        assert_eq!(quartiles(&[4.0, 1.0, 2.0, 3.0, 5.0]), Some([2.0, 3.0, 4.0]));
    }

    #[test]
    fn without_samples_there_is_no_summary_and_one_sample_has_no_deviation() {
        assert_eq!(Summary::of(&[]), None);
        let one = Summary::of(&[7]).unwrap();
        assert_eq!((one.count, one.median_ns, one.min_ns, one.max_ns), (1, 7, 7, 7));
        assert_eq!((one.quartiles_ns, one.stddev_ns), ([7.0, 7.0], None));
        assert!(one.outliers.is_empty());
    }

    #[test]
    fn the_figures_are_those_of_the_textbook() {
        // numpy: percentile([2, 4, 4, 4, 5, 5, 7, 9], [25, 75]) = [4, 5.5], std(ddof=1) = sqrt(32 / 7), mean 5.
        let summary = Summary::of(&[9, 2, 4, 5, 4, 7, 4, 5]).unwrap();
        assert_eq!((summary.median_ns, summary.min_ns, summary.max_ns), (4, 2, 9));
        assert_eq!((summary.quartiles_ns, summary.mean_ns), ([4.0, 5.5], 5.0));
        assert_eq!(summary.interquartile_range_ns(), 1.5);
        // The root is rounded from a quotient rounded before: a unit in the last place, which is 2ε between 2 and 4.
        assert!((summary.stddev_ns.unwrap() - (32.0_f64 / 7.0).sqrt()).abs() <= f64::EPSILON * 2.0);
    }

    #[test]
    fn nineteen_of_twenty_values_more_are_within_the_limit_of_those_before() {
        // Of 1, 2, 3: mean 2, deviation 1, and Student's table has 2.920 for two degrees of freedom.
        assert!((prediction_limit(&[1.0, 2.0, 3.0]).unwrap() - (2.0 + 2.920 * (4.0_f64 / 3.0).sqrt())).abs() < 1e-3);
        assert_eq!(prediction_limit(&[0.5; 4]), Some(0.5));
        assert_eq!((prediction_limit(&[]), prediction_limit(&[1.0])), (None, None));
        // Sums of twelve uniform numbers are nearly normal. Of 20000 fives of them 5 % ± 0.15 % are exceeded by the next:
        // four standard deviations are 0.6 %.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>();
        let exceeded = (0..20_000).filter(|_| {
            let values: [f64; 5] = std::array::from_fn(|_| normal());
            normal() > prediction_limit(&values).unwrap()
        });
        let share = exceeded.count() as f64 / 20_000.0;
        assert!((share - 0.05).abs() < 0.006, "{share}");
    }

    #[test]
    fn outliers_are_named_by_their_place_beyond_three_ranges() {
        let summary = Summary::of(&[100, 104, 900, 102, 98, 96, 5]).unwrap();
        assert_eq!(summary.quartiles_ns, [97.0, 103.0]);
        assert_eq!(summary.fences_ns(), [79.0, 121.0]);
        assert_eq!(summary.outliers, [2, 6]);
        // On the fence is inside.
        assert!(Summary::of(&[100, 104, 121, 102, 98, 96, 79]).unwrap().outliers.is_empty());
    }

    #[test]
    fn few_samples_and_the_ticks_of_a_coarse_clock_are_no_outliers() {
        assert!(Summary::of(&[1, 1, 1, 1_000_000]).unwrap().outliers.is_empty(), "what is usual is not known yet");
        assert!(Summary::of(&[1000, 1000, 1000, 1000, 1000, 1010]).unwrap().outliers.is_empty(), "1 %");
        assert_eq!(Summary::of(&[1000, 1000, 1000, 1000, 1000, 1011]).unwrap().outliers, [5]);
    }
}
