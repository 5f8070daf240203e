//! Charts of the columns of a table.

use super::{Axis, Chart, Curve, Line, Look, Polar, Unit};
use crate::Table;
use crate::table::{Column, Quantity, TableError, Units};

/// The most letters of a title: more do not fit above a chart.
const LONGEST_TITLE: usize = 50;

impl Chart {
    /// Columns of a table over one of its columns, a curve for each: `Chart::of(&table, "theta2", ["phi_torque"])`.
    ///
    /// A curve is broken where a row has no number. Angles are written in degrees. [Marks](Table::marks) of the column x,
    /// such as events over `time`, are dashed lines with their names. A curve of one point is a dot.
    ///
    /// # Errors
    /// [`TableError::UnknownColumn`] with the nearest name, [`TableError::NoColumns`], and [`TableError::NoNumbers`] if no
    /// row has a number for both axes.
    pub fn of(table: &Table, x: &str, columns: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Self, TableError> {
        let x = table.find(x)?;
        let columns: Vec<&Column> =
            columns.into_iter().map(|name| table.find(name.as_ref())).collect::<Result<_, _>>()?;
        let Some(first) = columns.first() else { return Err(TableError::NoColumns) };
        let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
        let all_in_degrees = columns.iter().all(|column| is_angle(column));
        // The title names the curves: the axis has their unit.
        let of_first =
            unit(first).filter(|of_first| columns.iter().all(|column| unit(column).as_ref() == Some(of_first)));
        let is_one = of_first.is_some() || columns.iter().all(|column| unit(column).is_none());
        let up = match of_first {
            Some(unit) if !all_in_degrees => Axis::linear(format!("[{unit}]")),
            _ => Axis::linear("").unit(if all_in_degrees { Unit::Degrees } else { Unit::Number }),
        };
        let across = match is_angle(x) {
            true => Axis::linear(&*x.name).unit(Unit::Degrees),
            false => Axis::linear(with_unit(x)),
        };
        let mut chart = Self::new(title(&names, &x.name), across, up);
        for (colour, column) in columns.iter().enumerate() {
            let [across, up] = [numbers(x, is_angle(x)), numbers(column, all_in_degrees)];
            // Curves of several units have their own.
            let name = if is_one || all_in_degrees { column.name.clone() } else { with_unit(column) };
            let curve = curve(&name, across.zip(up));
            chart.curves.push(Curve { colour, ..curve });
        }
        if chart.curves.iter().all(|curve| curve.points.iter().all(Option::is_none)) {
            let columns = names.iter().chain([&x.name.as_str()]).map(|&name| name.to_owned()).collect();
            return Err(TableError::NoNumbers { columns });
        }
        chart.has_legend = columns.len() > 1;
        let marks = table.marks().iter().filter(|mark| mark.column == x.name);
        chart.lines = marks
            .map(|mark| Line {
                at: if x.is_in_degrees() { mark.at.to_radians() } else { mark.at },
                name: mark.name.clone(),
            })
            .collect();
        Ok(chart)
    }
}

impl Polar {
    /// The vectors of two columns of a table as a curve: `Polar::of(&table, "o_on_crank_x", "o_on_crank_y")`.
    ///
    /// The curve is broken where a row has no number; one point is a dot. [`Polar::and`] adds another.
    ///
    /// # Errors
    /// [`TableError::UnknownColumn`] with the nearest name, and [`TableError::NoNumbers`] if no row has both numbers.
    pub fn of(table: &Table, x: &str, y: &str) -> Result<Self, TableError> {
        let unit = table.find(x)?.unit.as_ref().map_or_else(String::new, |unit| format!("[{unit}]"));
        Self::new(name(x, y), unit).and(table, x, y)
    }

    /// Adds the vectors of two columns as a curve in the next colour.
    ///
    /// # Errors
    /// Those of [`Polar::of`].
    pub fn and(mut self, table: &Table, x: &str, y: &str) -> Result<Self, TableError> {
        let [across, up] = [table.find(x)?, table.find(y)?].map(|column| numbers(column, false));
        let curve = curve(&name(x, y), across.zip(up));
        if curve.points.iter().all(Option::is_none) {
            return Err(TableError::NoNumbers { columns: vec![x.to_owned(), y.to_owned()] });
        }
        self.curves.push(Curve { colour: self.curves.len(), ..curve });
        self.has_legend = self.curves.len() > 1;
        Ok(self)
    }
}

/// A curve through these points, a dot if there is only one.
fn curve(name: &str, points: impl Iterator<Item = (f64, f64)>) -> Curve {
    let points: Vec<Option<[f64; 2]>> =
        points.map(|(x, y)| (x.is_finite() && y.is_finite()).then_some([x, y])).collect();
    let look = if points.iter().flatten().count() == 1 { Look::Dots } else { Look::Line };
    Curve { points, ..Curve::new(name, look, []) }
}

/// True for an angle, whose axis has its own unit.
fn is_angle(column: &Column) -> bool {
    matches!(column.quantity, Quantity::Angle(0) | Quantity::Degrees(0))
}

/// The unit of a column, also of an angle that has none in its head.
fn unit(column: &Column) -> Option<String> {
    let of_angle = || matches!(column.quantity, Quantity::Angle(_)).then(|| column.quantity.unit(Some(Units::SI)));
    column.unit.clone().or_else(|| of_angle().flatten())
}

/// The name of a column with its unit.
fn with_unit(column: &Column) -> String {
    unit(column).map_or_else(|| column.name.clone(), |unit| format!("{} [{unit}]", column.name))
}

/// The numbers of a column; for an axis of angles in radians.
fn numbers(column: &Column, is_in_radians: bool) -> impl Iterator<Item = f64> {
    let is_turned = is_in_radians && column.is_in_degrees();
    column.values.iter().map(move |value| if is_turned { value.to_radians() } else { *value })
}

/// The curves, if they are few, and the axis.
fn title(names: &[&str], x: &str) -> String {
    let whole = format!("{} over {x}", names.join(", "));
    match names {
        [first, _, ..] if names.len() > 3 || whole.chars().count() > LONGEST_TITLE => format!("{first}, … over {x}"),
        _ => whole,
    }
}

/// The common part of the names of two components.
fn name(x: &str, y: &str) -> String {
    let common = x.chars().zip(y.chars()).take_while(|(x, y)| x == y).map(|(letter, _)| letter).collect::<String>();
    let common = common.trim_end_matches('_');
    if common.is_empty() { format!("{x}, {y}") } else { common.to_owned() }
}
