//! The random numbers of path tracing, and the directions that they give.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::common::TestDevice;
use bytemuck::cast_slice;
use glam::{DVec2, DVec3};
use zerkalo::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Commands, ComputePipeline, PipelineDescription, Resource, Use, shaders,
};

/// Specialization constant 26 of `glsl/path/numbers.glsl`; those before it are of others.
const INDEPENDENT: usize = 26;

/// The numbers of the first samples of a pixel for a decision, and the directions about a normal that they give.
fn on_device(
    device: &TestDevice,
    samples: u32,
    (seed, decision): (u32, u32),
    normal: DVec3,
    are_independent: bool,
) -> Vec<(DVec2, DVec3)> {
    let bindings = [BindingKind::Records, BindingKind::Storage];
    let mut constants = [0; INDEPENDENT + 1];
    constants[INDEPENDENT] = u32::from(are_independent);
    let shader = &shaders::PROBE_PATH_NUMBERS_F32;
    let description =
        PipelineDescription { shader, bindings: &bindings, push_constant_bytes: 0, constants: &constants };
    let pipeline = ComputePipeline::new(device, &description).unwrap();
    let [x, y, z] = normal.as_vec3().to_array().map(f32::to_bits);
    let question = [x, y, z, 0, seed, decision, 0, 0];
    let mut input = Buffer::new(device, "question", BufferKind::Records, 32).unwrap();
    input.write(cast_slice(&question)).unwrap();
    let answers = Arc::new(Buffer::new(device, "answers", BufferKind::Storage, u64::from(samples) * 32).unwrap());
    let read_back = Resource::from(&answers);
    let set = BindingSet::new(&pipeline, &[Resource::from(&Arc::new(input)), read_back.clone()]).unwrap();
    let mut commands = Commands::new(device, "numbers").unwrap();
    commands
        .run(|recorder| {
            recorder.dispatch(&pipeline, &set, &[], [samples / 64, 1, 1]);
            recorder.make_ready(&read_back, Use::HostRead);
            Ok(())
        })
        .unwrap();
    let idle = commands.idle().unwrap();
    let answers: &[[f32; 8]] = cast_slice(answers.bytes(&idle).unwrap());
    let answer = |&[x, y, _, _, a, b, c, _]: &[f32; 8]| {
        (DVec2::new(x.into(), y.into()), DVec3::new(a.into(), b.into(), c.into()))
    };
    answers.iter().map(answer).collect()
}

/// Pearson's statistic of counts in cells of equal probability.
fn chi_square(counts: &[u32]) -> f64 {
    let expected = f64::from(counts.iter().sum::<u32>()) / counts.len() as f64;
    counts.iter().map(|&count| (f64::from(count) - expected).powi(2) / expected).sum()
}

/// What the statistic is above by chance once in a million times: its cube root is nearly normal (Wilson and Hilferty
/// 1931), and 4.75 standard deviations are that far.
fn chi_square_limit(degrees: usize) -> f64 {
    let k = degrees as f64;
    k * (1.0 - 2.0 / (9.0 * k) + 4.75 * (2.0 / (9.0 * k)).sqrt()).powi(3)
}

fn cell(number: f64, cells: usize) -> usize {
    ((number * cells as f64) as usize).min(cells - 1)
}

#[test]
fn each_power_of_two_of_samples_lies_one_in_each_equal_rectangle() {
    let device = TestDevice::open();
    for question in [(0, 0), (1, 0), (0xdead_beef, 1), (7, 12)] {
        let samples = on_device(&device, 4096, question, DVec3::Z, false);
        for power in [4, 6, 8, 12] {
            // Any block of 2^power samples, the second one here.
            let (count, first) = (1_usize << power, if power < 12 { 1 << power } else { 0 });
            for columns in 0..=power {
                let (columns, rows) = (1 << columns, count >> columns);
                let mut seen = vec![0; count];
                for (place, _) in &samples[first..first + count] {
                    seen[cell(place.x, columns) * rows + cell(place.y, rows)] += 1;
                }
                assert!(seen.iter().all(|&times| times == 1), "{question:?}: {columns}x{rows}");
            }
        }
    }
}

#[test]
fn numbers_of_other_pixels_decisions_and_samples_know_nothing_of_each_other() {
    let device = TestDevice::open();
    const CELLS: usize = 16;
    for are_independent in [false, true] {
        let of = |question| on_device(&device, 1 << 16, question, DVec3::Z, are_independent);
        let [one, other_pixel, other_decision] = [(3, 2), (4, 2), (3, 3)].map(of);
        let pairs = |a: &[(DVec2, DVec3)], b: &[(DVec2, DVec3)]| {
            let mut counts = [0; CELLS * CELLS];
            for ((a, _), (b, _)) in a.iter().zip(b) {
                counts[cell(a.x, CELLS) * CELLS + cell(b.y, CELLS)] += 1;
            }
            chi_square(&counts)
        };
        for (what, others) in [("pixel", &other_pixel), ("decision", &other_decision)] {
            let found = pairs(&one, others);
            assert!(found < chi_square_limit(CELLS * CELLS - 1), "{what}, independent {are_independent}: {found}");
        }
        if are_independent {
            let next = [&one[1..], &one[..1]].concat();
            for found in [pairs(&one, &one), pairs(&one, &next)] {
                assert!(found < chi_square_limit(CELLS * CELLS - 1), "{found}");
            }
        }
        assert!(one.iter().all(|(place, _)| place.min_element() > 0.0 && place.max_element() < 1.0));
    }
}

#[test]
fn directions_are_distributed_as_a_matt_surface_scatters() {
    let device = TestDevice::open();
    const RINGS: usize = 12;
    const SECTORS: usize = 16;
    let normals = [DVec3::Z, -DVec3::Z, DVec3::X, DVec3::new(1.0, -2.0, -0.5), DVec3::new(1e-4, 2e-4, -1.0)];
    for (seed, normal) in (0..).zip(normals.map(DVec3::normalize)) {
        for are_independent in [false, true] {
            let across = normal.any_orthonormal_pair();
            let mut counts = [0; RINGS * SECTORS];
            for (_, direction) in on_device(&device, 1 << 16, (seed, 1), normal, are_independent) {
                // The length by rounding of unit(), and a normal rounded to f32.
                assert!((direction.length() - 1.0).abs() < 4.0 * f64::from(f32::EPSILON));
                let cosine = direction.dot(normal);
                assert!(cosine > -2.0 * f64::from(f32::EPSILON), "{direction} from {normal}");
                // By a density of cosine / pi, the square of the sine is uniform, and so is the angle around.
                let around = direction.dot(across.1).atan2(direction.dot(across.0)) / (2.0 * PI) + 0.5;
                counts[cell((1.0 - cosine * cosine).clamp(0.0, 1.0), RINGS) * SECTORS + cell(around, SECTORS)] += 1;
            }
            // Of numbers that are spread evenly it is far smaller than by chance.
            let found = chi_square(&counts);
            assert!(found < chi_square_limit(RINGS * SECTORS - 1), "{normal}, independent {are_independent}: {found}");
        }
    }
}
