//! Scenes opened and saved, and what would be lost by it.

use super::*;

fn unsaved_question(action: Action) -> Option<Dialog> {
    Some(Dialog::Unsaved(Box::new(action)))
}

fn answer(state: &mut State, answer: UnsavedAnswer) -> Vec<Effect> {
    state.apply(Action::AnswerUnsaved(answer))
}

/// A folder with the showcase in `showcase.toml` and nonsense in `broken.toml`.
fn folder_with_scenes() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    gallery::scene("showcase").unwrap().save(&folder.path().join("showcase.toml")).unwrap();
    std::fs::write(folder.path().join("broken.toml"), "max_depth = 3\nmax_dpth = 3\n").unwrap();
    folder
}

#[test]
fn what_would_lose_changes_asks_first_and_cancelling_keeps_them() {
    let path = PathBuf::from("/nowhere.toml");
    for action in
        [Action::New, Action::Open, Action::OpenFile(path), Action::OpenGallery("four".to_owned()), Action::Quit]
    {
        for cancel in [Action::AnswerUnsaved(UnsavedAnswer::Cancel), Action::CloseDialog] {
            let mut state = edited();
            assert_eq!(state.apply(action.clone()), []);
            assert_eq!(state.dialog, unsaved_question(action.clone()));
            assert_eq!(state.apply(cancel), []);
            assert_eq!((state.dialog, state.document.scene().primitives.len()), (None, 1));
        }
    }
}

#[test]
fn without_changes_nothing_is_asked() {
    let mut state = start();
    state.document.camera_mut().position = DVec3::ONE;
    state.apply(Action::OpenGallery("four".to_owned()));
    assert_eq!((state.document.scene(), state.document.path()), (&gallery::scene("four").unwrap(), None));
    state.apply(Action::New);
    assert_eq!(state.document.scene(), &Scene::default());
    assert_eq!(state.apply(Action::Quit), [Effect::Quit]);
}

#[test]
fn discarding_goes_on() {
    let mut state = edited();
    state.apply(Action::New);
    assert_eq!(answer(&mut state, UnsavedAnswer::Discard), []);
    assert_eq!((&state.dialog, state.document.scene()), (&None, &Scene::default()));
    let mut state = edited();
    state.apply(Action::Quit);
    assert_eq!(answer(&mut state, UnsavedAnswer::Discard), [Effect::Quit]);
}

#[test]
fn the_file_chosen_after_discarding_is_not_asked_about_again() {
    let folder = folder_with_scenes();
    let mut state = edited();
    state.apply(Action::Open);
    answer(&mut state, UnsavedAnswer::Discard);
    assert_eq!(state.dialog, Some(Dialog::File(FilePurpose::Open)));
    assert!(state.document.has_unsaved_changes(), "until a file was chosen");
    state.apply(Action::OpenFile(folder.path().join("showcase.toml")));
    assert_eq!((&state.dialog, state.document.scene()), (&None, &gallery::scene("showcase").unwrap()));
}

#[test]
fn agreeing_to_a_loss_holds_for_one_file_dialog_only() {
    let mut state = edited();
    state.apply(Action::Open);
    answer(&mut state, UnsavedAnswer::Discard);
    state.apply(Action::CloseDialog);
    let open = Action::OpenFile(PathBuf::from("/nowhere.toml"));
    state.apply(open.clone());
    assert_eq!(state.dialog, unsaved_question(open));
}

#[test]
fn quitting_from_a_file_dialog_still_asks() {
    let mut state = edited();
    state.apply(Action::Open);
    answer(&mut state, UnsavedAnswer::Discard);
    assert_eq!(state.apply(Action::Quit), []);
    assert_eq!(state.dialog, unsaved_question(Action::Quit));
    answer(&mut state, UnsavedAnswer::Cancel);
    let open = Action::OpenFile(PathBuf::from("/nowhere.toml"));
    state.apply(open.clone());
    assert_eq!(state.dialog, unsaved_question(open), "the file dialog is gone and its agreement with it");
}

