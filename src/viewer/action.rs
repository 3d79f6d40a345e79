//! What a user can ask of the window.

use std::path::PathBuf;

use glam::DVec3;

use super::own_kernel::OwnKernel;
use super::preferences::Preferences;
use super::timeline::Timeline;
use crate::algorithm::Description;
use crate::scene::{Light, Material, Projection, Solid, SolidKind};
use crate::settings::sampling::Sampling;
use crate::settings::{RenderSettings, Shading};

/// One wish. Edits go through the undo history; a wish that cannot be granted changes nothing and shows a message.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    // ---- Primitives. All but the first two concern the selected one.
    /// Adds the course's default solid, which becomes the selected one.
    Add(SolidKind),
    /// By index; one beyond the last, like `None`, selects nothing.
    Select(Option<usize>),
    /// An empty name takes the given one away.
    Rename(String),
    /// To an absolute position, see [`Solid::move_to`].
    MoveTo(DVec3),
    /// By the course's rule, see [`Solid::rotate`]; degrees.
    Rotate(DVec3),
    /// New sizes or another pose of the same kind.
    SetSolid(Solid),
    /// Colour and coefficients as a whole.
    SetMaterial(Material),
    /// The copy stands beside the original, on its +x side, and becomes the selected one.
    Duplicate,
    /// The next one, or else the last, becomes the selected one.
    Delete,

    // ---- The scene around them.
    /// The course's, at the world's origin.
    AddLight,
    /// By index, as a whole; one that is not there is not set.
    SetLight(usize, Light),
    /// By index; one that is not there is not deleted.
    DeleteLight(usize),
    /// Linear RGB.
    SetBackground(DVec3),
    /// Linear RGB.
    SetAmbientLight(DVec3),
    /// From 1 to [`DEPTH_LIMIT`](crate::scene::DEPTH_LIMIT).
    SetMaxDepth(u32),
    /// The camera stays where it is.
    SetProjection(Projection),
    /// In (0, 180).
    SetVerticalFov(f64),
    /// Back to where the camera was when the scene was opened.
    ResetCamera,

    /// Takes the last edit back, and what is selected with it.
    Undo,
    /// Makes the last edit undone again.
    Redo,

    // ---- Files. Those that would lose changes ask first.
    /// The course's start state.
    New,
    /// Asks for a file.
    Open,
    /// A scene's, see [`Scene::load`](crate::scene::Scene::load).
    OpenFile(PathBuf),
    /// By the scene's name, see [`gallery`](crate::scene::gallery).
    OpenGallery(String),
    /// To its file, or asks for one.
    Save,
    /// Asks for a file.
    SaveAs,
    /// A name without an extension gets `.toml`.
    SaveTo(PathBuf),
    /// Asks for a file.
    Screenshot,
    /// PNG or OpenEXR by its extension; a name without one gets `.png`.
    ScreenshotTo(PathBuf),
    /// Ends the program.
    Quit,

    // ---- What a dialog is answered with.
    /// To "there are unsaved changes".
    AnswerUnsaved(UnsavedAnswer),
    /// To "the last run left unsaved work": whether to take it up.
    AnswerRecover(bool),
    /// Away with a message, or with a question that is not answered.
    CloseDialog,

    // ---- The window.
    /// As a whole; numbers out of range are brought into it.
    SetPreferences(Preferences),
    /// Draws from now on and, but for a settings' file, at the start of the next run.
    SetKernel(Kernel),
    /// Draws the picture's right side from now on; `None`: there is but one picture.
    SetBeside(Option<Kernel>),
    /// Share of the picture's width that is the left side's; brought into 0 to 1.
    MoveDivider(f64),
    /// Sampling of the accurate kernel.
    SetSampling(Sampling),
    /// How much of the light model is drawn, but by the course's kernel and a settings' file.
    SetShading(Shading),
    /// Whether pictures are traced anew though nothing changes.
    SetContinuous(bool),
    /// As a whole; numbers out of range are brought into it. In a scene that does not move it does nothing.
    SetTimeline(Timeline),
    /// Whether the sheet of keys is to be seen.
    ShowHelp(bool),
}

/// Before changes would be lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnsavedAnswer {
    /// Saves, having asked for a file where there is none, and goes on.
    Save,
    /// Goes on, and the changes are lost.
    Discard,
    /// Leaves everything as it is.
    Cancel,
}

/// What draws the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kernel {
    /// An algorithm, exactly.
    Own(OwnKernel),
    /// As the settings' file says, on the Vulkan device.
    BySetting(RenderSettings),
}

impl Kernel {
    /// What is asked of a plan or, where nothing is left out, of the algorithm.
    pub fn settings(self) -> RenderSettings {
        match self {
            Self::Own(kernel) => kernel.settings(),
            Self::BySetting(settings) => settings,
        }
    }

    /// Of its algorithm.
    pub fn description(self) -> &'static Description {
        self.settings().algorithm.description()
    }

    /// Whether it draws the accurate model, with what the panel chooses of that: light model and samples.
    pub fn is_chosen_in_panel(self) -> bool {
        matches!(self, Self::Own(_)) && self.description().is_of_accurate_model
    }
}

/// What the window has to do outside its state.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Closes the window.
    Quit,
    /// Writes the picture as it is into a PNG or EXR file.
    SaveScreenshot(PathBuf),
}
