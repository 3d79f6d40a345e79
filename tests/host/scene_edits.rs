//! The course's edits: add, move, rotate.

use glam::{DMat3, DVec3};
use zerkalo::scene::{
    COURSE_PRIMITIVE_LIMIT, Material, Primitive, Scene, Solid, SolidKind, TooManyPrimitives, world_from_box,
};

fn ends(solid: &Solid) -> [DVec3; 2] {
    match solid {
        Solid::Cylinder { ends, .. } => *ends,
        other => panic!("not a cylinder: {other:?}"),
    }
}

fn axis(solid: &Solid) -> DVec3 {
    match solid {
        Solid::Cone { axis, .. } => *axis,
        other => panic!("not a cone: {other:?}"),
    }
}

#[test]
fn added_primitive_is_the_course_default_at_the_origin() {
    let mut scene = Scene::default();
    for (index, kind) in SolidKind::ALL.into_iter().enumerate() {
        assert_eq!(scene.add(kind, COURSE_PRIMITIVE_LIMIT), Ok(index));
        let expected = Primitive { name: None, solid: Solid::course_default(kind), material: Material::default() };
        assert_eq!(scene.primitives[index], expected);
        assert_eq!(expected.solid.position(), DVec3::ZERO);
    }
    scene.validate().unwrap();
}

#[test]
fn hundred_and_first_primitive_is_refused_and_nothing_changes() {
    let mut scene = Scene::default();
    for index in 0..100 {
        assert_eq!(scene.add(SolidKind::Sphere, COURSE_PRIMITIVE_LIMIT), Ok(index));
    }
    let before = scene.clone();
    let refusal = scene.add(SolidKind::Cone, COURSE_PRIMITIVE_LIMIT);
    assert_eq!(refusal, Err(TooManyPrimitives { limit: 100 }));
    assert_eq!(refusal.unwrap_err().to_string(), "the scene already holds 100 primitives, the most allowed here");
    assert_eq!(scene, before);
    assert_eq!(scene.add(SolidKind::Cone, 101), Ok(100));
}

#[test]
fn moving_sets_the_position_whatever_it_was() {
    let target = DVec3::new(1.5, -2.0, 1000.0);
    for kind in SolidKind::ALL {
        let mut solid = Solid::course_default(kind);
        solid.move_to(DVec3::new(7.0, 8.0, 9.0));
        solid.move_to(target);
        assert_eq!(solid.position(), target, "{kind:?}");
    }
}

#[test]
fn moved_cylinder_keeps_its_orientation_and_length() {
    let mut solid = Solid::Cylinder { ends: [DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 4.0, 5.0)], radius: 0.5 };
    solid.move_to(DVec3::new(10.0, 0.0, 0.0));
    assert_eq!(ends(&solid), [DVec3::new(9.5, -1.0, -1.0), DVec3::new(10.5, 1.0, 1.0)]);
}

#[test]
fn sphere_does_not_turn() {
    let mut solid = Solid::course_default(SolidKind::Sphere);
    solid.rotate(DVec3::new(10.0, 20.0, 30.0));
    assert_eq!(solid, Solid::course_default(SolidKind::Sphere));
}

