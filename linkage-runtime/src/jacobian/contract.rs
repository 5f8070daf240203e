//! Undamped Newton's method from near a solution.

use crate::{Mechanism, PerUnknown, PositionErrorOf, Real, real};

/// J^-1 Psi, the correction of a Newton step u - J^-1 Psi.
///
/// # Errors
/// Those of [`Mechanism::solve_jacobian`].
#[inline]
pub fn correction<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<PerUnknown<M>, PositionErrorOf<M>> {
    mechanism.solve_jacobian(pose, &mechanism.residual(pose))
}

/// The result of one iteration of Newton's method.
#[derive(Debug, Clone, Copy)]
pub enum Iteration<P, X, T> {
    /// The iteration has converged.
    Converged(X),
    /// The next position, and the length of the step to it.
    Step(P, T),
    /// No step is possible.
    Failed,
}

/// Undamped Newton's method from near a solution: calls `iterate` until it returns that the iteration has converged.
/// `None` if a step is longer than half the one before, or if `most` iterations are not enough.
///
/// [`newton`](crate::newton) damps its steps, because it must handle every guess. Here the caller, who follows a
/// motion, takes a shorter step along it instead.
///
/// # Errors
/// Those of `iterate`.
pub fn contract<P, X, T: Real, E>(
    start: P,
    most: usize,
    mut iterate: impl FnMut(&P) -> Result<Iteration<P, X, T>, E>,
) -> Result<Option<X>, E> {
    let (mut here, mut last) = (start, None);
    for _ in 0..most {
        match iterate(&here)? {
            Iteration::Converged(found) => return Ok(Some(found)),
            Iteration::Failed => return Ok(None),
            Iteration::Step(next, size) => {
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
