//! Keeps unsaved work while it grows, and finds what earlier windows left.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use super::document::Document;
use super::recovery_file;
use crate::scene::Scene;

/// Between two writes while the user is at work.
const PERIOD: Duration = Duration::from_secs(2);

/// What is kept of a window's document for the next run.
///
/// Every window has a file of its own, and holds a lock beside it while it lives: files whose lock nobody holds were
/// left by windows that did not come to a good end. No failure here may take from the user what is still in the
/// window: a write that fails is tried again at the next change.
#[derive(Debug, Default)]
pub struct Recovery {
    place: Option<Place>,
    kept: Option<Scene>,
    last_write: Option<Instant>,
    /// Left by another window, and offered to the user.
    offered: Option<PathBuf>,
}

#[derive(Debug)]
struct Place {
    file: PathBuf,
    lock: PathBuf,
    /// Locked as long as it is open.
    _held: File,
}

impl Recovery {
    /// In a folder, if there is one that can be written to; with the latest work that was left there.
    pub fn new(folder: Option<&Path>) -> (Self, Option<Document>) {
        let Some(folder) = folder else { return Default::default() };
        let left = left_in(folder);
        let place = Place::new(folder, std::process::id());
        let document = left.as_deref().and_then(recovery_file::read);
        let offered = left.filter(|_| document.is_some());
        (Self { place, offered, ..Self::default() }, document)
    }

    /// Keeps unsaved work that is due, and forgets work that was saved or given up since. Not to be called while the
    /// user is asked about what was offered: here it counts as decided about.
    pub fn note(&mut self, document: &Document) {
        let is_due = self.due(document).is_some_and(|due| due <= Instant::now());
        if is_due || self.offered.is_some() {
            self.keep(document);
        }
        if let Some(offered) = self.offered.take() {
            // It is in this window's own file now, or not wanted. One that cannot be removed is offered again.
            let _ = fs::remove_file(&offered);
            let _ = fs::remove_file(offered.with_extension("lock"));
        }
        if !document.has_unsaved_changes() && self.kept.is_some() {
            self.forget();
        }
    }

    /// When [`Recovery::note`] has something to keep; `None` while all is kept.
    pub fn due(&self, document: &Document) -> Option<Instant> {
        let is_behind = document.has_unsaved_changes() && self.kept.as_ref() != Some(document.scene());
        let now = Instant::now();
        (is_behind && self.place.is_some()).then(|| self.last_write.map_or(now, |last| last + PERIOD))
    }

    /// Keeps unsaved work at once.
    pub fn keep(&mut self, document: &Document) {
        let Some(place) = self.place.as_ref().filter(|_| document.has_unsaved_changes()) else { return };
        let _ = recovery_file::write(&place.file, document);
        self.kept = Some(document.scene().clone());
        self.last_write = Some(Instant::now());
    }

    /// Nothing of this window's is left for the next run.
    pub fn forget(&mut self) {
        if let Some(place) = &self.place {
            // There may be none.
            let _ = fs::remove_file(&place.file);
        }
        self.kept = None;
    }
}

impl Place {
    fn new(folder: &Path, window: u32) -> Option<Self> {
        fs::create_dir_all(folder).ok()?;
        let file = folder.join(format!("recovery-{window}.toml"));
        let lock = file.with_extension("lock");
        let held = File::create(&lock).ok()?;
        held.try_lock().ok()?;
        Some(Self { file, lock, _held: held })
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // Left behind, it would be an open lock, which means the same.
        let _ = fs::remove_file(&self.lock);
    }
}

/// The latest file whose window is gone.
fn left_in(folder: &Path) -> Option<PathBuf> {
    let is_recovery = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("recovery-") && name.ends_with(".toml")
    };
    let is_left = |path: &PathBuf| {
        let lock = File::open(path.with_extension("lock"));
        lock.is_err() || lock.is_ok_and(|lock| lock.try_lock().is_ok())
    };
    let time = |path: &PathBuf| fs::metadata(path).and_then(|file| file.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    let files = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    files.filter(is_recovery).filter(is_left).max_by_key(time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{SolidKind, gallery};
    use crate::viewer::action::Action;
    use crate::viewer::preferences::Preferences;
    use crate::viewer::state::State;

    fn edited() -> State {
        let mut state = State::new(Document::new(Scene::default(), None), Preferences::default(), None);
        state.apply(Action::Add(SolidKind::Cone));
        state
    }

    /// A window that is gone without a good end, with what it kept.
    fn crashed_window(folder: &Path, window: u32, scene: Scene) {
        recovery_file::write(&folder.join(format!("recovery-{window}.toml")), &Document::new(scene, None)).unwrap();
        File::create(folder.join(format!("recovery-{window}.lock"))).unwrap();
    }

    #[test]
    fn what_a_crashed_window_left_is_offered_once_it_is_decided_about() {
        let folder = tempfile::tempdir().unwrap();
        crashed_window(folder.path(), 1, gallery::scene("four").unwrap());
        let (mut recovery, left) = Recovery::new(Some(folder.path()));
        assert_eq!(left.unwrap().scene(), &gallery::scene("four").unwrap());
        recovery.note(&Document::new(Scene::default(), None));
        drop(recovery);
        assert!(Recovery::new(Some(folder.path())).1.is_none());
    }

    #[test]
    fn work_taken_up_is_kept_before_what_was_left_goes() {
        let folder = tempfile::tempdir().unwrap();
        crashed_window(folder.path(), 1, gallery::scene("four").unwrap());
        let (mut recovery, left) = Recovery::new(Some(folder.path()));
        recovery.note(&left.unwrap());
        // As by a crash: the lock goes with the process, the file stays.
        drop(recovery);
        let (_, left) = Recovery::new(Some(folder.path()));
        assert_eq!(left.unwrap().scene(), &gallery::scene("four").unwrap());
    }

    #[test]
    fn a_window_that_lives_is_not_offered_nor_robbed() {
        let folder = tempfile::tempdir().unwrap();
        let state = edited();
        let (mut first, _) = Recovery::new(Some(folder.path()));
        first.note(&state.document);
        let second = Place::new(folder.path(), 1).unwrap();
        assert_eq!(left_in(folder.path()), None);
        drop(second);
        assert!(first.place.as_ref().unwrap().file.exists());
        drop(first);
        assert!(left_in(folder.path()).is_some());
    }

    #[test]
    fn saved_work_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut state = edited();
        let (mut recovery, _) = Recovery::new(Some(folder.path()));
        recovery.note(&state.document);
        assert!(recovery.place.as_ref().unwrap().file.exists());
        state.apply(Action::Undo);
        recovery.note(&state.document);
        drop(recovery);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_folder_that_cannot_be_written_to_is_no_hindrance() {
        let folder = tempfile::tempdir().unwrap();
        let not_a_folder = folder.path().join("file");
        fs::write(&not_a_folder, "").unwrap();
        let (mut recovery, left) = Recovery::new(Some(&not_a_folder));
        assert!(left.is_none());
        let state = edited();
        recovery.note(&state.document);
        recovery.keep(&state.document);
        assert_eq!(recovery.due(&state.document), None);
    }
}
