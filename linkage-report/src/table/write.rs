//! Tables as text: CSV and JSON.

use std::fmt::Write;

use super::Table;

/// Numbers outside of these are written with an exponent.
const PLAIN: std::ops::Range<f64> = 1e-5..1e16;

impl Table {
    /// The table as comma-separated values by RFC 4180, with lines that end in a line feed: the heads, then the rows. A
    /// number that does not exist is an empty cell.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let line = |cells: Vec<String>| cells.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",") + "\n";
        self.lines().map(line).collect()
    }

    /// The table as lines of cells: the heads, then the rows. A number that does not exist is an empty cell.
    #[must_use]
    pub fn cells(&self) -> Vec<Vec<String>> {
        self.lines().collect()
    }

    fn lines(&self) -> impl Iterator<Item = Vec<String>> {
        let heads = self.columns.iter().map(super::column::Column::head).collect();
        let cell = |column: &super::column::Column, row: usize| self.number(column.values[row]).unwrap_or_default();
        let rows = (0..self.len()).map(move |row| self.columns.iter().map(|column| cell(column, row)).collect());
        std::iter::once(heads).chain(rows)
    }

    /// The table as JSON. A number that does not exist is null, and `missing` has the reason:
    ///
    /// ```text
    /// {
    ///     "columns": [{"name": "theta2", "unit": "deg", "values": [0, 1, 2]}, …],
    ///     "missing": [{"row": 2, "cause": "FourBar: …"}],
    ///     "marks": [{"column": "theta2", "at": 1.5, "name": "dead point"}]
    /// }
    /// ```
    #[must_use]
    pub fn to_json(&self) -> String {
        let number = |value: f64| self.number(value).unwrap_or_else(|| "null".to_owned());
        let columns = self.columns.iter().map(|column| {
            let unit = column.unit.as_deref().map_or_else(|| "null".to_owned(), string);
            let values: Vec<String> = column.values.iter().map(|value| number(*value)).collect();
            format!("{{\"name\":{},\"unit\":{unit},\"values\":[{}]}}", string(&column.name), values.join(","))
        });
        let missing = self
            .missing
            .iter()
            .map(|missing| format!("{{\"row\":{},\"cause\":{}}}", missing.row, string(&missing.cause.to_string())));
        let marks = self.marks.iter().map(|mark| {
            let (column, at, name) = (string(&mark.column), number(mark.at), string(&mark.name));
            format!("{{\"column\":{column},\"at\":{at},\"name\":{name}}}")
        });
        let list = |lines: Vec<String>| lines.join(",\n");
        format!(
            "{{\"columns\":[\n{}\n],\"missing\":[{}],\"marks\":[{}]}}\n",
            list(columns.collect()),
            list(missing.collect()),
            list(marks.collect())
        )
    }

    /// A number with the digits of the table; none if it is not finite.
    fn number(&self, value: f64) -> Option<String> {
        let rounded = match self.digits {
            // The text of a finite number is one.
            Some(digits) => format!("{value:.*e}", digits - 1).parse().unwrap_or(value),
            None => value,
        };
        let is_plain = rounded == 0.0 || PLAIN.contains(&rounded.abs());
        // Rounded, -0 is 0.
        let rounded = if self.digits.is_some() { rounded + 0.0 } else { rounded };
        value.is_finite().then(|| if is_plain { format!("{rounded}") } else { format!("{rounded:e}") })
    }
}

/// A cell of CSV.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.to_owned() }
}

/// A string of JSON, by RFC 8259.
fn string(text: &str) -> String {
    let mut written = String::from("\"");
    for letter in text.chars() {
        // Writing to a string does not fail.
        _ = match letter {
            '"' | '\\' => write!(written, "\\{letter}"),
            control if control < ' ' => write!(written, "\\u{:04x}", u32::from(control)),
            plain => write!(written, "{plain}"),
        };
    }
    written.push('"');
    written
}
