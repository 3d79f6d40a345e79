//! POV-Ray 3.7's scene description language, written only: POV-Ray draws this program's light model, so that another
//! renderer can be asked whether a picture is right. How each term is said there: docs/light-model.md.

use std::fmt::{self, Write};

use glam::DVec3;

use super::{Export, Written};
use crate::scene::{Camera, Light, Material, Primitive, Projection, Scene, Solid, farthest_coordinate, world_from_box};

/// POV-Ray takes no more generations of a ray.
const MOST_GENERATIONS: u32 = 256;

pub(super) fn write(scene: &Scene, export: &Export) -> Written {
    let mut losses = Vec::new();
    let writer = Writer {
        exposure: export.exposure.unwrap_or_else(|| exposure_below(ceiling(scene))),
        length: export.length_scale.unwrap_or_else(|| length_scale(scene)),
    };
    let depth = scene.max_depth.min(MOST_GENERATIONS);
    if depth < scene.max_depth {
        losses
            .push(format!("max_depth is {MOST_GENERATIONS}, the most that POV-Ray takes, and not {}", scene.max_depth));
    }
    let [width, height] = export.size;
    let mut text = format!(
        "// Written by zerkalo. This draws the picture, linear, in 16 bits, 1/{exposure} of its brightness:\n\
         //   povray +IFILE.pov +OFILE.png +W{width} +H{height} +FN16 -A -GA -D File_Gamma=1.0 Display_Gamma=1.0\n\
         // Lengths are {length} times the scene's.\n\
         #version 3.7;\n\
         global_settings {{ assumed_gamma 1 max_trace_level {depth} adc_bailout 0 ambient_light rgb 1 }}\n\
         background {{ {background} }}\n\
         {camera}\n",
        exposure = writer.exposure.recip(),
        length = writer.length,
        background = Rgb(scene.background * writer.exposure),
        camera = writer.camera(&scene.camera, f64::from(width) / f64::from(height)),
    );
    for light in &scene.lights {
        text += &writer.light(light, scene.camera.position);
    }
    if scene.has_transmission() && scene.lights.iter().any(|light| light.radius > 0.0) {
        losses.push("light spheres are seen through what lets light through, too".to_owned());
    }
    let mut lines = 0;
    for primitive in &scene.primitives {
        match writer.solid(&primitive.solid) {
            Some(shape) => text += &writer.primitive(primitive, &shape, scene.ambient_light),
            None => lines += 1,
        }
    }
    if lines > 0 {
        losses.push(format!("{lines} boxes without an area are left out"));
    }
    if scene.primitives.iter().any(|primitive| is_lost(&primitive.material)) {
        losses.push("what lets all light through has no colour of its own".to_owned());
    }
    if !scene.animation.is_empty() {
        losses.push("nothing moves: the scene is as its file has it".to_owned());
    }
    Written { bytes: text.into_bytes(), losses }
}

/// Opacity 0 scales the surface's own light away.
fn is_lost(material: &Material) -> bool {
    material.transmission == 1.0 && (material.ambient > 0.0 || material.diffuse > 0.0)
}

/// A bound on any channel of any pixel: see docs/light-model.md.
fn ceiling(scene: &Scene) -> f64 {
    let arriving = |light: &Light| light.intensity.max_element() / light.distance_constant.unwrap_or(1.0);
    let lit: f64 = scene.lights.iter().map(arriving).sum();
    let light_spheres = scene.lights.iter().map(|light| light.intensity.max_element()).fold(0.0, f64::max);
    let background = scene.background.max_element();
    let mut most = background;
    for _ in 0..scene.max_depth.min(MOST_GENERATIONS) {
        let sent = |Primitive { material, .. }: &Primitive| {
            let color = material.color.max_element();
            let own = material.ambient * color * scene.ambient_light.max_element();
            own + (material.diffuse * color + material.specular) * lit
                + (material.reflection() + material.transmission) * most
        };
        most = scene.primitives.iter().map(sent).fold(background, f64::max);
    }
    most.max(light_spheres)
}

/// The largest power of two, at most 1, that brings `most` to 1 or below.
pub(crate) fn exposure_below(most: f64) -> f64 {
    if most <= 1.0 { 1.0 } else { most.log2().ceil().min(1000.0).exp2().recip() }
}

