//! Paths of the `f32` kernel (`glsl/whitted/trace.glsl`, `glsl/transport/`, `glsl/camera/camera.glsl`).

use glam::{DVec3, Vec3};

use super::line::{Face, Ray, unit};
use super::meet::{F32Hit, Origin};
use super::solids::{F32Solid, SURFACE_ERROR, is_large_enough};
use crate::plan::solids;
use crate::scene::{BoundingSphere, Camera, Light, Projection, Scene, SceneSpace};

/// A scene in the numbers of the `f32` kernel; scene space.
pub struct F32World<'a> {
    scene: &'a Scene,
    /// By the primitive's index; `None` of those that are too small for the kernel.
    solids: Vec<Option<F32Solid>>,
    lights: Vec<F32Light>,
    position: DVec3,
}

struct F32Light {
    position: Vec3,
    /// `None` where nothing of it is seen.
    sphere: Option<F32Solid>,
    intensity: Vec3,
    /// Scale, slope and constant of `Light` in `glsl/records/scene.glsl`.
    fading: Vec3,
}

/// What a path came to.
pub struct Seen {
    /// Linear RGB.
    pub color: Vec3,
    /// Index of the primitive that each generation met.
    pub primitives: Vec<u32>,
}

/// A hit and whose it is.
type HitOf = (F32Hit, usize);

/// What a ray leaves: a primitive, and whether inwards.
type Left = Option<HitOf>;

impl<'a> F32World<'a> {
    pub fn new(scene: &'a Scene, frame: &SceneSpace) -> Self {
        let solid =
            |solid| is_large_enough(BoundingSphere::of(solid).radius, frame).then(|| F32Solid::of(solid, frame));
        Self {
            scene,
            solids: scene.primitives.iter().map(|primitive| solid(&primitive.solid)).collect(),
            lights: scene.lights.iter().map(|light| F32Light::of(light, frame)).collect(),
            position: frame.point(scene.camera.position),
        }
    }

    /// What the primary ray through a pixel sees, counted from the left and from the top.
    pub fn look_through(&self, [column, row]: [u32; 2], [width, height]: [u32; 2]) -> Seen {
        let direction = primary_direction(&self.scene.camera, [column, row], [width, height]);
        let mut ray = Ray { origin: self.position, direction: unit(direction) };
        let mut left = None;
        let (mut color, mut weight) = (Vec3::ZERO, 1.0);
        let mut primitives = Vec::new();
        for generation in 0..self.scene.max_depth {
            let nearest = self.nearest(&ray, left);
            if generation == 0
                && let Some(intensity) = self.light_sphere_before(&ray, nearest)
            {
                return Seen { color: intensity, primitives };
            }
            let Some((hit, primitive)) = nearest else {
                color = limited(color + weight * self.scene.background.as_vec3());
                break;
            };
            primitives.push(primitive as u32);
            let material = &self.scene.primitives[primitive].material;
            color = limited(color + weight * self.local_radiance(&hit, primitive, ray.direction));
            weight *= material.reflection() as f32;
            if weight == 0.0 {
                break;
            }
            let direction = unit(mirrored(ray.direction, hit.normal));
            ray = Ray { origin: hit.point.as_dvec3(), direction };
            left = nearest;
        }
        Seen { color, primitives }
    }

    /// The solids that a ray can meet, with what its origin is to each.
    fn reachable(&self, left: Left) -> impl Iterator<Item = (usize, &F32Solid, Origin)> {
        self.solids.iter().enumerate().filter_map(move |(index, solid)| {
            let origin = match left {
                None => Origin::Free,
                Some((_, primitive)) if primitive != index => Origin::OtherSurface,
                Some((hit, _)) if hit.inside => Origin::OwnInside(hit.face),
                Some(_) => return None,
            };
            Some((index, solid.as_ref()?, origin))
        })
    }

    fn nearest(&self, ray: &Ray, left: Left) -> Option<HitOf> {
        let mut nearest: Option<HitOf> = None;
        for (index, solid, origin) in self.reachable(left) {
            let Some(hit) = solid.meet(ray, origin) else { continue };
            if nearest.is_none_or(|nearest| is_nearer((hit, index), nearest, ray)) {
                nearest = Some((hit, index));
            }
        }
        nearest
    }

