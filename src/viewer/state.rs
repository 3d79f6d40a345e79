//! Everything the window knows, and what each action does to it.

mod dialog;

use std::borrow::Cow;
use std::collections::VecDeque;
use std::mem;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::action::{Action, Effect, Kernel, UnsavedAnswer};
use super::document::Document;
use super::edits::Refusal;
use super::preferences::Preferences;
use super::timeline::Timeline;
use crate::frame::FileFormat;
use crate::scene::format::{Note, Reading};
use crate::scene::{Scene, gallery};
use crate::settings::sampling::Sampling;
use crate::settings::{RenderSettings, Shading};

pub use dialog::{Dialog, FilePurpose, Message};

/// All of the window but its picture.
#[derive(Debug)]
pub struct State {
    /// The scene, what is selected in it, its file and its history.
    pub document: Document,
    /// To be kept for the next run.
    pub preferences: Preferences,
    /// What draws the picture now, or its left side, which need not be the usual one.
    pub kernel: Kernel,
    /// What draws its right side, where two stand beside each other.
    pub beside: Option<Kernel>,
    /// Where the divider stands between them: share of the picture's width, 0 to 1.
    pub divider: f64,
    /// Scale of the accurate kernels: size of the traced picture against the one shown.
    scale: f64,
    /// Shading model of the accurate model; see [`State::shading`].
    shading: Shading,
    /// Setting of the settings' file, where there is one.
    pub setting: Option<RenderSettings>,
    /// Traces anew though nothing changes, as measuring needs.
    pub is_continuous: bool,
    /// Whether the sheet of keys is to be seen.
    pub is_help_shown: bool,
    /// The modal dialog over everything, if there is one.
    pub dialog: Option<Dialog>,
    /// To be shown when the dialog is closed.
    messages: VecDeque<Message>,
    errand: Errand,
    /// What [`Dialog::Recover`] offers.
    recovered: Option<Document>,
}

/// What a file dialog is for beyond its purpose.
#[derive(Debug, Default)]
enum Errand {
    #[default]
    None,
    /// What waits for the document to be saved.
    SaveFirst(Action),
    /// The loss of unsaved changes has been agreed to.
    DiscardChanges,
}

impl State {
    /// With a `recovered` document it begins by asking whether to take that up.
    pub fn new(document: Document, preferences: Preferences, recovered: Option<Document>) -> Self {
        let preferences = preferences.clamped();
        Self {
            document,
            kernel: Kernel::Own(preferences.kernel),
            beside: None,
            divider: 0.5,
            preferences,
            scale: Sampling::PLAIN.scale,
            setting: None,
            shading: Shading::Whitted,
            is_continuous: false,
            is_help_shown: false,
            dialog: recovered.as_ref().map(|_| Dialog::Recover),
            messages: VecDeque::new(),
            errand: Errand::None,
            recovered,
        }
    }

    /// Drawn at first as a settings' file says, or else by this kernel, and not by the usual one, which stays that.
    pub fn drawn_by(self, kernel: Option<Kernel>, setting: Option<RenderSettings>) -> Self {
        Self { kernel: setting.map(Kernel::BySetting).or(kernel).unwrap_or(self.kernel), setting, ..self }
    }

    /// With this light model at first.
    pub fn shaded_by(self, shading: Shading) -> Self {
        Self { shading, ..self }
    }

    /// What draws, from the left.
    pub fn kernels(&self) -> impl Iterator<Item = Kernel> + use<> {
        [self.kernel].into_iter().chain(self.beside)
    }

    /// How much of the light model a kernel draws.
    pub fn shading_by(&self, kernel: Kernel) -> Shading {
        if kernel.is_chosen_in_panel() { self.shading } else { kernel.settings().shading }
    }

