//! The errors of tables, and of charts of them.

use std::fmt;

/// A table has not what is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum TableError {
    /// There is no column of this name.
    UnknownColumn {
        /// The name.
        name: String,
        /// The column with the nearest name; none if the table has no columns.
        nearest: Option<String>,
    },
    /// A column of this name exists.
    SameName {
        /// The name.
        name: String,
    },
    /// A new column has not a number for each row.
    Length {
        /// The name of the new column.
        name: String,
        /// Its numbers.
        numbers: usize,
        /// The rows of the table.
        rows: usize,
    },
    /// Degrees are asked of a length, a time or a force.
    NotAnAngle {
        /// The name of the column.
        name: String,
    },
    /// A chart is asked for without a column to draw.
    NoColumns,
    /// No row has a number in each of these columns, so that a chart has nothing to draw.
    NoNumbers {
        /// The names of the columns.
        columns: Vec<String>,
    },
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownColumn { name, nearest: Some(nearest) } => {
                write!(f, "the table has no column `{name}`; the nearest name is `{nearest}`")
            }
            Self::UnknownColumn { name, nearest: None } => {
                write!(f, "the table has no column `{name}`: its `names` lists the columns")
            }
            Self::SameName { name } => write!(f, "the table has a column `{name}`: give the new one another name"),
            Self::Length { name, numbers, rows } => {
                write!(f, "the column `{name}` has {numbers} numbers for {rows} rows: give one for each row")
            }
            Self::NotAnAngle { name } => write!(f, "the column `{name}` is no angle: degrees are for angles"),
            Self::NoColumns => f.write_str("the chart has no column to draw: name one"),
            Self::NoNumbers { columns } => {
                write!(f, "no row has numbers in `{}`: there is nothing to draw", columns.join("`, `"))
            }
        }
    }
}

impl std::error::Error for TableError {}

impl TableError {
    pub(super) fn unknown(name: &str, names: &[&str]) -> Self {
        // A capital letter is a smaller slip than another letter.
        let by_case = |other: &str| (edits(&name.to_lowercase(), &other.to_lowercase()), edits(name, other));
        // Half the letters may differ.
        let near = names.iter().filter(|other| by_case(other).0 <= name.chars().count() / 2);
        let nearest = near.min_by_key(|other| by_case(other)).map(|&nearest| nearest.to_owned());
        Self::UnknownColumn { name: name.to_owned(), nearest }
    }
}

/// The number of letters to insert, delete or replace in one name to get the other: Levenshtein's distance.
fn edits(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().collect();
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (place, letter) in one.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], place + 1);
        for (column, &of_other) in other.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != of_other);
            diagonal = row[column + 1];
            row[column + 1] = replaced.min(diagonal + 1).min(row[column] + 1);
        }
    }
    row[other.len()]
}

#[cfg(test)]
mod tests {
    use super::edits;

    #[test]
    fn letters_to_edit() {
        for (one, other, expected) in [("", "", 0), ("abc", "", 3), ("kitten", "sitting", 3), ("C_x", "c_x", 1)] {
            assert_eq!([edits(one, other), edits(other, one)], [expected; 2], "{one} {other}");
        }
    }
}
