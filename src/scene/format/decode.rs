//! From the parsed tree to a scene: names and types here, the meaning of the values in `validate`.

use glam::DVec3;

use super::Fault;
use super::names::UniqueNames;
use super::tree::{Entry, Node, Shape};
use crate::scene::text;
use crate::scene::validate::{DEPTH, FINITE, Place, Violation, check_light_count, check_primitive_count, unit};
use crate::scene::{
    Camera, Interpolation, Keyframe, Light, Material, Part, Primitive, Projection, Scene, Solid, SolidKind, Track,
    Value, animated_fields,
};

pub(super) fn scene(root: Node<'_>) -> Result<Scene, Fault> {
    const FIELDS: &[&str] =
        &["camera", "background", "ambient_light", "max_depth", "lights", "primitives", "animation"];
    let fields = Fields::of(root, Place::Scene, "", FIELDS)?;
    let default = Scene::default();
    let mut scene = Scene {
        camera: fields.get("camera").map_or(Ok(default.camera), camera)?,
        background: fields.read("background", vector, default.background)?,
        ambient_light: fields.read("ambient_light", vector, default.ambient_light)?,
        max_depth: fields.read("max_depth", depth, default.max_depth)?,
        lights: fields.list("lights", check_light_count, light)?.unwrap_or(default.lights),
        primitives: fields.list("primitives", check_primitive_count, primitive)?.unwrap_or_default(),
        animation: Vec::new(),
    };
    scene.animation = animation(&fields, &scene)?;
    Ok(scene)
}

/// What of a scene moves, from an object that has nothing else; the rest of the scene is there.
pub(super) fn animation_of(root: Node<'_>, scene: &Scene) -> Result<Vec<Track>, Fault> {
    animation(&Fields::of(root, Place::Scene, "", &["animation"])?, scene)
}

fn animation(fields: &Fields<'_>, scene: &Scene) -> Result<Vec<Track>, Fault> {
    if fields.get("animation").is_none() {
        return Ok(Vec::new());
    }
    let names = UniqueNames::of(&scene.primitives);
    let track = |index, node| track(index, node, scene, &names);
    Ok(fields.list("animation", |_| Ok(()), track)?.unwrap_or_default())
}

fn track(index: usize, node: Node<'_>, scene: &Scene, names: &UniqueNames<'_>) -> Result<Track, Fault> {
    const FIELDS: &[&str] = &["primitive", "light", "field", "interpolation", "keyframes"];
    let place = Place::Track(index);
    let fields = Fields::of(node, place, "", FIELDS)?;
    let number = |node, count| match whole_number(node) {
        Some(number) if (1..=count).contains(&number) => Ok(number - 1),
        _ => Err(()),
    };
    let part = match (fields.get("primitive"), fields.get("light")) {
        (Some(node), Some(_)) => {
            return Err(wrong(node, place, "", "primitive", "one track changes a primitive or a light, not both"));
        }
        (Some(node), None) => {
            let by_name = |name| names.index(name).ok_or("must be the name of exactly one primitive");
            let index = match node.shape() {
                Shape::String(name) => by_name(name),
                _ => number(node, scene.primitives.len())
                    .map_err(|()| "must be the number of a primitive, from 1, or its name"),
            };
            Part::Primitive(index.map_err(|rule| wrong(node, place, "", "primitive", rule))?)
        }
        (None, Some(node)) => {
            let index = number(node, scene.lights.len());
            Part::Light(index.map_err(|()| wrong(node, place, "", "light", "must be the number of a light, from 1"))?)
        }
        (None, None) => Part::Scene,
    };
    let kind = match part {
        Part::Primitive(index) => Some(scene.primitives[index].solid.kind()),
        Part::Scene | Part::Light(_) => None,
    };
    let missing = |what| Err(Fault { offset: node.offset(), what: format!("{place}{what} is missing") });
    let Some(field_node) = fields.get("field") else { return missing("field") };
    let allowed = animated_fields(part, kind);
    let Some(field) = allowed.iter().find(|name| matches!(field_node.shape(), Shape::String(given) if given == **name))
    else {
        return Err(wrong(field_node, place, "", "field", &format!("must be one of {}", allowed.join(", "))));
    };
    let keyframes = fields.list("keyframes", |_| Ok(()), |number, node| keyframe([index, number], node))?;
    let Some(keyframes) = keyframes else { return missing("keyframes") };
    let interpolation = fields.read("interpolation", interpolation, Interpolation::default())?;
    Ok(Track { part, field, interpolation, keyframes })
}

