//! The program run as a user runs it, in a folder of its own.
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use tempfile::TempDir;

/// A folder to run the program in.
pub struct Place {
    folder: TempDir,
}

impl Place {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_zerkalo"));
        command.args(arguments).current_dir(&self.folder).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Run {
        Run::of(self.command(arguments).output().unwrap())
    }

    /// All names in the folder, hidden ones too.
    /// What the program prints where it has nothing to complain of.
    #[track_caller]
    pub fn run_well(&self, arguments: &[&str]) -> String {
        let run = self.run(arguments);
        assert_eq!((run.code, run.complaints()), (Some(0), vec![]), "{arguments:?}: {run:?}");
        run.stdout
    }

    /// The one object that `--json`, which need not be among the arguments, prints in one line.
    #[track_caller]
    pub fn json(&self, arguments: &[&str]) -> Value {
        let json: &[&str] = if arguments.contains(&"--json") { &[] } else { &["--json"] };
        let stdout = self.run_well(&[arguments, json].concat());
        assert_eq!(stdout.lines().count(), 1, "one object on one line");
        serde_json::from_str(&stdout).unwrap()
    }

    /// Runs what must fail with `code`, a complaint that holds all `parts`, and no trace in the folder.
    #[track_caller]
    pub fn assert_refused(&self, arguments: &[&str], code: i32, parts: &[&str]) {
        let before = self.names();
        let run = self.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (Some(code), ""), "{arguments:?}: {run:?}");
        assert!(parts.iter().all(|part| run.stderr.contains(part)), "{parts:?} are not in: {}", run.stderr);
        assert!(run.stderr.starts_with("error: ") || run.stderr.lines().count() == 1, "{}", run.stderr);
        assert_eq!(self.names(), before, "{arguments:?} left something");
    }

    pub fn names(&self) -> BTreeSet<String> {
        names_in(self.folder.path())
    }
}

pub fn names_in(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

/// Looks every 10 ms, a minute at most.
#[track_caller]
pub fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(60), "never: {what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Ctrl-C for a program that runs, up to its end.
#[cfg(unix)]
#[track_caller]
pub fn interrupted(mut program: Child) -> Run {
    let kill = Command::new("kill").args(["-INT", &program.id().to_string()]).status().unwrap();
    assert!(kill.success());
    wait_until("the program stops", || program.try_wait().unwrap().is_some());
    Run::of(program.wait_with_output().unwrap())
}

#[derive(Debug)]
pub struct Run {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Run {
    pub fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }

    /// What it says on standard error, but for how far it is: where a machine has other work, a run may take above half
    /// a minute.
    pub fn complaints(&self) -> Vec<&str> {
        self.stderr.lines().filter(|line| !line.starts_with("progress: ")).collect()
    }
}
