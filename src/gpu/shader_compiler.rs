//! GLSL to SPIR-V, for build.rs and, in debug builds, for `zerkalo view --watch`.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// Left as the front end writes them, without the performance passes: those turn each early return into a one-trip loop
/// before inlining it. Measured on lavapipe, which inlines without that: the course's kernel was 30 % slower, the
/// accurate one 12 %.
pub const AS_WRITTEN: [&str; 6] = ["course", "path", "probe_course_rays", "ssr_light", "ssr_reflect", "whitted"];

/// One build of a kernel's source: what is appended to its name, and macros with their values.
#[derive(Clone, Copy)]
pub struct Variant {
    pub suffix: &'static str,
    pub macros: &'static [(&'static str, &'static str)],
    /// Whether the device is asked to keep to IEEE 754 as far as it can.
    #[allow(dead_code, reason = "build.rs writes it down, where `view --watch` finds it")]
    pub asks_for_float_controls: bool,
}

/// A kernel of the accurate model.
const fn whitted(suffix: &'static str, macros: &'static [(&'static str, &'static str)]) -> Variant {
    Variant { suffix, macros, asks_for_float_controls: true }
}

/// The source without macros.
pub const AS_IT_STANDS: Variant = Variant { suffix: "", macros: &[], asks_for_float_controls: false };

const PRECISIONS: [Variant; 2] = [
    whitted("_f32", &[("REAL_BITS", "32"), ("COMPENSATION", "1"), ("PACKETS", "0")]),
    whitted("_f64", &[("REAL_BITS", "64"), ("COMPENSATION", "1"), ("PACKETS", "0")]),
];

/// The precisions, and what `f32` is worth without compensation.
const WITH_PLAIN: [Variant; 3] =
    [PRECISIONS[0], PRECISIONS[1], whitted("_plain", &[("REAL_BITS", "32"), ("COMPENSATION", "0"), ("PACKETS", "0")])];

/// These once more for devices whose invocations come by eights.
const WITH_PACKETS: [Variant; 6] = [
    WITH_PLAIN[0],
    WITH_PLAIN[1],
    WITH_PLAIN[2],
    whitted("_f32_packets", &[("REAL_BITS", "32"), ("COMPENSATION", "1"), ("PACKETS", "1")]),
    whitted("_f64_packets", &[("REAL_BITS", "64"), ("COMPENSATION", "1"), ("PACKETS", "1")]),
    whitted("_plain_packets", &[("REAL_BITS", "32"), ("COMPENSATION", "0"), ("PACKETS", "1")]),
];

/// The precisions, and each once more for devices whose invocations come by eights.
const PRECISIONS_WITH_PACKETS: [Variant; 4] = [PRECISIONS[0], PRECISIONS[1], WITH_PACKETS[3], WITH_PACKETS[4]];

/// In `f32`, for whichever devices.
const IN_F32: [Variant; 2] = [
    whitted("", &[("REAL_BITS", "32"), ("COMPENSATION", "1"), ("PACKETS", "0")]),
    whitted("_packets", &[("REAL_BITS", "32"), ("COMPENSATION", "1"), ("PACKETS", "1")]),
];

/// In `f32`, each invocation for itself.
const IN_F32_ALONE: [Variant; 1] = [IN_F32[0]];

/// The builds of a kernel, by its [name](kernel_name).
pub fn variants(name: &str) -> &'static [Variant] {
    match name {
        "whitted" => &WITH_PACKETS,
        "path" => &PRECISIONS_WITH_PACKETS,
        "ssr_light" => &IN_F32,
        "ssr_reflect" => &IN_F32_ALONE,
        "probe_rays" => &WITH_PLAIN,
        "probe_exact" | "probe_path_numbers" => &PRECISIONS,
        _ => &[AS_IT_STANDS],
    }
}

/// Compiles a variant of the kernel `folder`/`kernel` for Vulkan 1.2 (SPIR-V 1.5); build.rs says why.
///
/// # Errors
/// The compiler's messages, with the shader's own files and lines; warnings are errors.
pub fn compile(
    folder: &Path,
    kernel: &Path,
    variant: Variant,
    with_debug_info: bool,
) -> Result<shaderc::CompilationArtifact, Box<dyn Error>> {
    let file = folder.join(kernel);
    let source = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;

    let mut options = shaderc::CompileOptions::new()?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_2 as u32);
    options.set_optimization_level(match AS_WRITTEN.contains(&kernel_name(kernel)?.as_str()) {
        true => shaderc::OptimizationLevel::Zero,
        false => shaderc::OptimizationLevel::Performance,
    });
    options.set_warnings_as_errors();
    variant.macros.iter().for_each(|(name, value)| options.add_macro_definition(name, Some(value)));
    if with_debug_info {
        options.set_generate_debug_info();
    }
    options.set_include_callback(|requested, _kind, from, _depth| {
        let path = resolve_include(folder, requested, Path::new(from))?;
        let content = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(shaderc::ResolvedInclude { resolved_name: path.display().to_string(), content })
    });

    let file = file.display().to_string();
    let compiler = shaderc::Compiler::new()?;
    Ok(compiler.compile_into_spirv(&source, shaderc::ShaderKind::Compute, &file, "main", Some(&options))?)
}

/// `probe/layout.comp` is `probe_layout`.
pub fn kernel_name(kernel: &Path) -> Result<String, Box<dyn Error>> {
    Ok(kernel.with_extension("").to_str().ok_or("a shader's path is not UTF-8")?.replace(['/', '\\'], "_"))
}

/// Beside the including file first, then in `folder`.
fn resolve_include(folder: &Path, requested: &str, from: &Path) -> Result<PathBuf, String> {
    let beside = from.parent().unwrap_or(Path::new("")).join(requested);
    [beside, folder.join(requested)]
        .into_iter()
        .find(|path| path.is_file())
        .ok_or_else(|| format!("{requested} is neither beside {} nor in {}", from.display(), folder.display()))
}
