//! The SPIR-V that build.rs compiled, one constant a kernel: `glsl/probe/layout.comp` is [`PROBE_LAYOUT`].

use std::borrow::Cow;

/// A kernel's code.
#[derive(Clone)]
pub struct Shader {
    /// File name under `glsl/` without its ending, folders joined by `_`.
    pub name: &'static str,
    /// SPIR-V, little-endian words.
    spirv: Cow<'static, [u8]>,
    /// Whether the device is asked to round to nearest and to keep NaN and infinities, as far as it offers that.
    pub asks_for_float_controls: bool,
}

/// A file that is no SPIR-V.
#[derive(Debug, thiserror::Error)]
#[error("shader '{0}' is no SPIR-V module")]
pub struct NotSpirv(&'static str);

/// The first word of a module, and how many words come before its first instruction.
const MAGIC: [u8; 4] = 0x0723_0203_u32.to_le_bytes();
const HEADER_BYTES: usize = 20;

/// Whether bytes are words that begin as a module does.
const fn is_module(bytes: &[u8]) -> bool {
    let [a, b, c, d] = MAGIC;
    bytes.len() >= HEADER_BYTES
        && bytes.len().is_multiple_of(4)
        && bytes[0] == a
        && bytes[1] == b
        && bytes[2] == c
        && bytes[3] == d
}

impl Shader {
    /// One that build.rs compiled; anything else does not compile.
    const fn embedded(name: &'static str, spirv: &'static [u8], asks_for_float_controls: bool) -> Self {
        assert!(is_module(spirv), "build.rs writes SPIR-V");
        Self { name, spirv: Cow::Borrowed(spirv), asks_for_float_controls }
    }

    /// Another build of this shader.
    ///
    /// # Errors
    /// It is no SPIR-V. That it has this shader's interface is the compiler's word, and the validation layer's.
    pub fn rebuilt(&self, spirv: Vec<u8>) -> Result<Self, NotSpirv> {
        if !is_module(&spirv) {
            return Err(NotSpirv(self.name));
        }
        Ok(Self { spirv: Cow::Owned(spirv), ..*self })
    }

    /// SPIR-V, little-endian words.
    pub fn spirv(&self) -> &[u8] {
        &self.spirv
    }

    pub(super) fn words(&self) -> Vec<u32> {
        self.spirv.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
    }
}

/// Builds of kernels in place of those that the program has in it, such as of sources that have changed since.
#[derive(Clone, Default)]
pub struct Builds(Vec<Shader>);

impl Builds {
    /// Takes the place of the program's own of that name, and of a build before.
    pub fn put(&mut self, build: Shader) {
        self.0.retain(|other| other.name != build.name);
        self.0.push(build);
    }

    /// The build in place of one of the program's own, or that one.
    pub fn of<'a>(&'a self, own: &'a Shader) -> &'a Shader {
        self.0.iter().find(|build| build.name == own.name).unwrap_or(own)
    }
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
