//! A window that was opened: what it tells, how it ends.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use zerkalo::viewer::preferences::Language;
use zerkalo::viewer::text::Words;

use super::desk::Desk;
use super::observation::Observation;

/// For whatever the window is to do: a software device on a busy machine takes its time, and a test that waits in vain
/// fails anyway.
const PATIENCE: Duration = Duration::from_secs(60);

/// A window at rest tells nothing for so long.
const REST: Duration = Duration::from_millis(250);

/// The program with its window open. It is killed if the test comes to no good end.
pub struct Window<'a> {
    pub(super) desk: &'a Desk,
    program: Child,
    pub(super) id: String,
    observations: Receiver<Observation>,
    last: Option<Observation>,
    complaints: PathBuf,
}

impl<'a> Window<'a> {
    #[track_caller]
    pub(super) fn open(desk: &'a Desk, mut command: Command, complaints: PathBuf) -> Self {
        let mut program = command.spawn().unwrap();
        let (sender, observations) = channel();
        let output = BufReader::new(program.stdout.take().unwrap());
        thread::spawn(move || {
            for line in output.lines().map_while(Result::ok) {
                let observation = serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error}: {line}"));
                if sender.send(observation).is_err() {
                    return;
                }
            }
        });
        let mut window = Self { desk, program, id: String::new(), observations, last: None, complaints };
        window.wait_until("the first frame", |_| true);
        window.id = desk.display.xdotool(&["search", "--name", "zerkalo"]).lines().next().unwrap().to_owned();
        // There is no window manager to do it.
        desk.display.xdotool(&["windowfocus", "--sync", &window.id]);
        window
    }

    pub fn id(&self) -> &str {
        &self.id
    }

    pub fn pid(&self) -> u32 {
        self.program.id()
    }

    /// The last frame.
    #[track_caller]
    pub fn now(&mut self) -> &Observation {
        while let Ok(observation) = self.observations.try_recv() {
            self.last = Some(observation);
        }
        self.last.as_ref().expect("a frame")
    }

    /// The last frame that the test has looked at.
    #[track_caller]
    pub fn last(&self) -> &Observation {
        self.last.as_ref().expect("a frame")
    }

    /// The first frame from now on, or the last until now, of which something holds.
    #[track_caller]
    pub fn wait_until(&mut self, what: &str, holds: impl Fn(&Observation) -> bool) -> Observation {
        match self.wait_for(PATIENCE, holds) {
            Some(observation) => observation,
            None => panic!("in vain: {what}; last: {}; said: {:?}", self.last_in_short(), self.complaints()),
        }
    }

    /// As [`Window::wait_until`], or nothing if it does not come to hold for so long.
    pub(super) fn wait_for(&mut self, patience: Duration, holds: impl Fn(&Observation) -> bool) -> Option<Observation> {
        let deadline = Instant::now() + patience;
        while let Ok(observation) = self.observations.try_recv() {
            self.last = Some(observation);
        }
        loop {
            if let Some(last) = self.last.as_ref().filter(|last| holds(last)) {
                return Some(last.clone());
            }
            let left = deadline.saturating_duration_since(Instant::now());
            self.last = Some(self.observations.recv_timeout(left).ok()?);
        }
    }

    /// Waits until all of the picture is shown and nothing changes any more.
    #[track_caller]
    pub fn settle(&mut self) -> Observation {
        loop {
            self.wait_until("a whole picture", |now| now.is_finished);
            match self.observations.recv_timeout(REST) {
                Ok(observation) => self.last = Some(observation),
                Err(_) => return self.now().clone(),
            }
        }
    }

    /// Of the language that the window speaks now.
    #[track_caller]
    pub fn words(&mut self) -> &'static Words {
        let now = self.now();
        let speaks = |language: &Language| now.find(language.words().menu.file).is_some();
        [Language::Russian, Language::English].into_iter().find(speaks).expect("a menu bar").words()
    }

    fn last_in_short(&self) -> String {
        self.last.as_ref().map_or_else(|| "nothing".to_owned(), Observation::in_short)
    }

    fn complaints(&self) -> String {
        fs::read_to_string(&self.complaints).unwrap()
    }

    // ---- The process.

    /// Of all its threads, user and system.
    pub fn cpu_time(&self) -> Duration {
        const TICKS_PER_SECOND: u64 = 100;
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.pid())).unwrap();
        // After the name in parentheses, the 14th and 15th field of all, by proc(5).
        let ticks: u64 = stat.rsplit_once(')').unwrap().1.split_whitespace().skip(11).take(2).map(ticks).sum();
        Duration::from_millis(ticks * 1000 / TICKS_PER_SECOND)
    }

    /// Memory in use, KiB.
    pub fn resident_kib(&self) -> u64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.pid())).unwrap();
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
        ticks(line.trim().trim_end_matches(" kB"))
    }

    // ---- Its end.

    /// Asks the program to end by its own menu, without saving, and sees that it had no complaint.
    #[track_caller]
    pub fn close(mut self) {
        let words = self.words();
        let is_unsaved = self.now().has_unsaved_changes;
        self.menu(&[words.menu.file, words.menu.quit]);
        if is_unsaved {
            self.click(words.dialogs.discard);
        }
        let (code, complaints) = self.ended();
        assert_eq!((code, complaints.as_str()), (Some(0), ""));
    }

    /// Ctrl-C in the terminal that the program was started from.
    #[track_caller]
    pub fn interrupt(self) {
        let killed = Command::new("kill").args(["-INT", &self.pid().to_string()]).status().unwrap();
        assert!(killed.success());
        assert_eq!(self.ended(), (Some(130), "zerkalo: stopped\n".to_owned()));
    }

    /// As a fault of the program or of the machine ends it.
    pub fn kill(mut self) {
        self.program.kill().unwrap();
        self.ended();
    }

    /// Waits for the end; the exit code and what was said on the way.
    #[track_caller]
    pub fn ended(mut self) -> (Option<i32>, String) {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.program.try_wait().unwrap() {
                return (status.code(), self.complaints());
            }
            assert!(Instant::now() < deadline, "the program does not end; last: {}", self.last_in_short());
            thread::sleep(Duration::from_millis(10));
        }
    }
}

fn ticks(text: &str) -> u64 {
    text.parse().unwrap()
}

impl Drop for Window<'_> {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}
