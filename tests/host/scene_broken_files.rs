//! Broken scene files: each is refused with one line that names what is wrong and where.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use glam::DVec3;
use zerkalo::scene::{Light, Primitive, Scene, SceneError, Solid, SolidKind};

/// `words` are what the message must name.
fn assert_one_clear_line(result: Result<Scene, SceneError>, words: &[&str], about: &str) {
    let message = match result {
        Ok(_) => panic!("{about}: was accepted"),
        Err(error) => error.to_string(),
    };
    assert!(!message.contains(char::is_control), "{about}: {message:?}");
    assert!(message.chars().count() < 300, "{about}: {message:?}");
    for word in words {
        assert!(message.contains(word), "{about}: {word:?} is not in {message:?}");
    }
}

#[test]
fn every_kind_of_broken_toml_is_refused_by_name_and_line() {
    let broken: &[(&str, &[&str])] = &[
        // Not TOML
        ("max_depth = 3\nprimitives = [{ kind = \"sphere\", rad", &["line 2: ", "not valid TOML"]),
        ("primitives = [{ kind = \"sphere\" }", &["line 1: ", "not valid TOML"]),
        ("[camera", &["line 1: ", "not valid TOML"]),
        ("{\"max_depth\": 3}", &["line 1: ", "not valid TOML"]),
        ("max_depth = ", &["line 1: ", "not valid TOML"]),
        ("name = \"open\nmax_depth = 3", &["line 1: ", "not valid TOML"]),
        ("max_depth = 3\0", &["line 1: ", "not valid TOML"]),
        ("\n\nmax_depth = 3 max_depth = 4", &["line 3: ", "not valid TOML"]),
        ("camera.up = [0, 1, 0", &["line 1: ", "not valid TOML"]),
        ("max_depth = 3\nmax_depth = 4", &["line 2: ", "duplicate key", "max_depth"]),
        ("[camera]\n[camera]", &["line 2: ", "duplicate key", "camera"]),
        ("primitives = []\n[[primitives]]\nkind = 'box'", &["line 2: ", "duplicate key", "primitives"]),
        ("primitives = [{ kind = 'box', kind = 'box' }]", &["line 1: ", "duplicate key", "kind"]),
        // Unknown fields at each level
        ("max_deth = 3", &["line 1: unknown field max_deth; allowed: camera, background, ambient_light, max_depth"]),
        ("[camera]\nfov = 3", &["line 2: camera: unknown field fov; allowed: position, direction, up"]),
        (
            "[[lights]]\n[[lights]]\ncolor = [1, 1, 1]",
            &["line 3: light 2: unknown field color; allowed: position, int"],
        ),
        (
            "[[primitives]]\nkind = 'sphere'\nname = 'left'\nheight = 1",
            &[
                "line 4: primitive 1 (sphere \"left\"): unknown field height; allowed: kind, name, material, center, rad",
            ],
        ),
        (
            "[[primitives]]\nkind = 'cone'\n[primitives.material]\ncolour = [1, 1, 1]",
            &["line 4: primitive 1 (cone): unknown field material.colour; allowed: color, ambient, diffuse, specular"],
        ),
        ("\"a\\nb\\u0007\" = 1", &["line 1: unknown field a\\nb\\u{7}; allowed: camera"]),
        // Kinds
        ("[[primitives]]\nkind = 'cube'", &["line 2: primitive 1: kind = 'cube': must be \"sphere\", \"box\", \"cyl"]),
        ("[[primitives]]\nkind = 'Sphere'", &["line 2: primitive 1: kind = 'Sphere': must be"]),
        ("[[primitives]]\nkind = 1", &["line 2: primitive 1: kind = 1: must be"]),
        ("\n[[primitives]]\nradius = 1", &["line 2: primitive 1: kind is missing: must be \"sphere\""]),
        ("[[primitives]]\nname = 'left'", &["line 1: primitive 1 (\"left\"): kind is missing"]),
        // Wrong types
        ("camera = 1", &["line 1: camera: 1: must be a table"]),
        ("camera = [1, 2]", &["line 1: camera: [1, 2]: must be a table"]),
        ("background = 'blue'", &["line 1: background = 'blue': must be an array of three numbers"]),
        ("background = [1, 2]", &["line 1: background = [1, 2]: must be an array of three numbers"]),
        ("background = [1, 2, 3, 4]", &["line 1: background = [1, 2, 3, 4]: must be an array of three numbers"]),
        ("background = [1, 2, '3']", &["line 1: background = [1, 2, '3']: must be an array of three numbers"]),
        ("background.r = 1", &["line 1: background = a table: must be an array of three numbers"]),
        ("max_depth = '3'", &["line 1: max_depth = '3': must be a whole number from 1 to 1000"]),
        ("max_depth = 20.0", &["line 1: max_depth = 20.0: must be a whole number from 1 to 1000"]),
        ("lights = 3", &["line 1: lights = 3: must be an array of tables"]),
        ("lights = [3]", &["line 1: light 1: 3: must be a table"]),
        ("[lights]", &["line 1: lights = a table: must be an array of tables"]),
        ("primitives = { kind = 'box' }", &["primitives = { kind = 'box' }: must be an array of tables"]),
        ("primitives = [\n'box'\n]", &["line 2: primitive 1: 'box': must be a table"]),
        ("camera.projection = 'wide'", &["camera: projection = 'wide': must be \"centered\" or \"course\""]),
        ("camera.projection = 1", &["camera: projection = 1: must be \"centered\" or \"course\""]),
        ("camera.position = 1979-05-27", &["camera: position = 1979-05-27: must be an array of three numbers"]),
        ("camera.vertical_fov_degrees = true", &["camera: vertical_fov_degrees = true: must be a number"]),
        ("camera.vertical_fov_degrees = []", &["camera: vertical_fov_degrees = []: must be a number"]),
        ("[[primitives]]\nkind = 'box'\nname = 1", &["line 3: primitive 1 (box): name = 1: must be a string"]),
        ("[[primitives]]\nkind = 'box'\nmaterial = 1", &["line 3: primitive 1 (box): material = 1: must be a table"]),
        ("[[primitives]]\nkind = 'sphere'\nradius = '1'", &["primitive 1 (sphere): radius = '1': must be a number"]),
        ("[[primitives]]\nkind = 'sphere'\nradius = {}", &["primitive 1 (sphere): radius = {}: must be a number"]),
        (
            "[[primitives]]\nkind = 'cylinder'\nends = [1, 0, 1]",
            &["line 3: primitive 1 (cylinder): ends = [1, 0, 1]: must be an array of two points"],
        ),
        ("[[primitives]]\nkind = 'cylinder'\nends = [[1, 0, 1]]", &["ends = [[1, 0, 1]]: must be an array of two poi"]),
        (
            "[[primitives]]\nkind = 'cylinder'\nends = [[1, 0], [1, 0]]",
            &["ends = [[1, 0], [1, 0]]: must be an array of two poi"],
        ),
        // Numbers that are none
        ("background = [nan, 0, 0]", &["background = [nan, 0, 0]: must be a finite number"]),
        ("camera.position = [0, -inf, 0]", &["camera: position = [0, -inf, 0]: must be a finite number"]),
        ("camera.position = [0, 1e400, 0]", &["camera: position = [0, 1e400, 0]: must be a finite number"]),
        ("camera.position = [0, 1e39, 0]", &["camera: position = [0, 1e39, 0]: must be a finite number of at most"]),
        ("max_depth = 99999999999999999999", &["max_depth = 99999999999999999999: must be a whole number"]),
        ("max_depth = 4294967297", &["max_depth = 4294967297: must be a whole number"]),
        ("max_depth = -1", &["max_depth = -1: must be a whole number"]),
    ];
    for (source, words) in broken {
        assert_one_clear_line(Scene::from_toml(source), words, source);
    }
}

