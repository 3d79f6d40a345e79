//! What is drawn. Pure: no Vulkan.

use std::sync::Arc;

use serde::Serialize;

use crate::gpu::DeviceDescription;
use crate::plan::{Limits, Plan, PlanError, Precision, Structure, Wishes};
use crate::scene::{KernelFrame, Light, Scene, gallery};
use crate::tracer::sampling::Sampling;
use crate::tracer::{Kernel, Requirements, Settings, WORKGROUP, WhittedRecords};

/// Pixels. The checks are per command and per access, not per pixel.
pub const PICTURE: [u32; 2] = [64, 28];

/// Pixels: the sides of some tiles end inside a workgroup.
const TILE_SIDE: u32 = 40;

/// The allowed error of the runs with cuts: half a step of a channel in 8 bits.
const ERROR: f64 = 1.0 / 510.0;

/// A workgroup that does not come by eights along x, so that a kernel cannot count on
/// [octets](DeviceDescription::octets). No plan chooses it; where there are octets, it shows the kernels of other devices,
/// and few scenes are enough.
const NARROW_WORKGROUP: [u32; 2] = [4, 8];

/// More than one sample a pixel, and a smaller picture enlarged. One scene shows what these add behind the tracing.
const SAMPLED: Sampling = Sampling { samples: 3, scale: 0.5 };
const SAMPLED_SCENE: &str = TWO_LIGHTS;

/// All kinds of solids, too few for boxes over them, and two lights in sight.
const TWO_LIGHTS: &str = "showcase with one light more";

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
    pub scene: Arc<Scene>,
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

/// Runs in a row that are drawn by one shader.
pub(super) fn by_shader(runs: &[Run]) -> impl Iterator<Item = &[Run]> {
    runs.chunk_by(are_of_one_shader)
}

fn are_of_one_shader(a: &Run, b: &Run) -> bool {
    (a.settings.kernel, a.settings.workgroup) == (b.settings.kernel, b.settings.workgroup)
}

/// Those of the runs that [GPU-assisted validation](crate::gpu::Validation::GpuAssisted) draws, which makes each variant
/// of a kernel compile for many seconds: in the whole those that show each switch on and off, else as few as have each
/// access, by the kernels that plans choose on this device. (All at once in one scene would be fewer, but a kernel of all
/// kinds with boxes over them takes minutes to compile once it is instrumented.)
pub fn instrumented(runs: &[Run], scope: Scope) -> Vec<Run> {
    let of_one_shader = by_shader(runs).flat_map(|runs| match scope {
        Scope::Whole => few_with_all(runs, |_| true),
        Scope::EverySwitch if runs[0].settings.workgroup == WORKGROUP => few_with_all(runs, adds_accesses),
        Scope::EverySwitch => Vec::new(),
    });
    of_one_shader.collect()
}

/// Cuts and upright boxes only leave out what a kernel reads.
fn adds_accesses((name, is_on): State) -> bool {
    is_on && !["upright boxes", "paths cut", "shadow rays cut"].contains(&name)
}

