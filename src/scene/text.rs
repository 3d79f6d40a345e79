//! How numbers and foreign text are written in scene files and in one-line messages.

use glam::DVec3;

/// Longest piece of a file or a name that a message repeats, in characters.
pub(super) const LONGEST_QUOTE: usize = 40;

/// The shortest decimal text that reads back to the same bits, in the syntax that TOML and JSON share; whole numbers
/// lose their `.0`, but −0 keeps it: the integer `-0` has no sign.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:?}");
    match text.strip_suffix(".0") {
        Some(whole) if whole != "-0" => whole.to_owned(),
        _ => text,
    }
}

pub(super) fn vector(value: DVec3) -> String {
    format!("[{}, {}, {}]", number(value.x), number(value.y), number(value.z))
}

pub(super) fn points([start, end]: [DVec3; 2]) -> String {
    format!("[{}, {}]", vector(start), vector(end))
}

/// `text` on one line: control and invisible characters escaped, cut after about `longest` characters.
pub(super) fn one_line(text: &str, longest: usize) -> String {
    let mut line = String::new();
    let mut length = 0;
    for c in text.chars() {
        if length >= longest {
            line.push('…');
            break;
        }
        if matches!(c, '"' | '\'' | '\\') {
            line.push(c);
            length += 1;
        } else {
            let escaped = c.escape_debug();
            length += escaped.len();
            line.extend(escaped);
        }
    }
    line
}

/// `text` as a string literal of both TOML and JSON.
pub(super) fn quoted(text: &str) -> String {
    let mut literal = String::from('"');
    for c in text.chars() {
        match c {
            '"' => literal.push_str("\\\""),
            '\\' => literal.push_str("\\\\"),
            '\n' => literal.push_str("\\n"),
            '\t' => literal.push_str("\\t"),
            // TOML forbids DEL as it stands, JSON does not mind the escape.
            c if c.is_ascii_control() => literal.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => literal.push(c),
        }
    }
    literal.push('"');
    literal
}
