//! «Параметры света»: every light's position and colour.

use egui::Ui;

use super::fields::{RGB, Scale, XYZ, check_of, group, number_row, vector};
use crate::scene::{LIGHT_LIMIT, Light, Scene};
use crate::viewer::action::Action;
use crate::viewer::text::Words;

pub fn show(ui: &mut Ui, words: &Words, scene: &Scene, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    group(ui, "light", groups.light, |ui| {
        for (index, light) in scene.lights.iter().enumerate() {
            ui.push_id(index, |ui| show_light(ui, words, index, light, actions));
        }
        let add = ui.add_enabled(scene.lights.len() < LIGHT_LIMIT, egui::Button::new(groups.add_light));
        if add.clicked() {
            actions.push(Action::AddLight);
        }
    });
}

fn show_light(ui: &mut Ui, words: &Words, index: usize, light: &Light, actions: &mut Vec<Action>) {
    let groups = &words.groups;
    let number = index + 1;
    // The course has one light: the first goes without a number.
    let name = if index == 0 { groups.light.to_owned() } else { format!("{} {number}", groups.light) };
    let position = vector(ui, &name, XYZ, light.position, &Scale::POSITION);
    let intensity = vector(ui, &name, RGB, light.intensity, &Scale::INTENSITY);
    let radius = number_row(ui, &name, groups.radius, light.radius, &Scale::HALF_SIZE);
    let attenuates = check_of(ui, &name, light.distance_constant.is_some(), groups.attenuation);
    let distance_constant = match attenuates {
        Some(attenuates) => attenuates.then_some(1.0),
        None => light
            .distance_constant
            .map(|constant| number_row(ui, &name, "K", constant, &Scale::LENGTH).unwrap_or(constant)),
    };
    let edited = Light {
        position: position.unwrap_or(light.position),
        intensity: intensity.unwrap_or(light.intensity),
        radius: radius.unwrap_or(light.radius),
        distance_constant,
    };
    if edited != *light {
        actions.push(Action::SetLight(index, edited));
    }
    if ui.button(format!("{} {number}", groups.delete_light)).clicked() {
        actions.push(Action::DeleteLight(index));
    }
    ui.separator();
}
