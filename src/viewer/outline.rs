//! The highlight of the selected solid: lines on its surface, and where the picture shows them.

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3};

use super::camera_frame::{unit, world_from_camera};
use crate::scene::{Camera, Projection, Solid, world_from_box};

/// Enough for a circle across a whole screen to look round. A multiple of 4, so that quarter turns are points of it.
const CIRCLE_SEGMENTS: u32 = 64;

/// Lines are cut where their distance along the optical axis falls below this part of how far they reach from the
/// camera: that is 3e-5 degrees short of the camera's plane, which only a picture of more than 179.9999° would show.
const NEAR_FRACTION: f64 = 1e-6;

/// Lines on the surface of a solid, world frame: three great circles of a sphere, the edges of a box, the bases of a
/// cylinder and a cone with four lines along their sides.
pub fn outline(solid: &Solid) -> Vec<Vec<DVec3>> {
    match solid {
        Solid::Sphere { center, radius } => {
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * *radius);
            vec![circle(*center, x, y), circle(*center, y, z), circle(*center, z, x)]
        }
        Solid::Box { center, half_size, rotation_degrees } => {
            box_edges(*center, world_from_box(*rotation_degrees) * DMat3::from_diagonal(*half_size))
        }
        Solid::Cylinder { ends, radius } => {
            let (x, y) = unit(ends[1] - ends[0]).any_orthonormal_pair();
            let bases = ends.map(|end| circle(end, x * *radius, y * *radius));
            let sides: Vec<Vec<DVec3>> = bases[0]
                .iter()
                .zip(&bases[1])
                .step_by(QUARTER)
                .take(4)
                .map(|(&start, &end)| vec![start, end])
                .collect();
            bases.into_iter().chain(sides).collect()
        }
        Solid::Cone { apex, axis, height, half_angle_degrees } => {
            let (x, y) = axis.any_orthonormal_pair();
            let radius = height * half_angle_degrees.to_radians().tan();
            let base = circle(*apex + *axis * *height, x * radius, y * radius);
            let sides: Vec<Vec<DVec3>> = base.iter().step_by(QUARTER).take(4).map(|&end| vec![*apex, end]).collect();
            std::iter::once(base).chain(sides).collect()
        }
    }
}

const QUARTER: usize = CIRCLE_SEGMENTS as usize / 4;

/// Closed: the first point comes again at the end. `x` and `y` are its half axes.
fn circle(center: DVec3, x: DVec3, y: DVec3) -> Vec<DVec3> {
    let point = |segment: u32| {
        let (sin, cos) = (TAU * f64::from(segment % CIRCLE_SEGMENTS) / f64::from(CIRCLE_SEGMENTS)).sin_cos();
        center + x * cos + y * sin
    };
    (0..=CIRCLE_SEGMENTS).map(point).collect()
}

/// The columns are the half edges.
fn box_edges(center: DVec3, world_from_unit_box: DMat3) -> Vec<Vec<DVec3>> {
    let corner = |local: [f64; 3]| center + world_from_unit_box * DVec3::from(local);
    let mut edges = Vec::new();
    for along in 0..3 {
        for (side, other_side) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            let end = |sign| {
                let mut local = [sign; 3];
                (local[(along + 1) % 3], local[(along + 2) % 3]) = (side, other_side);
                corner(local)
            };
            edges.push(vec![end(-1.0), end(1.0)]);
        }
    }
    edges
}

/// Where a picture shows points of the world: the inverse of [`PrimaryRays`](crate::reference::PrimaryRays).
#[derive(Debug, Clone)]
pub struct Projector {
    position: DVec3,
    camera_from_world: DMat3,
    /// Half extent of the centred window in the plane at distance 1.
    half_extent: DVec2,
    projection: Projection,
    picture_size: DVec2,
}

