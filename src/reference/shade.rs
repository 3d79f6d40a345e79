//! Equation 1.19 of the course work (docs/light-model.md).

use std::iter;

use glam::DVec3;

use super::camera::unit;
use super::nearest::Solids;
use super::path::Path;
use super::ray::{Hit, OriginSurface, Ray, Side};
use super::{BACKGROUND, LIGHT_SPHERE, Pixel};
use crate::scene::{BoundingSphere, Light, Material, Primitive, Scene, Solid};

/// A scene ready to be looked at along any ray.
pub struct World<'a> {
    pub(super) scene: &'a Scene,
    /// World frame; all below is as seen from there.
    origin: DVec3,
    pub(super) solids: Solids,
    has_transmission: bool,
    light_positions: Vec<DVec3>,
    /// One for each light, in order; none where nothing of it is seen.
    light_spheres: Vec<Option<Solids>>,
}

impl<'a> World<'a> {
    /// Prepares what all rays share.
    pub fn new(scene: &'a Scene) -> Self {
        let origin = origin(scene);
        let ball = |light: &Light| (light.radius > 0.0).then(|| Solids::about(origin, &[ball(light)]));
        Self {
            scene,
            origin,
            solids: Solids::about(origin, &scene.primitives),
            has_transmission: scene.has_transmission(),
            light_positions: scene.lights.iter().map(|light| light.position - origin).collect(),
            light_spheres: scene.lights.iter().map(ball).collect(),
        }
    }

    /// The nearest hit of a ray on the scene's primitives, both in the world frame.
    pub fn nearest(&self, ray: &Ray, origin_surface: OriginSurface) -> Option<Hit> {
        let hit = self.solids.nearest(&self.relative(ray), origin_surface)?;
        Some(Hit { point: hit.point + self.origin, ..hit })
    }

    /// What a primary ray of unit direction sees.
    pub fn look_along(&self, primary: Ray) -> Pixel {
        let ray = self.relative(&primary);
        let mut path = Path::default();
        let nearest = self.solids.nearest(&ray, OriginSurface::Free);
        if let Some(light) = self.light_sphere_before(&ray, nearest.as_ref()) {
            let color = finite(self.scene.lights[light as usize].intensity);
            path.add_light_sphere(light);
            return Pixel { color, first_hit: LIGHT_SPHERE, path: path.signature() };
        }
        let mut color = DVec3::ZERO;
        // The last in is the next out.
        let mut legs = if self.scene.max_depth > 0 { vec![self.first_leg(ray)] } else { Vec::new() };
        let mut known = Some(nearest);
        while let Some(leg) = legs.pop() {
            let hit = known.take().unwrap_or_else(|| self.solids.nearest(&leg.ray, leg.origin_surface));
            let Some(hit) = hit else {
                path.add_miss();
                color = finite(color + leg.weight * self.scene.background);
                continue;
            };
            path.add_hit(&hit);
            let Primitive { material, .. } = &self.scene.primitives[hit.primitive as usize];
            let local_radiance = self.local_radiance(&hit, leg.ray.direction, material, &mut path);
            color = finite(color + leg.weight * local_radiance);
            if leg.generation + 1 < self.scene.max_depth {
                legs.extend(self.onward(&leg, &hit, &mut path).into_iter().flatten());
            }
        }
        let first_hit = nearest.map_or(BACKGROUND, |hit| hit.primitive);
        Pixel { color, first_hit, path: path.signature() }
    }

    /// What a primary ray of unit direction hits and, mirrored by each hit, the next; in the world frame, as many as
    /// the scene has generations.
    pub fn mirrored_path(&self, primary: Ray) -> impl Iterator<Item = Hit> {
        let hit = |ray: &Ray, origin_surface| Some((ray.direction, self.solids.nearest(ray, origin_surface)?));
        let hits = iter::successors(hit(&self.relative(&primary), OriginSurface::Free), move |(direction, last)| {
            let is_mirror = self.scene.primitives[last.primitive as usize].material.reflection() > 0.0;
            let ray = Ray { origin: last.point, direction: unit(reflected(*direction, last.normal)) };
            is_mirror.then(|| hit(&ray, last.origin_surface())).flatten()
        });
        let in_world = |(_, hit): (_, Hit)| Hit { point: hit.point + self.origin, ..hit };
        hits.take(self.scene.max_depth as usize).map(in_world)
    }

