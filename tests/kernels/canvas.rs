//! The window's picture without the window: traced a chunk at a time, and the same as a whole render, bit for bit.

use crate::common::{TestDevice, render};
use crate::tracers::Tracers;
use glam::DVec3;
use zerkalo::frame::Frame;
use zerkalo::gpu::{Builds, InFlight, Shader, shaders};
use zerkalo::plan::Plan;
use zerkalo::scene::{Light, Projection, Scene, Solid, gallery};
use zerkalo::settings::RenderSettings;
use zerkalo::settings::sampling::Sampling;
use zerkalo::tracer::{Canvas, Kernel, Precision, Settings, TracerError, limits_of};

/// A canvas with what it is traced on.
struct Easel {
    canvas: Canvas,
    in_flight: InFlight,
    pictures: usize,
    /// Which of each pixel these pictures were.
    samples: Vec<u32>,
}

impl Easel {
    fn new(device: &TestDevice, size: [u32; 2]) -> Self {
        let canvas = Canvas::new(device, Kernel::Course, &Builds::default(), size).unwrap();
        Self { canvas, in_flight: InFlight::new(device, "easel").unwrap(), pictures: 0, samples: Vec::new() }
    }

    /// One submission, as for a frame of the window.
    fn step(&mut self) {
        let place = self.in_flight.wait_for_place().unwrap();
        self.canvas.collect(place).unwrap();
        let canvas = &mut self.canvas;
        self.in_flight
            .run(|recorder| {
                canvas.record(recorder, place)?;
                Ok(())
            })
            .unwrap();
        let finished = self.canvas.take_finished();
        self.pictures += finished.len();
        self.samples.extend(finished.iter().map(|finished| finished.sample));
    }

    /// The picture of a scene, once all of it is traced; and how many submissions it took.
    fn draw(&mut self, scene: &Scene) -> (Frame, usize) {
        self.canvas.show(scene).unwrap();
        let mut steps = 0;
        while self.canvas.is_tracing() {
            self.step();
            steps += 1;
            assert!(steps < 10_000, "it never ends");
        }
        assert!(self.canvas.is_whole() && self.canvas.progress().is_none() && !self.canvas.is_growing());
        (self.shown(), steps)
    }

    fn shown(&mut self) -> Frame {
        self.canvas.read_back(&mut self.in_flight).unwrap()
    }

    /// Bytes uploaded by what is done meanwhile.
    fn uploaded(&mut self, work: impl FnOnce(&mut Self)) -> u64 {
        let before = self.canvas.uploaded_bytes();
        work(self);
        self.canvas.uploaded_bytes() - before
    }
}

fn scene(name: &str) -> Scene {
    gallery::scene(name).unwrap()
}

fn rendered(device: &TestDevice, scene: &Scene, [width, height]: [u32; 2]) -> Frame {
    render(device, scene, &Settings::new(width, height))
}

#[test]
fn its_picture_is_the_tracer_s_bit_for_bit() {
    let device = TestDevice::open();
    for size in [[233, 101], [1, 1], [64, 3], [17, 250]] {
        let mut easel = Easel::new(&device, size);
        for name in ["four", "corridor", "grid-box-30", "showcase"] {
            for projection in Projection::ALL {
                let mut scene = scene(name);
                scene.camera.projection = projection;
                let (frame, _) = easel.draw(&scene);
                assert!(frame == rendered(&device, &scene, size), "{name}, {projection:?}, {size:?}");
            }
        }
    }
}

const ON_DEVICE: [Kernel; 4] =
    [Kernel::Course, Kernel::Plain, Kernel::Whitted(Precision::F32), Kernel::Whitted(Precision::F64)];

fn rendered_by(tracers: &mut Tracers, kernel: Kernel, scene: &Scene, [width, height]: [u32; 2]) -> Frame {
    tracers.draw(scene, &Settings { kernel, ..Settings::new(width, height) })
}

