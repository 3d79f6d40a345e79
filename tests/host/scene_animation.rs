//! Scenes that move: how files say it, what is refused, and what is where at which time.

use std::time::Instant;

use glam::DVec3;
use zerkalo::scene::{Part, Primitive, Scene, Solid, SolidKind, Value};

const MOVING: &str = r#"
primitives = [
  { kind = "sphere", name = "ball", center = [0, 0, 0], radius = 1 },
  { kind = "cylinder", ends = [[0, 0, 0], [0, 1, 0]], radius = 1 },
]

[[animation]]
primitive = "ball"
field = "material.reflection"
keyframes = [{ seconds = 1, value = 0 }, { seconds = 3, value = 1 }]

[[animation]]
primitive = 2
field = "ends"
interpolation = "catmull-rom"
keyframes = [{ seconds = 0, value = [[0, 0, 0], [0, 1, 0]] }, { seconds = 4, value = [[2, 0, 0], [0, 5, 0]] }]

[[animation]]
field = "camera.position"
keyframes = [{ seconds = 0, value = [0, 0, -4] }, { seconds = 2, value = [4, 0, 0] }]

[[animation]]
field = "camera.look_at"
keyframes = [{ seconds = 0, value = [0, 0, 0] }]

[[animation]]
light = 1
field = "intensity"
keyframes = [{ seconds = 0, value = [0, 1, 2] }, { seconds = 1, value = [1, 1, 1] }]
"#;

fn at(scene: &Scene, seconds: f64) -> Scene {
    let mut moved = scene.clone();
    moved.go_to(seconds).unwrap();
    moved
}

#[test]
fn a_scene_is_what_its_time_says_whatever_the_times_before() {
    let scene = Scene::from_toml(MOVING).unwrap();
    assert_eq!((scene.animation.len(), scene.duration_seconds()), (5, 4.0));
    assert_eq!((scene.animation[0].part, scene.animation[1].part), (Part::Primitive(0), Part::Primitive(1)));
    let one = at(&scene, 2.0);
    assert_eq!(one.primitives[0].material.reflection, Some(0.5));
    let Solid::Cylinder { ends, .. } = one.primitives[1].solid else { panic!("{one:?}") };
    assert_eq!(ends, [DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 3.0, 0.0)]);
    assert_eq!((one.camera.position, one.camera.direction), (DVec3::new(4.0, 0.0, 0.0), DVec3::new(-4.0, 0.0, 0.0)));
    assert_eq!(at(&scene, 0.5).lights[0].intensity, DVec3::new(0.5, 1.0, 1.5));
    // Nothing of the file's own values is left in what moves, nor of times before.
    let mut wandering = scene.clone();
    for seconds in [3.9, 0.1, 2.7, 2.0] {
        wandering.go_to(seconds).unwrap();
    }
    assert_eq!(wandering, one);
    assert_eq!(at(&scene, 0.0).primitives[0].material.reflection, Some(0.0), "from before its first keyframe on");
}

