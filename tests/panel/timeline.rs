//! The bar under a scene that moves.

use egui::{Key, Modifiers};
use zerkalo::scene::gallery;
use zerkalo::viewer::preferences::Language;
use zerkalo::viewer::timeline::Timeline;

use crate::hands::*;

fn open_scene(name: &str, language: Language) -> Window {
    open_with(gallery::scene(name).unwrap(), language)
}

fn timeline(window: &Window) -> Timeline {
    window.state().state.document.timeline()
}

#[test]
fn a_scene_that_moves_is_played_paused_and_stopped_and_no_other_has_the_buttons() {
    for (language, play, pause, stop) in
        [(Language::Russian, "Пуск", "Пауза", "Стоп"), (Language::English, "Play", "Pause", "Stop")]
    {
        let mut window = open(language);
        assert!([play, pause, stop].iter().all(|name| !is_there(&window, name)));
        window = open_scene("orbit", language);
        assert_eq!(timeline(&window), Timeline::default(), "as its file has it");
        click(&mut window, play);
        let playing = Timeline { seconds: Some(0.0), is_playing: true, ..Timeline::default() };
        assert_eq!(timeline(&window), playing);
        click(&mut window, pause);
        assert_eq!(timeline(&window), Timeline { is_playing: false, ..playing });
        click(&mut window, stop);
        assert_eq!(timeline(&window), Timeline::default());
    }
}

#[test]
fn the_space_bar_plays_and_pauses_what_moves() {
    let mut window = open_scene("orbit", Language::English);
    let played = [1, 2, 3].map(|_| {
        press(&mut window, Modifiers::NONE, Key::Space);
        timeline(&window).is_playing
    });
    assert_eq!(played, [true, false, true]);
    let mut window = open(Language::English);
    press(&mut window, Modifiers::NONE, Key::Space);
    assert_eq!(timeline(&window), Timeline::default(), "nothing moves");
}

#[test]
fn time_and_rate_are_typed_and_stay_in_range() {
    let mut window = open_scene("dolly", Language::Russian);
    type_into(&mut window, "Анимация: время", "1,5");
    assert_eq!(timeline(&window), Timeline { seconds: Some(1.5), ..Timeline::default() });
    type_into(&mut window, "Анимация: кадров/с", "2");
    type_into(&mut window, "Анимация: время", "1.7");
    assert_eq!(timeline(&window).picture_seconds(), Some(1.5), "of the last picture");
    assert_eq!(value(&window, "Анимация: время"), "1.5");
    type_into(&mut window, "Анимация: время", "9");
    assert_eq!(timeline(&window).seconds, Some(4.0), "the last keyframe");
    type_into(&mut window, "Анимация: кадров/с", "0");
    assert_eq!(timeline(&window).rate, 0.1);
}

#[test]
fn only_an_animated_camera_can_be_followed() {
    let mut window = open_scene("dolly", Language::English);
    click(&mut window, "animated camera");
    assert!(!timeline(&window).follows_camera);
    assert!(!is_there(&open_scene("reflection", Language::English), "animated camera"));
}
