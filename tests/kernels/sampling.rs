//! Samples a pixel and the render scale: what a picture of several samples is the mean of, and what a smaller picture
//! becomes.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::common::{TestDevice, render};
use crate::scenes::{light, mixed_scene, picture, primitive, sphere};
use crate::tracers::Tracers;
use glam::DVec3;
use zerkalo::frame::Frame;
use zerkalo::gpu::{
    BindingKind, BindingSet, Buffer, BufferKind, Commands, ComputePipeline, PIXEL_BYTES, PipelineDescription, Resource,
    StorageImage, Use, shaders,
};
use zerkalo::scene::{Camera, Material, Projection, Scene, gallery};
use zerkalo::settings::sampling::{SUBPIXELS, Sampling, sample_place};
use zerkalo::tracer::{Kernel, Precision, Settings, Tracer, TracerError};

const F32: Kernel = Kernel::Whitted(Precision::F32);

fn settings(kernel: Kernel, [width, height]: [u32; 2]) -> Settings {
    Settings { kernel, ..Settings::new(width, height) }
}

fn rmse(frame: &Frame, truth: &[[f64; 3]]) -> f64 {
    let pairs = frame.pixels().as_flattened().iter().zip(truth.as_flattened());
    let squares: f64 = pairs.map(|(&ours, &truth)| (f64::from(ours) - truth).powi(2)).sum();
    (squares / (3 * truth.len()) as f64).sqrt()
}

/// The samples are pixels of a picture 65 times as wide and high, so one of those gives each by itself.
#[test]
fn a_pixel_is_the_mean_of_its_samples_bit_for_bit_and_the_first_is_its_centre() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let size = [5, 3];
    for kernel in [F32, Kernel::Whitted(Precision::F64), Kernel::Plain] {
        for projection in Projection::ALL {
            let mut scene = mixed_scene();
            scene.camera.projection = projection;
            scene.lights.push(light(-3.0, 5.0, -8.0));
            // Light above 1 counts in full.
            scene.background = DVec3::new(3.0, 0.5, 0.0);
            let fine = tracers.draw(&scene, &settings(kernel, size.map(|side| SUBPIXELS * side)));
            let fine: Vec<_> = fine.rows().collect();
            for samples in [1, 2, 5, 16, 64] {
                let frame = tracers.draw(&scene, &Settings { samples, ..settings(kernel, size) });
                for (row, y) in frame.rows().zip(0..) {
                    for (pixel, x) in row.iter().zip(0..) {
                        let mut mean = [0.0_f32; 3];
                        for index in 0..samples {
                            let [column, line] = sample_place(index);
                            let sample = fine[(SUBPIXELS * y + line) as usize][(SUBPIXELS * x + column) as usize];
                            let weight = 1.0 / (index + 1) as f32;
                            mean = std::array::from_fn(|i| mean[i] + (sample[i] - mean[i]) * weight);
                        }
                        let bits = |pixel: [f32; 3]| pixel.map(f32::to_bits);
                        assert_eq!(bits(*pixel), bits(mean), "{kernel:?}, {samples} samples, pixel {x} {y}");
                    }
                }
            }
        }
    }
}

/// A disk without shades: edges in all directions.
fn disk(center: DVec3) -> Scene {
    let material = Material::of_course(DVec3::ONE, 1.0, 0.0, 0.0);
    let disk = primitive(sphere(center, 1.0), material);
    let camera = Camera { position: DVec3::new(0.0, 0.0, -4.0), projection: Projection::Centered, ..Camera::default() };
    Scene { camera, primitives: vec![disk], background: DVec3::ZERO, ..Scene::default() }
}

/// Against the mean over the pixel's square, each of whose 24² parts the reference sees.
#[test]
fn more_samples_are_nearer_to_the_mean_over_the_pixel() {
    const PARTS: u32 = 24;
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let scene = disk(DVec3::new(0.1, 0.05, 0.0));
    let size = [27, 21];
    let fine = picture(&scene, PARTS * size[0], PARTS * size[1]).to_f32();
    let mut truth = vec![[0.0; 3]; (size[0] * size[1]) as usize];
    for (i, pixel) in (0..).zip(fine) {
        let (x, y) = (i % (PARTS * size[0]) / PARTS, i / (PARTS * size[0]) / PARTS);
        let sum = &mut truth[(y * size[0] + x) as usize];
        (0..3).for_each(|channel| sum[channel] += f64::from(pixel[channel]) / f64::from(PARTS * PARTS));
    }
    let errors =
        [1, 4, 16, 64].map(|samples| rmse(&tracers.draw(&scene, &Settings { samples, ..settings(F32, size) }), &truth));
    println!("RMSE with 1, 4, 16, 64 samples: {errors:?}");
    // For straight edges they are as 1 : 0.49 : 0.16 : 0.054, see `PLACES`; a few dozen pixels lie on the edge here.
    for (pair, falls) in errors.windows(2).zip([0.49, 0.32, 0.34]) {
        assert!(pair[1] < 1.5 * falls * pair[0], "{errors:?}");
    }
}

