//! From a scene to text. TOML is for people: fields that have their default value are left out, geometry never is.
//! JSON is for programs: every field of the course work's model stands there, and of the others those that are not as
//! they are without being named, so that programs which do not know them read what needs none.

use glam::DVec3;

use super::markup::Markup;
use super::names::UniqueNames;
use crate::scene::text::{number, points, quoted, vector};
use crate::scene::{Camera, Interpolation, Keyframe, Light, Material, Part, Primitive, Scene, Solid, Track};

impl Scene {
    /// The scene as TOML; reads back to the bit if the scene is valid.
    pub fn to_toml(&self) -> String {
        let default = Scene::default();
        let mut lines = Vec::new();
        let mut line = |key: &str, value: &str| lines.push(format!("{key} = {value}\n"));
        for (key, value) in Markup::Toml.fields(scene_fields(self), &scene_fields(&default)) {
            line(key, &value);
        }
        // Dotted keys, for a [camera] header would swallow the arrays behind it.
        for (key, value) in Markup::Toml.fields(camera_fields(&self.camera), &camera_fields(&default.camera)) {
            line(&format!("camera.{key}"), &value);
        }
        let lights = rows(&self.lights, |light| Markup::Toml.light(light));
        if lights != rows(&default.lights, |light| Markup::Toml.light(light)) {
            line("lights", &lights);
        }
        if !self.primitives.is_empty() {
            line("primitives", &rows(&self.primitives, |primitive| Markup::Toml.primitive(primitive)));
        }
        if !self.animation.is_empty() {
            line("animation", &animation(self, Markup::Toml));
        }
        lines.concat()
    }

