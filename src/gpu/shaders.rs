//! The SPIR-V that build.rs compiled, one constant a kernel: `glsl/probe/layout.comp` is [`PROBE_LAYOUT`].

use std::borrow::Cow;

/// A kernel's code.
#[derive(Clone)]
pub struct Shader {
    /// File name under `glsl/` without its ending, folders joined by `_`.
    pub name: &'static str,
    /// SPIR-V, little-endian words.
    pub spirv: Cow<'static, [u8]>,
    /// Whether the device is asked to round to nearest and to keep NaN and infinities, as far as it offers that.
    pub asks_for_float_controls: bool,
}

impl Shader {
    pub(super) fn words(&self) -> Vec<u32> {
        self.spirv.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
    }
}

/// Builds of kernels in the place of those that the program has in it, such as of sources that have changed since.
#[derive(Clone, Default)]
pub struct Builds(Vec<Shader>);

impl Builds {
    /// Takes the place of the program's own of that name, and of a build before.
    pub fn put(&mut self, build: Shader) {
        self.0.retain(|other| other.name != build.name);
        self.0.push(build);
    }

    /// The build in the place of one of the program's own, or that one.
    pub fn of<'a>(&'a self, own: &'a Shader) -> &'a Shader {
        self.0.iter().find(|build| build.name == own.name).unwrap_or(own)
    }
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
