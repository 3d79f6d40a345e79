//! Whether a picture drawn in `f32` is right.
//!
//! Where no length of a scene is many thousand times another, rounding moves nothing by what a picture could show: that
//! is tested, over the catalogue and random scenes. Elsewhere a sample of the picture's pixels is traced twice on the
//! CPU: by the [reference](crate::reference), and with the numbers, formulations and roundings of the `f32` kernel.
//! That is an estimate, tested against the kernel itself on thousands of random scenes
//! (`tests/kernels/right_by_default.rs`).

mod line;
mod meet;
mod sides;
mod solids;
mod world;

use std::fmt;

use glam::Vec3;
use rayon::prelude::*;

use super::Precision;
use super::ceiling::brightest_source;
use super::lengths::{Lengths, MILD_RATIO};
use super::solids::{from_face_planes, outside_by, size};
use crate::algorithm::Kernel;
use crate::reference::{Hit, PrimaryRays, World};
use crate::scene::{Light, Primitive, Scene, SceneSpace, Solid};
use world::F32World;

/// What rounding to `f32` does to a picture, as far as is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rounding {
    /// Lengths are too near each other for anything that it could show.
    Mild,
    /// No more than a stray one of the pixels that were tested is changed.
    Harmless {
        /// Pixels all over the picture.
        tried: usize,
    },
    /// So many of the pixels that were tested are changed by more than [`Precision::rounding_tolerance`].
    Harmful {
        /// Those that were tested and are changed.
        wrong: usize,
        /// Pixels all over the picture.
        tried: usize,
        /// Looked for among the solids on the wrong pixels' paths.
        cause: Cause,
    },
    /// Lengths differ by `ratio`, and to test pixels would take too long: solids, lights and generations are too many.
    Unknown {
        /// How many times the smallest length the scene is.
        ratio: f64,
    },
}

/// Where the trouble comes from: indices of primitives, world lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cause {
    /// The primitive whose numbers are rounded most.
    pub primitive: usize,
    /// The largest of its radius, half edges, half axis or height.
    pub size: f64,
    /// How far rounding moves its surface.
    pub shift: f64,
    /// What the shift is too large for.
    pub near: Near,
}

/// What is too small or too near for such a shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Near {
    /// The smallest of the others.
    Primitive {
        /// Its index.
        primitive: usize,
        /// As [`Cause::size`].
        size: f64,
    },
    /// The camera, where it is nearer to that surface than any other primitive is wide.
    Camera {
        /// Distance from the camera to that surface, or less.
        distance: f64,
    },
    /// Nothing is, but curved mirrors magnify it.
    Mirrors,
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Self { primitive, size, shift, near } = self;
        write!(
            f,
            "primitive {} is {} wide: f32 moves its surface by {}, and ",
            primitive + 1,
            Short(size),
            Short(shift)
        )?;
        match near {
            Near::Primitive { primitive, size } => write!(f, "primitive {} is {} wide", primitive + 1, Short(size)),
            Near::Camera { distance } => write!(f, "the camera is {} from it", Short(distance)),
            Near::Mirrors => write!(f, "curved mirrors that mirror each other magnify that"),
        }
    }
}

/// Two digits, in words of a picture and not of a bound.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        if value == 0.0 || (0.01..1000.0).contains(&value) {
            // Without the digits that a rounded number does not have.
            let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
            write!(f, "{rounded}")
        } else {
            write!(f, "{}", format!("{value:.1e}").replace(".0e", "e"))
        }
    }
}

/// What is tested.
const F32: Kernel = Kernel::Whitted(Precision::F32);

/// Pixels that are tested, at most and, where that takes no longer than a second or so, at least.
const MOST_TRIED: usize = 2048;
const FEWEST_TRIED: usize = 64;

/// Solids times rays.
const MOST_WORK: f64 = (1_u64 << 25) as f64;