#[test]
fn a_camera_may_fly_down_to_a_planet_and_up_again() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let size = [97, 61];
    let mut easel = Easel::new(&device, size);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/reports/planet.json");
    let mut scene = Scene::load(std::path::Path::new(path)).unwrap();
    let ground = scene.primitives[0].clone();
    scene.primitives = vec![ground];
    scene.lights[0].position.y *= 2.0;
    easel.canvas.use_kernel(Kernel::Whitted(Precision::F32)).unwrap();
    for (height, is_close_up) in [(1e7, false), (2.0, true), (3.0, true), (1e7, false)] {
        scene.camera.position.y = 6.371e6 + height;
        scene.camera.direction.y = if is_close_up { -0.05 } else { -2.0 };
        let space = zerkalo::plan::scene_space(&scene, Kernel::Whitted(Precision::F32));
        assert_eq!(space.is_close_up, is_close_up);
        let (frame, _) = easel.draw(&scene);
        let expected = rendered_by(&mut tracers, Kernel::Whitted(Precision::F32), &scene, size);
        assert!(frame == expected, "at {height}");
    }
}

#[test]
fn every_kernel_s_picture_is_the_tracer_s_bit_for_bit_and_follows_every_edit() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let size = [97, 61];
    let mut easel = Easel::new(&device, size);
    for kernel in ON_DEVICE.into_iter().chain(ON_DEVICE) {
        easel.canvas.use_kernel(kernel).unwrap();
        let mut scene = scene("showcase");
        let mut check = |scene: &Scene, what: &str| {
            let (frame, steps) = easel.draw(scene);
            assert!(steps > 0 && frame == rendered_by(&mut tracers, kernel, scene, size), "{kernel:?}: {what}");
        };
        check(&scene, "as it is");
        scene.camera.position += DVec3::new(0.5, 0.25, -0.5);
        check(&scene, "the camera moved");
        scene.primitives[1].material.color = DVec3::new(1.0, 0.5, 0.25);
        check(&scene, "another colour");
        scene.primitives.truncate(2);
        check(&scene, "kinds gone");
        scene.primitives.extend(gallery::scene("four").unwrap().primitives);
        check(&scene, "kinds come");
        scene.primitives.clear();
        check(&scene, "nothing");
        if kernel != Kernel::Course {
            scene = gallery::scene("four").unwrap();
            scene.lights.push(Light { position: DVec3::new(-3.0, 5.0, -8.0), ..Light::default() });
            check(&scene, "two lights");
        }
    }
}

#[test]
fn another_build_of_the_kernel_that_draws_draws_from_then_on() {
    let device = TestDevice::open();
    let (size, scene) = ([97, 61], scene("showcase"));
    let mut tracers = Tracers::new(&device);
    let [accurate, plain] = [ACCURATE, Kernel::Plain].map(|kernel| rendered_by(&mut tracers, kernel, &scene, size));
    assert!(accurate != plain, "builds are told apart by their pictures");
    let mut easel = Easel::new(&device, size);
    easel.canvas.use_kernel(ACCURATE).unwrap();
    assert!(easel.draw(&scene).0 == accurate);

    let build = |of: &Shader, code: &Shader| of.rebuilt(code.spirv().to_vec()).unwrap();
    assert!(shaders::COURSE.rebuilt(b"no SPIR-V".to_vec()).is_err());
    easel.canvas.replace_shaders([build(&shaders::COURSE, &shaders::COURSE)]).unwrap();
    easel.canvas.replace_shaders([shaders::WHITTED_F32.clone()]).unwrap();
    assert_eq!(easel.draw(&scene).1, 0, "another kernel's build, and the same one: nothing is traced anew");
    easel.canvas.replace_shaders([build(&shaders::WHITTED_F32, &shaders::WHITTED_PLAIN)]).unwrap();
    easel.canvas.replace_shaders([build(&shaders::WHITTED_F32_PACKETS, &shaders::WHITTED_PLAIN_PACKETS)]).unwrap();
    assert!(easel.draw(&scene).0 == plain);
    // It is kept while another kernel draws, and given up for a newer one.
    easel.canvas.use_kernel(Kernel::Course).unwrap();
    easel.draw(&scene);
    easel.canvas.use_kernel(ACCURATE).unwrap();
    assert!(easel.draw(&scene).0 == plain);
    easel.canvas.replace_shaders([&shaders::WHITTED_F32, &shaders::WHITTED_F32_PACKETS].map(Shader::clone)).unwrap();
    assert!(easel.draw(&scene).0 == accurate);
}

#[test]
fn a_build_of_any_pass_draws_from_then_on() {
    let device = TestDevice::open();
    let (size, scene) = ([97, 61], scene("showcase"));
    let mut easel = Easel::new(&device, size);
    easel.canvas.use_kernel(Kernel::Ssr).unwrap();
    assert!(easel.draw(&scene).1 > 0);
    // Another as far as bytes go: its third word says which compiler made it.
    for pass in [&shaders::SSR_DEPTHS, &shaders::SSR_REFLECT] {
        let mut code = pass.spirv().to_vec();
        code[8] ^= 1;
        easel.canvas.replace_shaders([pass.rebuilt(code).unwrap()]).unwrap();
        assert!(easel.draw(&scene).1 > 0, "{}", pass.name);
    }
}

