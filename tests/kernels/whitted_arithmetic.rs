//! The exact sums and products are exact on the device, and the compiler is not allowed to touch them.

use std::collections::HashSet;
use std::sync::Arc;

use crate::common::TestDevice;
use crate::random::Random;
use bytemuck::cast_slice;
use zerkalo::gpu::{
    self, BindingKind, BindingSet, Buffer, BufferKind, Commands, ComputePipeline, FloatWidth, PipelineDescription,
    Resource, Shader, Use, shaders,
};

const PAIRS: usize = 20_000;

/// Rows of `Result` in `glsl/probe/exact.comp`.
const SUM: usize = 0;
const SUM_ERROR: usize = 1;
const PRODUCT: usize = 2;
const PRODUCT_ERROR: usize = 3;
const ROWS: usize = 9;

/// Each pair as two rows of four; the results as rows of four. `fused`: by the device's fma.
fn on_device<T: bytemuck::Pod>(device: &TestDevice, shader: &Shader, pairs: &[T], fused: bool) -> Vec<T> {
    let bindings = [BindingKind::Records, BindingKind::Storage];
    let description =
        PipelineDescription { shader, bindings: &bindings, push_constant_bytes: 0, constants: &[u32::from(fused)] };
    let pipeline = ComputePipeline::new(device, &description).unwrap();
    let bytes: &[u8] = cast_slice(pairs);
    let mut input = Buffer::new(device, "pairs", BufferKind::Records, bytes.len() as u64).unwrap();
    input.write(bytes).unwrap();
    let result_bytes = (bytes.len() / 2 * ROWS) as u64;
    let results = Arc::new(Buffer::new(device, "results", BufferKind::Storage, result_bytes).unwrap());
    let read_back = Resource::from(&results);
    let set = BindingSet::new(&pipeline, &[Resource::from(&Arc::new(input)), read_back.clone()]).unwrap();
    let mut commands = Commands::new(device, "exact").unwrap();
    commands
        .run(|recorder| {
            recorder.dispatch(&pipeline, &set, &[], [(pairs.len() / 8).div_ceil(64) as u32, 1, 1]);
            recorder.make_ready(&read_back, Use::HostRead);
            Ok(())
        })
        .unwrap();
    cast_slice(results.bytes(&commands.idle().unwrap()).unwrap()).to_vec()
}

/// Numbers of both signs over many magnitudes, four to a row of which three count.
fn numbers(seed: u64, magnitude: f64) -> Vec<f64> {
    let mut random = Random(seed);
    (0..PAIRS * 8).map(|_| random.signed_magnitude(-magnitude, magnitude)).collect()
}

/// The three numbers that count of each pair and of its results.
fn triples<T: Copy>(pairs: &[T], results: &[T]) -> Vec<([T; 2], [T; ROWS])> {
    let of_pair = |(pair, result): (&[T], &[T])| {
        let at = |i: usize| ([pair[i], pair[4 + i]], std::array::from_fn(|row| result[4 * row + i]));
        [at(0), at(1), at(2)]
    };
    pairs.chunks_exact(8).zip(results.chunks_exact(4 * ROWS)).flat_map(of_pair).collect()
}

#[test]
fn f32_sums_and_products_with_their_errors_are_exact() {
    let device = TestDevice::open();
    let pairs: Vec<f32> = numbers(1, 4.0).into_iter().map(|number| number as f32).collect();
    let results = on_device(&device, &shaders::PROBE_EXACT_F32, &pairs, false);
    let mut with_error = 0;
    for ([a, b], result) in triples(&pairs, &results) {
        // Both fit an `f64`: the sum since the magnitudes differ by less than 2²⁹, the product always.
        let (sum, product) = (f64::from(a) + f64::from(b), f64::from(a) * f64::from(b));
        let value = |hi: usize, lo: usize| f64::from(result[hi]) + f64::from(result[lo]);
        assert_eq!((value(SUM, SUM_ERROR), value(PRODUCT, PRODUCT_ERROR)), (sum, product), "{a:e} and {b:e}");
        assert_eq!((result[SUM], result[PRODUCT]), (a + b, a * b), "rounded to nearest");
        with_error += u32::from(result[PRODUCT_ERROR] != 0.0);
    }
    assert!(with_error > PAIRS as u32, "only {with_error} products were not exact by themselves");
}

