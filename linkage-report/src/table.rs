//! The motion of a mechanism as columns of numbers, and as CSV.

use std::f64::consts::TAU;
use std::fmt::Write;

use linkage_runtime::lanes::{Batch, Lanes, Values};
use linkage_runtime::{Dim, InputError};

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
///         derive lanes;
///     }
/// }
/// use linkage::Table;
///
/// // A turn in 360 steps, at 10 rad/s.
/// let table = Table::turn(&FourBar::default(), FourBarBranch::new(linkage::Elbow::Left), 360, 10.0)?;
/// assert!(table.to_csv().starts_with("theta2,"));
/// let height = table.column("c_y").unwrap();
/// assert!(height.iter().all(|&y| y > 0.0));
/// # Ok::<(), linkage::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Table {
    names: Vec<&'static str>,
    columns: Vec<Vec<f64>>,
    rejected: usize,
}

impl Table {
    /// A turn of the input of a mechanism with `derive lanes;`, in equal steps from 0, at a constant input rate: the
    /// input, then all coordinates, rates, accelerations, points and outputs. Inputs without a position, rates and
    /// accelerations have no row; a point or an output that does not exist is NaN in its own column.
    ///
    /// # Errors
    /// [`InputError::ColumnLength`] if the mechanism has several inputs, or groups without closed form.
    pub fn turn<M: Lanes<Scalar = f64>>(
        design: &M,
        branch: M::Branch,
        steps: u32,
        rate: f64,
    ) -> Result<Self, InputError> {
        let inputs: Vec<f64> = (0..steps).map(|step| TAU * f64::from(step) / f64::from(steps)).collect();
        Self::at(design, branch, &inputs, rate)
    }

    /// Positions at these inputs of a mechanism with `derive lanes;`; see [`Table::turn`].
    ///
    /// # Errors
    /// Those of [`Table::turn`].
    pub fn at<M: Lanes<Scalar = f64>>(
        design: &M,
        branch: M::Branch,
        inputs: &[f64],
        rate: f64,
    ) -> Result<Self, InputError> {
        if M::START != 1 {
            let (column, expected) = ("inputs", M::START);
            return Err(InputError::ColumnLength { mechanism: M::NAME, column, length: 1, expected });
        }
        let mut given = <M::Given as Dim>::array(|_| 0.0);
        design.write_parameters(&mut given);
        let given = <M::Given as Dim>::array(|place| match place.checked_sub(M::PARAMETERS) {
            None => Values::Same(given.as_ref()[place]),
            Some(0) => Values::Each(inputs),
            Some(1) => Values::Same(rate),
            Some(_) => Values::Same(0.0),
        });
        let mut columns = vec![vec![0.0; inputs.len()]; M::FOUND.len()];
        let mut accepted = vec![false; inputs.len()];
        let mut found: Vec<Option<&mut [f64]>> = columns.iter_mut().map(|column| Some(column.as_mut_slice())).collect();
        let rejected = Batch::<M>::new(given, branch)?.run(&mut found, &mut accepted)?;
        columns.insert(0, inputs.to_vec());
        for column in &mut columns {
            let mut is_accepted = accepted.iter().copied();
            column.retain(|_| is_accepted.next().unwrap_or_default());
        }
        let names = M::GIVEN.iter().skip(M::PARAMETERS).take(1).chain(M::FOUND).copied().collect();
        Ok(Self { names, columns, rejected })
    }

    /// The names of the columns.
    #[must_use]
    pub fn names(&self) -> &[&'static str] {
        &self.names
    }

    /// The numbers of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let place = self.names.iter().position(|other| *other == name)?;
        self.columns.get(place).map(Vec::as_slice)
    }

    /// The number of inputs without a position, which have no row.
    #[must_use]
    pub fn rejected(&self) -> usize {
        self.rejected
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
