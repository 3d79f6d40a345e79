//! The algorithms: what each is called, where it runs, what it can calculate in and what it can leave out.
//!
//! The command line, the window, measurements, validation and reports read [`ALGORITHMS`]; a new algorithm is a row
//! there, its GLSL in a folder of its own, and what a driver needs to record it (see docs/adding-an-algorithm.md).

mod precision;

use clap::ValueEnum;
use clap::builder::PossibleValue;
use serde::{Deserialize, Serialize};

pub use precision::Precision;

/// By its name on the command line, in files and in JSON.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Algorithm {
    /// The course work's own kernel, its quirks included, in `f32`: not the accurate model.
    Course,
    /// The accurate model by textbook quadratics in `f32`.
    Plain,
    /// The accurate model with compensated sums where rounding would show.
    #[default]
    Whitted,
    /// The accurate model, but that mirrors show only what the camera sees, in `f32`.
    Ssr,
    /// Path tracing of the accurate model, where light that comes from everywhere takes the place of ambient light.
    Path,
    /// The accurate model in `f64` on the CPU, without Vulkan.
    Reference,
}

/// An algorithm in a precision, as a Vulkan device runs it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// `f32`.
    Course,
    /// `f32`.
    Plain,
    /// `f32` or `f64`; not every device has the latter.
    Whitted(Precision),
    /// `f32`.
    Ssr,
    /// `f32` or `f64`; not every device has the latter.
    Path(Precision),
}

/// A row of [`ALGORITHMS`].
#[derive(Debug)]
pub struct Description {
    /// The rows are in the order of its variants.
    pub algorithm: Algorithm,
    /// On the command line, in files, in JSON and in messages.
    pub name: &'static str,
    /// For `--help`.
    pub about: &'static str,
    /// What it can calculate in, the usual one first.
    pub precisions: &'static [Precision],
    /// What a Vulkan device runs, one for each precision; none where the CPU does the work.
    pub kernels: &'static [Kernel],
    /// Whether it can leave out what changes a picture by less than an allowed error.
    pub approximates: bool,
    /// Whether its rays find solids by boxes around them, and can do without.
    pub has_hierarchy: bool,
    /// Whether a pixel may have several samples at fixed places, and a picture be upscaled from a smaller one.
    pub samples: bool,
    /// Whether its pictures are estimates from random numbers: with a seed, any number of samples and a standard error.
    pub is_statistical: bool,
    /// Whether what a scene lacks is compiled out of it.
    pub is_specialized: bool,
    /// Whether it draws the accurate model, and not the course work's.
    pub is_of_accurate_model: bool,
    /// Whether its pictures are those of the accurate model, to the tolerances of its precision.
    pub is_accurate: bool,
    /// Whether it calculates in `f32` from the camera where lengths are far apart.
    pub has_close_ups: bool,
    /// Whether table 4.1 of the course work is measured with it unless others are asked for.
    pub is_in_fps_table: bool,
    /// What the note's table 1.1 says of it: its rank by frame time (1: the quickest), by realism (1: the least), and
    /// whether it is noisy (1).
    pub table_1_1: Option<[u32; 3]>,
}

