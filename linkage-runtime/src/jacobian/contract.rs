//! The loops closed by Newton's method from near by.

use crate::{Mechanism, PerUnknown, PositionError, Real, real};

/// J^-1 Psi: what a step of Newton's method takes from the unknowns.
///
/// # Errors
/// Those of [`Mechanism::solve_jacobian`].
#[inline]
pub fn correction<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<PerUnknown<M>, PositionError> {
    mechanism.solve_jacobian(pose, &mechanism.residual(pose))
}

/// What is found at a position on the way to a closed one.
#[derive(Debug, Clone, Copy)]
pub enum Closing<P, X, T> {
    /// It is closed.
    Closed(X),
    /// The next position, and how far it is.
    Step(P, T),
    /// There is no way on.
    Stuck,
}

/// Newton's method without damping from near a solution: steps that shrink by half at least, to where `look` finds the
/// closures closed; `None` where they do not shrink, or are not closed after `most` of them.
///
/// From far away steps are damped instead, as those of [`newton`](crate::newton) are, whose verdict has to hold for every
/// guess: here a shorter step of who follows a motion is the better answer.
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
