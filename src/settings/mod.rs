//! Everything that trades time for accuracy, in a user's words: one setting for any scene, kept in a file.

mod file;
mod numbers;
pub mod sampling;
mod shading;

use std::fmt;

use serde::Serialize;

pub use file::SettingsError;
pub use numbers::Numbers;
use sampling::{Sampling, most_samples};
pub use shading::Shading;

use crate::algorithm::{Algorithm, Description, Precision};
use crate::scene::DEPTH_LIMIT;

/// How a picture is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RenderSettings {
    /// What the other fields ask of it, it must be able to do; see [`RenderSettings::check`].
    #[serde(rename = "kernel")]
    pub algorithm: Algorithm,
    /// `None`: as the plan chooses, where the algorithm has a choice.
    pub precision: Option<Precision>,
    /// Largest change of any linear channel by what the plan may leave out; 0: it leaves out nothing.
    pub error: f64,
    /// In place of the scene's.
    pub max_depth: Option<u32>,
    /// Whether rays find solids by boxes around them, or look at each.
    pub boxes: bool,
    /// Samples of a pixel. See [`sampling`].
    pub samples: u32,
    /// Size of the traced picture against the one asked for.
    pub scale: f64,
    /// Of path tracing's random numbers: the same one gives the same picture.
    pub seed: u32,
    /// What kind of random numbers path tracing takes.
    pub numbers: Numbers,
    /// Which part of the light model; plans and tracers are given the scene that it is [applied](Shading::applied) to.
    pub shading: Shading,
}

impl RenderSettings {
    /// The accurate kernel, leaving out nothing.
    pub const DEFAULT: Self = Self {
        algorithm: Algorithm::Whitted,
        precision: None,
        error: 0.0,
        max_depth: None,
        boxes: true,
        samples: 1,
        scale: 1.0,
        seed: 0,
        numbers: Numbers::Sobol,
        shading: Shading::Whitted,
    };
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// A field that does not go with the others, or has an impossible value.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct Contradiction {
    /// Its name in [`RenderSettings`] and in a file.
    pub field: &'static str,
    /// One line, with the value at fault.
    pub what: String,
}

impl RenderSettings {
    /// `samples` and `scale` together; whether they are possible is for [`RenderSettings::check`].
    pub fn sampling(&self) -> Sampling {
        Sampling { samples: self.samples, scale: self.scale }
    }

    /// # Errors
    /// What no kernel can do.
    pub fn check(&self) -> Result<(), Contradiction> {
        let &Self { algorithm, precision, error, max_depth, boxes, samples, scale, seed, numbers, shading } = self;
        let &Description { name, precisions, .. } = algorithm.description();
        let refuse = |field, what: String| Err(Contradiction { field, what });
        if !(error.is_finite() && error >= 0.0) {
            return refuse("error", format!("error = {error}: it must be a number, 0 or greater"));
        }
        if let Some(depth) = max_depth.filter(|depth| !(1..=DEPTH_LIMIT).contains(depth)) {
            return refuse("max_depth", format!("max_depth = {depth}: there must be 1 to {DEPTH_LIMIT} generations"));
        }
        if let Some(precision) = precision.filter(|precision| !precisions.contains(precision)) {
            let own: Vec<_> = precisions.iter().map(|precision| precision.name()).collect();
            let others = Algorithm::names(|other| other.has_precisions() && other.precisions.contains(&precision));
            let own = own.join(" and ");
            return refuse(
                "precision",
                format!("the {name} algorithm calculates in {own} only; {others} can in {}", precision.name()),
            );
        }
        if error > 0.0 && !algorithm.description().approximates {
            let others = Algorithm::names(|other| other.approximates);
            return refuse("error", format!("the {name} algorithm keeps to no error: that is for {others}"));
        }
        if !boxes && !algorithm.description().has_hierarchy {
            return refuse("boxes", format!("the {name} algorithm has no boxes to go without"));
        }
        if shading != Shading::Whitted && !algorithm.description().is_of_accurate_model {
            let what = format!("shading = {}: the {name} algorithm has a light model of its own", shading.name());
            return refuse("shading", what);
        }
        let row = algorithm.description();
        for (field, is_asked) in [("seed", seed != 0), ("numbers", numbers != Numbers::Sobol)] {
            if is_asked && !row.is_statistical {
                let others = Algorithm::names(|other| other.is_statistical);
                return refuse(field, format!("{field} is for the {others} algorithm, not for {name}"));
            }
        }
        // One after the other, so that the field at fault is known.
        let plain = Sampling::PLAIN;
        let can_several = |field: &str, row: &Description| row.samples || (field == "samples" && row.is_statistical);
        for (field, sampling) in [("samples", Sampling { samples, ..plain }), ("scale", Sampling { scale, ..plain })] {
            if let Err(error) = sampling.check(most_samples(row)) {
                return refuse(field, error);
            }
            if sampling != plain && !can_several(field, row) {
                let others = Algorithm::names(|other| can_several(field, other));
                return refuse(field, format!("{field} is for the {others} algorithm, not for {name}"));
            }
        }
        Ok(())
    }
}

