//! What a plan decides, and that it says why.

use std::ops::ControlFlow;

use crate::scenes::{cube, light, material, mirror, mixed_scene, primitive, scene_of_a_light, sphere};
use glam::DVec3;
use zerkalo::algorithm::{Algorithm, Kernel};
use zerkalo::plan::{
    Area, Features, LightFeatures, Limits, Media, Plan, PlanError, Precision, Reason, Structure, scene_space,
};
use zerkalo::reference::{self, LIGHT_SPHERE};
use zerkalo::scene::{Camera, Light, Material, Scene, Solid, SolidKind, gallery};
use zerkalo::settings::RenderSettings;
use zerkalo::tracer::Settings;
use zerkalo::tracer::whitted::WhittedRecords;

const DEVICE: Limits = Limits { float64: true, max_array_bytes: 1 << 27, max_image_side: 16384, packets: true };

fn exact(scene: &Scene) -> Plan {
    Plan::for_scene(scene, &RenderSettings::default(), [1621, 701], &DEVICE).unwrap()
}

fn within(scene: &Scene, error: f64) -> Plan {
    Plan::for_scene(scene, &RenderSettings { error, ..RenderSettings::default() }, [1621, 701], &DEVICE).unwrap()
}

/// Seen from z = −8, lit by one light.
fn scene_of(solids: Vec<(Solid, Material)>) -> Scene {
    let primitives = solids.into_iter().map(|(solid, material)| primitive(solid, material)).collect();
    let camera = Camera { position: DVec3::NEG_Z * 8.0, ..Camera::default() };
    Scene { camera, lights: vec![light(3.0, 5.0, -9.0)], primitives, ..Scene::default() }
}

fn two_balls(material: Material) -> Scene {
    scene_of(vec![(sphere(DVec3::X, 1.0), material.clone()), (sphere(DVec3::NEG_X * 2.0, 1.0), material)])
}

fn room(material: Material) -> Scene {
    let mut scene = scene_of(vec![(cube(DVec3::ZERO, 10.0), material.clone()), (sphere(DVec3::X, 1.0), material)]);
    scene.max_depth = 200;
    scene
}

#[test]
fn kinds_are_counted_and_those_that_are_absent_are_left_out() {
    let plan = exact(&mixed_scene());
    assert_eq!(plan.counts, [2; 4]);
    let plan = exact(&two_balls(mirror()));
    assert_eq!(plan.counts, [2, 0, 0, 0]);
    let lines = plan.lines();
    for kind in ["boxes", "cylinders", "cones"] {
        let line = lines.iter().find(|line| line.what == kind).unwrap();
        assert_eq!((line.choice.as_str(), line.saves.is_some()), ("none", true), "{line:?}");
    }
}

#[test]
fn a_scene_of_nothing_traces_one_generation_without_light() {
    let plan = exact(&Scene::default());
    assert_eq!((plan.lights.choice, plan.lights.reason), (0, Reason::NoSolids));
    assert_eq!((plan.generations.choice, plan.generations.reason), (1, Reason::NoSolids));
    assert!(!plan.shadows.choice && !plan.highlights.choice);
}

/// As the reference's pictures show, from any camera and by either window.
#[test]
fn balls_out_of_sight_are_those_that_no_picture_shows() {
    let (mut seen, mut narrow) = (0, 0);
    for index in 0..400 {
        let scene = scene_of_a_light(index);
        let (width, height) = (64, 28);
        let plan = Plan::for_scene(&scene, &RenderSettings::default(), [width, height], &DEVICE).unwrap();
        let image = reference::render(&scene, width, height, &|_| ControlFlow::Continue(())).unwrap();
        let shown = (0..).zip(&image.pixels).filter(|(_, pixel)| pixel.first_hit == LIGHT_SPHERE);
        let shown: Vec<[u32; 2]> = shown.map(|(i, _)| [i % width, i / width]).collect();
        assert!(plan.light_spheres.choice == 1 || shown.is_empty(), "{scene:?}");
        assert_eq!(plan.approximations.light_spheres, plan.light_spheres.choice > 0);
        let Some(area) = Area::of_light_spheres(&scene, f64::from(width) / f64::from(height), 0.0) else {
            assert_eq!(plan.light_spheres.choice, 0);
            continue;
        };
        let area = area.pixels([width, height]);
        let is_in = |pixel: &[u32; 2]| (0..2).all(|axis| area[axis].contains(&pixel[axis]));
        assert!(shown.iter().all(is_in), "{area:?}: {scene:?}");
        // A ball between the edges ends within a pixel of its outermost centres, and the area a pixel beyond that.
        let end = |axis: usize| shown.iter().map(|pixel| pixel[axis] + 1).max().unwrap_or_default();
        let start = |axis: usize| shown.iter().map(|pixel| pixel[axis]).min().unwrap_or_default();
        if (0..2).all(|axis| start(axis) > 0 && end(axis) < [width, height][axis]) {
            let is_narrow = |axis: usize| start(axis) - area[axis].start <= 2 && area[axis].end - end(axis) <= 2;
            assert!(is_narrow(0) && is_narrow(1), "{area:?}: {scene:?}");
            narrow += 1;
        }
        seen += usize::from(!shown.is_empty());
    }
    assert!((50..350).contains(&seen) && narrow > 20, "{seen} and {narrow} of 400 are a poor choice");
}

