//! A number of Newton steps that is known beforehand.

use nalgebra::SVector;

use super::{Method, Reached};
use crate::mechanism::{finite_position, other_group};
use crate::{Error, Mechanism, Real};

/// `K` steps of Newton's method from a position nearby, predicted by its velocity ratios: u + W (v' - v), then `K` times
/// u - J^-1 Psi.
///
/// Nothing is measured on the way: a step of the input by h leaves an error of the order of h^(2^(`K` + 1)). The branch
/// is kept or [`Error::OtherBranch`] tells. [`newton`](crate::newton) goes on until the closures are closed to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Newton<const K: usize>;

impl<M, T, const U: usize, const V: usize, const K: usize> Method<M, T, U, V> for Newton<K>
where
    M: Mechanism<T, U, V>,
    T: Real,
{
    type From = Reached<M::Coordinates, M::Pose>;
    type Position = Reached<M::Coordinates, M::Pose>;

    #[inline]
    fn position(mechanism: &M, from: &Self::From, inputs: impl Into<M::Inputs>) -> Result<Self::Position, Error> {
        let mut here = Reached::at(mechanism, predicted(mechanism, from, inputs.into())?);
        for _ in 0..K {
            let step = mechanism.solve_jacobian(&here.pose, &mechanism.residual(&here.pose))?;
            let unknowns = M::unknowns(&here.coordinates) - step;
            here = Reached::at(mechanism, M::with_unknowns(&here.coordinates, unknowns));
        }
        finite_position::<M, T, U, V>(&here.coordinates, &here.pose)?;
        if mechanism.same_branch(&from.pose, &here.pose) {
            Ok(here)
        } else {
            Err(Error::OtherBranch { mechanism: M::NAME, group: other_group(mechanism, &from.pose, &here.pose) })
        }
    }
}

/// u + W (v' - v).
#[inline]
pub(super) fn predicted<M, T, const U: usize, const V: usize>(
    mechanism: &M,
    from: &Reached<M::Coordinates, M::Pose>,
    inputs: M::Inputs,
) -> Result<M::Coordinates, Error>
where
    M: Mechanism<T, U, V>,
    T: Real,
{
    let there: SVector<T, V> = inputs.into();
    let way = there - M::inputs(&from.coordinates);
    let step = mechanism.solve_jacobian(&from.pose, &(mechanism.jacobian_inputs(&from.pose) * way))?;
    let unknowns = M::unknowns(&from.coordinates) - step;
    Ok(M::with_inputs(&M::with_unknowns(&from.coordinates, unknowns), there))
}
