//! NFF, the «Neutral File Format» of Eric Haines' Standard Procedural Databases (version 3.1): spheres, cylinders, cones
//! and polygons under point lights, read as a stream of words.
//!
//! What becomes of it: see docs/scene-files.md.

mod solids;
mod words;

use std::io::Read;

use glam::DVec3;

use self::solids::{Round, rectangle, round};
use self::words::Words;
use super::Reading;
use super::note::Tally;
use crate::frame::Frame;
use crate::scene::validate::{self, check_camera, check_light, check_light_count, check_primitive_count};
use crate::scene::{Camera, Light, Material, Primitive, Scene, SceneError, Solid};

const ENTITIES: &str = "must be one of v, b, l, f, c, s, p, pp";

/// As other readers take an object before the first `f`.
const UNNAMED_FILL: Material = Material::of_course(DVec3::ONE, 0.0, 1.0, 0.0);

pub(super) fn read(file: &mut dyn Read) -> Result<Reading, SceneError> {
    let mut reader = Reader {
        words: Words::new(file),
        // NFF has no light that comes from everywhere: every material's ambient part is 0.
        scene: Scene { background: DVec3::ZERO, lights: Vec::new(), ..Scene::default() },
        size: None,
        has_view: false,
        has_background: false,
        colorless_lights: Vec::new(),
        fill: None,
        tally: Tally::default(),
    };
    while reader.entity()? {}
    reader.finish()
}

struct Reader<'r> {
    words: Words<'r>,
    scene: Scene,
    /// Pixels along x and y.
    size: Option<[u32; 2]>,
    has_view: bool,
    has_background: bool,
    /// Indices of lights without a colour.
    colorless_lights: Vec<usize>,
    /// Of the objects that follow.
    fill: Option<Material>,
    tally: Tally,
}

