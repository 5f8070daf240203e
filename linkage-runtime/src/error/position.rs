//! The error of positions, velocities and forces.

use core::fmt;

use super::{InputError, InputValues, Name};

/// The reason why a mechanism has no position at its inputs, or no velocity or force at its position. All measures are
/// nondimensional: scaling all lengths of a mechanism changes none of them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum PositionError<N: Name = &'static str> {
    /// The constraint Jacobian J is singular: the input cannot drive the mechanism.
    Singular {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group that is singular; the groups before it are regular.
        group: N,
        /// The regularity of the group, from 0 if it is singular to about 1: |det J| divided by the largest value that
        /// it can take at these lengths, which for two links (RRR) is the sine of the angle between them; for more than
        /// two unknowns the smallest pivot of the equilibrated Jacobian.
        regularity: f64,
    },
    /// A group cannot be assembled at this input: its links do not reach each other.
    Unbuildable {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group; the groups before it can be assembled.
        group: N,
        /// The relative gap, 0 where the links just touch. For two links (RRR) it is the amount by which the squared
        /// distance of the outer joints is outside the range that the links span, divided by the square of the sum of
        /// their lengths; for other groups the gap divided by the length of the link.
        gap: f64,
        /// The inputs.
        inputs: InputValues<N>,
    },
    /// A group has infinitely many positions at this input. For two links (RRR) the outer joints coincide and the
    /// lengths are equal up to rounding error, or a length is zero. For other groups all that determines an unknown
    /// vanishes likewise: the pin of a slotted link lies in its pivot, guides are parallel and coincide, the factor of
    /// an unknown is zero and so is the value it must have. Near this input the position depends on the side it is
    /// approached from.
    Undetermined {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group; the groups before it can be assembled.
        group: N,
    },
    /// Newton's method did not converge: the mechanism cannot be assembled at this input, or the guess is too far away.
    NotConverged {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group that was solved alone, or that is singular where the search ended; none
        /// if all were solved together.
        group: Option<N>,
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
        mechanism: N,
        /// The unknowns of the first group whose determinant has another sign.
        group: N,
    },
    /// A loop or an equation that is declared as implied by the others does not close at the position found: the
    /// dimensions or the branch are not those for which it follows from the others.
    NotImplied {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The loop or equation: its number among those declared as implied, and its doc comment.
        equation: N,
        /// Its residual, divided by the sum of the magnitudes of its terms.
        residual: f64,
    },
    /// A group has no closed form, and no guess is given.
    NoClosedForm {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the first group without a closed form.
        group: N,
    },
    /// The mechanism has more branches than a list of its positions can have.
    TooManyBranches {
        /// The mechanism, or the driver of one.
        mechanism: N,
    },
    /// A group has fewer positions at this input than the number of the one asked for.
    NoMode {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group.
        group: N,
        /// The number asked for, from 0.
        number: usize,
        /// The number of positions.
        count: usize,
    },
    /// It is not decided how many positions a group has: near one place rounding error, or the limit of the search, hides
    /// whether there are several, one or none.
    Undecided {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group.
        group: N,
        /// The regularity of the group there, 0 where positions meet.
        regularity: f64,
    },
    /// A number given or computed is infinite or NaN.
    NotFinite {
        /// The mechanism, the driver of one or the scene.
        mechanism: N,
        /// The name of the number.
        quantity: N,
    },
    /// The input is invalid.
    Input(InputError<N>),
}

// A list of names need not be `Copy` where a name is.
impl<N: Name<List: Copy> + Copy> Copy for PositionError<N> {}

impl<N: Name> PositionError<N> {
    /// This error with other names: borrowed ones become owned.
    pub fn map_names<M: Name<List: FromIterator<M>>>(self, mut f: impl FnMut(N) -> M) -> PositionError<M> {
        let inputs = |inputs: InputValues<N>, f: &mut dyn FnMut(N) -> M| inputs.map_names(f);
        self.renamed(&mut f, inputs)
    }

    /// This error with other names, and with the inputs of this list: owned names become borrowed.
    pub fn with_names<M: Name>(self, inputs: M::List, mut f: impl FnMut(N) -> M) -> PositionError<M> {
        self.renamed(
            &mut f,
            |values, _| if values.is_empty() { InputValues::default() } else { values.with_names(inputs) },
        )
    }

    fn renamed<M: Name>(
        self,
        f: &mut dyn FnMut(N) -> M,
        of_inputs: impl FnOnce(InputValues<N>, &mut dyn FnMut(N) -> M) -> InputValues<M>,
    ) -> PositionError<M> {
        match self {
            Self::Singular { mechanism, group, regularity } => {
                PositionError::Singular { mechanism: f(mechanism), group: f(group), regularity }
            }
            Self::Unbuildable { mechanism, group, gap, inputs } => PositionError::Unbuildable {
                mechanism: f(mechanism),
                group: f(group),
                gap,
                inputs: of_inputs(inputs, f),
            },
            Self::Undetermined { mechanism, group } => {
                PositionError::Undetermined { mechanism: f(mechanism), group: f(group) }
            }
            Self::NotConverged { mechanism, group, iterations, residual, regularity } => PositionError::NotConverged {
                mechanism: f(mechanism),
                group: group.map(f),
                iterations,
                residual,
                regularity,
            },
            Self::OtherBranch { mechanism, group } => {
                PositionError::OtherBranch { mechanism: f(mechanism), group: f(group) }
            }
            Self::NotImplied { mechanism, equation, residual } => {
                PositionError::NotImplied { mechanism: f(mechanism), equation: f(equation), residual }
            }
            Self::NoClosedForm { mechanism, group } => {
                PositionError::NoClosedForm { mechanism: f(mechanism), group: f(group) }
            }
            Self::TooManyBranches { mechanism } => PositionError::TooManyBranches { mechanism: f(mechanism) },
            Self::NoMode { mechanism, group, number, count } => {
                PositionError::NoMode { mechanism: f(mechanism), group: f(group), number, count }
            }
            Self::Undecided { mechanism, group, regularity } => {
                PositionError::Undecided { mechanism: f(mechanism), group: f(group), regularity }
            }
            Self::NotFinite { mechanism, quantity } => {
                PositionError::NotFinite { mechanism: f(mechanism), quantity: f(quantity) }
            }
            Self::Input(error) => PositionError::Input(error.map_names(f)),
        }
    }
}

impl<N: Name> fmt::Display for PositionError<N> {
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
                write!(
                    f,
                    "no position of {mechanism} found in {iterations} Newton steps; give a nearer guess: \
                     relative residual {residual:.1e}, regularity"
                )?;
                group.as_ref().map_or(Ok(()), |group| write!(f, " of group {group}"))?;
                write!(f, " {regularity:.1e}")
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

impl<N: Name> core::error::Error for PositionError<N> {}

impl<N: Name> From<InputError<N>> for PositionError<N> {
    fn from(error: InputError<N>) -> Self {
        Self::Input(error)
    }
}
