mod files;

use glam::DVec3;
use proptest::prelude::*;
use tempfile::TempDir;

use super::*;
use crate::plan::Precision;
use crate::scene::{COURSE_PRIMITIVE_LIMIT, Camera, Light, Material, Projection, Solid, SolidKind};
use crate::viewer::own_kernel::OwnKernel;

fn start() -> State {
    State::new(Document::new(Scene::default(), None), Preferences::default(), None)
}

/// With a sphere, which is selected and not saved.
fn edited() -> State {
    let mut state = start();
    state.apply(Action::Add(SolidKind::Sphere));
    assert!(state.document.has_unsaved_changes());
    state
}

fn message(state: &State) -> Option<&Message> {
    match &state.dialog {
        Some(Dialog::Message(message)) => Some(message),
        _ => None,
    }
}

#[test]
fn the_hundred_and_first_primitive_is_refused_in_the_course_s_words() {
    let mut state = start();
    for _ in 0..=COURSE_PRIMITIVE_LIMIT {
        assert_eq!(state.dialog, None);
        state.apply(Action::Add(SolidKind::Box));
    }
    assert_eq!(message(&state), Some(&Message::TooManyPrimitives));
    assert_eq!(state.document.scene().primitives.len(), COURSE_PRIMITIVE_LIMIT);
}

#[test]
fn an_empty_scene_and_a_missing_selection_are_told_apart() {
    let mut state = start();
    state.apply(Action::MoveTo(DVec3::ONE));
    assert_eq!(message(&state), Some(&Message::NoPrimitives));
    let mut state = edited();
    state.apply(Action::Select(None));
    state.apply(Action::SetMaterial(Material::default()));
    assert_eq!(message(&state), Some(&Message::NothingSelected));
}

#[test]
fn an_invalid_value_is_refused_in_one_line_that_names_it() {
    let mut state = edited();
    state.apply(Action::SetVerticalFov(180.0));
    let expected = Message::Failure("camera: vertical_fov_degrees = 180: must be between 0 and 180".to_owned());
    assert_eq!(message(&state), Some(&expected));
}

#[test]
fn a_slider_s_run_ends_with_any_other_action() {
    let mut state = edited();
    for (depth, between) in
        [(1, None), (2, None), (3, Some(Action::ShowHelp(true))), (4, None), (5, Some(Action::Select(Some(0))))]
    {
        between.map(|action| state.apply(action));
        state.apply(Action::SetMaxDepth(depth));
    }
    let depths = [0; 4].map(|_| {
        state.apply(Action::Undo);
        state.document.scene().max_depth
    });
    assert_eq!(depths, [4, 2, 20, 20]);
    assert!(!state.document.can_undo());
    state.apply(Action::Undo);
    assert_eq!(state.document.scene(), &Scene::default());
}

#[test]
fn actions_under_a_dialog_are_ignored_but_the_window_s_settings() {
    let mut state = edited();
    state.apply(Action::SetMaxDepth(0));
    let before = state.document.scene().clone();
    for action in [Action::Delete, Action::Undo, Action::New, Action::Save, Action::AnswerRecover(true)] {
        assert_eq!(state.apply(action), []);
    }
    assert_eq!(state.document.scene(), &before);
    assert!(message(&state).is_some());
    state.apply(Action::SetKernel(Kernel::Own(OwnKernel::REFERENCE)));
    state.apply(Action::SetContinuous(true));
    let sampling = Sampling { samples: 9, scale: 0.5 };
    state.apply(Action::SetSampling(sampling));
    assert_eq!((state.kernel, state.is_continuous), (Kernel::Own(OwnKernel::REFERENCE), true));
    assert_eq!(
        (state.accurate_sampling(), state.sampling(state.kernel)),
        (sampling, Sampling::PLAIN),
        "the reference has its own way"
    );
    state.apply(Action::CloseDialog);
    assert_eq!(state.dialog, None);
}

#[test]
fn the_first_kernel_is_the_accurate_one_with_samples_to_come() {
    assert_eq!(start().kernel, Kernel::Own(OwnKernel::ACCURATE));
    assert_eq!(start().sampling(start().kernel), Sampling { samples: 16, scale: 1.0 });
}

