//! The motion of a mechanism as columns of numbers, and as CSV.

use std::f64::consts::TAU;
use std::fmt::Write;

use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::range_of_motion::{Driven, RangeOfMotion, RangeOptions};
use linkage_runtime::{Assembly, Kinematic, Mechanism, PathError};

/// Columns of numbers with names, one row for each position.
///
/// ```
/// linkage::linkage! {
///     pub mechanism FourBar {
///         param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
///         input theta2;
///         unknown theta3, theta4;
///         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
///         point C = l2@theta2 + l3@theta3;
///     }
/// }
/// use linkage::Table;
///
/// // A turn in 360 steps, at 10 rad/s.
/// let table = Table::turn(&FourBar::default(), FourBarBranch::new(linkage::Elbow::Left), 360, 10.0)?;
/// assert!(table.to_csv().starts_with("theta2,"));
/// let height = table.column("C_y").unwrap();
/// assert!(height.iter().all(|&y| y > 0.0));
/// # Ok::<(), linkage::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Table {
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    rejected: Vec<Rejected>,
}

/// An input without a row.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Rejected {
    /// The input.
    pub input: f64,
    /// Why there is no row.
    pub error: PathError,
}

impl Table {
    /// One motion over a turn of the input, in equal steps from 0, at a constant input rate. It passes change points
    /// smoothly. Each row is a position of the motion that begins on this branch at the first input that has one; inputs
    /// that this motion does not reach have no row. See [`Table::over`].
    ///
    /// # Errors
    /// [`PathError::Position`] if no input has a position on the branch, and those of [`RangeOfMotion::of`].
    pub fn turn<M>(mechanism: &M, branch: M::Branch, steps: u32, rate: f64) -> Result<Self, PathError>
    where
        M: Driven<Scalar = f64, Of: Assembly>,
    {
        let inputs: Vec<f64> = (0..steps).map(|step| TAU * f64::from(step) / f64::from(steps)).collect();
        Self::at(mechanism, branch, &inputs, rate)
    }

    /// One motion at these inputs; see [`Table::turn`].
    ///
    /// # Errors
    /// Those of [`Table::turn`].
    pub fn at<M>(mechanism: &M, branch: M::Branch, inputs: &[f64], rate: f64) -> Result<Self, PathError>
    where
        M: Driven<Scalar = f64, Of: Assembly>,
    {
        let range =
            RangeOfMotion::on_branch(mechanism, branch, inputs.iter().copied(), RangeOptions::through_change_points())?;
        Ok(Self::over(&range, inputs.iter().copied(), rate))
    }

    /// One motion at these inputs, in any order, at a constant input rate: the input, then of each unknown the value, rate
    /// and acceleration, of each point x, y, their rates and their accelerations, and of each output the value, rate and
    /// acceleration. Inputs that the motion does not reach, and ends at which a rate does not exist, have no row.
    #[must_use]
    pub fn over<M>(range: &RangeOfMotion<'_, M>, inputs: impl IntoIterator<Item = f64>, rate: f64) -> Self
    where
        M: Driven<Scalar = f64>,
    {
        let mut table = Self::new(names::<M>());
        for input in inputs {
            match range.motion(input, rate, 0.0) {
                Ok(motion) => table.push(&row::<M>(input, &motion)),
                Err(error) => table.rejected.push(Rejected { input, error }),
            }
        }
        table
    }

    /// A table without rows.
    pub fn new(names: impl IntoIterator<Item = impl Into<String>>) -> Self {
        let names: Vec<String> = names.into_iter().map(Into::into).collect();
        Self { columns: vec![Vec::new(); names.len()], names, rejected: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// If it does not have a number for each name.
    pub fn push(&mut self, row: &[f64]) {
        assert_eq!(row.len(), self.names.len(), "a number for each name");
        for (column, number) in self.columns.iter_mut().zip(row) {
            column.push(*number);
        }
    }

    /// The names of the columns.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The numbers of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let place = self.names.iter().position(|other| *other == name)?;
        self.columns.get(place).map(Vec::as_slice)
    }

    /// The inputs that have no row, each with the reason.
    #[must_use]
    pub fn rejected(&self) -> &[Rejected] {
        &self.rejected
    }

    /// The table as comma-separated values; each number reads back as the same double.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = self.names.join(",");
        text.push('\n');
        for row in 0..self.columns.first().map_or(0, Vec::len) {
            for (place, column) in self.columns.iter().enumerate() {
                let comma = if place == 0 { "" } else { "," };
                // Writing to a string does not fail.
                _ = write!(text, "{comma}{}", column[row]);
            }
            text.push('\n');
        }
        text
    }
}

/// The names of the columns of a motion.
fn names<M: Driven>() -> Vec<String> {
    let moving = |name: &str| ["", "_rate", "_acceleration"].map(|end| format!("{name}{end}"));
    let points = M::Of::POINTS.iter().flat_map(|point| {
        ["", "_velocity", "_acceleration"]
            .into_iter()
            .flat_map(move |vector| ["x", "y"].map(|axis| format!("{point}{vector}_{axis}")))
    });
    let inputs = if is_the_input::<M>() { &[] } else { M::Of::INPUTS };
    let coordinates = inputs.iter().chain(M::UNKNOWNS).flat_map(|name| moving(name));
    let outputs = M::Of::OUTPUTS.iter().flat_map(|output| moving(output));
    M::INPUTS.iter().map(|&name| name.to_owned()).chain(coordinates).chain(points).chain(outputs).collect()
}

/// True if the parameter is the input of the mechanism itself.
fn is_the_input<M: Driven>() -> bool {
    M::INPUTS == M::Of::INPUTS
}

/// The numbers of a motion in the order of their names.
fn row<M: Driven<Scalar = f64>>(parameter: f64, motion: &MotionOf<M::Of>) -> Vec<f64> {
    let (of_unknowns, of_inputs) = M::Of::parts(&motion.position);
    let (unknown_rates, input_rates) = M::Of::rate_parts(&motion.rates);
    let (unknown_accelerations, input_accelerations) = M::Of::acceleration_parts(&motion.accelerations);
    let mut row = vec![parameter];
    if !is_the_input::<M>() {
        let moving = of_inputs.iter().zip(&input_rates).zip(&input_accelerations);
        row.extend(moving.flat_map(|((value, rate), acceleration)| [value, rate, acceleration]));
    }
    let moving = of_unknowns.iter().zip(&unknown_rates).zip(&unknown_accelerations);
    row.extend(moving.flat_map(|((value, rate), acceleration)| [value, rate, acceleration]));
    for point in M::Of::each_point(motion.points) {
        let vectors = [point.position.coords, point.velocity, point.acceleration];
        row.extend(vectors.iter().flat_map(|vector| [vector.x, vector.y]));
    }
    for output in M::Of::each_output(motion.outputs) {
        row.extend([output.value, output.rate, output.acceleration]);
    }
    row
}