impl Reader<'_> {
    /// Reads the next; `false` at the end.
    fn entity(&mut self) -> Result<bool, SceneError> {
        if !self.words.advance()? {
            return Ok(false);
        }
        let line = self.words.line();
        match self.words.word() {
            "v" => self.view(line)?,
            "b" => {
                self.scene.background = self.words.vector("b")?;
                self.has_background = true;
                validate::check(&self.bare_scene()).map_err(|violation| at(line, violation.to_string()))?;
            }
            "l" => self.light(line)?,
            "f" => self.fill(line)?,
            "s" => {
                let (center, radius) = (self.words.vector("s")?, self.words.number("s")?);
                if radius < 0.0 {
                    return Err(at(
                        line,
                        format!(
                            "s: radius = {radius}: only its inside is to be seen, which is not drawn here; must be greater than 0"
                        ),
                    ));
                }
                self.push(line, Solid::Sphere { center, radius })?;
            }
            "c" => self.round(line)?,
            "p" => self.polygon(line, "p", false)?,
            "pp" => self.polygon(line, "pp", true)?,
            _ => {
                let what = format!("{}: {ENTITIES}", self.words.quote());
                return Err(at(line, what));
            }
        }
        Ok(true)
    }

    fn finish(mut self) -> Result<Reading, SceneError> {
        if !self.has_view {
            self.tally.assumed("there is no v: the camera is this program's own", None);
        }
        if !self.has_background {
            self.tally.assumed("there is no b: the background is black", None);
        }
        // So that a scene is about as bright however many lights there are.
        let share = (self.scene.lights.len() as f64).sqrt().recip();
        for &index in &self.colorless_lights {
            self.scene.lights[index].intensity = DVec3::splat(share);
        }
        self.scene.validate()?;
        Ok(Reading { scene: self.scene, size: self.size, notes: self.tally.notes() })
    }

    /// What is to be validated of a scene besides its lights and primitives.
    fn bare_scene(&self) -> Scene {
        Scene { camera: self.scene.camera.clone(), background: self.scene.background, ..Scene::default() }
    }

    fn view(&mut self, line: usize) -> Result<(), SceneError> {
        let (mut from, mut target, mut up, mut angle, mut size) = (None, None, None, None, None);
        loop {
            let is_here = self.words.advance()?;
            match if is_here { self.words.word() } else { "" } {
                "from" => from = Some(self.words.vector("from")?),
                "at" => target = Some(self.words.vector("at")?),
                "up" => up = Some(self.words.vector("up")?),
                "angle" => angle = Some(self.words.number("angle")?),
                "hither" => {
                    self.words.number("hither")?;
                    self.tally.assumed("hither is passed over: what is nearer is drawn, too", self.words.line());
                }
                "resolution" => {
                    let mut side = || {
                        let side = self.words.whole("resolution")?;
                        let is_side = (2..=u64::from(Frame::MAX_SIDE)).contains(&side);
                        let rule = format!("resolution = {side}: must be from 2 to {}", Frame::MAX_SIDE);
                        if is_side { Ok(side as u32) } else { Err(at(self.words.line(), rule)) }
                    };
                    size = Some([side()?, side()?]);
                }
                _ => {
                    if is_here {
                        self.words.put_back();
                    }
                    break;
                }
            }
        }
        let missing = |what: &str| at(line, format!("v: {what} is missing"));
        let from = from.ok_or_else(|| missing("from"))?;
        let target = target.ok_or_else(|| missing("at"))?;
        let up = up.ok_or_else(|| missing("up"))?;
        let angle = angle.ok_or_else(|| missing("angle"))?;
        let size = size.ok_or_else(|| missing("resolution"))?;
        if !(angle > 0.0 && angle < 180.0) {
            return Err(at(line, format!("v: angle = {angle}: must be between 0 and 180")));
        }
        // Between the centres of the outer rows, which are N − 1 rows apart; the field of view has all N of them.
        let rows = f64::from(size[1]);
        let half_tan = (angle / 2.0).to_radians().tan() * rows / (rows - 1.0);
        self.scene.camera = Camera {
            position: from,
            direction: target - from,
            up,
            vertical_fov_degrees: (2.0 * half_tan.atan()).to_degrees(),
            ..Camera::default()
        };
        check_camera(&self.scene.camera).map_err(|violation| at(line, violation.to_string()))?;
        if self.has_view {
            self.tally.lost("another v takes the place of the one before", line);
        }
        (self.has_view, self.size) = (true, Some(size));
        Ok(())
    }

    fn light(&mut self, line: usize) -> Result<(), SceneError> {
        let position = self.words.vector("l")?;
        let index = self.scene.lights.len();
        let has_color = self.words.advance()? && {
            self.words.put_back();
            self.words.is_number()
        };
        let intensity = if has_color {
            self.words.vector("l")?
        } else {
            self.colorless_lights.push(index);
            self.tally.assumed("a light has no colour: it gets 1 over the root of how many lights there are", line);
            DVec3::ONE
        };
        let light = Light { position, intensity, radius: 0.0, distance_constant: None };
        check_light(index, &light).map_err(|violation| at(line, violation.to_string()))?;
        check_light_count(index + 1).map_err(|violation| at(line, violation.to_string()))?;
        self.scene.lights.push(light);
        Ok(())
    }

    fn fill(&mut self, line: usize) -> Result<(), SceneError> {
        let color = self.words.vector("f")?;
        let [diffuse, specular, shine, transmission, index] = self.words.numbers("f")?;
        let weights = [color.x, color.y, color.z, diffuse, specular, transmission];
        if weights.iter().any(|weight| *weight < 0.0) {
            return Err(at(line, "f: a color, Kd, Ks or T below 0: each must be from 0 to 1".to_owned()));
        }
        if weights.iter().any(|weight| *weight > 1.0) {
            self.tally.lost("a color, Kd, Ks or T above 1 is taken for 1", line);
        }
        let shininess = shine.clamp(1.0, 1024.0);
        if specular > 0.0 && shininess != shine {
            self.tally.lost("a Shine that is not from 1 to 1024 is taken for the nearer of the two", line);
        }
        let refractive_index = if transmission > 0.0 { index.clamp(0.01, 100.0) } else { 1.0 };
        if transmission > 0.0 && refractive_index != index {
            self.tally
                .lost("an index of refraction that is not from 0.01 to 100 is taken for the nearer of the two", line);
        }
        self.fill = Some(Material {
            shininess,
            transmission: transmission.min(1.0),
            refractive_index,
            ..Material::of_course(color.min(DVec3::ONE), 0.0, diffuse.min(1.0), specular.min(1.0))
        });
        Ok(())
    }

    fn round(&mut self, line: usize) -> Result<(), SceneError> {
        let ends = [self.words.numbers("c")?, self.words.numbers("c")?];
        match round(ends).map_err(|what| at(line, what))? {
            Round::Solid(solid) => {
                self.tally.lost("an open cylinder or cone is drawn with its bases", line);
                self.push(line, solid)?;
            }
            Round::Truncated => self.tally.lost("a truncated cone is left out", line),
        }
        Ok(())
    }

    fn polygon(&mut self, line: usize, entity: &str, has_normals: bool) -> Result<(), SceneError> {
        let count = self.words.whole(entity)?;
        if count < 3 {
            return Err(at(line, format!("{entity}: {count} corners: must be 3 or more")));
        }
        let mut corners = [DVec3::ZERO; 4];
        for index in 0..count {
            let corner = self.words.vector(entity)?;
            if let Some(place) = usize::try_from(index).ok().and_then(|index| corners.get_mut(index)) {
                *place = corner;
            }
            if has_normals {
                self.words.vector(entity)?;
            }
        }
        match rectangle(corners).filter(|_| count == 4) {
            Some(solid) => {
                if has_normals {
                    self.tally.lost("the normals of a patch are passed over", line);
                }
                self.push(line, solid)
            }
            None => {
                self.tally.lost("a polygon that is no rectangle is left out", line);
                Ok(())
            }
        }
    }

    fn push(&mut self, line: usize, solid: Solid) -> Result<(), SceneError> {
        if self.fill.is_none() {
            self.tally.assumed("an object stands before the first f: it is white and diffuse", line);
        }
        let material = self.fill.clone().unwrap_or(UNNAMED_FILL);
        let primitive = Primitive { name: None, solid, material };
        let index = self.scene.primitives.len();
        check_primitive_count(index + 1).map_err(|violation| at(line, violation.to_string()))?;
        validate::check_primitive(index, &primitive).map_err(|violation| at(line, violation.to_string()))?;
        self.scene.primitives.push(primitive);
        Ok(())
    }
}

fn at(line: usize, what: String) -> SceneError {
    SceneError { line: Some(line), ..SceneError::refused(what) }
}
