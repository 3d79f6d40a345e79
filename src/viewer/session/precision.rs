//! What the accurate kernel calculates in, where the plan for the scene is asked.

use super::super::action::Kernel;
use super::side::{Side, Wanted};
use crate::algorithm::Algorithm;
use crate::plan::{Limits, Plan, PlanError, Precision};
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// The plan's answer for a scene at a size.
pub(super) struct Chosen {
    scene: Scene,
    size: [u32; 2],
    asked: Asked,
    pub precision: Precision,
    /// Why the picture is not right.
    pub warning: Option<String>,
}

/// What the answer depends on besides.
#[derive(Clone, Copy, PartialEq)]
struct Asked {
    algorithm: Algorithm,
    /// `None`: as the scene needs.
    precision: Option<Precision>,
    max_depth: Option<u32>,
    error: f64,
}

impl Asked {
    /// `None` of kernels that calculate in one way.
    fn by(kernel: Kernel) -> Option<Self> {
        let RenderSettings { algorithm, precision, max_depth, error, .. } = kernel.settings();
        kernel.description().has_precisions().then_some(Self { algorithm, precision, max_depth, error })
    }
}

impl Chosen {
    fn is_for(&self, scene: &Scene, size: [u32; 2], asked: Asked) -> bool {
        (self.size, self.asked) == (size, asked) && self.scene == *scene
    }

    fn new(scene: &Scene, size: [u32; 2], asked: Asked, limits: &Limits) -> Result<Self, PlanError> {
        let Asked { algorithm, precision, max_depth, error } = asked;
        let settings = RenderSettings { algorithm, precision, max_depth, error, ..RenderSettings::default() };
        let plan = Plan::for_scene(scene, &settings, size, limits)?.with_f32_tried(scene);
        Ok(Self { scene: scene.clone(), size, asked, precision: plan.precision.choice, warning: plan.warning() })
    }
}

impl Side {
    /// Asks the plan, unless its answer is for the scene as it is. Pixels may be tested for it, too slow while the
    /// scene changes from frame to frame: `is_at_rest` says that it does not; until then the last answer holds.
    ///
    /// # Errors
    /// There is no plan for the scene on this device.
    pub fn choose_precision(&mut self, wanted: &Wanted, is_at_rest: bool) -> Result<(), PlanError> {
        let &Wanted { kernel, scene, size, limits, .. } = wanted;
        let Some(asked) = Asked::by(kernel) else {
            (self.chosen, self.lacks_precision) = (None, false);
            return Ok(());
        };
        let is_current = |chosen: &Chosen| chosen.is_for(scene, size, asked);
        let is_of_another_choice = self.chosen.as_ref().is_none_or(|chosen| chosen.asked != asked);
        if is_of_another_choice || (is_at_rest && !self.chosen.as_ref().is_some_and(is_current)) {
            self.chosen = Some(Chosen::new(scene, size, asked, limits)?);
        }
        self.lacks_precision = !self.chosen.as_ref().is_some_and(is_current);
        Ok(())
    }
}
