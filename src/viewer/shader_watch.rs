//! The course's kernel, compiled anew whenever its sources change. In debug builds only: release builds have no
//! compiler in them.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, SystemTime};

use crate::gpu::{AS_IT_STANDS, Shader, compile, shaders};

/// Between two looks at the sources.
const PERIOD: Duration = Duration::from_millis(200);

/// Watches a folder of sources, such as `glsl/`; dropped, it stops.
pub struct ShaderWatch {
    builds: Receiver<Result<Shader, String>>,
}

impl ShaderWatch {
    /// `wake` is called after each build, from another thread.
    pub fn start(sources: PathBuf, wake: impl Fn() + Send + 'static) -> Self {
        let (sender, builds) = mpsc::channel();
        std::thread::spawn(move || {
            let mut seen = state_of(&sources);
            loop {
                std::thread::sleep(PERIOD);
                let now = state_of(&sources);
                let is_changed = std::mem::replace(&mut seen, now) != seen;
                // Nobody listens to a watch that was dropped; it notices at the next change.
                if is_changed && sender.send(build(&sources)).is_err() {
                    return;
                }
                if is_changed {
                    wake();
                }
            }
        });
        Self { builds }
    }

    /// What the last change came to: a kernel, or the compiler's messages; `None` since the last call.
    pub fn take(&self) -> Option<Result<Shader, String>> {
        self.builds.try_iter().last()
    }
}

fn build(sources: &Path) -> Result<Shader, String> {
    let artifact = compile(sources, Path::new("course.comp"), AS_IT_STANDS, true).map_err(|error| error.to_string())?;
    Ok(Shader { spirv: Cow::Owned(artifact.as_binary_u8().to_vec()), ..shaders::COURSE })
}

/// Every file with its time; editors that write beside and rename change it as well as those that write in place.
fn state_of(folder: &Path) -> Vec<(PathBuf, Option<SystemTime>)> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut state: Vec<_> = entries
        .flatten()
        .flat_map(|entry| match entry.path() {
            path if path.is_dir() => state_of(&path),
            path => vec![(path, entry.metadata().and_then(|metadata| metadata.modified()).ok())],
        })
        .collect();
    state.sort();
    state
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    /// The repository's `glsl/` in a folder of its own.
    fn copy_of_sources() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl");
        for (file, _) in state_of(&from) {
            let to = folder.path().join(file.strip_prefix(&from).unwrap());
            fs::create_dir_all(to.parent().unwrap()).unwrap();
            fs::copy(file, to).unwrap();
        }
        folder
    }

    #[test]
    fn a_change_is_compiled_and_a_mistake_is_told_with_its_file_and_line() {
        let folder = copy_of_sources();
        let (sender, woken) = channel();
        let watch = ShaderWatch::start(folder.path().to_owned(), move || sender.send(()).unwrap());
        let phong = folder.path().join("course/phong.glsl");
        let whole = fs::read_to_string(&phong).unwrap();
        // A watch that has not looked yet would take the change for the beginning.
        std::thread::sleep(PERIOD * 3);

        fs::write(&phong, format!("broken\n{whole}")).unwrap();
        woken.recv_timeout(Duration::from_secs(60)).unwrap();
        let messages = watch.take().unwrap().err().unwrap();
        assert!(messages.contains("phong.glsl:"), "{messages}");

        fs::write(&phong, whole).unwrap();
        woken.recv_timeout(Duration::from_secs(60)).unwrap();
        let shader = watch.take().unwrap().unwrap();
        assert_eq!(shader.name, "course");
        assert!(watch.take().is_none(), "each build once");
    }
}