/// Every algorithm, the course work's first.
pub static ALGORITHMS: [Description; 6] = [
    Description {
        algorithm: Algorithm::Course,
        name: "course",
        about: "The course work's, quirks and all",
        precisions: &[Precision::F32],
        kernels: &[Kernel::Course],
        approximates: false,
        has_hierarchy: false,
        samples: false,
        is_statistical: false,
        is_specialized: false,
        is_of_accurate_model: false,
        is_accurate: false,
        has_close_ups: false,
        is_in_fps_table: true,
        table_1_1: None,
    },
    Description {
        algorithm: Algorithm::Plain,
        name: "plain",
        about: "The accurate model by textbook quadratics in f32: what accuracy costs and gains is measured against it",
        precisions: &[Precision::F32],
        kernels: &[Kernel::Plain],
        approximates: true,
        has_hierarchy: true,
        samples: false,
        is_statistical: false,
        is_specialized: true,
        is_of_accurate_model: true,
        is_accurate: false,
        has_close_ups: false,
        is_in_fps_table: false,
        table_1_1: None,
    },
    Description {
        algorithm: Algorithm::Whitted,
        name: "whitted",
        about: "The accurate model",
        precisions: &[Precision::F32, Precision::F64],
        kernels: &[Kernel::Whitted(Precision::F32), Kernel::Whitted(Precision::F64)],
        approximates: true,
        has_hierarchy: true,
        samples: true,
        is_statistical: false,
        is_specialized: true,
        is_of_accurate_model: true,
        is_accurate: true,
        has_close_ups: true,
        is_in_fps_table: true,
        table_1_1: Some([2, 2, 0]),
    },
    Description {
        algorithm: Algorithm::Ssr,
        name: "ssr",
        about: "Screen-space reflections: the accurate model, but mirrors show only what the camera sees; no refraction",
        precisions: &[Precision::F32],
        kernels: &[Kernel::Ssr],
        approximates: false,
        has_hierarchy: true,
        samples: false,
        is_statistical: false,
        is_specialized: true,
        is_of_accurate_model: true,
        is_accurate: false,
        has_close_ups: true,
        is_in_fps_table: false,
        table_1_1: Some([1, 1, 0]),
    },
    Description {
        algorithm: Algorithm::Path,
        name: "path",
        about: "Path tracing: light from everywhere in place of ambient light, by random paths",
        precisions: &[Precision::F32, Precision::F64],
        kernels: &[Kernel::Path(Precision::F32), Kernel::Path(Precision::F64)],
        approximates: false,
        has_hierarchy: true,
        samples: false,
        is_statistical: true,
        is_specialized: true,
        is_of_accurate_model: true,
        is_accurate: false,
        has_close_ups: true,
        is_in_fps_table: false,
        table_1_1: Some([3, 3, 1]),
    },
    Description {
        algorithm: Algorithm::Reference,
        name: "reference",
        about: "The accurate model in f64 on the CPU, without Vulkan: the truth, slowly",
        precisions: &[Precision::F64],
        kernels: &[],
        approximates: false,
        has_hierarchy: false,
        samples: false,
        is_statistical: false,
        is_specialized: false,
        is_of_accurate_model: true,
        is_accurate: true,
        has_close_ups: false,
        is_in_fps_table: false,
        table_1_1: None,
    },
];

impl Description {
    /// Whether Vulkan runs it, rather than this program on the CPU.
    pub fn is_on_device(&self) -> bool {
        !self.kernels.is_empty()
    }

    /// Whether a Vulkan device runs it, and its pictures do not depend on chance.
    pub fn is_deterministic(&self) -> bool {
        self.is_on_device() && !self.is_statistical
    }

    /// Whether its rays can be tried one by one: what a picture shows comes of them alone.
    pub fn casts_rays(&self) -> bool {
        self.is_deterministic() && !self.kernels.iter().any(|kernel| kernel.draws_whole())
    }

    /// Whether a precision can be asked for.
    pub fn has_precisions(&self) -> bool {
        self.precisions.len() > 1
    }
}

