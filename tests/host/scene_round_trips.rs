//! What is written reads back to the same bits; what is left out takes the course's defaults; and whatever text the
//! two parsers are given, they answer with a scene or with one line.

use std::fs;

use crate::random::Random;
use glam::DVec3;
use proptest::prelude::*;
use zerkalo::scene::{
    Camera, Interpolation, Keyframe, Light, Material, Part, Primitive, Projection, Scene, SceneError, Solid, SolidKind,
    Track, Value,
};

/// Tells −0 from 0 and any two floats of different bits apart, which `==` does not.
fn bits(scene: &Scene) -> String {
    format!("{scene:?}")
}

fn assert_round_trips(scene: &Scene) {
    let toml = scene.to_toml();
    let back = Scene::from_toml(&toml).unwrap_or_else(|error| panic!("{error}\n{toml}"));
    assert_eq!(bits(&back), bits(scene), "{toml}");
    let json = scene.to_json();
    let back = Scene::from_json(&json).unwrap_or_else(|error| panic!("{error}\n{json}"));
    assert_eq!(bits(&back), bits(scene), "{json}");
    let back = Scene::from_zscene(&scene.to_zscene()).unwrap_or_else(|error| panic!("{error}\n{json}"));
    assert_eq!(bits(&back), bits(scene), "{json}");
    serde_json::from_str::<serde_json::Value>(&json).unwrap_or_else(|error| panic!("{error}\n{json}"));
}

/// Any `f64` that a scene may hold: denormals, −0 and the largest `f32` included.
fn any_number() -> impl Strategy<Value = f64> {
    let largest = f64::from(f32::MAX);
    prop_oneof![
        proptest::num::f64::ANY.prop_filter("within f32", move |x| x.abs() <= largest),
        -10.0..10.0,
        proptest::sample::select(vec![0.0, -0.0, 5e-324, -5e-324, largest, -largest, 1e16, 0.1 + 0.2]),
    ]
}

fn any_vector() -> impl Strategy<Value = DVec3> {
    [any_number(), any_number(), any_number()].prop_map(DVec3::from_array)
}

fn positive() -> impl Strategy<Value = f64> {
    any_number().prop_map(|x| if x == 0.0 { 5e-324 } else { x.abs() })
}

fn not_negative() -> impl Strategy<Value = f64> {
    prop_oneof![positive(), Just(0.0), Just(-0.0)]
}

fn fraction() -> impl Strategy<Value = f64> {
    prop_oneof![0.0..=1.0, proptest::sample::select(vec![0.0, -0.0, 1.0, 5e-324])]
}

fn between_0_and(limit: f64) -> impl Strategy<Value = f64> {
    prop_oneof![(0.0..limit).prop_filter("not 0", |x| *x > 0.0), Just(5e-324), Just(limit.next_down())]
}

fn any_name() -> impl Strategy<Value = Option<String>> {
    proptest::option::of(prop_oneof![any::<String>(), Just("\u{0}\u{7f}\"\\\r\n\t'''\u{feff}é😀".to_owned())])
}

fn any_solid() -> impl Strategy<Value = Solid> {
    let sphere = (any_vector(), positive()).prop_map(|(center, radius)| Solid::Sphere { center, radius });
    let cuboid = (any_vector(), [not_negative(), not_negative(), not_negative()], any_vector()).prop_map(
        |(center, half_size, rotation_degrees)| Solid::Box {
            center,
            half_size: DVec3::from_array(half_size),
            rotation_degrees,
        },
    );
    let cylinder = (any_vector(), any_vector(), positive())
        .prop_filter("two ends", |(start, end, _)| start != end)
        .prop_map(|(start, end, radius)| Solid::Cylinder { ends: [start, end], radius });
    let axis = [-1.0..1.0, -1.0..1.0, -1.0..1.0]
        .prop_map(DVec3::from_array)
        .prop_filter("long enough to normalise", |axis| axis.length() > 1e-3)
        .prop_map(DVec3::normalize);
    let cone = (any_vector(), axis, positive(), between_0_and(90.0))
        .prop_map(|(apex, axis, height, half_angle_degrees)| Solid::Cone { apex, axis, height, half_angle_degrees });
    prop_oneof![sphere, cuboid, cylinder, cone]
}

