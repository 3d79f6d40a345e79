//! Screen-space reflections as a user asks for them.

use crate::place::Place;
use zerkalo::frame::Frame;
use zerkalo::gpu;

fn render<'a>(scene: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["render", scene, "-o", "x.exr", "--size", "64x28", "--algorithm", "ssr"][..], more].concat()
}

#[test]
fn what_is_left_out_is_said_by_render_and_plan() {
    let place = Place::new();
    let told = place.run_well(&render("showcase", &[]));
    assert!(told.lines().count() == 2 && told.contains("refracted rays are left out"), "{told}");
    let report = place.json(&render("showcase", &["--json"]));
    assert_eq!((&report["kernel"], &report["precision"]), (&"ssr".into(), &"f32".into()));
    assert!(report["note"].as_str().unwrap().contains("refracted rays are left out"));
    let plan = place.run_well(&["plan", "glass", "--algorithm", "ssr", "--no-device"]);
    assert!(plan.contains("refracted rays are left out"), "{plan}");
    let plan = place.run_well(&["plan", "glass", "--no-device"]);
    assert!(!plan.contains("refracted rays are left out"), "{plan}");
}

#[test]
fn reasons_are_a_picture_of_their_own() {
    let place = Place::new();
    place.run_well(&render("showcase", &["--ssr-reasons", "why.png"]));
    let [picture, reasons] = ["x.exr", "why.png"].map(|name| Frame::load(&place.path(name)).unwrap());
    assert_eq!((reasons.width(), reasons.height()), (picture.width(), picture.height()));
    assert_ne!(reasons.pixels(), picture.pixels());
    place.run_well(&render("showcase", &["--ssr-shadows", "none"]));
    assert_ne!(Frame::load(&place.path("x.exr")).unwrap().pixels(), picture.pixels());
}

#[test]
fn what_it_cannot_do_is_refused_in_a_line() {
    let place = Place::new();
    for (more, part) in [
        (["--error", "1/510"], "ssr"),
        (["--samples", "2"], "ssr"),
        (["--scale", "0.5"], "ssr"),
        (["--precision", "f64"], "ssr"),
        (["--ssr-reasons", "why.gif"], "why.gif"),
    ] {
        place.assert_refused(&render("showcase", &more), 2, &[part]);
    }
    for more in [["--ssr-shadows", "none"], ["--ssr-reasons", "why.png"]] {
        let arguments = [&["render", "showcase", "-o", "x.png"][..], &more].concat();
        place.assert_refused(&arguments, 2, &["ssr", "whitted"]);
    }
    let device = gpu::devices().unwrap().swap_remove(gpu::choose(&gpu::devices().unwrap(), None).unwrap());
    if device.max_storage_bytes < 16384 * 16384 * 16 {
        let arguments = ["render", "corridor", "-o", "x.png", "--size", "16384x16384", "--algorithm", "ssr"];
        place.assert_refused(&arguments, 2, &["ssr", "16384x16384", "whole"]);
    }
}
