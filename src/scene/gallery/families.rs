//! Scenes of any number of solids, up to a million: made when asked for, never written to `scenes/`.

use glam::DVec3;
use rayon::prelude::*;

use super::{Entry, figures};
use crate::scene::validate::unit;
use crate::scene::{Camera, Light, Material, Primitive, Scene, Solid, SolidKind};

/// Largest number of solids.
pub const FAMILY_LIMIT: usize = 1_000_000;

/// A name that a family makes a scene for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Member {
    /// `squares-N`
    Squares(usize),
    /// `cloud-N` or `cloud-KIND-N`
    Cloud(Option<SolidKind>, usize),
}

pub(super) fn entries() -> Vec<Entry> {
    let families = [
        (
            "squares-N",
            "N spheres on a square grid, 1 to 1000000; table 4.1's camera and light",
            "N сфер квадратом, от 1 до 1000000; камера и свет таблицы 4.1",
        ),
        (
            "cloud-N",
            "N solids of the four kinds at random, 1 to 1000000; the same ones every time",
            "N случайных тел четырёх видов, от 1 до 1000000; всегда одни и те же",
        ),
        (
            "cloud-KIND-N",
            "the same of one kind: sphere, box, cylinder or cone",
            "то же одного вида: sphere, box, cylinder или cone",
        ),
    ];
    let entry = |(name, english, russian): (&str, &str, &str)| Entry {
        name: name.into(),
        english: english.into(),
        russian: russian.into(),
    };
    families.map(entry).to_vec()
}

impl Member {
    pub(super) fn named(name: &str) -> Option<Self> {
        let (family, number) = name.rsplit_once('-')?;
        let count: usize = number.parse().ok()?;
        // One name a scene: neither `+7` nor `007`.
        if count.to_string() != number || !(1..=FAMILY_LIMIT).contains(&count) {
            return None;
        }
        match family {
            "squares" => Some(Self::Squares(count)),
            "cloud" => Some(Self::Cloud(None, count)),
            _ => {
                let kind = family.strip_prefix("cloud-")?;
                let kind = SolidKind::ALL.into_iter().find(|known| known.name() == kind)?;
                Some(Self::Cloud(Some(kind), count))
            }
        }
    }

    pub(super) fn make(self) -> Scene {
        match self {
            Self::Squares(count) => {
                let side = count.isqrt();
                let side = if side * side < count { side + 1 } else { side };
                figures::rows(SolidKind::Sphere, count, side)
            }
            Self::Cloud(kind, count) => cloud(kind, count),
        }
    }
}

/// Solids of about a world unit in a cube that has eight cubic units for each, seen whole from outside: however many
/// there are, as many of them overlap, and as many lie behind each other along the edge of one of them.
fn cloud(kind: Option<SolidKind>, count: usize) -> Scene {
    let half_side = (count as f64).cbrt();
    let primitives =
        (0..count as u64).into_par_iter().map(|index| random_primitive(Random::of(index), kind, half_side));
    let position = DVec3::new(1.1, 1.7, -4.2) * half_side;
    Scene {
        camera: Camera { position, direction: -position, vertical_fov_degrees: 40.0, ..Camera::default() },
        lights: vec![Light { position: DVec3::new(-3.0, 5.0, -4.0) * half_side, ..Light::default() }],
        primitives: primitives.collect(),
        ..Scene::default()
    }
}

fn random_primitive(mut random: Random, kind: Option<SolidKind>, half_side: f64) -> Primitive {
    let kind = kind.unwrap_or(SolidKind::ALL[(random.bits() % 4) as usize]);
    let center = random.vector(-1.0, 1.0) * half_side;
    let solid = match kind {
        SolidKind::Sphere => Solid::Sphere { center, radius: random.number(0.2, 0.8) },
        SolidKind::Box => {
            let half_size = random.vector(0.2, 0.8);
            Solid::Box { center, half_size, rotation_degrees: random.vector(0.0, 360.0) }
        }
        SolidKind::Cylinder => {
            let half_axis = random.axis() * random.number(0.2, 0.8);
            Solid::Cylinder { ends: [center - half_axis, center + half_axis], radius: random.number(0.1, 0.6) }
        }
        SolidKind::Cone => {
            let (axis, height) = (random.axis(), random.number(0.4, 1.6));
            let half_angle_degrees = random.number(10.0, 40.0);
            Solid::Cone { apex: center - axis * (height / 2.0), axis, height, half_angle_degrees }
        }
    };
    let material = Material::of_course(random.vector(0.2, 1.0), 0.1, 0.6, random.number(0.0, 0.5));
    Primitive { name: None, solid, material }
}

/// Steele, Lea and Flood's SplitMix64: a few lines that give the same scenes with every version of every library.
struct Random(u64);

impl Random {
    /// Numbers of their own for each solid.
    fn of(index: u64) -> Self {
        // Begun anew from a mixed number, lest each solid's numbers be the next one's, moved by one.
        Self(Self(index).bits())
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    fn number(&mut self, low: f64, high: f64) -> f64 {
        const STEPS: f64 = (1_u64 << 53) as f64;
        low + (high - low) * ((self.bits() >> 11) as f64 / STEPS)
    }

    fn vector(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.number(low, high)))
    }

    /// Unit vector, all directions alike.
    fn axis(&mut self) -> DVec3 {
        loop {
            let vector = self.vector(-1.0, 1.0);
            if (0.01..=1.0).contains(&vector.length_squared()) {
                return unit(vector);
            }
        }
    }
}