#[test]
fn an_unsaved_question_is_not_replaced() {
    let mut state = edited();
    state.apply(Action::New);
    assert_eq!(state.apply(Action::Quit), []);
    state.apply(Action::OpenFile(PathBuf::from("/nowhere.toml")));
    state.report("could not save the screenshot\nfor many reasons");
    assert_eq!(state.dialog, unsaved_question(Action::New));
    answer(&mut state, UnsavedAnswer::Cancel);
    assert_eq!(message(&state), Some(&Message::Failure("could not save the screenshot".to_owned())));
    state.apply(Action::CloseDialog);
    assert_eq!(state.dialog, None);
}

#[test]
fn saving_before_quitting_asks_for_a_file_and_then_quits() {
    let folder = tempfile::tempdir().unwrap();
    let mut state = edited();
    state.apply(Action::Quit);
    assert_eq!(answer(&mut state, UnsavedAnswer::Save), []);
    assert_eq!(state.dialog, Some(Dialog::File(FilePurpose::Save)));
    assert_eq!(state.apply(Action::SaveTo(folder.path().join("mine"))), [Effect::Quit]);
    let path = folder.path().join("mine.toml");
    assert_eq!(&Scene::load(&path).unwrap(), state.document.scene());
    assert_eq!(state.document.path(), Some(path.as_path()));
}

#[test]
fn saving_before_opening_writes_the_document_s_own_file() {
    let folder = folder_with_scenes();
    let path = folder.path().join("showcase.toml");
    let mut state = start();
    state.apply(Action::OpenFile(path.clone()));
    state.apply(Action::SetMaxDepth(3));
    state.apply(Action::New);
    answer(&mut state, UnsavedAnswer::Save);
    assert_eq!((state.dialog, state.document.scene()), (None, &Scene::default()));
    assert_eq!(Scene::load(&path).unwrap().max_depth, 3);
}

#[test]
fn what_waited_for_a_save_is_dropped_with_its_dialog() {
    let folder = tempfile::tempdir().unwrap();
    let mut state = edited();
    state.apply(Action::Quit);
    answer(&mut state, UnsavedAnswer::Save);
    state.apply(Action::CloseDialog);
    state.apply(Action::Save);
    assert_eq!(state.dialog, Some(Dialog::File(FilePurpose::Save)));
    assert_eq!(state.apply(Action::SaveTo(folder.path().join("mine.json"))), []);
    assert!(!state.document.has_unsaved_changes());
}

