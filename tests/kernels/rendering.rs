//! What a picture may depend on, and what it may not: tiles, workgroups, tracers and runs change no bit.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::common::{TestDevice, render};
use bytemuck::{bytes_of, cast_slice};
use glam::DVec3;
use zerkalo::frame::Frame;
use zerkalo::gpu::{
    BindingSet, Buffer, BufferKind, Commands, ComputePipeline, Device, PIXEL_BYTES, PipelineDescription, Resource,
    StorageImage, Use, shaders,
};
use zerkalo::plan::WORKGROUP;
use zerkalo::scene::{Light, Primitive, Scene, Solid, SolidKind, gallery};
use zerkalo::tracer::course::{BINDINGS, CoursePushConstants, MAX_PRIMITIVES, PrimitiveRecords, upload};
use zerkalo::tracer::{Settings, Tracer, TracerError};

/// Neither side is a multiple of a tile or a workgroup used here.
const SIZE: [u32; 2] = [151, 67];

fn settings() -> Settings {
    Settings::new(SIZE[0], SIZE[1])
}

/// All four solids, some of them mirrors.
fn scene() -> Scene {
    gallery::scene("showcase").unwrap()
}

fn bits(frame: &Frame) -> Vec<[u32; 3]> {
    frame.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

#[track_caller]
fn assert_same_bits(a: &Frame, b: &Frame, what: &str) {
    assert_eq!((a.width(), a.height()), (b.width(), b.height()), "{what}");
    let differing: Vec<_> = (0_u32..).zip(bits(a).into_iter().zip(bits(b))).filter(|(_, (a, b))| a != b).collect();
    assert!(differing.is_empty(), "{what}: {} pixels differ, the first: {:x?}", differing.len(), differing.first());
}

/// The error of a tracer that must not be made; its message must be one line.
#[track_caller]
fn refusal(device: &Arc<Device>, scene: &Scene, settings: &Settings) -> (TracerError, String) {
    let Err(error) = Tracer::new(device, scene, settings) else { panic!("it was accepted") };
    let line = error.to_string();
    assert!(!line.is_empty() && !line.contains('\n'), "{line:?}");
    (error, line)
}

#[test]
fn a_picture_in_tiles_is_the_whole_picture_bit_for_bit() {
    let device = TestDevice::open();
    let whole = render(&device, &scene(), &settings());
    let tile_sides = [7, 33, 64, 150, SIZE[0]];
    for max_tile_side in tile_sides {
        let tiled = render(&device, &scene(), &Settings { max_tile_side, ..settings() });
        assert_same_bits(&tiled, &whole, &format!("tiles of {max_tile_side}"));
    }
}

#[test]
fn a_tile_of_one_pixel_is_enough() {
    let device = TestDevice::open();
    let settings = Settings::new(6, 4);
    let whole = render(&device, &scene(), &settings);
    for max_tile_side in [0, 1] {
        let tiled = render(&device, &scene(), &Settings { max_tile_side, ..settings.clone() });
        assert_same_bits(&tiled, &whole, &format!("tiles of {max_tile_side}"));
    }
}

#[test]
fn two_renders_of_one_tracer_are_bit_equal() {
    let device = TestDevice::open();
    let mut tracer = Tracer::new(&device, &scene(), &Settings { max_tile_side: 64, ..settings() }).unwrap();
    let mut draw = |held_before: f32| {
        let mut frame = tracer.frame().unwrap();
        frame.pixels_mut().fill([held_before; 3]);
        tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
        frame
    };
    // Whatever the frame held is gone.
    assert_same_bits(&draw(0.0), &draw(f32::NAN), "the second render");
}

#[test]
fn two_tracers_of_one_device_and_of_two_devices_are_bit_equal() {
    let (device, other_device) = (TestDevice::open(), TestDevice::open());
    let first = render(&device, &scene(), &settings());
    // Both alive, drawing in turn.
    let mut other_scene_tracer = Tracer::new(&device, &gallery::scene("four").unwrap(), &settings()).unwrap();
    let mut second_tracer = Tracer::new(&device, &scene(), &settings()).unwrap();
    let mut frame = second_tracer.frame().unwrap();
    other_scene_tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
    second_tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_same_bits(&frame, &first, "another tracer of the device");
    assert_same_bits(&render(&other_device, &scene(), &settings()), &first, "another device object");
}

#[test]
fn every_workgroup_shape_gives_the_same_bits() {
    let device = TestDevice::open();
    let usual = render(&device, &scene(), &settings());
    for workgroup in [[8, 8], [16, 8], [64, 1], [3, 5]] {
        let other = render(&device, &scene(), &Settings { workgroup, ..settings() });
        assert_same_bits(&other, &usual, &format!("workgroups of {workgroup:?}"));
    }
}

#[test]
fn the_depth_of_the_settings_is_that_of_the_scene() {
    let device = TestDevice::open();
    for depth in [1, 3] {
        let by_settings = render(&device, &scene(), &Settings { max_depth: Some(depth), ..settings() });
        let by_scene = render(&device, &Scene { max_depth: depth, ..scene() }, &settings());
        assert_same_bits(&by_settings, &by_scene, &format!("depth {depth}"));
    }
}

/// No light, colour or coefficient is negative, so what a generation adds is not, and rounding keeps the order of
/// sums: the deeper picture is nowhere darker. The background and the light's ball end a ray at once.
#[test]
fn a_deeper_picture_is_brighter_where_mirrors_are_and_the_same_where_nothing_is() {
    let device = TestDevice::open();
    let scene = gallery::scene("corridor").unwrap();
    let at = |depth| render(&device, &scene, &Settings { max_depth: Some(depth), ..settings() });
    let pictures = [at(1), at(5), at(20)];
    let background = scene.background.as_vec3().to_array();
    let is_background: Vec<bool> = pictures[0].pixels().iter().map(|&pixel| pixel == background).collect();
    assert!(is_background.contains(&true) && is_background.contains(&false));
    for pair in pictures.windows(2) {
        let mut brighter = 0;
        for ((shallow, deep), &is_background) in pair[0].pixels().iter().zip(pair[1].pixels()).zip(&is_background) {
            assert!((0..3).all(|i| deep[i] >= shallow[i]), "{shallow:?} became {deep:?}");
            assert!(!is_background || deep == shallow, "{shallow:?} became {deep:?}");
            brighter += usize::from(deep != shallow);
        }
        // Every solid of the corridor mirrors, and in this kernel a ray that leaves goes on adding to its pixel.
        let solid = is_background.iter().filter(|&&is_background| !is_background).count();
        assert!(brighter * 10 > solid * 9, "only {brighter} of {solid} pixels are brighter");
    }
}

/// Both end the kernel's loop: one is compiled in, the other comes with the picture.
#[test]
fn the_pushed_depth_and_the_compiled_one_give_the_same_bits() {
    let device = TestDevice::open();
    let scene = gallery::scene("corridor").unwrap();
    for depth in [1, 5] {
        let tracer = render(&device, &scene, &Settings { max_depth: Some(depth), ..settings() });
        for (compiled, pushed) in [(20, depth), (depth, 20)] {
            let picture = render_with_depths(&device, &scene, compiled, pushed);
            assert_same_bits(&picture, &tracer, &format!("compiled for {compiled}, {pushed} pushed"));
        }
    }
}

/// What [`Tracer`] does for one tile, with its two depths apart.
fn render_with_depths(device: &TestDevice, scene: &Scene, compiled: u32, pushed: u32) -> Frame {
    let [width, height] = SIZE;
    let picture = Resource::from(&Arc::new(StorageImage::new(device, "picture", width, height).unwrap()));
    let bytes = u64::from(width * height) * PIXEL_BYTES;
    let pixels = Arc::new(Buffer::new(device, "pixels", BufferKind::Readback, bytes).unwrap());
    let read_back = Resource::from(&pixels);
    let pipeline = ComputePipeline::new(
        device,
        &PipelineDescription {
            shader: &shaders::COURSE,
            bindings: &BINDINGS,
            push_constant_bytes: size_of::<CoursePushConstants>() as u32,
            constants: &[compiled, WORKGROUP[0], WORKGROUP[1]],
        },
    )
    .unwrap();
    let records = PrimitiveRecords::of(scene);
    let resources: Vec<_> = [picture.clone()].into_iter().chain(upload(device, &records).unwrap()).collect();
    let set = BindingSet::new(&pipeline, &resources).unwrap();
    let record = CoursePushConstants::new(scene, &scene.lights[0], records.counts(), pushed, width, height);
    let mut commands = Commands::new(device, "depths").unwrap();
    commands
        .run(|recorder| {
            recorder.make_ready(&picture, Use::ShaderWrite);
            let groups = [width.div_ceil(WORKGROUP[0]), height.div_ceil(WORKGROUP[1]), 1];
            recorder.dispatch(&pipeline, &set, bytes_of(&record), groups);
            recorder.make_ready(&picture, Use::CopySource);
            recorder.make_ready(&read_back, Use::CopyTarget);
            recorder.copy_to_buffer(&picture, &read_back, width, height);
            recorder.make_ready(&read_back, Use::HostRead);
            Ok(())
        })
        .unwrap();
    let mut frame = Frame::new(width, height).unwrap();
    let idle = commands.idle().unwrap();
    let rgba: &[[f32; 4]] = cast_slice(pixels.bytes(&idle).unwrap());
    for (target, &[r, g, b, _]) in frame.pixels_mut().iter_mut().zip(rgba) {
        *target = [r, g, b];
    }
    frame
}

#[test]
fn a_hundred_primitives_are_drawn_and_one_more_is_refused_with_the_reason() {
    let device = TestDevice::open();
    let mut scene = gallery::scene("grid-sphere-100").unwrap();
    assert_eq!(scene.primitives.len(), MAX_PRIMITIVES);
    render(&device, &scene, &Settings::new(16, 7));
    scene.primitives.push(Primitive::course_default(SolidKind::Cone));
    let (error, line) = refusal(&device, &scene, &settings());
    assert!(error.is_input_error());
    for part in ["course kernel", "100", "101"] {
        assert!(line.contains(part), "{part} is not in: {line}");
    }
}

#[test]
fn a_scene_without_a_light_or_with_two_is_refused_with_the_reason() {
    let device = TestDevice::open();
    for count in [0, 2] {
        let scene = Scene { lights: vec![Light::default(); count], ..scene() };
        let (error, line) = refusal(&device, &scene, &settings());
        assert!(error.is_input_error());
        for part in ["course kernel", "exactly one light", &count.to_string()] {
            assert!(line.contains(part), "{part} is not in: {line}");
        }
    }
}

#[test]
fn sides_of_0_and_16385_pixels_are_refused_with_the_limits() {
    let device = TestDevice::open();
    for (width, height) in [(0, 1), (1, 0), (0, 0), (16385, 1), (1, 16385), (u32::MAX, u32::MAX)] {
        let (error, line) = refusal(&device, &scene(), &Settings::new(width, height));
        assert!(error.is_input_error());
        for part in [format!("{width}x{height}"), "1 to 16384".to_owned()] {
            assert!(line.contains(&part), "{part} is not in: {line}");
        }
    }
}

#[test]
fn pictures_of_one_pixel_and_one_row_or_column_are_drawn() {
    let device = TestDevice::open();
    for (width, height) in [(1, 1), (1, 300), (300, 1), (16384, 1), (1, 16384)] {
        let settings = Settings { max_depth: Some(1), ..Settings::new(width, height) };
        let frame = render(&device, &scene(), &settings);
        assert_eq!((frame.width(), frame.height()), (width, height));
        // Neither the background nor the ambient light is black: what is, was not drawn.
        assert!(frame.pixels().iter().flatten().all(|value| value.is_finite() && *value > 0.0), "{width}x{height}");
    }
}

#[test]
fn progress_rises_tile_by_tile_to_all_pixels() {
    let device = TestDevice::open();
    let settings = Settings { max_tile_side: 50, max_depth: Some(1), ..settings() };
    let mut tracer = Tracer::new(&device, &scene(), &settings).unwrap();
    let mut frame = tracer.frame().unwrap();
    for _ in 0..2 {
        let mut heard = Vec::new();
        let mut listen = |pixels_done| {
            heard.push(pixels_done);
            ControlFlow::Continue(())
        };
        tracer.render(&mut frame, &mut listen).unwrap();
        // 151x67 in tiles of 50: three and a sliver of one pixel, in two rows.
        assert_eq!(heard, [2500, 5000, 7500, 7550, 8400, 9250, 10100, 10117]);
    }
}

#[test]
fn a_break_stops_at_once_and_the_tracer_draws_again() {
    let device = TestDevice::open();
    let settings = Settings { max_tile_side: 50, max_depth: Some(2), ..settings() };
    let mut tracer = Tracer::new(&device, &scene(), &settings).unwrap();
    let mut frame = tracer.frame().unwrap();
    for stop_at in [1, 3, 8] {
        let mut calls = 0;
        let mut stop = |_| {
            calls += 1;
            if calls == stop_at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let error = tracer.render(&mut frame, &mut stop).unwrap_err();
        assert!(matches!(error, TracerError::Stopped), "{error}");
        assert!(!error.is_input_error());
        assert_eq!(calls, stop_at, "it went on");
    }
    tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_same_bits(&frame, &render(&device, &scene(), &settings), "after the stops");
}

#[test]
fn an_empty_scene_is_its_background_exactly() {
    let device = TestDevice::open();
    // The default light stands in the middle of the default picture.
    let lights = vec![Light { position: DVec3::new(0.0, 0.0, -5.0), ..Light::default() }];
    for background in [DVec3::new(0.1, 0.2, 0.3), DVec3::ZERO, DVec3::new(1e30, 1.0 / 3.0, 1e-30)] {
        let scene = Scene { background, lights: lights.clone(), ..Scene::default() };
        let frame = render(&device, &scene, &settings());
        let expected = background.as_vec3().to_array();
        assert!(frame.pixels().iter().all(|&pixel| pixel == expected), "{background}");
    }
}

/// The course's box is not seen from inside, but what stands outside is, and the box in its mirror.
#[test]
fn a_camera_inside_of_a_solid_gives_finite_pixels() {
    let device = TestDevice::open();
    for kind in SolidKind::ALL {
        let mut around = Primitive::course_default(kind);
        if let Solid::Cone { apex, .. } = &mut around.solid {
            *apex = DVec3::new(0.0, 0.5, 0.0);
        }
        let mut mirror = Primitive::course_default(SolidKind::Sphere);
        mirror.solid.move_to(DVec3::new(0.0, 0.0, 5.0));
        mirror.material.specular = 0.9;
        let mut scene = Scene { primitives: vec![around, mirror], max_depth: 5, ..Scene::default() };
        scene.camera.position = DVec3::ZERO;
        scene.lights[0].position = DVec3::new(0.0, 4.0, 2.0);
        let frame = render(&device, &scene, &settings());
        assert!(frame.pixels().iter().flatten().all(|value| value.is_finite()), "inside of a {}", kind.name());
    }
}