fn any_material() -> impl Strategy<Value = Material> {
    let optics = (proptest::option::of(fraction()), 1.0..=1024.0, fraction(), 0.01..=100.0);
    prop_oneof![
        Just(Material::default()),
        optics.prop_map(|(reflection, shininess, transmission, refractive_index)| Material {
            reflection,
            shininess,
            transmission,
            refractive_index,
            ..Material::default()
        }),
        ([fraction(), fraction(), fraction()], fraction(), fraction(), fraction()).prop_map(
            |(color, ambient, diffuse, specular)| Material::of_course(
                DVec3::from_array(color),
                ambient,
                diffuse,
                specular
            )
        ),
    ]
}

fn any_camera() -> impl Strategy<Value = Camera> {
    let projection = proptest::sample::select(Projection::ALL.to_vec());
    (any_vector(), any_vector(), any_vector(), between_0_and(180.0), projection)
        .prop_map(|(position, direction, up, vertical_fov_degrees, projection)| Camera {
            position,
            direction,
            up,
            vertical_fov_degrees,
            projection,
        })
        .prop_filter("upright", |camera| Scene { camera: camera.clone(), ..Scene::default() }.validate().is_ok())
}

fn any_scene() -> impl Strategy<Value = Scene> {
    let rgb = || [not_negative(), not_negative(), not_negative()].prop_map(DVec3::from_array);
    let radius = prop_oneof![Just(0.0), Just(0.01), not_negative()];
    let constant = proptest::option::of(positive());
    let light = (any_vector(), rgb(), radius, constant).prop_map(|(position, intensity, radius, distance_constant)| {
        Light { position, intensity, radius, distance_constant }
    });
    let ambient_light = prop_oneof![Just(DVec3::ONE), rgb()];
    let primitive = (any_name(), any_solid(), any_material()).prop_map(|(name, solid, material)| Primitive {
        name,
        solid,
        material,
    });
    let lights = prop_oneof![Just(vec![Light::default()]), proptest::collection::vec(light, 0..3)];
    let still = (any_camera(), rgb(), ambient_light, 1u32..=1000, lights, proptest::collection::vec(primitive, 0..6))
        .prop_map(|(camera, background, ambient_light, max_depth, lights, primitives)| Scene {
            camera,
            background,
            ambient_light,
            max_depth,
            lights,
            primitives,
            animation: Vec::new(),
        });
    (still, proptest::collection::vec(any_track(), 0..4)).prop_map(|(mut scene, tracks)| {
        for track in tracks {
            let is_there = match track.part {
                Part::Scene => true,
                Part::Light(index) => index < scene.lights.len(),
                Part::Primitive(index) => index < scene.primitives.len(),
            };
            let is_new = |other: &Track| (other.part, other.field) != (track.part, track.field);
            if is_there && scene.animation.iter().all(is_new) {
                scene.animation.push(track);
            }
        }
        scene
    })
}

