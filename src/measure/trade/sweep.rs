//! Which settings are tested on a scene. Pure: no Vulkan.

use super::{LeftOut, Target};
use crate::algorithm::{ALGORITHMS, Algorithm, Description, Precision};
use crate::plan::{Limits, Plan, PlanError};
use crate::scene::Scene;
use crate::settings::{RenderSettings, Shading};
use crate::tracer::Settings;

/// What is varied.
#[derive(Debug, Clone, PartialEq)]
pub struct Axes {
    /// Kernels, each in all its precisions.
    pub algorithms: Vec<Algorithm>,
    /// Allowed errors, besides none.
    pub errors: Vec<f64>,
    /// Numbers of generations below the scene's, besides that.
    pub generations: Vec<u32>,
    /// Samples a pixel, besides 1.
    pub samples: Vec<u32>,
    /// Samples a pixel of path tracing.
    pub path_samples: Vec<u32>,
    /// Scales of the traced picture, besides 1.
    pub scales: Vec<f64>,
    /// What errors are measured against.
    pub target: Target,
    /// Shading model of all settings.
    pub shading: Shading,
}

impl Axes {
    /// All of everything; `asked`: errors that are asked for. A picture is mostly far within its bound, so that a
    /// larger allowed error may keep what is asked for, too.
    pub fn full(target: Target, asked: &[f64]) -> Self {
        let mut errors = [2550.0, 510.0, 255.0, 100.0, 30.0, 10.0].map(|part| 1.0 / part).to_vec();
        errors.extend(asked.iter().flat_map(|error| [1.0, 4.0].map(|times| times * error)));
        errors.retain(|&error| error > 0.0);
        errors.sort_by(f64::total_cmp);
        errors.dedup();
        Self {
            algorithms: match target {
                Target::Point | Target::Area => Algorithm::deterministic().collect(),
                Target::Radiance { .. } => Algorithm::on_device().collect(),
            },
            errors,
            shading: Shading::Whitted,
            generations: vec![1, 2, 3, 4, 6, 8, 12, 16, 24, 32],
            samples: match target {
                // More than the one in the centre are farther from what is there.
                Target::Point => Vec::new(),
                Target::Area | Target::Radiance { .. } => vec![2, 4, 8, 16, 32, 64],
            },
            path_samples: match target {
                Target::Point | Target::Area => Vec::new(),
                // Of powers of two the sequence covers a pixel most evenly. More than a quarter of the truth's samples
                // would be told of an error that is more and more the truth's own: of a quarter, √(1 + 1/4) times theirs.
                Target::Radiance { truth_samples } => {
                    (0..u32::BITS).map(|power| 1 << power).filter(|samples| *samples <= truth_samples / 4).collect()
                }
            },
            scales: vec![0.25, 0.5, 0.75],
            target,
        }
    }
}

/// A setting with what it comes to on a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Planned {
    /// What was asked for.
    pub setting: RenderSettings,
    /// What the tracer is given for it.
    pub settings: Settings,
    /// See [`Point::bound`](super::Point::bound).
    pub bound: Option<f64>,
}

impl Planned {
    /// Samples of a picture by path tracing; `None` by others.
    pub fn path_samples(&self) -> Option<u32> {
        self.setting.algorithm.description().is_statistical.then_some(self.setting.samples)
    }

    /// Whether both draw the same picture in the same way.
    fn draws_as(&self, other: &Self) -> bool {
        self.settings == other.settings && self.path_samples() == other.path_samples()
    }
}

/// The settings to measure, the baseline first.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Exactly by the accurate kernel in `f32`: what `zerkalo render` does by default, or the scene needs
    /// `f64`.
    pub baseline: Planned,
    /// Without the baseline; no two of them draw the same picture in the same way.
    pub others: Vec<Planned>,
    /// Not for this device or scene.
    pub left_out: Vec<LeftOut>,
}

const BASELINE: RenderSettings = RenderSettings { precision: Some(Precision::F32), ..RenderSettings::DEFAULT };

