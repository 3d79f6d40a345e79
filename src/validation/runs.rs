//! What is drawn. Pure: no Vulkan.

use std::sync::Arc;

use glam::DVec3;

use super::selection::{by_shader, few_with_all};
use crate::algorithm::{ALGORITHMS, Kernel};
use crate::gpu::DeviceDescription;
use crate::plan::{Limits, Plan, PlanError, Precision, Structure, WORKGROUP};
use crate::scene::{Camera, Light, Material, Primitive, Scene, Solid, gallery};
use crate::settings::RenderSettings;
use crate::settings::sampling::Sampling;
use crate::tracer::{Settings, course};

/// Pixels. The checks are per command and per access, not per pixel.
pub const PICTURE: [u32; 2] = [64, 28];

/// Pixels: the sides of some tiles end inside a workgroup.
const TILE_SIDE: u32 = 40;

/// The allowed error of the runs with cuts: half a step of a channel in 8 bits.
const ERROR: f64 = 1.0 / 510.0;

/// A workgroup that does not come by eights along x, so that a kernel cannot count on
/// [packets](DeviceDescription::packets). No plan chooses it; where there are packets, it shows the kernels of other
/// devices, and few scenes are enough.
const NARROW_WORKGROUP: [u32; 2] = [4, 8];

/// More than one sample a pixel, and a smaller picture upscaled. One scene shows what these add behind the tracing.
const SAMPLED: Sampling = Sampling { samples: 3, scale: 0.5 };
const SAMPLED_SCENE: &str = TWO_LIGHTS;

/// All kinds of solids, too few for boxes over them, and two lights in sight.
const TWO_LIGHTS: &str = "showcase with one light more";

/// Enough lights for an algorithm that follows chance to choose among them; the others go through them all as through
/// two.
const MANY_LIGHTS: &str = "showcase with two lights more";

/// How much of the gallery is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// Every scene by every kernel, in every way that differs for it.
    Whole,
    /// By every kernel as few as turn on and off all that plans turn on and off in the whole.
    EverySwitch,
}

/// A scene and how it is drawn.
#[derive(Debug, Clone)]
pub struct Run {
    /// Such as `corridor, whitted f64, error 1/510`.
    pub name: String,
    /// Shared with other runs of it.
    pub scene: Arc<Scene>,
    /// Settings of a picture of [`PICTURE`] pixels.
    pub settings: Settings,
    /// Whether the window draws it in no other way.
    pub is_as_in_window: bool,
}

/// All runs for a device with these limits, those of one kernel in a row.
///
/// # Errors
/// A scene does not fit the device.
pub fn runs(device: &DeviceDescription, limits: &Limits, scope: Scope) -> Result<Vec<Run>, PlanError> {
    let subjects = subjects();
    let mut runs = Vec::new();
    for way in ways(device) {
        for subject in &subjects {
            if let Some(settings) = way.settings(subject, limits)? {
                let name = format!("{}, {}", subject.name, way.name());
                let is_as_in_window = way.is_as_in_window();
                runs.push(Run { name, scene: subject.scene.clone(), settings, is_as_in_window });
            }
        }
    }
    let of_one_shader = by_shader(&runs).flat_map(|runs| match scope {
        Scope::Whole if runs[0].settings.workgroup == WORKGROUP => runs.to_vec(),
        Scope::Whole | Scope::EverySwitch => few_with_all(runs, |_| true),
    });
    Ok(of_one_shader.collect())
}

struct Subject {
    name: String,
    scene: Arc<Scene>,
}

fn subjects() -> Vec<Subject> {
    let subject = |name: String, scene: Scene| Subject { name, scene: Arc::new(scene) };
    let entries = gallery::entries().into_iter();
    let mut subjects: Vec<_> =
        entries.filter_map(|entry| Some(subject(entry.name.clone(), gallery::scene(&entry.name)?))).collect();
    // What the gallery does not have: nothing is lit and nothing reflected; a second light, and its sphere in sight; a
    // third; a close-up.
    if let Some(showcase) = gallery::scene("showcase") {
        let position = showcase.camera.position + showcase.camera.direction;
        let more = |count| {
            let lights = [showcase.lights.clone(), vec![Light { position, ..Light::default() }; count]].concat();
            Scene { lights, ..showcase.clone() }
        };
        subjects.push(subject(TWO_LIGHTS.to_owned(), more(1)));
        subjects.push(subject(MANY_LIGHTS.to_owned(), more(2)));
        let unlit = Scene { lights: Vec::new(), max_depth: 1, ..showcase };
        subjects.push(subject("showcase without lights and reflections".to_owned(), unlit));
    }
    subjects.push(subject("a pillar on a planet".to_owned(), pillar_on_planet()));
    subjects
}

