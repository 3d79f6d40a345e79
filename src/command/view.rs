//! `zerkalo view [SCENE]`: the window.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::interrupt::Listener;
use super::{DeviceArgs, ReadingArgs, ValidationArgs, refuse_messages};
use crate::scene::gallery;
use crate::settings::{RenderSettings, Shading};
use crate::tracer::TracerError;
use crate::viewer::action::Kernel;
use crate::viewer::own_kernel::OwnKernel;
use crate::viewer::{self, Document, Options};

/// The gallery's scene that the course's program began with; the window opens on it as that program did.
const COURSE_START: &str = "start";

/// Open the window on a scene
///
/// It draws by the kernel that was chosen last in its panel, at first the accurate one in f32; on the scene `start`, by
/// the course's. While nothing changes, the accurate kernels add samples to every pixel, 16 unless the panel is told
/// otherwise.
#[derive(Debug, Clone, Args)]
pub struct ViewArgs {
    /// A scene file (.toml, .json, .zscene, .nff) or a name of `zerkalo gallery`, such as `start`
    #[arg(default_value = "showcase")]
    pub scene: String,
    #[command(flatten)]
    pub reading: ReadingArgs,
    /// Draw as a file of `zerkalo trade --save-settings` says; the panel offers the kernels, too
    #[arg(long, value_name = "FILE")]
    pub settings: Option<PathBuf>,
    /// How much of the light model is drawn at first; the panel offers the others
    #[arg(long, value_enum, default_value_t, conflicts_with = "settings")]
    pub shading: Shading,
    #[command(flatten)]
    pub device: DeviceArgs,
    #[command(flatten)]
    pub validation: ValidationArgs,
    /// Print one JSON object for every frame that differs from the last, for scripts that drive the window: what is
    /// shown, and where the widgets are
    #[arg(long)]
    pub observe: bool,
    /// Compile the kernels, whichever is shown, anew whenever their sources, this program's own or those in DIR,
    /// change; in debug builds only
    #[arg(long, value_name = "DIR", num_args = 0..=1, default_missing_value = concat!(env!("CARGO_MANIFEST_DIR"), "/glsl"))]
    pub watch: Option<PathBuf>,
    /// Act as if the device was lost after so many frames
    #[arg(long, value_name = "FRAMES", hide = true)]
    pub lose_device_after: Option<u64>,
}

/// Returns when the window is closed. Fails then when validation had anything to say.
pub fn run(args: &ViewArgs) -> Result<()> {
    if args.watch.is_some() && !cfg!(debug_assertions) {
        let reason = "--watch needs a debug build, which has the shader compiler in it: cargo run -- view --watch";
        return Err(TracerError::Refused(reason.to_owned()).into());
    }
    let scene = args.reading.read(&args.scene)?.scene;
    let setting = args.settings.as_deref().map(RenderSettings::load).transpose()?;
    let is_file = !gallery::has(&args.scene);
    let document = Document::new(scene, is_file.then(|| PathBuf::from(&args.scene)));
    let options = Options {
        device: args.device.device.clone(),
        validation: args.validation.validation(),
        is_observed: args.observe,
        watched_sources: args.watch.clone(),
        kernel: (args.scene == COURSE_START && args.shading == Shading::Whitted)
            .then_some(Kernel::Own(OwnKernel::COURSE)),
        setting,
        shading: args.shading,
        lose_device_after: args.lose_device_after,
        config_folder: viewer::config_folder(),
    };
    let mut listener = None;
    let messages = viewer::run(document, options, |stopper| {
        listener = Some(Listener::waking(move || stopper.stop()));
    })?;
    refuse_messages(&messages)?;
    match listener {
        Some(listener) if listener.stop_requested() => Err(TracerError::Stopped.into()),
        _ => Ok(()),
    }
}
