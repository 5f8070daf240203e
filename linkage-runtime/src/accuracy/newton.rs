//! Newton's method with a fixed number of steps.

use super::{PositionMethod, Reached};
use crate::jacobian::correction;
use crate::mechanism::{finite_position, other_group};
use crate::{Mechanism, PerInput, PositionError, PositionErrorOf};

/// u + W (v' - v), then `K` times u - J^-1 Psi: `K` Newton steps after a prediction by the velocity ratios at a
/// position nearby.
///
/// Convergence is not checked: an input step h leaves an error of order h^(2^(`K` + 1)). A change of branch is a
/// [`PositionError::OtherBranch`]. [`newton`](crate::newton) iterates until the residual is within rounding error.
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
    ) -> Result<Self::Position, PositionErrorOf<M>> {
        let mut here = Reached::at(mechanism, predicted(mechanism, from, inputs.into())?);
        for _ in 0..K {
            let step = correction(mechanism, &here.pose)?;
            let unknowns = M::unknowns(&here.coordinates) - step;
            here = Reached::at(mechanism, M::with_unknowns(&here.coordinates, unknowns));
        }
        finite_position(mechanism, &here.coordinates, &here.pose)?;
        if mechanism.same_branch(&from.pose, &here.pose) {
            Ok(here)
        } else {
            Err(PositionError::OtherBranch {
                mechanism: mechanism.name(),
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
) -> Result<M::Coordinates, PositionErrorOf<M>> {
    let there: PerInput<M> = inputs.into();
    let (unknowns, here) = M::parts(&from.coordinates);
    let way = there - here;
    let step = mechanism.solve_jacobian(&from.pose, &(mechanism.jacobian_inputs(&from.pose) * way))?;
    Ok(M::coordinates(unknowns - step, there))
}