impl Projector {
    /// For a picture of `width` × `height` square pixels.
    pub fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let picture_size = DVec2::new(width.into(), height.into());
        let half_height = (camera.vertical_fov_degrees.to_radians() / 2.0).tan();
        Self {
            position: camera.position,
            camera_from_world: world_from_camera(camera).transpose(),
            half_extent: DVec2::new(half_height * picture_size.x / picture_size.y, half_height),
            projection: camera.projection,
            picture_size,
        }
    }

    /// In pixels from the top left corner of the picture, perhaps outside of it; the centre of a pixel has halves.
    /// `None` behind the camera and in its plane.
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        let in_camera = self.in_camera(point);
        let is_ahead = in_camera.z > 0.0 && in_camera.z >= NEAR_FRACTION * in_camera.length();
        is_ahead.then(|| self.pixel(in_camera)).filter(|pixel| pixel.is_finite())
    }

    /// The parts of a line that lie before the camera, as [`Projector::project`] has them.
    pub fn project_polyline(&self, points: &[DVec3]) -> Vec<Vec<DVec2>> {
        let points: Vec<DVec3> = points.iter().map(|point| self.in_camera(*point)).collect();
        let reach = points.iter().map(|point| point.length()).fold(0.0, f64::max);
        let near = NEAR_FRACTION * reach;
        let mut pieces: Vec<Vec<DVec2>> = Vec::new();
        let mut is_continued = false;
        for segment in points.windows(2) {
            let [start, end] = [segment[0], segment[1]];
            if let Some((visible_start, visible_end)) = cut_before(start, end, near) {
                if !is_continued {
                    pieces.push(vec![self.pixel(visible_start)]);
                }
                if let Some(piece) = pieces.last_mut() {
                    piece.push(self.pixel(visible_end));
                }
            }
            is_continued = end.z > near;
        }
        pieces.retain(|piece| piece.iter().all(|pixel| pixel.is_finite()));
        pieces
    }

    /// x to the right on the picture, y up, z along the optical axis.
    fn in_camera(&self, point: DVec3) -> DVec3 {
        self.camera_from_world * (point - self.position)
    }

    fn pixel(&self, in_camera: DVec3) -> DVec2 {
        // x right, y up, in [0, 1]² where the picture shows the centred window.
        let window = (in_camera.truncate() / in_camera.z / self.half_extent + 1.0) / 2.0;
        let centered = match self.projection {
            Projection::Centered => window,
            Projection::Course => (window + 1.0) / 2.0,
        };
        DVec2::new(centered.x, 1.0 - centered.y) * self.picture_size
    }
}