#[test]
fn f64_sums_and_products_with_their_errors_are_exact() {
    let device = TestDevice::open();
    let pairs = numbers(2, 20.0);
    let results = on_device(&device, &shaders::PROBE_EXACT_F64, &pairs, false);
    for ([a, b], result) in triples(&pairs, &results) {
        let sum = a + b;
        let sum_error = if a.abs() > b.abs() { b - (sum - a) } else { a - (sum - b) };
        assert_eq!((result[SUM], result[SUM_ERROR]), (sum, sum_error), "{a:e} and {b:e}");
        assert_eq!((result[PRODUCT], result[PRODUCT_ERROR]), (a * b, a.mul_add(b, -(a * b))), "{a:e} and {b:e}");
    }
}

#[test]
fn a_device_s_own_fma_is_used_only_where_it_makes_products_exact() {
    let device = TestDevice::open();
    let pairs: Vec<f32> = numbers(3, 4.0).into_iter().map(|number| number as f32).collect();
    let by_fma = on_device(&device, &shaders::PROBE_EXACT_F32, &pairs, true);
    let is_exact = triples(&pairs, &by_fma).iter().all(|([a, b], result)| {
        f64::from(result[PRODUCT]) + f64::from(result[PRODUCT_ERROR]) == f64::from(*a) * f64::from(*b)
    });
    assert_eq!(gpu::arithmetic(&device, FloatWidth::F32).unwrap().fused_fma, is_exact);

    let pairs = numbers(4, 20.0);
    let by_fma = on_device(&device, &shaders::PROBE_EXACT_F64, &pairs, true);
    let is_exact = triples(&pairs, &by_fma)
        .iter()
        .all(|([a, b], result)| (result[PRODUCT], result[PRODUCT_ERROR]) == (a * b, a.mul_add(*b, -(a * b))));
    assert_eq!(gpu::arithmetic(&device, FloatWidth::F64).unwrap().fused_fma, is_exact);
}

#[test]
fn the_self_test_finds_the_arithmetic_that_the_bounds_rest_on() {
    let device = TestDevice::open();
    for width in [FloatWidth::F32, FloatWidth::F64] {
        let found = gpu::arithmetic(&device, width).unwrap();
        assert!(found.exact_sums && found.keeps_nan && found.keeps_infinity, "{width:?}: {found:?}");
        // Vulkan allows an f32 division 2.5 ulp, which an error below 0.5 beside it cannot be mistaken for.
        let worst = found.division_error_ulp.max(found.square_root_error_ulp);
        assert!((0.25..=3.0).contains(&worst), "{width:?}: {found:?}");
    }
}

/// Opcodes and numbers of the SPIR-V specification, unified1.
mod spirv {
    pub const MAGIC: u32 = 0x0723_0203;
    pub const NAME: u32 = 5;
    pub const CONSTANT: u32 = 43;
    pub const CONSTANT_COMPOSITE: u32 = 44;
    pub const FUNCTION: u32 = 54;
    pub const FUNCTION_END: u32 = 56;
    pub const DECORATE: u32 = 71;
    pub const F_ADD: u32 = 129;
    pub const F_SUB: u32 = 131;
    pub const F_MUL: u32 = 133;
    pub const VECTOR_TIMES_SCALAR: u32 = 142;
    pub const NO_CONTRACTION: u32 = 42;
    /// What contraction and reassociation are about.
    pub const ARITHMETIC: [u32; 4] = [F_ADD, F_SUB, F_MUL, VECTOR_TIMES_SCALAR];
}

struct Instruction {
    opcode: u32,
    /// Of arithmetic: type, result, operands.
    words: Vec<u32>,
}

fn instructions(shader: &Shader) -> Vec<Instruction> {
    let words = shader.spirv().chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap()));
    let words: Vec<u32> = words.collect();
    assert_eq!(words[0], spirv::MAGIC);
    let mut rest = &words[5..];
    let mut instructions = Vec::new();
    while let [first, ..] = rest {
        let (length, opcode) = ((first >> 16) as usize, first & 0xFFFF);
        instructions.push(Instruction { opcode, words: rest[1..length].to_vec() });
        rest = &rest[length..];
    }
    instructions
}

fn without_contraction(code: &[Instruction]) -> HashSet<u32> {
    let decorations = code.iter().filter(|i| i.opcode == spirv::DECORATE && i.words[1] == spirv::NO_CONTRACTION);
    decorations.map(|decoration| decoration.words[0]).collect()
}

