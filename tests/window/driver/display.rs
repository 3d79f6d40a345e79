//! A display of a test's own.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use zerkalo::frame::Frame;

/// An X server without a screen and without a window manager; it ends with the test.
pub struct Display {
    server: Child,
    name: String,
}

impl Display {
    pub fn open() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1600x1000x24", "-nolisten", "tcp", "-noreset"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is installed, see setup.sh");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let name = format!(":{}", number.trim());
        assert!(name.len() > 1, "Xvfb did not start");
        Self { server, name }
    }

    pub fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("DISPLAY", &self.name).stdin(Stdio::null());
        command
    }

    /// Whether it worked, and what it printed.
    pub fn try_xdotool(&self, arguments: &[&str]) -> (bool, String) {
        let output = self.command("xdotool").args(arguments).output().expect("xdotool is installed, see setup.sh");
        (output.status.success(), String::from_utf8(output.stdout).unwrap())
    }

    #[track_caller]
    pub fn xdotool(&self, arguments: &[&str]) -> String {
        let (works, output) = self.try_xdotool(arguments);
        assert!(works, "xdotool {arguments:?}");
        output
    }

    /// All that is to be seen on the display.
    pub fn screenshot(&self, path: &Path) -> Frame {
        let status = self.command("import").args(["-window", "root"]).arg(path).status();
        assert!(status.expect("ImageMagick is installed, see setup.sh").success());
        Frame::load(path).unwrap()
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
