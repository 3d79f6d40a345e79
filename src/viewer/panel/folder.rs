//! What a folder offers to a dialog that looks for files of some kinds.

use std::ffi::OsStr;
use std::io;
use std::path::Path;

/// Sub-folders and files, each in the order of the alphabet.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Listing {
    pub folders: Vec<String>,
    pub files: Vec<String>,
}

impl Listing {
    /// Without hidden ones, and without those whose names could not be typed.
    pub fn read(folder: &Path, extensions: &[&str]) -> io::Result<Self> {
        let mut listing = Self::default();
        for entry in folder.read_dir()? {
            let path = entry?.path();
            let Some(name) = path.file_name().and_then(OsStr::to_str).filter(|name| !name.starts_with('.')) else {
                continue;
            };
            if path.is_dir() {
                listing.folders.push(name.to_owned());
            } else if has_extension(&path, extensions) {
                listing.files.push(name.to_owned());
            }
        }
        for names in [&mut listing.folders, &mut listing.files] {
            names.sort_by_cached_key(|name| (name.to_lowercase(), name.clone()));
        }
        Ok(listing)
    }
}

pub fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let extension = path.extension().and_then(OsStr::to_str).unwrap_or_default();
    extensions.iter().any(|allowed| allowed.eq_ignore_ascii_case(extension))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_and_files_of_the_kinds_asked_are_listed_and_hidden_ones_are_not() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.TOML", "a.json", "c.png", ".hidden.toml", "noextension"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        for name in ["Zoo", "ant", ".git"] {
            std::fs::create_dir(folder.path().join(name)).unwrap();
        }
        let listing = Listing::read(folder.path(), &["toml", "json"]).unwrap();
        assert_eq!(
            listing,
            Listing { folders: vec!["ant".into(), "Zoo".into()], files: vec!["a.json".into(), "b.TOML".into()] }
        );
        assert!(Listing::read(&folder.path().join("missing"), &[]).is_err());
    }
}
