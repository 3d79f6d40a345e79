//! Where windows are opened.

use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

use tempfile::TempDir;
use zerkalo::frame::Frame;
use zerkalo::scene::Scene;

use super::display::Display;
use super::window::Window;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Locale {
    Russian,
    English,
}

/// A display with a folder that the program is run in; what it remembers is kept in `config`.
pub struct Desk {
    pub display: Display,
    folder: TempDir,
    locale: Locale,
    _turn: Turn,
}

/// Tests that take times have the machine to themselves.
static MACHINE: RwLock<()> = RwLock::new(());

enum Turn {
    Shared { _guard: RwLockReadGuard<'static, ()> },
    Alone { _guard: RwLockWriteGuard<'static, ()> },
}

impl Desk {
    /// Windows are first opened in a size of so many pixels.
    pub fn new(locale: Locale, size: [u32; 2]) -> Self {
        let guard = MACHINE.read().unwrap_or_else(PoisonError::into_inner);
        Self::with(locale, size, Turn::Shared { _guard: guard })
    }

    /// While no other test runs.
    pub fn alone(locale: Locale, size: [u32; 2]) -> Self {
        let guard = MACHINE.write().unwrap_or_else(PoisonError::into_inner);
        Self::with(locale, size, Turn::Alone { _guard: guard })
    }

    fn with(locale: Locale, size: [u32; 2], turn: Turn) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let config = folder.path().join("config/zerkalo");
        fs::create_dir_all(&config).unwrap();
        fs::write(config.join("preferences.toml"), format!("window_size = {size:?}\n")).unwrap();
        Self { display: Display::open(), folder, locale, _turn: turn }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn scene(&self, name: &str) -> Scene {
        Scene::load(&self.path(name)).unwrap()
    }

    /// The window on a scene, once all of it is drawn; `arguments` follow `view`.
    #[track_caller]
    pub fn view(&self, arguments: &[&str]) -> Window<'_> {
        let mut window = self.start(arguments);
        window.settle();
        window
    }

    /// The window on a scene, once it is there.
    #[track_caller]
    pub fn start(&self, arguments: &[&str]) -> Window<'_> {
        self.open(self.program(&viewing(arguments)))
    }

    #[track_caller]
    fn open(&self, mut command: Command) -> Window<'_> {
        let complaints = self.path("stderr.txt");
        command.stdout(Stdio::piped()).stderr(File::create(&complaints).unwrap());
        Window::open(self, command, complaints)
    }

    /// The program, ready to be run here.
    pub fn program(&self, arguments: &[&str]) -> Command {
        self.command(env!("CARGO_BIN_EXE_zerkalo"), arguments)
    }

    fn command(&self, program: &str, arguments: &[&str]) -> Command {
        let mut command = self.display.command(program);
        let locale = match self.locale {
            Locale::Russian => "ru_RU.UTF-8",
            Locale::English => "en_US.UTF-8",
        };
        for variable in ["LC_ALL", "LC_MESSAGES", "LANGUAGE", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(variable);
        }
        command.args(arguments).current_dir(&self.folder);
        command.env("LANG", locale).env("XDG_CONFIG_HOME", self.path("config"));
        command
    }

    /// What `zerkalo render` makes of a scene, a file in the folder or a name of the gallery, as a window at rest does
    /// until it is told otherwise: by the accurate kernel, with 16 samples a pixel.
    #[track_caller]
    pub fn render(&self, scene: &str, size: [u32; 2]) -> Frame {
        self.render_with(&["--algorithm", "whitted", "--precision", "f32", "--samples", "16"], scene, size)
    }

    pub fn render_by(&self, kernel: &str, scene: &str, size: [u32; 2]) -> Frame {
        self.render_with(&["--algorithm", kernel], scene, size)
    }

    pub fn render_with(&self, arguments: &[&str], scene: &str, [width, height]: [u32; 2]) -> Frame {
        let size = format!("{width}x{height}");
        let usual = ["render", scene, "-o", "rendered.exr", "--size", &size];
        let Output { status, stderr, .. } = self.program(&[&usual, arguments].concat()).output().unwrap();
        assert!(status.success(), "{}", String::from_utf8_lossy(&stderr));
        Frame::load(&self.path("rendered.exr")).unwrap()
    }
}

fn viewing<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [&["view"], arguments, &["--observe", "--validate"]].concat()
}