#[test]
fn a_kernel_and_samples_that_are_chosen_are_those_of_the_next_run() {
    let mut state = start();
    for kernel in [
        Kernel::Own(OwnKernel::COURSE),
        Kernel::Own(OwnKernel { precision: Some(Precision::F64), ..OwnKernel::ACCURATE }),
        Kernel::Own(OwnKernel::REFERENCE),
    ] {
        state.apply(Action::SetKernel(kernel));
        let next = State::new(Document::new(Scene::default(), None), state.preferences.clone(), None);
        assert_eq!(next.kernel, kernel);
    }
    state.apply(Action::SetSampling(Sampling { samples: 64, scale: 0.5 }));
    let next = State::new(Document::new(Scene::default(), None), state.preferences.clone(), None);
    assert_eq!(next.accurate_sampling(), Sampling { samples: 64, scale: 1.0 });
}

#[test]
fn what_a_run_is_asked_to_begin_with_is_not_remembered_until_it_is_chosen() {
    let course = || start().drawn_by(Some(Kernel::Own(OwnKernel::COURSE)), None);
    assert_eq!((course().kernel, course().preferences.kernel), (Kernel::Own(OwnKernel::COURSE), OwnKernel::ACCURATE));
    let setting = RenderSettings::default();
    let mut state = start().drawn_by(Some(Kernel::Own(OwnKernel::COURSE)), Some(setting));
    assert_eq!(state.kernel, Kernel::BySetting(setting), "the file goes before the scene");
    state.apply(Action::SetKernel(Kernel::Own(OwnKernel::REFERENCE)));
    state.apply(Action::SetKernel(Kernel::BySetting(setting)));
    assert_eq!(state.preferences.kernel, OwnKernel::REFERENCE, "the next run has no such file");
}

#[test]
fn preferences_are_clamped() {
    let mut state = start();
    state.apply(Action::SetPreferences(Preferences { ui_scale: 100.0, ..Preferences::default() }));
    assert_eq!(state.preferences.ui_scale, 3.0);
}

fn any_action() -> impl Strategy<Value = Action> {
    let number = || prop_oneof![8 => (-4.0..4.0).prop_map(|x: f64| (x * 4.0).round() / 4.0), 1 => Just(f64::NAN)];
    let vector = move || (number(), number(), number()).prop_map(DVec3::from);
    let kind = || proptest::sample::select(&SolidKind::ALL[..]);
    let index = || 0..4_usize;
    let material = |specular| Material { specular, ..Material::default() };
    prop_oneof![
        4 => kind().prop_map(Action::Add),
        2 => proptest::option::of(index()).prop_map(Action::Select),
        2 => vector().prop_map(Action::MoveTo),
        1 => vector().prop_map(Action::Rotate),
        1 => number().prop_map(move |specular| Action::SetMaterial(material(specular))),
        1 => kind().prop_map(|kind| Action::SetSolid(Solid::course_default(kind))),
        1 => Just(Action::Rename("name".to_owned())),
        2 => Just(Action::Duplicate),
        2 => Just(Action::Delete),
        1 => Just(Action::AddLight),
        1 => (index(), vector()).prop_map(|(index, intensity)| {
            Action::SetLight(index, Light { position: DVec3::ZERO, intensity, ..Light::default() })
        }),
        1 => index().prop_map(Action::DeleteLight),
        1 => vector().prop_map(Action::SetBackground),
        1 => (0..4_u32).prop_map(Action::SetMaxDepth),
        1 => proptest::sample::select(&Projection::ALL[..]).prop_map(Action::SetProjection),
        1 => number().prop_map(Action::SetVerticalFov),
        1 => Just(Action::ResetCamera),
        3 => Just(Action::Undo),
        2 => Just(Action::Redo),
    ]
}

proptest! {
    #[test]
    fn any_actions_leave_a_valid_scene_that_can_be_undone_to_the_start_and_redone(
        actions in proptest::collection::vec(any_action(), 0..60),
    ) {
        let mut state = start();
        for action in actions {
            state.apply(action);
            prop_assert!(state.document.scene().validate().is_ok());
            let count = state.document.scene().primitives.len();
            prop_assert!(state.document.selection().is_none_or(|index| index < count));
            state.apply(Action::CloseDialog);
        }
        let end = (state.document.scene().clone(), state.document.can_redo());
        while state.document.can_redo() {
            state.apply(Action::Redo);
        }
        let furthest = state.document.scene().clone();
        while state.document.can_undo() {
            state.apply(Action::Undo);
            prop_assert!(state.document.scene().validate().is_ok());
        }
        prop_assert_eq!(state.document.scene(), &Scene::default());
        prop_assert!(!state.document.has_unsaved_changes());
        while state.document.can_redo() {
            state.apply(Action::Redo);
        }
        prop_assert_eq!(state.document.scene(), &furthest);
        prop_assert!(end.1 || end.0 == furthest);
        prop_assert_eq!(&state.document.scene().camera.position, &Camera::default().position);
    }
}
