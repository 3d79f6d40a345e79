//! The kernels that draw, compiled anew whenever their sources change. In debug builds only: release builds have no
//! compiler in them.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, SystemTime};

use rayon::prelude::*;

use crate::gpu::{Shader, compile, kernel_name, shaders, variants};

/// Between two looks at the sources.
const PERIOD: Duration = Duration::from_millis(200);

/// Every build of the kernels that a window draws by, by their files under `glsl/` without the ending.
const DRAWING: [(&str, &[&Shader]); 6] = [
    ("course", &[&shaders::COURSE]),
    ("path", &[&shaders::PATH_F32, &shaders::PATH_F64, &shaders::PATH_F32_PACKETS, &shaders::PATH_F64_PACKETS]),
    ("ssr/depths", &[&shaders::SSR_DEPTHS]),
    ("ssr/light", &[&shaders::SSR_LIGHT, &shaders::SSR_LIGHT_PACKETS]),
    ("ssr/reflect", &[&shaders::SSR_REFLECT]),
    (
        "whitted",
        &[
            &shaders::WHITTED_F32,
            &shaders::WHITTED_F64,
            &shaders::WHITTED_PLAIN,
            &shaders::WHITTED_F32_PACKETS,
            &shaders::WHITTED_F64_PACKETS,
            &shaders::WHITTED_PLAIN_PACKETS,
        ],
    ),
];

/// Outcome of each build of [`DRAWING`]: the shader, or the compiler's messages.
pub type Outcomes = Vec<Result<Shader, String>>;

/// Watches a folder of sources, such as `glsl/`; dropped, it stops.
pub struct ShaderWatch {
    outcomes: Receiver<Outcomes>,
}

impl ShaderWatch {
    /// `wake` is called after each build, from another thread.
    pub fn start(sources: PathBuf, wake: impl Fn() + Send + 'static) -> Self {
        let (sender, outcomes) = mpsc::channel();
        std::thread::spawn(move || {
            let mut seen = state_of(&sources);
            loop {
                std::thread::sleep(PERIOD);
                let now = state_of(&sources);
                let is_changed = std::mem::replace(&mut seen, now) != seen;
                // Nobody listens to a watch that was dropped; it notices at the next change.
                if is_changed && sender.send(build_all(&sources)).is_err() {
                    return;
                }
                if is_changed {
                    wake();
                }
            }
        });
        Self { outcomes }
    }

    /// What the last change came to; `None` since the last call.
    pub fn take(&self) -> Option<Outcomes> {
        self.outcomes.try_iter().last()
    }
}

fn build_all(sources: &Path) -> Outcomes {
    let of_kernel = |(file, own): (&'static str, &'static [&'static Shader])| own.iter().map(move |own| (file, *own));
    let all: Vec<_> = DRAWING.into_iter().flat_map(of_kernel).collect();
    let build = |(file, own)| build(sources, file, own).map_err(|error| error.to_string());
    all.into_par_iter().map(build).collect()
}

/// As build.rs made one of the program's own.
fn build(sources: &Path, file: &str, own: &Shader) -> Result<Shader, Box<dyn Error>> {
    let file = PathBuf::from(format!("{file}.comp"));
    let kernel = kernel_name(&file)?;
    let is_own = |suffix: &str| own.name.strip_prefix(&kernel) == Some(suffix);
    let variant = variants(&kernel).iter().find(|variant| is_own(variant.suffix));
    let variant = *variant.ok_or_else(|| format!("{kernel} has no variant {}", own.name))?;
    let artifact = compile(sources, &file, variant, cfg!(debug_assertions))?;
    Ok(own.rebuilt(artifact.as_binary_u8().to_vec())?)
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

    /// The first complaint, if there is one, and the names of those that are without.
    fn sorted(builds: Outcomes) -> (Option<String>, Vec<&'static str>) {
        let (good, broken): (Vec<_>, Vec<_>) = builds.into_iter().partition(Result::is_ok);
        let names = good.into_iter().flatten().map(|shader| shader.name).collect();
        (broken.into_iter().find_map(Result::err), names)
    }

    #[test]
    fn a_change_of_any_kernel_is_compiled_and_a_mistake_is_told_with_its_file_and_line() {
        let folder = copy_of_sources();
        let (sender, woken) = channel();
        let watch = ShaderWatch::start(folder.path().to_owned(), move || sender.send(()).unwrap());
        // A watch that has not looked yet would take the change for the beginning.
        std::thread::sleep(PERIOD * 3);
        let all: Vec<&str> = DRAWING.iter().flat_map(|(_, own)| *own).map(|own| own.name).collect();
        let of = |is_wanted: fn(&str) -> bool| all.iter().copied().filter(|name| is_wanted(name)).collect::<Vec<_>>();
        for (file, others) in [
            ("course/phong.glsl", of(|name| name != "course")),
            ("path/successors.glsl", of(|name| !name.starts_with("path"))),
            ("ssr/march.glsl", of(|name| name != "ssr_reflect")),
        ] {
            let path = folder.path().join(file);
            let whole = fs::read_to_string(&path).unwrap();
            fs::write(&path, format!("broken\n{whole}")).unwrap();
            woken.recv_timeout(Duration::from_secs(60)).unwrap();
            let (complaint, good) = sorted(watch.take().unwrap());
            assert!(complaint.is_some_and(|complaint| complaint.contains(&format!("{file}:"))), "{file}");
            assert_eq!(good, others, "{file}: the other kernels are as good as they were");

            fs::write(&path, whole).unwrap();
            woken.recv_timeout(Duration::from_secs(60)).unwrap();
            assert_eq!(sorted(watch.take().unwrap()), (None, all.clone()));
            assert!(watch.take().is_none(), "each change once");
        }
    }

    #[test]
    fn a_build_of_the_same_sources_is_what_the_program_has_in_it() {
        // From where build.rs named them, for the paths are in what a debugger gets.
        let builds = build_all(Path::new("glsl"));
        let own: Vec<_> = DRAWING.iter().flat_map(|(_, own)| *own).collect();
        assert_eq!(builds.len(), own.len());
        for (own, build) in own.into_iter().zip(builds) {
            let build = build.unwrap();
            assert_eq!((build.name, build.asks_for_float_controls), (own.name, own.asks_for_float_controls));
            assert!(build.spirv() == own.spirv(), "{}", own.name);
        }
    }
}
