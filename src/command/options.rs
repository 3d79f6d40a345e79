//! Options that several commands have.

use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, RangedI64ValueParser, TypedValueParser};

use crate::algorithm::{Algorithm, Description};
use crate::frame::Frame;
use crate::scene::DEPTH_LIMIT;
use crate::settings::sampling::{MAX_PATH_SAMPLES, Sampling};

/// Options that do not go together.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Contradictory(pub(super) &'static str);

/// The name of one of the algorithms that can do something.
pub(super) fn parse_algorithm(can: fn(&Description) -> bool) -> impl TypedValueParser<Value = Algorithm> {
    let able = Algorithm::value_variants().iter().filter(move |algorithm| can(algorithm.description()));
    PossibleValuesParser::new(able.filter_map(ValueEnum::to_possible_value))
        .try_map(|name| <Algorithm as ValueEnum>::from_str(&name, false))
}

pub(super) fn parse_depth() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(DEPTH_LIMIT))
}

pub(super) fn parse_samples() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(MAX_PATH_SAMPLES))
}

/// A number, or a fraction of two.
fn parse_fraction(text: &str) -> Option<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    match text.split_once('/') {
        Some((numerator, denominator)) => Some(number(numerator)? / number(denominator)?),
        None => number(text),
    }
}

/// Such as 0.5 or 1/2.
pub(super) fn parse_scale(text: &str) -> Result<f64, String> {
    let scale = parse_fraction(text).ok_or("it must be a number or a fraction, such as 0.5 or 1/2")?;
    Sampling { scale, ..Sampling::PLAIN }.check(Sampling::PLAIN.samples)?;
    Ok(scale)
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X', '×']);
    let size = sides.and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height) = size.ok_or("it must be WIDTHxHEIGHT in pixels, such as 1621x701")?;
    Frame::check_size(width, height).map_err(|error| error.to_string())?;
    Ok((width, height))
}

/// A finite number, 0 or greater, as a decimal or as a fraction of two.
pub(super) fn parse_error(text: &str) -> Result<f64, String> {
    let value = parse_fraction(text).filter(|value| value.is_finite() && *value >= 0.0);
    value.ok_or_else(|| "it must be a number, 0 or greater, such as 0.002 or 1/510".to_owned())
}

/// A number above 0, as a decimal or as a fraction of two; in seconds, not above what a clock counts.
pub(super) fn parse_positive(text: &str) -> Result<f64, String> {
    let value = parse_fraction(text).filter(|value| *value > 0.0 && *value <= 1e9);
    value.ok_or_else(|| "it must be a number above 0 and up to 10^9, such as 0.002, 1/510 or 60".to_owned())
}

/// A factor of an exported file, which may be any that keeps numbers in range.
pub fn parse_factor(text: &str) -> Result<f64, String> {
    let factor = text.parse::<f64>().ok().filter(|factor| (1e-30..=1e30).contains(factor));
    factor.ok_or("it must be a number from 1e-30 to 1e30".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_decimals_and_fractions_within_the_limits() {
        for (text, scale) in [("1", 1.0), ("0.25", 0.25), ("1/2", 0.5), (" 3 / 4 ", 0.75)] {
            assert_eq!(parse_scale(text), Ok(scale), "{text}");
        }
        for bad in ["", "0", "-1", "1/5", "2", "1/0", "nan", "x", "1/2/3", "0.2499", "inf"] {
            assert!(parse_scale(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn sizes_are_two_sides_within_the_limits() {
        assert_eq!(parse_size("1621x701"), Ok((1621, 701)));
        assert_eq!(parse_size("1X16384"), Ok((1, 16384)));
        for bad in ["", "x", "10", "10x", "0x5", "5x0", "16385x1", "-1x5", "1.5x2", "99999999999x1", "1x2x3"] {
            assert!(parse_size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn errors_are_decimals_and_fractions() {
        for (text, value) in [("0", 0.0), ("0.002", 0.002), ("1/510", 1.0 / 510.0), (" 1 / 2 ", 0.5), ("1e-3", 1e-3)] {
            assert_eq!(parse_error(text), Ok(value), "{text}");
        }
        for bad in ["", "-1", "1/0", "0/0", "nan", "inf", "1/-2", "1/2/3", "/", "x", "1e999", "-1/510"] {
            assert!(parse_error(bad).is_err(), "{bad}");
        }
    }
}
