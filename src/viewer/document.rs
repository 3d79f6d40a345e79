//! The scene being edited, with what is selected in it, where it is kept, and how to go back.

use std::borrow::Cow;
use std::mem;
use std::path::{Path, PathBuf};

use super::history::{Field, History, Snapshot, is_same_work};
use super::timeline::Timeline;
use crate::scene::format::SceneFormat;
use crate::scene::{Camera, Part, Primitive, Scene, SceneError};

/// Its scene is always valid and its selection always a primitive of the scene.
#[derive(Debug)]
pub struct Document {
    current: Snapshot,
    history: History,
    path: Option<PathBuf>,
    /// What its file holds, or what it began with; none if only a crash left it.
    saved: Option<Scene>,
    opening_camera: Camera,
    timeline: Timeline,
}

impl Document {
    /// A scene as it was loaded from `path` or made without a file; it must be valid. A file of a format that is read
    /// only is not the document's: it could not be saved there.
    pub fn new(scene: Scene, path: Option<PathBuf>) -> Self {
        Self { saved: Some(scene.clone()), ..Self::recovered(scene, path) }
    }

    /// A valid scene that was never saved to `path` as it is.
    pub fn recovered(scene: Scene, path: Option<PathBuf>) -> Self {
        let path = path.filter(|path| SceneFormat::of(path).map_or(true, SceneFormat::is_written));
        let path = path.map(|path| absolute(&path));
        Self {
            opening_camera: scene.camera.clone(),
            current: Snapshot { scene, selection: None },
            history: History::default(),
            path,
            saved: None,
            timeline: Timeline::default(),
        }
    }

    /// What is edited, saved and undone: always valid and without a time. Its camera is the window's where that is not
    /// the animation's.
    pub fn scene(&self) -> &Scene {
        &self.current.scene
    }

    /// Moving the camera is not an edit: it is neither undone nor a reason to ask before closing. Its angle and its
    /// projection are edits and do not go this way.
    ///
    /// An animated camera stays where the user takes it.
    pub fn camera_mut(&mut self) -> &mut Camera {
        if self.is_camera_followed() {
            let Camera { position, direction, up, .. } = self.shown_scene().camera;
            let camera = &mut self.current.scene.camera;
            (camera.position, camera.direction, camera.up) = (position, direction, up);
            self.timeline.follows_camera = false;
        }
        &mut self.current.scene.camera
    }

    /// Back to where the camera was when the scene was opened.
    pub fn reset_camera(&mut self) {
        let Camera { position, direction, up, .. } = self.opening_camera;
        let camera = self.camera_mut();
        (camera.position, camera.direction, camera.up) = (position, direction, up);
    }

    /// Which time is shown.
    pub fn timeline(&self) -> Timeline {
        self.timeline
    }

    /// Numbers out of range are brought into it; where nothing is animated there is no time.
    ///
    /// # Errors
    /// The scene may not be what it would be then; the time stays as it was and stands still.
    pub(super) fn set_timeline(&mut self, timeline: Timeline) -> Result<(), SceneError> {
        let scene = self.scene();
        if scene.animation.is_empty() {
            self.timeline = Timeline::default();
            return Ok(());
        }
        let timeline = timeline.clamped(scene.duration_seconds());
        if let Err(error) = timeline.picture_seconds().map_or(Ok(()), |seconds| scene.clone().go_to(seconds)) {
            self.timeline.is_playing = false;
            return Err(error);
        }
        self.timeline = timeline;
        Ok(())
    }