#[test]
fn every_kind_of_broken_json_is_refused_by_name_and_line() {
    let broken: &[(&str, &[&str])] = &[
        ("", &["line 1: empty"]),
        (" \n ", &["line 1: empty"]),
        ("{\n\"max_depth\": 3", &["not valid JSON"]),
        ("{\"primitives\": [{\"kind\": \"sphe", &["line 1: not valid JSON"]),
        ("{\"max_depth\": 3,\n}", &["line 1: not valid JSON"]),
        ("{\"lights\": [\n{},\n]}", &["line 2: not valid JSON"]),
        ("{\"max_depth\": 3} {}", &["line 1: not valid JSON"]),
        ("// note\n{}", &["line 1: not valid JSON"]),
        ("{max_depth: 3}", &["line 1: not valid JSON", "max_depth"]),
        ("{'max_depth': 3}", &["line 1: not valid JSON"]),
        ("{\"max_depth\": 0x10}", &["line 1: not valid JSON"]),
        ("{\"max_depth\": 010}", &["line 1: not valid JSON"]),
        ("{\"background\": [.5, 0, 0]}", &["line 1: not valid JSON"]),
        ("{\"background\": [+5, 0, 0]}", &["line 1: not valid JSON"]),
        ("{\"background\": [5 5 5]}", &["line 1: not valid JSON"]),
        ("{\"background\": [5,,5]}", &["line 1: not valid JSON"]),
        ("{\"background\":\n[NaN, 0, 0]}", &["line 2: not valid JSON", "NaN"]),
        ("{\"background\": [-Infinity, 0, 0]}", &["line 1: not valid JSON"]),
        ("{\"max_depth\" 3}", &["line 1: not valid JSON"]),
        ("max_depth = 3", &["line 1: not valid JSON"]),
        ("{\"primitives\": [{\"kind\": \"box\", \"name\": \"\\ud800\"}]}", &["line 1: not valid JSON"]),
        ("[]", &["line 1: []: must be a table of fields"]),
        ("3", &["line 1: 3: must be a table of fields"]),
        ("null", &["line 1: null: must be a table of fields"]),
        ("\"scene\"", &["line 1: \"scene\": must be a table of fields"]),
        ("{\"max_depth\": 3,\n\"max_depth\": 4}", &["line 2: max_depth is given twice"]),
        ("{\"primitives\": [],\n\"primitives\": []}", &["line 2: primitives is given twice"]),
        ("{\"primitives\": [{\"kind\": \"box\", \"kind\": \"box\"}]}", &["primitive 1 (box): kind is given twice"]),
        ("{\"lights\": null}", &["lights = null: must be an array of tables"]),
        ("{\"max_depth\": null}", &["max_depth = null: must be a whole number"]),
        ("{\"max_depth\": 2e1}", &["max_depth = 2e1: must be a whole number"]),
        ("{\"background\": [1e400, 0, 0]}", &["background = [1e400, 0, 0]: must be a finite number"]),
        ("{\"scene\": {}}", &["line 1: unknown field scene; allowed: camera"]),
        (
            "{\"primitives\": [{\"kind\": \"sphere\"},\n{\"kind\": \"sphere\",\n\"name\": \"left wall\", \"radius\": -1}]}",
            &["line 3: primitive 2 (sphere \"left wall\"): radius = -1: must be greater than 0"],
        ),
    ];
    for (source, words) in broken {
        assert_one_clear_line(Scene::from_json(source), words, source);
    }
}

