//! What a scene lacks costs nothing: with the constants of its plan, no way through the kernel's code leads to it.
//!
//! A driver that knows a specialization constant drops the side of a branch that it rules out. This looks at what is
//! left, in the code that drivers are given, and so holds for each of them.

use std::collections::BTreeSet;

use crate::common::TestDevice;
use crate::spirv_walk::{Kernel, Reached};
use glam::DVec3;
use zerkalo::gpu::{Shader, shaders};
use zerkalo::plan::{Features, Limits, Plan, Precision, scene_space};
use zerkalo::scene::{Light, Material, Scene, Solid, SolidKind, gallery};
use zerkalo::settings::RenderSettings;
use zerkalo::tracer::whitted::WhittedRecords;

const SIZE: (u32, u32) = (1621, 701);

/// A hundred solids of each kind with boxes over them, turned cubes and mirrors, and two lights before the camera.
fn all_features() -> Scene {
    let mut scene = gallery::scene("cloud-400").unwrap();
    let camera = &scene.camera;
    let ahead = |distance: f64| Light {
        position: camera.position + camera.direction.normalize() * distance,
        intensity: DVec3::ONE,
        ..Light::default()
    };
    scene.lights = vec![ahead(1.0), ahead(2.0)];
    scene
}

fn without(feature: &str) -> Scene {
    let mut scene = all_features();
    let drop = |scene: &mut Scene, kind: SolidKind| scene.primitives.retain(|primitive| primitive.solid.kind() != kind);
    match feature {
        "spheres" => drop(&mut scene, SolidKind::Sphere),
        "boxes" => drop(&mut scene, SolidKind::Box),
        "cylinders" => drop(&mut scene, SolidKind::Cylinder),
        "cones" => drop(&mut scene, SolidKind::Cone),
        "rotated boxes" => {
            for primitive in &mut scene.primitives {
                if let Solid::Box { rotation_degrees, .. } = &mut primitive.solid {
                    *rotation_degrees = DVec3::ZERO;
                }
            }
        }
        "structures" => {
            let mut left = [20; 4];
            scene.primitives.retain(|primitive| {
                let left = &mut left[primitive.solid.kind() as usize];
                *left -= i32::from(*left > -1);
                *left >= 0
            });
        }
        "light spheres" => scene.lights.iter_mut().for_each(|light| light.position = scene.camera.position * 2.0),
        "several lights" => scene.lights.truncate(1),
        "lights" => scene.lights.clear(),
        "shadows" => scene.primitives.truncate(1),
        "mirrors" => scene.primitives.iter_mut().for_each(|primitive| {
            primitive.material = Material { specular: 0.0, ..primitive.material.clone() };
        }),
        other => panic!("no feature {other}"),
    }
    scene
}

fn reached(device: &TestDevice, kernel: &Kernel, scene: &Scene, precision: Precision) -> Reached {
    let limits = Limits { float64: true, max_array_bytes: 1 << 27, ..Limits::PROMISED };
    let settings = RenderSettings { precision: Some(precision), ..RenderSettings::default() };
    let plan = Plan::for_scene(scene, &settings, [SIZE.0, SIZE.1], &limits).unwrap();
    let records = WhittedRecords::of(
        scene,
        scene_space(scene, zerkalo::algorithm::Kernel::Whitted(precision)),
        precision,
        [SIZE.0, SIZE.1],
    );
    let features = Features::of(&records, plan.kernel.description(), &plan.approximations, plan.generations.choice);
    kernel.reached(&features.constants(device, precision, plan.workgroup.choice).unwrap())
}

/// Functions by the beginning of their names, and arrays, that must be reached with a feature and not without it.
const GONE: [(&str, &[&str]); 11] = [
    ("spheres", &["sphere_rows", "sphere(", "search_sphere(", "key_of_sphere(", "try_eight_sphere("]),
    ("boxes", &["box_rows", "box(", "search_box(", "key_of_box(", "try_eight_box("]),
    ("cylinders", &["cylinder_rows", "cylinder(", "search_cylinder(", "key_of_cylinder("]),
    ("cones", &["cone_rows", "cone(", "search_cone(", "key_of_cone("]),
    ("rotated boxes", &[]),
    ("structures", &["entry_of_box("]),
    ("light spheres", &["may_meet_a_light_sphere(", "light_sphere_ahead("]),
    ("several lights", &[]),
    ("lights", &["light(", "light_sphere_ahead(", "towards(", "direct_radiance(", "is_before("]),
    ("shadows", &["is_before("]),
    ("mirrors", &["mirrored(", "fifth_power("]),
];

fn leaves_nothing_behind(shader: &Shader, precision: Precision) {
    let device = TestDevice::open();
    let kernel = Kernel::of(shader);
    let all = reached(&device, &kernel, &all_features(), precision);
    println!("{}: {} instructions with all features", shader.name, all.instructions);
    for (feature, names) in GONE {
        let left = reached(&device, &kernel, &without(feature), precision);
        println!("without {feature}: {}", left.instructions);
        let beginning = |names: &BTreeSet<String>, name: &str| names.iter().any(|known| known.starts_with(name));
        for name in names {
            assert!(beginning(&all.names, name), "{}: there is no {name}", shader.name);
            assert!(!beginning(&left.names, name), "{}: {name} is left without {feature}", shader.name);
        }
        assert!(left.names.is_subset(&all.names), "{}: more without {feature}", shader.name);
        assert!(left.instructions < all.instructions, "{}: nothing less without {feature}", shader.name);
    }
}

#[test]
fn absent_features_leave_nothing_in_the_f32_kernel() {
    leaves_nothing_behind(&shaders::WHITTED_F32, Precision::F32);
    leaves_nothing_behind(&shaders::WHITTED_F32_PACKETS, Precision::F32);
}

#[test]
fn absent_features_leave_nothing_in_the_f64_kernel() {
    leaves_nothing_behind(&shaders::WHITTED_F64, Precision::F64);
    leaves_nothing_behind(&shaders::WHITTED_F64_PACKETS, Precision::F64);
}

/// What a box's turn is read from, and what walks over lights.
#[test]
fn upright_boxes_read_no_axes_and_one_light_has_no_loop() {
    let device = TestDevice::open();
    let kernel = Kernel::of(&shaders::WHITTED_F32);
    let all = reached(&device, &kernel, &all_features(), Precision::F32);
    let upright = reached(&device, &kernel, &without("rotated boxes"), Precision::F32);
    assert_eq!(all.fetches - upright.fetches, 3, "rows of the axes' errors");
    let one_light = reached(&device, &kernel, &without("several lights"), Precision::F32);
    assert_eq!(all.back_edges - one_light.back_edges, 3, "whether its ball may be met, of its ball, and of its light");
}

#[test]
fn one_sample_a_pixel_reads_no_picture() {
    let device = TestDevice::open();
    let features = Features { kinds: [true; 4], ..Features::default() };
    for shader in [&shaders::WHITTED_F32, &shaders::WHITTED_F32_PACKETS, &shaders::WHITTED_F64] {
        let reached = |samples| {
            let features = Features { samples, ..features };
            Kernel::of(shader).reached(&features.constants(&device, Precision::F32, [8, 8]).unwrap())
        };
        let (one, several) = (reached(false), reached(true));
        let reads = |reached: &Reached| reached.names.iter().any(|name| name.starts_with("mean_before("));
        assert!(!reads(&one) && reads(&several), "{}", shader.name);
        assert!(one.instructions < several.instructions, "{}", shader.name);
    }
}