#[test]
fn a_failed_save_is_told_and_nothing_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["none/mine.toml", "mine.txt"] {
        let mut state = edited();
        state.apply(Action::Quit);
        answer(&mut state, UnsavedAnswer::Save);
        assert_eq!(state.apply(Action::SaveTo(folder.path().join(name))), []);
        assert!(matches!(message(&state), Some(Message::Failure(_))));
        assert!(state.document.has_unsaved_changes() && state.document.path().is_none());
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_file_that_cannot_be_opened_leaves_the_document_as_it_was() {
    let folder = folder_with_scenes();
    let mut state = start();
    state.apply(Action::OpenFile(folder.path().join("showcase.toml")));
    for (name, told) in [("broken.toml", "broken.toml:2: "), ("none.toml", "could not be read")] {
        state.apply(Action::Open);
        state.apply(Action::OpenFile(folder.path().join(name)));
        let Some(Message::Failure(failure)) = message(&state) else { panic!("{:?}", state.dialog) };
        assert!(failure.contains(told) && !failure.contains('\n'), "{failure}");
        state.apply(Action::CloseDialog);
    }
    state.apply(Action::OpenGallery("nothing".to_owned()));
    assert!(message(&state).is_some());
    assert_eq!(state.document.scene(), &gallery::scene("showcase").unwrap());
    assert_eq!(state.document.path(), Some(folder.path().join("showcase.toml").as_path()));
}

#[test]
fn a_screenshot_goes_into_a_picture_file() {
    let mut state = edited();
    state.apply(Action::Screenshot);
    assert_eq!(state.dialog, Some(Dialog::File(FilePurpose::Screenshot)));
    for (given, meant) in [("/a/b", "/a/b.png"), ("/a/b.EXR", "/a/b.EXR"), ("/a/b.png", "/a/b.png")] {
        let effects = state.apply(Action::ScreenshotTo(PathBuf::from(given)));
        assert_eq!((effects, &state.dialog), (vec![Effect::SaveScreenshot(PathBuf::from(meant))], &None));
    }
    assert_eq!(state.apply(Action::ScreenshotTo(PathBuf::from("/a/b.jpg"))), []);
    assert!(matches!(message(&state), Some(Message::Failure(_))));
}

#[test]
fn names_without_an_extension_get_the_usual_one() {
    let completed = |purpose: FilePurpose, name: &str| purpose.completed(PathBuf::from(name));
    assert_eq!(completed(FilePurpose::Save, "a"), PathBuf::from("a.toml"));
    assert_eq!(completed(FilePurpose::Save, "a."), PathBuf::from("a.toml"));
    assert_eq!(completed(FilePurpose::Save, "a.b/сцена"), PathBuf::from("a.b/сцена.toml"));
    assert_eq!(completed(FilePurpose::Save, "a.json"), PathBuf::from("a.json"));
    assert_eq!(completed(FilePurpose::Open, "a"), PathBuf::from("a"));
}

#[test]
fn recovered_work_is_taken_up_when_wanted() {
    let recovered = || Document::recovered(gallery::scene("four").unwrap(), Some(PathBuf::from("/a.toml")));
    let asked = || State::new(Document::new(Scene::default(), None), Preferences::default(), Some(recovered()));
    let mut state = asked();
    for action in [Action::CloseDialog, Action::New, Action::Add(SolidKind::Cone)] {
        state.apply(action);
        assert_eq!(state.dialog, Some(Dialog::Recover), "it must be answered");
    }
    state.apply(Action::AnswerRecover(true));
    assert_eq!((&state.dialog, state.document.scene()), (&None, recovered().scene()));
    assert!(state.document.has_unsaved_changes());

    let mut state = asked();
    assert_eq!(state.apply(Action::Quit), [Effect::Quit]);
    assert_eq!(state.dialog, Some(Dialog::Recover), "the question stays for the next run");
    state.apply(Action::AnswerRecover(false));
    assert_eq!((&state.dialog, state.document.scene()), (&None, &Scene::default()));
    state.apply(Action::AnswerRecover(true));
    assert!(!state.document.has_unsaved_changes());
}

#[test]
fn a_file_that_is_read_only_is_opened_with_what_is_lost_and_saved_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ball.nff");
    let text = "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45 resolution 64 64 b 0 0 0 s 0 0 0 1 c 0 0 0 1 0 0 1 2\n";
    std::fs::write(&path, text).unwrap();
    let mut state = start();
    assert_eq!(state.apply(Action::OpenFile(path)), []);
    let told = "line 1: an object stands before the first f: it is white and diffuse\n\
                line 1: a truncated cone is left out";
    assert_eq!(state.dialog, Some(Dialog::Message(Message::ReadOtherwise(told.to_owned()))));
    assert_eq!((state.document.scene().primitives.len(), state.document.path()), (1, None));
    state.apply(Action::CloseDialog);
    state.apply(Action::Save);
    assert_eq!(state.dialog, Some(Dialog::File(FilePurpose::Save)));
    state.apply(Action::SaveTo(folder.path().join("ball.nff")));
    assert!(
        matches!(&state.dialog, Some(Dialog::Message(Message::Failure(what))) if what.contains("NFF is read only"))
    );
}
