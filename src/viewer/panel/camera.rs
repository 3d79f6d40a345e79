//! What surrounds the primitives, and what looks at them.

use egui::Ui;

use super::fields::{RGB, Scale, check, choice, group, name_widget, number, number_row, vector};
use crate::algorithm::Description;
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
        show_beside(ui, words, state, actions);
        let is_any = |can: &dyn Fn(&Description) -> bool| {
            state.kernels().any(|kernel| kernel.is_chosen_in_panel() && can(kernel.description()))
        };
        // By the kernel that it is chosen for, if there is one.
        let shaded = state.kernels().find(|kernel| kernel.is_chosen_in_panel());
        let shading = state.shading_by(shaded.unwrap_or(state.kernel));
        ui.add_enabled_ui(shaded.is_some(), |ui| show_shading(ui, words, shading, actions));
        ui.add_enabled_ui(is_any(&|row| row.samples), |ui| {
            show_sampling(ui, words, state.accurate_sampling(), actions);
        });
        ui.add_enabled_ui(is_any(&|row| row.is_statistical), |ui| {
            show_path_samples(ui, words, &state.preferences, actions);
        });
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

/// What draws the picture's right side.
fn show_beside(ui: &mut Ui, words: &Words, state: &State, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let offered = OwnKernel::all().filter(|kernel| groups.kernel_words(*kernel).is_some()).map(Kernel::Own);
    let offered = offered.chain(state.setting.map(Kernel::BySetting)).map(Some);
    let name = |kernel: Option<Kernel>| kernel.map_or(groups.beside_nothing, |kernel| words.kernel_name(kernel, None));
    ui.label(groups.beside);
    let list = egui::ComboBox::from_id_salt("beside").width(ui.available_width()).selected_text(name(state.beside));
    let list = list.show_ui(ui, |ui| {
        for kernel in [None].into_iter().chain(offered) {
            // The kernels' own choices have these names already.
            let response = ui.selectable_label(state.beside == kernel, name(kernel));
            name_widget(&response, || format!("{}: {}", groups.beside, name(kernel)));
            if response.clicked() {
                actions.push(Action::SetBeside(kernel));
            }
        }
    });
    name_widget(&list.response, || format!("{}: {}", groups.camera, groups.beside));
    list.response.on_hover_text(groups.beside_hint);
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

fn show_path_samples(ui: &mut Ui, words: &Words, now: &Preferences, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let samples = now.path_samples.into();
    let samples = ui.horizontal(|ui| number(ui, groups.camera, groups.path_samples, samples, &Scale::PATHS));
    samples.response.on_hover_text(groups.path_samples_hint);
    // invariant: the scale keeps it in the range of `u32`.
    let preferred = samples.inner.map(|samples| Preferences { path_samples: samples.round() as u32, ..now.clone() });
    actions.extend(preferred.map(Action::SetPreferences));
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
