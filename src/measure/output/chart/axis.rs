//! Linear and logarithmic axes.

use crate::settings::three_digits;

/// From values to parts of its length.
#[derive(Debug, Clone)]
pub struct Axis {
    pub label: &'static str,
    /// The range's ends; powers of ten where the axis is logarithmic.
    low: f64,
    high: f64,
    scale: Scale,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Scale {
    Linear,
    Logarithmic,
    /// And the lower end stands for 0.
    LogarithmicFromZero,
}

impl Axis {
    /// `low` is below `high`.
    pub fn linear(label: &'static str, low: f64, high: f64) -> Self {
        Self { label, low, high, scale: Scale::Linear }
    }

    /// Whole decades around positive values, and one more below with its end for 0 where there is one; at least one.
    pub fn of_decades(label: &'static str, values: &[f64]) -> Self {
        let (least, most) = ends(values).unwrap_or((1.0, 1.0));
        let (low, high) = (least.log10().floor(), most.log10().ceil());
        let (low, scale) =
            if values.contains(&0.0) { (low - 1.0, Scale::LogarithmicFromZero) } else { (low, Scale::Logarithmic) };
        Self { label, low, high: high.max(low + 1.0), scale }
    }

    /// A little more than from the least to the largest of positive values; at least from a half to a double.
    pub fn around(label: &'static str, values: &[f64]) -> Self {
        let (least, most) = ends(values).unwrap_or((1.0, 1.0));
        let (low, high) = (least.log10(), most.log10());
        let room = (0.07 * (high - low)).max(0.15);
        Self { label, low: low - room, high: high + room, scale: Scale::Logarithmic }
    }

    /// Where a value is, from 0 to 1; beyond the ends, the end's. On a logarithmic axis it is not below 0.
    pub fn share(&self, value: f64) -> f64 {
        let value = if self.scale == Scale::Linear { value } else { value.log10() };
        ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    /// Values at which to write a number: ten at most, or decades and in short ranges twos and fives of them.
    pub fn ticks(&self) -> Vec<f64> {
        let slack = 1e-9;
        if self.scale == Scale::Linear {
            let least = (self.high - self.low) / 10.0;
            let decade = 10f64.powf(least.log10().floor());
            let step = [1.0, 2.0, 5.0, 10.0].map(|step| step * decade).into_iter().find(|step| *step >= least - slack);
            let step = step.unwrap_or(least);
            let [first, last] = [(self.low / step - slack).ceil() as i64, (self.high / step + slack).floor() as i64];
            return (first..=last).map(|tick| tick as f64 * step).collect();
        }
        let steps: &[f64] = if self.high - self.low > 2.5 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let values = decades.flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade)));
        let mut ticks: Vec<f64> =
            values.filter(|value| (self.low - slack..=self.high + slack).contains(&value.log10())).collect();
        if self.scale == Scale::LogarithmicFromZero {
            // Nothing between 0 and the first decade has a position.
            ticks.retain(|value| value.log10() >= self.low + 1.0 - slack);
            ticks.insert(0, 0.0);
        }
        ticks
    }
}

/// A tick's number.
pub fn plain(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value) { three_digits(value) } else { format!("{value:.0e}") }
}

/// The least and the largest of the positive finite values.
fn ends(values: &[f64]) -> Option<(f64, f64)> {
    let usable = || values.iter().copied().filter(|value| value.is_finite() && *value > 0.0);
    Some((usable().min_by(f64::total_cmp)?, usable().max_by(f64::total_cmp)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(plain).collect()
    }

    #[test]
    fn linear_ticks_are_few_and_round() {
        assert_eq!(told(&Axis::linear("", 5.0, 105.0)), (1..=10).map(|n| (10 * n).to_string()).collect::<Vec<_>>());
        assert_eq!(told(&Axis::linear("", 0.0, 1.06)), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!([-1.0, 5.0, 30.0, 200.0].map(|x| Axis::linear("", 5.0, 105.0).share(x)), [0.0, 0.0, 0.25, 1.0]);
    }

    #[test]
    fn decades_are_whole_and_ends_are_at_their_places() {
        let axis = Axis::of_decades("", &[0.003, 0.2, f64::INFINITY]);
        assert_eq!(axis.ticks(), [1e-3, 1e-2, 1e-1, 1.0]);
        assert_eq!([1e-3, 1.0, 1e-9, 0.0, 5.0].map(|value| axis.share(value)), [0.0, 1.0, 0.0, 0.0, 1.0]);
        assert!((axis.share(1e-2) - 1.0 / 3.0).abs() < 1e-15);
        assert_eq!(Axis::of_decades("", &[]).ticks(), [1.0, 2.0, 5.0, 10.0], "of nothing");
    }

    #[test]
    fn zero_has_a_place_of_its_own() {
        let axis = Axis::of_decades("", &[0.003, 0.2, 0.0]);
        assert_eq!(axis.ticks(), [0.0, 1e-3, 1e-2, 1e-1, 1.0]);
        assert_eq!([0.0, 1e-3, 1.0].map(|value| axis.share(value)), [0.0, 0.25, 1.0]);
    }

    #[test]
    fn short_ranges_have_twos_and_fives() {
        let axis = Axis::around("", &[4.0, 30.0]);
        assert_eq!(axis.ticks(), [5.0, 10.0, 20.0]);
        assert!(axis.share(4.0) > 0.0 && axis.share(30.0) < 1.0 && axis.share(5.0) < axis.share(10.0));
        assert!((Axis::around("", &[3.0]).share(3.0) - 0.5).abs() < 1e-15, "one value is in the middle");
    }
}