#[test]
fn lights_matter_where_some_surface_sends_some_of_them_back() {
    let plan = exact(&two_balls(material(0.1, 0.5, 0.0)));
    assert_eq!((plan.lights.choice, plan.lights.reason), (1, Reason::LightsMatter { lights: 1, dark: 0 }));

    let mut none = two_balls(material(0.1, 0.5, 0.5));
    none.lights.clear();
    assert_eq!((exact(&none).lights.choice, exact(&none).lights.reason), (0, Reason::NoLights));

    let mut dark = two_balls(material(0.1, 0.5, 0.5));
    dark.lights.push(Light { intensity: DVec3::ZERO, ..light(0.0, 2.0, 0.0) });
    let plan = exact(&dark);
    let seen = Reason::LightSpheresInSight { lights: 2, seen: 1 };
    assert_eq!(
        (plan.light_spheres.choice, plan.light_spheres.reason),
        (1, seen),
        "a dark ball is still seen, one behind the camera is not"
    );
    assert_eq!((plan.lights.choice, plan.lights.reason), (1, Reason::LightsMatter { lights: 2, dark: 1 }));

    let black = exact(&two_balls(material(0.7, 0.0, 0.0)));
    assert_eq!((black.lights.choice, black.lights.reason), (0, Reason::NothingTakesLight { lights: 1 }));
    assert_eq!((black.shadows.choice, black.shadows.reason), (false, Reason::NothingIsLit));

    // Red light on surfaces that send back only blue.
    let mut red = two_balls(Material { color: DVec3::Z, ..material(0.1, 0.5, 0.0) });
    red.lights[0].intensity = DVec3::X;
    assert_eq!(exact(&red).lights.choice, 0);
}

#[test]
fn one_convex_solid_casts_no_shadow_on_itself_seen_from_outside() {
    let turned = Solid::Box { center: DVec3::X, half_size: DVec3::ONE, rotation_degrees: DVec3::new(10.0, 20.0, 30.0) };
    let slanted = DVec3::new(0.48, 0.6, 0.64);
    let solids = [
        sphere(DVec3::X, 1.0),
        turned,
        Solid::Cylinder { ends: [-2.0 * slanted, slanted], radius: 0.5 },
        Solid::Cone { apex: DVec3::Y, axis: slanted, height: 2.0, half_angle_degrees: 30.0 },
    ];
    for solid in solids {
        let scene = scene_of(vec![(solid.clone(), material(0.1, 0.5, 0.5))]);
        let plan = exact(&scene);
        assert_eq!((plan.shadows.choice, plan.shadows.reason), (false, Reason::LoneSolidShadowsNothing), "{solid:?}");
        assert_eq!(plan.generations.choice, 2, "it mirrors the background");
        let mut inside = scene.clone();
        inside.camera.position = match solid {
            Solid::Cone { apex, axis, height, .. } => apex + 0.5 * height * axis,
            ref solid => solid.position(),
        };
        assert!(exact(&inside).shadows.choice, "from inside the solid hides a light outside: {solid:?}");
        assert_eq!(exact(&inside).generations.choice, 20);
        let mut two = scene.clone();
        two.primitives.push(primitive(sphere(DVec3::Y * 50.0, 1.0), mirror()));
        assert!(exact(&two).shadows.choice);
    }
    // On the surface, to the rounding of a kernel.
    let mut on = scene_of(vec![(sphere(DVec3::ZERO, 1.0), material(0.1, 0.5, 0.5))]);
    on.camera.position = DVec3::NEG_Z * (1.0 + 1e-6);
    assert!(exact(&on).shadows.choice);
}

