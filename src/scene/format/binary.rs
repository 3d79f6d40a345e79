//! `.zscene`: a scene in bytes, for those too large for text. What it means is the text forms' business: the same
//! fields, the same rules.
//!
//! Integers and numbers have their lowest byte first; a number is an `f64`.
//!
//! | what | as |
//! | --- | --- |
//! | `zscene` CR LF | 8 bytes |
//! | version: 4 where anything moves, else 3 where anything is not as in the course work but a light's radius, else 2 where one is not 0.01, else 1 | u32 |
//! | max_depth | u32 |
//! | background | 3 numbers |
//! | from version 3 on: ambient_light | 3 numbers |
//! | camera: position, direction, up, vertical_fov_degrees | 10 numbers |
//! | projection: 0 is centered, 1 is course | u8 |
//! | count of lights | u64 |
//! | each: position, intensity, from version 2 on radius, from version 3 on distance_constant or 0 | 6, 7 or 8 numbers |
//! | count of primitives | u64 |
//! | each: kind (0 sphere, 1 box, 2 cylinder, 3 cone), and 128 where it has a name | u8 |
//! | its name, if any, in UTF-8: bytes, and they | u64, bytes |
//! | its geometry, in the order of the text forms' fields | 4, 9, 7 or 8 numbers |
//! | its material: color, ambient, diffuse, specular | 6 numbers |
//! | from version 3 on: reflection or −1, shininess, transmission, refractive_index | 4 numbers |
//! | of version 4: the JSON form's `animation` in an object of its own: bytes, and they | u64, bytes |
//! | CRC-32 of all before | u32 |

use glam::DVec3;

use super::markup::Markup;
use super::tree::Document;
use super::{Fault, JSON, decode, write};
use crate::scene::validate::{Place, Violation, check_light_count, check_primitive_count, unit};
use crate::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid, SolidKind};

/// With a line's end as text has it on some systems, so that a transfer that took the file for text is seen at once.
const MAGIC: [u8; 8] = *b"zscene\r\n";
/// All lights have the radius of the course's.
const VERSION: u32 = 1;
/// Each light has its radius.
const VERSION_OF_RADII: u32 = 2;
/// All of the light model.
const VERSION_OF_LIGHT_MODEL: u32 = 3;
/// An animation.
const VERSION_OF_ANIMATION: u32 = 4;
/// In a kind's byte.
const HAS_NAME: u8 = 128;
/// Bytes of the smallest light, and of the smallest primitive.
const LIGHT_BYTES: usize = 6 * 8;
const SMALLEST_PRIMITIVE_BYTES: usize = 1 + (4 + 6) * 8;

pub(super) fn encode(scene: &Scene) -> Vec<u8> {
    let Scene { camera, background, ambient_light, max_depth, lights, primitives, animation } = scene;
    let room = 256 + lights.len() * LIGHT_BYTES + primitives.len() * SMALLEST_PRIMITIVE_BYTES;
    let version = least_version(scene);
    let mut writer = Writer { bytes: Vec::with_capacity(room), version };
    writer.raw(&MAGIC);
    writer.raw(&version.to_le_bytes());
    writer.raw(&max_depth.to_le_bytes());
    writer.vector(*background);
    if version >= VERSION_OF_LIGHT_MODEL {
        writer.vector(*ambient_light);
    }
    [camera.position, camera.direction, camera.up].into_iter().for_each(|vector| writer.vector(vector));
    writer.number(camera.vertical_fov_degrees);
    writer.raw(&[match camera.projection {
        Projection::Centered => 0,
        Projection::Course => 1,
    }]);
    writer.count(lights.len());
    for light in lights {
        writer.vector(light.position);
        writer.vector(light.intensity);
        if version >= VERSION_OF_RADII {
            writer.number(light.radius);
        }
        if version >= VERSION_OF_LIGHT_MODEL {
            writer.number(light.distance_constant.unwrap_or(NO_CONSTANT));
        }
    }
    writer.count(primitives.len());
    primitives.iter().for_each(|primitive| writer.primitive(primitive));
    if !animation.is_empty() {
        let text = format!("{{\"animation\": {}}}", write::animation(scene, Markup::Json));
        writer.count(text.len());
        writer.raw(text.as_bytes());
    }
    let sum = crc32fast::hash(&writer.bytes);
    writer.raw(&sum.to_le_bytes());
    writer.bytes
}