/// The part of a segment with z beyond `near`, camera frame.
fn cut_before(start: DVec3, end: DVec3, near: f64) -> Option<(DVec3, DVec3)> {
    let crossing = || start.lerp(end, (near - start.z) / (end.z - start.z)).with_z(near);
    match (start.z > near, end.z > near) {
        (true, true) => Some((start, end)),
        (true, false) => Some((start, crossing())),
        (false, true) => Some((crossing(), end)),
        (false, false) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{OriginSurface, PrimaryRays, Ray, Solids};
    use crate::scene::{Material, Primitive, SolidKind};

    fn cameras() -> Vec<Camera> {
        let slanted = Camera {
            position: DVec3::new(2.7, 4.1, -4.9),
            direction: DVec3::new(0.4, -1.6, 9.8),
            up: DVec3::new(0.1, 2.0, 0.3),
            vertical_fov_degrees: 70.0,
            projection: Projection::Centered,
        };
        let wide = Camera { vertical_fov_degrees: 179.0, ..Camera::default() };
        [Camera::default(), slanted, wide]
            .into_iter()
            .flat_map(|camera| Projection::ALL.map(|projection| Camera { projection, ..camera.clone() }))
            .collect()
    }

    #[test]
    fn a_point_on_a_pixel_s_ray_is_projected_to_the_pixel_s_centre() {
        for camera in cameras() {
            let (width, height) = (160, 90);
            let rays = PrimaryRays::new(&camera, width, height);
            let projector = Projector::new(&camera, width, height);
            for (column, row) in [(0, 0), (159, 0), (0, 89), (159, 89), (80, 45), (119, 22), (3, 70)] {
                for distance in [1e-3, 1.0, 1e6] {
                    let ray = rays.through(column, row);
                    let pixel = projector.project(ray.origin + ray.direction * distance).unwrap();
                    let center = DVec2::new(column.into(), row.into()) + 0.5;
                    assert!(pixel.distance(center) < 1e-7, "{camera:?}, {distance}: {pixel} for {center}");
                }
            }
        }
    }

    #[test]
    fn points_behind_the_camera_or_in_its_plane_have_no_pixel() {
        let projector = Projector::new(&Camera::default(), 100, 100);
        for point in [DVec3::new(0.0, 0.0, -3.0), DVec3::new(5.0, 0.0, -2.0), DVec3::new(0.0, 0.0, -2.0)] {
            assert_eq!(projector.project(point), None, "{point}");
        }
        assert!(projector.project(DVec3::new(5.0, 0.0, -1.9)).is_some());
    }

    #[test]
    fn a_line_through_the_camera_s_plane_is_cut_and_not_flipped() {
        let projector = Projector::new(&Camera::default(), 100, 100);
        // From the right ahead to the right behind: −x is on the right.
        let [ahead, behind] = [DVec3::new(-1.0, 0.0, 8.0), DVec3::new(-1.0, 0.0, -12.0)];
        for line in [[ahead, behind], [behind, ahead]] {
            let pieces = projector.project_polyline(&line);
            assert_eq!(pieces.len(), 1);
            let seen = projector.project(ahead).unwrap();
            assert!(pieces[0].iter().all(|pixel| pixel.x >= seen.x && (pixel.y - 50.0).abs() < 1e-6), "{pieces:?}");
            assert!(pieces[0].iter().any(|pixel| pixel.x > 1e4), "it leaves the picture: {pieces:?}");
        }
        assert!(projector.project_polyline(&[behind, behind - DVec3::Z]).is_empty());
    }

    #[test]
    fn a_circle_around_the_camera_is_seen_in_one_piece_or_two() {
        let camera = Camera { position: DVec3::ZERO, ..Camera::default() };
        let projector = Projector::new(&camera, 100, 100);
        let starts_ahead = projector.project_polyline(&circle(DVec3::NEG_Y, DVec3::Z, DVec3::X));
        assert_eq!(starts_ahead.len(), 2, "the line begins and ends in what is seen");
        let starts_behind = projector.project_polyline(&circle(DVec3::NEG_Y, DVec3::NEG_Z, DVec3::X));
        assert_eq!(starts_behind.len(), 1);
        for pixel in starts_ahead.iter().chain(&starts_behind).flatten() {
            assert!(pixel.is_finite() && pixel.y > 100.0, "below the picture: {pixel}");
        }
    }

    #[test]
    fn a_whole_line_ahead_keeps_its_points() {
        let projector = Projector::new(&Camera::default(), 100, 100);
        let line = circle(DVec3::new(0.0, 0.0, 3.0), DVec3::X, DVec3::Y);
        let pieces = projector.project_polyline(&line);
        let points: Vec<DVec2> = line.iter().map(|point| projector.project(*point).unwrap()).collect();
        assert_eq!(pieces, [points]);
    }

    fn solids() -> Vec<Solid> {
        let mut turned = SolidKind::ALL.map(Solid::course_default);
        for solid in &mut turned {
            solid.rotate(DVec3::new(20.0, 130.0, 77.0));
            solid.move_to(DVec3::new(3.0, -1.0, 5.0));
        }
        SolidKind::ALL.map(Solid::course_default).into_iter().chain(turned).collect()
    }

    #[test]
    fn outlines_have_the_lines_that_show_the_solid() {
        for solid in solids() {
            let lines = outline(&solid);
            let circles = lines.iter().filter(|line| line.len() > 2).count();
            let expected = match solid.kind() {
                SolidKind::Sphere => (3, 0),
                SolidKind::Box => (0, 12),
                SolidKind::Cylinder => (2, 4),
                SolidKind::Cone => (1, 4),
            };
            assert_eq!((circles, lines.len() - circles), expected, "{solid:?}");
        }
    }

    #[test]
    fn every_point_of_an_outline_lies_on_the_solid_s_surface() {
        for solid in solids() {
            let primitive = Primitive { name: None, solid: solid.clone(), material: Material::default() };
            let surface = Solids::new(&[primitive]);
            let lines = outline(&solid);
            let points: Vec<DVec3> = lines.iter().flatten().copied().collect();
            let middle = points.iter().sum::<DVec3>() / points.len() as f64;
            for point in points {
                // From inside a convex solid, its surface is as far as the outline's point.
                let ray = Ray { origin: middle, direction: point - middle };
                let hit = surface.nearest(&ray, OriginSurface::Free).unwrap();
                assert!((hit.t - 1.0).abs() < 1e-9, "{solid:?}: {point} at {}", hit.t);
            }
        }
    }

    #[test]
    fn the_edges_of_a_box_are_twelve_different_ones() {
        let edges = outline(&Solid::course_default(SolidKind::Box));
        let mut middles: Vec<[i32; 3]> =
            edges.iter().map(|edge| edge[0].midpoint(edge[1]).as_ivec3().to_array()).collect();
        middles.sort_unstable();
        middles.dedup();
        assert_eq!(middles.len(), 12);
        assert!(edges.iter().all(|edge| edge[0].distance(edge[1]) == 2.0));
    }
}
