//! What a scene requires of a kernel, and nothing more; why; and what an allowed error buys on top. Pure: no Vulkan.
//!
//! ```
//! use zerkalo::plan::{Limits, Plan};
//! use zerkalo::scene::gallery;
//! use zerkalo::settings::RenderSettings;
//!
//! let scene = gallery::scene("corridor").expect("a scene of the gallery");
//! let settings = RenderSettings { error: 1.0 / 510.0, ..RenderSettings::default() };
//! let plan = Plan::for_scene(&scene, &settings, [1621, 701], &Limits::PROMISED).expect("it fits every device");
//! assert!(plan.bounds.total() <= settings.error);
//! ```

mod arrays;
mod budget;
mod ceiling;
mod features;
mod generations;
mod lengths;
mod light_model;
mod light_spheres;
mod lines;
mod precision;
mod reason;
mod rounding;
mod solids;
mod structure;
mod tiling;
mod traversal_cost;

pub use crate::algorithm::Precision;
pub(crate) use arrays::{VIEW_ROWS, solid_row_count};
pub use budget::{Approximations, Bounds};
pub use features::Features;
pub(crate) use features::{lights_told_apart, most_pending};
pub use lengths::scene_space;
pub(crate) use lengths::scene_space_within;
pub(crate) use light_model::may_be_in_a_solid;
pub use light_model::{LightFeatures, LightModel, Media};
pub use light_spheres::Area;
pub use lines::Line;
pub use reason::Reason;
pub use rounding::{Cause, Near, Rounding};
pub use structure::Structure;
pub use tiling::{SAMPLES_AT_ONCE, rays_per_pixel, tile_side, tried_under_boxes};
pub use traversal_cost::{CPU_MAX_ITERATIONS, MOST_PIXELS, TraversalCost};

use glam::DVec3;
use thiserror::Error;

use crate::algorithm::Kernel;
use crate::scene::{Scene, SolidKind};
use crate::settings::{Contradiction, RenderSettings};
use arrays::check_arrays;
use budget::{Spent, Transport, spend};
use features::Kept;
use generations::{approximated_generations, energy_gain, generations};
use lengths::Lengths;
use solids::is_lone_and_seen_from_outside;
pub(crate) use solids::is_rotated;

/// What a device can do.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Whether kernels can calculate in `f64`.
    pub float64: bool,
    /// Largest array that a kernel can see, bytes.
    pub max_array_bytes: u64,
    /// Largest picture side in one tile, pixels.
    pub max_image_side: u32,
    /// Whether eight invocations go together and can hand each other numbers.
    pub packets: bool,
}

impl Limits {
    /// What every Vulkan device has (the specification's table of required limits).
    pub const PROMISED: Self = Self { float64: false, max_array_bytes: 1 << 20, max_image_side: 4096, packets: false };
}

/// Why there is no plan. Each is one line, and the input's fault.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlanError {
    /// What [`RenderSettings::check`] refuses.
    #[error(transparent)]
    Settings(#[from] Contradiction),
    /// A side is 0.
    #[error("a picture of {width}x{height} pixels has none")]
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// The algorithm of that name has no kernel.
    #[error("the {0} algorithm runs on the CPU: there is nothing to be planned for a device")]
    NotOnDevice(&'static str),
    /// `f64` was asked for, and the device has none.
    #[error("the device cannot calculate in f64 (it lacks shaderFloat64); --precision f32 works there")]
    NoFloat64,
    /// Some of the scene's records take more than [`Limits::max_array_bytes`].
    #[error("the scene is too large: its {array} take {bytes} B in {}, and a kernel sees {limit} B there", .precision.name())]
    TooLarge {
        /// What is recorded there, in the plural.
        array: &'static str,
        /// That the array would take.
        bytes: u64,
        /// Bytes.
        limit: u64,
        /// Precision of the kernel, which decides how large most records are.
        precision: Precision,
    },
}

/// What was decided, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision<T> {
    /// In the unit that the plan's field names.
    pub choice: T,
    /// Also a line for people.
    pub reason: Reason,
}

