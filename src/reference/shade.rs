//! Equation 1.19 of the course work without refraction (docs/light-model.md, «The accurate model»).

use glam::DVec3;

use super::camera::unit;
use super::nearest::Solids;
use super::path::Path;
use super::ray::{Hit, OriginSurface, Ray, Side};
use super::{BACKGROUND, LIGHT_SPHERE, Pixel};
use crate::scene::{BoundingSphere, Light, Material, Primitive, Scene, Solid};

/// A scene ready to be looked at along any ray.
pub struct World<'a> {
    scene: &'a Scene,
    /// World frame; all below is as seen from there.
    origin: DVec3,
    solids: Solids,
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
            light_positions: scene.lights.iter().map(|light| light.position - origin).collect(),
            light_spheres: scene.lights.iter().map(ball).collect(),
        }
    }

    /// The nearest hit of a ray on the scene's primitives, both in the world frame.
    pub fn nearest(&self, ray: &Ray, origin_surface: OriginSurface) -> Option<Hit> {
        let hit = self.solids.nearest(&Ray { origin: ray.origin - self.origin, ..*ray }, origin_surface)?;
        Some(Hit { point: hit.point + self.origin, ..hit })
    }

    /// What a primary ray of unit direction sees.
    pub fn look_along(&self, primary: Ray) -> Pixel {
        let mut ray = Ray { origin: primary.origin - self.origin, ..primary };
        let mut origin_surface = OriginSurface::Free;
        let mut weight = 1.0;
        let mut color = DVec3::ZERO;
        let mut first_hit = BACKGROUND;
        let mut path = Path::default();
        for generation in 0..self.scene.max_depth {
            let hit = self.solids.nearest(&ray, origin_surface);
            if generation == 0 {
                if let Some(light) = self.light_sphere_before(&ray, hit.as_ref()) {
                    let color = finite(self.scene.lights[light as usize].intensity);
                    path.add_light_sphere(light);
                    return Pixel { color, first_hit: LIGHT_SPHERE, path: path.signature() };
                }
                first_hit = hit.map_or(BACKGROUND, |hit| hit.primitive);
            }
            let Some(hit) = hit else {
                path.add_miss();
                color = finite(color + weight * self.scene.background);
                break;
            };
            path.add_hit(&hit);
            let material = &self.scene.primitives[hit.primitive as usize].material;
            color = finite(color + weight * self.local_radiance(&hit, ray.direction, material, &mut path));
            weight *= material.specular;
            if weight == 0.0 {
                break;
            }
            ray = Ray { origin: hit.point, direction: unit(reflected(ray.direction, hit.normal)) };
            origin_surface = hit.origin_surface();
        }
        Pixel { color, first_hit, path: path.signature() }
    }

    /// E of the model: what a hit sends back along the ray without reflections, linear RGB.
    fn local_radiance(&self, hit: &Hit, ray_direction: DVec3, material: &Material, path: &mut Path) -> DVec3 {
        let mut sum = material.ambient * material.color;
        for (light, &position) in self.scene.lights.iter().zip(&self.light_positions) {
            // NaN for a light at the hit point, which therefore gives nothing.
            let to_light = unit(position - hit.point);
            let cosine = hit.normal.dot(to_light);
            // Of a rounded point, a light in a face's plane is now on this side of it and now on that.
            let faces = self.solids.height_above(hit, position).is_none_or(|height| height > 0.0);
            let lit = faces && cosine > 0.0 && !self.solids.hide(position, hit.point, hit.origin_surface());
            path.add_light(lit);
            if lit {
                let mirrored_light = reflected(-to_light, hit.normal);
                let highlight = fifth_power(mirrored_light.dot(-ray_direction).max(0.0));
                let received = material.diffuse * material.color * cosine + material.specular * highlight;
                sum = finite(sum + received * light.intensity);
            }
        }
        sum
    }

    /// The light whose sphere is nearer than any primitive, and seen from outside.
    fn light_sphere_before(&self, ray: &Ray, hit: Option<&Hit>) -> Option<u32> {
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

/// From where places are counted, so that a rounded one is not off by more than solids are small: the world's origin,
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

fn fifth_power(x: f64) -> f64 {
    let square = x * x;
    square * square * x
}

/// Overflow stops at the largest number, so that no sum becomes infinite or, by ∞ − ∞, NaN.
fn finite(color: DVec3) -> DVec3 {
    color.clamp(DVec3::MIN, DVec3::MAX)
}