#[test]
fn highlights_need_a_specular_material_and_a_light() {
    let plan = exact(&two_balls(material(0.1, 0.5, 0.2)));
    assert_eq!((plan.highlights.choice, plan.highlights.reason), (true, Reason::SomethingIsSpecular));
    let plan = exact(&two_balls(material(0.1, 0.5, 0.0)));
    assert_eq!((plan.highlights.choice, plan.highlights.reason), (false, Reason::NothingIsSpecular));
    assert!(plan.lines().iter().any(|line| line.what == "highlights" && line.saves.is_some()));
}

#[test]
fn generations_are_those_that_can_add_light() {
    let specular = two_balls(material(0.1, 0.5, 0.2));
    assert_eq!((exact(&specular).generations.choice, exact(&specular).generations.reason), (20, Reason::SceneSays));
    let asked = RenderSettings { max_depth: Some(7), ..RenderSettings::default() };
    let plan = Plan::for_scene(&specular, &asked, [8, 8], &DEVICE).unwrap();
    assert_eq!((plan.generations.choice, plan.generations.reason), (7, Reason::Asked));

    let matt = exact(&two_balls(material(0.1, 0.5, 0.0)));
    assert_eq!((matt.generations.choice, matt.generations.reason), (1, Reason::NothingIsSpecular));
    let mut flat = two_balls(material(0.1, 0.5, 0.0));
    flat.max_depth = 1;
    assert_eq!(exact(&flat).generations.reason, Reason::SceneSays, "nothing is saved there");

    let mut black = two_balls(mirror());
    (black.background, black.lights) = (DVec3::ZERO, vec![]);
    assert_eq!((exact(&black).generations.choice, exact(&black).generations.reason), (1, Reason::ReflectionsAreBlack));

    let mut lone = scene_of(vec![(sphere(DVec3::ZERO, 1.0), material(0.1, 0.5, 0.5))]);
    assert_eq!(exact(&lone).generations.reason, Reason::LoneSolidMirrorsBackground);
    lone.background = DVec3::ZERO;
    assert_eq!((exact(&lone).generations.choice, exact(&lone).generations.reason), (1, Reason::ReflectionsAreBlack));
}

#[test]
fn boxes_are_upright_unless_one_is_turned() {
    let plain = material(0.1, 0.5, 0.0);
    assert_eq!(exact(&two_balls(plain.clone())).axis_aligned_boxes.reason, Reason::NoBoxes);
    let mut boxes = scene_of(vec![(cube(DVec3::ZERO, 1.0), plain.clone()), (cube(DVec3::X * 3.0, 1.0), plain.clone())]);
    assert_eq!(
        (exact(&boxes).axis_aligned_boxes.choice, exact(&boxes).axis_aligned_boxes.reason),
        (true, Reason::NoBoxRotated)
    );
    let turn_by = |scene: &mut Scene, degrees: DVec3| {
        if let Solid::Box { rotation_degrees, .. } = &mut scene.primitives[1].solid {
            *rotation_degrees = degrees;
        }
    };
    turn_by(&mut boxes, DVec3::new(360.0, -720.0, 0.0));
    assert!(exact(&boxes).axis_aligned_boxes.choice, "a whole turn is none");
    turn_by(&mut boxes, DVec3::new(0.0, 1e-9, 0.0));
    let plan = exact(&boxes);
    assert!(!plan.axis_aligned_boxes.choice);
    assert_eq!(plan.axis_aligned_boxes.reason, Reason::BoxesRotated { boxes: 2, rotated: 1 });
}

#[test]
fn a_precision_asked_for_is_taken_or_refused() {
    let scene = mixed_scene();
    for precision in [Precision::F32, Precision::F64] {
        let settings = RenderSettings { precision: Some(precision), error: 1e-5, ..RenderSettings::default() };
        let plan = Plan::for_scene(&scene, &settings, [8, 8], &DEVICE).unwrap();
        assert_eq!((plan.precision.choice, plan.precision.reason), (precision, Reason::Asked));
    }
    let settings = RenderSettings { precision: Some(Precision::F64), ..RenderSettings::default() };
    assert_eq!(Plan::for_scene(&scene, &settings, [8, 8], &Limits::PROMISED), Err(PlanError::NoFloat64));
}

