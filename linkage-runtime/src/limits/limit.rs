//! An end of an interval of inputs.

use crate::RangeEnd;

/// An end of an interval of inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Limit<T, N = &'static str> {
    /// No limit: an angle can turn fully, a length can have any value. If groups were searched, no limit was found
    /// within a turn, or within four times the sum of the lengths of all links.
    Unlimited,
    /// A limit v in closed form, accurate to two ulp times its condition number, 1 + the sum of |(l / v) dv/dl| over
    /// the lengths l. The links are in line there; a later group may be undetermined
    /// ([`PositionError::Undetermined`](crate::PositionError::Undetermined)).
    Exact {
        /// The last input at which the mechanism can be assembled.
        input: T,
        /// The unknowns of the group whose links are in line there.
        group: N,
    },
    /// The last input before a coordinate or an output is beyond the end of its declared range: that end itself for the range
    /// of this input, else one of two neighbouring inputs between which it is.
    JointRange {
        /// The input.
        input: T,
        /// The coordinate or the output.
        of: N,
        /// The end of its range.
        end: RangeEnd,
    },
    /// A limit found by search, between two neighbouring inputs, or between two inputs where a group is undetermined.
    /// Links that miss each other by a rounding error count as in line, so the true limit lies between the two inputs,
    /// widened by three ulp times its condition number.
    Bracketed {
        /// The last input found at which the mechanism can be assembled.
        assembled: T,
        /// An input beyond the limit at which it cannot.
        unbuildable: T,
        /// The unknowns of the group that cannot be assembled beyond the limit.
        group: N,
    },
}

impl<T: Copy, N> Limit<T, N> {
    /// Returns the last input at which the mechanism is known to assemble; none if there is no limit.
    pub fn input(&self) -> Option<T> {
        match *self {
            Self::Unlimited => None,
            Self::Exact { input, .. } | Self::JointRange { input, .. } => Some(input),
            Self::Bracketed { assembled, .. } => Some(assembled),
        }
    }
}
