//! Figures as a language writes them.

use super::Words;

/// What stands for a figure that is not there.
pub const NO_FIGURE: &str = "—";

impl Words {
    /// `12.3 ms`, to three significant digits.
    pub fn milliseconds(&self, time_ns: u64) -> String {
        format!("{} {}", self.three_digits(time_ns as f64 / 1e6), self.milliseconds)
    }

    /// `59.8`, to three significant digits; a dash for anything but a finite rate above 0.
    pub fn frames_per_second(&self, rate: Option<f64>) -> String {
        let rate = rate.filter(|rate| rate.is_finite() && *rate > 0.0);
        rate.map_or_else(|| NO_FIGURE.to_owned(), |rate| self.three_digits(rate))
    }

    /// `0.00312`, with the language's separator.
    pub(in crate::viewer) fn three_digits(&self, value: f64) -> String {
        let magnitude = if value > 0.0 { value.log10().floor() } else { 0.0 };
        let decimals = (2.0 - magnitude).clamp(0.0, 20.0) as usize;
        format!("{value:.decimals$}").replace('.', self.decimal_separator)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Language;
    use super::*;

    #[test]
    fn times_and_rates_have_three_digits_and_the_language_s_separator() {
        let (russian, english) = (Language::Russian.words(), Language::English.words());
        assert_eq!(
            (russian.milliseconds(12_345_678), english.milliseconds(12_345_678)),
            ("12,3 мс".into(), "12.3 ms".into())
        );
        assert_eq!((english.milliseconds(1_234), english.milliseconds(0)), ("0.00123 ms".into(), "0.00 ms".into()));
        assert_eq!(english.milliseconds(4_200_000_000), "4200 ms");
        assert_eq!(
            (russian.frames_per_second(Some(57.14)), english.frames_per_second(Some(1234.5))),
            ("57,1".into(), "1234".into())
        );
    }

    #[test]
    fn a_rate_is_never_zero_infinite_or_not_a_number() {
        let words = Language::English.words();
        for rate in [None, Some(0.0), Some(-1.0), Some(f64::INFINITY), Some(f64::NAN)] {
            assert_eq!(words.frames_per_second(rate), NO_FIGURE, "{rate:?}");
        }
        for slow in [1e-3, 5e-11] {
            assert!(words.frames_per_second(Some(slow)).contains(|c: char| ('1'..='9').contains(&c)), "{slow}");
        }
    }
}