/// POV-Ray's tolerances are fixed lengths, made for coordinates of some thousands: the power of two that brings the
/// largest to 1024 to 2048.
fn length_scale(scene: &Scene) -> f64 {
    let points = scene.lights.iter().map(|light| light.position).chain([scene.camera.position]);
    let solids = farthest_coordinate(&scene.primitives, DVec3::ZERO);
    let largest = points.map(|point| point.abs().max_element()).fold(solids, f64::max);
    if largest > 0.0 { (10.0 - largest.log2().floor()).clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}

struct Writer {
    /// Times every intensity.
    exposure: f64,
    /// Times every length.
    length: f64,
}

impl Writer {
    /// `aspect`: width by height. The window is told by its own vectors, so that POV-Ray's hand does not matter.
    fn camera(&self, camera: &Camera, aspect: f64) -> String {
        let along = camera.direction.normalize();
        let right = along.cross(camera.up.normalize()).normalize();
        let up = right.cross(along);
        let half_height = (camera.vertical_fov_degrees / 2.0).to_radians().tan();
        let half_width = half_height * aspect;
        let (middle, extent) = match camera.projection {
            Projection::Centered => (along, 1.0),
            // [-3,1]×[-3,1] in half extents.
            Projection::Course => (along - half_width * right - half_height * up, 2.0),
        };
        format!(
            "camera {{ perspective location {} direction {} right {} up {} }}",
            Vector(camera.position * self.length),
            Vector(middle),
            Vector(right * (2.0 * extent * half_width)),
            Vector(up * (2.0 * extent * half_height)),
        )
    }

    fn light(&self, light: &Light, camera: DVec3) -> String {
        let center = light.position * self.length;
        // POV-Ray's is 2 / (1 + d/K) times as bright at distance d.
        let (share, fading) = match light.distance_constant {
            Some(k) => ((2.0 * k).recip(), format!(" fade_power 1 fade_distance {:?}", k * self.length)),
            None => (1.0, String::new()),
        };
        let color = Rgb(light.intensity * self.exposure * share);
        let mut text = format!("light_source {{ {} {color}{fading} }}\n", Vector(center));
        if light.radius > 0.0 && camera.distance(light.position) >= light.radius {
            let (radius, color) = (light.radius * self.length, Rgb(light.intensity * self.exposure));
            let _ = writeln!(
                text,
                "sphere {{ {}, {radius:?} pigment {{ {color} }} finish {{ ambient 0 diffuse 0 emission 1 }} no_shadow \
                 no_reflection }}",
                Vector(center)
            );
        }
        text
    }

    /// An object up to its texture; `None` where it has no area.
    fn solid(&self, solid: &Solid) -> Option<String> {
        let point = |point: DVec3| Vector(point * self.length);
        let long = |length: f64| length * self.length;
        Some(match solid {
            Solid::Sphere { center, radius } => format!("sphere {{ {}, {:?}", point(*center), long(*radius)),
            Solid::Box { center, half_size, rotation_degrees } => {
                let rotation = world_from_box(*rotation_degrees);
                if solid.is_plate() {
                    let axes: Vec<DVec3> = (0..3)
                        .filter(|&axis| half_size[axis] > 0.0)
                        .map(|axis| rotation.col(axis) * half_size[axis])
                        .collect();
                    let &[a, b] = &axes[..] else { return None };
                    let corners =
                        [-a - b, a - b, a + b, b - a, -a - b].map(|corner| point(*center + corner).to_string());
                    return Some(format!("polygon {{ 5, {}", corners.join(", ")));
                }
                let [x, y, z] = [rotation.x_axis, rotation.y_axis, rotation.z_axis].map(Vector);
                format!(
                    "box {{ {}, {} matrix <{x:?}, {y:?}, {z:?}, {:?}>",
                    point(-*half_size),
                    point(*half_size),
                    point(*center)
                )
            }
            Solid::Cylinder { ends, radius } => {
                format!("cylinder {{ {}, {}, {:?}", point(ends[0]), point(ends[1]), long(*radius))
            }
            Solid::Cone { apex, axis, height, half_angle_degrees } => {
                let radius = height * half_angle_degrees.to_radians().tan();
                format!("cone {{ {}, 0, {}, {:?}", point(*apex), point(*apex + *axis * *height), long(radius))
            }
        })
    }

    fn primitive(&self, Primitive { material, .. }: &Primitive, shape: &str, ambient_light: DVec3) -> String {
        let transmission = material.transmission;
        // Opacity scales a surface's own light in POV-Ray, and does not here.
        let opacity = if transmission < 1.0 { 1.0 - transmission } else { 1.0 };
        let DVec3 { x, y, z } = material.color;
        let interior = if transmission > 0.0 && material.refractive_index != 1.0 {
            format!(" interior {{ ior {:?} }}", material.refractive_index)
        } else {
            String::new()
        };
        format!(
            "{shape} pigment {{ rgbt <{x:?}, {y:?}, {z:?}, {transmission:?}> }} finish {{ ambient {} diffuse {:?} phong {:?} \
             phong_size {:?} reflection {{ rgb {:?} }} }}{interior} }}\n",
            Rgb(ambient_light * (self.exposure * material.ambient / opacity)),
            material.diffuse / opacity,
            material.specular,
            f64::from(material.shininess_256()) / 256.0,
            material.reflection(),
        )
    }
}

struct Vector(DVec3);

impl fmt::Display for Vector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "<{self:?}>")
    }
}

impl fmt::Debug for Vector {
    /// Without brackets.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}, {:?}, {:?}", self.0.x, self.0.y, self.0.z)
    }
}

struct Rgb(DVec3);

impl fmt::Display for Rgb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "rgb {}", Vector(self.0))
    }
}
