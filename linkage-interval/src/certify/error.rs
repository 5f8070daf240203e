//! The error of certificates.

use std::fmt;

use linkage_runtime::{Mechanism, Name};

use crate::Interval;

/// The reason why a motion has no certificate.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum CertifyError<N: Name = &'static str> {
    /// A number or an index given is invalid: NaN, infinite, or outside its range.
    Invalid {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The name of the number.
        what: &'static str,
    },
    /// The input has no turn: no sine or cosine takes it, and no vector has it as its angle.
    NoTurn {
        /// The mechanism, or the driver of one.
        mechanism: N,
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
    /// The start is near no position that can be certified: Newton's method does not converge, or the position is
    /// singular, or the tolerances are too wide.
    NoPosition {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group nearest to a singularity there.
        group: N,
    },
    /// The input turns back at a dead point.
    DeadPoint {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group that is singular there.
        group: N,
        /// It contains the limit of the input.
        limit: Interval,
    },
    /// Even the shortest step fails in this interval of the input: it contains a change point, where motions cross, or
    /// other motions or singularities are too near. With tolerances some mechanisms of the box may reach one.
    Singular {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group nearest to a singularity.
        group: N,
        /// The inputs of the step.
        input: Interval,
    },
    /// The equations of a group have no bounded derivative in this interval of the input: they jump, as an angle by
    /// `atan2` at pi, have a kink, as a modulus at zero, or a pole, or are undefined.
    NoBounds {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group.
        group: N,
        /// The inputs of the step.
        input: Interval,
    },
    /// Even the shortest step fails in this interval of the input, though no group is nearly singular there: the bounds
    /// are too wide, as next to a pole, of sines of angles beyond 1e5 rad, or with wide tolerances.
    Undecided {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The inputs of the step.
        input: Interval,
    },
    /// Two enclosures of one derivative have no number in common: the emitted formula is not the derivative of Psi.
    Contradiction {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The derivative: J, A or gamma.
        what: &'static str,
    },
    /// The certified motion is not the one that a path has found.
    OtherMotion {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The difference: modes or dead points.
        what: &'static str,
    },
    /// The bound of the work, [`most_tests`](super::Certify::most_tests), is reached. A curve that never closes takes any
    /// number of tests.
    Exhausted {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The number of boxes certified or tested.
        boxes: usize,
        /// The input up to which the motion is certified.
        input: f64,
    },
}

/// The error of a certificate, with names of a mechanism.
pub type CertifyErrorOf<M> = CertifyError<<M as Mechanism>::Name>;

impl<N: Name> CertifyError<N> {
    /// This error with other names: borrowed ones become owned.
    pub fn map_names<M: Name>(self, mut f: impl FnMut(N) -> M) -> CertifyError<M> {
        match self {
            Self::Invalid { mechanism, what } => CertifyError::Invalid { mechanism: f(mechanism), what },
            Self::NoTurn { mechanism } => CertifyError::NoTurn { mechanism: f(mechanism) },
            Self::UserFunction { mechanism, group, function } => {
                CertifyError::UserFunction { mechanism: f(mechanism), group: f(group), function: f(function) }
            }
            Self::NoPosition { mechanism, group } => {
                CertifyError::NoPosition { mechanism: f(mechanism), group: f(group) }
            }
            Self::DeadPoint { mechanism, group, limit } => {
                CertifyError::DeadPoint { mechanism: f(mechanism), group: f(group), limit }
            }
            Self::Singular { mechanism, group, input } => {
                CertifyError::Singular { mechanism: f(mechanism), group: f(group), input }
            }
            Self::NoBounds { mechanism, group, input } => {
                CertifyError::NoBounds { mechanism: f(mechanism), group: f(group), input }
            }
            Self::Undecided { mechanism, input } => CertifyError::Undecided { mechanism: f(mechanism), input },
            Self::Contradiction { mechanism, what } => CertifyError::Contradiction { mechanism: f(mechanism), what },
            Self::OtherMotion { mechanism, what } => CertifyError::OtherMotion { mechanism: f(mechanism), what },
            Self::Exhausted { mechanism, boxes, input } => {
                CertifyError::Exhausted { mechanism: f(mechanism), boxes, input }
            }
        }
    }
}

impl<N: Name> fmt::Display for CertifyError<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid { mechanism, what } => {
                write!(f, "{what} of {mechanism} is invalid: not finite or out of range")
            }
            Self::NoTurn { mechanism } => write!(
                f,
                "the input of {mechanism} is used as no angle, so that it has no turn: certify a range of it with `range`"
            ),
            Self::UserFunction { mechanism, group, function } => write!(
                f,
                "group {group} of {mechanism} has the user function {function}, which has no values over intervals"
            ),
            Self::NoPosition { mechanism, group } => write!(
                f,
                "no position of {mechanism} can be certified at the start: group {group} is nearest to a singularity"
            ),
            Self::DeadPoint { mechanism, group, limit } => write!(
                f,
                "the input of {mechanism} turns back between {:?} and {:?}: group {group} is at a dead point; \
                 `curve` passes it",
                limit.least(),
                limit.most()
            ),
            Self::Singular { mechanism, group, input } => write!(
                f,
                "the motion of {mechanism} cannot be certified between the inputs {:?} and {:?}: group {group} is \
                 singular there or nearly so",
                input.least(),
                input.most()
            ),
            Self::NoBounds { mechanism, group, input } => write!(
                f,
                "the equations of group {group} of {mechanism} jump, have a kink or a pole, or are undefined between the \
                 inputs {:?} and {:?}",
                input.least(),
                input.most()
            ),
            Self::Undecided { mechanism, input } => write!(
                f,
                "the motion of {mechanism} cannot be certified between the inputs {:?} and {:?}, though no group is nearly \
                 singular there: the bounds are too wide, as next to a pole or for angles beyond 1e5 rad",
                input.least(),
                input.most()
            ),
            Self::Contradiction { mechanism, what } => {
                write!(f, "the emitted {what} of {mechanism} contradicts the derivatives of Psi")
            }
            Self::OtherMotion { mechanism, what } => {
                write!(f, "the certified motion of {mechanism} has other {what} than the one found by path following")
            }
            Self::Exhausted { mechanism, boxes, input } => {
                write!(
                    f,
                    "the motion of {mechanism} is certified up to the input {input} by {boxes} boxes, which took all tests \
                     allowed: raise `most_tests`"
                )
            }
        }
    }
}

impl<N: Name> std::error::Error for CertifyError<N> {}
