//! A number of Newton steps that is known beforehand.

use super::{PositionMethod, Reached};
use crate::jacobian::correction;
use crate::mechanism::{finite_position, other_group};
use crate::{Mechanism, PerInput, PositionError};

/// `K` steps of Newton's method from a position nearby, predicted by its velocity ratios: u + W (v' - v), then `K` times
/// u - J^-1 Psi.
///
/// Nothing is measured on the way: a step of the input by h leaves an error of the order of h^(2^(`K` + 1)). The branch
/// is kept or [`PositionError::OtherBranch`] tells. [`newton`](crate::newton) goes on until the closures are closed to
/// rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Newton<const K: usize>;

impl<M: Mechanism, const K: usize> PositionMethod<M> for Newton<K> {
    type From = Reached<M::Coordinates, M::Pose>;
    type Position = Reached<M::Coordinates, M::Pose>;

    #[inline]
    fn position(
        mechanism: &M,
        from: &Self::From,
        inputs: impl Into<M::Inputs>,
    ) -> Result<Self::Position, PositionError> {
        let mut here = Reached::at(mechanism, predicted(mechanism, from, inputs.into())?);
        for _ in 0..K {
            let step = correction(mechanism, &here.pose)?;
            let unknowns = M::unknowns(&here.coordinates) - step;
            here = Reached::at(mechanism, M::with_unknowns(&here.coordinates, unknowns));
        }
        finite_position::<M>(&here.coordinates, &here.pose)?;
        if mechanism.same_branch(&from.pose, &here.pose) {
            Ok(here)
        } else {
            Err(PositionError::OtherBranch {
                mechanism: M::NAME,
                group: other_group(mechanism, &from.pose, &here.pose),
            })
        }
    }
}

/// u + W (v' - v).
#[inline]
pub(super) fn predicted<M: Mechanism>(
    mechanism: &M,
    from: &Reached<M::Coordinates, M::Pose>,
    inputs: M::Inputs,
) -> Result<M::Coordinates, PositionError> {
    let there: PerInput<M> = inputs.into();
    let (unknowns, here) = M::parts(&from.coordinates);
    let way = there - here;
    let step = mechanism.solve_jacobian(&from.pose, &(mechanism.jacobian_inputs(&from.pose) * way))?;
    Ok(M::coordinates(unknowns - step, there))
}
