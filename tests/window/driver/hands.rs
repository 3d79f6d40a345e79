//! Mouse and keyboard.

use std::process::Child;
use std::thread;
use std::time::Duration;

use zerkalo::frame::Frame;

use super::observation::{Observation, Widget};
use super::window::Window;

/// A widget that is not moving is at the same place after so long: three frames at 60 Hz.
const STILL: Duration = Duration::from_millis(50);

/// The panel glides to where it is scrolled to; on a busy machine there may be long pauses on the way.
const SCROLLING: Duration = Duration::from_millis(400);

/// From the panel's upper and lower edge to the middle of a widget that can be clicked, pixels.
const MARGIN: f64 = 6.0;

impl Window<'_> {
    // ---- Bare hands.

    /// Pixels of the window.
    #[track_caller]
    pub fn move_mouse(&self, [x, y]: [f64; 2]) {
        let (x, y) = (x.round().to_string(), y.round().to_string());
        self.desk.display.xdotool(&["mousemove", "--window", &self.id, &x, &y]);
    }

    /// 1 is the left one, 2 the middle one, 3 the right one.
    #[track_caller]
    pub fn press(&self, button: u32) {
        self.desk.display.xdotool(&["mousedown", &button.to_string()]);
    }

    #[track_caller]
    pub fn release(&self, button: u32) {
        self.desk.display.xdotool(&["mouseup", &button.to_string()]);
    }

    #[track_caller]
    pub fn click_at(&self, place: [f64; 2]) {
        self.move_mouse(place);
        self.desk.display.xdotool(&["click", "1"]);
    }

    /// Where the mouse is.
    #[track_caller]
    pub fn click_again(&self) {
        self.desk.display.xdotool(&["click", "1"]);
    }

    /// Lets a button go and does not wait for xdotool to end, so that no more than its start is in a time taken.
    #[track_caller]
    pub fn release_at_once(&self, button: u32) -> Child {
        self.desk.display.command("xdotool").args(["mouseup", &button.to_string()]).spawn().unwrap()
    }

    /// Presses a button at a place, moves the mouse by some pixels and lets go.
    #[track_caller]
    pub fn drag(&self, button: u32, from: [f64; 2], by: [f64; 2]) {
        self.move_mouse(from);
        self.press(button);
        self.move_mouse([from[0] + by[0], from[1] + by[1]]);
        self.release(button);
    }

    /// Clicks of the wheel; towards the user is down. winit counts a synthetic click twice: as it goes down and as it
    /// comes up.
    #[track_caller]
    pub fn wheel(&self, notches_down: i32) {
        let button = if notches_down > 0 { "5" } else { "4" };
        let count = notches_down.unsigned_abs().to_string();
        self.desk.display.xdotool(&["click", "--repeat", &count, "--delay", "1", button]);
    }

    /// Such as `ctrl+z`.
    #[track_caller]
    pub fn key(&self, key: &str) {
        self.desk.display.xdotool(&["key", key]);
    }

    /// One after the other, `times` times over.
    #[track_caller]
    pub fn keys(&self, keys: &[&str], times: usize) {
        let keys = keys.repeat(times);
        self.desk.display.xdotool(&[&["key", "--delay", "20"], &keys[..]].concat());
    }

    #[track_caller]
    pub fn key_down(&self, key: &str) {
        self.desk.display.xdotool(&["keydown", key]);
    }

    #[track_caller]
    pub fn key_up(&self, key: &str) {
        self.desk.display.xdotool(&["keyup", key]);
    }

    // ---- Widgets.

    /// Once it is there and at rest, in sight and not dead; scrolls the panel to it.
    #[track_caller]
    fn reach(&mut self, name: &str) -> Widget {
        let there = format!("{name:?} can be used");
        for _ in 0..100 {
            self.wait_until(&there, |now| now.find(name).is_some_and(|widget| !widget.is_disabled));
            thread::sleep(STILL);
            let Some(widget) = self.now().find(name).cloned() else { continue };
            thread::sleep(STILL);
            if self.now().find(name) == Some(&widget) && self.is_in_sight(&widget) {
                return widget;
            }
        }
        panic!("{name:?} does not come to rest in sight; last: {}", self.now().in_short());
    }

    /// If it is not, the panel is scrolled towards it.
    #[track_caller]
    fn is_in_sight(&mut self, widget: &Widget) -> bool {
        const PIXELS_PER_NOTCH: f64 = 80.0;
        let now = self.now().clone();
        let ([x, y], [left, top]) = (widget.middle(), now.in_picture(1.0, 0.0));
        let bottom = top + f64::from(now.picture_size[1]);
        let is_in_sight = x < left || now.dialog.is_some() || (top + MARGIN..bottom - MARGIN).contains(&y);
        if !is_in_sight {
            let middle = f64::midpoint(top, bottom);
            // The panel's edge, where there is nothing else that a wheel could turn.
            self.move_mouse([left + 12.0, middle]);
            let notches = (y - middle) / PIXELS_PER_NOTCH;
            self.wheel(notches.clamp(-20.0, 20.0).round() as i32);
            thread::sleep(SCROLLING);
        }
        is_in_sight
    }

    #[track_caller]
    pub fn click(&mut self, name: &str) {
        let place = self.reach(name).middle();
        self.click_at(place);
    }

    /// From the menu bar down; menus within menus open by themselves.
    #[track_caller]
    pub fn menu(&mut self, path: &[&str]) {
        let (last, on_the_way) = path.split_last().expect("an item");
        for (depth, name) in on_the_way.iter().enumerate() {
            if depth == 0 {
                self.click(name);
            } else {
                let place = self.reach(name).middle();
                self.move_mouse(place);
            }
        }
        self.click(last);
    }

    /// Puts a number into a field.
    #[track_caller]
    pub fn fill(&mut self, name: &str, number: f64) {
        self.type_into(name, &number.to_string());
    }

    /// Puts a text into a field and presses Enter.
    #[track_caller]
    pub fn type_into(&mut self, name: &str, text: &str) {
        const TRIES: u32 = 5;
        // A field does not tell that it is ready for keys; those that come too soon are lost.
        let is_typed = (0..TRIES).any(|_| {
            self.click(name);
            thread::sleep(STILL);
            self.key("ctrl+a");
            self.desk.display.xdotool(&["type", "--delay", "10", "--", text]);
            self.wait_for(STILL * 20, |now| now.find(name).is_some_and(|field| field.value == text)).is_some()
        });
        assert!(is_typed, "{name:?} does not become {text:?}; last: {}", self.now().in_short());
        self.key("Return");
    }

    // ---- The window.

    /// Of the window, pixels; waits until it has that size and shows all of the picture.
    #[track_caller]
    pub fn resize(&mut self, [width, height]: [u32; 2]) -> Observation {
        // While picture follows picture, none is ever the last.
        let before = self.last().pictures_traced + 1;
        self.desk.display.xdotool(&["windowsize", &self.id, &width.to_string(), &height.to_string()]);
        self.wait_until("the new size", |now| {
            now.window == [width, height] && (now.is_whole || now.pictures_traced > before)
        })
    }

    /// The picture by the program's own F12, through a file of that name.
    #[track_caller]
    pub fn screenshot(&mut self, file: &str) -> Frame {
        self.key("F12");
        let name = self.words().dialogs.file_name;
        self.type_into(name, file);
        self.wait_until("the dialog closes", |now| now.dialog.is_none());
        self.settle();
        Frame::load(&self.desk.path(file)).unwrap()
    }

    /// Saves the scene by Ctrl-Shift-S.
    #[track_caller]
    pub fn save_as(&mut self, file: &str) {
        self.key("ctrl+shift+s");
        let name = self.words().dialogs.file_name;
        self.type_into(name, file);
        let is_saved = |now: &Observation| {
            now.dialog.is_none()
                && !now.has_unsaved_changes
                && now.file.as_ref().is_some_and(|path| path.ends_with(file))
        };
        self.wait_until("the scene is saved", is_saved);
    }
}