/// What a kernel has to do for a scene. What is false, 0 or 1 here can be compiled out.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// What was asked for.
    pub settings: RenderSettings,
    /// Pixels along x and y.
    pub size: [u32; 2],
    /// The algorithm in the precision that was chosen.
    pub kernel: Kernel,
    /// Solids of each kind, in the order of [`SolidKind::ALL`], without those too small for the precision.
    pub counts: [usize; 4],
    /// Lights of the scene, dark ones too.
    pub all_lights: usize,
    /// Whether no box is rotated against the world's axes.
    pub axis_aligned_boxes: Decision<bool>,
    /// Light spheres that primary rays may see, those of dark lights too.
    pub light_spheres: Decision<usize>,
    /// Lights that brighten anything. Where there are none, nothing is shaded by light; one needs no loop.
    pub lights: Decision<usize>,
    /// Whether a solid may lie between a hit and a light.
    pub shadows: Decision<bool>,
    /// Whether highlights are drawn.
    pub highlights: Decision<bool>,
    /// What else of the light model there is.
    pub light_model: LightModel,
    /// Generations of a ray, the primary one included. Where it is 1, nothing is reflected.
    pub generations: Decision<u32>,
    /// Also that of `kernel`.
    pub precision: Decision<Precision>,
    /// How many times the smallest length the scene is, where the picture is drawn as a close-up: in `f32`, from where
    /// solids are nearest to the camera.
    pub close_up: Option<f64>,
    /// What rounding to `f32` does to the picture; `None` where the precision was asked for and that was not looked at.
    pub rounding: Option<Rounding>,
    /// Structure over the solids of each kind.
    pub structures: Decision<[Structure; 4]>,
    /// Pixels of a workgroup along x and y.
    pub workgroup: Decision<[u32; 2]>,
    /// That an invocation traces, one after another.
    pub pixels: Decision<u32>,
    /// Side of what one submission traces, pixels.
    pub tile_side: Decision<u32>,
    /// What the allowed error bought.
    pub approximations: Approximations,
    /// What that can change; its total is at most [`RenderSettings::error`].
    pub bounds: Bounds,
    /// Where path tracing would draw light without end: the first primitive that sends back more than it gets, by its
    /// index, and how many times as much.
    pub energy_gain: Option<(usize, f64)>,
}

impl Plan {
    /// For a scene that [is valid](Scene::validate).
    ///
    /// # Errors
    /// Settings that make no sense, or that the device cannot fulfil.
    pub fn for_scene(
        scene: &Scene,
        settings: &RenderSettings,
        size: [u32; 2],
        limits: &Limits,
    ) -> Result<Self, PlanError> {
        // A thread that is not of the pool waits for one to wake at everything that is done by several: here once.
        rayon::scope(|_| Self::decide(scene, settings, size, limits))
    }

    fn decide(scene: &Scene, settings: &RenderSettings, size: [u32; 2], limits: &Limits) -> Result<Self, PlanError> {
        settings.check()?;
        if size.contains(&0) {
            let [width, height] = size;
            return Err(PlanError::Size { width, height });
        }
        let row = settings.algorithm.description();
        let kernel_in = |precision| settings.algorithm.kernel(precision).ok_or(PlanError::NotOnDevice(row.name));
        let transport = Transport::of(scene);
        let is_lone = is_lone_and_seen_from_outside(scene) && !transport.has_transmission();
        let lengths = Lengths::of(scene);
        let (mut precision, rounding) = precision::choose(&lengths, settings, size, limits)?;
        let mut kernel = kernel_in(precision.choice)?;
        let mut kept = Kept::of(&scene.primitives, precision.choice, &lengths.space(kernel));
        let light_features = LightFeatures::of(scene);
        let fits = |kept: &Kept, kernel: Kernel| {
            let is_close_up = lengths.close_up(kernel).is_some();
            check_arrays(kept.counts, scene.lights.len(), light_features, kernel.precision(), is_close_up, limits)
        };
        // A wrong picture with a word is better than none.
        if matches!(precision.reason, Reason::RoundingSpoils { .. } | Reason::RoundingIsUnknown { .. })
            && fits(&kept, kernel).is_err()
        {
            precision.choice = Precision::F32;
            kernel = kernel_in(precision.choice)?;
            kept = Kept::of(&scene.primitives, precision.choice, &lengths.space(kernel));
        }
        fits(&kept, kernel)?;
        let counts = kept.counts;

        let lights = lights(scene, &transport);
        let is_lit = lights.choice > 0;
        let shadows = shadows(scene, is_lit, is_lone);
        let highlights = highlights(&transport, is_lit);
        let generations = generations(scene, settings, &transport, is_lone);
        let spent =
            spend(&transport, settings.error, generations.choice, precision.choice, shadows.choice, highlights.choice);
        let Spent { approximations, bounds, .. } = spent;
        let generations = approximated_generations(generations, &spent);
        let light_spheres = light_spheres::decide(scene, size);
        let highlights = approximated_highlights(highlights, &spent);
        let light_model = LightModel::decide(scene, light_features, generations.choice);
        let approximations = if row.is_specialized {
            Approximations {
                light_spheres: light_spheres.choice > 0,
                lights: is_lit,
                shadows: shadows.choice,
                reflections: generations.choice > 1,
                ..approximations
            }
        } else {
            Approximations::NONE
        };
        Ok(Self {
            settings: *settings,
            size,
            kernel,
            counts,
            axis_aligned_boxes: axis_aligned_boxes(kept),
            all_lights: scene.lights.len(),
            light_spheres,
            lights,
            shadows,
            highlights,
            light_model,
            close_up: lengths.close_up(kernel),
            precision,
            rounding,
            structures: Structure::decide(counts, settings),
            workgroup: Decision { choice: WORKGROUP, reason: Reason::SquareWorkgroup },
            pixels: traversal_cost::decide(scene, kernel, generations.choice, limits),
            tile_side: tiling::decide(scene, kernel, generations.choice, limits),
            generations,
            approximations,
            bounds,
            energy_gain: if row.is_statistical { energy_gain(scene) } else { None },
        })
    }