/// A part of a kernel, and whether it is on.
type State = (&'static str, bool);

/// Again and again the run that has most of what counts and was not to be seen yet, in the order of the whole.
fn few_with_all(runs: &[Run], counts: impl Fn(State) -> bool) -> Vec<Run> {
    // The course's kernel has one state.
    let states: Vec<Vec<State>> =
        runs.iter().map(|run| states(run).map_or(vec![("course", true)], |states| states.to_vec())).collect();
    let mut seen: Vec<State> = Vec::new();
    let mut chosen = Vec::new();
    loop {
        let is_news = |state: &&State| counts(**state) && !seen.contains(state);
        let news = |place: &usize| states[*place].iter().filter(is_news).count();
        // Of equals the first.
        let best = (0..runs.len()).rev().max_by_key(news).filter(|place| news(place) > 0);
        let Some(best) = best else { break };
        chosen.push(best);
        seen.extend(&states[best]);
    }
    chosen.sort_unstable();
    chosen.into_iter().map(|place| runs[place].clone()).collect()
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
    // What the gallery does not have: nothing is lit and nothing reflected; a second light, and its ball in sight.
    if let Some(showcase) = gallery::scene("showcase") {
        let position = showcase.camera.position + showcase.camera.direction;
        let lights = [showcase.lights.clone(), vec![Light { position, ..Light::default() }]].concat();
        let two_lights = Scene { lights, ..showcase.clone() };
        let unlit = Scene { lights: Vec::new(), max_depth: 1, ..showcase };
        subjects.push(subject(TWO_LIGHTS.to_owned(), two_lights));
        subjects.push(subject("showcase without lights and reflections".to_owned(), unlit));
    }
    subjects
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
    let precisions: &[Precision] = if device.float64 { &[Precision::F32, Precision::F64] } else { &[Precision::F32] };
    let whitted = precisions.iter().map(|&precision| Kernel::Whitted(precision));
    let workgroups: &[[u32; 2]] = if device.octets { &[WORKGROUP, NARROW_WORKGROUP] } else { &[WORKGROUP] };
    let mut ways = Vec::new();
    for kernel in [Kernel::Course, Kernel::Plain].into_iter().chain(whitted) {
        for &workgroup in workgroups {
            let exact = Way { kernel, workgroup, without_boxes: false, error: 0.0, sampling: Sampling::PLAIN };
            ways.push(exact);
            if kernel != Kernel::Course {
                ways.push(Way { without_boxes: true, ..exact });
                ways.push(Way { sampling: SAMPLED, ..exact });
            }
            if matches!(kernel, Kernel::Whitted(_)) {
                ways.push(Way { error: ERROR, ..exact });
            }
        }
    }
    ways
}

impl Way {
    fn name(self) -> String {
        let Self { kernel, workgroup: [width, height], without_boxes, error, sampling } = self;
        let kernel = match kernel {
            Kernel::Course => "course".to_owned(),
            Kernel::Plain => "plain".to_owned(),
            Kernel::Whitted(precision) => format!("whitted {}", precision.name()),
        };
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
        let wishes = Wishes { precision: Some(kernel.precision()), error, ..Wishes::exact(width, height) };
        let plan = Plan::for_scene(scene, &wishes, limits)?;
        let has_boxes = plan.structures.choice.iter().any(|structure| *structure != Structure::None);
        let cuts_nothing = (plan.cuts.least_weight, plan.cuts.least_shadowed, plan.bounds.total()) == (0.0, 0.0, 0.0);
        let is_as_another = without_boxes && !has_boxes || error > 0.0 && cuts_nothing;
        // The course's kernel has one light.
        let is_refused = kernel == Kernel::Course && scene.lights.len() != 1;
        let is_shown_elsewhere = sampling != Sampling::PLAIN && subject.name != SAMPLED_SCENE;
        if is_as_another || is_refused || is_shown_elsewhere {
            return Ok(None);
        }
        let settings = match kernel {
            Kernel::Course | Kernel::Plain => Settings { kernel, ..Settings::new(width, height) },
            Kernel::Whitted(_) => Settings::planned(&plan, width, height),
        };
        let max_tile_side = settings.max_tile_side.min(TILE_SIDE);
        let Sampling { samples, scale } = sampling;
        Ok(Some(Settings { max_tile_side, workgroup, without_boxes, samples, scale, ..settings }))
    }
}

/// What plans turn on and off, with whether this run has it; `None` for the course's kernel, which is always the same.
fn states(run: &Run) -> Option<[State; 16]> {
    let &Settings { kernel, cuts, width, height, without_boxes, samples, scale, .. } = &run.settings;
    if kernel == Kernel::Course {
        return None;
    }
    let records = WhittedRecords::of(&run.scene, KernelFrame::of(&run.scene), kernel.precision(), [width, height]);
    let max_depth = run.settings.max_depth.unwrap_or(run.scene.max_depth);
    // Whole, so that nothing new is forgotten here.
    let Requirements {
        kinds: [spheres, boxes, cylinders, cones],
        levels,
        are_boxes_upright,
        highlights,
        balls,
        lights,
        shadows,
        reflections,
        // A scene does not tell how it is sampled, nor whether invocations come in packets.
        samples: _,
        pixels: _,
    } = Requirements::of(&records, &cuts, max_depth);
    Some([
        ("spheres", spheres),
        ("boxes", boxes),
        ("cylinders", cylinders),
        ("cones", cones),
        ("boxes over solids", levels != [0; 4] && !without_boxes),
        ("upright boxes", are_boxes_upright),
        ("highlights", highlights),
        ("balls of lights", balls > 0),
        ("lights", lights > 0),
        ("several lights", lights > 1),
        ("shadows", shadows),
        ("reflections", reflections),
        ("paths cut", cuts.least_weight > 0.0),
        ("shadow rays cut", cuts.least_shadowed > 0.0),
        ("several samples", samples > 1),
        ("enlarged", scale < 1.0),
    ])
}

/// A part of an accurate kernel, with how many runs have it and how many do not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Switch {
    pub name: &'static str,
    pub on: usize,
    pub off: usize,
}

/// What the plans of the runs turn on and off.
pub fn switches(runs: &[Run]) -> Vec<Switch> {
    let mut switches: Vec<Switch> = Vec::new();
    for (place, (name, is_on)) in runs.iter().filter_map(states).flat_map(|states| states.into_iter().enumerate()) {
        if place == switches.len() {
            switches.push(Switch { name, on: 0, off: 0 });
        }
        let switch = &mut switches[place];
        *(if is_on { &mut switch.on } else { &mut switch.off }) += 1;
    }
    switches
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::DeviceKind;

    fn device(float64: bool, octets: bool) -> DeviceDescription {
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
            octets,
            lacks: Vec::new(),
        }
    }

    fn runs_on(device: &DeviceDescription, scope: Scope) -> Vec<Run> {
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
        assert!(quick.len() * 10 < whole.len(), "{} of {}", quick.len(), whole.len());
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

    #[test]
    fn what_is_instrumented_is_little_and_has_each_access() {
        let device = device(true, true);
        for (scope, a_shader) in [(Scope::Whole, 8), (Scope::EverySwitch, 2)] {
            let all = runs_on(&device, scope);
            let all: Vec<_> = match scope {
                Scope::Whole => all,
                Scope::EverySwitch => all.into_iter().filter(|run| run.settings.workgroup == WORKGROUP).collect(),
            };
            let few = instrumented(&all, scope);
            for (few, all) in by_shader(&few).zip(by_shader(&all)) {
                assert!(are_of_one_shader(&few[0], &all[0]));
                assert!(few.len() <= a_shader, "{}: {}", few[0].name, few.len());
                for (few, all) in switches(few).iter().zip(switches(all)) {
                    let is_asked_for = scope == Scope::Whole || adds_accesses((all.name, true));
                    assert!(!is_asked_for || (few.on > 0) == (all.on > 0), "{}", all.name);
                }
            }
        }
    }

    #[test]
    fn whatever_a_plan_turns_on_or_off_is_seen_both_ways() {
        for scope in [Scope::Whole, Scope::EverySwitch] {
            let runs = runs_on(&device(false, false), scope);
            for Switch { name, on, off } in switches(&runs) {
                assert!(on > 0 && off > 0, "{name}: {on} on, {off} off");
            }
        }
    }
}