impl Algorithm {
    /// Its row of [`ALGORITHMS`].
    pub fn description(self) -> &'static Description {
        // invariant: the rows are in the order of the names (`every_algorithm_has_its_row`).
        &ALGORITHMS[self as usize]
    }

    /// On the command line, in files, in JSON and in messages.
    pub fn name(self) -> &'static str {
        self.description().name
    }

    /// `None` where it has no such precision, or runs on the CPU.
    pub fn kernel(self, precision: Precision) -> Option<Kernel> {
        self.description().kernels.iter().copied().find(|kernel| kernel.precision() == precision)
    }

    /// Those that a Vulkan device runs, in the order of [`ALGORITHMS`].
    pub fn on_device() -> impl Iterator<Item = Self> {
        ALGORITHMS.iter().filter(|description| description.is_on_device()).map(|description| description.algorithm)
    }

    /// Those whose pictures do not depend on chance, on a Vulkan device, in the order of [`ALGORITHMS`].
    pub fn deterministic() -> impl Iterator<Item = Self> {
        ALGORITHMS.iter().filter(|description| description.is_deterministic()).map(|description| description.algorithm)
    }

    /// Those that table 4.1 of the course work is measured with unless others are asked for, in the order of
    /// [`ALGORITHMS`].
    pub fn in_fps_table() -> impl Iterator<Item = Self> {
        ALGORITHMS.iter().filter(|description| description.is_in_fps_table).map(|description| description.algorithm)
    }

    /// Those of the note's table 1.1, in the order of [`ALGORITHMS`].
    pub fn in_table_1_1() -> impl Iterator<Item = Self> {
        ALGORITHMS.iter().filter(|description| description.table_1_1.is_some()).map(|description| description.algorithm)
    }

    /// The names of those that can do something, for messages: "plain and whitted".
    pub fn names(can: impl Fn(&Description) -> bool) -> String {
        let names: Vec<_> =
            ALGORITHMS.iter().filter(|description| can(description)).map(|description| description.name).collect();
        names.join(" and ")
    }
}

impl ValueEnum for Algorithm {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self::Course, Self::Plain, Self::Whitted, Self::Ssr, Self::Path, Self::Reference]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let Description { name, about, .. } = self.description();
        Some(PossibleValue::new(*name).help(*about))
    }
}

impl Kernel {
    /// Its algorithm's row of [`ALGORITHMS`].
    pub fn description(self) -> &'static Description {
        self.algorithm().description()
    }

    /// The algorithm that it runs.
    pub fn algorithm(self) -> Algorithm {
        match self {
            Self::Course => Algorithm::Course,
            Self::Plain => Algorithm::Plain,
            Self::Whitted(_) => Algorithm::Whitted,
            Self::Ssr => Algorithm::Ssr,
            Self::Path(_) => Algorithm::Path,
        }
    }

    /// Whether it needs the whole picture at once, and draws no tiles of it.
    pub fn draws_whole(self) -> bool {
        self == Self::Ssr
    }

    /// What it calculates in.
    pub fn precision(self) -> Precision {
        match self {
            Self::Course | Self::Plain | Self::Ssr => Precision::F32,
            Self::Whitted(precision) | Self::Path(precision) => precision,
        }
    }

    /// The algorithm's name and, where that has several, the precision's.
    pub fn name(self) -> String {
        let description = self.description();
        if description.has_precisions() {
            format!("{} {}", description.name, self.precision().name())
        } else {
            description.name.to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_algorithm_has_its_row() {
        for (algorithm, row) in Algorithm::value_variants().iter().zip(&ALGORITHMS) {
            assert_eq!(*algorithm, row.algorithm);
            assert_eq!(serde_json::to_value(algorithm).unwrap(), row.name);
        }
        assert_eq!(Algorithm::value_variants().len(), ALGORITHMS.len());
    }

    #[test]
    fn kernels_are_of_the_row_s_algorithm_and_precisions() {
        for row in &ALGORITHMS {
            for kernel in row.kernels {
                assert_eq!(kernel.algorithm(), row.algorithm);
            }
            if row.is_on_device() {
                assert_eq!(row.kernels.iter().map(|kernel| kernel.precision()).collect::<Vec<_>>(), row.precisions);
            }
        }
        assert_eq!(Kernel::Whitted(Precision::F64).name(), "whitted f64");
        assert_eq!(Kernel::Plain.name(), "plain");
        assert_eq!(Algorithm::names(|row| row.approximates), "plain and whitted");
    }
}