    /// Whether rays look at every solid where boxes around them would be quicker.
    pub fn is_without_boxes(&self) -> bool {
        !self.settings.boxes && self.counts.iter().any(|&count| Structure::over(count) != Structure::None)
    }

    /// With [`Plan::rounding`] looked at where `f32` was asked for, too, which may take a second: for those who show
    /// the [warning](Plan::warning). To be called with the scene that the plan was made for. Of what is no accurate
    /// algorithm nothing is reported: it is there to show what rounding does.
    pub fn with_f32_tried(mut self, scene: &Scene) -> Self {
        let is_accurate = self.settings.algorithm.description().is_accurate;
        if is_accurate && self.precision.choice == Precision::F32 && self.rounding.is_none() {
            self.rounding = Some(precision::try_f32(&Lengths::of(scene), &self.settings, self.size));
        }
        self
    }

    /// That the picture will or may be wrong, and why, in one line: where `f32` is what there is or was asked for, or
    /// where paths gain light at a surface.
    pub fn warning(&self) -> Option<String> {
        self.rounding_warning().or_else(|| self.energy_warning())
    }

    fn energy_warning(&self) -> Option<String> {
        let (primitive, gain) = self.energy_gain?;
        Some(format!(
            "primitive {primitive} sends back {} times the light that it gets (diffuse * its brightest channel + \
             reflection + transmission): the picture grows brighter with every generation",
            reason::Short(gain)
        ))
    }

    fn rounding_warning(&self) -> Option<String> {
        if self.precision.choice != Precision::F32 {
            return None;
        }
        let what = match self.rounding? {
            Rounding::Mild | Rounding::Harmless { .. } => return None,
            Rounding::Harmful { wrong, tried, cause } => {
                format!("is too coarse for this scene, {wrong} of {tried} pixels that were tried are wrong: {cause}")
            }
            Rounding::Unknown { .. } => "may be too coarse for this scene, of so many solids and sizes".to_owned(),
        };
        let cure = match self.precision.reason {
            Reason::Asked => "f64 draws it right, where the device has that",
            _ => "this device has no f64, or no room in it, to draw it right",
        };
        Some(format!("f32 {what}; {cure}"))
    }
}

/// Pixels of a workgroup. lavapipe packs eight neighbours along x into one SIMD register, GPUs take 32 or 64
/// invocations at a time, which lie nearest to each other in a square.
pub const WORKGROUP: [u32; 2] = [8, 8];

fn axis_aligned_boxes(kept: Kept) -> Decision<bool> {
    let boxes = kept.counts[SolidKind::Box as usize];
    let rotated = kept.rotated_boxes;
    let reason = match (boxes, rotated) {
        (0, _) => Reason::NoBoxes,
        (_, 0) => Reason::NoBoxRotated,
        (boxes, rotated) => Reason::BoxesRotated { boxes, rotated },
    };
    Decision { choice: rotated == 0, reason }
}

fn lights(scene: &Scene, transport: &Transport) -> Decision<usize> {
    let lights = scene.lights.len();
    let shining = scene.lights.iter().filter(|light| light.intensity != DVec3::ZERO).count();
    let choice = if transport.has_light_that_matters() { shining } else { 0 };
    let reason = if lights == 0 {
        Reason::NoLights
    } else if scene.primitives.is_empty() {
        Reason::NoSolids
    } else if choice == 0 {
        Reason::NothingTakesLight { lights }
    } else {
        Reason::LightsMatter { lights, dark: lights - choice }
    };
    Decision { choice, reason }
}

fn shadows(scene: &Scene, is_lit: bool, is_lone: bool) -> Decision<bool> {
    let (choice, reason) = match (is_lit, is_lone) {
        (false, _) => (false, Reason::NothingIsLit),
        (true, true) => (false, Reason::LoneSolidShadowsNothing),
        (true, false) => (true, Reason::SolidsMayHide { solids: scene.primitives.len() }),
    };
    Decision { choice, reason }
}

fn highlights(transport: &Transport, is_lit: bool) -> Decision<bool> {
    let (choice, reason) = match (is_lit, transport.has_specular()) {
        (false, _) => (false, Reason::NothingIsLit),
        (true, false) => (false, Reason::NothingIsSpecular),
        (true, true) => (true, Reason::SomethingIsSpecular),
    };
    Decision { choice, reason }
}

/// Highlights as far as the allowed error leaves them.
fn approximated_highlights(exact: Decision<bool>, spent: &Spent) -> Decision<bool> {
    if exact.choice && !spent.approximations.highlights {
        return Decision { choice: false, reason: Reason::HighlightsAreFaint { bound: spent.bounds.highlights } };
    }
    exact
}
