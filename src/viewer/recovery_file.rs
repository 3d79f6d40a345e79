//! Unsaved work, kept beside the preferences while there is some: what a run that did not end well leaves to the next.
//!
//! It is a scene file, which any command opens, with the path of the document's own file in a comment on top.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::document::Document;
use crate::scene::Scene;
use crate::whole_file::WholeFile;

/// In front of the document's own path as a JSON string, or of `null`.
const PATH_MARK: &str = "# unsaved changes to ";

/// Keeps the document as it is now in place of what was kept, whole or not at all.
///
/// A path that is not Unicode is not kept: it is asked for at the next save. A scene beyond the size of a TOML scene
/// file, 16 MiB, will not be read again.
pub fn write(file: &Path, document: &Document) -> io::Result<()> {
    let path = document.path().and_then(Path::to_str);
    let text = format!("{PATH_MARK}{}\n{}", serde_json::to_string(&path)?, document.scene().to_toml());
    let mut file = WholeFile::create(file)?;
    file.as_file_mut().write_all(text.as_bytes())?;
    file.finish()
}

/// The document that was kept, unsaved; none if there is none or it cannot be read.
pub fn read(file: &Path) -> Option<Document> {
    let text = fs::read_to_string(file).ok()?;
    let (mark, scene) = text.split_once('\n')?;
    let path: Option<String> = mark.strip_prefix(PATH_MARK).and_then(|path| serde_json::from_str(path).ok()?);
    // A relative one would mean another file in another working directory.
    let path = path.map(PathBuf::from).filter(|path| path.is_absolute());
    Some(Document::recovered(Scene::from_toml(scene).ok()?, path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::gallery;

    fn showcase() -> Scene {
        gallery::scene("showcase").unwrap()
    }

    /// A file's path in a folder that goes with the test.
    fn place() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("recovery.toml");
        (folder, file)
    }

    #[test]
    fn what_was_kept_comes_back_unsaved_with_its_path() {
        let (_folder, file) = place();
        for path in [None, Some(PathBuf::from("/home/я/a \"b\"\n\u{7f}\\c.toml"))] {
            write(&file, &Document::new(showcase(), path.clone())).unwrap();
            let document = read(&file).unwrap();
            assert_eq!((document.scene(), document.path()), (&showcase(), path.as_deref()));
            assert!(document.has_unsaved_changes());
        }
    }

    #[test]
    fn it_is_a_scene_file() {
        let (_folder, file) = place();
        write(&file, &Document::new(showcase(), Some(PathBuf::from("/a.toml")))).unwrap();
        assert_eq!(Scene::load(&file).unwrap(), showcase());
    }

    #[test]
    fn a_damaged_file_is_ignored() {
        let (_folder, file) = place();
        write(&file, &Document::new(showcase(), None)).unwrap();
        let whole = fs::read(&file).unwrap();
        for length in (0..whole.len()).step_by(7) {
            fs::write(&file, &whole[..length]).unwrap();
            assert!(read(&file).is_none_or(|document| document.scene().validate().is_ok()), "{length} bytes");
        }
        for damaged in [&b""[..], b"\n[[[", b"\xff\xff\n", b"# unsaved changes to null\nmax_depth = 0"] {
            fs::write(&file, damaged).unwrap();
            assert!(read(&file).is_none(), "{damaged:?}");
        }
    }

    #[test]
    fn a_damaged_or_relative_path_does_not_lose_the_scene() {
        let (_folder, file) = place();
        let relative = "# unsaved changes to \"scene.toml\"";
        for mark in ["", "# unsaved changes to \"/home", "# anything", relative] {
            fs::write(&file, format!("{mark}\n{}", showcase().to_toml())).unwrap();
            let document = read(&file).unwrap();
            assert_eq!((document.scene(), document.path()), (&showcase(), None));
        }
    }
}