#[test]
fn what_a_setting_leaves_out_the_canvas_leaves_out_as_the_tracer_does() {
    let device = TestDevice::open();
    let size = [97, 61];
    let mut easel = Easel::new(&device, size);
    let limits = limits_of(device.description());
    let plain = RenderSettings { algorithm: zerkalo::algorithm::Algorithm::Plain, ..RenderSettings::default() };
    for setting in [
        RenderSettings { error: 0.1, ..RenderSettings::default() },
        RenderSettings { max_depth: Some(2), boxes: false, ..RenderSettings::default() },
        RenderSettings { error: 0.1, ..plain },
        RenderSettings {
            algorithm: zerkalo::algorithm::Algorithm::Course,
            max_depth: Some(2),
            ..RenderSettings::default()
        },
        RenderSettings::default(),
    ] {
        for name in ["corridor", "grid-sphere-40"] {
            let scene = scene(name);
            let settings = Settings::planned(&Plan::for_scene(&scene, &setting, size, &limits).unwrap());
            easel.canvas.use_kernel(settings.kernel).unwrap();
            easel.canvas.set_settings(settings.clone());
            let (frame, _) = easel.draw(&scene);
            assert!(frame == render(&device, &scene, &settings), "{name}: {setting}");
        }
    }
}

#[test]
fn the_accurate_kernel_neither_traces_nor_uploads_a_scene_unchanged() {
    let device = TestDevice::open();
    let mut easel = Easel::new(&device, [80, 60]);
    assert!(easel.canvas.use_kernel(Kernel::Whitted(Precision::F32)).unwrap());
    assert!(!easel.canvas.use_kernel(Kernel::Whitted(Precision::F32)).unwrap(), "it is the same");
    let scene = scene("four");
    // Rows of four numbers, eight of each kind for one: proxies, records, materials; view, light.
    let rows = 8 * ((1 + 2 + 2 + 2) + (1 + 7 + 4 + 4) + 4 * 2) + (7 + 2);
    assert_eq!(easel.uploaded(|easel| drop(easel.draw(&scene))), rows * 16);
    assert_eq!(easel.uploaded(|easel| assert_eq!(easel.draw(&scene).1, 0)), 0);
}

#[test]
fn a_scene_unchanged_is_not_traced_again() {
    let device = TestDevice::open();
    let mut easel = Easel::new(&device, [160, 120]);
    let scene = scene("four");
    easel.draw(&scene);
    let pictures = easel.pictures;
    let uploaded = easel.uploaded(|easel| assert_eq!(easel.draw(&scene).1, 0, "nothing is submitted"));
    assert_eq!((uploaded, easel.pictures), (0, pictures));

    easel.canvas.trace_again(&scene).unwrap();
    assert!(easel.canvas.is_tracing(), "unless it is asked for");
    let uploaded = easel.uploaded(|easel| assert!(easel.draw(&scene).1 > 0));
    assert_eq!(uploaded, 0);
}

#[test]
fn what_did_not_change_is_not_uploaded() {
    const SPHERE_BYTES: u64 = 48;
    let device = TestDevice::open();
    let size = [160, 120];
    let mut easel = Easel::new(&device, size);
    let mut scene = scene("grid-sphere-50");
    assert_eq!(easel.uploaded(|easel| drop(easel.draw(&scene))), 50 * SPHERE_BYTES);

    scene.camera.position.x += 0.5;
    scene.lights[0].intensity.y = 0.5;
    assert_eq!(easel.uploaded(|easel| drop(easel.draw(&scene))), 0, "camera and light go with every picture");

    scene.primitives[17].material.color = DVec3::new(1.0, 0.5, 0.25);
    assert_eq!(easel.uploaded(|easel| drop(easel.draw(&scene))), SPHERE_BYTES);
    scene.primitives.pop();
    assert_eq!(easel.uploaded(|easel| drop(easel.draw(&scene))), 0, "one fewer is a matter of counting");
    assert!(easel.shown() == rendered(&device, &scene, size));
}

