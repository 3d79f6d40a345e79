//! Compiles every `glsl/**/*.comp` to SPIR-V and writes `$OUT_DIR/shaders.rs`, which embeds them.
//!
//! Target: Vulkan 1.2 (SPIR-V 1.5). The kernels need nothing of 1.3, and 1.2 is what the drivers of laptops since
//! about 2015 offer, those stopped before 1.3 among them; 1.3's SPIR-V would besides ask for `maintenance4`, because
//! a workgroup size that is a specialization constant becomes `LocalSizeId` there.
//!
//! In a clone it also tells the program its commit, as `ZERKALO_COMMIT`.

#[path = "src/gpu/shader_compiler.rs"]
mod shader_compiler;

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use shader_compiler::{AS_WRITTEN, compile, kernel_name, variants};

const SHADER_DIR: &str = "glsl";

fn main() {
    if let Some((commit, log)) = commit() {
        println!("cargo::rerun-if-changed={}", log.display());
        println!("cargo::rustc-env=ZERKALO_COMMIT={commit}");
    }
    if let Err(error) = compile_all() {
        // shaderc's text names the shader's own file and line; cargo shows each such line as an error.
        for line in error.to_string().lines() {
            println!("cargo::error={line}");
        }
    }
}

/// The commit that is checked out, and the file that tells when it is another. `None` without git, outside a clone, in
/// some other project's clone, and where git keeps no such file: an old commit would be worse than none.
fn commit() -> Option<(String, PathBuf)> {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let root = fs::canonicalize(git(&["rev-parse", "--show-toplevel"])?).ok()?;
    let is_ours = fs::canonicalize(".").ok()? == root;
    let log = PathBuf::from(git(&["rev-parse", "--git-path", "logs/HEAD"])?);
    let commit = git(&["rev-parse", "--short=10", "HEAD"])?;
    (is_ours && log.is_file()).then_some((commit, log))
}

fn compile_all() -> Result<(), Box<dyn Error>> {
    let out_dir = PathBuf::from(std::env::var("OUT_DIR")?);
    let is_debug = std::env::var("PROFILE")? == "debug";
    // cargo watches the folder with all in it: kernels, includes, and those yet to come.
    println!("cargo::rerun-if-changed={SHADER_DIR}");

    let mut kernels = Vec::new();
    find_kernels(Path::new(SHADER_DIR), &mut kernels)?;
    kernels.sort();

    let mut as_written = AS_WRITTEN.to_vec();
    let mut embedded = String::new();
    for kernel in &kernels {
        let kernel = kernel.strip_prefix(SHADER_DIR)?;
        let kernel_name = kernel_name(kernel)?;
        as_written.retain(|listed| *listed != kernel_name);
        for &variant in variants(&kernel_name) {
            let name = format!("{kernel_name}{}", variant.suffix);
            let spirv = compile(Path::new(SHADER_DIR), kernel, variant, is_debug)?;
            let spirv_path = out_dir.join(format!("{name}.spv"));
            fs::write(&spirv_path, spirv.as_binary_u8())?;
            let (constant, file) = (name.to_uppercase(), Path::new(SHADER_DIR).join(kernel));
            writeln!(embedded, "/// `{}`\npub static {constant}: Shader =", file.display())?;
            writeln!(
                embedded,
                "    Shader::embedded({name:?}, include_bytes!({spirv_path:?}), {});",
                variant.asks_for_float_controls
            )?;
        }
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