#[test]
fn tiles_workgroups_and_runs_change_no_bit() {
    let device = TestDevice::open();
    let size = [75, 43];
    for scale in [1.0, 0.6, 0.25] {
        let usual = Settings { samples: 3, scale, ..settings(F32, size) };
        let whole = render(&device, &mixed_scene(), &usual);
        for (max_tile_side, workgroup) in [(1024, [8, 8]), (24, [8, 8]), (7, [3, 5]), (1, [8, 8])] {
            if max_tile_side == 1 && scale > 0.25 {
                continue;
            }
            let other = render(&device, &mixed_scene(), &Settings { max_tile_side, workgroup, ..usual.clone() });
            assert!(other == whole, "scale {scale}: tiles of {max_tile_side}, workgroups of {workgroup:?}");
        }
    }
}

#[test]
fn a_tracer_takes_up_other_samples_and_another_scale() {
    let device = TestDevice::open();
    let plain = settings(F32, [50, 30]);
    let mut tracer = Tracer::new(&device, &mixed_scene(), &plain).unwrap();
    let mut frame = tracer.frame().unwrap();
    let others = [(4, 1.0), (2, 0.5), (2, 0.3), (1, 0.3), (1, 1.0)];
    for (samples, scale) in others {
        let settings = Settings { samples, scale, max_tile_side: 20, ..plain.clone() };
        tracer.set_scene(&mixed_scene(), &settings).unwrap();
        tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
        assert!(frame == render(&device, &mixed_scene(), &settings), "{samples} samples at scale {scale}");
    }
    assert!(frame == render(&device, &mixed_scene(), &plain));
}

/// Along one axis: the traced pixels around a pixel's centre, and how far on from the first it lies.
fn neighbours(pixel: u32, size: u32, traced: u32) -> (usize, usize, f32) {
    let (unit, last) = (2 * i64::from(size), i64::from(traced) - 1);
    let place = ((2 * i64::from(pixel) + 1) * i64::from(traced) - i64::from(size)).clamp(0, last * unit);
    let low = place / unit;
    (low as usize, (low + 1).min(last) as usize, (place - low * unit) as f32 / unit as f32)
}

/// `glsl/upscale.comp` in the host's `f32`.
fn upscaled(traced: &[Vec<[f32; 3]>], [width, height]: [u32; 2]) -> Vec<[f32; 3]> {
    let between =
        |low: [f32; 3], high: [f32; 3], share: f32| std::array::from_fn(|i| low[i] + (high[i] - low[i]) * share);
    let mut pixels = Vec::new();
    for y in 0..height {
        let (top, bottom, down) = neighbours(y, height, traced.len() as u32);
        for x in 0..width {
            let (left, right, across) = neighbours(x, width, traced[0].len() as u32);
            let row = |y: usize| between(traced[y][left], traced[y][right], across);
            pixels.push(between(row(top), row(bottom), down));
        }
    }
    pixels
}

/// Vulkan lets a quotient be off by 2.5 units in the last place, of which the share is one; its colours' differences
/// weigh by it twice, along rows and columns.
fn tolerance(largest: f32) -> f32 {
    2.0 * 2.5 * f32::EPSILON * largest
}

#[test]
fn a_smaller_picture_is_brought_to_size_bilinearly() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    // Of the same shape as the smaller picture, so that this one can be traced by itself.
    for (size, traced_size, scale) in [([64, 32], [32, 16], 0.5), ([60, 40], [15, 10], 0.25), ([40, 30], [32, 24], 0.8)]
    {
        let scene = gallery::scene("four").unwrap();
        for samples in [1, 3] {
            let traced = tracers.draw(&scene, &Settings { samples, ..settings(F32, traced_size) });
            let traced: Vec<_> = traced.rows().map(<[_]>::to_vec).collect();
            let frame = tracers.draw(&scene, &Settings { samples, scale, ..settings(F32, size) });
            for (i, (ours, expected)) in frame.pixels().iter().zip(upscaled(&traced, size)).enumerate() {
                for (ours, expected) in ours.iter().zip(expected) {
                    assert!((ours - expected).abs() <= tolerance(1.0), "scale {scale}, pixel {i}: {ours} {expected}");
                }
            }
        }
    }
}

