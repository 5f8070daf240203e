//! The error of enclosures.

use std::fmt;

use linkage_runtime::{Mechanism, Name};

use crate::Interval;

/// The reason why a velocity, an acceleration or a sensitivity has no enclosure over a box.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum EncloseError<N: Name = &'static str> {
    /// An interval given has an infinite bound.
    Invalid {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The kind of the number, such as `parameter`.
        kind: &'static str,
        /// Its name.
        name: N,
    },
    /// Nothing is known of a user function over an interval.
    UserFunction {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group with the function in its equations.
        group: N,
        /// The function.
        function: N,
    },
    /// A derivative of Psi has no bounds over the box: a divisor may be zero, or the argument of a function outside its
    /// domain; or the numbers are so large that they overflow.
    NoBounds {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group with the equation.
        group: N,
        /// The derivative: J, or the right-hand side by its name.
        derivative: &'static str,
    },
    /// J is not proved regular at every point of the box. With a float inverse Y of the middle of J it is if the norm of
    /// I - Y J is below 1 for all J of the box; the norm is relative to the best scales.
    NotRegular {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group whose block of J may be singular.
        group: N,
        /// An upper bound of the norm of I - Y J for the block, infinite if its middle is singular.
        norm: f64,
    },
    /// A certificate does not cover these inputs.
    Outside {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The inputs asked for.
        input: Interval,
        /// Those of the certificate.
        inputs: Interval,
    },
}

/// The error of an enclosure, with names of a mechanism.
pub type EncloseErrorOf<M> = EncloseError<<M as Mechanism>::Name>;

impl<N: Name> EncloseError<N> {
    /// This error with other names: borrowed ones become owned.
    pub fn map_names<M: Name>(self, mut f: impl FnMut(N) -> M) -> EncloseError<M> {
        match self {
            Self::Invalid { mechanism, kind, name } => {
                EncloseError::Invalid { mechanism: f(mechanism), kind, name: f(name) }
            }
            Self::UserFunction { mechanism, group, function } => {
                EncloseError::UserFunction { mechanism: f(mechanism), group: f(group), function: f(function) }
            }
            Self::NoBounds { mechanism, group, derivative } => {
                EncloseError::NoBounds { mechanism: f(mechanism), group: f(group), derivative }
            }
            Self::NotRegular { mechanism, group, norm } => {
                EncloseError::NotRegular { mechanism: f(mechanism), group: f(group), norm }
            }
            Self::Outside { mechanism, input, inputs } => {
                EncloseError::Outside { mechanism: f(mechanism), input, inputs }
            }
        }
    }
}

impl<N: Name> fmt::Display for EncloseError<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid { mechanism, kind, name } => {
                write!(f, "the interval of {kind} {name} of {mechanism} is infinite: give finite bounds")
            }
            Self::UserFunction { mechanism, group, function } => write!(
                f,
                "group {group} of {mechanism} has the user function {function}, which has no values over intervals"
            ),
            Self::NoBounds { mechanism, group, derivative } => write!(
                f,
                "{derivative} of group {group} of {mechanism} has no bounds over the box: a divisor contains zero, or an \
                 argument leaves the domain of its function; give narrower intervals"
            ),
            Self::NotRegular { mechanism, group, norm } => write!(
                f,
                "{mechanism} is not proved regular at every point of the box: the norm of I - Y J of group {group} is up to \
                 {norm:.2e}, not below 1; give narrower intervals, farther from a dead point"
            ),
            Self::Outside { mechanism, input, inputs } => write!(
                f,
                "the inputs from {:?} to {:?} are not within those of the certificate of {mechanism}, from {:?} to {:?}",
                input.least(),
                input.most(),
                inputs.least(),
                inputs.most()
            ),
        }
    }
}

impl<N: Name> std::error::Error for EncloseError<N> {}