#[test]
fn what_moves_survives_every_form_and_keeps_the_names_that_it_was_given() {
    let scene = Scene::from_toml(MOVING).unwrap();
    assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    assert_eq!(Scene::from_json(&scene.to_json()).unwrap(), scene);
    assert_eq!(Scene::from_zscene(&scene.to_zscene()).unwrap(), scene);
    assert!(scene.to_toml().contains(r#"{ primitive = "ball", field = "material.reflection", keyframes = [{ "#));
    let still = Scene { animation: Vec::new(), ..scene };
    assert!(!still.to_json().contains("animation"), "programs that know of none read what has none");
    assert_eq!(still.to_zscene()[8], 1);
}

#[test]
fn what_is_taken_out_takes_its_motion_along_and_the_rest_keeps_its_own() {
    let mut scene = Scene::from_toml(MOVING).unwrap();
    scene.remove_primitive(0);
    scene.remove_light(0);
    let left: Vec<_> = scene.animation.iter().map(|track| (track.part, track.field)).collect();
    let of_scene = |field| (Part::Scene, field);
    assert_eq!(left, [(Part::Primitive(0), "ends"), of_scene("camera.position"), of_scene("camera.look_at")]);
    scene.validate().unwrap();
}

#[test]
fn every_kind_of_broken_animation_is_refused_by_name_and_line() {
    let track = |lines: &str| format!("[[primitives]]\nkind = 'sphere'\nname = 'ball'\n[[animation]]\n{lines}");
    let keyframes = "keyframes = [{ seconds = 0, value = 0.5 }]";
    let broken: &[(&str, &str)] = &[
        (
            "primitive = 2\nfield = 'radius'",
            "line 5: animation 1: primitive = 2: must be the number of a primitive, from",
        ),
        ("primitive = 0\nfield = 'radius'", "primitive = 0: must be the number"),
        ("primitive = 'bal'\nfield = 'radius'", "primitive = 'bal': must be the name of exactly one primitive"),
        ("light = 2\nfield = 'radius'", "light = 2: must be the number of a light"),
        ("light = 1\nprimitive = 1\nfield = 'radius'", "changes a primitive or a light, not both"),
        ("primitive = 1", "line 4: animation 1: field is missing"),
        (
            "primitive = 1\nfield = 'height'",
            "line 6: animation 1: field = 'height': must be one of center, radius, mat",
        ),
        ("field = 'max_depth'", "field = 'max_depth': must be one of background, ambient_light, camera.position"),
        ("field = 'background'", "line 4: animation 1: keyframes is missing"),
        ("field = 'background'\nkeyframes = []", "animation 1: keyframes = []: must have at least one"),
        ("field = 'background'\nkeyframes = [{ value = [0, 0, 0] }]", "animation 1, keyframe 1: seconds is missing"),
        ("field = 'background'\nkeyframes = [{ seconds = 1 }]", "animation 1, keyframe 1: value is missing"),
        ("field = 'background'\nkeyframes = [{ seconds = 1, value = 'red' }]", "must be a number, an array of three"),
        (
            "field = 'background'\nkeyframes = [{ seconds = 1, value = 2 }]",
            "line 6: animation 1, keyframe 1: value = 2: must be an array of three numbers",
        ),
        (
            "field = 'background'\nkeyframes = [{ seconds = 1, value = [0, 0, -1] }]",
            "background = [0, 0, -1]: must be 0",
        ),
        ("field = 'background'\nkeyframes = [{ seconds = -1, value = [0, 0, 0] }]", "seconds = -1: must be from 0 to"),
        ("field = 'background'\nkeyframes = [{ seconds = 2e6, value = [0, 0, 0] }]", "must be from 0 to 1000000"),
        (
            "primitive = 1\nfield = 'radius'\nkeyframes = [\n{ seconds = 1, value = 1 },\n{ seconds = 1, value = 2 }]",
            "line 9: animation 1, keyframe 2: seconds = 1: must be later than that of the keyframe before",
        ),
        (
            "primitive = 1\nfield = 'radius'\nkeyframes = [\n{ seconds = 1, value = 1 },\n{ seconds = 2, value = 0 }]",
            "line 9: animation 1, keyframe 2: primitive 1 (sphere \"ball\"): radius = 0: must be greater than 0",
        ),
        (
            "field = 'camera.up'\nkeyframes = [{ seconds = 0, value = [0, 0, 3] }]",
            "animation 1, keyframe 1: camera: up = [0, 0, 3]: must not be parallel to direction",
        ),
        (
            "field = 'background'\ninterpolation = 'cubic'\nkeyframes = [{ seconds = 1, value = 2 }]",
            "must be \"linear\" or",
        ),
    ];
    for (lines, words) in broken {
        let complete = if lines.contains("keyframes") || words.contains("missing") { "" } else { keyframes };
        let error = Scene::from_toml(&track(&format!("{lines}\n{complete}"))).expect_err(lines).to_string();
        assert!(error.contains(words), "{words:?} is not in {error:?}");
    }
    let twice = "[[animation]]\nfield = 'camera.direction'\nkeyframes = [{ seconds = 0, value = [0, 0, 1] }]\n";
    let error = Scene::from_toml(&[twice, twice].concat()).unwrap_err().to_string();
    assert!(error.contains("line 5: animation 2: field = \"camera.direction\": is animated already"), "{error}");
    let both = [twice, &twice.replace("camera.direction", "camera.look_at")].concat();
    assert!(Scene::from_toml(&both).unwrap_err().to_string().contains("the camera's direction is animated already"));
}

#[test]
fn what_is_wrong_only_between_keyframes_is_told_with_its_time() {
    let mut scene = Scene::from_toml(
        "[[primitives]]\nkind = 'cylinder'\n[[animation]]\nprimitive = 1\nfield = 'ends'\nkeyframes = [\
         { seconds = 0, value = [[1, 0, 0], [-1, 0, 0]] }, { seconds = 2, value = [[-1, 0, 0], [1, 0, 0]] }]",
    )
    .unwrap();
    scene.go_to(0.5).unwrap();
    let error = scene.go_to(1.0).unwrap_err().to_string();
    assert_eq!(error, "at 1 s: primitive 1 (cylinder): ends = [[0, 0, 0], [0, 0, 0]]: must be two different points");
}

/// A hundred thousand keyframes, whether in one track, in two of one part or in many, and a million solids.
#[test]
fn long_animations_are_read_in_no_time() {
    let keyframes = |count: u32| {
        let keyframe = |i| format!("{{\"seconds\": {i}, \"value\": 0.5}}");
        (0..count).map(keyframe).collect::<Vec<_>>().join(", ")
    };
    let track = |primitive: u32, count| {
        let keyframes = keyframes(count);
        format!("{{\"primitive\": {primitive}, \"field\": \"material.diffuse\", \"keyframes\": [{keyframes}]}}")
    };
    let scene = |tracks: &[String]| {
        let primitives = vec!["{\"kind\": \"cone\"}"; 10_000].join(", ");
        format!("{{\"primitives\": [{primitives}], \"animation\": [{}]}}", tracks.join(", "))
    };
    let start = Instant::now();
    // At half seconds, between those of the other.
    let smooth = track(1, 100_000).replace(", \"value\"", ".5, \"value\"").replace("diffuse", "ambient");
    let smooth = smooth.replace("\"keyframes\"", "\"interpolation\": \"catmull-rom\", \"keyframes\"");
    Scene::from_json(&scene(&[track(1, 100_000), smooth])).unwrap();
    let many: Vec<_> = (1..=10_000).map(|primitive| track(primitive, 10)).collect();
    let mut scene = Scene::from_json(&scene(&many)).unwrap();
    assert_eq!(scene.animation[9_999].keyframes[3].value, Value::Number(0.5));
    scene.go_to(4.5).unwrap();
    scene.primitives.resize(1_000_000, Primitive::course_default(SolidKind::Box));
    scene.go_to(5.5).unwrap();
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}
