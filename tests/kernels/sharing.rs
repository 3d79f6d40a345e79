//! Frames of a changing scene share what did not change: counted in bytes, and the picture is a fresh tracer's, bit for
//! bit.

use std::ops::ControlFlow;

use crate::common::TestDevice;
use crate::scenes::{material, mixed_scene, primitive, sphere};
use glam::DVec3;
use zerkalo::frame::Frame;
use zerkalo::gpu::{Builds, InFlight};
use zerkalo::scene::{Camera, Light, Scene, Solid};
use zerkalo::tracer::{Canvas, Kernel, Precision, Settings, Tracer};

const SIZE: [u32; 2] = [48, 36];

/// A canvas, and a tracer that makes all anew for every picture.
struct Easel {
    canvas: Canvas,
    in_flight: InFlight,
    tracer: Tracer,
    settings: Settings,
}

impl Easel {
    fn new(device: &TestDevice, precision: Precision, scene: &Scene) -> Self {
        let kernel = Kernel::Whitted(precision);
        let settings = Settings { kernel, ..Settings::new(SIZE[0], SIZE[1]) };
        let canvas = Canvas::new(device, kernel, &Builds::default(), SIZE).unwrap();
        let tracer = Tracer::new(device, scene, &settings).unwrap();
        Self { canvas, in_flight: InFlight::new(device, "easel").unwrap(), tracer, settings }
    }

    /// Bytes uploaded for a picture of the scene, which is checked.
    fn draw(&mut self, scene: &Scene) -> u64 {
        let before = self.canvas.uploaded_bytes();
        self.canvas.show(scene).unwrap();
        self.step_to_the_end();
        let shown = self.canvas.read_back(&mut self.in_flight).unwrap();
        assert!(shown == self.fresh(scene), "it is not the tracer's picture");
        self.canvas.uploaded_bytes() - before
    }

    fn step_to_the_end(&mut self) {
        while self.canvas.is_tracing() {
            let place = self.in_flight.wait_for_place().unwrap();
            self.canvas.collect(place).unwrap();
            let canvas = &mut self.canvas;
            self.in_flight
                .run(|recorder| {
                    canvas.record(recorder, place)?;
                    canvas.take_finished();
                    Ok(())
                })
                .unwrap();
            self.canvas.forget_dropped(&mut self.in_flight);
        }
    }

    fn fresh(&mut self, scene: &Scene) -> Frame {
        self.tracer.set_scene(scene, &self.settings).unwrap();
        let mut frame = self.tracer.frame().unwrap();
        self.tracer.render(&mut frame, &mut |_| ControlFlow::Continue(())).unwrap();
        frame
    }
}

/// 1000 spheres, about half of the space between them free, as seen from just outside.
fn thousand_spheres() -> Scene {
    let place = |i: u32| DVec3::new(f64::from(i % 10), f64::from(i / 10 % 10), f64::from(i / 100)) - DVec3::splat(4.6);
    let ball = |i: u32| {
        let sway = DVec3::new(0.1, -0.07, 0.13) * f64::from(i * 37 % 19) / 19.0;
        primitive(sphere(place(i) + sway, 0.3), material(0.2, 0.5, 0.3))
    };
    Scene {
        camera: Camera { position: DVec3::new(0.3, 0.4, -7.1), direction: DVec3::Z, ..Camera::default() },
        lights: vec![Light { position: DVec3::new(-9.0, 14.0, -12.0), ..Light::default() }],
        primitives: (0..1000).map(ball).collect(),
        max_depth: 3,
        ..Scene::default()
    }
}

/// A row of four numbers.
fn row_bytes(precision: Precision) -> u64 {
    match precision {
        Precision::F32 => 16,
        Precision::F64 => 32,
    }
}

const PRECISIONS: [Precision; 2] = [Precision::F32, Precision::F64];

/// Of the search, which is in `f32` whatever the kernel's precision.
const PROXY_BYTES: u64 = 16;
const BOX_BYTES: u64 = 32;

#[test]
fn a_scene_unchanged_uploads_nothing_even_where_it_is_traced_again() {
    let device = TestDevice::open();
    let scene = mixed_scene();
    for precision in PRECISIONS {
        let mut easel = Easel::new(&device, precision, &scene);
        assert!(easel.draw(&scene) > 0);
        let before = easel.canvas.uploaded_bytes();
        easel.canvas.trace_again(&scene).unwrap();
        assert!(easel.canvas.is_tracing());
        easel.step_to_the_end();
        assert_eq!(easel.canvas.uploaded_bytes(), before);
        assert_eq!(easel.draw(&scene), 0);
    }
}

