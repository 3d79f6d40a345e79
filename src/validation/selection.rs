//! Which of the runs are enough: what plans turn on and off in them.

use serde::Serialize;

use super::{Run, Scope};
use crate::plan::{Features, LightFeatures, Media, WORKGROUP, scene_space};
use crate::tracer::Settings;
use crate::tracer::whitted::WhittedRecords;

/// Runs in a row that are drawn by one shader.
pub(super) fn by_shader(runs: &[Run]) -> impl Iterator<Item = &[Run]> {
    runs.chunk_by(are_of_one_shader)
}

pub(super) fn are_of_one_shader(a: &Run, b: &Run) -> bool {
    (a.settings.kernel, a.settings.workgroup) == (b.settings.kernel, b.settings.workgroup)
}

/// Those of the runs that [GPU-assisted validation](crate::gpu::Validation::GpuAssisted) draws, which makes each
/// variant of a kernel compile for many seconds: in the whole those that show each switch on and off, else as few as
/// have each access, by the kernels that plans choose on this device. (All at once in one scene would be fewer, but a
/// kernel of all kinds with boxes over them takes minutes to compile once it is instrumented.)
pub fn instrumented(runs: &[Run], scope: Scope) -> Vec<Run> {
    let of_one_shader = by_shader(runs).flat_map(|runs| match scope {
        Scope::Whole => few_with_all(runs, |_| true),
        // Path tracing reads what whitted does, by the same functions, and takes longest of all to compile.
        Scope::EverySwitch if runs[0].settings.kernel.description().is_statistical => Vec::new(),
        Scope::EverySwitch if runs[0].settings.workgroup == WORKGROUP => few_with_all(runs, adds_accesses),
        Scope::EverySwitch => Vec::new(),
    });
    of_one_shader.collect()
}

/// Approximations and axis-aligned boxes only leave out what a kernel reads.
fn adds_accesses((name, is_on): State) -> bool {
    is_on && !["axis-aligned boxes", "paths cut", "shadow rays cut"].contains(&name)
}

/// A part of a kernel, and whether it is on.
type State = (&'static str, bool);

/// Again and again the run that has most of what counts and was not to be seen yet, in the order of the whole.
pub(super) fn few_with_all(runs: &[Run], counts: impl Fn(State) -> bool) -> Vec<Run> {
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

/// What plans turn on and off, with whether this run has it; `None` for the course's kernel, which is always the same.
fn states(run: &Run) -> Option<[State; 23]> {
    let &Settings { kernel, approximations, width, height, without_boxes, samples, scale, .. } = &run.settings;
    if !kernel.description().is_of_accurate_model {
        return None;
    }
    let records = WhittedRecords::of(&run.scene, scene_space(&run.scene, kernel), kernel.precision(), [width, height]);
    let max_depth = run.settings.max_depth.unwrap_or(run.scene.max_depth);
    // Whole, so that nothing new is forgotten here.
    let Features {
        kinds: [spheres, boxes, cylinders, cones],
        levels,
        are_boxes_axis_aligned,
        highlights,
        light_spheres,
        lights,
        shadows,
        reflections,
        is_close_up,
        // A scene does not determine how it is sampled, nor whether invocations come in packets.
        samples: _,
        pixels: _,
        pending: _,
        // Other integers, no other work.
        independent_numbers: _,
        light: LightFeatures { shininess, attenuation, ambient_light, media },
    } = Features::of(&records, kernel.description(), &approximations, max_depth);
    Some([
        ("spheres", spheres),
        ("boxes", boxes),
        ("cylinders", cylinders),
        ("cones", cones),
        ("boxes over solids", levels != [0; 4] && !without_boxes),
        ("axis-aligned boxes", are_boxes_axis_aligned),
        ("close-ups", is_close_up),
        ("highlights", highlights),
        ("own exponents", shininess),
        ("attenuation", attenuation),
        ("ambient light", ambient_light),
        ("refraction", media != Media::None),
        ("nested media", media == Media::Nested),
        ("light spheres", light_spheres > 0),
        ("lights", lights > 0),
        ("several lights", lights > 1),
        ("one of many lights", lights > 2),
        ("shadows", shadows),
        ("reflections", reflections),
        ("paths cut", approximations.min_throughput > 0.0),
        ("shadow rays cut", approximations.min_shadowed > 0.0),
        ("several samples", samples > 1),
        ("upscaled", scale < 1.0),
    ])
}

/// A part of an accurate kernel, with how many runs have it and how many do not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Switch {
    /// In the plural, mostly, and the same in every report.
    pub name: &'static str,
    /// Runs that have it.
    pub on: usize,
    /// Runs that do not.
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
    use super::super::runs::tests::{device, runs_on};
    use super::*;

    #[test]
    fn what_is_instrumented_is_little_and_has_each_access() {
        let device = device(true, true);
        for (scope, a_shader) in [(Scope::Whole, 8), (Scope::EverySwitch, 5)] {
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
