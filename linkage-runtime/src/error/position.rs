//! The error of positions, velocities and forces.

use core::fmt;

use super::{InputError, InputValues};

/// The reason why a mechanism has no position at its inputs, or no velocity or force at its position. All measures are
/// nondimensional: scaling all lengths of a mechanism changes none of them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum PositionError {
    /// The constraint Jacobian J is singular: the input cannot drive the mechanism.
    Singular {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that is singular; the groups before it are regular.
        group: &'static str,
        /// The regularity of the group, from 0 if it is singular to about 1: |det J| divided by the largest value that
        /// it can take at these lengths, which for two links (RRR) is the sine of the angle between them; for more than
        /// two unknowns the smallest pivot of the equilibrated Jacobian.
        regularity: f64,
    },
    /// A group cannot be assembled at this input: its links do not reach each other.
    Unbuildable {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group; the groups before it can be assembled.
        group: &'static str,
        /// The relative gap, 0 where the links just touch. For two links (RRR) it is the amount by which the squared
        /// distance of the outer joints is outside the range that the links span, divided by the square of the sum of
        /// their lengths; for other groups the gap divided by the length of the link.
        gap: f64,
        /// The inputs.
        inputs: InputValues,
    },
    /// A group has infinitely many positions at this input. For two links (RRR) the outer joints coincide and the
    /// lengths are equal up to rounding error, or a length is zero. For other groups all that determines an unknown
    /// vanishes likewise: the pin of a slotted link lies in its pivot, guides are parallel and coincide, the factor of
    /// an unknown is zero and so is the value it must have. Near this input the position depends on the side it is
    /// approached from.
    Undetermined {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group; the groups before it can be assembled.
        group: &'static str,
    },
    /// Newton's method did not converge: the mechanism cannot be assembled at this input, or the guess is too far away.
    NotConverged {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that was solved alone, or that is singular where the search ended; none
        /// if all were solved together.
        group: Option<&'static str>,
        /// Newton steps taken.
        iterations: usize,
        /// The largest residual at the end, divided by the sum of the magnitudes of its terms.
        residual: f64,
        /// The regularity of the Jacobian where the search ended: at a singular group as in
        /// [`PositionError::Singular`], otherwise |det J| divided by the product of its column norms.
        regularity: f64,
    },
    /// The position found is on another assembly branch than the guess: between the two the group is singular.
    OtherBranch {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the first group whose determinant has another sign.
        group: &'static str,
    },
    /// A loop or an equation that is declared as implied by the others does not close at the position found: the
    /// dimensions or the branch are not those for which it follows from the others.
    NotImplied {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The loop or equation: its number among those declared as implied, and its doc comment.
        equation: &'static str,
        /// Its residual, divided by the sum of the magnitudes of its terms.
        residual: f64,
    },
    /// A group has no closed form, and no guess is given.
    NoClosedForm {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the first group without a closed form.
        group: &'static str,
    },
    /// The mechanism has more branches than a list of its positions can have.
    TooManyBranches {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
    },
    /// A group has fewer positions at this input than the number of the one asked for.
    NoMode {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group.
        group: &'static str,
        /// The number asked for, from 0.
        number: usize,
        /// The number of positions.
        count: usize,
    },
    /// It is not decided how many positions a group has: near one place rounding error, or the limit of the search, hides
    /// whether there are several, one or none.
    Undecided {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group.
        group: &'static str,
        /// The regularity of the group there, 0 where positions meet.
        regularity: f64,
    },
    /// A number given or computed is infinite or NaN.
    NotFinite {
        /// The mechanism, the driver of one or the scene.
        mechanism: &'static str,
        /// The name of the number.
        quantity: &'static str,
    },
    /// The input is invalid.
    Input(InputError),
}

impl fmt::Display for PositionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { mechanism, group, regularity } => write!(
                f,
                "{mechanism} is in a singular configuration: group {group} has regularity {regularity:.1e}, 0 is \
                 singular"
            ),
            Self::Unbuildable { mechanism, group, gap, inputs } => {
                write!(
                    f,
                    "{mechanism} cannot be assembled at {inputs}: group {group} does not close by a relative gap of \
                     {gap:.1e}"
                )
            }
            Self::Undetermined { mechanism, group } => {
                write!(f, "{mechanism} is undetermined at this input: group {group} has infinitely many positions")
            }
            Self::NotConverged { mechanism, group, iterations, residual, regularity } => {
                let of = group.map_or("", |_| " of group ");
                write!(
                    f,
                    "no position of {mechanism} found in {iterations} Newton steps; give a nearer guess: \
                     relative residual {residual:.1e}, regularity{of}{} {regularity:.1e}",
                    group.unwrap_or_default()
                )
            }
            Self::OtherBranch { mechanism, group } => {
                write!(
                    f,
                    "the position found of {mechanism} is on another branch than the guess: the determinant of group \
                     {group} changed its sign"
                )
            }
            Self::NotImplied { mechanism, equation, residual } => write!(
                f,
                "{equation} of {mechanism} does not close at this position: relative residual {residual:.1e}; check the \
                 lengths and the branch"
            ),
            Self::NoClosedForm { mechanism, group } => {
                write!(
                    f,
                    "group {group} of {mechanism} has no closed form: use `assemble_near` with a guess, or `solve`"
                )
            }
            Self::TooManyBranches { mechanism } => {
                write!(f, "{mechanism} has too many branches to list its positions: use `assemble` with one of them")
            }
            Self::NoMode { mechanism, group, number, count } => write!(
                f,
                "group {group} of {mechanism} has {count} positions at this input, numbered from 0: there is no number \
                 {number}"
            ),
            Self::Undecided { mechanism, group, regularity } => write!(
                f,
                "it is not decided how many positions group {group} of {mechanism} has at this input: near one place, of \
                 regularity {regularity:.1e}, rounding error or the limit of the search hides their number"
            ),
            Self::NotFinite { mechanism, quantity } => write!(f, "{quantity} of {mechanism} is not a finite number"),
            Self::Input(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for PositionError {}

impl From<InputError> for PositionError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}
