//! What the window offers to draw with, besides a settings' file.

use serde::{Deserialize, Serialize};

use crate::algorithm::{ALGORITHMS, Algorithm, Precision};
use crate::settings::RenderSettings;

/// An algorithm in a precision. In files, their names with a hyphen between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct OwnKernel {
    /// On the Vulkan device or on the CPU.
    pub algorithm: Algorithm,
    /// `None`: as the plan for the scene chooses, where the algorithm has several.
    pub precision: Option<Precision>,
}

impl OwnKernel {
    /// The course work's.
    pub const COURSE: Self = Self { algorithm: Algorithm::Course, precision: None };
    /// The accurate one, in `f32` where that is right.
    pub const ACCURATE: Self = Self { algorithm: Algorithm::Whitted, precision: None };
    /// In `f64` on the CPU.
    pub const REFERENCE: Self = Self { algorithm: Algorithm::Reference, precision: None };

    /// Every algorithm, and those that have several precisions in each.
    pub fn all() -> impl Iterator<Item = Self> {
        ALGORITHMS.iter().flat_map(|row| {
            let precisions = row.precisions.iter().filter(|_| row.has_precisions());
            let precisions = [None].into_iter().chain(precisions.copied().map(Some));
            precisions.map(|precision| Self { algorithm: row.algorithm, precision })
        })
    }

    /// As a request: an exact picture.
    pub fn settings(self) -> RenderSettings {
        let Self { algorithm, precision } = self;
        RenderSettings { algorithm, precision, ..RenderSettings::default() }
    }
}

impl From<OwnKernel> for String {
    fn from(OwnKernel { algorithm, precision }: OwnKernel) -> Self {
        match precision {
            Some(precision) => format!("{}-{}", algorithm.name(), precision.name()),
            None => algorithm.name().to_owned(),
        }
    }
}

impl TryFrom<String> for OwnKernel {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        Self::all().find(|kernel| String::from(*kernel) == name).ok_or_else(|| format!("there is no kernel {name:?}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_that_older_programs_wrote() {
        let names = ["course", "whitted", "whitted-f32", "whitted-f64", "reference"];
        for name in names {
            let kernel = OwnKernel::try_from(name.to_owned()).unwrap();
            assert_eq!(String::from(kernel), name);
        }
        assert_eq!(OwnKernel::all().count(), names.len() + 5, "and those that the window does not offer");
        assert!(OwnKernel::try_from("course-f32".to_owned()).is_err());
    }
}