/// Why pixels are tested.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Doubt {
    Lengths,
    /// Lengths are mild, and curved mirrors may magnify rounding.
    Mirrors,
}

impl Doubt {
    /// How many of the pixels that are tested may be wrong.
    fn allowed(self, tried: usize) -> usize {
        let share = match self {
            // Of a picture with 5 in 1000 wrong, more than that of 2048 are, with a probability of 99.7 %; of fewer,
            // with a lower one.
            Self::Lengths => 0.001,
            // Single pixels at the edges of images in images, which `f64` would be too expensive for.
            Self::Mirrors => 0.005,
        };
        ((share * tried as f64) as usize).max(1)
    }

    /// How many pixels are tested where none of these is wrong.
    fn enough_without_wrong(self) -> usize {
        match self {
            Self::Lengths => MOST_TRIED,
            // Of a picture with 1 in 100 wrong, one of them is, with a probability of 99.4 %; and of 2048 more than
            // the 10 that are allowed are, with one of 99.1 %.
            Self::Mirrors => 512,
        }
    }
}

/// An angle's error is at most that of a surface, 8u, against its size; where mirrors magnify it to less than 1/510, it
/// is not seen.
const MILD_RATIO_IN_MIRRORS: f64 = 1.0 / (510.0 * 8.0 * (f32::EPSILON as f64 / 2.0));

/// A quarter of a pixel.
const MILD_SHIFT_PIXELS: f64 = 0.25;

/// How much a curved mirror magnifies the error of an angle: about that between facing spheres (catalogue MR-2), which
/// are nearer to each other than most.
const MIRROR_GAIN: f64 = 5.0;

/// For a picture of so many pixels in `depth` generations, whose silhouettes that are seen directly move by no more
/// than `shift_pixels`.
pub fn of_f32(lengths: &Lengths, depth: u32, size: [u32; 2], shift_pixels: f64) -> Rounding {
    let scene = lengths.scene;
    if scene.primitives.is_empty() {
        return Rounding::Mild;
    }
    let ratio = lengths.ratio();
    let are_lengths_mild = shift_pixels <= MILD_SHIFT_PIXELS && ratio <= MILD_RATIO;
    let are_mirrors_mild = ratio * gain_of_mirrors(scene, depth) <= MILD_RATIO_IN_MIRRORS;
    if scene.has_transmission() {
        // The paths that are tested know no refraction.
        let is_mild = are_lengths_mild && !has_grazing_light(lengths);
        return if is_mild { Rounding::Mild } else { Rounding::Unknown { ratio } };
    }
    let doubt = match (are_lengths_mild && !has_grazing_light(lengths), are_mirrors_mild) {
        (true, true) => return Rounding::Mild,
        (true, false) => Doubt::Mirrors,
        (false, _) => Doubt::Lengths,
    };
    let count = (MOST_WORK / (scene.primitives.len() as f64 * rays_of_pixel(scene, depth))) as usize;
    match (count < FEWEST_TRIED, are_lengths_mild) {
        // Of so many solids of one size, a few faces or images in images are not seen.
        (true, true) => Rounding::Mild,
        (true, false) => Rounding::Unknown { ratio },
        (false, _) => try_pixels(lengths, depth, size, count, doubt),
    }
}

/// About how many rays, at most, a pixel takes: where every hit mirrors, as many generations as there may be.
fn rays_of_pixel(scene: &Scene, depth: u32) -> f64 {
    let reflection = scene.primitives.iter().map(|primitive| primitive.material.reflection()).fold(0.0, f64::max);
    let generations = f64::from(depth).min(1.0 / (1.0 - reflection).max(f64::EPSILON));
    generations * (1 + scene.lights.len()) as f64
}

/// Whether a light is above the plane of a flat face by so little that `f32` takes it for one in the plane: then the
/// face loses its highlight.
fn has_grazing_light(lengths: &Lengths) -> bool {
    let scene = lengths.scene;
    let least = lengths.extent() / MILD_RATIO;
    let grazes = |light: &Light| {
        scene.primitives.par_iter().any(|primitive| from_face_planes(&primitive.solid, light.position) < least)
    };
    scene.lights.iter().any(grazes)
}