/// Of what any light or primitive has.
fn any_track() -> impl Strategy<Value = Track> {
    let rgb = || [not_negative(), not_negative(), not_negative()].prop_map(DVec3::from_array).prop_map(Value::Vector);
    let keyframes = |value: BoxedStrategy<Value>| {
        let times = proptest::collection::btree_set(0_u32..1000, 1..4);
        (times, proptest::collection::vec(value, 4)).prop_map(|(times, values)| {
            let keyframe = |(time, value): (u32, Value)| Keyframe { seconds: f64::from(time) * 0.1, value };
            times.into_iter().zip(values).map(keyframe).collect()
        })
    };
    let of = |part, field: &'static str, value: BoxedStrategy<Value>| {
        let interpolation = proptest::sample::select(Interpolation::ALL.to_vec());
        (interpolation, keyframes(value)).prop_map(move |(interpolation, keyframes)| Track {
            part,
            field,
            interpolation,
            keyframes,
        })
    };
    let fraction = || fraction().prop_map(Value::Number).boxed();
    let near = [-10.0..10.0, -10.0..10.0, -10.0..10.0];
    prop_oneof![
        of(Part::Scene, "background", rgb().boxed()),
        // A smooth curve through the largest numbers goes beyond them.
        of(Part::Scene, "camera.position", near.prop_map(DVec3::from_array).prop_map(Value::Vector).boxed()),
        of(Part::Light(0), "intensity", rgb().boxed()),
        of(Part::Light(1), "distance_constant", positive().prop_map(Value::Number).boxed()),
        of(Part::Primitive(0), "material.reflection", fraction()),
        of(Part::Primitive(4), "material.transmission", fraction()),
        of(Part::Primitive(2), "material.color", Just(Value::Vector(DVec3::splat(0.5))).boxed()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn any_valid_scene_survives_every_form_to_the_bit(scene in any_scene()) {
        scene.validate().unwrap();
        assert_round_trips(&scene);
    }
}

#[test]
fn empty_toml_and_an_empty_json_object_are_the_default_scene() {
    assert_eq!(Scene::from_toml("").unwrap(), Scene::default());
    assert_eq!(Scene::from_json("{}").unwrap(), Scene::default());
    assert_eq!(Scene::default().to_toml(), "");
    assert_round_trips(&Scene::default());
}

#[test]
fn missing_fields_take_the_course_defaults() {
    for kind in SolidKind::ALL {
        let expected = vec![Primitive::course_default(kind)];
        let toml = format!("primitives = [{{ kind = \"{}\" }}]", kind.name());
        assert_eq!(Scene::from_toml(&toml).unwrap().primitives, expected);
        let json = format!(r#"{{"primitives": [{{"kind": "{}", "material": {{}}}}]}}"#, kind.name());
        assert_eq!(Scene::from_json(&json).unwrap().primitives, expected);
    }
    let scene = Scene::from_toml("camera.position = [1, 2, 3]\nlights = [{}]").unwrap();
    assert_eq!(scene.camera, Camera { position: DVec3::new(1.0, 2.0, 3.0), ..Camera::default() });
    assert_eq!(scene.lights, [Light::default()]);
}

#[test]
fn no_lights_is_not_the_default_light() {
    let dark = Scene { lights: Vec::new(), ..Scene::default() };
    assert_round_trips(&dark);
    assert_eq!(Scene::from_toml("lights = []").unwrap(), dark);
}

#[test]
fn json_of_the_design_page_reads_as_it_says() {
    let json = r#"{"camera": {"position": [0,0,-2], "direction": [0,0,1], "up": [0,1,0],
          "vertical_fov_degrees": 28.6478897565, "projection": "course"},
         "background": [0.1,0.2,0.3], "max_depth": 20,
         "lights": [{"position": [0,0,0], "intensity": [1,1,1]}],
         "primitives": [
          {"kind": "sphere", "center": [0,0,0], "radius": 1,
           "material": {"color": [0.3,0.5,0.7], "ambient": 0.1, "diffuse": 0.1, "specular": 0.1}},
          {"kind": "box", "center": [0,0,0], "half_size": [1,1,1], "rotation_degrees": [0,0,0], "material": {}},
          {"kind": "cylinder", "ends": [[1,0,1],[-1,0,-1]], "radius": 1, "material": {}},
          {"kind": "cone", "apex": [0,0,0], "axis": [0,-1,0], "height": 1, "half_angle_degrees": 25.8419327632,
           "material": {}}]}"#;
    let scene = Scene::from_json(json).unwrap();
    assert_eq!(scene.camera.projection, Projection::Course);
    assert_eq!(scene.camera.vertical_fov_degrees, 28.6478897565);
    for (primitive, kind) in scene.primitives.iter().zip(SolidKind::ALL).take(3) {
        assert_eq!(*primitive, Primitive::course_default(kind));
    }
    assert_round_trips(&scene);
}

#[test]
fn all_ways_to_write_toml_tables_read_alike() {
    let header = "[camera]\nposition = [1, 2, 3]\n[[lights]]\nposition = [4, 5, 6]\n\
                  [[primitives]]\nkind = 'sphere'\nradius = 2\n[primitives.material]\nambient = 0.5\n";
    let inline = "camera = { position = [1, 2, 3] }\nlights = [{ position = [4, 5, 6] }]\n\
                  primitives = [{ kind = \"sphere\", radius = 2.0, material.ambient = 5e-1 }]\n";
    let scene = Scene::from_toml(header).unwrap();
    assert_eq!(Scene::from_toml(inline).unwrap(), scene);
    assert_eq!(Scene::from_toml(&header.replace('\n', "\r\n")).unwrap(), scene);
    assert_eq!(Scene::from_toml(&format!("\u{feff}{header}")).unwrap(), scene);
    assert_eq!(scene.primitives[0].material, Material { ambient: 0.5, ..Material::default() });
    let json = scene.to_json();
    assert_eq!(Scene::from_json(&json.replace('\n', "\r\n")).unwrap(), scene);
    assert_eq!(Scene::from_json(&format!("\u{feff}{json}")).unwrap(), scene);
}