#[test]
fn f64_is_chosen_where_f32_is_not_known_to_keep_the_error() {
    let scene = mixed_scene();
    let precision = |scene: &Scene, error| within(scene, error).precision;
    // Spheres that mirror each other may magnify what rounding does: pixels are tried.
    assert!(matches!(exact(&scene).precision.reason, Reason::RoundingIsHarmless { .. }));
    assert_eq!(exact(&scene).precision.choice, Precision::F32);
    let dull = Scene { max_depth: 1, ..scene.clone() };
    assert!(matches!(exact(&dull).precision.reason, Reason::RoundingIsNoCut { .. }));

    let enough = precision(&scene, 1.0 / 510.0);
    assert_eq!(enough.choice, Precision::F32);
    let Reason::RoundingIsWithinError { shift_pixels, .. } = enough.reason else { panic!("{enough:?}") };
    assert!(shift_pixels > 0.0 && shift_pixels < 0.01, "{shift_pixels}");

    let finer = precision(&scene, 1.0 / 511.0);
    assert_eq!((finer.choice, finer.reason), (Precision::F64, Reason::RoundingExceedsError { tolerance: 1.0 / 510.0 }));
    let mut bright = scene.clone();
    bright.lights[0].intensity = DVec3::splat(10.0);
    assert_eq!(precision(&bright, 1.0 / 510.0).choice, Precision::F64, "rounding grows with the light");

    // A pixel is an angle of 1e-9 there: less than f32 knows a direction by.
    let mut narrow = scene.clone();
    narrow.camera.vertical_fov_degrees = 1e-4;
    let narrow = precision(&narrow, 1.0 / 510.0);
    assert_eq!(narrow.choice, Precision::F64);
    assert!(matches!(narrow.reason, Reason::RoundingMovesSilhouettes { shift_pixels } if shift_pixels > 0.5));

    let poor = RenderSettings { error: 1e-4, ..RenderSettings::default() };
    let poor = Plan::for_scene(&scene, &poor, [1621, 701], &Limits::PROMISED).unwrap().precision;
    assert!(poor.choice == Precision::F32 && matches!(poor.reason, Reason::NoFloat64 { .. }));
}

#[test]
fn few_solids_are_tried_one_by_one_in_small_workgroups_and_tiles_fit_the_device() {
    let plan = exact(&mixed_scene());
    assert_eq!((plan.structures.choice, plan.workgroup.choice), ([Structure::None; 4], [8, 8]));
    let tile = |limits: &Limits, scene: &Scene| {
        Plan::for_scene(scene, &RenderSettings::default(), [4000, 4000], limits).unwrap().tile_side
    };
    let few = two_balls(material(0.1, 0.5, 0.0));
    assert_eq!((tile(&DEVICE, &few).choice, tile(&DEVICE, &few).reason), (1024, Reason::LightTiles));
    assert_eq!(tile(&Limits { max_image_side: 512, ..DEVICE }, &few).choice, 512);
    let grid = gallery::scene("grid-sphere-100").unwrap();
    assert_eq!((tile(&DEVICE, &grid).choice, tile(&DEVICE, &grid).reason), (256, Reason::HeavyTiles { largest: 1024 }));
    let [some, many] = ["cloud-sphere-128", "cloud-sphere-10000"].map(|name| gallery::scene(name).unwrap());
    assert_eq!(tile(&DEVICE, &some).choice, tile(&DEVICE, &many).choice, "boxes keep rays from most of them");
}

#[test]
fn a_scene_fits_the_device_exactly_where_the_kernels_records_do() {
    let mut scene = gallery::scene("grid-sphere-100").unwrap();
    scene.primitives.extend(mixed_scene().primitives);
    let planet = primitive(Solid::Sphere { center: DVec3::Y * -1e9, radius: 1e9 }, Material::default());
    // The last scene, in f32, as a close-up.
    let added = SolidKind::ALL.map(zerkalo::scene::Primitive::course_default).into_iter().chain([planet]);
    for primitive in added {
        scene.primitives.push(primitive);
        for precision in [Precision::F32, Precision::F64] {
            let row_bytes = if precision == Precision::F32 { 16 } else { 32 };
            let records =
                WhittedRecords::of(&scene, scene_space(&scene, Kernel::Whitted(precision)), precision, [8, 8]);
            let proxies = records.solids.proxies.len() as u64 * 16;
            let own = records.buffers().map(|(_, rows)| rows.len() as u64 * row_bytes);
            let largest = own.into_iter().chain([proxies]).max().unwrap();
            let settings = RenderSettings { precision: Some(precision), ..RenderSettings::default() };
            let fits =
                |max_array_bytes| Plan::for_scene(&scene, &settings, [8, 8], &Limits { max_array_bytes, ..DEVICE });
            assert!(fits(largest).is_ok());
            let error = fits(largest - 1).unwrap_err();
            assert!(matches!(error, PlanError::TooLarge { bytes, .. } if bytes == largest), "{error}");
        }
    }
}

