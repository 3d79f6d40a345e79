//! Help, faults, and what holds for every widget.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect};
use egui_kittest::kittest::{NodeT, Queryable};
use zerkalo::scene::{SolidKind, gallery};
use zerkalo::viewer::action::Action;
use zerkalo::viewer::preferences::Language;

use crate::hands::*;

#[test]
fn the_help_sheet_comes_and_goes_with_its_key() {
    let mut window = open(Language::Russian);
    press(&mut window, Modifiers::NONE, Key::F1);
    assert!(is_there(&window, "осмотреться"));
    press(&mut window, Modifiers::NONE, Key::F1);
    assert!(!is_there(&window, "осмотреться"));
    press(&mut window, Modifiers::NONE, Key::F1);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!is_there(&window, "осмотреться"));
}

#[test]
fn a_refusal_is_shown_over_the_picture() {
    let mut window = open(Language::English);
    window.state_mut().refusal = Some("it has 2 lights, and the course's kernel knows one");
    window.run();
    let fault = window.get_by_label("it has 2 lights, and the course's kernel knows one").rect();
    assert!(window.state().picture.contains_rect(fault), "{fault}");
}

#[test]
fn the_picture_is_free_of_widgets() {
    let window = open(Language::Russian);
    let picture = window.state().picture;
    assert!(picture.width() > 900.0 && picture.height() > 1400.0, "{picture}");
    let covering = named_widgets(&window).into_iter().filter(|(_, rect)| rect.shrink(1.0).intersects(picture));
    assert_eq!(covering.collect::<Vec<_>>(), []);
    let layer = window.ctx.layer_id_at(picture.center());
    assert!(layer.is_none_or(|layer| layer.order == egui::Order::Background), "{layer:?}");
}

#[test]
fn every_widget_has_a_name_of_its_own() {
    for language in BOTH {
        let mut window = open(language);
        apply(&mut window, Action::AddLight);
        for kind in SolidKind::ALL {
            apply(&mut window, Action::Add(kind));
            let mut names: Vec<String> = named_widgets(&window).into_iter().map(|(name, _)| name).collect();
            assert!(names.len() > 40, "{names:?}");
            assert!(names.iter().all(|name| !name.is_empty()), "{names:?}");
            names.sort();
            let twice: Vec<_> = names.windows(2).filter(|pair| pair[0] == pair[1]).collect();
            assert!(twice.is_empty(), "{twice:?}");
        }
    }
}

#[test]
fn every_sign_of_every_word_can_be_drawn() {
    let window = open(Language::Russian);
    let font = egui::FontId::default();
    for language in BOTH {
        let words = format!("{:?} ⏴⏵⏶×", language.words());
        let missing: String =
            window.ctx.fonts_mut(|fonts| words.chars().filter(|sign| !fonts.has_glyph(&font, *sign)).collect());
        assert_eq!(missing, "");
    }
}

#[test]
fn every_group_is_in_sight_in_a_tall_window() {
    let window = open_with(gallery::scene("showcase").unwrap(), Language::Russian);
    let inside = Rect::from_min_size(Pos2::ZERO, SIZE);
    let outside = named_widgets(&window).into_iter().filter(|(_, rect)| !inside.contains_rect(*rect));
    assert_eq!(outside.collect::<Vec<_>>(), []);
}

/// What can be clicked or typed into, with its place.
fn named_widgets(window: &Window) -> Vec<(String, Rect)> {
    let roles = [Role::Button, Role::SpinButton, Role::TextInput, Role::CheckBox, Role::RadioButton, Role::ComboBox];
    let is_widget = move |node: &egui_kittest::kittest::AccessKitNode<'_>| roles.contains(&node.role());
    let widgets = window.query_all_by(is_widget);
    widgets.map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect())).collect()
}

#[test]
fn a_right_click_in_the_picture_is_left_to_the_picture() {
    let mut window = open(Language::Russian);
    let picture = window.state().picture.center();
    window.event(Event::PointerMoved(picture));
    window.event(Event::PointerButton {
        pos: picture,
        button: PointerButton::Secondary,
        pressed: true,
        modifiers: Modifiers::NONE,
    });
    window.run();
    assert!(!window.ctx.egui_wants_pointer_input());
}