#[test]
fn every_rule_of_validation_names_field_value_and_line() {
    let broken: &[(&str, &str)] = &[
        ("background = [0, -0.1, 0]", "background = [0, -0.1, 0]: must be 0 or greater"),
        ("max_depth = 0", "max_depth = 0: must be a whole number from 1 to 1000"),
        ("max_depth = 1001", "max_depth = 1001: must be a whole number from 1 to 1000"),
        ("camera.direction = [0, 0, -0.0]", "camera: direction = [0, 0, -0.0]: must not be zero"),
        ("camera.up = [0, 0, 0]", "camera: up = [0, 0, 0]: must not be zero"),
        ("camera.up = [0, 0, 1e-9]", "camera: up = [0, 0, 1e-9]: must not be parallel to direction"),
        ("camera.direction = [0, -1e30, 0]", "camera: up = [0, 1, 0]: must not be parallel to direction"),
        ("camera.vertical_fov_degrees = 0", "camera: vertical_fov_degrees = 0: must be between 0 and 180"),
        ("camera.vertical_fov_degrees = 180", "camera: vertical_fov_degrees = 180: must be between 0 and 180"),
        ("lights = [{ intensity = [1, 1, -1e-300] }]", "light 1: intensity = [1, 1, -1e-300]: must be 0 or greater"),
        ("lights = [{ distance_constant = 0 }]", "light 1: distance_constant = 0: must be greater than 0"),
        ("ambient_light = [1, -1, 1]", "ambient_light = [1, -1, 1]: must be 0 or greater"),
        ("lights = [{ position = [1, 1, 4e38] }]", "light 1: position = [1, 1, 4e38]: must be a finite number"),
        ("sphere.radius = 0", "radius = 0: must be greater than 0"),
        ("sphere.radius = -0.0", "radius = -0.0: must be greater than 0"),
        ("sphere.radius = -1e39", "radius = -1e39: must be a finite number"),
        ("sphere.center = [1e39, 0, 0]", "center = [1e39, 0, 0]: must be a finite number"),
        ("box.half_size = [1, -1, 1]", "half_size = [1, -1, 1]: must be 0 or greater"),
        ("box.rotation_degrees = [1e39, 0, 0]", "rotation_degrees = [1e39, 0, 0]: must be a finite number"),
        ("cylinder.ends = [[1, 0, 0], [1, 0, -0.0]]", "ends = [[1, 0, 0], [1, 0, -0.0]]: must be two different points"),
        ("cylinder.ends = [[1, 0, 0], [1, 0, 1e39]]", "ends = [[1, 0, 0], [1, 0, 1e39]]: must be a finite number"),
        ("cylinder.radius = 0", "radius = 0: must be greater than 0"),
        ("cone.axis = [0, 0, 0]", "axis = [0, 0, 0]: must not be zero"),
        ("cone.apex = [0, 1e39, 0]", "apex = [0, 1e39, 0]: must be a finite number"),
        ("cone.height = 0", "height = 0: must be greater than 0"),
        ("cone.half_angle_degrees = 0", "half_angle_degrees = 0: must be between 0 and 90"),
        ("cone.half_angle_degrees = 90", "half_angle_degrees = 90: must be between 0 and 90"),
        ("cone.half_angle_degrees = -25", "half_angle_degrees = -25: must be between 0 and 90"),
        ("box.material.color = [0, 1.5, 0]", "material.color = [0, 1.5, 0]: must be from 0 to 1"),
        ("box.material.ambient = 1.1", "material.ambient = 1.1: must be from 0 to 1"),
        ("box.material.diffuse = -0.1", "material.diffuse = -0.1: must be from 0 to 1"),
        ("box.material.specular = 2", "material.specular = 2: must be from 0 to 1"),
        ("box.material.reflection = -0.1", "material.reflection = -0.1: must be from 0 to 1"),
        ("box.material.shininess = 0.5", "material.shininess = 0.5: must be from 1 to 1024"),
        ("box.material.shininess = 1025", "material.shininess = 1025: must be from 1 to 1024"),
        ("box.material.transmission = 1.5", "material.transmission = 1.5: must be from 0 to 1"),
        ("box.material.refractive_index = 0", "material.refractive_index = 0: must be from 0.01 to 100"),
    ];
    for (assignment, message) in broken {
        let kind = SolidKind::ALL.into_iter().find(|kind| assignment.starts_with(kind.name()));
        let (source, expected) = match kind.map(SolidKind::name) {
            Some(kind) => (
                format!(
                    "[[primitives]]\nkind = '{kind}'\n{}",
                    assignment.strip_prefix(kind).unwrap().trim_start_matches('.')
                ),
                format!("line 3: primitive 1 ({kind}): {message}"),
            ),
            None => (format!("\n{assignment}"), format!("line 2: {message}")),
        };
        assert_one_clear_line(Scene::from_toml(&source), &[&expected], &source);
    }
}