#[test]
fn senseless_settings_are_refused_in_one_line() {
    let scene = mixed_scene();
    let exact = RenderSettings::default();
    let refused = [
        (RenderSettings { error: f64::NAN, ..exact }, [8, 8]),
        (RenderSettings { error: -1e-3, ..exact }, [8, 8]),
        (RenderSettings { error: f64::INFINITY, ..exact }, [8, 8]),
        (RenderSettings { max_depth: Some(0), ..exact }, [8, 8]),
        (RenderSettings { max_depth: Some(1001), ..exact }, [8, 8]),
        (RenderSettings { algorithm: Algorithm::Course, error: 0.1, ..exact }, [8, 8]),
        (RenderSettings { algorithm: Algorithm::Reference, ..exact }, [8, 8]),
        (exact, [0, 8]),
    ];
    for (settings, size) in refused {
        let error = Plan::for_scene(&scene, &settings, size, &DEVICE).unwrap_err().to_string();
        assert!(!error.contains('\n') && !error.is_empty(), "{error}");
    }
}

#[test]
fn every_algorithm_is_planned_as_far_as_it_goes() {
    let scene = gallery::scene("corridor").unwrap();
    let plan = |settings: &RenderSettings| Plan::for_scene(&scene, settings, [64, 28], &DEVICE).unwrap();
    let exact = plan(&RenderSettings::default());
    assert_eq!((exact.kernel, exact.bounds.total()), (Kernel::Whitted(Precision::F32), 0.0));
    for algorithm in [Algorithm::Plain, Algorithm::Whitted] {
        let cut = plan(&RenderSettings {
            algorithm,
            precision: Some(Precision::F32),
            error: 0.01,
            ..RenderSettings::default()
        });
        assert!(cut.bounds.total() > 0.0 && cut.bounds.total() <= 0.01);
        assert_ne!(cut.approximations, exact.approximations);
        assert_eq!(cut.kernel.algorithm(), algorithm);
    }
    let course = RenderSettings { algorithm: Algorithm::Course, max_depth: Some(3), ..RenderSettings::default() };
    let course = plan(&course);
    let expected = Settings { max_depth: Some(3), ..Settings::new(64, 28) };
    assert_eq!(Settings { max_tile_side: 1024, ..Settings::planned(&course) }, expected);
    assert_eq!(course.structures.reason, Reason::NoHierarchy);
    let brute = plan(&RenderSettings { boxes: false, ..RenderSettings::default() });
    assert_eq!((brute.structures.choice, brute.structures.reason), ([Structure::None; 4], Reason::Asked));
}

#[test]
fn without_an_error_nothing_is_cut() {
    for entry in gallery::entries() {
        let plan = exact(&gallery::scene(&entry.name).unwrap());
        assert_eq!(plan.bounds.total(), 0.0);
        assert_eq!((plan.approximations.min_throughput, plan.approximations.min_shadowed), (0.0, 0.0));
        assert_eq!(plan.approximations.highlights, plan.highlights.choice);
    }
}

#[test]
fn a_closed_room_is_cut_where_its_paths_have_faded() {
    let scene = room(material(0.1, 0.1, 0.8));
    let plan = within(&scene, 1.0 / 510.0);
    // 0.8³⁷ ≈ 2.6e-4 of at most 0.14 + 0.8 more a generation, five times that in all.
    assert!((30..=42).contains(&plan.generations.choice), "{:?}", plan.generations);
    assert!(matches!(plan.generations.reason, Reason::PathsFade { of: 200, .. }));
    assert!(plan.bounds.generations > 0.0 && plan.bounds.shadows > 0.0 && plan.bounds.total() <= 1.0 / 510.0);

    let perfect = within(&room(mirror()), 1.0 / 510.0);
    assert_eq!((perfect.approximations.min_throughput, perfect.generations.choice), (0.0, 200), "its paths never fade");
    assert!(perfect.bounds.total() <= 1.0 / 510.0);
}

