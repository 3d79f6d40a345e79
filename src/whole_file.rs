//! Files that are written whole or not at all.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// A temporary file beside its target, which it replaces at the end. Dropped before that, it removes itself and the
/// target stays as it was.
pub struct WholeFile {
    temporary: NamedTempFile,
    /// Symbolic links are followed: replacing a link by a file would surprise its owner.
    target: PathBuf,
}

impl WholeFile {
    /// Starts a file for `path`, with the permissions that a plain write to it would leave.
    ///
    /// # Errors
    /// The target is not a file or is write-protected, or its folder cannot be written to.
    pub fn create(path: &Path) -> io::Result<Self> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
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
        // A temporary file is for its owner alone unless told otherwise; the umask still applies to this.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temporary = builder.tempfile_in(folder)?;
        if let Some(old) = old {
            temporary.as_file().set_permissions(old.permissions())?;
        }
        Ok(Self { temporary, target })
    }

    pub fn as_file_mut(&mut self) -> &mut File {
        self.temporary.as_file_mut()
    }

    /// Puts what was written in the target's place.
    pub fn finish(self) -> io::Result<()> {
        // Some file systems report a full disk only now; and the name must not reach the disk before the data.
        self.temporary.as_file().sync_all()?;
        self.temporary.persist(self.target)?;
        Ok(())
    }
}