#[test]
fn values_on_the_edge_of_a_rule_are_accepted() {
    for source in [
        "max_depth = 1",
        "max_depth = 1000",
        "camera.vertical_fov_degrees = 179.999",
        "camera.vertical_fov_degrees = 5.7e-5",
        "camera.direction = [0, 5e-324, 5e-324]",
        "camera.direction = [0, 3.4e38, 3.4e38]",
        "camera.up = [0, 1, 1e9]",
        "background = [1e30, 0, 0]",
        "primitives = [{ kind = 'sphere', radius = 5e-324 }]",
        "primitives = [{ kind = 'box', half_size = [1, 0, 1] }]",
        "primitives = [{ kind = 'box', half_size = [0, 0, 0] }]",
        "primitives = [{ kind = 'cylinder', ends = [[0, 0, 0], [0, 5e-324, 0]] }]",
        "primitives = [{ kind = 'cone', half_angle_degrees = 89.999 }]",
        "primitives = [{ kind = 'box', material = { color = [0, 1, 0], ambient = 0, diffuse = 1, specular = 1 } }]",
    ] {
        Scene::from_toml(source).unwrap_or_else(|error| panic!("{source}: {error}"));
    }
}

#[test]
fn scenes_made_in_memory_are_checked_by_the_same_rules() {
    let mut scene = Scene { lights: vec![Light::default(); 65], ..Scene::default() };
    assert_eq!(scene.validate().unwrap_err().to_string(), "lights = [65 of them]: at most 64 are allowed");
    scene.lights.truncate(64);
    scene.validate().unwrap();
    let center = DVec3::new(0.0, f64::NAN, 0.0);
    let solid = Solid::Sphere { center, radius: 1.0 };
    scene.primitives = vec![Primitive { solid, ..Primitive::course_default(SolidKind::Box) }];
    let message = scene.validate().unwrap_err().to_string();
    assert!(message.starts_with("primitive 1 (sphere): center = [0, NaN, 0]: must be a finite number"), "{message}");
    let Solid::Cone { apex, height, half_angle_degrees, .. } = Solid::course_default(SolidKind::Cone) else {
        unreachable!()
    };
    scene.primitives[0].solid = Solid::Cone { apex, axis: DVec3::new(0.0, 2.0, 0.0), height, half_angle_degrees };
    let message = scene.validate().unwrap_err().to_string();
    assert_eq!(message, "primitive 1 (cone): axis = [0, 2, 0]: must have length 1");
}