    /// The scene as a kernel draws it: by [`Self::shading_by`].
    pub fn shaded_scene(&self, kernel: Kernel) -> Cow<'_, Scene> {
        let shading = self.shading_by(kernel);
        match self.document.shown_scene() {
            Cow::Borrowed(scene) => shading.applied(scene),
            Cow::Owned(scene) => Cow::Owned(shading.applied(&scene).into_owned()),
        }
    }

    /// How finely the accurate kernels trace once nothing changes.
    pub fn accurate_sampling(&self) -> Sampling {
        Sampling { samples: self.preferences.samples, scale: self.scale }
    }

    /// How finely a kernel traces; those that take no samples know but one way.
    pub fn sampling(&self, kernel: Kernel) -> Sampling {
        let row = kernel.description();
        match kernel {
            Kernel::Own(_) if row.samples => self.accurate_sampling(),
            Kernel::Own(_) if row.is_statistical => {
                Sampling { samples: self.preferences.path_samples, ..Sampling::PLAIN }
            }
            _ => kernel.settings().sampling(),
        }
    }

    /// Does what is asked and returns what is left to do outside the state.
    ///
    /// While a dialog is open, only its answers, the window's settings and, unless the dialog asks about unsaved
    /// changes already, [`Action::Quit`] are taken; anything else is ignored, as under any modal dialog.
    pub fn apply(&mut self, action: Action) -> Vec<Effect> {
        if !self.takes(&action) {
            return Vec::new();
        }
        if !is_edit(&action) {
            self.document.end_run();
        }
        let is_loss_agreed = matches!((&self.errand, &action), (Errand::DiscardChanges, Action::OpenFile(_)));
        let effects = if self.would_lose_changes(&action) && !is_loss_agreed {
            self.open_dialog(Dialog::Unsaved(Box::new(action)));
            Vec::new()
        } else {
            self.perform(action)
        };
        if self.dialog.is_none() {
            self.dialog = self.messages.pop_front().map(Dialog::Message);
        }
        effects
    }

    /// Shows what went wrong outside the state, after the dialog that is open.
    pub fn report(&mut self, failure: impl ToString) {
        self.say(Message::failure(failure));
    }

    /// Time goes on by so much, where it is played; what the scene may not be then ends that, and is said.
    pub fn play(&mut self, elapsed: Duration) {
        let now = self.document.timeline();
        self.set_timeline(now.after(elapsed, self.document.scene().duration_seconds()));
    }

    fn set_timeline(&mut self, timeline: Timeline) {
        if let Err(error) = self.document.set_timeline(timeline) {
            self.say(Message::failure(error));
        }
    }

    /// What the dialog leaves to be asked.
    fn takes(&self, action: &Action) -> bool {
        use Action::{
            AnswerRecover, AnswerUnsaved, CloseDialog, MoveDivider, OpenFile, Quit, SaveTo, ScreenshotTo, SetBeside,
            SetContinuous, SetKernel, SetPreferences, SetSampling, SetShading, ShowHelp,
        };
        let is_window_setting = matches!(
            action,
            SetPreferences(_)
                | SetKernel(_)
                | SetBeside(_)
                | MoveDivider(_)
                | SetSampling(_)
                | SetShading(_)
                | SetContinuous(_)
                | ShowHelp(_)
        );
        let is_answer = match &self.dialog {
            None => true,
            Some(Dialog::Message(_)) => matches!(action, CloseDialog | Quit),
            Some(Dialog::File(_)) => {
                matches!(action, OpenFile(_) | SaveTo(_) | ScreenshotTo(_) | CloseDialog | Quit)
            }
            Some(Dialog::Unsaved(_)) => matches!(action, AnswerUnsaved(_) | CloseDialog),
            Some(Dialog::Recover) => matches!(action, AnswerRecover(_) | Quit),
        };
        is_window_setting || is_answer
    }

    fn would_lose_changes(&self, action: &Action) -> bool {
        use Action::{New, Open, OpenFile, OpenGallery, Quit};
        matches!(action, New | Open | OpenFile(_) | OpenGallery(_) | Quit) && self.document.has_unsaved_changes()
    }

    /// Does what is asked, whatever is lost by it.
    fn perform(&mut self, action: Action) -> Vec<Effect> {
        match action {
            Action::Add(kind) => self.edit(|document| document.add(kind)),
            Action::Rename(name) => self.edit(|document| document.rename(name)),
            Action::MoveTo(target) => self.edit(|document| document.move_to(target)),
            Action::Rotate(degrees) => self.edit(|document| document.rotate(degrees)),
            Action::SetSolid(solid) => self.edit(|document| document.set_solid(solid)),
            Action::SetMaterial(material) => self.edit(|document| document.set_material(material)),
            Action::Duplicate => self.edit(Document::duplicate),
            Action::Delete => self.edit(Document::delete),
            Action::AddLight => self.edit(Document::add_light),
            Action::SetLight(index, light) => self.edit(|document| document.set_light(index, light)),
            Action::DeleteLight(index) => self.edit(|document| document.delete_light(index)),
            Action::SetBackground(color) => self.edit(|document| document.set_background(color)),
            Action::SetAmbientLight(color) => self.edit(|document| document.set_ambient_light(color)),
            Action::SetMaxDepth(max_depth) => self.edit(|document| document.set_max_depth(max_depth)),
            Action::SetProjection(projection) => self.edit(|document| document.set_projection(projection)),
            Action::SetVerticalFov(degrees) => self.edit(|document| document.set_vertical_fov(degrees)),

            Action::Select(selection) => self.document.select(selection),
            Action::ResetCamera => self.document.reset_camera(),
            Action::Undo => self.document.undo(),
            Action::Redo => self.document.redo(),

            Action::New => self.document = Document::new(Scene::default(), None),
            Action::Open => self.open_dialog(Dialog::File(FilePurpose::Open)),
            Action::OpenFile(path) => self.open_file(path),
            Action::OpenGallery(name) => self.open_gallery(&name),
            Action::Save => match self.document.path().map(Path::to_owned) {
                Some(path) => drop(self.save(&path)),
                None => self.open_dialog(Dialog::File(FilePurpose::Save)),
            },
            Action::SaveAs => self.open_dialog(Dialog::File(FilePurpose::Save)),
            Action::SaveTo(path) => return self.save_to(path),
            Action::Screenshot => self.open_dialog(Dialog::File(FilePurpose::Screenshot)),
            Action::ScreenshotTo(path) => return self.screenshot_to(path),
            Action::Quit => return vec![Effect::Quit],

            Action::AnswerUnsaved(answer) => return self.answer_unsaved(answer),
            Action::AnswerRecover(is_taken) => self.answer_recover(is_taken),
            Action::CloseDialog => drop(self.close_dialog()),

            Action::SetPreferences(preferences) => self.preferences = preferences.clamped(),
            Action::SetKernel(kernel) => self.set_kernel(kernel),
            Action::SetBeside(kernel) => self.beside = kernel,
            Action::MoveDivider(share) => self.divider = share.clamp(0.0, 1.0),
            Action::SetShading(shading) => self.shading = shading,
            Action::SetSampling(Sampling { samples, scale }) => {
                (self.preferences.samples, self.scale) = (samples, scale);
            }
            Action::SetContinuous(is_continuous) => self.is_continuous = is_continuous,
            Action::SetTimeline(timeline) => self.set_timeline(timeline),
            Action::ShowHelp(is_shown) => self.is_help_shown = is_shown,
        }
        Vec::new()
    }

    fn set_kernel(&mut self, kernel: Kernel) {
        self.kernel = kernel;
        if let Kernel::Own(kernel) = kernel {
            self.preferences.kernel = kernel;
        }
    }

    fn edit(&mut self, edit: impl FnOnce(&mut Document) -> Result<(), Refusal>) {
        if let Err(refusal) = edit(&mut self.document) {
            self.say(refusal.into());
        }
    }

    fn open_file(&mut self, path: PathBuf) {
        self.close_dialog();
        match Scene::read(&path) {
            Ok(Reading { scene, notes, .. }) => {
                self.document = Document::new(scene, Some(path));
                if !notes.is_empty() {
                    let lines: Vec<_> = notes.iter().map(Note::to_string).collect();
                    self.say(Message::ReadOtherwise(lines.join("\n")));
                }
            }
            Err(error) => self.say(Message::failure(error)),
        }
    }

    fn open_gallery(&mut self, name: &str) {
        match gallery::scene(name) {
            Some(scene) => self.document = Document::new(scene, None),
            None => self.say(Message::failure(format!("the gallery has no scene {name:?}"))),
        }
    }

    fn save_to(&mut self, path: PathBuf) -> Vec<Effect> {
        let errand = self.close_dialog();
        match (self.save(&FilePurpose::Save.completed(path)), errand) {
            (true, Errand::SaveFirst(waiting)) => self.perform(waiting),
            _ => Vec::new(),
        }
    }

    /// Whether it was saved; if not, why not is said.
    fn save(&mut self, path: &Path) -> bool {
        let saved = self.document.save_to(path);
        if let Err(error) = &saved {
            self.say(Message::failure(error));
        }
        saved.is_ok()
    }

    fn screenshot_to(&mut self, path: PathBuf) -> Vec<Effect> {
        self.close_dialog();
        let path = FilePurpose::Screenshot.completed(path);
        match FileFormat::of(&path) {
            Ok(_) => vec![Effect::SaveScreenshot(path)],
            Err(error) => {
                self.say(Message::failure(error));
                Vec::new()
            }
        }
    }

    fn answer_unsaved(&mut self, answer: UnsavedAnswer) -> Vec<Effect> {
        let Some(Dialog::Unsaved(waiting)) = self.dialog.take_if(|dialog| matches!(dialog, Dialog::Unsaved(_))) else {
            return Vec::new();
        };
        match answer {
            UnsavedAnswer::Cancel => Vec::new(),
            UnsavedAnswer::Discard => {
                let is_file_asked_for = *waiting == Action::Open;
                let effects = self.perform(*waiting);
                if is_file_asked_for {
                    self.errand = Errand::DiscardChanges;
                }
                effects
            }
            UnsavedAnswer::Save => match self.document.path().map(Path::to_owned) {
                Some(path) if self.save(&path) => self.perform(*waiting),
                Some(_) => Vec::new(),
                None => {
                    self.open_dialog(Dialog::File(FilePurpose::Save));
                    self.errand = Errand::SaveFirst(*waiting);
                    Vec::new()
                }
            },
        }
    }

    fn answer_recover(&mut self, is_taken: bool) {
        self.close_dialog();
        if let Some(recovered) = self.recovered.take().filter(|_| is_taken) {
            self.document = recovered;
        }
    }

    /// In place of the one that is open.
    fn open_dialog(&mut self, dialog: Dialog) {
        self.close_dialog();
        self.dialog = Some(dialog);
    }

    /// Returns what a file dialog was for.
    fn close_dialog(&mut self) -> Errand {
        self.dialog = None;
        mem::take(&mut self.errand)
    }

    /// Shows a message, after the dialog that is open.
    pub fn say(&mut self, message: Message) {
        if self.dialog.is_none() {
            self.dialog = Some(Dialog::Message(message));
        } else {
            self.messages.push_back(message);
        }
    }
}

/// Whether it can be one of the edits that make one undo step together.
fn is_edit(action: &Action) -> bool {
    use Action::{
        MoveTo, Rename, Rotate, SetAmbientLight, SetBackground, SetLight, SetMaterial, SetMaxDepth, SetProjection,
        SetSolid, SetVerticalFov,
    };
    matches!(
        action,
        Rename(_)
            | MoveTo(_)
            | Rotate(_)
            | SetSolid(_)
            | SetMaterial(_)
            | SetLight(..)
            | SetAmbientLight(_)
            | SetBackground(_)
            | SetMaxDepth(_)
            | SetProjection(_)
            | SetVerticalFov(_)
    )
}

#[cfg(test)]
mod tests;
