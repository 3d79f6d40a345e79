//! Compiles every `glsl/**/*.comp` to SPIR-V and writes `$OUT_DIR/shaders.rs`, which embeds them.
//!
//! Target: Vulkan 1.2 (SPIR-V 1.5). The kernels need nothing of 1.3, and 1.2 is what the drivers of laptops since
//! about 2015 offer, those stopped before 1.3 among them; 1.3's SPIR-V would besides ask for `maintenance4`, because
//! a workgroup size that is a specialization constant becomes `LocalSizeId` there.

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

const SHADER_DIR: &str = "glsl";

/// Left as the front end writes them, without the performance passes: those turn each early return of the course's
/// listings into a one-trip loop before inlining it. Measured on lavapipe, which inlines without that: 30 % slower.
const AS_WRITTEN: [&str; 1] = ["course"];

fn main() {
    if let Err(error) = compile_all() {
        // shaderc's text names the shader's own file and line; cargo shows each such line as an error.
        for line in error.to_string().lines() {
            println!("cargo::error={line}");
        }
    }
}

fn compile_all() -> Result<(), Box<dyn Error>> {
    let out_dir = PathBuf::from(std::env::var("OUT_DIR")?);
    // cargo watches the folder with all in it: kernels, includes, and those yet to come.
    println!("cargo::rerun-if-changed={SHADER_DIR}");

    let mut kernels = Vec::new();
    find_kernels(Path::new(SHADER_DIR), &mut kernels)?;
    kernels.sort();

    let mut as_written = AS_WRITTEN.to_vec();

    let compiler = shaderc::Compiler::new()?;
    let mut embedded = String::new();
    for kernel in &kernels {
        let name = kernel_name(kernel)?;
        let is_as_written = as_written.contains(&name.as_str());
        as_written.retain(|listed| *listed != name);
        let spirv = compile(&compiler, kernel, !is_as_written)?;
        let spirv_path = out_dir.join(format!("{name}.spv"));
        fs::write(&spirv_path, spirv.as_binary_u8())?;
        writeln!(
            embedded,
            "/// `{}`\npub const {}: Shader = Shader {{ name: {name:?}, spirv: include_bytes!({spirv_path:?}) }};",
            kernel.display(),
            name.to_uppercase(),
        )?;
    }
    if let Some(missing) = as_written.first() {
        return Err(format!("AS_WRITTEN names {missing:?}, and there is no such kernel").into());
    }
    fs::write(out_dir.join("shaders.rs"), embedded)?;
    Ok(())
}

fn find_kernels(dir: &Path, kernels: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(dir)? {
        let path = entry?.path();
        if path.is_dir() {
            find_kernels(&path, kernels)?;
        } else if path.extension().is_some_and(|extension| extension == "comp") {
            kernels.push(path);
        }
    }
    Ok(())
}

/// `glsl/probe/layout.comp` is `probe_layout`.
fn kernel_name(kernel: &Path) -> Result<String, Box<dyn Error>> {
    let relative = kernel.strip_prefix(SHADER_DIR)?.with_extension("");
    Ok(relative.to_str().ok_or("a shader's path is not UTF-8")?.replace(['/', '\\'], "_"))
}

fn compile(
    compiler: &shaderc::Compiler,
    kernel: &Path,
    optimise: bool,
) -> Result<shaderc::CompilationArtifact, Box<dyn Error>> {
    let source = fs::read_to_string(kernel)?;

    let mut options = shaderc::CompileOptions::new()?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_2 as u32);
    options.set_optimization_level(match optimise {
        true => shaderc::OptimizationLevel::Performance,
        false => shaderc::OptimizationLevel::Zero,
    });
    options.set_warnings_as_errors();
    if std::env::var("PROFILE")? == "debug" {
        options.set_generate_debug_info();
    }
    options.set_include_callback(|requested, _kind, from, _depth| {
        let path = resolve_include(requested, Path::new(from))?;
        let content = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(shaderc::ResolvedInclude { resolved_name: path.display().to_string(), content })
    });

    let file = kernel.display().to_string();
    Ok(compiler.compile_into_spirv(&source, shaderc::ShaderKind::Compute, &file, "main", Some(&options))?)
}

/// Beside the including file first, then in `glsl/`.
fn resolve_include(requested: &str, from: &Path) -> Result<PathBuf, String> {
    let beside = from.parent().unwrap_or(Path::new("")).join(requested);
    [beside, Path::new(SHADER_DIR).join(requested)]
        .into_iter()
        .find(|path| path.is_file())
        .ok_or_else(|| format!("{requested} is neither beside {} nor in {SHADER_DIR}/", from.display()))
}