/// The oldest that has room for the scene, so that programs which know no newer one read what needs none.
fn least_version(scene: &Scene) -> u32 {
    let usual = Material::default();
    let is_of_course = |Primitive { material, .. }: &Primitive| {
        let Material {
            color: _,
            ambient: _,
            diffuse: _,
            specular: _,
            reflection,
            shininess,
            transmission,
            refractive_index,
        } = *material;
        reflection.is_none()
            && [shininess, transmission, refractive_index].map(f64::to_bits)
                == [usual.shininess, usual.transmission, usual.refractive_index].map(f64::to_bits)
    };
    let has_constants = scene.lights.iter().any(|light| light.distance_constant.is_some());
    if !scene.animation.is_empty() {
        VERSION_OF_ANIMATION
    } else if scene.ambient_light != DVec3::ONE || has_constants || !scene.primitives.iter().all(is_of_course) {
        VERSION_OF_LIGHT_MODEL
    } else if scene.lights.iter().any(|light| light.radius != Light::COURSE_RADIUS) {
        VERSION_OF_RADII
    } else {
        VERSION
    }
}

/// Distance constant of a light without attenuation; others are greater than 0.
const NO_CONSTANT: f64 = 0.0;
/// Reflection of a material whose reflection is its specular coefficient.
const AS_SPECULAR: f64 = -1.0;

struct Writer {
    bytes: Vec<u8>,
    version: u32,
}

impl Writer {
    fn raw(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    fn count(&mut self, count: usize) {
        self.raw(&(count as u64).to_le_bytes());
    }

    fn number(&mut self, number: f64) {
        self.raw(&number.to_le_bytes());
    }

    fn vector(&mut self, vector: DVec3) {
        vector.to_array().into_iter().for_each(|number| self.number(number));
    }

    fn primitive(&mut self, Primitive { name, solid, material }: &Primitive) {
        let kind = solid.kind() as u8;
        match name {
            None => self.raw(&[kind]),
            Some(name) => {
                self.raw(&[kind | HAS_NAME]);
                self.count(name.len());
                self.raw(name.as_bytes());
            }
        }
        match *solid {
            Solid::Sphere { center, radius } => {
                self.vector(center);
                self.number(radius);
            }
            Solid::Box { center, half_size, rotation_degrees } => {
                [center, half_size, rotation_degrees].into_iter().for_each(|vector| self.vector(vector));
            }
            Solid::Cylinder { ends, radius } => {
                ends.into_iter().for_each(|end| self.vector(end));
                self.number(radius);
            }
            Solid::Cone { apex, axis, height, half_angle_degrees } => {
                self.vector(apex);
                self.vector(axis);
                self.number(height);
                self.number(half_angle_degrees);
            }
        }
        self.vector(material.color);
        let Material { color: _, ambient, diffuse, specular, reflection, shininess, transmission, refractive_index } =
            *material;
        [ambient, diffuse, specular].into_iter().for_each(|number| self.number(number));
        if self.version >= VERSION_OF_LIGHT_MODEL {
            let reflection = reflection.unwrap_or(AS_SPECULAR);
            [reflection, shininess, transmission, refractive_index].into_iter().for_each(|number| self.number(number));
        }
    }
}

/// What the values mean is not looked at.
pub(super) fn decode(bytes: &[u8]) -> Result<Scene, Fault> {
    let mut reader = Reader { bytes, offset: 0, version: VERSION, place: Place::Scene };
    if reader.bytes::<8>()? != MAGIC {
        return Err(Fault { offset: 0, what: "not a zscene file: its first bytes are others".to_owned() });
    }
    let version = reader.u32()?;
    if !(VERSION..=VERSION_OF_ANIMATION).contains(&version) {
        let known = format!("{VERSION} to {VERSION_OF_ANIMATION} are");
        return Err(reader.fault(4, format!("version {version} of zscene files is not known here: {known}")));
    }
    reader.version = version;
    let scene = reader.scene()?;
    let sum = crc32fast::hash(&bytes[..reader.offset]);
    let at = reader.offset;
    if reader.u32()? != sum {
        return Err(Fault { offset: at, what: "the checksum is that of other bytes: the file is damaged".to_owned() });
    }
    match bytes.len() - reader.offset {
        0 => Ok(scene),
        more => Err(reader.fault(0, format!("{more} bytes more than the scene has"))),
    }
}

struct Reader<'b> {
    bytes: &'b [u8],
    /// Offset of what is read next.
    offset: usize,
    version: u32,
    /// That belongs to this.
    place: Place<'b>,
}

