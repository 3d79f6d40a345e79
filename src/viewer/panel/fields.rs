//! The parts that the groups are made of: titled groups, number fields, buttons, all with names that can be found.

use std::ops::RangeInclusive;

use egui::{DragValue, Key, Response, Ui};
use glam::DVec3;

use crate::settings::sampling::MAX_PATH_SAMPLES;

/// What a number field accepts.
pub struct Scale {
    typed: RangeInclusive<f64>,
    /// Part of `typed`.
    dragged: RangeInclusive<f64>,
    /// Steps of dragging and of the arrow keys, as the reciprocal, since 3 / 20 is 0.15 and 3 · 0.05 is not.
    steps_per_unit: f64,
}

impl Scale {
    /// The course's: world units.
    pub const POSITION: Self = Self::new(-1000.0..=1000.0, 2.0);
    /// The course's: degrees.
    pub const ROTATION: Self = Self::new(0.0..=360.0, 2.0);
    /// The course's: colours and coefficients.
    pub const SHARE: Self = Self::new(0.0..=1.0, 20.0);
    /// Linear and not limited to 1, but that is where most are; kernels calculate in `f32`.
    pub const INTENSITY: Self =
        Self { typed: 0.0..=f32::MAX as f64, dragged: 0.0..=1.0, steps_per_unit: Self::SHARE.steps_per_unit };
    /// World units, greater than 0.
    pub const LENGTH: Self = Self { typed: 1e-6..=1000.0, dragged: 0.05..=1000.0, steps_per_unit: 20.0 };
    /// World units; a plate is a box without thickness.
    pub const HALF_SIZE: Self = Self::new(0.0..=1000.0, 20.0);
    /// Coordinates of a unit vector.
    pub const AXIS: Self = Self::new(-1.0..=1.0, 20.0);
    /// Degrees of a cone's half angle, in (0, 90).
    pub const HALF_ANGLE: Self = Self { typed: 0.001..=89.999, dragged: 0.5..=89.5, steps_per_unit: 2.0 };
    /// Exponent of a highlight.
    pub const SHININESS: Self = Self::new(1.0..=1024.0, 1.0);
    /// Refractive index: common ones are dragged.
    pub const REFRACTIVE_INDEX: Self = Self { typed: 0.01..=100.0, dragged: 1.0..=3.0, steps_per_unit: 20.0 };
    /// Degrees of a field of view, in (0, 180).
    pub const FIELD_OF_VIEW: Self = Self { typed: 0.001..=179.999, dragged: 1.0..=179.0, steps_per_unit: 2.0 };
    /// World units in a second.
    pub const SPEED: Self = Self { typed: 0.01..=1000.0, dragged: 0.5..=1000.0, steps_per_unit: 2.0 };

    /// Paths of a pixel: more are typed than anyone would drag to.
    pub const PATHS: Self =
        Self { typed: 1.0..=MAX_PATH_SAMPLES as f64, dragged: 1.0..=65536.0, steps_per_unit: 1.0 / 64.0 };

    pub const fn new(range: RangeInclusive<f64>, steps_per_unit: f64) -> Self {
        Self { dragged: *range.start()..=*range.end(), typed: range, steps_per_unit }
    }

    fn clamp(&self, value: f64) -> f64 {
        value.clamp(*self.typed.start(), *self.typed.end())
    }

    fn nearest_step(&self, value: f64) -> f64 {
        let step = (value * self.steps_per_unit).round() / self.steps_per_unit;
        step.clamp(*self.dragged.start(), *self.dragged.end())
    }
}

/// The mouse's way from one step to the next, logical pixels: short enough to be quick, long enough to hit each.
const DRAG_PER_STEP: f64 = 4.0;

/// A titled group that can be folded; `salt` names it in every language.
pub fn group(ui: &mut Ui, salt: &'static str, title: &str, contents: impl FnOnce(&mut Ui)) {
    let heading = egui::RichText::new(title).strong();
    egui::CollapsingHeader::new(heading).id_salt(salt).default_open(true).show(ui, contents);
}

/// A labelled number that is dragged or typed, with the accessible name `GROUP: LABEL`. A new value comes when one is
/// chosen: with each step of dragging, with Enter or when the focus leaves.
pub fn number(ui: &mut Ui, group: &str, label: &str, value: f64, scale: &Scale) -> Option<f64> {
    ui.label(label);
    let id = ui.next_auto_id();
    let is_typing = ui.memory(|memory| memory.has_focus(id));
    let was_given_up = ui.data_mut(|data| data.remove_temp::<GivenUp>(id)).is_some();
    let is_fine = ui.input(|input| input.modifiers.shift);
    let step = scale.steps_per_unit.recip();
    let shown = decimal(value);
    let mut edited = value;
    let field = DragValue::new(&mut edited)
        // A scene may hold what a hand may not choose, and looking at it must not change it.
        .clamp_existing_to_range(false)
        .range(scale.typed.clone())
        // The arrow keys step by the same number.
        .speed(if is_typing { step } else { step / DRAG_PER_STEP })
        .update_while_editing(false)
        .custom_formatter(|value, _| decimal(value))
        // What was not touched keeps the digits that are not shown.
        .custom_parser(|text| if text == shown || was_given_up { None } else { parse(text) });
    let response = ui.add(field);
    if ui.input(|input| input.key_pressed(Key::Escape)) && ui.memory(|memory| memory.had_focus_last_frame(id)) {
        ui.data_mut(|data| data.insert_temp(id, GivenUp));
    }
    if response.dragged() && edited != value && !is_fine {
        edited = scale.nearest_step(edited);
    }
    name_widget(&response, || format!("{group}: {label}"));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_numeric_value_step(step));
    // Neither the arrow keys nor a screen reader's requests are kept in the range by egui.
    let edited = if edited == value || !edited.is_finite() { value } else { scale.clamp(edited) };
    (edited != value).then_some(edited)
}

