//! What a device's arithmetic is worth, found out by trying it: Vulkan promises little.

use std::sync::Arc;

use serde::Serialize;

use super::Commands;
use super::device::Device;
use super::error::GpuError;
use super::hazards::Use;
use super::memory::{Buffer, BufferKind};
use super::pipeline::{BindingKind, BindingSet, ComputePipeline, PipelineDescription, Resource};
use super::shaders;

/// Width of a kernel's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FloatWidth {
    /// 24 bits of significand.
    F32,
    /// 53 bits of significand; for devices with [`DeviceDescription::float64`](super::DeviceDescription::float64).
    F64,
}

/// The numbers of one width, as `glsl/probe/exact.comp` found them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Arithmetic {
    /// Whether sums and products with their errors (TwoSum, Dekker's TwoProd) are exact: all that the accurate kernel
    /// claims rests on that.
    pub exact_sums: bool,
    /// Whether a fma is rounded once: then it gives a product's error in one step.
    pub fused_fma: bool,
    /// Whether NaNs come about, stay and are recognised.
    pub keeps_nan: bool,
    /// The same of infinities.
    pub keeps_infinity: bool,
    /// Largest error met, in units in the last place of the result; correctly rounded ones have at most 0.5.
    pub division_error_ulp: f64,
    /// In the same units.
    pub square_root_error_ulp: f64,
    /// Whether kernels have been promised rounding to nearest by the driver.
    pub round_to_nearest_declared: bool,
    /// Whether kernels have been promised NaN, infinities and the sign of zero by the driver.
    pub nan_preserve_declared: bool,
}

/// Arithmetic of a device that calculates in that width; tested at the first call.
pub fn arithmetic(device: &Arc<Device>, width: FloatWidth) -> Result<Arithmetic, GpuError> {
    let place = match width {
        FloatWidth::F32 => 0,
        FloatWidth::F64 => 1,
    };
    if let Some(known) = device.arithmetic[place].get() {
        return Ok(*known);
    }
    let found = match width {
        FloatWidth::F32 => Trial::<f32>::new(device, &shaders::PROBE_EXACT_F32)?.judge(device, place),
        FloatWidth::F64 => Trial::<f64>::new(device, &shaders::PROBE_EXACT_F64)?.judge(device, place),
    };
    Ok(*device.arithmetic[place].get_or_init(|| found))
}

/// What the host's own, correctly rounded arithmetic is needed for.
trait Float: bytemuck::Pod + PartialEq + PartialOrd {
    fn from_f64(value: f64) -> Self;
    fn to_f64(self) -> f64;
    /// a·b + c rounded once.
    fn fused(a: Self, b: Self, c: Self) -> Self;
    fn sum(a: Self, b: Self) -> Self;
    /// To the next number away from zero.
    fn ulp(self) -> f64;
}

macro_rules! float {
    ($float:ty) => {
        impl Float for $float {
            fn from_f64(value: f64) -> Self {
                value as $float
            }
            fn to_f64(self) -> f64 {
                self.into()
            }
            fn fused(a: Self, b: Self, c: Self) -> Self {
                a.mul_add(b, c)
            }
            fn sum(a: Self, b: Self) -> Self {
                a + b
            }
            fn ulp(self) -> f64 {
                (self.abs().next_up() - self.abs()).into()
            }
        }
    };
}

float!(f32);
float!(f64);

/// The last of them are special.
const PAIRS: usize = 512;

/// NaN, infinities and what makes them: a and b.
const SPECIAL: [[f64; 2]; 6] = [
    [f64::NAN, 1.0],
    [f64::INFINITY, 2.0],
    [f64::INFINITY, f64::NEG_INFINITY],
    [1.0, 0.0],
    [0.0, 0.0],
    [1.0, f64::NAN],
];

/// Rows of `Result` in the kernel.
const ROWS: usize = 9;

/// One pair with what the device made of it.
struct Tried<T> {
    a: T,
    b: T,
    sum: T,
    sum_error: T,
    product: T,
    product_error: T,
    fma_error: T,
    quotient: T,
    root: T,
    is_nan: bool,
    is_infinite: bool,
}

struct Trial<T> {
    usual: Vec<Tried<T>>,
    special: Vec<Tried<T>>,
}

/// Numbers with all their digits, of both signs and of magnitudes whose sums lose digits.
fn usual_pairs() -> impl Iterator<Item = [f64; 2]> {
    // Multiples of the golden ratio spread evenly over [0, 1).
    let spread = |index: usize, step: f64| (index as f64 * step).fract();
    (1..=PAIRS - SPECIAL.len()).map(move |index| {
        let number = |step: f64, exponent: i32| {
            let digits = 1.0 + spread(index, step);
            if index.is_multiple_of(3) { -digits * 2f64.powi(exponent) } else { digits * 2f64.powi(exponent) }
        };
        [
            number(0.618_033_988_749_894_9, (index % 17) as i32 - 8),
            number(0.414_213_562_373_095_1, (index % 13) as i32 - 6),
        ]
    })
}

