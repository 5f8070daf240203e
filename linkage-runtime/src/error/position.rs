//! Why there is no position, velocity or force.

use core::fmt;

use super::InputError;

/// Why a mechanism has no position at its inputs, or no velocity or force at its position. All measures are pure numbers:
/// scaling all lengths of a mechanism changes none of them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum PositionError {
    /// The constraint Jacobian has no inverse here: the input cannot drive the mechanism.
    Singular {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that is singular; the groups before it are regular.
        group: &'static str,
        /// How regular the Jacobian is: its determinant beside the largest value that its formula
        /// could take at these lengths; of more than two unknowns the smallest pivot of the
        /// equilibrated Jacobian. 1 is far from singular, 0 is singular.
        regularity: f64,
    },
    /// A group cannot be assembled at this input: its links do not reach each other.
    Unbuildable {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group; the groups before it can be assembled.
        group: &'static str,
        /// By how much it misses, 0 where the links just touch. Of two links (RRR) how far the square of
        /// the distance of their outer joints lies outside what they span, beside the square of their sum;
        /// of the other groups what the link misses beside its length.
        gap: f64,
    },
    /// A group has infinitely many positions at this input. Of two links (RRR) the outer joints coincide and the lengths
    /// are equal to rounding, or a length is zero; of the other groups likewise everything that fixes an unknown
    /// vanishes: the pin of a slotted link lies in its pivot, guides are parallel and coincide, the factor of an
    /// unknown is zero and what it must equal too. Near this input the position depends on the side it is approached from.
    Undetermined {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group; the groups before it can be assembled.
        group: &'static str,
    },
    /// Newton's method found no position: the mechanism cannot be assembled at this input, or the
    /// guess is too far.
    NotConverged {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that was solved alone, or that is singular where the search ended; none
        /// if all were solved together.
        group: Option<&'static str>,
        /// Newton steps taken.
        iterations: usize,
        /// The largest residual that was left, beside the sum of the magnitudes of its terms.
        residual: f64,
        /// How regular the Jacobian is where the search ended, as in [`PositionError::Singular`].
        regularity: f64,
    },
    /// Newton's method found a position of another assembly branch than the guess belongs to: between the two
    /// the group is singular.
    OtherBranch {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the first group whose determinant has another sign.
        group: &'static str,
    },
    /// A number given or computed is infinite or not a number.
    NotFinite {
        /// The mechanism, the driver of one or the scene.
        mechanism: &'static str,
        /// What is not finite.
        quantity: &'static str,
    },
    /// What was given cannot be used.
    Input(InputError),
}

impl fmt::Display for PositionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { mechanism, group, regularity } => write!(
                f,
                "{mechanism} is in a singular configuration: the Jacobian of {group} is regular to {regularity:.1e} only"
            ),
            Self::Unbuildable { mechanism, group, gap } => {
                write!(f, "{mechanism} cannot be assembled at this input: {group} miss closing by {gap:.1e}")
            }
            Self::Undetermined { mechanism, group } => {
                write!(f, "{mechanism} is undetermined at this input: the outer joints of group {group} coincide")
            }
            Self::NotConverged { mechanism, group, iterations, residual, regularity } => {
                let of = group.map_or("", |_| " of ");
                write!(
                    f,
                    "no position of {mechanism} found in {iterations} Newton steps: relative residual {residual:.1e}, \
                     Jacobian{of}{} regular to {regularity:.1e}",
                    group.unwrap_or_default()
                )
            }
            Self::OtherBranch { mechanism, group } => {
                write!(f, "the position of {mechanism} near the guess has {group} on another branch than the guess")
            }
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
