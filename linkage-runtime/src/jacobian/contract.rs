//! Undamped Newton's method from near a solution.

use crate::{Mechanism, PerUnknown, PositionError, Real, real};

/// J^-1 Psi, the correction of a Newton step u - J^-1 Psi.
///
/// # Errors
/// Those of [`Mechanism::solve_jacobian`].
#[inline]
pub fn correction<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<PerUnknown<M>, PositionError> {
    mechanism.solve_jacobian(pose, &mechanism.residual(pose))
}

/// The result of one iteration of Newton's method.
#[derive(Debug, Clone, Copy)]
pub enum Closing<P, X, T> {
    /// The iteration has converged.
    Closed(X),
    /// The next position, and the length of the step to it.
    Step(P, T),
    /// No step is possible.
    Stuck,
}

/// Undamped Newton's method from near a solution: each step is at most half as long as the one before, until `look`
/// finds that the iteration has converged. `None` if the steps do not shrink, or if `most` of them do not converge.
///
/// [`newton`](crate::newton) damps its steps, because it must handle every guess. Here the caller, who follows a
/// motion, takes a shorter step instead.
///
/// # Errors
/// Those of `look`.
pub fn contract<P, X, T: Real, E>(
    start: P,
    most: usize,
    mut look: impl FnMut(&P) -> Result<Closing<P, X, T>, E>,
) -> Result<Option<X>, E> {
    let (mut here, mut last) = (start, None);
    for _ in 0..most {
        match look(&here)? {
            Closing::Closed(found) => return Ok(Some(found)),
            Closing::Stuck => return Ok(None),
            Closing::Step(next, size) => {
                let contracts = size.is_finite() && last.is_none_or(|last| size <= last * real(0.5));
                if !contracts {
                    return Ok(None);
                }
                (here, last) = (next, Some(size));
            }
        }
    }
    Ok(None)
}