    /// What a hit sends back along the ray, without reflections.
    fn local_radiance(&self, hit: &F32Hit, primitive: usize, ray_direction: Vec3) -> Vec3 {
        let material = &self.scene.primitives[primitive].material;
        let (diffuse, specular) = (material.diffuse as f32, material.specular as f32);
        let color = material.color.as_vec3();
        let mut sum = limited(material.ambient as f32 * color * self.scene.ambient_light.as_vec3());
        for light in &self.lights {
            let to_light = light.position - hit.point;
            let distance = to_light.length();
            let direction = to_light / distance;
            let cosine = hit.normal.dot(direction);
            let place = light.position.abs().max_element().max(hit.point.abs().max_element());
            let is_above = hit.face == Face::Curved || cosine * distance > SURFACE_ERROR * (place + hit.size);
            if distance > 0.0
                && cosine > 0.0
                && is_above
                && !self.hide(light.position, distance, direction, hit, primitive)
            {
                let alignment = unit(mirrored(-direction, hit.normal)).dot(-ray_direction).max(0.0);
                let highlight = alignment.powf(material.shininess_256() as f32 / 256.0);
                let received = diffuse * cosine * color + specular * highlight;
                sum = limited(sum + limited(received * (light.intensity * light.fading(distance))));
            }
        }
        sum
    }

    /// Whether a solid lies between a hit and a light.
    fn hide(&self, light: Vec3, distance: f32, direction: Vec3, from: &F32Hit, primitive: usize) -> bool {
        let ray = Ray { origin: from.point.as_dvec3(), direction };
        self.reachable(Some((*from, primitive))).any(|(_, solid, origin)| {
            solid.meet(&ray, origin).is_some_and(|hit| {
                let height_of_target = (distance - hit.t) * hit.normal.dot(direction).abs();
                height_of_target > SURFACE_ERROR * (light.abs().max_element() + hit.size)
            })
        })
    }

    /// The intensity of the light whose sphere is nearer than any primitive.
    fn light_sphere_before(&self, ray: &Ray, nearest: Option<HitOf>) -> Option<Vec3> {
        let hits =
            self.lights.iter().filter_map(|light| Some((light.sphere.as_ref()?.meet(ray, Origin::Free)?, light)));
        let hits = hits.filter(|(hit, _)| !hit.inside);
        let (hit, light) = hits.min_by(|(a, _), (b, _)| a.t.total_cmp(&b.t))?;
        nearest.is_none_or(|(nearest, _)| hit.t < nearest.t).then_some(light.intensity)
    }
}

impl F32Light {
    fn of(light: &Light, frame: &SceneSpace) -> Self {
        let (position, radius) = frame.light(light);
        let (position, radius) = (position.as_vec3(), radius as f32);
        Self {
            position,
            sphere: (radius > 0.0).then_some(F32Solid::Sphere { center: position, radius }),
            intensity: light.intensity.as_vec3(),
            fading: light.fading(frame.scale).as_vec3(),
        }
    }

    /// What of the light is left at a distance.
    fn fading(&self, distance: f32) -> f32 {
        self.fading.x / (self.fading.y * distance + self.fading.z)
    }
}

fn primary_direction(camera: &Camera, [column, row]: [u32; 2], [width, height]: [u32; 2]) -> Vec3 {
    let ahead = solids::unit(camera.direction);
    let left = solids::unit(solids::unit(camera.up).cross(ahead));
    let half_height = (camera.vertical_fov_degrees.to_radians() / 2.0).tan();
    let half_width = half_height * f64::from(width) / f64::from(height);
    let x = (2 * column + 1) as f32 / (2 * width) as f32;
    let y = (2 * (height - 1 - row) + 1) as f32 / (2 * height) as f32;
    let [window_x, window_y] = match camera.projection {
        Projection::Centered => [x, y],
        Projection::Course => [2.0 * x - 1.0, 2.0 * y - 1.0],
    };
    let to_left = (1.0 - 2.0 * window_x) * half_width as f32;
    let upward = (2.0 * window_y - 1.0) * half_height as f32;
    left.as_vec3() * to_left + ahead.cross(left).as_vec3() * upward + ahead.as_vec3()
}

/// `are_coplanar` and `is_nearer` of `glsl/solids/nearest.glsl`.
fn is_nearer((hit, index): HitOf, (nearest, nearest_index): HitOf, ray: &Ray) -> bool {
    let u = f32::EPSILON / 2.0;
    let error = u * (hit.t + nearest.t + 4.0 * (hit.size + nearest.size));
    let are_coplanar = hit.normal.dot(nearest.normal) >= 1.0 - 16.0 * u
        && (hit.t - nearest.t).abs() * hit.normal.dot(ray.direction).abs() <= error;
    if hit.t == nearest.t || are_coplanar { index < nearest_index } else { hit.t < nearest.t }
}

fn mirrored(direction: Vec3, normal: Vec3) -> Vec3 {
    direction - (2.0 * direction.dot(normal)) * normal
}

/// Overflow stops at the largest number.
fn limited(color: Vec3) -> Vec3 {
    color.min(Vec3::MAX)
}
