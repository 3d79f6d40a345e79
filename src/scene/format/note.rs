//! What is to be told of a file that was read.

use std::fmt;

/// One line of what a file and its scene differ in, or of what the file leaves open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// Where it is so for the first time, from 1; `None` where it is of the whole file.
    pub line: Option<usize>,
    /// What, and how often if more than once.
    pub what: String,
    /// Whether it is a loss.
    pub kind: NoteKind,
}

/// Whether the scene is still what the file says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoteKind {
    /// The file does not say it, and something had to be taken.
    Assumed,
    /// The file says something else.
    Lost,
}

impl fmt::Display for Note {
    /// `line 7: WHAT`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.what),
            None => f.write_str(&self.what),
        }
    }
}

/// Notes as they come up; each kind of them is told once.
#[derive(Default)]
pub(super) struct Tally {
    entries: Vec<Entry>,
}

struct Entry {
    kind: NoteKind,
    what: &'static str,
    line: Option<usize>,
    times: usize,
}

impl Tally {
    pub(super) fn assumed(&mut self, what: &'static str, line: impl Into<Option<usize>>) {
        self.add(NoteKind::Assumed, what, line.into());
    }

    pub(super) fn lost(&mut self, what: &'static str, line: usize) {
        self.add(NoteKind::Lost, what, Some(line));
    }

    fn add(&mut self, kind: NoteKind, what: &'static str, line: Option<usize>) {
        match self.entries.iter_mut().find(|entry| entry.what == what) {
            Some(entry) => entry.times += 1,
            None => self.entries.push(Entry { kind, what, line, times: 1 }),
        }
    }

    /// In the order in which they came up.
    pub(super) fn notes(self) -> Vec<Note> {
        let note = |Entry { kind, what, line, times }| {
            let what = if times == 1 { what.to_owned() } else { format!("{what} ({times} times, here first)") };
            Note { line, what, kind }
        };
        self.entries.into_iter().map(note).collect()
    }
}
