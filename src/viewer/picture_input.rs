//! The mouse and the keys over the picture: looking, flying, going around, choosing.

use std::collections::HashSet;

use glam::{DVec2, DVec3};
use winit::event::MouseButton;
use winit::keyboard::KeyCode;

use super::camera_motion::{self, Flight};
use crate::scene::Camera;

/// A press that moves no farther than this, pixels, is a click.
const CLICK_SLACK: f64 = 4.0;

/// What the buttons and keys held over the picture do.
#[derive(Debug, Default)]
pub struct PictureInput {
    cursor: DVec2,
    /// With the button that it ends with.
    gesture: Option<(Gesture, MouseButton)>,
    keys: HashSet<KeyCode>,
    is_alt_held: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Gesture {
    /// The right button: the mouse turns the view, the keys fly.
    Look,
    /// The middle button, or Alt with the left: around this point, which stays the same however the view changes.
    Orbit(DVec3),
    /// The left button, where it was pressed.
    Click(DVec2),
}

impl PictureInput {
    /// Pixels from the window's top left corner.
    pub fn cursor(&self) -> DVec2 {
        self.cursor
    }

    /// A button goes down over the picture; `pivot` is what there is to go around.
    pub fn press(&mut self, button: MouseButton, pivot: DVec3) {
        if self.gesture.is_none() {
            let gesture = match button {
                MouseButton::Right => Gesture::Look,
                MouseButton::Middle => Gesture::Orbit(pivot),
                MouseButton::Left if self.is_alt_held => Gesture::Orbit(pivot),
                MouseButton::Left => Gesture::Click(self.cursor),
                _ => return,
            };
            self.gesture = Some((gesture, button));
        }
    }

    /// A button goes up, anywhere; returns where a click was made.
    pub fn release(&mut self, button: MouseButton) -> Option<DVec2> {
        let (gesture, _) = self.gesture.take_if(|(_, held)| *held == button)?;
        match gesture {
            Gesture::Click(from) => (from.distance(self.cursor) <= CLICK_SLACK).then_some(from),
            Gesture::Look | Gesture::Orbit(_) => None,
        }
    }

    /// The cursor moves, anywhere; the camera is taken where it moves, too.
    pub fn move_to<'c>(&mut self, cursor: DVec2, camera: impl FnOnce() -> &'c mut Camera, is_inverted: bool) {
        let pixels = cursor - std::mem::replace(&mut self.cursor, cursor);
        match self.gesture.map(|(gesture, _)| gesture) {
            Some(Gesture::Look) => camera_motion::look(camera(), pixels, is_inverted),
            Some(Gesture::Orbit(pivot)) => camera_motion::orbit(camera(), pivot, pixels),
            Some(Gesture::Click(_)) | None => {}
        }
    }

    pub fn set_alt_held(&mut self, is_held: bool) {
        self.is_alt_held = is_held;
    }

    pub fn key(&mut self, key: KeyCode, is_pressed: bool) {
        if is_pressed {
            self.keys.insert(key);
        } else {
            self.keys.remove(&key);
        }
    }

    /// The window loses the focus: what is released elsewhere is not heard of.
    pub fn let_go(&mut self) {
        self.gesture = None;
        self.keys.clear();
    }

    /// Whether a button pressed over the picture is still held.
    pub fn is_busy(&self) -> bool {
        self.gesture.is_some()
    }

    /// Where the keys want to go while the view is being turned, if anywhere.
    pub fn flight(&self) -> Option<Flight> {
        let wish = |forth, back| f64::from(self.keys.contains(&forth)) - f64::from(self.keys.contains(&back));
        let flight = Flight {
            ahead: wish(KeyCode::KeyW, KeyCode::KeyS),
            left: wish(KeyCode::KeyA, KeyCode::KeyD),
            up: wish(KeyCode::KeyQ, KeyCode::KeyE),
        };
        (matches!(self.gesture, Some((Gesture::Look, _))) && flight != Flight::default()).then_some(flight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(input: &mut PictureInput, camera: &mut Camera, x: f64, y: f64) {
        input.move_to(DVec2::new(x, y), || camera, false);
    }

    #[test]
    fn the_mouse_turns_the_view_only_while_the_right_button_is_held() {
        let (mut input, mut camera) = (PictureInput::default(), Camera::default());
        moved(&mut input, &mut camera, 50.0, 50.0);
        assert_eq!(camera, Camera::default());
        input.press(MouseButton::Right, DVec3::ZERO);
        moved(&mut input, &mut camera, 150.0, 50.0);
        let turned = camera.direction.angle_between(DVec3::Z);
        assert!((turned - 0.1).abs() < 1e-9, "100 pixels at 0.001 rad: {turned}");
        assert_eq!(input.release(MouseButton::Right), None);
        let before = camera.clone();
        moved(&mut input, &mut camera, 0.0, 0.0);
        assert_eq!(camera, before);
    }

    #[test]
    fn keys_fly_only_while_the_view_is_being_turned() {
        let mut input = PictureInput::default();
        input.key(KeyCode::KeyW, true);
        assert_eq!(input.flight(), None);
        input.press(MouseButton::Right, DVec3::ZERO);
        assert_eq!(input.flight(), Some(Flight { ahead: 1.0, ..Flight::default() }));
        input.key(KeyCode::KeyS, true);
        assert_eq!(input.flight(), None, "both ways at once");
        input.key(KeyCode::KeyS, false);
        input.let_go();
        assert_eq!((input.flight(), input.is_busy()), (None, false));
    }

    #[test]
    fn a_click_is_a_press_and_a_release_at_one_place() {
        let (mut input, mut camera) = (PictureInput::default(), Camera::default());
        moved(&mut input, &mut camera, 10.0, 20.0);
        input.press(MouseButton::Left, DVec3::ZERO);
        moved(&mut input, &mut camera, 12.0, 21.0);
        assert_eq!(input.release(MouseButton::Left), Some(DVec2::new(10.0, 20.0)));
        input.press(MouseButton::Left, DVec3::ZERO);
        moved(&mut input, &mut camera, 60.0, 20.0);
        assert_eq!(input.release(MouseButton::Left), None, "a drag");
        assert_eq!(input.release(MouseButton::Left), None, "pressed elsewhere");
    }

    #[test]
    fn alt_and_the_left_button_go_around_as_the_middle_one_does() {
        for (button, is_alt_held) in [(MouseButton::Middle, false), (MouseButton::Left, true)] {
            let (mut input, mut camera) = (PictureInput::default(), Camera::default());
            input.set_alt_held(is_alt_held);
            input.press(button, DVec3::ZERO);
            moved(&mut input, &mut camera, 30.0, 0.0);
            assert_ne!(camera.position, Camera::default().position);
            assert!((camera.position.length() - 2.0).abs() < 1e-9, "at the same distance from the pivot");
            assert_eq!(input.release(button), None);
        }
    }
}