#[test]
fn long_and_odd_values_are_cut_and_escaped() {
    let long = "x".repeat(10_000);
    let odd = "\u{202e}\u{1b}[31m".repeat(1000);
    for text in [&long, &odd] {
        let json = serde_json::to_string(text).unwrap();
        for source in [
            format!("{{{json}: 1}}"),
            format!("{{\"background\": {json}}}"),
            format!("{{\"primitives\": [{{\"kind\": {json}, \"name\": {json}}}]}}"),
            format!("{{\"primitives\": [{{\"kind\": \"box\", \"name\": {json}, \"center\": {json}}}]}}"),
        ] {
            assert_one_clear_line(Scene::from_json(&source), &["…"], &source[..60]);
        }
    }
    for text in [&long, &odd] {
        assert_one_clear_line(Scene::from_json(&format!("[{text}")), &["line 1: not valid JSON"], "no value");
        assert_one_clear_line(Scene::from_toml(&format!("a = {text}")), &["line 1: not valid TOML"], "no value");
    }
    let digits = format!("max_depth = {}", "9".repeat(100_000));
    assert_one_clear_line(Scene::from_toml(&digits), &["max_depth = 9999999", "…: must be a whole number"], "digits");
}

fn load(folder: &Path, name: &str, content: &[u8]) -> Result<Scene, SceneError> {
    let path = folder.join(name);
    fs::write(&path, content).unwrap();
    Scene::load(&path)
}

