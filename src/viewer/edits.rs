//! The edits that the panel offers, each a step that can be undone.

use glam::DVec3;

use super::camera_frame::unit;
use super::document::Document;
use super::history::Field;
use super::outline::outline;
use crate::scene::{
    COURSE_PRIMITIVE_LIMIT, Light, Material, Primitive, Projection, SceneError, Solid, SolidKind, TooManyPrimitives,
};

/// Why an edit was not made; nothing has changed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    #[error("the scene has no primitives")]
    NoPrimitives,
    #[error("no primitive is selected")]
    NothingSelected,
    #[error(transparent)]
    TooManyPrimitives(#[from] TooManyPrimitives),
    #[error(transparent)]
    Invalid(#[from] SceneError),
}

/// None of them leaves the scene invalid, and the first three leave what they made or what came in its place selected.
impl Document {
    pub(super) fn add(&mut self, kind: SolidKind) -> Result<(), Refusal> {
        self.append(Primitive::course_default(kind))
    }

    /// The copy stands beside the original, on its +x side, lest it be invisible.
    pub(super) fn duplicate(&mut self) -> Result<(), Refusal> {
        let (_, original) = self.selected_or_refusal()?;
        let mut copy = original.clone();
        let position = copy.solid.position();
        copy.solid.move_to(position + DVec3::X * width(&copy.solid));
        self.append(copy)
    }

    pub(super) fn delete(&mut self) -> Result<(), Refusal> {
        let (index, _) = self.selected_or_refusal()?;
        self.edit(None, |scene| scene.remove_primitive(index))?;
        let last = self.scene().primitives.len().checked_sub(1);
        self.select(last.map(|last| index.min(last)));
        Ok(())
    }

    pub(super) fn rename(&mut self, name: String) -> Result<(), Refusal> {
        self.edit_selected(Field::Name, |primitive| primitive.name = Some(name).filter(|name| !name.is_empty()))
    }

    pub(super) fn move_to(&mut self, target: DVec3) -> Result<(), Refusal> {
        self.edit_selected(Field::Position, |primitive| primitive.solid.move_to(target))
    }

    pub(super) fn rotate(&mut self, degrees: DVec3) -> Result<(), Refusal> {
        self.edit_selected(Field::Rotation, |primitive| primitive.solid.rotate(degrees))
    }

    /// A solid of another kind is not taken. A cone's axis may have any length but 0.
    pub(super) fn set_solid(&mut self, mut solid: Solid) -> Result<(), Refusal> {
        if let Solid::Cone { axis, .. } = &mut solid
            && *axis != DVec3::ZERO
        {
            *axis = unit(*axis);
        }
        self.edit_selected(Field::Solid, |primitive| {
            if primitive.solid.kind() == solid.kind() {
                primitive.solid = solid;
            }
        })
    }

    pub(super) fn set_material(&mut self, material: Material) -> Result<(), Refusal> {
        self.edit_selected(Field::Material, |primitive| primitive.material = material)
    }

    pub(super) fn add_light(&mut self) -> Result<(), Refusal> {
        Ok(self.edit(None, |scene| scene.lights.push(Light::default()))?)
    }

    /// A light that is not there is not set.
    pub(super) fn set_light(&mut self, index: usize, light: Light) -> Result<(), Refusal> {
        Ok(self.edit(Some(Field::Light(index)), |scene| {
            if let Some(old) = scene.lights.get_mut(index) {
                *old = light;
            }
        })?)
    }

    /// A light that is not there is not deleted.
    pub(super) fn delete_light(&mut self, index: usize) -> Result<(), Refusal> {
        Ok(self.edit(None, |scene| {
            if index < scene.lights.len() {
                scene.remove_light(index);
            }
        })?)
    }

    pub(super) fn set_ambient_light(&mut self, color: DVec3) -> Result<(), Refusal> {
        Ok(self.edit(Some(Field::AmbientLight), |scene| scene.ambient_light = color)?)
    }

    pub(super) fn set_background(&mut self, color: DVec3) -> Result<(), Refusal> {
        Ok(self.edit(Some(Field::Background), |scene| scene.background = color)?)
    }

    pub(super) fn set_max_depth(&mut self, max_depth: u32) -> Result<(), Refusal> {
        Ok(self.edit(Some(Field::MaxDepth), |scene| scene.max_depth = max_depth)?)
    }

    pub(super) fn set_projection(&mut self, projection: Projection) -> Result<(), Refusal> {
        Ok(self.edit(Some(Field::Projection), |scene| scene.camera.projection = projection)?)
    }

    pub(super) fn set_vertical_fov(&mut self, degrees: f64) -> Result<(), Refusal> {
        Ok(self.edit(Some(Field::VerticalFov), |scene| scene.camera.vertical_fov_degrees = degrees)?)
    }

    fn append(&mut self, primitive: Primitive) -> Result<(), Refusal> {
        let index = self.scene().primitives.len();
        if index >= COURSE_PRIMITIVE_LIMIT {
            return Err(TooManyPrimitives { limit: COURSE_PRIMITIVE_LIMIT }.into());
        }
        self.edit(None, |scene| scene.primitives.push(primitive))?;
        self.select(Some(index));
        Ok(())
    }

    fn edit_selected(&mut self, field: fn(usize) -> Field, change: impl FnOnce(&mut Primitive)) -> Result<(), Refusal> {
        let (index, _) = self.selected_or_refusal()?;
        Ok(self.edit(Some(field(index)), |scene| change(&mut scene.primitives[index]))?)
    }

    fn selected_or_refusal(&self) -> Result<(usize, &Primitive), Refusal> {
        let refusal = if self.scene().primitives.is_empty() { Refusal::NoPrimitives } else { Refusal::NothingSelected };
        self.selection().zip(self.selected()).ok_or(refusal)
    }
}

/// How far the solid's outline reaches along the world's x, or 1 if it is a plate across it.
fn width(solid: &Solid) -> f64 {
    let points = || outline(solid).into_iter().flatten().map(|point| point.x);
    let width = points().fold(f64::NEG_INFINITY, f64::max) - points().fold(f64::INFINITY, f64::min);
    if width > 0.0 { width } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{DEPTH_LIMIT, LIGHT_LIMIT, Scene};

    fn empty() -> Document {
        Document::new(Scene::default(), None)
    }

    fn document_of(kind: SolidKind) -> Document {
        let mut document = empty();
        document.add(kind).unwrap();
        document
    }

    #[test]
    fn what_is_added_is_selected_up_to_the_course_s_limit() {
        let mut document = empty();
        for index in 0..COURSE_PRIMITIVE_LIMIT {
            document.add(SolidKind::Cone).unwrap();
            assert_eq!(document.selection(), Some(index));
        }
        let full = Err(Refusal::TooManyPrimitives(TooManyPrimitives { limit: COURSE_PRIMITIVE_LIMIT }));
        document.select(Some(3));
        assert_eq!((document.add(SolidKind::Box), document.duplicate()), (full.clone(), full));
        assert_eq!((document.scene().primitives.len(), document.selection()), (COURSE_PRIMITIVE_LIMIT, Some(3)));
    }

    #[test]
    fn a_copy_stands_beside_its_original_and_is_selected() {
        for (kind, width) in
            [(SolidKind::Sphere, 2.0), (SolidKind::Box, 2.0), (SolidKind::Cylinder, 2.0 + 2.0_f64.sqrt())]
        {
            let mut document = document_of(kind);
            document.rename("mine".to_owned()).unwrap();
            document.duplicate().unwrap();
            let [original, copy] = &document.scene().primitives[..] else { panic!("two of them") };
            let shift = copy.solid.position() - original.solid.position();
            assert!((shift - DVec3::X * width).length() < 0.01, "{kind:?}: {shift}");
            assert_eq!((&copy.name, &copy.material), (&Some("mine".to_owned()), &original.material));
            assert_eq!(document.selection(), Some(1));
        }
    }

    #[test]
    fn a_copy_of_a_plate_across_x_is_not_in_the_same_place() {
        let mut document = document_of(SolidKind::Box);
        let plate =
            Solid::Box { center: DVec3::ZERO, half_size: DVec3::new(0.0, 1.0, 1.0), rotation_degrees: DVec3::ZERO };
        document.set_solid(plate).unwrap();
        document.duplicate().unwrap();
        assert_eq!(document.selected().unwrap().solid.position(), DVec3::X);
    }

    #[test]
    fn deleting_selects_the_neighbour() {
        let mut document = empty();
        for kind in [SolidKind::Sphere, SolidKind::Box, SolidKind::Cylinder, SolidKind::Cone] {
            document.add(kind).unwrap();
        }
        document.select(Some(1));
        document.delete().unwrap();
        assert_eq!(document.selected().unwrap().solid.kind(), SolidKind::Cylinder);
        document.delete().unwrap();
        assert_eq!(document.selected().unwrap().solid.kind(), SolidKind::Cone);
        document.delete().unwrap();
        assert_eq!(document.selected().unwrap().solid.kind(), SolidKind::Sphere);
        document.delete().unwrap();
        assert_eq!((document.selection(), document.delete()), (None, Err(Refusal::NoPrimitives)));
        document.undo();
        assert_eq!(document.selected().unwrap().solid.kind(), SolidKind::Sphere);
    }

    #[test]
    fn nothing_selected_and_nothing_there_are_different_refusals() {
        type Edit = fn(&mut Document) -> Result<(), Refusal>;
        let edits: [Edit; 7] = [
            |document| document.move_to(DVec3::ONE),
            |document| document.rotate(DVec3::ONE),
            |document| document.set_material(Material::default()),
            |document| document.set_solid(Solid::course_default(SolidKind::Sphere)),
            |document| document.rename("a".to_owned()),
            |document| document.duplicate(),
            |document| document.delete(),
        ];
        for edit in edits {
            assert_eq!(edit(&mut empty()), Err(Refusal::NoPrimitives));
            let mut document = document_of(SolidKind::Sphere);
            document.select(None);
            assert_eq!(edit(&mut document), Err(Refusal::NothingSelected));
        }
    }

    #[test]
    fn an_empty_name_takes_the_given_one_away() {
        let mut document = document_of(SolidKind::Sphere);
        document.rename("left wall".to_owned()).unwrap();
        assert_eq!(document.selected().unwrap().name.as_deref(), Some("left wall"));
        document.rename(String::new()).unwrap();
        assert_eq!(document.selected().unwrap().name, None);
    }

    #[test]
    fn a_cone_s_axis_is_normalised_and_a_zero_one_refused() {
        let mut document = document_of(SolidKind::Cone);
        let cone = |axis| Solid::Cone { apex: DVec3::ZERO, axis, height: 2.0, half_angle_degrees: 30.0 };
        document.set_solid(cone(DVec3::new(0.0, 0.0, 5.0))).unwrap();
        assert_eq!(document.selected().unwrap().solid, cone(DVec3::Z));
        assert!(matches!(document.set_solid(cone(DVec3::ZERO)), Err(Refusal::Invalid(_))));
    }

    #[test]
    fn a_solid_of_another_kind_is_not_taken() {
        let mut document = document_of(SolidKind::Cone);
        document.set_solid(Solid::course_default(SolidKind::Box)).unwrap();
        assert_eq!(document.selected().unwrap().solid.kind(), SolidKind::Cone);
    }

    #[test]
    fn edits_of_two_fields_or_two_primitives_are_two_steps() {
        let mut document = document_of(SolidKind::Sphere);
        document.add(SolidKind::Sphere).unwrap();
        for x in 1..=3 {
            document.move_to(DVec3::X * f64::from(x)).unwrap();
        }
        document.set_material(Material { ambient: 0.5, ..Material::default() }).unwrap();
        document.select(Some(0));
        document.move_to(DVec3::Y).unwrap();
        document.undo();
        document.undo();
        let positions = document.scene().primitives.iter().map(|primitive| primitive.solid.position());
        assert_eq!(positions.collect::<Vec<_>>(), [DVec3::ZERO, DVec3::X * 3.0]);
        document.undo();
        assert_eq!(document.selected().unwrap().solid.position(), DVec3::ZERO);
        assert_eq!(document.scene().primitives.len(), 2);
    }

    #[test]
    fn lights_are_added_set_and_deleted_and_those_not_there_are_left_alone() {
        let mut document = empty();
        document.add_light().unwrap();
        let light = Light { position: DVec3::ONE, intensity: DVec3::X, ..Light::default() };
        document.set_light(1, light.clone()).unwrap();
        document.set_light(2, light.clone()).unwrap();
        document.delete_light(2).unwrap();
        assert_eq!(document.scene().lights, [Light::default(), light.clone()]);
        document.delete_light(0).unwrap();
        assert_eq!(document.scene().lights, [light]);
        for _ in 1..LIGHT_LIMIT {
            document.add_light().unwrap();
        }
        assert!(matches!(document.add_light(), Err(Refusal::Invalid(_))));
    }

    #[test]
    fn impossible_values_are_refused() {
        let mut document = document_of(SolidKind::Sphere);
        assert!(document.move_to(DVec3::splat(f64::NAN)).is_err());
        assert!(document.set_material(Material { specular: 1.5, ..Material::default() }).is_err());
        assert!(document.set_max_depth(DEPTH_LIMIT + 1).is_err());
        assert!(document.set_vertical_fov(180.0).is_err());
        assert!(document.set_background(DVec3::NEG_X).is_err());
        assert!(
            document
                .set_light(0, Light { position: DVec3::ZERO, intensity: DVec3::NEG_ONE, ..Light::default() })
                .is_err()
        );
        assert_eq!(document.scene(), document_of(SolidKind::Sphere).scene());
    }
}
