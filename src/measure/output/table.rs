//! Tables as data, and the forms that each of them is written in.

use serde::Serialize;
use serde_json::Value;

/// A text in both languages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Words {
    pub english: String,
    pub russian: String,
}

impl Words {
    pub fn both(english: impl Into<String>, russian: impl Into<String>) -> Self {
        Self { english: english.into(), russian: russian.into() }
    }

    pub fn yes_no(is_so: bool) -> Self {
        if is_so { Self::both("yes", "да") } else { Self::both("no", "нет") }
    }

    pub fn join(parts: &[Self], between: &str) -> Self {
        let joined = |of: fn(&Self) -> &str| parts.iter().map(of).collect::<Vec<_>>().join(between);
        Self::both(joined(|words| &words.english), joined(|words| &words.russian))
    }
}

/// What is the same in both languages, or there in one only.
impl<T: ToString> From<T> for Words {
    fn from(text: T) -> Self {
        Self::both(text.to_string(), text.to_string())
    }
}

/// A cell of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Entry {
    /// Not known, or not there.
    Absent,
    Text(Words),
    /// Less than there should be.
    Lacking(Words),
}

impl Entry {
    pub fn of(text: impl Into<Words>) -> Self {
        Self::Text(text.into())
    }

    pub fn maybe(text: Option<impl Into<Words>>) -> Self {
        text.map_or(Self::Absent, Self::of)
    }

    fn english<'a>(&'a self, absent: &'a str) -> &'a str {
        match self {
            Self::Absent => absent,
            Self::Text(words) | Self::Lacking(words) => &words.english,
        }
    }
}

/// Rows of as many cells as there are columns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// The columns' names, with units where they have any.
    pub head: Vec<Words>,
    pub rows: Vec<Vec<Entry>>,
}

impl Table {
    /// For programs: a row a record, which is a tuple of structures. A column is a key of one of them, or stands for
    /// what follows its `=`: the way there by keys and indices. A list is shown by its length.
    pub fn of_records(columns: &str, records: impl IntoIterator<Item = impl Serialize>) -> Self {
        let columns = || columns.split(',').map(|column| column.split_once('=').unwrap_or((column, column)));
        let entry = |record: &Value, way: &str| {
            let pointer = format!("/{way}");
            match record.as_array().into_iter().flatten().find_map(|part| part.pointer(&pointer)) {
                None | Some(Value::Null) => Entry::Absent,
                Some(Value::Array(list)) => Entry::of(list.len()),
                Some(Value::Number(number)) if number.is_f64() => Entry::maybe(number.as_f64()),
                Some(Value::String(text)) => Entry::of(text),
                Some(value) => Entry::of(value),
            }
        };
        let row = |record| {
            // invariant: structures, lists, numbers and texts: JSON has them all.
            let record = serde_json::to_value(record).expect("a record is JSON");
            columns().map(|(_, way)| entry(&record, way)).collect()
        };
        Self { head: columns().map(|(name, _)| name.into()).collect(), rows: records.into_iter().map(row).collect() }
    }

    /// For programs, in English: the names, and a line a row (RFC 4180). What is not known is empty.
    pub fn to_csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let head = self.head.iter().map(|name| name.english.as_str()).collect();
        let rows = self.rows.iter().map(|row| row.iter().map(|cell| cell.english("")).collect());
        for line in [head].into_iter().chain(rows) {
            let line: Vec<&str> = line;
            // invariant: lines are of one length, and memory takes them all.
            writer.write_record(line).expect("a row has a cell a column");
        }
        // invariant: as above, and all of it came from texts.
        String::from_utf8(writer.into_inner().expect("memory takes all")).expect("fields are texts")
    }

    /// For people, in English: Markdown whose columns also stand in line in a terminal, the first to the left, the
    /// others to the right.
    pub fn to_markdown(&self) -> String {
        let head = self.head.iter().map(|name| name.english.as_str()).collect();
        let rows = self.rows.iter().map(|row| row.iter().map(|cell| cell.english("–")).collect());
        let lines: Vec<Vec<&str>> = [head].into_iter().chain(rows).collect();
        let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0).max(2);
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let padded = |line: &Vec<&str>| {
            let cells = line.iter().zip(&widths).enumerate();
            let cells = cells.map(|(column, (cell, &width))| match column {
                0 => format!("| {cell:<width$} |"),
                _ => format!(" {cell:>width$} |"),
            });
            cells.collect::<String>()
        };
        let rule = |(column, &width): (usize, &usize)| match column {
            0 => format!("| {} |", "-".repeat(width)),
            _ => format!(" {}: |", "-".repeat(width - 1)),
        };
        let mut lines: Vec<String> = lines.iter().map(padded).collect();
        lines.insert(1, widths.iter().enumerate().map(rule).collect());
        lines.join("\n")
    }
}

/// Four digits.
pub fn figure(value: f64) -> String {
    let digits_before = value.abs().max(1e-6).log10().floor() as i32 + 1;
    format!("{value:.*}", (4 - digits_before).max(0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let rows = vec![
            vec![Entry::of("a \"b\", c"), Entry::maybe(None::<f64>)],
            vec![Entry::of(Words::both("two", "два")), Entry::Lacking(1.5.into())],
        ];
        Table { head: vec![Words::both("name", "имя"), "x".into()], rows }
    }

    #[test]
    fn programs_read_fields_in_quotes_where_they_must_be_and_nothing_for_what_is_absent() {
        assert_eq!(table().to_csv(), "name,x\n\"a \"\"b\"\", c\",\ntwo,1.5\n");
    }

    #[test]
    fn columns_stand_in_line() {
        let lines = ["| name     |   x |", "| -------- | --: |", "| a \"b\", c |   – |", "| two      | 1.5 |"];
        assert_eq!(table().to_markdown(), lines.join("\n"));
    }

    #[test]
    fn figures_have_four_digits() {
        for (value, text) in [(57.1419, "57.14"), (0.0123456, "0.01235"), (1.0, "1.000"), (123456.0, "123456")] {
            assert_eq!(figure(value), text);
        }
    }
}