impl<'b> Reader<'b> {
    /// About what was read so many bytes ago.
    fn fault(&self, ago: usize, what: String) -> Fault {
        Fault { offset: self.offset - ago, what: format!("{}{what}", self.place) }
    }

    fn slice(&mut self, length: u64) -> Result<&'b [u8], Fault> {
        let left = &self.bytes[self.offset..];
        let taken = usize::try_from(length).ok().and_then(|length| left.get(..length));
        let taken = taken.ok_or_else(|| {
            let what = format!("the file ends too soon: {length} bytes should follow, and {} do", left.len());
            self.fault(0, what)
        })?;
        self.offset += taken.len();
        Ok(taken)
    }

    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.slice(N as u64)?);
        Ok(bytes)
    }

    fn u32(&mut self) -> Result<u32, Fault> {
        self.bytes().map(u32::from_le_bytes)
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N], Fault> {
        let mut numbers = [0.0; N];
        let (bytes, _) = self.slice(8 * N as u64)?.as_chunks::<8>();
        for (number, bytes) in numbers.iter_mut().zip(bytes) {
            *number = f64::from_le_bytes(*bytes);
        }
        Ok(numbers)
    }

    fn vectors<const N: usize>(&mut self) -> Result<[DVec3; N], Fault> {
        let mut vectors = [DVec3::ZERO; N];
        for vector in &mut vectors {
            *vector = DVec3::from_array(self.numbers()?);
        }
        Ok(vectors)
    }

    fn scene(&mut self) -> Result<Scene, Fault> {
        let max_depth = self.u32()?;
        let [background] = self.vectors()?;
        let has_light_model = self.version >= VERSION_OF_LIGHT_MODEL;
        let [ambient_light] = if has_light_model { self.vectors()? } else { [DVec3::ONE] };
        self.place = Place::Camera;
        let camera = self.camera()?;
        self.place = Place::Scene;
        let lights = self.list(check_light_count, LIGHT_BYTES, Self::light)?;
        let primitives = self.list(check_primitive_count, SMALLEST_PRIMITIVE_BYTES, Self::primitive)?;
        let mut scene =
            Scene { camera, background, ambient_light, max_depth, lights, primitives, animation: Vec::new() };
        if self.version >= VERSION_OF_ANIMATION {
            let text = self.text("its animation")?;
            if text.len() as u64 > JSON.largest {
                let what = format!("its animation has {} bytes, and at most {} are read", text.len(), JSON.largest);
                return Err(self.fault(text.len(), what));
            }
            let start = self.offset - text.len();
            let moved = Fault::moved_by(start);
            scene.animation =
                decode::animation_of(Document::parse_json(text).map_err(moved)?.root(), &scene).map_err(moved)?;
        }
        Ok(scene)
    }

    fn camera(&mut self) -> Result<Camera, Fault> {
        let [position, direction, up] = self.vectors()?;
        let [vertical_fov_degrees] = self.numbers()?;
        let projection = match self.bytes()? {
            [0] => Projection::Centered,
            [1] => Projection::Course,
            [other] => {
                return Err(self.fault(1, format!("projection = {other}: must be 0 (centered) or 1 (course)")));
            }
        };
        Ok(Camera { position, direction, up, vertical_fov_degrees, projection })
    }

    fn list<T>(
        &mut self,
        check_count: impl Fn(usize) -> Result<(), Violation<'static>>,
        smallest_bytes: usize,
        element: impl Fn(&mut Self, usize) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let count = usize::try_from(u64::from_le_bytes(self.bytes()?)).unwrap_or(usize::MAX);
        check_count(count).map_err(|violation| self.fault(8, violation.to_string()))?;
        // The count may be a lie, the length of the file is not.
        let possible = (self.bytes.len() - self.offset) / smallest_bytes;
        let mut elements = Vec::with_capacity(count.min(possible));
        for index in 0..count {
            elements.push(element(self, index)?);
        }
        self.place = Place::Scene;
        Ok(elements)
    }

    fn light(&mut self, index: usize) -> Result<Light, Fault> {
        self.place = Place::Light(index);
        let [position, intensity] = self.vectors()?;
        let [radius] = if self.version >= VERSION_OF_RADII { self.numbers()? } else { [Light::COURSE_RADIUS] };
        let [constant] = if self.version >= VERSION_OF_LIGHT_MODEL { self.numbers()? } else { [NO_CONSTANT] };
        let distance_constant = (constant != NO_CONSTANT).then_some(constant);
        Ok(Light { position, intensity, radius, distance_constant })
    }

    fn primitive(&mut self, index: usize) -> Result<Primitive, Fault> {
        self.place = Place::Primitive { index, kind: None, name: None };
        let [first] = self.bytes()?;
        let kind = SolidKind::ALL.into_iter().find(|&kind| kind as u8 == first & !HAS_NAME).ok_or_else(|| {
            let rule = "must be 0 (sphere), 1 (box), 2 (cylinder) or 3 (cone), and 128 more with a name";
            self.fault(1, format!("kind = {first}: {rule}"))
        })?;
        self.place = Place::Primitive { index, kind: Some(kind), name: None };
        let name = if first & HAS_NAME != 0 { Some(self.text("its name")?) } else { None };
        self.place = Place::Primitive { index, kind: Some(kind), name };
        let solid = self.solid(kind)?;
        let material = self.material()?;
        Ok(Primitive { name: name.map(str::to_owned), solid, material })
    }

    fn material(&mut self) -> Result<Material, Fault> {
        let [color] = self.vectors()?;
        let [ambient, diffuse, specular] = self.numbers()?;
        let usual = Material { color, ambient, diffuse, specular, ..Material::default() };
        if self.version < VERSION_OF_LIGHT_MODEL {
            return Ok(usual);
        }
        let [reflection, shininess, transmission, refractive_index] = self.numbers()?;
        let reflection = (reflection != AS_SPECULAR).then_some(reflection);
        Ok(Material { reflection, shininess, transmission, refractive_index, ..usual })
    }

    /// Its length, and itself.
    fn text(&mut self, what: &str) -> Result<&'b str, Fault> {
        let length = u64::from_le_bytes(self.bytes()?);
        let bytes = self.slice(length)?;
        std::str::from_utf8(bytes).map_err(|error| self.fault(bytes.len(), format!("{what} is not UTF-8: {error}")))
    }

    fn solid(&mut self, kind: SolidKind) -> Result<Solid, Fault> {
        Ok(match kind {
            SolidKind::Sphere => {
                let [center] = self.vectors()?;
                let [radius] = self.numbers()?;
                Solid::Sphere { center, radius }
            }
            SolidKind::Box => {
                let [center, half_size, rotation_degrees] = self.vectors()?;
                Solid::Box { center, half_size, rotation_degrees }
            }
            SolidKind::Cylinder => {
                let ends = self.vectors()?;
                let [radius] = self.numbers()?;
                Solid::Cylinder { ends, radius }
            }
            SolidKind::Cone => {
                let [apex, axis] = self.vectors()?;
                let [height, half_angle_degrees] = self.numbers()?;
                Solid::Cone { apex, axis: unit(axis), height, half_angle_degrees }
            }
        })
    }
}
