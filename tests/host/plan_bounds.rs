//! The bounds that a plan relies on, kept by a tracer in `f64` on the CPU that cuts as the plan says.

use crate::budget::random_scene;
use crate::random::Random;
use glam::DVec3;
use rayon::prelude::*;
use zerkalo::plan::{Approximations, Limits, Plan, Precision};
use zerkalo::reference::{Hit, LIGHT_SPHERE, OriginSurface, PrimaryRays, Ray, Solids, World};
use zerkalo::scene::{Material, Scene};
use zerkalo::settings::RenderSettings;

/// The accurate model over the reference's intersections, with a plan's cuts.
struct Model<'a> {
    scene: &'a Scene,
    solids: Solids,
    approximations: Approximations,
    generations: u32,
}

/// How often something was left out.
#[derive(Debug, Default, Clone, Copy)]
struct LeftOut {
    paths: u32,
    shadow_rays: u32,
    highlights: u32,
}

impl<'a> Model<'a> {
    fn new(scene: &'a Scene, approximations: Approximations, generations: u32) -> Self {
        Self { scene, solids: Solids::new(&scene.primitives), approximations, generations }
    }

    /// Of a primary ray that sees no light's ball, linear RGB.
    fn trace(&self, mut ray: Ray, left_out: &mut LeftOut) -> DVec3 {
        let mut origin_surface = OriginSurface::Free;
        let mut weight = 1.0;
        let mut color = DVec3::ZERO;
        for generation in 0..self.scene.max_depth {
            if weight <= f64::from(self.approximations.min_throughput) || generation == self.generations {
                left_out.paths += u32::from(weight > 0.0);
                break;
            }
            let Some(hit) = self.solids.nearest(&ray, origin_surface) else {
                color = limited(color + weight * self.scene.background);
                break;
            };
            let material = &self.scene.primitives[hit.primitive as usize].material;
            color = limited(color + weight * self.local_radiance(&hit, ray.direction, material, weight, left_out));
            weight *= material.specular;
            ray = Ray { origin: hit.point, direction: unit(reflected(ray.direction, hit.normal)) };
            origin_surface = hit.origin_surface();
        }
        color
    }

    fn local_radiance(&self, hit: &Hit, ray: DVec3, material: &Material, weight: f64, left_out: &mut LeftOut) -> DVec3 {
        let mut sum = material.ambient * material.color;
        for light in &self.scene.lights {
            let to_light = unit(light.position - hit.point);
            let cosine = hit.normal.dot(to_light);
            if cosine.is_nan() || cosine <= 0.0 {
                continue;
            }
            let highlight = fifth_power(reflected(-to_light, hit.normal).dot(-ray).max(0.0));
            left_out.highlights += u32::from(!self.approximations.highlights && material.specular * highlight > 0.0);
            let highlight = if self.approximations.highlights { highlight } else { 0.0 };
            let received = material.diffuse * material.color * cosine + material.specular * highlight;
            let direct = received * light.intensity;
            if weight * direct.max_element() <= f64::from(self.approximations.min_shadowed) {
                left_out.shadow_rays += u32::from(direct != DVec3::ZERO);
                sum = limited(sum + 0.5 * direct);
            } else if !self.solids.hide(light.position, hit.point, hit.origin_surface()) {
                sum = limited(sum + direct);
            }
        }
        sum
    }
}

fn reflected(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// As the reference does it, to the bit: round mirrors make much of a rounding.
fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize()
}

fn fifth_power(x: f64) -> f64 {
    let square = x * x;
    square * square * x
}

fn limited(color: DVec3) -> DVec3 {
    color.min(DVec3::MAX)
}

const PIXELS: [u32; 2] = [11, 8];

/// What one allowed error changed in one scene.
#[derive(Debug, Default, Clone, Copy)]
struct Change {
    /// Against the bound.
    largest: f64,
    left_out: LeftOut,
}

fn change(scene: &Scene, error: f64) -> Change {
    let [width, height] = PIXELS;
    let limits = Limits { float64: true, ..Limits::PROMISED };
    let settings = RenderSettings { precision: Some(Precision::F64), error, ..RenderSettings::default() };
    let plan = Plan::for_scene(scene, &settings, [width, height], &limits).unwrap();
    let bound = plan.bounds.total();
    assert!(bound <= error, "{bound} of {error}: {plan:?}");

    let world = World::new(scene);
    let exact = Model::new(scene, Approximations::NONE, scene.max_depth);
    let cut = Model::new(scene, plan.approximations, plan.generations.choice);
    let rays = PrimaryRays::new(&scene.camera, width, height);
    let mut change = Change::default();
    for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
        let ray = rays.through(column, row);
        let seen = world.look_along(ray);
        if seen.first_hit == LIGHT_SPHERE {
            continue;
        }
        let whole = exact.trace(ray, &mut LeftOut::default());
        assert_eq!(whole, seen.color, "the reference's colour");
        // Of sums over at most 60 generations of up to 4 lights, each relative to the sum.
        let rounding = 300.0 * f64::EPSILON * whole.max_element();
        let difference = (cut.trace(ray, &mut change.left_out) - whole).abs().max_element();
        assert!(
            difference <= bound + rounding,
            "{difference} above {bound}: {:?} {:?}",
            plan.approximations,
            plan.bounds
        );
        if bound > 0.0 && difference > rounding {
            change.largest = change.largest.max(difference / bound);
        }
    }
    change
}

/// About the brightest channel that there is: errors are tried in proportion to it too, for a scene lit by 1e38 has
/// nothing to cut for 1/510.
fn brightness(scene: &Scene) -> f64 {
    let lights: DVec3 = scene.lights.iter().map(|light| light.intensity).sum();
    (lights + scene.background).max_element()
}

#[test]
fn no_cut_changes_more_than_the_bound_that_the_plan_relied_on() {
    let of_scenes: Vec<[Change; 4]> = (0..500_u64)
        .into_par_iter()
        .map(|seed| {
            let scene = random_scene(seed);
            let mut random = Random(seed ^ 0xb0d6e7);
            let mut relative = || random.magnitude(-5.0, 0.0) * brightness(&scene);
            [1.0 / 510.0, 1.0 / 50.0, relative(), relative()].map(|error| change(&scene, error))
        })
        .collect();
    let scenes_with = |is: &dyn Fn(&Change) -> bool| of_scenes.iter().filter(|changes| changes.iter().any(is)).count();
    let paths = scenes_with(&|change| change.left_out.paths > 0);
    let shadow_rays = scenes_with(&|change| change.left_out.shadow_rays > 0);
    let highlights = scenes_with(&|change| change.left_out.highlights > 0);
    let changed = scenes_with(&|change| change.largest > 0.0);
    let by_a_tenth = scenes_with(&|change| change.largest > 0.1);
    let largest = of_scenes.iter().flatten().map(|change| change.largest).fold(0.0, f64::max);
    println!(
        "of {} scenes: paths cut in {paths}, shadow rays in {shadow_rays}, highlights in {highlights}; changed \
         {changed}, by a tenth of the bound and more {by_a_tenth}; the largest change is {largest:.3} of its bound",
        of_scenes.len()
    );
    assert!(paths >= 200 && shadow_rays >= 200 && highlights >= 50 && by_a_tenth >= 150);
}
