//! Which settings are tried on a scene. Pure: no Vulkan.

use super::{LeftOut, Target};
use crate::plan::{Limits, PlanError, Precision};
use crate::scene::Scene;
use crate::setting::{Kernel, Setting};
use crate::tracer::Settings;

/// What is varied.
#[derive(Debug, Clone, PartialEq)]
pub struct Axes {
    pub kernels: Vec<Kernel>,
    /// Allowed errors, besides none.
    pub errors: Vec<f64>,
    /// Numbers of generations below the scene's, besides that.
    pub generations: Vec<u32>,
    /// Samples a pixel, besides 1.
    pub samples: Vec<u32>,
    /// Of the traced picture, besides 1.
    pub scales: Vec<f64>,
    pub target: Target,
}

impl Axes {
    /// All of everything; `asked`: errors that are asked for. A picture is mostly far within its bound, so that a larger
    /// allowed error may keep what is asked for, too.
    pub fn full(target: Target, asked: &[f64]) -> Self {
        let mut errors = [2550.0, 510.0, 255.0, 100.0, 30.0, 10.0].map(|part| 1.0 / part).to_vec();
        errors.extend(asked.iter().flat_map(|error| [1.0, 4.0].map(|times| times * error)));
        errors.retain(|&error| error > 0.0);
        errors.sort_by(f64::total_cmp);
        errors.dedup();
        Self {
            kernels: Kernel::ALL.into(),
            errors,
            generations: vec![1, 2, 3, 4, 6, 8, 12, 16, 24, 32],
            samples: match target {
                // More than the one in the middle are farther from what is there.
                Target::Point => Vec::new(),
                Target::Area => vec![2, 4, 8, 16, 32, 64],
            },
            scales: vec![0.25, 0.5, 0.75],
            target,
        }
    }
}

/// A setting with what it comes to on a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Planned {
    pub setting: Setting,
    pub settings: Settings,
    /// See [`Point::bound`](super::Point::bound).
    pub bound: Option<f64>,
}

/// The settings to measure, the baseline first.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Exactly by the accurate kernel in `f32`: what `zerkalo render` does unless told otherwise, or the scene needs `f64`.
    pub baseline: Planned,
    /// Without the baseline; no two of them draw the same picture in the same way.
    pub others: Vec<Planned>,
    /// Not for this device or scene.
    pub left_out: Vec<LeftOut>,
}

const BASELINE: Setting = Setting {
    kernel: Kernel::Whitted,
    precision: Some(Precision::F32),
    error: 0.0,
    max_depth: None,
    boxes: true,
    samples: 1,
    scale: 1.0,
};

impl Sweep {
    /// For a scene at so many pixels. Where settings come to the same, the first one stands for all: the exact one, or
    /// that of the smallest allowed error.
    ///
    /// # Errors
    /// The scene is not for this device, whatever the setting.
    pub fn of(scene: &Scene, axes: &Axes, limits: &Limits, [width, height]: [u32; 2]) -> Result<Self, PlanError> {
        let plan = |setting: Setting| {
            let drawing = setting.drawing(scene, limits, width, height)?;
            let is_of_model = setting.kernel == Kernel::Whitted && setting.max_depth.is_none();
            let is_of_points = axes.target == Target::Point && setting.samples == 1 && setting.scale == 1.0;
            let bound = (is_of_model && is_of_points).then_some(drawing.error_bound);
            Ok::<_, PlanError>(Planned { setting, settings: drawing.settings, bound })
        };
        let mut sweep = Self { baseline: plan(BASELINE)?, others: Vec::new(), left_out: Vec::new() };
        for setting in candidates(scene, axes) {
            match plan(setting) {
                Ok(planned) if sweep.planned().any(|earlier| earlier.settings == planned.settings) => {}
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

/// Every kernel and precision, exactly; with each allowed error; with each number of generations; without boxes. The
/// whitted kernel in `f32` with each number of samples and at each scale. The course's kernel, which is of another model,
/// only exactly.
fn candidates(scene: &Scene, axes: &Axes) -> Vec<Setting> {
    let mut bases = Vec::new();
    if axes.kernels.contains(&Kernel::Whitted) {
        bases.extend(
            [Precision::F32, Precision::F64].map(|precision| Setting { precision: Some(precision), ..BASELINE }),
        );
    }
    if axes.kernels.contains(&Kernel::Plain) {
        bases.push(Setting { kernel: Kernel::Plain, ..BASELINE });
    }
    let mut settings = bases.clone();
    for &base in &bases {
        settings.extend(axes.errors.iter().map(|&error| Setting { error, ..base }));
        let fewer = axes.generations.iter().filter(|&&generations| generations < scene.max_depth);
        settings.extend(fewer.map(|&generations| Setting { max_depth: Some(generations), ..base }));
        settings.push(Setting { boxes: false, ..base });
    }
    if axes.kernels.contains(&Kernel::Whitted) {
        settings.extend(axes.samples.iter().map(|&samples| Setting { samples, ..BASELINE }));
        settings.extend(axes.scales.iter().map(|&scale| Setting { scale, ..BASELINE }));
    }
    if axes.kernels.contains(&Kernel::Course) {
        settings.push(Setting { kernel: Kernel::Course, precision: None, ..BASELINE });
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
        let has = |wanted: fn(&Setting) -> bool| planned.iter().any(|planned| wanted(&planned.setting));
        assert!(has(|setting| setting.kernel == Kernel::Course) && has(|setting| setting.kernel == Kernel::Plain));
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
            let Setting { kernel, max_depth, error, scale, .. } = planned.setting;
            let is_provable = kernel == Kernel::Whitted && max_depth.is_none() && scale == 1.0;
            assert_eq!(planned.bound.is_some(), is_provable, "{}", planned.setting);
            assert!(planned.bound.unwrap_or(0.0) <= error);
        }
        let of_areas = sweep("corridor", &Axes::full(Target::Area, &[]), &LIMITS);
        assert!(of_areas.planned().all(|planned| planned.bound.is_none()), "a point proves nothing of an area");
        assert!(of_areas.planned().any(|planned| planned.setting.samples == 64));
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
