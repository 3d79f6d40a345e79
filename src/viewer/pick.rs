//! What a click on the picture means.

use crate::reference::{OriginSurface, PrimaryRays, Solids};
use crate::scene::Scene;

/// Index of the primitive that the pixel's primary ray meets first; columns count from the left and rows from the top
/// of a picture of `width` × `height` pixels. Outside of it, and in the background, there is none.
///
/// By the accurate model: a cone has its base disk, and solids are met from inside too.
pub fn pick(scene: &Scene, width: u32, height: u32, column: u32, row: u32) -> Option<usize> {
    if column >= width || row >= height {
        return None;
    }
    let ray = PrimaryRays::new(&scene.camera, width, height).through(column, row);
    Solids::new(&scene.primitives).nearest(&ray, OriginSurface::Free).map(|hit| hit.primitive as usize)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::{Camera, Material, Primitive, Projection, Solid};
    use crate::viewer::outline::Projector;

    fn ball(x: f64, z: f64) -> Primitive {
        let solid = Solid::Sphere { center: DVec3::new(x, 0.0, z), radius: 0.05 };
        Primitive { name: None, solid, material: Material::default() }
    }

    #[test]
    fn the_solid_under_the_pointer_is_picked_in_both_projections() {
        let primitives = vec![ball(0.15, 1.0), ball(-0.15, 1.0), ball(-0.2, 2.0)];
        for projection in Projection::ALL {
            let camera = Camera { projection, ..Camera::default() };
            let scene = Scene { camera, primitives: primitives.clone(), ..Scene::default() };
            let projector = Projector::new(&scene.camera, 320, 200);
            for (index, primitive) in scene.primitives.iter().enumerate().take(2) {
                let at = projector.project(primitive.solid.position()).unwrap();
                let picked = pick(&scene, 320, 200, at.x as u32, at.y as u32);
                assert_eq!(picked, Some(index), "{projection:?}, the nearer of those in line");
            }
            assert_eq!(pick(&scene, 320, 200, 0, 199), None, "the background");
        }
    }

    #[test]
    fn clicks_outside_the_picture_and_empty_pictures_pick_nothing() {
        let camera = Camera { position: DVec3::ZERO, ..Camera::default() };
        let scene = Scene { camera, primitives: vec![ball(0.0, 0.0)], ..Scene::default() };
        assert_eq!(pick(&scene, 10, 10, 9, 9), Some(0), "from inside");
        assert_eq!(
            (pick(&scene, 10, 10, 10, 0), pick(&scene, 10, 10, 0, 10), pick(&scene, 0, 0, 0, 0)),
            (None, None, None)
        );
    }
}
