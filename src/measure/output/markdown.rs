//! Tables whose columns also stand in line in a terminal.

/// Rows of a Markdown table, the first the header, padded to columns: the first to the left, the others to the right.
pub fn in_line(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| Some(row.get(column)?.chars().count())).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0).max(2)).collect();
    let line = |cells: Vec<String>| format!("| {} |", cells.join(" | "));
    let padded = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate();
        line(
            cells
                .map(|(c, (cell, &width))| if c == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") })
                .collect(),
        )
    };
    let rule = |(column, &width): (usize, &usize)| {
        if column == 0 { "-".repeat(width) } else { "-".repeat(width - 1) + ":" }
    };
    let mut lines: Vec<String> = rows.iter().map(padded).collect();
    lines.insert(1, line(widths.iter().enumerate().map(rule).collect()));
    lines
}

/// Four digits.
pub fn figure(value: f64) -> String {
    let digits_before = value.abs().max(1e-6).log10().floor() as i32 + 1;
    format!("{value:.*}", (4 - digits_before).max(0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_four_digits() {
        for (value, text) in [(57.1419, "57.14"), (0.0123456, "0.01235"), (1.0, "1.000"), (123456.0, "123456")] {
            assert_eq!(figure(value), text);
        }
    }
}