#[test]
fn box_takes_the_angles_of_the_last_turn() {
    let mut solid = Solid::course_default(SolidKind::Box);
    solid.rotate(DVec3::new(10.0, 20.0, 30.0));
    solid.rotate(DVec3::new(1.0, 2.0, 3.0));
    let Solid::Box { rotation_degrees, .. } = solid else { unreachable!() };
    assert_eq!(rotation_degrees, DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn cylinder_turns_about_its_middle_from_where_it_is() {
    let start = DVec3::new(5.0, 6.0, 7.0);
    let mut solid = Solid::Cylinder { ends: [start, start + DVec3::new(2.0, 0.0, 0.0)], radius: 1.0 };
    // Rz(-90) takes x to -y; a second quarter takes it on to -x.
    solid.rotate(DVec3::new(0.0, 0.0, 90.0));
    assert_eq!(ends(&solid), [DVec3::new(6.0, 7.0, 7.0), DVec3::new(6.0, 5.0, 7.0)]);
    solid.rotate(DVec3::new(0.0, 0.0, 90.0));
    assert_eq!(ends(&solid), [DVec3::new(7.0, 6.0, 7.0), DVec3::new(5.0, 6.0, 7.0)]);
}

#[test]
fn cylinder_of_figure_3_5_comes_from_the_default_one() {
    let mut solid = Solid::course_default(SolidKind::Cylinder);
    solid.move_to(DVec3::new(-3.0, 0.0, 1.0));
    solid.rotate(DVec3::new(0.0, 30.0, 10.0));
    // From the golden f_all_four, computed in f32 there, its ends in the other order.
    let golden = [
        DVec3::new(-2.639535427093506, -0.0635596439242363, 2.366025447845459),
        DVec3::new(-3.360464572906494, 0.0635596439242363, -0.366025447845459),
    ];
    for (end, golden) in ends(&solid).into_iter().zip(golden) {
        assert!((end - golden).length() < 1e-6, "{end} {golden}");
    }
}

#[test]
fn cone_of_figure_3_5_comes_from_the_default_one() {
    let mut solid = Solid::course_default(SolidKind::Cone);
    let apex = DVec3::new(1.9, -0.5, -2.0);
    solid.move_to(apex);
    solid.rotate(DVec3::new(10.0, 0.0, 15.0));
    let golden = DVec3::new(-0.2548869848251343, -0.951251208782196, 0.1736481785774231);
    assert!((axis(&solid) - golden).length() < 1e-7, "{}", axis(&solid));
    assert_eq!(solid.position(), apex);
}

#[test]
fn turns_about_x_then_y_then_z() {
    // (0,-1,0) by Rx(-90) to (0,0,1), by Ry(-90) to (-1,0,0), by Rz(-90) to (0,1,0); other orders end elsewhere.
    for (degrees, expected) in [
        (DVec3::new(90.0, 90.0, 90.0), DVec3::Y),
        (DVec3::new(90.0, 0.0, 0.0), DVec3::Z),
        (DVec3::new(90.0, 90.0, 0.0), DVec3::NEG_X),
        (DVec3::new(0.0, 0.0, 90.0), DVec3::NEG_X),
        (DVec3::new(0.0, 90.0, 0.0), DVec3::NEG_Y),
        (DVec3::new(180.0, 0.0, 0.0), DVec3::Y),
        (DVec3::new(-270.0, 0.0, 720.0), DVec3::Z),
    ] {
        let mut solid = Solid::course_default(SolidKind::Cone);
        solid.rotate(degrees);
        assert_eq!(axis(&solid), expected, "{degrees}");
    }
}

#[test]
fn box_matrix_is_exact_at_quarter_turns() {
    assert_eq!(world_from_box(DVec3::ZERO), DMat3::IDENTITY);
    // Rx(-90): y to -z, z to y.
    let quarter = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);
    assert_eq!(world_from_box(DVec3::new(90.0, 0.0, 0.0)), quarter);
    assert_eq!(world_from_box(DVec3::new(90.0 + 3600.0, 0.0, -720.0)), quarter);
    // Rx(-90)·Ry(-90)·Rz(-90): x to -y, -y, z; y to x, z, y; z to z, -x, -x.
    let all = DMat3::from_cols(DVec3::Z, DVec3::Y, DVec3::NEG_X);
    assert_eq!(world_from_box(DVec3::splat(90.0)), all);
}

#[test]
fn box_matrix_is_a_rotation_and_agrees_with_the_product_of_library_rotations() {
    for degrees in [DVec3::new(30.0, 40.0, 50.0), DVec3::new(-123.0, 359.5, 0.25), DVec3::splat(45.0)] {
        let matrix = world_from_box(degrees);
        let (a, b, c) = (degrees.x.to_radians(), degrees.y.to_radians(), degrees.z.to_radians());
        let product = DMat3::from_rotation_x(-a) * DMat3::from_rotation_y(-b) * DMat3::from_rotation_z(-c);
        assert!(matrix.abs_diff_eq(product, 4e-15), "{degrees}");
        assert!((matrix.determinant() - 1.0).abs() < 1e-14);
        assert!(matrix.transpose().mul_mat3(&matrix).abs_diff_eq(DMat3::IDENTITY, 1e-14));
    }
}

#[test]
fn many_turns_leave_a_cone_valid() {
    let mut scene = Scene::default();
    scene.add(SolidKind::Cone, 1).unwrap();
    for turn in 0..10_000 {
        scene.primitives[0].solid.rotate(DVec3::new(7.5, 0.5 * f64::from(turn), 121.0));
        scene.validate().unwrap();
    }
}