#[test]
fn a_larger_error_cuts_no_less() {
    let scene = room(material(0.1, 0.3, 0.5));
    let mut last = within(&scene, 1e-12);
    for error in [1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.5] {
        let plan = within(&scene, error);
        assert!(plan.generations.choice <= last.generations.choice, "{error}");
        assert!(plan.approximations.min_throughput >= last.approximations.min_throughput, "{error}");
        assert!(plan.bounds.total() <= error && plan.bounds.total() > 0.3 * error, "{:?} of {error}", plan.bounds);
        last = plan;
    }
}

#[test]
fn highlights_go_where_all_of_them_fit_in_the_error() {
    let faint = two_balls(material(0.1, 0.5, 1e-4));
    let plan = within(&faint, 1.0 / 510.0);
    assert!(!plan.highlights.choice && !plan.approximations.highlights);
    assert!(matches!(plan.highlights.reason, Reason::HighlightsAreFaint { bound } if bound == plan.bounds.highlights));
    assert!(within(&two_balls(material(0.1, 0.5, 0.1)), 1.0 / 510.0).highlights.choice);
    assert_eq!(plan.generations.choice, 1, "and so does what is mirrored");
}

#[test]
fn the_primary_ray_is_never_cut_however_large_the_error() {
    let plan = within(&mixed_scene(), 1e30);
    assert!(plan.approximations.min_throughput < 1.0);
    assert_eq!(plan.generations.choice, 1);
    assert_eq!(plan.approximations.min_shadowed, f32::MAX, "no shadow ray is traced");
    assert!(plan.bounds.total() <= 1e30);
}

#[test]
fn cuts_smaller_than_an_f32_can_say_are_not_made() {
    let mut scene = room(material(0.1, 0.3, 0.5));
    scene.lights[0].intensity = DVec3::splat(3e38);
    let plan = within(&scene, 1e-3);
    assert_eq!((plan.approximations.min_throughput, plan.bounds.generations), (0.0, 0.0));
    assert!(plan.bounds.total() <= 1e-3);
}

#[test]
fn every_line_is_one_and_says_why() {
    let mut scenes: Vec<Scene> = gallery::entries().iter().map(|entry| gallery::scene(&entry.name).unwrap()).collect();
    scenes.extend([Scene::default(), room(mirror()), two_balls(material(0.0, 0.0, 0.0))]);
    for scene in scenes {
        for error in [0.0, 1e-4, 0.1] {
            for line in within(&scene, error).lines() {
                let texts = [&line.choice, &line.why, line.saves.as_ref().unwrap_or(&line.why)];
                assert!(texts.iter().all(|text| !text.is_empty() && !text.contains('\n')), "{line:?}");
            }
        }
    }
}

#[test]
fn a_hierarchy_has_few_boxes_on_top_and_no_more_levels_than_the_kernel_goes_down() {
    assert_eq!(Structure::over(32), Structure::None);
    assert_eq!(Structure::over(33), Structure::Hierarchy { levels: 1 });
    // One level alone has two groups of boxes at most, more levels have four on top.
    assert_eq!(Structure::over(128), Structure::Hierarchy { levels: 1 });
    assert_eq!(Structure::over(129), Structure::Hierarchy { levels: 2 });
    assert_eq!(Structure::over(2048), Structure::Hierarchy { levels: 2 });
    assert_eq!(Structure::over(1_000_000), Structure::Hierarchy { levels: 5 });
    let most = zerkalo::scene::PRIMITIVE_LIMIT;
    assert_eq!(Structure::over(most), Structure::Hierarchy { levels: Structure::MOST_LEVELS });
    assert!(most.div_ceil(Structure::GROUP.pow(Structure::MOST_LEVELS)) <= 64);
}