#[test]
fn a_moved_camera_uploads_itself_alone() {
    let device = TestDevice::open();
    for precision in PRECISIONS {
        for mut scene in [mixed_scene(), thousand_spheres()] {
            let mut easel = Easel::new(&device, precision, &scene);
            easel.draw(&scene);
            for step in 1..=4 {
                let step = f64::from(step);
                scene.camera.position += DVec3::new(0.123, -0.0456, 0.0789) / step;
                scene.camera.direction = DVec3::new(0.02 * step, 0.013, 1.0);
                scene.camera.up = DVec3::new(0.05, 1.0, -0.03 * step);
                let uploaded = easel.draw(&scene);
                // Position with its error, and three unit vectors.
                assert!((1..=15 * row_bytes(precision) / 4).contains(&uploaded), "{uploaded} B");
                assert!(uploaded <= 128);
            }
            scene.camera.vertical_fov_degrees *= 0.9;
            assert_eq!(easel.draw(&scene), 2 * row_bytes(precision) / 4, "the window's half sides");
        }
    }
}

#[test]
fn an_edited_primitive_uploads_its_rows_and_the_boxes_over_it() {
    // 1000 spheres in 125 boxes, and these in 16.
    const LEVELS: u64 = 2;
    let device = TestDevice::open();
    for precision in PRECISIONS {
        let mut scene = thousand_spheres();
        let row = row_bytes(precision);
        let mut easel = Easel::new(&device, precision, &scene);
        let all = easel.draw(&scene);
        assert!(all > 64_000);

        scene.primitives[345].material.color = DVec3::new(1.0, 0.5, 0.25);
        assert_eq!(easel.draw(&scene), row);
        scene.primitives[345].material = material(0.3, 0.4, 0.2);
        assert_eq!(easel.draw(&scene), 2 * row);

        let own = row + PROXY_BYTES;
        for index in [345, 0, 999, 500] {
            let Solid::Sphere { center, radius } = &mut scene.primitives[index].solid else { unreachable!() };
            *center += DVec3::new(0.04, -0.03, 0.05);
            *radius *= 1.1;
            let uploaded = easel.draw(&scene);
            assert!((own..=own + LEVELS * BOX_BYTES).contains(&uploaded), "sphere {index}: {uploaded} B");
        }
        scene.lights[0].intensity.y *= 0.5;
        assert_eq!(easel.draw(&scene), row / 4);
    }
}

#[test]
fn solids_that_wander_off_are_put_in_another_order_in_the_end() {
    let device = TestDevice::open();
    let mut scene = thousand_spheres();
    let mut easel = Easel::new(&device, Precision::F32, &scene);
    easel.draw(&scene);
    let mut orders = 0;
    for step in 0..60_u32 {
        // From all over the cloud to all over it, within its bounds.
        let target = DVec3::new(f64::from(step * 7 % 9), f64::from(step * 5 % 8), f64::from(step * 3 % 7)) - 4.0;
        let Solid::Sphere { center, .. } = &mut scene.primitives[(step * 337 % 1000) as usize].solid else {
            unreachable!()
        };
        *center = target;
        let uploaded = easel.draw(&scene);
        // Of each level one box, and where its group's axis is another, that of all eight.
        let most = 16 + PROXY_BYTES + 2 * (BOX_BYTES + 7 * 16);
        assert!(uploaded <= most || uploaded > 10 * most, "{uploaded} B");
        orders += u32::from(uploaded > most);
    }
    assert!((1..20).contains(&orders), "{orders} new orders");
    assert_eq!(easel.draw(&scene), 0);
}

#[test]
fn what_comes_goes_or_turns_into_another_kind_is_drawn() {
    let device = TestDevice::open();
    for precision in PRECISIONS {
        let mut scene = mixed_scene();
        let mut easel = Easel::new(&device, precision, &scene);
        easel.draw(&scene);
        scene.primitives.swap(0, 5);
        easel.draw(&scene);
        let last = scene.primitives.pop().unwrap();
        easel.draw(&scene);
        scene.primitives.push(last);
        easel.draw(&scene);
        scene.primitives[3].solid = sphere(DVec3::new(0.5, 0.25, -1.0), 0.5);
        easel.draw(&scene);
        scene.primitives[3].material = material(0.0, 1.0, 0.0);
        scene.max_depth = 1;
        easel.draw(&scene);
        scene.lights.pop();
        easel.draw(&scene);
        // A camera so far away that the frame is another.
        scene.camera.position *= 100.0;
        easel.draw(&scene);
    }
}