#[test]
fn a_scene_that_the_kernel_refuses_leaves_the_picture() {
    let device = TestDevice::open();
    let mut easel = Easel::new(&device, [90, 70]);
    let good = scene("four");
    let (before, _) = easel.draw(&good);
    let mut bad = good.clone();
    bad.lights.push(Light::default());
    assert!(matches!(easel.canvas.show(&bad), Err(TracerError::Refused(_))));
    assert!(easel.canvas.is_whole() && easel.shown() == before);
    assert_eq!(easel.draw(&good).1, 0, "it shows the good one all the while");
}

#[test]
fn another_size_is_another_picture() {
    let device = TestDevice::open();
    let mut easel = Easel::new(&device, [90, 70]);
    let scene = scene("several");
    easel.draw(&scene);
    for size in [[301, 211], [3, 5], [90, 70]] {
        easel.canvas.resize(&mut easel.in_flight, size).unwrap();
        assert_eq!(easel.canvas.size(), size);
        let uploaded = easel.uploaded(|easel| {
            let (frame, steps) = easel.draw(&scene);
            assert!(steps > 0 && frame == rendered(&device, &scene, size), "{size:?}");
        });
        assert_eq!(uploaded, 0, "the scene is there already");
    }
    easel.canvas.resize(&mut easel.in_flight, [90, 70]).unwrap();
    assert_eq!(easel.draw(&scene).1, 0, "the same size is none");
}

#[test]
fn an_edit_in_the_middle_of_a_picture_ends_in_the_right_one() {
    let device = TestDevice::open();
    // Enough for many chunks, of which the first are small.
    let size = [400, 300];
    let mut easel = Easel::new(&device, size);
    let mut scene = scene("grid-cylinder-20");
    for round in 0..3 {
        easel.canvas.show(&scene).unwrap();
        (0..=round).for_each(|_| easel.step());
        assert!(easel.canvas.is_tracing(), "the picture came too soon for this test");
        let Solid::Cylinder { radius, .. } = &mut scene.primitives[round].solid else { unreachable!() };
        *radius = 0.5;
        scene.camera.position.y += 0.25;
        // Twice: the first of these edits is never begun.
        easel.canvas.show(&scene).unwrap();
        scene.background.x += 0.1;
        let (frame, _) = easel.draw(&scene);
        assert!(frame == rendered(&device, &scene, size), "round {round}");
        easel.canvas.resize(&mut easel.in_flight, [8, 8]).unwrap();
        easel.canvas.resize(&mut easel.in_flight, size).unwrap();
    }
}

#[test]
fn a_picture_from_elsewhere_is_shown_until_a_scene_is() {
    let device = TestDevice::open();
    let size = [75, 45];
    let mut easel = Easel::new(&device, size);
    let scene = scene("four");
    let mut other = Frame::new(size[0], size[1]).unwrap();
    for (i, pixel) in other.pixels_mut().iter_mut().enumerate() {
        *pixel = [i as f32, -0.5, 0.1];
    }
    // Before anything was traced, and after.
    for _ in 0..2 {
        easel.canvas.put(&mut easel.in_flight, &other).unwrap();
        easel.step();
        assert!(easel.shown() == other && easel.canvas.is_whole());
        let (frame, _) = easel.draw(&scene);
        assert!(frame == rendered(&device, &scene, size));
    }
}

#[test]
fn each_picture_s_time_is_told_once() {
    let device = TestDevice::open();
    if !device.description().timestamps {
        return;
    }
    let mut easel = Easel::new(&device, [120, 90]);
    let mut scene = scene("four");
    for count in 1..=5 {
        easel.draw(&scene);
        assert_eq!(easel.pictures, count);
        scene.camera.position.z -= 0.5;
    }
}

const ACCURATE: Kernel = Kernel::Whitted(Precision::F32);

fn sampled(tracers: &mut Tracers, scene: &Scene, [width, height]: [u32; 2], sampling: Sampling) -> Frame {
    let Sampling { samples, scale } = sampling;
    tracers.draw(scene, &Settings { kernel: ACCURATE, samples, scale, ..Settings::new(width, height) })
}

impl Easel {
    /// For the accurate kernel.
    fn sampled(device: &TestDevice, size: [u32; 2], sampling: Sampling) -> Self {
        let mut easel = Self::new(device, size);
        easel.canvas.use_kernel(ACCURATE).unwrap();
        assert!(easel.set(sampling) && !easel.set(sampling), "what is set already is told");
        easel
    }

