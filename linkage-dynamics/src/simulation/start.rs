//! The start of a simulation.

/// The start of a motion: a time, a position and the rates of the inputs.
///
/// ```text
/// Start { t: 0.0, q, input_rates: 12.0 }
/// Start { t: 0.0, q, input_rates: RobotInputs { shoulder: 1.0, elbow: 0.0 } }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Start<T, Q, R> {
    /// The time.
    pub t: T,
    /// All coordinates by name. Only the inputs must be exact: the others are a guess, projected onto the constraints.
    pub q: Q,
    /// The rates v' of the inputs by name; a number if there is one input.
    pub input_rates: R,
}