#[test]
fn whole_numbers_stand_for_floats_and_toml_spells_them_in_four_bases() {
    let radius = |spelled: &str| {
        let scene = Scene::from_toml(&format!("primitives = [{{ kind = 'sphere', radius = {spelled} }}]")).unwrap();
        match scene.primitives[0].solid {
            Solid::Sphere { radius, .. } => radius,
            _ => unreachable!(),
        }
    };
    for (spelled, value) in [
        ("1", 1.0),
        ("+1_000", 1000.0),
        ("0x10", 16.0),
        ("0b11", 3.0),
        ("0o17", 15.0),
        ("123456789012345678901234567890", 123456789012345678901234567890.0),
    ] {
        assert_eq!(radius(spelled), value, "{spelled}");
    }
    assert_eq!(Scene::from_toml("max_depth = 0x10").unwrap().max_depth, 16);
}

#[test]
fn cone_axis_is_normalised_at_load_from_any_length() {
    for (written, expected) in [
        ("[0, -2, 0]", DVec3::NEG_Y),
        ("[0, 0, 1e-320]", DVec3::Z),
        ("[3e38, 0, 0]", DVec3::X),
        ("[0.6, 0.8, 0]", DVec3::new(0.6, 0.8, 0.0)),
    ] {
        let scene = Scene::from_toml(&format!("primitives = [{{ kind = 'cone', axis = {written} }}]")).unwrap();
        let Solid::Cone { axis, .. } = scene.primitives[0].solid else { unreachable!() };
        assert_eq!(axis, expected, "{written}");
    }
}

#[test]
fn toml_leaves_defaults_out_and_json_does_not() {
    let scene = Scene { primitives: vec![Primitive::course_default(SolidKind::Sphere)], ..Scene::default() };
    assert_eq!(scene.to_toml(), "primitives = [\n  { kind = \"sphere\", center = [0, 0, 0], radius = 1 }\n]\n");
    let json: serde_json::Value = serde_json::from_str(&scene.to_json()).unwrap();
    assert_eq!(json["camera"]["projection"], "centered");
    assert_eq!(json["lights"][0]["intensity"][2], 1);
}

#[test]
fn saved_files_load_again_by_their_extension_in_any_case() {
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene { max_depth: 3, ..Scene::default() };
    for name in ["a.toml", "b.json", "c.TOML", "d.Json", "имя с пробелом.toml", "e.zscene"] {
        let path = folder.path().join(name);
        scene.save(&path).unwrap();
        assert_eq!(Scene::load(&path).unwrap(), scene, "{name}");
    }
    assert!(fs::read_to_string(folder.path().join("d.Json")).unwrap().starts_with('{'));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 6, "temporary files were left");
}

#[test]
fn refused_save_keeps_the_old_file_and_leaves_nothing_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    Scene::default().save(&path).unwrap();
    let before = fs::read(&path).unwrap();
    let invalid = Scene { max_depth: 0, ..Scene::default() };
    let message = invalid.save(&path).unwrap_err().to_string();
    assert!(message.ends_with("scene.toml: max_depth = 0: must be a whole number from 1 to 1000"), "{message}");
    assert_eq!(fs::read(&path).unwrap(), before);
    for impossible in ["folder.toml", "scene.yaml", "no such folder/scene.toml"] {
        let impossible = folder.path().join(impossible);
        if impossible.ends_with("folder.toml") {
            fs::create_dir(&impossible).unwrap();
        }
        assert!(Scene::default().save(&impossible).is_err(), "{impossible:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "temporary files were left");
}

#[cfg(unix)]
#[test]
fn saving_through_a_link_replaces_what_it_points_to_and_keeps_its_permissions() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("scene.toml"), folder.path().join("link.toml"));
    fs::write(&file, "").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&file, &link).unwrap();
    let scene = Scene { max_depth: 7, ..Scene::default() };
    scene.save(&link).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(Scene::load(&file).unwrap(), scene);
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
}