impl<T: Float> Trial<T> {
    fn new(device: &Arc<Device>, shader: &shaders::Shader) -> Result<Self, GpuError> {
        let pairs: Vec<[T; 2]> = usual_pairs().chain(SPECIAL).map(|pair| pair.map(T::from_f64)).collect();
        // The kernel takes vectors: each number fills one.
        let vectors: Vec<[T; 4]> = pairs.iter().flatten().map(|&number| [number; 4]).collect();
        let results: Vec<[T; 4]> =
            bytemuck::pod_collect_to_vec(&on_device(device, shader, bytemuck::cast_slice(&vectors))?);
        let tried = results.chunks_exact(ROWS).map(|rows| std::array::from_fn(|row| rows[row][0]));
        let of_pair = |(&[a, b], row): (&[T; 2], [T; ROWS])| {
            let [sum, sum_error, product, product_error, fma_error, quotient, root, is_nan, is_infinite] = row;
            let is_one = |value: T| value == T::from_f64(1.0);
            let (is_nan, is_infinite) = (is_one(is_nan), is_one(is_infinite));
            Tried { a, b, sum, sum_error, product, product_error, fma_error, quotient, root, is_nan, is_infinite }
        };
        let mut usual: Vec<_> = pairs.iter().zip(tried).map(of_pair).collect();
        let special = usual.split_off(usual.len() - SPECIAL.len());
        Ok(Self { usual, special })
    }

    fn judge(&self, device: &Device, width: usize) -> Arithmetic {
        let worst = |error: &dyn Fn(&Tried<T>) -> f64| {
            // A NaN among them is the worst.
            self.usual
                .iter()
                .map(error)
                .fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
        };
        let [nan, infinity, infinities, by_zero, zeros, nan_second] = &self.special[..] else {
            unreachable!("as many as SPECIAL")
        };
        let is_nan = |value: T| value.to_f64().is_nan();
        let is_infinite = |value: T| value.to_f64().is_infinite();
        let controls = device.float_controls[width];
        Arithmetic {
            exact_sums: self.usual.iter().all(Tried::is_exact),
            fused_fma: self.usual.iter().all(|tried| tried.fma_error == tried.exact_product_error()),
            keeps_nan: nan.is_nan
                && !infinity.is_nan
                && is_nan(nan.sum)
                && is_nan(nan_second.product)
                && is_nan(infinities.sum)
                && is_nan(zeros.quotient),
            keeps_infinity: infinity.is_infinite
                && !nan.is_infinite
                && is_infinite(infinity.product)
                && is_infinite(by_zero.quotient),
            division_error_ulp: worst(&|tried| {
                // The remainder of a division is a number of the same width, if the quotient is near.
                let remainder = T::fused(T::from_f64(-tried.quotient.to_f64()), tried.b, tried.a).to_f64();
                (remainder / tried.b.to_f64()).abs() / tried.quotient.ulp()
            }),
            square_root_error_ulp: worst(&|tried| {
                let size = T::from_f64(tried.a.to_f64().abs());
                let remainder = T::fused(T::from_f64(-tried.root.to_f64()), tried.root, size).to_f64();
                remainder.abs() / (2.0 * tried.root.to_f64()) / tried.root.ulp()
            }),
            round_to_nearest_declared: controls.round_to_nearest,
            nan_preserve_declared: controls.keep_nan_and_infinity,
        }
    }
}

impl<T: Float> Tried<T> {
    fn exact_product_error(&self) -> T {
        T::fused(self.a, self.b, T::from_f64(-self.product.to_f64()))
    }

    fn is_exact(&self) -> bool {
        let minus_one = T::from_f64(-1.0);
        let (large, small) =
            if self.a.to_f64().abs() >= self.b.to_f64().abs() { (self.a, self.b) } else { (self.b, self.a) };
        // Dekker's Fast2Sum: its differences are exact.
        let sum = T::sum(large, small);
        let sum_error = T::fused(minus_one, T::fused(minus_one, large, sum), small);
        let product = T::fused(self.a, self.b, T::from_f64(0.0));
        (self.sum, self.sum_error) == (sum, sum_error)
            && (self.product, self.product_error) == (product, self.exact_product_error())
    }
}

/// The results of the kernel without a fused fma.
fn on_device(device: &Arc<Device>, shader: &shaders::Shader, pairs: &[u8]) -> Result<Vec<u8>, GpuError> {
    let bindings = [BindingKind::Records, BindingKind::Storage];
    let description = PipelineDescription { shader, bindings: &bindings, push_constant_bytes: 0, constants: &[0] };
    let pipeline = ComputePipeline::new(device, &description)?;
    let mut input = Buffer::new(device, "pairs", BufferKind::Records, pairs.len() as u64)?;
    input.write(pairs)?;
    let results = Arc::new(Buffer::new(device, "results", BufferKind::Storage, (pairs.len() / 2 * ROWS) as u64)?);
    let read_back = Resource::from(&results);
    let set = BindingSet::new(&pipeline, &[Resource::from(&Arc::new(input)), read_back.clone()])?;
    let mut commands = Commands::new(device, "arithmetic")?;
    commands.run(|recorder| {
        recorder.dispatch(&pipeline, &set, &[], [PAIRS.div_ceil(64) as u32, 1, 1]);
        recorder.make_ready(&read_back, Use::HostRead);
        Ok(())
    })?;
    Ok(results.bytes(&commands.idle()?)?.to_vec())
}