/// How many times an error of an angle may be magnified, and then seen, by curved mirrors.
fn gain_of_mirrors(scene: &Scene, depth: u32) -> f64 {
    let is_curved = |primitive: &&Primitive| !matches!(primitive.solid, Solid::Box { .. });
    let mirrors = scene.primitives.iter().filter(is_curved).map(|primitive| primitive.material.reflection());
    (MIRROR_GAIN * mirrors.fold(0.0, f64::max)).max(1.0).powi(depth as i32 - 1)
}

/// How many times the curved mirrors of one path magnify an error of an angle, and show it, where they do so most. Of
/// the last hit nothing is seen mirrored, and the background looks the same at every angle.
fn gain_of_path(scene: &Scene, hits: impl Iterator<Item = Hit>) -> f64 {
    let gains = hits.scan(1.0, |gain, hit| {
        let Primitive { solid, material, .. } = &scene.primitives[hit.primitive as usize];
        let here = *gain;
        if !matches!(solid, Solid::Box { .. }) {
            *gain *= MIRROR_GAIN * material.reflection();
        }
        Some(here)
    });
    gains.fold(1.0, f64::max)
}

fn try_pixels(lengths: &Lengths, depth: u32, size: [u32; 2], count: usize, doubt: Doubt) -> Rounding {
    let asked = (depth != lengths.scene.max_depth).then(|| Scene { max_depth: depth, ..lengths.scene.clone() });
    let scene = asked.as_ref().unwrap_or(lengths.scene);
    let frame = lengths.space(F32);
    let (exact, rounded) = (World::new(scene), F32World::new(scene, &frame));
    let rays = PrimaryRays::new(&scene.camera, size[0], size[1]);
    let pixels = pixels(size, count.min(MOST_TRIED));
    let tolerance = (Precision::F32.rounding_tolerance() * brightest_source(scene).max(1.0)) as f32;
    let most_gain = MILD_RATIO_IN_MIRRORS / lengths.ratio();
    let path_if_wrong = |&[column, row]: &[u32; 2]| {
        let ray = rays.through(column, row);
        if doubt == Doubt::Mirrors && gain_of_path(scene, exact.mirrored_path(ray)) <= most_gain {
            return None;
        }
        let (right, seen) = (exact.look_along(ray), rounded.look_through([column, row], size));
        // Not a number counts as wrong.
        let is_right = (right.color.as_vec3().min(Vec3::MAX) - seen.color).abs().cmple(Vec3::splat(tolerance)).all();
        let first = Some(right.first_hit).filter(|primitive| (*primitive as usize) < scene.primitives.len());
        (!is_right).then(|| seen.primitives.into_iter().chain(first).collect())
    };
    let paths_of_wrong =
        |pixels: &[[u32; 2]]| -> Vec<Vec<u32>> { pixels.par_iter().filter_map(path_if_wrong).collect() };
    // Of a small picture they are in the order of its rows, and the first ones are not all over it.
    let is_every_pixel = pixels.len() as u64 == u64::from(size[0]) * u64::from(size[1]);
    let enough = if is_every_pixel { pixels.len() } else { doubt.enough_without_wrong().min(pixels.len()) };
    let (first, others) = pixels.split_at(enough);
    let mut wrong = paths_of_wrong(first);
    if wrong.is_empty() {
        return Rounding::Harmless { tried: first.len() };
    }
    wrong.extend(paths_of_wrong(others));
    if wrong.len() <= doubt.allowed(pixels.len()) {
        return Rounding::Harmless { tried: pixels.len() };
    }
    let met: Vec<usize> = wrong.iter().flatten().map(|&primitive| primitive as usize).collect();
    let mut cause = cause(scene, &frame, &met);
    if doubt == Doubt::Mirrors {
        cause.near = Near::Mirrors;
    }
    Rounding::Harmful { wrong: wrong.len(), tried: pixels.len(), cause }
}

