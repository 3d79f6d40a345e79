//! What edits can be undone and redone.

use std::collections::VecDeque;
use std::mem;

use crate::scene::{Camera, Light, Primitive, Scene, Track};

/// What an edit changes: the scene, and what is selected in it.
#[derive(Debug, Clone)]
pub(super) struct Snapshot {
    pub scene: Scene,
    /// Index of a primitive of that scene.
    pub selection: Option<usize>,
}

impl Snapshot {
    /// Becomes `other`, seen from where the camera is now; returns what it was.
    fn replace(&mut self, mut other: Snapshot) -> Snapshot {
        let Camera { position, direction, up, vertical_fov_degrees: _, projection: _ } = &self.scene.camera;
        let camera = &mut other.scene.camera;
        (camera.position, camera.direction, camera.up) = (*position, *direction, *up);
        mem::replace(self, other)
    }

    fn size_bytes(&self) -> usize {
        let names = self.scene.primitives.iter().filter_map(|primitive| primitive.name.as_ref());
        size_of::<Self>()
            + self.scene.primitives.len() * size_of::<Primitive>()
            + self.scene.lights.len() * size_of::<Light>()
            + names.map(String::len).sum::<usize>()
            + self.scene.animation.iter().map(Track::size_bytes).sum::<usize>()
    }
}

/// Whether two scenes differ in nothing but where the camera is.
pub(super) fn is_same_work(one: &Scene, other: &Scene) -> bool {
    let Scene { camera, background, ambient_light, max_depth, lights, primitives, animation } = one;
    let Camera { position: _, direction: _, up: _, vertical_fov_degrees, projection } = camera;
    *vertical_fov_degrees == other.camera.vertical_fov_degrees
        && *projection == other.camera.projection
        && *background == other.background
        && *ambient_light == other.ambient_light
        && *max_depth == other.max_depth
        && *lights == other.lights
        && *primitives == other.primitives
        && *animation == other.animation
}

/// What a slider changes: edits of one field in a row are one step, however many values it went through.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Field {
    Name(usize),
    Position(usize),
    Rotation(usize),
    Solid(usize),
    Material(usize),
    Light(usize),
    Background,
    AmbientLight,
    MaxDepth,
    Projection,
    VerticalFov,
}

#[derive(Debug, Default)]
pub(super) struct History {
    /// The oldest first.
    undo: VecDeque<Snapshot>,
    /// What the last undo left comes last.
    redo: Vec<Snapshot>,
    /// What the step undone next changes, while more changes of it belong to that step.
    run: Option<Field>,
}

impl History {
    const LARGEST_STEPS: usize = 1000;

    /// Enough for all those steps in a scene of 300 primitives. One step is kept whatever it takes.
    const LARGEST_BYTES: usize = 64 << 20;

    /// Remembers what was before an edit, unless a run of edits of the same field does.
    pub fn record(&mut self, before: Snapshot, after: &Scene, field: Option<Field>) {
        self.redo.clear();
        if field.is_none() || self.run != field {
            self.undo.push_back(before);
            self.forget_oldest();
            self.run = field;
        } else if self.undo.back().is_some_and(|start| is_same_work(&start.scene, after)) {
            // A slider came back to where it was taken up.
            self.undo.pop_back();
            self.run = None;
        }
    }

    fn forget_oldest(&mut self) {
        let mut size_bytes: usize = self.undo.iter().map(Snapshot::size_bytes).sum();
        while self.undo.len() > Self::LARGEST_STEPS || (size_bytes > Self::LARGEST_BYTES && self.undo.len() > 1) {
            size_bytes -= self.undo.pop_front().map_or(0, |oldest| oldest.size_bytes());
        }
    }

    /// The next edit is a step of its own.
    pub fn end_run(&mut self) {
        self.run = None;
    }

    pub fn undo(&mut self, current: &mut Snapshot) {
        self.end_run();
        if let Some(before) = self.undo.pop_back() {
            self.redo.push(current.replace(before));
        }
    }

    pub fn redo(&mut self, current: &mut Snapshot) {
        self.end_run();
        if let Some(after) = self.redo.pop() {
            self.undo.push_back(current.replace(after));
        }
    }

    pub fn can_undo(&self) -> bool {
        !self.undo.is_empty()
    }

    pub fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SolidKind;

    fn snapshot(max_depth: u32, primitive_count: usize) -> Snapshot {
        let primitives = vec![Primitive::course_default(SolidKind::Sphere); primitive_count];
        Snapshot { scene: Scene { max_depth, primitives, ..Scene::default() }, selection: None }
    }

    /// A history of `steps` edits, and how many of them can be undone.
    fn undoable(steps: u32, primitive_count: usize) -> usize {
        let mut history = History::default();
        for step in 0..steps {
            history.record(snapshot(step, primitive_count), &snapshot(step + 1, primitive_count).scene, None);
        }
        let mut current = snapshot(steps, primitive_count);
        let mut undone = 0;
        while history.can_undo() {
            history.undo(&mut current);
            undone += 1;
            assert_eq!(current.scene.max_depth, steps - undone);
        }
        undone as usize
    }

    #[test]
    fn the_oldest_steps_are_forgotten() {
        assert_eq!(undoable(10, 0), 10);
        assert_eq!(undoable(1100, 0), History::LARGEST_STEPS);
    }

    #[test]
    fn large_scenes_keep_fewer_steps_but_one_at_least() {
        let primitives_in_budget = History::LARGEST_BYTES / size_of::<Primitive>();
        assert_eq!(undoable(9, primitives_in_budget / 5), 4);
        assert_eq!(undoable(3, primitives_in_budget * 2), 1);
    }

    #[test]
    fn names_count_into_the_memory() {
        let mut named = snapshot(1, 1);
        let unnamed_bytes = named.size_bytes();
        named.scene.primitives[0].name = Some("left wall".to_owned());
        assert_eq!(named.size_bytes(), unnamed_bytes + 9);
    }

    #[test]
    fn the_camera_s_pose_is_no_part_of_the_work_but_its_lens_is() {
        let scene = Scene::default();
        let changed = |change: fn(&mut Camera)| {
            let mut other = scene.clone();
            change(&mut other.camera);
            other
        };
        assert!(is_same_work(&scene, &changed(|camera| camera.position.x = 7.0)));
        assert!(is_same_work(&scene, &changed(|camera| camera.direction.x = 7.0)));
        assert!(!is_same_work(&scene, &changed(|camera| camera.vertical_fov_degrees = 50.0)));
        assert!(!is_same_work(&scene, &changed(|camera| camera.projection = crate::scene::Projection::Course)));
    }
}