impl Random {
    pub fn below(&mut self, limit: usize) -> usize {
        (self.bits() % limit as u64) as usize
    }

    fn pick<'a, T: ?Sized>(&mut self, from: &[&'a T]) -> &'a T {
        from[self.below(from.len())]
    }
}

const TOKENS: &[&str] = &[
    "{",
    "}",
    "[",
    "]",
    "[[",
    "]]",
    ",",
    ":",
    "=",
    ".",
    "\n",
    " ",
    "\"",
    "'",
    "'''",
    "\"\"\"",
    "#",
    "\\",
    "\\u",
    "-",
    "+",
    "0",
    "-0",
    "1",
    "-1",
    "0.5",
    "1e400",
    "1e-400",
    "5e-324",
    "nan",
    "inf",
    "NaN",
    "null",
    "true",
    "1979-05-27",
    "0x7f",
    "99999999999999999999",
    "é",
    "\u{0}",
    "\u{feff}",
    "\u{202e}",
    "\r",
    "camera",
    "lights",
    "primitives",
    "material",
    "kind",
    "name",
    "sphere",
    "box",
    "cylinder",
    "cone",
    "\"kind\": \"cone\"",
    "kind = \"sphere\"",
    "center",
    "radius",
    "ends",
    "axis",
    "max_depth",
    "projection",
    "background",
    "[primitives.material]",
    "[1, 2, 3]",
    "[[primitives]]",
    "position",
    "direction",
    "up",
    "\"primitives\": [",
    "camera.up",
    "lights = [",
];

fn mutated(random: &mut Random, seed: &str) -> String {
    let mut text: Vec<char> = seed.chars().collect();
    for _ in 0..1 + random.below(3) {
        let at = random.below(text.len() + 1);
        let end = (at + random.below(12)).min(text.len());
        match random.below(10) {
            // The commonest, for the text to remain a scene now and then.
            0..5 => {
                if let Some(digit) = text[at..].iter_mut().find(|c| c.is_ascii_digit()) {
                    *digit = random.pick(&["0", "1", "9", ".", "-", "e"]).chars().next().unwrap();
                }
            }
            5 => drop(text.drain(at..end)),
            6 => text.truncate(at),
            7 => drop(text.splice(at..end, random.pick(TOKENS).chars())),
            8 => drop(text.splice(at..at, random.pick(TOKENS).chars())),
            _ => {
                let copied = text[at..end].to_vec();
                let target = random.below(text.len() + 1);
                drop(text.splice(target..target, copied));
            }
        }
    }
    text.into_iter().collect()
}

type Parse = fn(&str) -> Result<Scene, SceneError>;

#[test]
fn hundred_thousand_damaged_texts_give_a_scene_or_one_line() {
    let seeds = [
        zerkalo::scene::gallery::scene("four").unwrap(),
        zerkalo::scene::gallery::scene("corridor").unwrap(),
        Scene { lights: Vec::new(), background: DVec3::ZERO, max_depth: 1, ..Scene::default() },
    ];
    let toml: Vec<String> = seeds.iter().map(Scene::to_toml).collect();
    let json: Vec<String> = seeds.iter().map(Scene::to_json).collect();
    let parsers: [(&[String], Parse); 2] = [(&toml, Scene::from_toml), (&json, Scene::from_json)];
    let mut random = Random(1);
    let (mut read, mut refused) = (0, 0);
    for round in 0..50_000 {
        for (seeds, parse) in parsers {
            let text = if round % 4 == 0 {
                (0..random.below(30)).map(|_| random.pick(TOKENS)).collect()
            } else {
                let seed = random.below(seeds.len());
                mutated(&mut random, &seeds[seed])
            };
            match parse(&text) {
                Ok(scene) => {
                    read += 1;
                    assert_round_trips(&scene);
                }
                Err(error) => {
                    refused += 1;
                    let message = error.to_string();
                    assert!(!message.contains(char::is_control), "{message:?} for {text:?}");
                    assert!(message.chars().count() < 300, "{message:?} for {text:?}");
                    assert!(error.line.is_some_and(|line| line <= text.lines().count().max(1) + 1), "{message}");
                }
            }
        }
    }
    assert!(read > 3_000 && refused > 50_000, "{read} read, {refused} refused: the mutations are one-sided");
}