    fn set(&mut self, sampling: Sampling) -> bool {
        self.canvas.set_sampling(&mut self.in_flight, sampling).unwrap()
    }
}

#[test]
fn samples_are_added_while_nothing_changes_until_all_are_there() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let size = [97, 61];
    let mut scene = scene("showcase");
    for sampling in [Sampling { samples: 5, scale: 1.0 }, Sampling { samples: 3, scale: 0.5 }] {
        let mut easel = Easel::sampled(&device, size, sampling);
        for _ in 0..2 {
            let (frame, _) = easel.draw(&scene);
            assert!(frame == sampled(&mut tracers, &scene, size, sampling), "{sampling:?}");
            let uploaded = easel.uploaded(|easel| assert_eq!(easel.draw(&scene).1, 0, "nothing more is traced"));
            assert_eq!(uploaded, 0);
            scene.camera.position.x += 0.25;
        }
    }
}

#[test]
fn times_tell_which_sample_they_are_of() {
    let device = TestDevice::open();
    if !device.description().timestamps {
        return;
    }
    let mut easel = Easel::sampled(&device, [97, 61], Sampling { samples: 3, scale: 1.0 });
    easel.draw(&scene("showcase"));
    assert_eq!(easel.samples, [0, 1, 2], "the first is a picture, the others are added to it");
}

#[test]
fn a_change_among_the_samples_begins_again_from_the_first() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let (size, sampling) = ([97, 61], Sampling { samples: 6, scale: 1.0 });
    let mut easel = Easel::sampled(&device, size, sampling);
    let mut scene = scene("showcase");
    for round in 0..4 {
        easel.canvas.show(&scene).unwrap();
        while !easel.canvas.is_whole() {
            assert!(!easel.canvas.is_finished());
            easel.step();
        }
        // One sample of each pixel is a picture of the scene already.
        let first = Sampling { samples: 1, ..sampling };
        assert!(round > 0 || easel.shown() == sampled(&mut tracers, &scene, size, first));
        (0..round).for_each(|_| easel.step());
        assert!(!easel.canvas.is_finished() && easel.canvas.progress().is_some_and(|share| share < 1.0));
        scene.camera.position.y += 0.125;
    }
    let (frame, _) = easel.draw(&scene);
    assert!(easel.canvas.is_finished() && frame == sampled(&mut tracers, &scene, size, sampling));
}

#[test]
fn other_samples_and_another_scale_are_another_picture() {
    let device = TestDevice::open();
    let mut tracers = Tracers::new(&device);
    let size = [90, 70];
    let scene = scene("four");
    let mut easel = Easel::sampled(&device, size, Sampling { samples: 4, scale: 1.0 });
    for (samples, scale) in [(4, 1.0), (2, 1.0), (2, 0.25), (1, 0.7), (1, 1.0)] {
        let sampling = Sampling { samples, scale };
        easel.set(sampling);
        let uploaded = easel.uploaded(|easel| {
            let (frame, steps) = easel.draw(&scene);
            assert!(steps > 0 && frame == sampled(&mut tracers, &scene, size, sampling), "{sampling:?}");
        });
        assert!(uploaded == 0 || (samples, scale) == (4, 1.0), "the scene is there already");
        assert_eq!(easel.canvas.size(), size);
    }
    easel.set(Sampling { samples: 1, scale: 0.5 });
    easel.canvas.resize(&mut easel.in_flight, [33, 21]).unwrap();
    assert!(easel.draw(&scene).0 == sampled(&mut tracers, &scene, [33, 21], Sampling { samples: 1, scale: 0.5 }));
    assert!(easel.canvas.set_sampling(&mut easel.in_flight, Sampling { samples: 65, scale: 1.0 }).is_err());

    // A picture from elsewhere is of the canvas's size, and the course kernel knows no other.
    let other = Frame::new(33, 21).unwrap();
    easel.canvas.put(&mut easel.in_flight, &other).unwrap();
    easel.step();
    assert!(easel.shown() == other && easel.canvas.is_finished());
    easel.set(Sampling { samples: 2, scale: 0.5 });
    easel.canvas.use_kernel(Kernel::Course).unwrap();
    assert!(matches!(easel.canvas.show(&scene), Err(TracerError::Refused(_))));
    easel.set(Sampling::PLAIN);
    assert!(easel.draw(&scene).0 == rendered(&device, &scene, [33, 21]));
}