/// Of all kinds, sizes and materials, lit by bright and dark lights.
fn any_scene(random: &mut crate::random::Random) -> Scene {
    let some = |random: &mut crate::random::Random, most: u64| random.bits() % (most + 1);
    let most = if random.chance(0.1) { 200 } else { 6 };
    let spread = if random.chance(0.2) { 20.0 } else { 0.3 };
    let rare = |random: &mut crate::random::Random, value: f64| if random.chance(0.3) { 0.0 } else { value };
    let primitives = (0..some(random, most)).map(|_| {
        let center = random.vector(|random| random.uniform(-9.0, 9.0));
        let size = random.magnitude(-spread, 0.3);
        let solid = match random.bits() % 4 {
            0 => sphere(center, size),
            1 => {
                let quarter = 90.0 * some(random, 4) as f64;
                let angle = if random.chance(0.5) { quarter } else { random.uniform(-180.0, 180.0) };
                Solid::Box { center, half_size: DVec3::splat(size), rotation_degrees: DVec3::Y * angle }
            }
            2 => Solid::Cylinder { ends: [center, center + DVec3::Y * size], radius: size },
            _ => Solid::Cone { apex: center, axis: DVec3::Y, height: size, half_angle_degrees: 30.0 },
        };
        let [specular, diffuse] = [0, 1].map(|_| if random.chance(0.3) { 0.0 } else { random.uniform(0.0, 1.0) });
        let mut material = material(0.1, diffuse, specular);
        if random.chance(0.1) {
            material.transmission = random.uniform(0.0, 1.0);
        }
        if random.chance(0.1) {
            material.shininess = random.uniform(1.0, 1024.0);
        }
        primitive(solid, material)
    });
    let primitives = primitives.collect();
    let lights = (0..some(random, 3)).map(|_| {
        let position = random.vector(|random| random.uniform(-12.0, 12.0));
        let intensity = DVec3::splat(rare(random, 0.8));
        let distance_constant = random.chance(0.2).then(|| random.magnitude(-3.0, 3.0));
        Light { position, intensity, distance_constant, ..Light::default() }
    });
    let lights = lights.collect();
    let ambient_light = if random.chance(0.2) { DVec3::splat(0.5) } else { DVec3::ONE };
    let background = DVec3::splat(rare(random, 0.2));
    let max_depth = 1 + some(random, 9) as u32;
    let camera = Camera { position: DVec3::NEG_Z * 12.0, ..Camera::default() };
    Scene { camera, lights, primitives, background, ambient_light, max_depth, animation: Vec::new() }
}

#[test]
fn a_kernel_is_compiled_for_what_the_plan_says() {
    let mut random = crate::random::Random(17);
    let (mut small, mut dark, mut close_up) = (0, 0, 0);
    let (mut apart, mut nested, mut many_lights, mut other_light) = (0, 0, 0, 0);
    for number in 0..1000 {
        let scene = any_scene(&mut random);
        if scene.validate().is_err() {
            continue;
        }
        let precision = if number % 2 == 0 { Precision::F32 } else { Precision::F64 };
        let is_path = number % 4 == 3;
        let algorithm = if is_path { Algorithm::Path } else { Algorithm::Whitted };
        let error = if number % 3 == 0 && !is_path { 0.01 } else { 0.0 };
        let samples = if is_path { 1 } else { 1 + number % 5 / 4 };
        let settings =
            RenderSettings { algorithm, precision: Some(precision), error, samples, ..RenderSettings::default() };
        let plan = Plan::for_scene(&scene, &settings, [64, 28], &DEVICE).unwrap();
        let records = WhittedRecords::of(&scene, scene_space(&scene, plan.kernel), precision, [64, 28]);
        let compiled = Features::of(&records, plan.kernel.description(), &plan.approximations, plan.generations.choice);
        let compiled = Features { pixels: plan.pixels.choice, samples: samples > 1, ..compiled };
        assert_eq!(plan.features(), compiled, "scene {number}: {scene:?}");
        assert_eq!(plan.counts.map(|count| count as u32), records.solids.counts, "scene {number}");
        small += usize::from(plan.counts.iter().sum::<usize>() < scene.primitives.len());
        dark += usize::from(records.light_count < records.light_sphere_count);
        close_up += usize::from(plan.close_up.is_some());
        apart += usize::from(compiled.light.media == Media::Apart);
        nested += usize::from(compiled.light.media == Media::Nested);
        many_lights += usize::from(compiled.lights == 3);
        other_light += usize::from(LightFeatures { media: Media::None, ..compiled.light } != LightFeatures::default());
    }
    assert!(small > 5 && dark > 50 && close_up > 20, "{small} {dark} {close_up}: each kind is there");
    assert!(apart > 20 && nested > 20 && other_light > 100, "{apart} {nested} {other_light}: each kind is there");
    assert!(many_lights > 5, "{many_lights}");
}