impl Sweep {
    /// For a scene at so many pixels. Where settings come to the same, the first one stands for all: the exact one, or
    /// that of the smallest allowed error.
    ///
    /// # Errors
    /// The scene is not for this device, whatever the setting.
    pub fn of(scene: &Scene, axes: &Axes, limits: &Limits, [width, height]: [u32; 2]) -> Result<Self, PlanError> {
        let plan = |setting: RenderSettings| {
            let plan = Plan::for_scene(scene, &setting, [width, height], limits)?;
            let is_of_model = setting.algorithm.description().is_accurate && setting.max_depth.is_none();
            let is_of_points = axes.target == Target::Point && setting.samples == 1 && setting.scale == 1.0;
            let bound = (is_of_model && is_of_points).then(|| plan.bounds.total());
            Ok::<_, PlanError>(Planned { setting, settings: Settings::planned(&plan), bound })
        };
        let mut sweep = Self {
            baseline: plan(RenderSettings { shading: axes.shading, ..BASELINE })?,
            others: Vec::new(),
            left_out: Vec::new(),
        };
        for setting in candidates(scene, axes) {
            match plan(setting) {
                Ok(planned) if sweep.planned().any(|earlier| earlier.draws_as(&planned)) => {}
                Ok(planned) => sweep.others.push(planned),
                Err(error) => sweep.left_out.push(LeftOut { setting, reason: error.to_string() }),
            }
        }
        Ok(sweep)
    }

    /// The baseline and the others.
    pub fn planned(&self) -> impl Iterator<Item = &Planned> {
        [&self.baseline].into_iter().chain(&self.others)
    }
}