#[test]
fn all_arithmetic_of_the_exact_sums_and_products_has_no_contraction() {
    for shader in [&shaders::PROBE_EXACT_F32, &shaders::PROBE_EXACT_F64] {
        let code = instructions(shader);
        let protected = without_contraction(&code);
        let arithmetic: Vec<_> = code.iter().filter(|i| spirv::ARITHMETIC.contains(&i.opcode)).collect();
        assert!(arithmetic.len() >= 20, "{}: {} instructions", shader.name, arithmetic.len());
        let bare: Vec<_> = arithmetic.iter().filter(|i| !protected.contains(&i.words[1])).map(|i| i.opcode).collect();
        assert!(bare.is_empty(), "{}: {bare:?}", shader.name);
    }
}

/// The probes' code, the kernels' own inlined and optimised: what starts with a multiplication by the splitter is a
/// TwoProd, and so is what follows from it within its five steps.
#[test]
fn every_exact_product_in_the_probes_has_no_contraction() {
    let f32_splitter: &[u32] = &[4097_f32.to_bits()];
    let bits = 134_217_729_f64.to_bits();
    let f64_splitter: &[u32] = &[bits as u32, (bits >> 32) as u32];
    for (shader, splitter) in [(&shaders::PROBE_RAYS_F32, f32_splitter), (&shaders::PROBE_RAYS_F64, f64_splitter)] {
        let code = instructions(shader);
        let protected = without_contraction(&code);
        let mut splitters = HashSet::new();
        for constant in &code {
            let is_scalar = constant.opcode == spirv::CONSTANT && constant.words[2..] == *splitter;
            let is_vector = constant.opcode == spirv::CONSTANT_COMPOSITE && splitters.contains(&constant.words[2]);
            if is_scalar || is_vector {
                splitters.insert(constant.words[1]);
            }
        }
        let mut reached = splitters;
        let mut checked = HashSet::new();
        for _step in 0..5 {
            let uses: Vec<_> = code
                .iter()
                .filter(|i| spirv::ARITHMETIC.contains(&i.opcode))
                .filter(|i| i.words[2..].iter().any(|operand| reached.contains(operand)))
                .map(|i| (i.opcode, i.words[1]))
                .collect();
            let bare: Vec<_> = uses.iter().filter(|(_, result)| !protected.contains(result)).collect();
            assert!(bare.is_empty(), "{}: {bare:?}", shader.name);
            reached = uses.iter().map(|(_, result)| *result).collect();
            checked.extend(reached.iter().copied());
        }
        println!("{}: {} instructions of exact products", shader.name, checked.len());
        assert!(checked.len() > 300, "{}: only {}", shader.name, checked.len());
    }
}

/// The kernels' code as it is written, function by function.
#[test]
fn every_function_of_the_kernels_that_makes_sums_and_products_exact_has_no_contraction() {
    let exact = ["two_sum(", "renormalized(", "upper_half(", "two_product(", "add_scaled(", "exact_sum("];
    for shader in
        [&shaders::WHITTED_F32, &shaders::WHITTED_F64, &shaders::WHITTED_F32_PACKETS, &shaders::WHITTED_F64_PACKETS]
    {
        let code = instructions(shader);
        let protected = without_contraction(&code);
        let name_of = |id: u32| {
            let name = code.iter().find(|i| i.opcode == spirv::NAME && i.words[0] == id);
            let bytes = name.map(|name| cast_slice::<u32, u8>(&name.words[1..]).to_vec()).unwrap_or_default();
            String::from_utf8_lossy(&bytes).into_owned()
        };
        let mut found = HashSet::new();
        let mut rest = &code[..];
        while let Some(begin) = rest.iter().position(|i| i.opcode == spirv::FUNCTION) {
            let end = begin + rest[begin..].iter().position(|i| i.opcode == spirv::FUNCTION_END).unwrap();
            let name = name_of(rest[begin].words[1]);
            if let Some(known) = exact.iter().find(|known| name.starts_with(**known)) {
                let arithmetic: Vec<_> =
                    rest[begin..end].iter().filter(|i| spirv::ARITHMETIC.contains(&i.opcode)).collect();
                let bare = arithmetic.iter().filter(|i| !protected.contains(&i.words[1])).count();
                assert_eq!(bare, 0, "{}: {name}", shader.name);
                assert!(!arithmetic.is_empty(), "{}: {name} calculates nothing", shader.name);
                found.insert(*known);
            }
            rest = &rest[end..];
        }
        assert_eq!(found.len(), exact.len(), "{}: only {found:?}", shader.name);
    }
}
