//! What the accurate kernel calculates in, where the plan for the scene is asked.

use super::super::action::Kernel;
use super::Session;
use crate::plan::{Limits, Plan, PlanError, Precision, Wishes};
use crate::scene::Scene;

/// The plan's answer for a scene at a size.
pub(super) struct Chosen {
    scene: Scene,
    size: [u32; 2],
    /// By the user; `None`: as the scene needs.
    asked: Option<Precision>,
    pub precision: Precision,
    /// Why the picture is not right.
    pub warning: Option<String>,
}

impl Chosen {
    fn is_for(&self, scene: &Scene, size: [u32; 2], asked: Option<Precision>) -> bool {
        (self.size, self.asked) == (size, asked) && self.scene == *scene
    }

    fn new(scene: &Scene, size: [u32; 2], asked: Option<Precision>, limits: &Limits) -> Result<Self, PlanError> {
        let wishes = Wishes { precision: asked, ..Wishes::exact(size[0], size[1]) };
        let plan = Plan::for_scene(scene, &wishes, limits)?;
        Ok(Self { scene: scene.clone(), size, asked, precision: plan.precision.choice, warning: plan.warning() })
    }
}

impl Session {
    /// Asks the plan, unless its answer is for the scene as it is. Pixels may be tried for it, too slow while the scene
    /// changes from frame to frame: `is_at_rest` says that it does not; until then the last answer holds.
    ///
    /// # Errors
    /// There is no plan for the scene on this device.
    pub(super) fn choose_precision(
        &mut self,
        limits: &Limits,
        size: [u32; 2],
        is_at_rest: bool,
    ) -> Result<(), PlanError> {
        let Kernel::Accurate(asked) = self.state.kernel else {
            (self.chosen, self.is_precision_known) = (None, true);
            return Ok(());
        };
        let scene = self.state.document.scene();
        let is_current = |chosen: &Chosen| chosen.is_for(scene, size, asked);
        let is_of_another_choice = self.chosen.as_ref().is_none_or(|chosen| chosen.asked != asked);
        if is_of_another_choice || (is_at_rest && !self.chosen.as_ref().is_some_and(is_current)) {
            self.chosen = Some(Chosen::new(scene, size, asked, limits)?);
        }
        self.is_precision_known = self.chosen.as_ref().is_some_and(is_current);
        Ok(())
    }
}
