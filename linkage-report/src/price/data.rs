//! Errors and times of one method.

use linkage_runtime::PositionError;

use super::timing::Time;

/// The quantities, by order of derivative.
pub const QUANTITIES: [&str; 3] = ["position", "velocity", "acceleration"];

/// A method with its errors and times.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MethodPrice {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub family: Family,
    /// The position, and the position with the velocity and with velocity and acceleration.
    pub quantities: [QuantityPrice; 3],
}

/// The kind of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Family {
    /// Closed form.
    ClosedForm,
    /// Newton's method.
    Newton,
    /// Interpolation in a table.
    Table,
}

/// The errors and the time of one quantity by one method.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct QuantityPrice {
    /// The error at each input, or that of the method. Of a position in radians, of lengths divided by those of their
    /// loops; of a velocity relative to the largest one; of an acceleration relative to the larger of the largest one and
    /// the square of the largest velocity.
    pub errors: Vec<Result<f64, PositionError>>,
    /// The time of one evaluation from the input; none if the method fails everywhere.
    pub time: Option<Time>,
    /// The time by the number of operations, in seconds; none if that depends on the input.
    pub predicted: Option<f64>,
}

impl QuantityPrice {
    /// The largest error.
    ///
    /// # Errors
    /// The first error of the method.
    pub fn largest(&self) -> Result<f64, PositionError> {
        self.errors.iter().try_fold(0.0, |largest: f64, error| Ok(largest.max((*error)?)))
    }

    /// The median of the errors where there is one.
    #[must_use]
    pub fn median(&self) -> Option<f64> {
        let mut errors: Vec<f64> = self.errors.iter().filter_map(|error| error.ok()).collect();
        errors.sort_by(f64::total_cmp);
        errors.get(errors.len() / 2).copied()
    }

    /// The number of inputs at which the method fails.
    #[must_use]
    pub fn failures(&self) -> usize {
        self.errors.iter().filter(|error| error.is_err()).count()
    }
}