    /// A ray of the world frame as seen from the origin of all that is kept here.
    pub(super) fn relative(&self, ray: &Ray) -> Ray {
        Ray { origin: ray.origin - self.origin, ..*ray }
    }

    /// A path's beginning along a primary ray.
    pub(super) fn first_leg(&self, ray: Ray) -> Leg {
        let medium = self.medium_about(&ray, OriginSurface::Free);
        Leg { ray, origin_surface: OriginSurface::Free, weight: 1.0, medium, generation: 0 }
    }

    /// The mirrored and the refracted ray from a hit, as far as they weigh anything; the heavier comes last.
    pub(super) fn onward(&self, leg: &Leg, hit: &Hit, path: &mut Path) -> [Option<Leg>; 2] {
        let Primitive { material, solid, .. } = &self.scene.primitives[hit.primitive as usize];
        let mut mirror_weight = leg.weight * material.reflection();
        let mut through_weight = leg.weight * material.transmission;
        let mut through = Leg { weight: 0.0, generation: leg.generation + 1, ..*leg };
        through.ray.origin = hit.point;
        through.origin_surface = hit.left_by(hit.side.other());
        if solid.is_plate() {
            // Both of its sides are outside.
            through.origin_surface = hit.left_by(Side::Outside);
        } else if material.transmission > 0.0 {
            let inside = material.refractive_index;
            let (here, there) = match hit.side {
                Side::Outside => (leg.medium, inside),
                Side::Inside => {
                    let straight_on = Ray { origin: hit.point, direction: leg.ray.direction };
                    (inside, self.medium_about(&straight_on, hit.left_by(Side::Outside)))
                }
            };
            through.medium = there;
            match refracted(leg.ray.direction, hit.normal, here / there) {
                Some(direction) => through.ray.direction = direction,
                None => (mirror_weight, through_weight) = (mirror_weight + through_weight, 0.0),
            }
            path.add_refraction(through_weight > 0.0);
        }
        through.weight = through_weight;
        let direction = unit(reflected(leg.ray.direction, hit.normal));
        let mirror = Leg {
            ray: Ray { origin: hit.point, direction },
            origin_surface: hit.origin_surface(),
            weight: mirror_weight,
            generation: leg.generation + 1,
            medium: leg.medium,
        };
        let (mirror, through) = ((mirror_weight > 0.0).then_some(mirror), (through_weight > 0.0).then_some(through));
        if mirror_weight >= through_weight { [through, mirror] } else { [mirror, through] }
    }

    /// The refractive index about a ray's origin: of the solid that it is in and straight on leaves first, 1 where it
    /// is in none.
    fn medium_about(&self, ray: &Ray, origin_surface: OriginSurface) -> f64 {
        if !self.has_transmission {
            return 1.0;
        }
        let index = self.solids.innermost(ray, origin_surface);
        index.map_or(1.0, |index| self.scene.primitives[index as usize].material.refractive_index)
    }

    /// E of the model: what a hit sends back along the ray without reflections, linear RGB.
    fn local_radiance(&self, hit: &Hit, ray_direction: DVec3, material: &Material, path: &mut Path) -> DVec3 {
        let ambient = finite(material.ambient * material.color * self.scene.ambient_light);
        self.with_direct_light(ambient, hit, ray_direction, material, path)
    }

    /// A sum, linear RGB, with what the lights add to it that a hit sends back along the ray.
    pub(super) fn with_direct_light(
        &self,
        mut sum: DVec3,
        hit: &Hit,
        ray_direction: DVec3,
        material: &Material,
        path: &mut Path,
    ) -> DVec3 {
        for (light, &position) in self.scene.lights.iter().zip(&self.light_positions) {
            let distance = (position - hit.point).length();
            // NaN for a light at the hit point, which therefore gives nothing.
            let to_light = unit(position - hit.point);
            let cosine = hit.normal.dot(to_light);
            // Of a rounded point, a light in a face's plane is now on this side of it and now on that.
            let faces = self.solids.height_above(hit, position).is_none_or(|height| height > 0.0);
            let share = match faces && cosine > 0.0 {
                true => self.let_through(position, hit, path),
                false => 0.0,
            };
            path.add_light(share > 0.0);
            if share > 0.0 {
                let mirrored_light = reflected(-to_light, hit.normal);
                let highlight = power(mirrored_light.dot(-ray_direction).max(0.0), material.shininess_256());
                let received = material.diffuse * material.color * cosine + material.specular * highlight;
                let fading = light.distance_constant.map_or(1.0, |constant| (distance + constant).recip());
                sum = finite(sum + finite(share * received * (fading * light.intensity)));
            }
        }
        sum
    }

