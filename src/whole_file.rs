//! Files that are written whole or not at all.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tempfile::NamedTempFile;

/// The temporary files that stand beside their targets now.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn with_unfinished(work: impl FnOnce(&mut Vec<PathBuf>)) {
    work(&mut UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner));
}

/// Removes them all: for a program that ends without dropping what it has.
pub fn remove_unfinished() {
    with_unfinished(|paths| {
        for path in paths.drain(..) {
            // Nothing is left to be done about one that cannot be removed.
            let _ = fs::remove_file(path);
        }
    });
}

/// A temporary file beside its target, which it replaces at the end. Dropped before that, it removes itself and the
/// target stays as it was.
pub struct WholeFile {
    /// Always there until [`WholeFile::finish`] takes it.
    temporary: Option<NamedTempFile>,
    temporary_path: PathBuf,
    /// Symbolic links are followed: replacing a link by a file would surprise its owner.
    target: PathBuf,
}

impl WholeFile {
    /// Starts a file for `path`, with the permissions that a plain write to it would leave.
    ///
    /// # Errors
    /// The target is not a file or is write-protected, or its folder cannot be written to.
    pub fn create(path: &Path) -> io::Result<Self> {
        let target = fs::canonicalize(path).or_else(|_| fs::read_link(path)).unwrap_or_else(|_| path.to_owned());
        let old = fs::metadata(&target).ok();
        if old.as_ref().is_some_and(|old| !old.is_file()) {
            return Err(io::Error::other("it exists and is not a file"));
        }
        if old.as_ref().is_some_and(|old| old.permissions().readonly()) {
            return Err(io::Error::other("it is write-protected"));
        }
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if !folder.is_dir() {
            return Err(io::Error::other(format!("{} is not a folder", folder.display())));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".zerkalo-").suffix(".tmp");
        // A temporary file is for its owner alone by default; the umask still applies to this.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temporary = builder.tempfile_in(folder)?;
        if let Some(old) = old {
            temporary.as_file().set_permissions(old.permissions())?;
        }
        let temporary_path = temporary.path().to_owned();
        with_unfinished(|paths| paths.push(temporary_path.clone()));
        Ok(Self { temporary: Some(temporary), temporary_path, target })
    }

    pub fn as_file_mut(&mut self) -> &mut File {
        // invariant: only `finish`, which consumes the file, takes it.
        self.temporary.as_mut().expect("the file is not finished").as_file_mut()
    }

    /// For another program to write to.
    pub fn temporary_path(&self) -> &Path {
        &self.temporary_path
    }

    /// Puts what was written in the target's place.
    pub fn finish(mut self) -> io::Result<()> {
        // Some file systems report a full disk only now; and the name must not reach the disk before the data.
        self.as_file_mut().sync_all()?;
        if let Some(temporary) = self.temporary.take() {
            temporary.persist(&self.target)?;
        }
        Ok(())
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        with_unfinished(|paths| paths.retain(|path| *path != self.temporary_path));
    }
}