#[test]
fn the_window_is_the_same_at_every_scale() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    // 0.3 of either side is no whole number of pixels, and of another shape: 1.6 % wider, of which a disk this far from
    // the middle would be moved by half a pixel.
    let size = [101, 53];
    let scene = disk(DVec3::new(2.1, -0.3, 4.0));
    let mut middle = |scale| {
        let frame = tracers.draw(&scene, &Settings { samples: 64, scale, ..settings(F32, size) });
        let mut sums = DVec3::ZERO;
        for (i, pixel) in (0..).zip(frame.pixels()) {
            sums += f64::from(pixel[1]) * DVec3::new(f64::from(i % size[0]), f64::from(i / size[0]), 1.0);
        }
        sums.truncate() / sums.z
    };
    let whole = middle(1.0);
    for scale in [0.25, 0.3, 0.7] {
        let off = (middle(scale) - whole).abs().max_element();
        // Some twenty pixels on the edge of a disk of forty, 4 pixels wide, each off by 0.013 of its area in its own
        // way, come to 0.02 of a pixel; the samples' mean place is up to 0.004 of 4 pixels from the centre.
        assert!(off < 0.1, "scale {scale}: {off} pixels");
    }
}

#[test]
fn a_picture_of_one_colour_stays_that_at_every_scale() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let empty = Scene { lights: vec![], background: DVec3::new(0.1, 2.5, 0.3), ..Scene::default() };
    for size in [[61, 37], [1, 1], [1, 300], [300, 2]] {
        for scale in [0.25, 0.333, 0.5, 0.77, 0.999] {
            let frame = tracers.draw(&empty, &Settings { samples: 3, scale, ..settings(F32, size) });
            assert!(frame.pixels().iter().all(|&pixel| pixel == [0.1, 2.5, 0.3]), "{size:?} at scale {scale}");
        }
    }
}

#[test]
fn a_ramp_goes_on_as_a_ramp() {
    let device = TestDevice::open();
    for (size, traced_size) in [([97, 61], [49, 31]), ([64, 64], [16, 16]), ([50, 40], [49, 40])] {
        // Brightness at a place of the window, in [0, 1]² from its top left.
        let at = |x: f64, y: f64| [0.25 + 0.5 * x, 1.0 - 0.75 * y, 0.1 + 0.3 * x + 0.4 * y];
        let center = |pixel: u32, size: u32| (f64::from(pixel) + 0.5) / f64::from(size);
        let ramp = |[width, height]: [u32; 2]| {
            let rows = (0..height).map(move |y| (0..width).map(move |x| at(center(x, width), center(y, height))));
            rows.flatten().collect::<Vec<_>>()
        };
        let traced: Vec<_> = ramp(traced_size).iter().map(|&[r, g, b]| [r as f32, g as f32, b as f32, 1.0]).collect();
        let upscaled = upscale(&device, &traced, traced_size, size);
        // Within the outermost centres of the smaller picture.
        let is_within = |pixel: u32, axis: usize| {
            let edge = center(0, traced_size[axis]);
            (edge..=1.0 - edge).contains(&center(pixel, size[axis]))
        };
        for (i, (ours, expected)) in (0..).zip(upscaled.iter().zip(ramp(size))) {
            let [x, y] = [i % size[0], i / size[0]];
            assert_eq!(ours[3], 1.0);
            if is_within(x, 0) && is_within(y, 1) {
                for (ours, expected) in ours.iter().zip(expected) {
                    // Four rounded colours, below 1, besides the shares.
                    let off = (f64::from(*ours) - expected).abs();
                    assert!(off <= f64::from(tolerance(1.0) + 2.0 * f32::EPSILON), "{size:?}, pixel {x} {y}: {off}");
                }
            }
        }
    }
}

