//! Logarithmic axes.

/// From values to pixels of the chart.
#[derive(Debug, Clone, Copy)]
pub struct LogAxis {
    /// Of the range's ends, powers of ten.
    low: f64,
    high: f64,
    /// Whether the lower one stands for 0.
    ends_in_zero: bool,
    /// Pixels of these ends.
    from: i32,
    to: i32,
}

impl LogAxis {
    /// Whole decades around positive values, and one more below with its end for 0 where there is one; at least one.
    pub fn of_decades(values: &[f64], [from, to]: [i32; 2]) -> Self {
        let (least, most) = ends(values).unwrap_or((1.0, 1.0));
        let (low, high) = (least.log10().floor(), most.log10().ceil());
        let ends_in_zero = values.contains(&0.0);
        let low = if ends_in_zero { low - 1.0 } else { low };
        Self { low, high: high.max(low + 1.0), ends_in_zero, from, to }
    }

    /// A little more than from the least to the largest of positive values; at least from a half to a double.
    pub fn around(values: &[f64], [from, to]: [i32; 2]) -> Self {
        let (least, most) = ends(values).unwrap_or((1.0, 1.0));
        let (low, high) = (least.log10(), most.log10());
        let room = (0.07 * (high - low)).max(0.15);
        Self { low: low - room, high: high + room, ends_in_zero: false, from, to }
    }

    /// Pixel of a value that is not below 0; beyond the ends, the end's.
    pub fn place(&self, value: f64) -> i32 {
        let share = ((value.log10() - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        self.from + (share * f64::from(self.to - self.from)).round() as i32
    }

    /// Values at which to write a number: decades, and in short ranges twos and fives of them.
    pub fn ticks(&self) -> Vec<f64> {
        let steps: &[f64] = if self.high - self.low > 2.5 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let values = decades.flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade)));
        let slack = 1e-9;
        let mut ticks: Vec<f64> =
            values.filter(|value| (self.low - slack..=self.high + slack).contains(&value.log10())).collect();
        if self.ends_in_zero {
            // Nothing between 0 and the first decade has a place.
            ticks.retain(|value| value.log10() >= self.low + 1.0 - slack);
            ticks.insert(0, 0.0);
        }
        ticks
    }
}

/// The least and the largest of the positive finite values.
fn ends(values: &[f64]) -> Option<(f64, f64)> {
    let usable = || values.iter().copied().filter(|value| value.is_finite() && *value > 0.0);
    Some((usable().min_by(f64::total_cmp)?, usable().max_by(f64::total_cmp)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_whole_and_ends_are_at_their_pixels() {
        let axis = LogAxis::of_decades(&[0.003, 0.2, f64::INFINITY], [100, 400]);
        assert_eq!(axis.ticks(), [1e-3, 1e-2, 1e-1, 1.0]);
        assert_eq!([1e-3, 1e-2, 1.0, 1e-9, 5.0].map(|value| axis.place(value)), [100, 200, 400, 100, 400]);
        assert_eq!(LogAxis::of_decades(&[], [0, 9]).ticks(), [1.0, 2.0, 5.0, 10.0], "of nothing");
    }

    #[test]
    fn zero_has_a_place_of_its_own() {
        let axis = LogAxis::of_decades(&[0.003, 0.2, 0.0], [0, 400]);
        assert_eq!(axis.ticks(), [0.0, 1e-3, 1e-2, 1e-1, 1.0]);
        assert_eq!([0.0, 1e-3, 1.0].map(|value| axis.place(value)), [0, 100, 400]);
    }

    #[test]
    fn short_ranges_have_twos_and_fives() {
        let axis = LogAxis::around(&[4.0, 30.0], [300, 0]);
        assert_eq!(axis.ticks(), [5.0, 10.0, 20.0]);
        assert!(axis.place(4.0) < 300 && axis.place(30.0) > 0 && axis.place(5.0) > axis.place(10.0));
        assert_eq!(LogAxis::around(&[3.0], [300, 0]).place(3.0), 150, "one value is in the middle");
    }
}