fn keyframe([track, keyframe]: [usize; 2], node: Node<'_>) -> Result<Keyframe, Fault> {
    let place = Place::Keyframe(track, keyframe);
    let fields = Fields::of(node, place, "", &["seconds", "value"])?;
    let missing = |what| Fault { offset: node.offset(), what: format!("{place}{what} is missing") };
    fields.get("seconds").ok_or_else(|| missing("seconds"))?;
    fields.get("value").ok_or_else(|| missing("value"))?;
    Ok(Keyframe {
        seconds: fields.read("seconds", number, 0.0)?,
        value: fields.read("value", value, Value::Number(0.0))?,
    })
}

/// Which of the three types is the field's business.
fn value(node: Node<'_>) -> Result<Value, &'static str> {
    const RULE: &str = "must be a number, an array of three, or for ends an array of two points";
    match node.shape() {
        Shape::Array(nodes) if nodes.len() == 2 => two_points(node).map(Value::Points),
        Shape::Array(_) => vector(node).map(Value::Vector),
        _ => number(node).map(Value::Number),
    }
    .map_err(|rule| if rule == FINITE { rule } else { RULE })
}

fn interpolation(node: Node<'_>) -> Result<Interpolation, &'static str> {
    match node.shape() {
        Shape::String(name) => Interpolation::ALL.into_iter().find(|interpolation| interpolation.name() == name),
        _ => None,
    }
    .ok_or("must be \"linear\" or \"catmull-rom\"")
}

fn whole_number(node: Node<'_>) -> Option<usize> {
    match node.shape() {
        Shape::Integer { digits, radix } => usize::from_str_radix(digits, radix).ok(),
        _ => None,
    }
}

fn camera(node: Node<'_>) -> Result<Camera, Fault> {
    const FIELDS: &[&str] = &["position", "direction", "up", "vertical_fov_degrees", "projection"];
    let fields = Fields::of(node, Place::Camera, "", FIELDS)?;
    let default = Camera::default();
    Ok(Camera {
        position: fields.read("position", vector, default.position)?,
        direction: fields.read("direction", vector, default.direction)?,
        up: fields.read("up", vector, default.up)?,
        vertical_fov_degrees: fields.read("vertical_fov_degrees", number, default.vertical_fov_degrees)?,
        projection: fields.read("projection", projection, default.projection)?,
    })
}

fn light(index: usize, node: Node<'_>) -> Result<Light, Fault> {
    const FIELDS: &[&str] = &["position", "intensity", "radius", "distance_constant"];
    let fields = Fields::of(node, Place::Light(index), "", FIELDS)?;
    let default = Light::default();
    Ok(Light {
        position: fields.read("position", vector, default.position)?,
        intensity: fields.read("intensity", vector, default.intensity)?,
        radius: fields.read("radius", number, default.radius)?,
        distance_constant: fields.read("distance_constant", some_number, None)?,
    })
}

fn primitive(index: usize, node: Node<'_>) -> Result<Primitive, Fault> {
    let name = match node.get("name").map(Node::shape) {
        Some(Shape::String(name)) => Some(name),
        _ => None,
    };
    let unknown = Place::Primitive { index, kind: None, name };
    let kind = match node.get("kind") {
        Some(kind_node) => solid_kind(kind_node).map_err(|rule| wrong(kind_node, unknown, "", "kind", rule))?,
        None if node.is_table() => {
            return Err(Fault { offset: node.offset(), what: format!("{unknown}kind is missing: {KINDS}") });
        }
        None => return Err(wrong_table(node, unknown, "")),
    };
    let allowed: &[&str] = match kind {
        SolidKind::Sphere => &["kind", "name", "material", "center", "radius"],
        SolidKind::Box => &["kind", "name", "material", "center", "half_size", "rotation_degrees"],
        SolidKind::Cylinder => &["kind", "name", "material", "ends", "radius"],
        SolidKind::Cone => &["kind", "name", "material", "apex", "axis", "height", "half_angle_degrees"],
    };
    let place = Place::Primitive { index, kind: Some(kind), name };
    let fields = Fields::of(node, place, "", allowed)?;
    Ok(Primitive {
        name: fields.read("name", string, None)?,
        solid: solid(&fields, kind)?,
        material: fields.get("material").map_or(Ok(Material::default()), |node| material(node, place))?,
    })
}

fn solid(fields: &Fields<'_>, kind: SolidKind) -> Result<Solid, Fault> {
    Ok(match Solid::course_default(kind) {
        Solid::Sphere { center, radius } => Solid::Sphere {
            center: fields.read("center", vector, center)?,
            radius: fields.read("radius", number, radius)?,
        },
        Solid::Box { center, half_size, rotation_degrees } => Solid::Box {
            center: fields.read("center", vector, center)?,
            half_size: fields.read("half_size", vector, half_size)?,
            rotation_degrees: fields.read("rotation_degrees", vector, rotation_degrees)?,
        },
        Solid::Cylinder { ends, radius } => Solid::Cylinder {
            ends: fields.read("ends", two_points, ends)?,
            radius: fields.read("radius", number, radius)?,
        },
        Solid::Cone { apex, axis, height, half_angle_degrees } => Solid::Cone {
            apex: fields.read("apex", vector, apex)?,
            axis: unit(fields.read("axis", vector, axis)?),
            height: fields.read("height", number, height)?,
            half_angle_degrees: fields.read("half_angle_degrees", number, half_angle_degrees)?,
        },
    })
}

fn material(node: Node<'_>, place: Place<'_>) -> Result<Material, Fault> {
    const FIELDS: &[&str] =
        &["color", "ambient", "diffuse", "specular", "reflection", "shininess", "transmission", "refractive_index"];
    let fields = Fields::of(node, place, "material.", FIELDS)?;
    let default = Material::default();
    Ok(Material {
        color: fields.read("color", vector, default.color)?,
        ambient: fields.read("ambient", number, default.ambient)?,
        diffuse: fields.read("diffuse", number, default.diffuse)?,
        specular: fields.read("specular", number, default.specular)?,
        reflection: fields.read("reflection", some_number, None)?,
        shininess: fields.read("shininess", number, default.shininess)?,
        transmission: fields.read("transmission", number, default.transmission)?,
        refractive_index: fields.read("refractive_index", number, default.refractive_index)?,
    })
}

/// The entries of one table, all of them known and none twice.
struct Fields<'t> {
    place: Place<'t>,
    /// Stands before the field's name in messages.
    prefix: &'static str,
    entries: Vec<Entry<'t>>,
}

impl<'t> Fields<'t> {
    fn of(node: Node<'t>, place: Place<'t>, prefix: &'static str, allowed: &[&str]) -> Result<Self, Fault> {
        let Shape::Table(entries) = node.shape() else { return Err(wrong_table(node, place, prefix)) };
        for (index, entry) in entries.iter().enumerate() {
            let refuse = |problem: String| Err(Fault { offset: entry.key_offset, what: format!("{place}{problem}") });
            let key = text::one_line(entry.key, text::LONGEST_QUOTE);
            if !allowed.contains(&entry.key) {
                return refuse(format!("unknown field {prefix}{key}; allowed: {}", allowed.join(", ")));
            }
            // Few: at the latest the entry after all the allowed ones is unknown or a repetition.
            if entries[..index].iter().any(|earlier| earlier.key == entry.key) {
                return refuse(format!("{prefix}{key} is given twice"));
            }
        }
        Ok(Self { place, prefix, entries })
    }

    fn get(&self, key: &str) -> Option<Node<'t>> {
        self.entries.iter().find(|entry| entry.key == key).map(|entry| entry.value)
    }

    /// The field through `convert`, which answers with the rule when the value breaks it; `default` without the field.
    fn read<T>(
        &self,
        key: &'static str,
        convert: impl Fn(Node<'t>) -> Result<T, &'static str>,
        default: T,
    ) -> Result<T, Fault> {
        let Some(node) = self.get(key) else { return Ok(default) };
        convert(node).map_err(|rule| wrong(node, self.place, self.prefix, key, rule))
    }

    fn list<T>(
        &self,
        key: &'static str,
        check_count: impl Fn(usize) -> Result<(), Violation<'static>>,
        element: impl Fn(usize, Node<'t>) -> Result<T, Fault>,
    ) -> Result<Option<Vec<T>>, Fault> {
        let Some(node) = self.get(key) else { return Ok(None) };
        let Shape::Array(nodes) = node.shape() else {
            return Err(wrong(node, self.place, self.prefix, key, "must be an array of tables"));
        };
        // Before millions of them are made.
        check_count(nodes.len()).map_err(|violation| Fault { offset: node.offset(), what: violation.to_string() })?;
        let elements = nodes.iter().enumerate().map(|(index, node)| element(index, node));
        elements.collect::<Result<_, _>>().map(Some)
    }
}

fn wrong(node: Node<'_>, place: Place<'_>, prefix: &str, key: &str, rule: &str) -> Fault {
    Fault { offset: node.offset(), what: format!("{place}{prefix}{key} = {}: {rule}", node.quote()) }
}

fn wrong_table(node: Node<'_>, place: Place<'_>, prefix: &str) -> Fault {
    let what = prefix.strip_suffix('.').map(|field| format!("{field} = ")).unwrap_or_default();
    Fault { offset: node.offset(), what: format!("{place}{what}{}: must be a table of fields", node.quote()) }
}

fn number(node: Node<'_>) -> Result<f64, &'static str> {
    let value = match node.shape() {
        Shape::Float(digits) | Shape::Integer { digits, radix: 10 } => digits.parse::<f64>().ok(),
        Shape::Integer { digits, radix } => u64::from_str_radix(digits, radix).ok().map(|value| value as f64),
        _ => None,
    };
    match value {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => Err(FINITE),
        None => Err("must be a number"),
    }
}

fn some_number(node: Node<'_>) -> Result<Option<f64>, &'static str> {
    number(node).map(Some)
}

fn vector(node: Node<'_>) -> Result<DVec3, &'static str> {
    const RULE: &str = "must be an array of three numbers";
    let Shape::Array(nodes) = node.shape() else { return Err(RULE) };
    let [x, y, z] = nodes.exactly().ok_or(RULE)?;
    let component = |node| number(node).map_err(|rule| if rule == FINITE { rule } else { RULE });
    Ok(DVec3::new(component(x)?, component(y)?, component(z)?))
}

fn two_points(node: Node<'_>) -> Result<[DVec3; 2], &'static str> {
    const RULE: &str = "must be an array of two points of three numbers each";
    let Shape::Array(nodes) = node.shape() else { return Err(RULE) };
    let [start, end] = nodes.exactly().ok_or(RULE)?;
    let point = |node| vector(node).map_err(|rule| if rule == FINITE { rule } else { RULE });
    Ok([point(start)?, point(end)?])
}

fn depth(node: Node<'_>) -> Result<u32, &'static str> {
    match node.shape() {
        Shape::Integer { digits, radix } => u32::from_str_radix(digits, radix).map_err(|_| DEPTH),
        _ => Err(DEPTH),
    }
}

fn projection(node: Node<'_>) -> Result<Projection, &'static str> {
    match node.shape() {
        Shape::String(name) => Projection::ALL.into_iter().find(|projection| projection.name() == name),
        _ => None,
    }
    .ok_or("must be \"centered\" or \"course\"")
}

const KINDS: &str = "must be \"sphere\", \"box\", \"cylinder\" or \"cone\"";

fn solid_kind(node: Node<'_>) -> Result<SolidKind, &'static str> {
    match node.shape() {
        Shape::String(name) => SolidKind::ALL.into_iter().find(|kind| kind.name() == name),
        _ => None,
    }
    .ok_or(KINDS)
}

fn string(node: Node<'_>) -> Result<Option<String>, &'static str> {
    match node.shape() {
        Shape::String(string) => Ok(Some(string.to_owned())),
        _ => Err("must be a string"),
    }
}
