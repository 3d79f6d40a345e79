//! What surrounds the primitives, and what looks at them.

use egui::Ui;

use super::fields::{RGB, Scale, check, choice, group, number, number_row, vector};
use crate::scene::{DEPTH_LIMIT, Projection};
use crate::settings::Shading;
use crate::settings::sampling::{MAX_SAMPLES, MIN_SCALE, Sampling};
use crate::viewer::action::{Action, Kernel};
use crate::viewer::own_kernel::OwnKernel;
use crate::viewer::preferences::Preferences;
use crate::viewer::state::State;
use crate::viewer::text::Words;

/// Generations of a ray.
const DEPTH: Scale = Scale::new(1.0..=DEPTH_LIMIT as f64, 1.0);
/// Samples of a pixel.
const SAMPLES: Scale = Scale::new(1.0..=MAX_SAMPLES as f64, 1.0);
/// Size of the traced picture against the one shown.
const SCALE: Scale = Scale::new(MIN_SCALE..=1.0, 20.0);

pub fn show(ui: &mut Ui, words: &Words, state: &State, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let scene = state.document.scene();
    group(ui, "camera", groups.camera, |ui| {
        ui.label(groups.background);
        let background = vector(ui, groups.background, RGB, scene.background, &Scale::INTENSITY);
        actions.extend(background.map(Action::SetBackground));
        ui.label(groups.ambient_light);
        let ambient_light = vector(ui, groups.ambient_light, RGB, scene.ambient_light, &Scale::INTENSITY);
        actions.extend(ambient_light.map(Action::SetAmbientLight));

        let depth = ui.horizontal(|ui| number(ui, groups.camera, groups.max_depth, scene.max_depth.into(), &DEPTH));
        depth.response.on_hover_text(groups.max_depth_hint);
        // invariant: the scale keeps it in the range of `u32`.
        actions.extend(depth.inner.map(|depth| Action::SetMaxDepth(depth.round() as u32)));

        show_projection(ui, words, scene.camera.projection, actions);
        let fov = scene.camera.vertical_fov_degrees;
        let fov = number_row(ui, groups.camera, groups.vertical_fov, fov, &Scale::FIELD_OF_VIEW);
        actions.extend(fov.map(Action::SetVerticalFov));
        if ui.button(groups.reset_camera).clicked() {
            actions.push(Action::ResetCamera);
        }
        show_flight(ui, words, &state.preferences, actions);
        show_kernel(ui, words, state, actions);
        let has_shading = state.kernel.is_chosen_in_panel();
        ui.add_enabled_ui(has_shading, |ui| show_shading(ui, words, state.shading(), actions));
        let has_sampling = has_shading && state.kernel.description().samples;
        ui.add_enabled_ui(has_sampling, |ui| show_sampling(ui, words, state.accurate_sampling(), actions));
    });
}

fn show_projection(ui: &mut Ui, words: &Words, now: Projection, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let choices = [
        (Projection::Course, groups.projection_course, groups.projection_course_hint),
        (Projection::Centered, groups.projection_centered, ""),
    ];
    ui.label(groups.projection);
    ui.horizontal_wrapped(|ui| {
        for (projection, label, hint) in choices {
            if choice(ui, now == projection, label, hint) {
                actions.push(Action::SetProjection(projection));
            }
        }
    });
}

fn show_kernel(ui: &mut Ui, words: &Words, state: &State, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    ui.label(groups.kernel);
    ui.horizontal_wrapped(|ui| {
        for kernel in OwnKernel::all() {
            let Some([label, hint]) = groups.kernel_words(kernel) else { continue };
            if choice(ui, state.kernel == Kernel::Own(kernel), label, hint) {
                actions.push(Action::SetKernel(Kernel::Own(kernel)));
            }
        }
        if let Some(setting) = state.setting {
            let kernel = Kernel::BySetting(setting);
            if choice(ui, state.kernel == kernel, groups.kernel_by_setting, &setting.to_string()) {
                actions.push(Action::SetKernel(kernel));
            }
        }
    });
}

fn show_shading(ui: &mut Ui, words: &Words, now: Shading, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let choices = [
        (Shading::Lambert, groups.shading_lambert),
        (Shading::Phong, groups.shading_phong),
        (Shading::Whitted, groups.shading_whitted),
    ];
    ui.label(groups.shading);
    ui.horizontal_wrapped(|ui| {
        for (shading, label) in choices {
            if choice(ui, now == shading, label, "") {
                actions.push(Action::SetShading(shading));
            }
        }
    });
}

fn show_sampling(ui: &mut Ui, words: &Words, now: Sampling, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let samples = ui.horizontal(|ui| number(ui, groups.camera, groups.samples, now.samples.into(), &SAMPLES));
    samples.response.on_hover_text(groups.samples_hint);
    let scale = ui.horizontal(|ui| number(ui, groups.camera, groups.scale, now.scale, &SCALE));
    scale.response.on_hover_text(groups.scale_hint);
    // invariant: the scale keeps it in the range of `u32`.
    let samples = samples.inner.map(|samples| Sampling { samples: samples.round() as u32, ..now });
    actions.extend(samples.map(Action::SetSampling));
    actions.extend(scale.inner.map(|scale| Action::SetSampling(Sampling { scale, ..now })));
}

fn show_flight(ui: &mut Ui, words: &Words, now: &Preferences, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let fly_speed = number_row(ui, groups.camera, groups.fly_speed, now.fly_speed, &Scale::SPEED);
    let is_mouse_inverted = check(ui, now.is_mouse_inverted, groups.invert_mouse);
    if fly_speed.is_some() || is_mouse_inverted.is_some() {
        actions.push(Action::SetPreferences(Preferences {
            fly_speed: fly_speed.unwrap_or(now.fly_speed),
            is_mouse_inverted: is_mouse_inverted.unwrap_or(now.is_mouse_inverted),
            ..now.clone()
        }));
    }
}