/// A close-up, of the two kinds whose records are others there.
fn pillar_on_planet() -> Scene {
    let of = |solid| Primitive { name: None, solid, material: Material::default() };
    let planet = Solid::Sphere { center: DVec3::Y * -6.371e6, radius: 6.371e6 };
    let pillar = Solid::Cylinder { ends: [DVec3::ZERO, DVec3::Y * 3.0], radius: 0.5 };
    Scene {
        camera: Camera { position: DVec3::new(0.0, 2.0, -10.0), ..Camera::default() },
        lights: vec![Light { position: DVec3::new(9.0, 9.0, -9.0), ..Light::default() }],
        primitives: vec![of(planet), of(pillar)],
        ..Scene::default()
    }
}

/// How to draw, apart from the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Way {
    kernel: Kernel,
    workgroup: [u32; 2],
    without_boxes: bool,
    error: f64,
    sampling: Sampling,
}

fn ways(device: &DeviceDescription) -> Vec<Way> {
    let workgroups: &[[u32; 2]] = if device.packets { &[WORKGROUP, NARROW_WORKGROUP] } else { &[WORKGROUP] };
    let mut ways = Vec::new();
    let kernels = ALGORITHMS.iter().flat_map(|row| row.kernels).copied();
    for kernel in kernels.filter(|kernel| device.float64 || kernel.precision() == Precision::F32) {
        let row = kernel.algorithm().description();
        for &workgroup in workgroups {
            let exact = Way { kernel, workgroup, without_boxes: false, error: 0.0, sampling: Sampling::PLAIN };
            ways.push(exact);
            // Its search is that of the accurate kernel, which goes every way.
            if row.is_statistical {
                break;
            }
            if row.has_hierarchy {
                ways.push(Way { without_boxes: true, ..exact });
            }
            if row.has_hierarchy && !kernel.draws_whole() {
                ways.push(Way { sampling: SAMPLED, ..exact });
            }
            if row.is_accurate {
                ways.push(Way { error: ERROR, ..exact });
            }
        }
    }
    ways
}