/// Every algorithm that can leave something out, in each precision: exactly; with each allowed error; with each number
/// of generations; without boxes. In the first of its precisions with each number of samples and at each scale, if it
/// has those. What can leave out nothing only exactly, by path tracing with each number of samples.
fn candidates(scene: &Scene, axes: &Axes) -> Vec<RenderSettings> {
    let mut rows: Vec<&Description> =
        ALGORITHMS.iter().filter(|row| row.is_on_device() && axes.algorithms.contains(&row.algorithm)).collect();
    rows.sort_by_key(|row| !row.is_accurate);
    let (approximating, others): (Vec<_>, Vec<_>) = rows.into_iter().partition(|row| row.approximates);
    let of = |row: &Description, precision| RenderSettings {
        algorithm: row.algorithm,
        precision,
        shading: axes.shading,
        ..BASELINE
    };
    let in_each =
        |row: &&Description| row.precisions.iter().map(|&precision| of(row, Some(precision))).collect::<Vec<_>>();
    let bases: Vec<_> = approximating.iter().flat_map(in_each).collect();
    let mut settings = bases.clone();
    for &base in &bases {
        settings.extend(axes.errors.iter().map(|&error| RenderSettings { error, ..base }));
        let fewer = axes.generations.iter().filter(|&&generations| generations < scene.max_depth);
        settings.extend(fewer.map(|&generations| RenderSettings { max_depth: Some(generations), ..base }));
        settings.push(RenderSettings { boxes: false, ..base });
    }
    for row in approximating.iter().filter(|row| row.samples) {
        let base = of(row, Some(row.precisions[0]));
        settings.extend(axes.samples.iter().map(|&samples| RenderSettings { samples, ..base }));
        settings.extend(axes.scales.iter().map(|&scale| RenderSettings { scale, ..base }));
    }
    for row in others {
        if row.is_statistical {
            let base = of(row, Some(row.precisions[0]));
            settings.extend(axes.path_samples.iter().map(|&samples| RenderSettings { samples, ..base }));
        } else {
            settings.push(of(row, None));
        }
    }
    settings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::gallery;

    const LIMITS: Limits = Limits { float64: true, ..Limits::PROMISED };

    fn sweep(name: &str, axes: &Axes, limits: &Limits) -> Sweep {
        Sweep::of(&gallery::scene(name).unwrap(), axes, limits, [64, 28]).unwrap()
    }

    fn full() -> Axes {
        Axes::full(Target::Point, &[])
    }

    #[test]
    fn every_axis_is_swept_and_nothing_twice() {
        let sweep = sweep("squares-100", &full(), &LIMITS);
        let planned: Vec<&Planned> = sweep.planned().collect();
        for (place, one) in planned.iter().enumerate() {
            assert!(planned[..place].iter().all(|earlier| earlier.settings != one.settings), "{}", one.setting);
            one.setting.check().unwrap();
        }
        let has = |wanted: fn(&RenderSettings) -> bool| planned.iter().any(|planned| wanted(&planned.setting));
        assert!(
            has(|setting| setting.algorithm == Algorithm::Course)
                && has(|setting| setting.algorithm == Algorithm::Plain)
        );
        assert!(has(|setting| setting.precision == Some(Precision::F64) && setting.error > 0.0));
        assert!(has(|setting| setting.max_depth == Some(2)) && has(|setting| !setting.boxes));
        assert!(has(|setting| setting.scale == 0.5) && !has(|setting| setting.samples > 1));
        assert_eq!(sweep.left_out, []);
    }

    #[test]
    fn what_a_scene_has_no_use_for_is_not_measured() {
        // Few solids have no boxes; an allowed error that changes nothing is the exact picture.
        let few = sweep("showcase", &full(), &LIMITS);
        assert!(few.planned().all(|planned| planned.setting.boxes));
        let mut scene = gallery::scene("showcase").unwrap();
        scene.primitives.iter_mut().for_each(|primitive| primitive.material.specular = 0.0);
        let dull = Sweep::of(&scene, &full(), &LIMITS, [64, 28]).unwrap();
        assert!(dull.planned().all(|planned| planned.setting.max_depth.is_none()), "no reflections, no generations");
    }

    #[test]
    fn only_bounds_on_what_is_left_out_of_the_accurate_kernel_are_proven() {
        for planned in sweep("corridor", &full(), &LIMITS).planned() {
            let RenderSettings { algorithm, max_depth, error, scale, .. } = planned.setting;
            let is_provable = algorithm == Algorithm::Whitted && max_depth.is_none() && scale == 1.0;
            assert_eq!(planned.bound.is_some(), is_provable, "{}", planned.setting);
            assert!(planned.bound.unwrap_or(0.0) <= error);
        }
        let of_areas = sweep("corridor", &Axes::full(Target::Area, &[]), &LIMITS);
        assert!(of_areas.planned().all(|planned| planned.bound.is_none()), "a point proves nothing of an area");
        assert!(of_areas.planned().any(|planned| planned.setting.samples == 64));
    }

    #[test]
    fn for_all_light_path_tracing_is_swept_by_its_samples_and_nothing_is_proven() {
        let sweep = sweep("corridor", &Axes::full(Target::Radiance { truth_samples: 1024 }, &[]), &LIMITS);
        let samples: Vec<_> = sweep.planned().filter_map(Planned::path_samples).collect();
        assert_eq!(samples, [1, 2, 4, 8, 16, 32, 64, 128, 256]);
        assert!(sweep.planned().all(|planned| planned.bound.is_none()));
        assert!(sweep.planned().any(|planned| planned.setting.algorithm == Algorithm::Ssr));
        assert!(full().algorithms.iter().all(|algorithm| !algorithm.description().is_statistical));
    }

    #[test]
    fn without_f64_its_settings_are_left_out_and_said_to_be() {
        let sweep = sweep("corridor", &full(), &Limits::PROMISED);
        assert!(sweep.planned().all(|planned| planned.setting.precision != Some(Precision::F64)));
        assert!(sweep.left_out.iter().all(|left_out| left_out.reason.contains("shaderFloat64")));
        assert!(!sweep.left_out.is_empty());
    }

    #[test]
    fn errors_asked_for_are_among_those_allowed() {
        let axes = Axes::full(Target::Point, &[0.005, 0.0, 0.1]);
        assert!([0.005, 0.02, 0.1, 0.4].iter().all(|error| axes.errors.contains(error)));
        assert!(axes.errors.is_sorted_by(|a, b| a < b) && axes.errors[0] > 0.0);
    }
}