    /// The scene at the time that is shown, with the camera that is looked through; without a time, or where an edit left
    /// none that may be at that time, as it is.
    pub fn shown_scene(&self) -> Cow<'_, Scene> {
        let Some(seconds) = self.timeline.picture_seconds() else { return Cow::Borrowed(self.scene()) };
        let mut scene = self.scene().clone();
        if scene.go_to(seconds).is_err() {
            return Cow::Borrowed(self.scene());
        }
        if !self.timeline.follows_camera {
            let Camera { position, direction, up, .. } = self.scene().camera;
            (scene.camera.position, scene.camera.direction, scene.camera.up) = (position, direction, up);
        }
        Cow::Owned(scene)
    }

    /// Whether the animation moves or turns the camera.
    pub fn is_camera_animated(&self) -> bool {
        let moves = |field| ["position", "direction", "look_at", "up"].contains(&field);
        let mut fields =
            self.scene().animation.iter().filter(|track| track.part == Part::Scene).map(|track| track.field);
        fields.any(|field| field.strip_prefix("camera.").is_some_and(moves))
    }

    fn is_camera_followed(&self) -> bool {
        self.timeline.follows_camera && self.timeline.seconds.is_some() && self.is_camera_animated()
    }

    /// The file it was opened from or last saved to.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Index into the scene's primitives.
    pub fn selection(&self) -> Option<usize> {
        self.current.selection
    }

    /// `None` where no primitive is.
    pub fn selected(&self) -> Option<&Primitive> {
        self.scene().primitives.get(self.selection()?)
    }

    /// An index beyond the last primitive selects nothing.
    pub fn select(&mut self, selection: Option<usize>) {
        self.current.selection = selection.filter(|&index| index < self.scene().primitives.len());
    }

    /// Number of a primitive among those of its kind, from 1: the course's «Сфера1». 0 if there is no such primitive.
    pub fn ordinal(&self, index: usize) -> usize {
        let primitives = &self.scene().primitives;
        primitives.get(index).map_or(0, |primitive| {
            let kind = primitive.solid.kind();
            primitives[..=index].iter().filter(|other| other.solid.kind() == kind).count()
        })
    }

    /// Whether edits would be lost by closing; a recovered document always has some.
    pub fn has_unsaved_changes(&self) -> bool {
        !self.saved.as_ref().is_some_and(|saved| is_same_work(saved, self.scene()))
    }

    /// Writes the scene, with the camera as it stands, to a file of one of the formats that are written, which is the document's
    /// from then on, unless it is for other programs to read.
    ///
    /// # Errors
    /// Those of [`Scene::save`]; the document and the file stay as they were.
    pub fn save_to(&mut self, path: &Path) -> Result<(), SceneError> {
        self.scene().save(path)?;
        if !SceneFormat::of(path).is_ok_and(SceneFormat::is_read) {
            return Ok(());
        }
        self.saved = Some(self.scene().clone());
        self.path = Some(absolute(path));
        Ok(())
    }

    /// Whether there is an edit to be taken back.
    pub fn can_undo(&self) -> bool {
        self.history.can_undo()
    }

    /// Whether an edit was taken back, and none made since.
    pub fn can_redo(&self) -> bool {
        self.history.can_redo()
    }

    /// Takes the last step back, if there is one, with what was selected before it.
    pub fn undo(&mut self) {
        self.history.undo(&mut self.current);
    }

    /// Takes the last step undone again, if there is one.
    pub fn redo(&mut self) {
        self.history.redo(&mut self.current);
    }

    /// The next edit is an undo step of its own, though it may go on with the field of the last one.
    pub fn end_run(&mut self) {
        self.history.end_run();
    }

    /// Edits the scene; a change that changes nothing is no step. Edits of the same `field` in a row are one step.
    ///
    /// # Errors
    /// The edited scene would not be valid; nothing has changed.
    pub(super) fn edit(&mut self, field: Option<Field>, change: impl FnOnce(&mut Scene)) -> Result<(), SceneError> {
        let mut scene = self.scene().clone();
        change(&mut scene);
        if scene == *self.scene() {
            return Ok(());
        }
        scene.validate()?;
        let selection = self.selection();
        let before = Snapshot { scene: mem::replace(&mut self.current.scene, scene), selection };
        self.history.record(before, &self.current.scene, field);
        self.select(selection);
        Ok(())
    }
}