impl Way {
    fn name(self) -> String {
        let Self { kernel, workgroup: [width, height], without_boxes, error, sampling } = self;
        let kernel = kernel.name();
        let error = (error > 0.0).then(|| format!("error 1/{:.0}", 1.0 / error));
        let boxes = without_boxes.then(|| "without boxes".to_owned());
        let workgroup = ([width, height] != WORKGROUP).then(|| format!("workgroups of {width}x{height}"));
        let sampling =
            (sampling != Sampling::PLAIN).then(|| format!("{} samples at scale {}", sampling.samples, sampling.scale));
        [Some(kernel), error, boxes, sampling, workgroup].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    fn is_as_in_window(self) -> bool {
        let exact = Self {
            kernel: self.kernel,
            workgroup: WORKGROUP,
            without_boxes: false,
            error: 0.0,
            sampling: Sampling::PLAIN,
        };
        self == exact
    }

    /// `None` where the kernel cannot draw that, or another way draws just the same.
    fn settings(self, subject: &Subject, limits: &Limits) -> Result<Option<Settings>, PlanError> {
        let Self { kernel, workgroup, without_boxes, error, sampling } = self;
        let scene = &subject.scene;
        let [width, height] = PICTURE;
        let settings = RenderSettings {
            algorithm: kernel.algorithm(),
            precision: Some(kernel.precision()),
            error,
            ..RenderSettings::default()
        };
        let plan = Plan::for_scene(scene, &settings, [width, height], limits)?;
        let has_boxes = plan.structures.choice.iter().any(|structure| *structure != Structure::None);
        let cuts_nothing = (plan.approximations.min_throughput, plan.approximations.min_shadowed, plan.bounds.total())
            == (0.0, 0.0, 0.0);
        let is_as_another = without_boxes && !has_boxes || error > 0.0 && cuts_nothing;
        let row = kernel.algorithm().description();
        let is_refused = !row.is_of_accurate_model && course::check(scene).is_err();
        let is_shown_elsewhere = sampling != Sampling::PLAIN && subject.name != SAMPLED_SCENE;
        let has_needless_lights = subject.name == MANY_LIGHTS && !row.is_statistical;
        if is_as_another || is_refused || is_shown_elsewhere || has_needless_lights {
            return Ok(None);
        }
        let settings = if row.is_specialized {
            Settings::planned(&plan)
        } else {
            Settings { kernel, ..Settings::new(width, height) }
        };
        let max_tile_side = settings.max_tile_side.min(TILE_SIDE);
        let Sampling { samples, scale } = sampling;
        Ok(Some(Settings { max_tile_side, workgroup, without_boxes, samples, scale, ..settings }))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::selection::{are_of_one_shader, switches};
    use super::*;
    use crate::gpu::DeviceKind;

    pub fn device(float64: bool, packets: bool) -> DeviceDescription {
        DeviceDescription {
            index: 0,
            name: "a device".to_owned(),
            kind: DeviceKind::Cpu,
            driver: String::new(),
            api_version: "1.2.0".to_owned(),
            timestamps: true,
            max_image_side: 16384,
            max_storage_bytes: 1 << 27,
            max_texels: 1 << 27,
            float64,
            packets,
            lacks: Vec::new(),
        }
    }

    pub fn runs_on(device: &DeviceDescription, scope: Scope) -> Vec<Run> {
        runs(device, &Limits { float64: device.float64, ..Limits::PROMISED }, scope).unwrap()
    }

    #[test]
    fn every_kernel_draws_every_scene_and_no_two_runs_have_one_name() {
        let runs = runs_on(&device(true, true), Scope::Whole);
        for (place, run) in runs.iter().enumerate() {
            assert!(runs[..place].iter().all(|before| before.name != run.name), "{}", run.name);
        }
        let has = |name: &str| runs.iter().any(|run| run.name == name);
        for kernel in ["course", "plain", "whitted f32", "whitted f64"] {
            for entry in gallery::entries() {
                let scene = gallery::scene(&entry.name).unwrap();
                if kernel == "course" && course::check(&scene).is_err() {
                    continue;
                }
                let name = format!("{}, {kernel}", entry.name);
                assert!(has(&name), "{name}");
            }
            assert!(runs.iter().any(|run| run.name.contains(&format!("{kernel}, workgroups of 4x8"))), "{kernel}");
        }
        for name in [
            "grid-cone-100, whitted f64, error 1/510",
            "grid-cone-100, plain, without boxes",
            "showcase without lights and reflections, plain",
        ] {
            assert!(has(name), "{name}");
        }
    }

    #[test]
    fn what_would_be_drawn_just_the_same_is_left_out() {
        let runs = runs_on(&device(true, true), Scope::Whole);
        for name in [
            "four, plain, without boxes",
            "start, whitted f32, error 1/510",
            "showcase without lights and reflections, course",
        ] {
            assert!(!runs.iter().any(|run| run.name == name), "{name}");
        }
    }

    #[test]
    fn a_device_is_asked_only_for_what_it_has() {
        let runs = runs_on(&device(false, false), Scope::Whole);
        assert!(runs.iter().all(|run| run.settings.kernel.precision() == Precision::F32));
        assert!(runs.iter().all(|run| run.settings.workgroup == WORKGROUP));
    }

    #[test]
    fn the_quick_runs_are_few_and_have_all_that_the_whole_has() {
        let device = device(true, true);
        let (whole, quick) = (runs_on(&device, Scope::Whole), runs_on(&device, Scope::EverySwitch));
        assert!(quick.len() * 8 < whole.len(), "{} of {}", quick.len(), whole.len());
        let quick: Vec<&[Run]> = quick.chunk_by(are_of_one_shader).collect();
        let whole: Vec<&[Run]> = whole.chunk_by(are_of_one_shader).collect();
        assert_eq!(quick.len(), whole.len());
        for (quick, whole) in quick.iter().zip(whole) {
            assert!(are_of_one_shader(&quick[0], &whole[0]));
            for (quick, whole) in switches(quick).iter().zip(switches(whole)) {
                assert_eq!((quick.on > 0, quick.off > 0), (whole.on > 0, whole.off > 0), "{}", whole.name);
            }
        }
    }
}
