//! What scripts that drive the window read: a line of JSON for every frame that differs from the last.

use std::io::{self, Write};

use egui::accesskit::{Node, TreeUpdate};
use serde::Serialize;

use super::action::Kernel;
use super::panel::Shown;
use super::state::State;

/// A widget as assistive programs see it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Widget {
    pub role: String,
    pub name: String,
    pub value: String,
    pub is_disabled: bool,
    /// Corners on the window, pixels: left, top, right, bottom.
    pub rect: [f64; 4],
}

/// One frame of the window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Observation {
    /// Size of the window, pixels.
    pub window: [u32; 2],
    /// Position of the picture's corner, pixels.
    pub picture_corner: [u32; 2],
    pub picture_size: [u32; 2],
    /// Whether all of the picture is of the scene as it is now.
    pub is_whole: bool,
    /// Whether it has all its samples, too.
    pub is_finished: bool,
    pub pictures_traced: u64,
    /// From the change of the scene to the first whole picture of it being shown, ms; of the last change.
    pub latency_ms: Option<f64>,
    /// Median GPU time of the last pictures, ms.
    pub gpu_time_ms: Option<f64>,
    pub uploaded_bytes: u64,
    pub primitives: usize,
    pub lights: usize,
    pub selection: Option<usize>,
    /// Of the picture shown, from the animation's start; none where the scene is shown as its file has it.
    pub seconds: Option<f64>,
    pub camera_position: [f64; 3],
    pub camera_direction: [f64; 3],
    pub has_unsaved_changes: bool,
    pub file: Option<String>,
    pub dialog: Option<String>,
    pub refusal: Option<String>,
    pub kernel: String,
    pub device_losses: u32,
    pub validation_messages: usize,
    pub widgets: Vec<Widget>,
}

/// Prints observations to standard output.
#[derive(Debug, Default)]
pub struct Observer {
    last: Option<Observation>,
}

impl Observer {
    pub fn tell(&mut self, observation: Observation) -> io::Result<()> {
        if self.last.as_ref() == Some(&observation) {
            return Ok(());
        }
        let line = serde_json::to_string(&observation)?;
        self.last = Some(observation);
        let mut output = io::stdout().lock();
        writeln!(output, "{line}").and_then(|()| output.flush())
    }
}

impl Observation {
    /// What the state alone says; the rest is for the caller to fill in.
    pub fn of(state: &State, shown: &Shown, pixels_per_point: f32) -> Self {
        let document = &state.document;
        let camera = &document.shown_scene().camera;
        let corner = shown.picture.min * pixels_per_point;
        Self {
            window: [0, 0],
            picture_corner: [corner.x.round() as u32, corner.y.round() as u32],
            picture_size: [0, 0],
            is_whole: false,
            is_finished: false,
            pictures_traced: 0,
            latency_ms: None,
            gpu_time_ms: None,
            uploaded_bytes: 0,
            primitives: document.scene().primitives.len(),
            lights: document.scene().lights.len(),
            selection: document.selection(),
            seconds: document.timeline().picture_seconds(),
            camera_position: camera.position.to_array(),
            camera_direction: camera.direction.to_array(),
            has_unsaved_changes: document.has_unsaved_changes(),
            file: document.path().map(|path| path.display().to_string()),
            dialog: state.dialog.as_ref().map(|dialog| format!("{dialog:?}")),
            refusal: None,
            kernel: match state.kernel {
                Kernel::Own(kernel) => kernel.algorithm.name(),
                Kernel::BySetting(_) => "setting",
            }
            .to_owned(),
            device_losses: 0,
            validation_messages: 0,
            widgets: Vec::new(),
        }
    }
}

/// Every widget with a name or a value; a name may be another widget's, which labels it.
pub fn widgets(tree: &TreeUpdate, pixels_per_point: f32) -> Vec<Widget> {
    let text_of = |node: &Node| node.label().or(node.value()).unwrap_or_default().to_owned();
    let labelled_by = |node: &Node| {
        let labels = node.labelled_by().iter().filter_map(|id| tree.nodes.iter().find(|(other, _)| other == id));
        labels.map(|(_, label)| text_of(label)).collect::<Vec<_>>().join(" ")
    };
    let of = |node: &Node| {
        let bounds = node.bounds()?;
        let name = node.label().map_or_else(|| labelled_by(node), str::to_owned);
        let value = node.value().map(str::to_owned).or_else(|| node.numeric_value().map(|value| value.to_string()));
        let value = value.or_else(|| node.toggled().map(|toggled| format!("{toggled:?}"))).unwrap_or_default();
        let rect = [bounds.x0, bounds.y0, bounds.x1, bounds.y1].map(|side| side * f64::from(pixels_per_point));
        let is_told = !name.is_empty() || !value.is_empty();
        let role = format!("{:?}", node.role());
        is_told.then(|| Widget { role, name, value, is_disabled: node.is_disabled(), rect })
    };
    tree.nodes.iter().filter_map(|(_, node)| of(node)).collect()
}
