//! Keeps unsaved work while it grows.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::document::Document;
use super::recovery_file;
use crate::scene::Scene;

/// Between two writes while the user is at work.
const PERIOD: Duration = Duration::from_secs(2);

/// What is kept of a document for the next run, in a folder, if there is one.
///
/// No failure here may take from the user what is still in the window: a write that fails is tried again at the next
/// change.
#[derive(Debug)]
pub struct Recovery {
    folder: Option<PathBuf>,
    kept: Option<Scene>,
    last_write: Option<Instant>,
}

impl Recovery {
    pub fn new(folder: Option<PathBuf>) -> Self {
        Self { folder, kept: None, last_write: None }
    }

    /// Keeps unsaved work that is due, and forgets work that was saved or given up since.
    pub fn note(&mut self, document: &Document) {
        if !document.has_unsaved_changes() {
            if self.kept.is_some() {
                self.forget();
            }
        } else if self.due(document).is_some_and(|due| due <= Instant::now()) {
            self.keep(document);
        }
    }

    /// When [`Recovery::note`] has something to keep; `None` while all is kept.
    pub fn due(&self, document: &Document) -> Option<Instant> {
        let is_behind = document.has_unsaved_changes() && self.kept.as_ref() != Some(document.scene());
        let now = Instant::now();
        (is_behind && self.folder.is_some()).then(|| self.last_write.map_or(now, |last| last + PERIOD))
    }

    /// Keeps unsaved work at once.
    pub fn keep(&mut self, document: &Document) {
        let Some(folder) = self.folder.as_deref().filter(|_| document.has_unsaved_changes()) else { return };
        let _ = recovery_file::write(folder, document);
        self.kept = Some(document.scene().clone());
        self.last_write = Some(Instant::now());
    }

    /// Nothing is left for the next run.
    pub fn forget(&mut self) {
        if let Some(folder) = &self.folder {
            let _ = recovery_file::remove(folder);
        }
        self.kept = None;
    }
}