/// By the pass itself, of a picture that no scene gives.
fn upscale(device: &TestDevice, traced: &[[f32; 4]], traced_size: [u32; 2], size: [u32; 2]) -> Vec<[f32; 4]> {
    let description = PipelineDescription {
        shader: &shaders::UPSCALE,
        bindings: &[BindingKind::Picture, BindingKind::PictureRead],
        push_constant_bytes: 32,
        constants: &[8, 8],
    };
    let pipeline = ComputePipeline::new(device, &description).unwrap();
    let image = |name, [width, height]: [u32; 2]| {
        Resource::from(&Arc::new(StorageImage::new(device, name, width, height).unwrap()))
    };
    let (small, large) = (image("traced", traced_size), image("picture", size));
    let set = BindingSet::new(&pipeline, &[large.clone(), small.clone()]).unwrap();
    let mut upload = Buffer::new(device, "ramp", BufferKind::Upload, traced.len() as u64 * 16).unwrap();
    upload.write(bytemuck::cast_slice(traced)).unwrap();
    let upload = Resource::from(&Arc::new(upload));
    let bytes = u64::from(size[0] * size[1]) * PIXEL_BYTES;
    let pixels = Arc::new(Buffer::new(device, "pixels", BufferKind::Readback, bytes).unwrap());
    let read_back = Resource::from(&pixels);
    let mut commands = Commands::new(device, "upscale").unwrap();
    commands
        .run(|recorder| {
            recorder.make_ready(&small, Use::CopyTarget);
            recorder.copy_to_image(&upload, &small, traced_size[0], traced_size[1]);
            recorder.make_ready(&small, Use::ShaderRead);
            recorder.make_ready(&large, Use::ShaderWrite);
            let frame = [size, traced_size, [0, 0], [0, 0]];
            let groups = [size[0].div_ceil(8), size[1].div_ceil(8), 1];
            recorder.dispatch(&pipeline, &set, bytemuck::bytes_of(&frame), groups);
            recorder.make_ready(&large, Use::CopySource);
            recorder.make_ready(&read_back, Use::CopyTarget);
            recorder.copy_to_buffer(&large, &read_back, size[0], size[1]);
            recorder.make_ready(&read_back, Use::HostRead);
            Ok(())
        })
        .unwrap();
    bytemuck::cast_slice(pixels.bytes(&commands.idle().unwrap()).unwrap()).to_vec()
}

#[test]
fn progress_rises_sample_by_sample_to_all_pixels() {
    let device = TestDevice::open();
    let settings = Settings { samples: 4, scale: 0.5, max_tile_side: 16, ..settings(F32, [40, 30]) };
    let mut tracer = Tracer::new(&device, &mixed_scene(), &settings).unwrap();
    let mut frame = tracer.frame().unwrap();
    let mut heard = Vec::new();
    let mut listen = |pixels_done| {
        heard.push(pixels_done);
        ControlFlow::Continue(())
    };
    tracer.render(&mut frame, &mut listen).unwrap();
    // Tiles of 32 as shown: one, and a sliver of eight columns.
    assert_eq!(heard, [240, 480, 720, 960, 1020, 1080, 1140, 1200]);
    let mut calls = 0;
    let mut stop = |_| {
        calls += 1;
        if calls == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    assert!(matches!(tracer.render(&mut frame, &mut stop), Err(TracerError::Stopped)));
    tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
    assert!(frame == render(&device, &mixed_scene(), &settings), "after the stop");
}

#[test]
fn what_is_out_of_range_or_not_for_the_kernel_is_refused() {
    let device = TestDevice::open();
    let size = [8, 8];
    let wrong = [(F32, 0, 1.0), (F32, 65, 1.0), (F32, 1, 0.2), (F32, 1, 1.5), (F32, 1, f64::NAN)];
    let of_course = [(Kernel::Course, 2, 1.0), (Kernel::Course, 1, 0.5)];
    for (kernel, samples, scale) in wrong.into_iter().chain(of_course) {
        let settings = Settings { samples, scale, ..settings(kernel, size) };
        let error = Tracer::new(&device, &gallery::scene("four").unwrap(), &settings).err().expect("a refusal");
        assert!(matches!(error, TracerError::Refused(_)), "{error}");
        let is_told = error.to_string().contains(if kernel == Kernel::Course { "course kernel" } else { "not" });
        assert!(is_told && !error.to_string().contains('\n'), "{error}");
    }
    assert_eq!(Sampling::PLAIN, Sampling { samples: 1, scale: 1.0 });
}