/// What was typed into a field was given up with Escape. egui 0.36 heeds that for one frame and takes the text up in
/// the next, in which it still counts the focus as just lost.
#[derive(Clone, Copy, Default)]
struct GivenUp;

/// A number on a row of its own.
pub fn number_row(ui: &mut Ui, group: &str, label: &str, value: f64, scale: &Scale) -> Option<f64> {
    ui.horizontal(|ui| number(ui, group, label, value, scale)).inner
}

/// Three numbers in a row.
pub fn vector(ui: &mut Ui, group: &str, labels: [&str; 3], value: DVec3, scale: &Scale) -> Option<DVec3> {
    let edit = |ui: &mut Ui| [0, 1, 2].map(|axis| number(ui, group, labels[axis], value[axis], scale));
    let edited = ui.horizontal_wrapped(edit).inner;
    let any = edited.iter().any(Option::is_some);
    any.then(|| DVec3::from_array([0, 1, 2].map(|axis| edited[axis].unwrap_or(value[axis]))))
}

/// The course's names of three coordinates.
pub const XYZ: [&str; 3] = ["x", "y", "z"];
/// The course's names of three channels.
pub const RGB: [&str; 3] = ["R", "G", "B"];

/// A button of a few signs, with a name for those who do not see it.
pub fn short_button(ui: &mut Ui, sign: &str, name: &str) -> bool {
    let response = ui.small_button(sign).on_hover_text(name);
    name_widget(&response, || name.to_owned());
    response.clicked()
}

/// A radio button; whether another one was chosen by it.
pub fn choice(ui: &mut Ui, is_chosen: bool, label: &str, hint: &str) -> bool {
    let response = ui.radio(is_chosen, label);
    let clicked = response.clicked();
    if !hint.is_empty() {
        response.on_hover_text(hint);
    }
    clicked && !is_chosen
}

/// A check box; what it was set to.
pub fn check(ui: &mut Ui, is_set: bool, label: &str) -> Option<bool> {
    let mut edited = is_set;
    ui.checkbox(&mut edited, label).changed().then_some(edited)
}

/// A check box of a group of which there may be several, with the accessible name `GROUP: LABEL`; what it was set to.
pub fn check_of(ui: &mut Ui, group: &str, is_set: bool, label: &str) -> Option<bool> {
    let mut edited = is_set;
    let response = ui.checkbox(&mut edited, label);
    name_widget(&response, || format!("{group}: {label}"));
    response.changed().then_some(edited)
}

/// Says what a widget is called, to screen readers and tests.
pub fn name_widget(response: &Response, name: impl FnOnce() -> String) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(name()));
}

/// Six significant digits without trailing zeros; what rounding leaves of a zero is shown as 0.
pub fn decimal(value: f64) -> String {
    const NOISE: f64 = 1e-9;
    if value.abs() < NOISE {
        return "0".to_owned();
    }
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    let text = format!("{rounded:?}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

/// A finite number, with a point or a comma.
fn parse(text: &str) -> Option<f64> {
    let text = text.trim().replace(',', ".").replace('−', "-");
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_without_noise() {
        let shown = [0.1_f32 as f64, 0.1 + 0.2, -0.0, 6e-17, 1000.0, -62.0, 1.0 / 3.0, 1e-6, 3.4e38].map(decimal);
        assert_eq!(shown, ["0.1", "0.3", "0", "0", "1000", "-62", "0.333333", "1e-6", "3.4e38"]);
    }

    #[test]
    fn points_and_commas_are_read_and_nothing_that_is_not_a_number() {
        assert_eq!(["0,5", " -1.25 ", "−2", "1e-3"].map(parse), [Some(0.5), Some(-1.25), Some(-2.0), Some(0.001)]);
        assert_eq!(["", "nan", "inf", "-infinity", "1e999", "x", "1.2.3"].map(parse), [None; 7]);
    }

    #[test]
    fn steps_are_the_decimals_they_are_called_by() {
        assert_eq!([0.149, 0.31, 1.2, -0.4].map(|value| Scale::SHARE.nearest_step(value)), [0.15, 0.3, 1.0, 0.0]);
        assert_eq!(Scale::POSITION.nearest_step(-1.7), -1.5);
    }
}
