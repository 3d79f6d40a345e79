//! The page of `zerkalo report` as a reader meets it: in a browser, on a telephone and on a desk, in both languages;
//! and the command, which a user may stop.

mod browser;
mod example;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::place::{Run, interrupted, wait_until};
use browser::Browser;
use serde_json::Value;

/// Pixels: a telephone's width and a desk's.
const WIDTHS: [u32; 2] = [400, 1600];

/// What has no place in the page: scripts, and what is elsewhere.
const FOREIGN: &str = "document.querySelectorAll('script, [src^=http], [href^=http]').length";

/// Of the smallest letters that are shown, charts' too, in pixels.
const SMALLEST_LETTERS: &str = "Math.min(
    parseFloat(getComputedStyle(document.body).fontSize),
    ...[...document.querySelectorAll('td, th, figcaption, code')].filter(e => e.getClientRects().length)
        .map(e => parseFloat(getComputedStyle(e).fontSize)),
    ...[...document.querySelectorAll('svg text')].map(e => parseFloat(e.getAttribute('font-size'))
        * Math.hypot(e.getScreenCTM().a, e.getScreenCTM().b)))";

/// What stands out of the page's width, unless it is in a box that scrolls.
const TOO_WIDE: &str = "[...document.querySelectorAll('body *')].filter(e => !e.closest('.scroll')
    && e.getBoundingClientRect().right > document.documentElement.clientWidth + 0.5).map(e => e.outerHTML.slice(0, 99))";

fn shown(browser: &mut Browser, class: &str) -> u64 {
    let count = format!("[...document.querySelectorAll('.{class}')].filter(e => e.getClientRects().length).length");
    browser.evaluate(&count).as_u64().unwrap()
}

#[test]
fn the_page_is_read_without_a_network_at_every_width_in_both_languages() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.html");
    fs::write(&path, example::report().to_html().unwrap()).unwrap();
    let url = format!("file://{}", path.display());
    let mut browser = Browser::open();
    browser.resize(WIDTHS[0], 900);
    browser.visit(&url);
    browser.evaluate("document.querySelectorAll('details').forEach(details => details.open = true)");
    for width in WIDTHS {
        browser.resize(width, 900);
        for (language, other) in [("en", "ru"), ("ru", "en")] {
            browser.evaluate(&format!("document.getElementById('language-{language}').click()"));
            assert!(shown(&mut browser, language) > 50, "{language} at {width}");
            assert_eq!(shown(&mut browser, other), 0, "{other} where {language} is chosen");
            assert_eq!(browser.evaluate("innerWidth"), width);
            let page_width = browser.evaluate("document.documentElement.scrollWidth").as_u64().unwrap();
            assert!(page_width <= width.into(), "{page_width} at {width}, {language}: {}", browser.evaluate(TOO_WIDE));
            assert_eq!(browser.evaluate(TOO_WIDE), Value::Array(Vec::new()), "at {width}, {language}");
            let letters = browser.evaluate(SMALLEST_LETTERS).as_f64().unwrap();
            assert!(letters >= 9.0, "letters of {letters} px at {width}");
        }
    }
    // Nothing is missing: pictures are drawn, links lead somewhere, charts have their lines.
    let broken = "[...document.images].filter(image => !image.complete || image.naturalWidth == 0).length";
    assert_eq!(browser.evaluate(broken), 0);
    assert!(browser.evaluate("document.images.length").as_u64().unwrap() >= 6);
    assert_eq!(browser.evaluate("document.querySelectorAll('.chart > svg').length"), 3);
    let lost = "[...document.querySelectorAll('nav a')].filter(a => !document.querySelector(a.hash)).length";
    assert_eq!(browser.evaluate(lost), 0);
    assert_eq!(browser.evaluate(FOREIGN), 0, "a device's name became a part of the page");
    assert_eq!(browser.evaluate("document.title"), format!("zerkalo: {}", example::DEVICE));

    let outside = browser.events_of("Network.requestWillBeSent").map(|event| event["request"]["url"].as_str().unwrap());
    let outside: Vec<_> = outside.filter(|asked| !asked.starts_with("data:") && *asked != url).collect();
    assert!(outside.is_empty(), "{outside:?}");
    for method in ["Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"] {
        assert_eq!(browser.events_of(method).next(), None, "{method}");
    }
}

#[test]
fn what_is_not_whole_is_said_to_be_so() {
    let whole = example::report();
    let marks = |report: &zerkalo::report::Report| report.to_html().unwrap().matches("class=\"partial\"").count();
    assert!(whole.is_complete());
    assert_eq!(marks(&whole), 0);
    for ending in [
        zerkalo::report::Ending::Stopped,
        zerkalo::report::Ending::NotBegun,
        zerkalo::report::Ending::Failed("the device is <gone>".to_owned()),
    ] {
        let mut report = whole.clone();
        report.fps.ending = ending;
        report.fps.content.cells.clear();
        report.trade.content.scenes.clear();
        assert!(!report.is_complete());
        assert_eq!(marks(&report), 2, "in the head and in the section");
        assert!(!report.to_html().unwrap().contains("<gone>"));
    }
}

/// The command's exit code and complaint.
fn report(arguments: &[&str], folder: &Path) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_zerkalo"))
        .args([&["report"], arguments].concat())
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_page_that_cannot_be_written_is_refused_before_anything_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    fs::create_dir_all(folder.path().join("taken/report.html")).unwrap();
    for (output, part) in [("file", "could not create folder \"file\""), ("taken", "exists and is not a file")] {
        let (code, complaint) = report(&["--quick", "-o", output], folder.path());
        assert_eq!((code, complaint.lines().count()), (Some(1), 1), "{complaint}");
        assert!(complaint.contains(part), "{complaint}");
    }
    let (code, complaint) = report(&["--quick"], folder.path());
    assert!(code == Some(2) && complaint.contains("--output"), "{complaint}");
}

#[test]
fn ctrl_c_leaves_a_page_of_what_was_measured() {
    let folder = tempfile::tempdir().unwrap();
    let program = Command::new(env!("CARGO_BIN_EXE_zerkalo"))
        .args(["report", "--quick", "-o", "out"])
        .current_dir(&folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let page = folder.path().join("out/report.html");
    // The first section is written when it is done.
    wait_until("a section is measured", || page.exists());
    let Run { code, stderr: complaint, .. } = interrupted(program);
    assert_eq!(code, Some(130), "{complaint}");
    assert!(complaint.contains("stopped") && complaint.contains("out/report.html"), "{complaint}");
    let names: Vec<_> =
        fs::read_dir(folder.path().join("out")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["report.html"]);
    let text = fs::read_to_string(page).unwrap();
    assert!(text.starts_with("<!DOCTYPE html>") && text.ends_with("</html>"));
    assert!(text.contains("This report is partial") && text.contains("not measured"), "{text}");
    assert!(text.contains("zerkalo fps --size 405x175 --counts 10,50,100 --seconds 0.25"), "{text}");
}
