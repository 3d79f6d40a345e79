//! What a user can ask of the window.

use std::path::PathBuf;

use glam::DVec3;

use super::preferences::{Preferences, UsualKernel};
use crate::scene::{Light, Material, Projection, Solid, SolidKind};
use crate::settings::RenderSettings;
use crate::settings::sampling::Sampling;
use crate::tracer::Precision;

/// One wish. Edits go through the undo history; a wish that cannot be granted changes nothing and shows a message.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    // ---- Primitives. All but the first two concern the selected one.
    /// Adds the course's default solid, which becomes the selected one.
    Add(SolidKind),
    Select(Option<usize>),
    /// An empty name takes the given one away.
    Rename(String),
    /// To an absolute position, see [`Solid::move_to`].
    MoveTo(DVec3),
    /// By the course's rule, see [`Solid::rotate`]; degrees.
    Rotate(DVec3),
    /// New sizes or another pose of the same kind.
    SetSolid(Solid),
    SetMaterial(Material),
    Duplicate,
    Delete,

    // ---- The scene around them.
    AddLight,
    SetLight(usize, Light),
    DeleteLight(usize),
    SetBackground(DVec3),
    SetMaxDepth(u32),
    SetProjection(Projection),
    /// In (0, 180).
    SetVerticalFov(f64),
    /// Back to where the camera was when the scene was opened.
    ResetCamera,

    Undo,
    Redo,

    // ---- Files. Those that would lose changes ask first.
    /// The course's start state.
    New,
    /// Asks for a file.
    Open,
    OpenFile(PathBuf),
    OpenGallery(String),
    /// To its file, or asks for one.
    Save,
    /// Asks for a file.
    SaveAs,
    SaveTo(PathBuf),
    /// Asks for a file.
    Screenshot,
    ScreenshotTo(PathBuf),
    Quit,

    // ---- What a dialog is answered with.
    /// To «there are unsaved changes».
    AnswerUnsaved(UnsavedAnswer),
    /// To «the last run left unsaved work»: whether to take it up.
    AnswerRecover(bool),
    CloseDialog,

    // ---- The window.
    SetPreferences(Preferences),
    SetKernel(Kernel),
    /// Of the accurate kernel.
    SetSampling(Sampling),
    SetContinuous(bool),
    ShowHelp(bool),
}

/// Before changes would be lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnsavedAnswer {
    Save,
    Discard,
    Cancel,
}

/// What draws the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kernel {
    /// The course work's, on the Vulkan device.
    Course,
    /// The accurate model on the Vulkan device; `None`: in `f32` where that is right, as the plan for the scene says.
    Accurate(Option<Precision>),
    /// The accurate model in `f64` on the CPU.
    Reference,
    /// As the settings' file says, on the Vulkan device.
    BySetting(RenderSettings),
}

impl From<UsualKernel> for Kernel {
    fn from(usual: UsualKernel) -> Self {
        match usual {
            UsualKernel::Course => Self::Course,
            UsualKernel::Whitted => Self::Accurate(None),
            UsualKernel::WhittedF32 => Self::Accurate(Some(Precision::F32)),
            UsualKernel::WhittedF64 => Self::Accurate(Some(Precision::F64)),
            UsualKernel::Reference => Self::Reference,
        }
    }
}

impl Kernel {
    /// What the next run can begin with; `None` for what needs a settings' file.
    pub fn usual(self) -> Option<UsualKernel> {
        match self {
            Self::Course => Some(UsualKernel::Course),
            Self::Accurate(None) => Some(UsualKernel::Whitted),
            Self::Accurate(Some(Precision::F32)) => Some(UsualKernel::WhittedF32),
            Self::Accurate(Some(Precision::F64)) => Some(UsualKernel::WhittedF64),
            Self::Reference => Some(UsualKernel::Reference),
            Self::BySetting(_) => None,
        }
    }
}

/// What the window has to do outside its state.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    Quit,
    /// Writes the picture as it is into a PNG or EXR file.
    SaveScreenshot(PathBuf),
}
