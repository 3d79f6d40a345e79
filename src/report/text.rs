//! Texts in both languages, and the forms they stand in.

use std::time::Duration;

use maud::{Markup, Render, html};

use crate::measure::output::{Entry, Table, Words};

/// One text in both languages; the page shows one of them.
pub fn both(english: impl Render, russian: impl Render) -> Markup {
    html! {
        span.en lang="en" { (english) }
        span.ru lang="ru" { (russian) }
    }
}

/// What there is in English only, such as a driver's words: shown whatever the language.
pub fn english(text: impl Render) -> Markup {
    html! { span lang="en" { (text) } }
}

/// As [`both`], or as they are where both are alike.
pub fn words(words: &Words) -> Markup {
    let Words { english, russian } = words;
    if english == russian {
        html! { (english) }
    } else {
        both(english, russian)
    }
}

pub fn yes_no(is_so: bool) -> Markup {
    words(&Words::yes_no(is_so))
}

/// What is not known, or not there.
pub fn dash() -> Markup {
    html! { "–" }
}

/// Minutes and seconds.
pub fn duration(time: Duration) -> Markup {
    let seconds = time.as_secs_f64();
    if seconds < 59.95 {
        return both(format!("{seconds:.1} s"), format!("{seconds:.1} с"));
    }
    let whole = seconds.round() as u64;
    let (minutes, seconds) = (whole / 60, whole % 60);
    both(format!("{minutes} min {seconds:02} s"), format!("{minutes} мин {seconds:02} с"))
}

/// A table in a box of its own that scrolls where it is too wide. The first column stands to the left.
pub fn table(head: &[Markup], rows: &[Vec<Markup>]) -> Markup {
    html! {
        div.scroll tabindex="0" {
            table {
                thead { tr { @for cell in head { th scope="col" { (cell) } } } }
                tbody {
                    @for row in rows {
                        tr {
                            @for (column, cell) in row.iter().enumerate() {
                                @if column == 0 { th scope="row" { (cell) } } @else { td { (cell) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// As [`table`].
pub fn table_of(Table { head, rows }: &Table) -> Markup {
    let cell = |entry: &Entry| match entry {
        Entry::Absent => dash(),
        Entry::Text(text) => words(text),
        Entry::Lacking(text) => html! { span.lacking { (words(text)) } },
    };
    let rows: Vec<Vec<Markup>> = rows.iter().map(|row| row.iter().map(cell).collect()).collect();
    table(&head.iter().map(words).collect::<Vec<_>>(), &rows)
}

/// Commands to be copied.
pub fn commands(lines: &[String]) -> Markup {
    html! { pre.scroll tabindex="0" { code { (lines.join("\n")) } } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_languages_are_told_apart_and_escaped() {
        let markup = both("a < b", "а < б").into_string();
        assert_eq!(
            markup,
            "<span class=\"en\" lang=\"en\">a &lt; b</span><span class=\"ru\" lang=\"ru\">а &lt; б</span>"
        );
    }

    #[test]
    fn durations_are_in_minutes_where_they_are_long() {
        let english = |seconds| {
            let markup = duration(Duration::from_secs_f64(seconds)).into_string();
            markup.split(['>', '<']).nth(2).unwrap().to_owned()
        };
        assert_eq!(english(0.04), "0.0 s");
        assert_eq!(english(59.9), "59.9 s");
        assert_eq!(english(59.97), "1 min 00 s");
        assert_eq!(english(605.2), "10 min 05 s");
    }
}