#[test]
fn files_that_are_no_scene_files_are_refused_by_name() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    fs::create_dir(folder.join("folder.toml")).unwrap();
    assert_one_clear_line(Scene::load(folder), &["is a folder"], "a folder");
    assert_one_clear_line(Scene::load(&folder.join("folder.toml")), &["folder.toml: is a folder"], "a named folder");
    assert_one_clear_line(Scene::load(&folder.join("none.toml")), &["none.toml: could not be read: No"], "missing");
    assert_one_clear_line(Scene::load(&folder.join("a\nb.toml")), &["a\\nb.toml: could not be read"], "odd name");
    assert_one_clear_line(
        load(folder, "scene.yaml", b""),
        &["scene.yaml: ", ".toml, .json, .zscene, .nff or .pov"],
        "wrong extension",
    );
    assert_one_clear_line(load(folder, "scene", b""), &[".toml, .json, .zscene, .nff or .pov"], "no extension");
    assert_one_clear_line(
        load(folder, ".toml", b""),
        &[".toml, .json, .zscene, .nff or .pov"],
        "nothing but an extension",
    );
    assert_one_clear_line(load(folder, "empty.json", b""), &["empty.json:1: empty"], "empty JSON");
    assert_one_clear_line(load(folder, "latin.toml", b"# \xe9t\xe9"), &["is not UTF-8 text"], "Latin-1");
    assert_one_clear_line(load(folder, "wide.json", b"\xff\xfe{\0}\0"), &["is not UTF-8 text"], "UTF-16");
    let named = load(folder, "named.toml", b"\nmax_depth = 0");
    assert_one_clear_line(named, &["named.toml:2: max_depth = 0: must be"], "line");
    if cfg!(unix) {
        assert_one_clear_line(
            Scene::load(Path::new("/dev/null")),
            &[".toml, .json, .zscene, .nff or .pov"],
            "a device",
        );
    }
}

#[cfg(unix)]
#[test]
fn pipes_are_refused_without_waiting() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.toml");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    assert_one_clear_line(Scene::load(&pipe), &["pipe.toml: is not a regular file"], "a pipe");
}

#[cfg(unix)]
#[test]
fn file_without_permission_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("secret.toml");
    fs::write(&path, "").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o000)).unwrap();
    if fs::read(&path).is_ok() {
        println!("skipped: this user (root?) reads files that permit nobody");
        return;
    }
    assert_one_clear_line(Scene::load(&path), &["secret.toml: could not be read: Permission denied"], "no permission");
}

#[test]
fn deep_nesting_is_refused_without_a_stack_overflow() {
    let million = 1_000_000;
    let deep = |open: &str, close: &str| open.repeat(million) + &close.repeat(million);
    for json in [deep("[", "]"), deep("[", ""), deep("{\"a\":", ""), deep("{\"a\":[", "]}")] {
        assert_one_clear_line(Scene::from_json(&json), &["not valid JSON"], &json[..20]);
    }
    let dotted = format!("{}a = 1", "a.".repeat(million));
    // As deep as both of the parser's limits together allow, in one document.
    let mixed = format!("{}1", format!("{}a = {{ ", "a.".repeat(78)).repeat(79));
    let closed = format!("{}a = 1{}", format!("{}a = {{ ", "a.".repeat(78)).repeat(78), " }".repeat(78));
    let arrays = format!("{}{}", "a = [".to_owned() + &"[".repeat(million), "]".repeat(million));
    for toml in [
        deep("[", "]"),
        "a = ".to_owned() + &deep("[", ""),
        "a = ".to_owned() + &deep("{ a = ", ""),
        "a = ".to_owned() + &deep("{a=[", "]}"),
        format!("[{}a]", "a.".repeat(million)),
        arrays,
        dotted,
        mixed,
        closed,
    ] {
        assert_one_clear_line(Scene::from_toml(&toml), &["line 1: "], &toml[..20]);
    }
}

