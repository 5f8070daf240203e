//! Position by Newton's method: u <- u - J^-1 Psi, damped, with honest failure.

use nalgebra::SVector;

use crate::scalar::to_f64;
use crate::{Error, Mechanism, Real, real};

/// A position and how it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution<Q> {
    /// The position.
    pub coordinates: Q,
    /// Newton steps taken.
    pub iterations: usize,
    /// The largest residual left, beside the sum of the magnitudes of its terms.
    pub residual: f64,
    /// Whether the determinant of each block of J has the sign it had at the guess: if not, the
    /// position belongs to another assembly branch than the guess, or the guess lay beyond a dead point.
    pub same_branch: bool,
}

/// Newton steps before the search is given up; from a fair guess it takes four or five.
const MOST_ITERATIONS: usize = 60;

/// A residual of this many roundings of the sum of the magnitudes of its terms is zero.
const ROUNDINGS: f64 = 4.0;

/// Halvings of one step before it is given up: a step 2^-40 of its length no longer moves anything.
const MOST_HALVINGS: usize = 40;

struct Iterate<Q, P, T, const U: usize> {
    q: Q,
    pose: P,
    residual: SVector<T, U>,
    /// The largest relative residual.
    size: T,
}

/// One step of Newton's method without damping: q with u - J^-1 Psi in place of u.
///
/// # Errors
/// [`Error::Singular`] where J has no inverse, [`Error::NotFinite`] if the step is not finite.
pub fn newton_step<T, M, const U: usize, const V: usize>(
    mechanism: &M,
    q: &M::Coordinates,
) -> Result<M::Coordinates, Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let pose = mechanism.pose_at(q);
    let step = mechanism.solve_jacobian(&pose, &mechanism.residual(&pose))?;
    Ok(M::with_unknowns(q, M::unknowns(q) - step))
}

/// The position near `guess` whose inputs are those of `guess`.
///
/// Steps are halved until the residual falls. The search ends at a residual that rounding explains,
/// after one more step that removes what the last one left.
///
/// # Errors
/// [`Error::NotConverged`] if the residual stays, [`Error::NotFinite`] if a number is not finite.
pub fn newton<T, M, const U: usize, const V: usize>(
    mechanism: &M,
    guess: &M::Coordinates,
) -> Result<Solution<M::Coordinates>, Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let enough = real::<T>(ROUNDINGS) * T::default_epsilon();
    let mut here = iterate(mechanism, *guess);
    if !here.size.is_finite() {
        return Err(Error::NotFinite { mechanism: M::NAME, quantity: "the residual" });
    }
    let start = mechanism.pose_at(guess);
    let mut iterations = 0;
    while iterations < MOST_ITERATIONS {
        let arrived = here.size <= enough;
        let step = match mechanism.solve_jacobian(&here.pose, &here.residual) {
            Ok(step) => step,
            Err(_) if arrived => break,
            Err(error) => return Err(failure::<M, T, U, V>(iterations, here.size, regularity(&error))),
        };
        let next = if arrived { iterate_at(mechanism, &here, step, T::one()) } else { damped(mechanism, &here, step) };
        // Within rounding a step may help or not; what is better stays.
        let Some(next) = next.filter(|next| next.size < here.size) else {
            if arrived {
                break;
            }
            return Err(failure::<M, T, U, V>(iterations, here.size, measure(mechanism, &here.pose)));
        };
        here = next;
        iterations += 1;
        if arrived {
            break;
        }
    }
    if here.size > enough {
        return Err(failure::<M, T, U, V>(iterations, here.size, measure(mechanism, &here.pose)));
    }
    Ok(Solution {
        coordinates: here.q,
        iterations,
        residual: to_f64(here.size),
        same_branch: mechanism.same_branch(&start, &here.pose),
    })
}

fn iterate<T: Real, M: Mechanism<T, U, V>, const U: usize, const V: usize>(
    mechanism: &M,
    q: M::Coordinates,
) -> Iterate<M::Coordinates, M::Pose, T, U> {
    let pose = mechanism.pose_at(&q);
    let residual = mechanism.residual(&pose);
    let sizes = mechanism.closure_sizes(&pose);
    let relative = residual.iter().zip(sizes.iter()).map(|(psi, size)| {
        // Nothing is left of a closure whose terms are all zero.
        if psi.is_zero() { T::zero() } else { psi.abs() / *size }
    });
    // A residual that is not a number must not be lost in a maximum.
    let size = relative.fold(T::zero(), |largest, psi| if psi <= largest { largest } else { psi });
    Iterate { q, pose, residual, size }
}

fn iterate_at<T: Real, M: Mechanism<T, U, V>, const U: usize, const V: usize>(
    mechanism: &M,
    from: &Iterate<M::Coordinates, M::Pose, T, U>,
    step: SVector<T, U>,
    fraction: T,
) -> Option<Iterate<M::Coordinates, M::Pose, T, U>> {
    let next = iterate(mechanism, M::with_unknowns(&from.q, M::unknowns(&from.q) - step * fraction));
    next.size.is_finite().then_some(next)
}

/// The longest of the steps 1, 1/2, 1/4, … that lowers the residual.
fn damped<T: Real, M: Mechanism<T, U, V>, const U: usize, const V: usize>(
    mechanism: &M,
    from: &Iterate<M::Coordinates, M::Pose, T, U>,
    step: SVector<T, U>,
) -> Option<Iterate<M::Coordinates, M::Pose, T, U>> {
    let mut fraction = T::one();
    for _ in 0..MOST_HALVINGS {
        let next = iterate_at(mechanism, from, step, fraction);
        if next.as_ref().is_some_and(|next| next.size < from.size) {
            return next;
        }
        fraction *= real::<T>(0.5);
    }
    None
}

fn failure<M: Mechanism<T, U, V>, T: Real, const U: usize, const V: usize>(
    iterations: usize,
    residual: T,
    regularity: f64,
) -> Error {
    Error::NotConverged { mechanism: M::NAME, iterations, residual: to_f64(residual), regularity }
}

fn regularity(error: &Error) -> f64 {
    match error {
        Error::Singular { regularity, .. } => *regularity,
        _ => 0.0,
    }
}

/// How regular J is, without a verdict: |det J| beside the product of the sizes of its columns.
fn measure<T: Real, M: Mechanism<T, U, V>, const U: usize, const V: usize>(mechanism: &M, pose: &M::Pose) -> f64 {
    let determinant = mechanism.determinant(pose);
    let jacobian = mechanism.jacobian_unknowns(pose);
    let product = jacobian.column_iter().fold(T::one(), |product, column| product * column.norm());
    if product > T::zero() { to_f64(determinant.abs() / product) } else { 0.0 }
}