    /// The scene as JSON; reads back to the bit if the scene is valid.
    pub fn to_json(&self) -> String {
        let mut fields = scene_fields(self);
        fields.push(("camera", Markup::Json.table(&camera_fields(&self.camera))));
        fields.push(("lights", rows(&self.lights, |light| Markup::Json.light(light))));
        fields.push(("primitives", rows(&self.primitives, |primitive| Markup::Json.primitive(primitive))));
        if !self.animation.is_empty() {
            fields.push(("animation", animation(self, Markup::Json)));
        }
        let lines: Vec<String> = fields.iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}

/// The tracks; they name primitives where names tell them apart.
pub(super) fn animation(scene: &Scene, markup: Markup) -> String {
    let names = UniqueNames::of(&scene.primitives);
    rows(&scene.animation, |track| markup.track(track, scene, &names))
}

/// A field's name and its value's text; numbers, strings and arrays are spelled alike in both formats.
type Field = (&'static str, String);

fn scene_fields(scene: &Scene) -> Vec<Field> {
    let mut fields = vec![("max_depth", scene.max_depth.to_string()), ("background", vector(scene.background))];
    fields.extend((scene.ambient_light != DVec3::ONE).then(|| ("ambient_light", vector(scene.ambient_light))));
    fields
}

fn camera_fields(camera: &Camera) -> Vec<Field> {
    vec![
        ("position", vector(camera.position)),
        ("direction", vector(camera.direction)),
        ("up", vector(camera.up)),
        ("vertical_fov_degrees", number(camera.vertical_fov_degrees)),
        ("projection", quoted(camera.projection.name())),
    ]
}

fn material_fields(material: &Material) -> Vec<Field> {
    let Material { color, ambient, diffuse, specular, reflection, shininess, transmission, refractive_index } =
        *material;
    let mut fields = vec![
        ("color", vector(color)),
        ("ambient", number(ambient)),
        ("diffuse", number(diffuse)),
        ("specular", number(specular)),
    ];
    fields.extend(reflection.map(|reflection| ("reflection", number(reflection))));
    let default = Material::default();
    let others = [
        ("shininess", shininess, default.shininess),
        ("transmission", transmission, default.transmission),
        ("refractive_index", refractive_index, default.refractive_index),
    ];
    // By their bits: −0 is not 0.
    let others = others.into_iter().filter(|(_, value, usual)| value.to_bits() != usual.to_bits());
    fields.extend(others.map(|(key, value, _)| (key, number(value))));
    fields
}

fn solid_fields(solid: &Solid) -> Vec<Field> {
    match solid {
        Solid::Sphere { center, radius } => vec![("center", vector(*center)), ("radius", number(*radius))],
        Solid::Box { center, half_size, rotation_degrees } => vec![
            ("center", vector(*center)),
            ("half_size", vector(*half_size)),
            ("rotation_degrees", vector(*rotation_degrees)),
        ],
        Solid::Cylinder { ends, radius } => {
            vec![("ends", points(*ends)), ("radius", number(*radius))]
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => vec![
            ("apex", vector(*apex)),
            ("axis", vector(*axis)),
            ("height", number(*height)),
            ("half_angle_degrees", number(*half_angle_degrees)),
        ],
    }
}

impl Markup {
    fn light(self, light: &Light) -> String {
        let position = ("position", vector(light.position));
        let others = |light: &Light| {
            let mut fields = vec![("intensity", vector(light.intensity)), ("radius", number(light.radius))];
            fields.extend(light.distance_constant.map(|constant| ("distance_constant", number(constant))));
            fields
        };
        let mut fields = vec![position];
        fields.extend(self.fields(others(light), &others(&Light::default())));
        self.table(&fields)
    }

    fn primitive(self, primitive: &Primitive) -> String {
        let mut fields = vec![("kind", quoted(primitive.solid.kind().name()))];
        fields.extend(primitive.name.as_ref().map(|name| ("name", quoted(name))));
        fields.extend(solid_fields(&primitive.solid));
        let material = self.fields(material_fields(&primitive.material), &material_fields(&Material::default()));
        if !material.is_empty() {
            fields.push(("material", self.table(&material)));
        }
        self.table(&fields)
    }

    fn track(self, track: &Track, scene: &Scene, names: &UniqueNames<'_>) -> String {
        let name = |index: usize| scene.primitives[index].name.as_deref().filter(|name| names.index(name).is_some());
        let part = match track.part {
            Part::Scene => None,
            Part::Light(index) => Some(("light", (index + 1).to_string())),
            Part::Primitive(index) => Some(("primitive", name(index).map_or_else(|| (index + 1).to_string(), quoted))),
        };
        let mut fields: Vec<Field> = part.into_iter().collect();
        fields.push(("field", quoted(track.field)));
        if track.interpolation != Interpolation::default() {
            fields.push(("interpolation", quoted(track.interpolation.name())));
        }
        let keyframe = |keyframe: &Keyframe| {
            self.table(&[("seconds", number(keyframe.seconds)), ("value", keyframe.value.text())])
        };
        let keyframes: Vec<String> = track.keyframes.iter().map(keyframe).collect();
        fields.push(("keyframes", format!("[{}]", keyframes.join(", "))));
        self.table(&fields)
    }

    /// The fields that this format writes. Texts are compared, not values: −0 is not 0 there.
    fn fields(self, mut fields: Vec<Field>, default: &[Field]) -> Vec<Field> {
        if matches!(self, Self::Toml) {
            fields.retain(|field| !default.contains(field));
        }
        fields
    }

    /// A table on one line.
    fn table(self, fields: &[Field]) -> String {
        match self {
            Self::Toml => {
                let fields: Vec<String> = fields.iter().map(|(key, value)| format!("{key} = {value}")).collect();
                format!("{{ {} }}", fields.join(", "))
            }
            Self::Json => {
                let fields: Vec<String> = fields.iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
                format!("{{{}}}", fields.join(", "))
            }
        }
    }
}

/// An array with an element a line.
fn rows<T>(elements: &[T], row: impl Fn(&T) -> String) -> String {
    if elements.is_empty() {
        return "[]".to_owned();
    }
    let rows: Vec<String> = elements.iter().map(|element| format!("  {}", row(element))).collect();
    format!("[\n{}\n]", rows.join(",\n"))
}