impl fmt::Display for RenderSettings {
    /// What differs from an exact picture by default, in a few words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Self { algorithm, precision, error, max_depth, boxes, samples, scale, seed, numbers, shading } = self;
        write!(f, "{}", algorithm.name())?;
        if let Some(precision) = precision.filter(|_| algorithm.description().has_precisions()) {
            write!(f, " {}", precision.name())?;
        }
        if shading != Shading::Whitted {
            write!(f, ", {} shading", shading.name())?;
        }
        if error > 0.0 {
            write!(f, ", error {}", three_digits(error))?;
        }
        match max_depth {
            Some(1) => write!(f, ", 1 generation")?,
            Some(depth) => write!(f, ", {depth} generations")?,
            None => {}
        }
        match samples {
            1 if algorithm.description().is_statistical => write!(f, ", 1 sample")?,
            1 => {}
            samples => write!(f, ", {samples} samples")?,
        }
        if scale < 1.0 {
            write!(f, ", scale {}", three_digits(scale))?;
        }
        if seed != 0 {
            write!(f, ", seed {seed}")?;
        }
        if numbers == Numbers::Independent {
            write!(f, ", independent numbers")?;
        }
        if boxes { Ok(()) } else { write!(f, ", no boxes") }
    }
}

/// A number to three digits, without an exponent where that is short.
pub fn three_digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..6).contains(&magnitude) {
        return format!("{value:.2e}");
    }
    let text = format!("{value:.*}", (2 - magnitude).max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contradictions_name_their_field() {
        let setting = RenderSettings::default();
        let course = RenderSettings { algorithm: Algorithm::Course, ..setting };
        for (setting, field) in [
            (RenderSettings { error: f64::NAN, ..setting }, "error"),
            (RenderSettings { error: -1.0, ..setting }, "error"),
            (RenderSettings { max_depth: Some(0), ..setting }, "max_depth"),
            (RenderSettings { algorithm: Algorithm::Plain, precision: Some(Precision::F64), ..setting }, "precision"),
            (RenderSettings { error: 0.1, ..course }, "error"),
            (RenderSettings { boxes: false, ..course }, "boxes"),
            (RenderSettings { samples: 0, ..setting }, "samples"),
            (RenderSettings { samples: 4, ..course }, "samples"),
            (RenderSettings { scale: 0.1, ..setting }, "scale"),
            (RenderSettings { algorithm: Algorithm::Plain, scale: 0.5, ..setting }, "scale"),
        ] {
            assert_eq!(setting.check().map_err(|contradiction| contradiction.field), Err(field), "{setting:?}");
        }
    }

    #[test]
    fn a_setting_is_told_by_what_it_does_otherwise() {
        let f32 = RenderSettings { precision: Some(Precision::F32), ..RenderSettings::default() };
        assert_eq!(f32.to_string(), "whitted f32");
        let cut = RenderSettings { error: 1.0 / 255.0, max_depth: Some(1), boxes: false, ..f32 };
        assert_eq!(cut.to_string(), "whitted f32, error 0.00392, 1 generation, no boxes");
        assert_eq!(RenderSettings { samples: 4, scale: 0.5, ..f32 }.to_string(), "whitted f32, 4 samples, scale 0.5");
        assert_eq!(
            RenderSettings { algorithm: Algorithm::Plain, max_depth: Some(4), ..f32 }.to_string(),
            "plain, 4 generations"
        );
    }

    #[test]
    fn numbers_have_three_digits() {
        for (value, text) in
            [(0.0, "0"), (0.1, "0.1"), (1.0 / 510.0, "0.00196"), (12.345, "12.3"), (300.0, "300"), (1e-7, "1.00e-7")]
        {
            assert_eq!(three_digits(value), text);
        }
    }
}
