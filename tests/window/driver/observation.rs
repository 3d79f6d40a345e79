//! What the window tells of a frame.

use glam::DVec3;
use serde::Deserialize;

/// A line of `view --observe`.
#[derive(Debug, Clone, Deserialize)]
pub struct Observation {
    pub window: [u32; 2],
    pub picture_corner: [u32; 2],
    pub picture_size: [u32; 2],
    pub is_whole: bool,
    pub is_finished: bool,
    pub pictures_traced: u64,
    pub primitives: usize,
    pub lights: usize,
    pub selection: Option<usize>,
    pub seconds: Option<f64>,
    camera_position: [f64; 3],
    camera_direction: [f64; 3],
    pub has_unsaved_changes: bool,
    pub file: Option<String>,
    pub dialog: Option<String>,
    pub refusal: Option<String>,
    pub kernel: String,
    pub device_losses: u32,
    pub validation_messages: usize,
    pub widgets: Vec<Widget>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Widget {
    pub role: String,
    pub name: String,
    pub value: String,
    pub is_disabled: bool,
    /// Left, top, right, bottom, pixels of the window.
    rect: [f64; 4],
}

impl Widget {
    pub fn middle(&self) -> [f64; 2] {
        let [left, top, right, bottom] = self.rect;
        [f64::midpoint(left, right), f64::midpoint(top, bottom)]
    }
}

impl Observation {
    /// What can be used by that name, or else what is called so; the last of several lies on top of the others.
    pub fn find(&self, name: &str) -> Option<&Widget> {
        self.widgets.iter().rev().find(|widget| widget.name == name && widget.role != "Label")
    }

    #[track_caller]
    pub fn widget(&self, name: &str) -> &Widget {
        self.find(name).unwrap_or_else(|| panic!("{name:?} is not there: {:?}", self.names()))
    }

    /// Of a field, as it is shown to assistive programs.
    #[track_caller]
    pub fn value(&self, name: &str) -> &str {
        &self.widget(name).value
    }

    /// Whether this is to be read anywhere in the window.
    pub fn says(&self, text: &str) -> bool {
        self.widgets.iter().any(|widget| widget.name == text || widget.value == text)
    }

    /// The selected primitive, as the list calls it.
    #[track_caller]
    pub fn selected_name(&self) -> &str {
        let list = self.find("Выбранный примитив").or_else(|| self.find("Selected primitive"));
        &list.expect("the list of primitives").value
    }

    pub fn position(&self) -> DVec3 {
        self.camera_position.into()
    }

    pub fn direction(&self) -> DVec3 {
        self.camera_direction.into()
    }

    /// A place of the window by its place in the picture, both sides from 0 to 1.
    pub fn in_picture(&self, x: f64, y: f64) -> [f64; 2] {
        let [left, top] = self.picture_corner.map(f64::from);
        let [width, height] = self.picture_size.map(f64::from);
        [left + (x * width).floor(), top + (y * height).floor()]
    }

    /// A place of the window by a pixel of the picture, column and row.
    pub fn in_picture_pixel(&self, pixel: [u32; 2]) -> [f64; 2] {
        [0, 1].map(|axis| f64::from(self.picture_corner[axis] + pixel[axis]))
    }

    /// All but the widgets, which are many.
    pub fn in_short(&self) -> String {
        format!("{:?}", Self { widgets: Vec::new(), ..self.clone() })
    }

    fn names(&self) -> Vec<&str> {
        self.widgets.iter().map(|widget| widget.name.as_str()).filter(|name| !name.is_empty()).collect()
    }
}