/// Bytes of a fixed sequence, mapped by `byte`.
fn noise(length: usize, byte: impl Fn(u8) -> u8) -> Vec<u8> {
    let mut state = 1u64;
    let step = |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        byte((state >> 33) as u8)
    };
    (0..length).map(step).collect()
}

#[test]
fn hundred_megabytes_of_noise_are_refused_soon() {
    let temporary = tempfile::tempdir().unwrap();
    let binary = noise(100_000_000, |byte| byte);
    let printable = noise(100_000_000, |byte| b' ' + byte % 95);
    for (name, content) in [("binary", &binary), ("printable", &printable)] {
        for extension in ["toml", "json"] {
            let file = format!("{name}.{extension}");
            fs::write(temporary.path().join(&file), content).unwrap();
            let start = Instant::now();
            assert_one_clear_line(Scene::load(&temporary.path().join(&file)), &[&file, "100000000 bytes"], &file);
            assert!(start.elapsed() < Duration::from_secs(5), "{file}: {:?}", start.elapsed());
        }
    }
}

#[test]
fn noise_of_the_largest_size_read_is_refused_soon() {
    let (toml_limit, json_limit) = (16 << 20, 64 << 20);
    let printable = String::from_utf8(noise(json_limit, |byte| b' ' + byte % 95)).unwrap();
    let structural = String::from_utf8(noise(json_limit, |byte| b"[]{},:\".= \n01a'"[usize::from(byte % 15)])).unwrap();
    let headers: String =
        (0..400_000).map(|i| format!("[x{i}.a]\n")).chain((0..400_000).map(|i| format!("[x{i}]\n"))).collect();
    // The dots take the parser the most memory; the headers are quadratic with toml's preserve_order.
    let toml = [
        printable[..toml_limit].to_owned(),
        structural[..toml_limit].to_owned(),
        ".".repeat(toml_limit),
        format!("a = [{}", "1,".repeat(toml_limit / 2 - 10)),
        format!("lights = [{}]", "[],".repeat(toml_limit / 3 - 10)),
        "[[a]]\n".repeat(toml_limit / 6),
        "\"".repeat(toml_limit),
        "a\n".repeat(toml_limit / 2),
        headers[..toml_limit.min(headers.len())].to_owned(),
    ];
    for (case, source) in toml.iter().enumerate() {
        let start = Instant::now();
        assert_one_clear_line(Scene::from_toml(source), &["line "], &source[..20]);
        println!("toml {case} {:?}: {:?}", &source[..12], start.elapsed());
        assert!(start.elapsed() < Duration::from_secs(20), "{:?}: {:?}", &source[..20], start.elapsed());
    }
    let json = [
        printable,
        structural,
        format!("[{}1]", "1,".repeat(json_limit / 2 - 10)),
        format!("{{\"lights\": [{}1]}}", "{},".repeat(json_limit / 3 - 10)),
        format!("{{{}\"a\":1}}", "\"a\":1,".repeat(json_limit / 6 - 10)),
        " \n".repeat(json_limit / 2),
    ];
    for (case, source) in json.iter().enumerate() {
        let start = Instant::now();
        assert_one_clear_line(Scene::from_json(source), &["line "], &source[..20]);
        println!("json {case} {:?}: {:?}", &source[..12], start.elapsed());
        assert!(start.elapsed() < Duration::from_secs(20), "{:?}: {:?}", &source[..20], start.elapsed());
    }
}