/// Pixels all over a picture, so many or all that there are; counted from the left and from the top.
fn pixels([width, height]: [u32; 2], count: usize) -> Vec<[u32; 2]> {
    if u64::from(width) * u64::from(height) <= count as u64 {
        return (0..height).flat_map(|row| (0..width).map(move |column| [column, row])).collect();
    }
    // Roberts' R2 sequence: the powers of 1/1.3247…, the root of x³ = x + 1.
    let place = |index: usize, step: f64, side: u32| {
        let share = (0.5 + index as f64 * step).fract();
        ((share * f64::from(side)) as u32).min(side - 1)
    };
    const STEP_X: f64 = 0.754_877_666_246_692_8;
    const STEP_Y: f64 = 0.569_840_290_998_053_3;
    (0..count).map(|index| [place(index, STEP_X, width), place(index, STEP_Y, height)]).collect()
}

/// `met`: by the paths of wrong pixels.
fn cause(scene: &Scene, frame: &SceneSpace, met: &[usize]) -> Cause {
    let solid = |primitive: usize| &scene.primitives[primitive].solid;
    let rounded = |primitive: usize| {
        let place = (solid(primitive).position() - frame.origin).abs().max_element();
        place.max(size(solid(primitive)))
    };
    let all = 0..scene.primitives.len();
    let widest =
        |primitives: &mut dyn Iterator<Item = usize>| primitives.max_by(|&a, &b| rounded(a).total_cmp(&rounded(b)));
    let primitive = widest(&mut met.iter().copied()).or_else(|| widest(&mut all.clone())).unwrap_or(0);
    let others = all.filter(|&other| other != primitive).map(|other| (other, size(solid(other))));
    let smallest = others.min_by(|(_, a), (_, b)| a.total_cmp(b));
    let distance = outside_by(solid(primitive), scene.camera.position).abs();
    let near = match smallest {
        Some((primitive, size)) if size <= distance => Near::Primitive { primitive, size },
        _ => Near::Camera { distance },
    };
    let shift = Precision::F32.unit_roundoff() * rounded(primitive);
    Cause { primitive, size: size(solid(primitive)), shift, near }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::reference::Ray;
    use crate::scene::gallery;

    /// Whether it is mild or not; but for those that let light through, which are not tested.
    #[test]
    fn every_scene_of_the_gallery_is_right_in_f32() {
        for entry in gallery::entries() {
            let scene = gallery::scene(&entry.name).unwrap();
            if !scene.primitives.is_empty() && !scene.has_transmission() {
                let lengths = Lengths::of(&scene);
                let rounding = try_pixels(&lengths, scene.max_depth, [1621, 701], MOST_TRIED, Doubt::Lengths);
                assert!(matches!(rounding, Rounding::Harmless { .. }), "{}: {rounding:?}", entry.name);
            }
        }
    }

    /// Of six generations, so many of which are reflected by spheres as perfect as can be.
    #[test]
    fn a_path_magnifies_at_each_curved_mirror_that_something_is_seen_in() {
        let mut scene = Scene { max_depth: 6, ..gallery::scene("sphere").unwrap() };
        let Solid::Sphere { center, radius } = scene.primitives[0].solid else { panic!("it is one") };
        scene.primitives[0].material.reflection = Some(1.0);
        let gain = |scene: &Scene| {
            let along_its_axis = Ray { origin: center - DVec3::Z * 3.0 * radius, direction: DVec3::Z };
            gain_of_path(scene, World::new(scene).mirrored_path(along_its_axis))
        };
        assert_eq!(gain(&scene), 1.0, "the background");
        // One that sends the ray back, behind where it came from.
        let mut behind = scene.primitives[0].clone();
        behind.solid.move_to(center - DVec3::Z * 8.0 * radius);
        scene.primitives.push(behind);
        assert_eq!(gain(&scene), MIRROR_GAIN.powi(5));
        scene.primitives[1].material.reflection = Some(0.0);
        assert_eq!(gain(&scene), MIRROR_GAIN);
        scene.primitives.remove(1);
        scene.primitives[0].material.reflection = Some(0.0);
        assert_eq!(gain(&scene), 1.0);
    }

    #[test]
    fn an_empty_scene_is_right_however_it_is_looked_at() {
        assert_eq!(of_f32(&Lengths::of(&Scene::default()), 20, [1621, 701], 1e9), Rounding::Mild);
    }

    #[test]
    fn what_would_take_too_long_to_try_is_not_known() {
        let mut scene = gallery::scene("cloud-100000").unwrap();
        let of = |scene: &Scene| of_f32(&Lengths::of(scene), 1000, [1621, 701], 0.0);
        scene.lights = vec![Light { position: DVec3::Y * 100.0, ..Light::default() }; 64];
        assert_eq!(of(&scene), Rounding::Mild, "like solids");
        let center = scene.primitives[0].solid.position();
        scene.primitives[0].solid = Solid::Sphere { center, radius: 1e-6 };
        assert!(matches!(of(&scene), Rounding::Unknown { ratio } if ratio > MILD_RATIO), "{:?}", of(&scene));
    }

    #[test]
    fn a_light_just_above_the_plane_of_a_face_is_looked_at() {
        let grazes = |y: f64| {
            let mut scene = gallery::scene("box").unwrap();
            if let Solid::Box { center, half_size, rotation_degrees } = &mut scene.primitives[0].solid {
                (*center, *half_size, *rotation_degrees) = (DVec3::ZERO, DVec3::new(5.0, 1.0, 5.0), DVec3::ZERO);
            }
            scene.lights = vec![Light { position: DVec3::new(9.0, y, 0.3), ..Light::default() }];
            has_grazing_light(&Lengths::of(&scene))
        };
        assert_eq!([3.0, 1.0, 1.0 + 1e-6].map(grazes), [false, false, true]);
    }

    #[test]
    fn large_scenes_of_like_solids_stay_with_f32() {
        for name in ["squares-10000", "squares-1000000", "cloud-10000"] {
            let scene = gallery::scene(name).unwrap();
            let rounding = of_f32(&Lengths::of(&scene), scene.max_depth, [1621, 701], 0.0);
            assert!(!matches!(rounding, Rounding::Harmful { .. }), "{name}: {rounding:?}");
        }
    }

    #[test]
    fn a_cause_is_told_in_numbers_of_the_scene() {
        let near = Near::Primitive { primitive: 1, size: 1.0 };
        let cause = Cause { primitive: 0, size: 6.371e6, shift: 0.3797, near };
        let told = "primitive 1 is 6.4e6 wide: f32 moves its surface by 0.38, and primitive 2 is 1 wide";
        assert_eq!(cause.to_string(), told);
        let near = Near::Camera { distance: 2.0 };
        let cause = Cause { primitive: 2, size: 12.0, shift: 7e-7, near };
        assert_eq!(
            cause.to_string(),
            "primitive 3 is 12 wide: f32 moves its surface by 7e-7, and the camera is 2 from it"
        );
    }

    #[test]
    fn pixels_lie_all_over_a_picture_and_each_is_tried_where_there_are_few() {
        assert_eq!(pixels([3, 2], 6), [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]]);
        let many = pixels([1621, 701], 2048);
        assert_eq!(many.len(), 2048);
        for [left, top] in [[0, 0], [1216, 526], [700, 300]] {
            let inside =
                many.iter().filter(|&&[x, y]| (left..left + 405).contains(&x) && (top..top + 175).contains(&y));
            assert!((100..160).contains(&inside.count()), "{left} {top}");
        }
    }
}