/// The same file whatever the working directory, as of the next run, which may be offered the document.
fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::{Interpolation, Keyframe, SolidKind, Track, Value, gallery};

    fn document_of(kinds: &[SolidKind]) -> Document {
        let primitives = kinds.iter().map(|kind| Primitive::course_default(*kind)).collect();
        Document::new(Scene { primitives, ..Scene::default() }, None)
    }

    fn set_depth(document: &mut Document, max_depth: u32) {
        document.edit(Some(Field::MaxDepth), |scene| scene.max_depth = max_depth).unwrap();
    }

    #[test]
    fn ordinals_count_each_kind_from_one() {
        use SolidKind::{Box, Sphere};
        let document = document_of(&[Sphere, Box, Sphere, Sphere, Box]);
        assert_eq!([0, 1, 2, 3, 4, 5].map(|index| document.ordinal(index)), [1, 1, 2, 3, 2, 0]);
    }

    #[test]
    fn a_dragged_slider_is_one_undo_step() {
        let mut document = document_of(&[]);
        (1..=5).for_each(|depth| set_depth(&mut document, depth));
        document.undo();
        assert_eq!(document.scene().max_depth, 20);
        assert!(!document.can_undo());
        document.redo();
        assert_eq!(document.scene().max_depth, 5);
    }

    #[test]
    fn a_run_ends_when_told_or_when_another_field_is_edited() {
        let mut document = document_of(&[]);
        set_depth(&mut document, 1);
        document.end_run();
        set_depth(&mut document, 2);
        document.edit(Some(Field::Background), |scene| scene.background = DVec3::ZERO).unwrap();
        set_depth(&mut document, 3);
        let depths: Vec<u32> = std::iter::from_fn(|| {
            let is_step = document.can_undo();
            document.undo();
            is_step.then(|| document.scene().max_depth)
        })
        .collect();
        assert_eq!(depths, [2, 2, 1, 20]);
    }

    #[test]
    fn an_edit_after_an_undo_does_not_join_the_step_undone() {
        let mut document = document_of(&[]);
        set_depth(&mut document, 1);
        document.end_run();
        set_depth(&mut document, 2);
        document.undo();
        set_depth(&mut document, 3);
        assert!(!document.can_redo());
        document.undo();
        assert_eq!(document.scene().max_depth, 1);
    }

    #[test]
    fn edits_that_change_nothing_leave_no_step_and_no_trace() {
        let mut document = document_of(&[]);
        set_depth(&mut document, 20);
        assert!(!document.can_undo());
        set_depth(&mut document, 7);
        set_depth(&mut document, 20);
        assert!(!document.can_undo(), "the slider came back");
        set_depth(&mut document, 7);
        document.undo();
        set_depth(&mut document, 20);
        assert!(document.can_redo());
    }

    #[test]
    fn an_invalid_edit_is_refused_and_changes_nothing() {
        let mut document = document_of(&[SolidKind::Sphere]);
        set_depth(&mut document, 7);
        let refused = document.edit(Some(Field::MaxDepth), |scene| scene.max_depth = 0);
        assert!(refused.unwrap_err().what.contains("max_depth = 0"));
        assert_eq!(document.scene().max_depth, 7);
        document.undo();
        assert!(!document.can_undo() && !document.has_unsaved_changes());
    }

    #[test]
    fn undoing_back_to_what_was_saved_leaves_nothing_unsaved() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = document_of(&[SolidKind::Cone]);
        assert!(!document.has_unsaved_changes());
        set_depth(&mut document, 5);
        document.end_run();
        assert!(document.has_unsaved_changes());
        document.save_to(&folder.path().join("scene.toml")).unwrap();
        set_depth(&mut document, 6);
        document.undo();
        assert!(!document.has_unsaved_changes());
        document.undo();
        assert!(document.has_unsaved_changes(), "before what was saved");
        document.redo();
        assert!(!document.has_unsaved_changes());
    }

    #[test]
    fn moving_the_camera_is_neither_undone_nor_unsaved() {
        let mut document = document_of(&[]);
        document.camera_mut().position = DVec3::splat(3.0);
        assert!(!document.has_unsaved_changes() && !document.can_undo());
        document.edit(Some(Field::VerticalFov), |scene| scene.camera.vertical_fov_degrees = 60.0).unwrap();
        document.camera_mut().position = DVec3::splat(4.0);
        document.camera_mut().direction = DVec3::NEG_Z;
        document.undo();
        let camera = &document.scene().camera;
        assert_eq!((camera.position, camera.direction), (DVec3::splat(4.0), DVec3::NEG_Z));
        assert_eq!(camera.vertical_fov_degrees, Camera::COURSE_FOV_DEGREES);
        document.redo();
        document.reset_camera();
        assert_eq!(document.scene().camera, Camera { vertical_fov_degrees: 60.0, ..Camera::default() });
    }

    fn moving() -> Document {
        Document::new(gallery::scene("dolly").unwrap(), None)
    }

    fn at(seconds: f64) -> Timeline {
        Timeline { seconds: Some(seconds), ..Timeline::default() }
    }

    #[test]
    fn the_scene_is_shown_at_the_time_and_saved_without_it() {
        let mut document = moving();
        assert_eq!(*document.shown_scene(), *document.scene());
        document.set_timeline(at(1.0)).unwrap();
        let mut then = document.scene().clone();
        then.go_to(1.0).unwrap();
        assert_eq!(*document.shown_scene(), then);
        assert_eq!(*document.scene(), gallery::scene("dolly").unwrap());
        assert!(!document.has_unsaved_changes() && !document.can_undo());
        document.edit(Some(Field::Background), |scene| scene.background = DVec3::ONE).unwrap();
        assert_eq!(document.shown_scene().background, DVec3::ONE, "an edit is seen at once");
        assert_eq!(document.shown_scene().camera, then.camera);
    }

    #[test]
    fn the_user_s_camera_takes_an_animated_one_over_where_it_is_and_can_give_it_back() {
        let mut document = moving();
        document.set_timeline(at(1.0)).unwrap();
        let from = document.shown_scene().camera.clone();
        document.camera_mut().position.y += 0.5;
        assert_eq!(document.scene().camera, Camera { position: from.position + DVec3::Y * 0.5, ..from.clone() });
        assert_eq!(document.shown_scene().camera, document.scene().camera);
        document.set_timeline(at(1.0)).unwrap();
        assert_eq!(document.shown_scene().camera, from, "the animation's again");
        document.reset_camera();
        assert_eq!(document.shown_scene().camera, gallery::scene("dolly").unwrap().camera);
    }

    #[test]
    fn a_time_at_which_a_scene_may_not_be_is_refused() {
        // The ends of a cylinder change places and meet half way.
        let keyframes = [-1.0, 1.0].map(|x| {
            let value = Value::Points([DVec3::X * x, DVec3::X * -x]);
            Keyframe { seconds: 1.0 + x, value }
        });
        let ends = Track {
            part: Part::Primitive(0),
            field: "ends",
            interpolation: Interpolation::Linear,
            keyframes: keyframes.to_vec(),
        };
        let primitives = vec![Primitive::course_default(SolidKind::Cylinder)];
        let scene = Scene { primitives, animation: vec![ends], ..Scene::default() };
        let mut document = Document::new(scene, None);
        document.set_timeline(Timeline { is_playing: true, ..at(0.5) }).unwrap();
        assert!(document.set_timeline(Timeline { is_playing: true, ..at(1.0) }).is_err());
        assert_eq!(document.timeline(), at(0.5), "it stands still");
        let mut still = document_of(&[]);
        still.set_timeline(at(1.0)).unwrap();
        assert_eq!(still.timeline(), Timeline::default());
    }

    #[test]
    fn a_selection_beyond_the_last_primitive_is_none() {
        let mut document = document_of(&[SolidKind::Sphere]);
        document.select(Some(0));
        assert!(document.selected().is_some());
        document.edit(None, |scene| scene.primitives.clear()).unwrap();
        assert_eq!(document.selection(), None);
        document.undo();
        assert_eq!(document.selection(), Some(0));
        document.select(Some(1));
        assert_eq!((document.selection(), document.selected()), (None, None));
    }

    #[test]
    fn a_recovered_document_is_unsaved_until_it_is_saved() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.json");
        let mut document = Document::recovered(Scene::default(), Some(path.clone()));
        assert!(document.has_unsaved_changes() && document.path() == Some(&path));
        document.save_to(&path).unwrap();
        assert!(!document.has_unsaved_changes());
        assert_eq!(Scene::load(&path).unwrap(), Scene::default());
    }

    #[test]
    fn a_failed_save_leaves_the_document_as_it_was() {
        let mut document = document_of(&[]);
        set_depth(&mut document, 5);
        assert!(document.save_to(Path::new("/nowhere/at/all/scene.toml")).is_err());
        assert!(document.has_unsaved_changes() && document.path().is_none());
    }
}