    /// The share of a light that the solids before it let through to a hit.
    fn let_through(&self, light_position: DVec3, hit: &Hit, path: &mut Path) -> f64 {
        if !self.has_transmission {
            return f64::from(u8::from(!self.solids.hide(light_position, hit.point, hit.origin_surface())));
        }
        let mut share = 1.0;
        for (primitive, surfaces) in self.solids.between(light_position, hit.point, hit.origin_surface()) {
            let Primitive { material, solid, .. } = &self.scene.primitives[primitive as usize];
            let surfaces = if solid.is_plate() { surfaces.min(1) } else { surfaces };
            share *= material.transmission.powi(surfaces as i32);
            path.add_crossing(primitive, surfaces);
        }
        share
    }

    /// The light whose sphere is nearer than any primitive, and seen from outside.
    pub(super) fn light_sphere_before(&self, ray: &Ray, hit: Option<&Hit>) -> Option<u32> {
        let entry = |sphere: &Option<Solids>| {
            let entry = sphere.as_ref()?.nearest(ray, OriginSurface::Free)?;
            (entry.side == Side::Outside).then_some(entry.t)
        };
        let light_spheres =
            (0u32..).zip(&self.light_spheres).filter_map(|(light, sphere)| Some((light, entry(sphere)?)));
        let (light, t) = light_spheres.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        hit.is_none_or(|hit| t < hit.t).then_some(light)
    }
}

/// A part of a path from one surface to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    pub ray: Ray,
    pub origin_surface: OriginSurface,
    pub weight: f64,
    /// Refractive index of what it goes through.
    pub medium: f64,
    /// 0 of the primary ray.
    pub generation: u32,
}

/// Origin of positions, so that a rounded one is not off by more than solids are small: the world's origin,
/// or the camera where solids are less than a millionth of its coordinates.
fn origin(scene: &Scene) -> DVec3 {
    const FAR: f64 = 1e6;
    let sizes = scene.primitives.iter().map(|primitive| BoundingSphere::of(&primitive.solid).radius);
    let smallest = sizes.fold(f64::INFINITY, f64::min);
    let is_far = scene.camera.position.abs().max_element() > FAR * smallest;
    if is_far { scene.camera.position } else { DVec3::ZERO }
}

fn ball(light: &Light) -> Primitive {
    let solid = Solid::Sphere { center: light.position, radius: light.radius };
    Primitive { name: None, solid, material: Material::default() }
}

/// Mirror image of a direction in the plane across a unit normal.
fn reflected(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// The unit direction behind a surface by Snell's law: sines are in the ratio of the refractive indices, here / there,
/// across the normal. `None` where all is reflected.
fn refracted(direction: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    if ratio == 1.0 {
        return Some(direction);
    }
    let across = ratio * (direction - direction.dot(normal) * normal);
    let sine = across.length();
    let cosine_squared = (1.0 - sine) * (1.0 + sine);
    (cosine_squared >= 0.0).then(|| unit(across - cosine_squared.sqrt() * normal))
}

/// x to the power of n / 256, x from 0 to 1.
fn power(x: f64, n: u32) -> f64 {
    let mut root = x;
    let mut part = 1.0;
    for bit in (0..8).rev() {
        root = root.sqrt();
        if n >> bit & 1 == 1 {
            part *= root;
        }
    }
    x.powi((n / 256) as i32) * part
}

/// Overflow stops at the largest number, so that no sum becomes infinite or, by ∞ − ∞, NaN.
pub(super) fn finite(color: DVec3) -> DVec3 {
    color.clamp(DVec3::MIN, DVec3::MAX)
}
