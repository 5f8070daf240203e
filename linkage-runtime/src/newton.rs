//! Newton's method: u <- u - J^-1 Psi, damped, with honest failure.

use nalgebra::{SMatrix, SVector};

use crate::scalar::{largest, relative, to_f64};
use crate::{Error, Real, real};

/// Newton steps before the search is given up; from a fair guess it takes four or five.
const MOST_ITERATIONS: usize = 60;

/// A residual of this many roundings of the sum of the magnitudes of its terms is zero.
const ROUNDINGS: f64 = 4.0;

/// Halvings of one step before it is given up: a step 2^-40 of its length no longer moves anything.
const MOST_HALVINGS: usize = 40;

/// Closures in some unknowns.
pub trait Closures<T: Real, const N: usize> {
    /// All that follows from values of the unknowns.
    type Point;
    /// What follows from these values.
    fn at(&self, unknowns: &SVector<T, N>) -> Self::Point;
    /// Psi, and the sum of the magnitudes of the terms of each closure.
    fn residual(&self, point: &Self::Point) -> (SVector<T, N>, SVector<T, N>);
    /// J^-1 `right`.
    fn solve(&self, point: &Self::Point, right: &SVector<T, N>) -> Result<SVector<T, N>, Error>;
    /// J, row by column.
    fn jacobian(&self, point: &Self::Point) -> SMatrix<T, N, N>;
    /// How regular J is, without a verdict.
    fn regularity(&self, point: &Self::Point) -> f64;
    /// The mechanism, and the group if it is one alone.
    fn names(&self) -> (&'static str, Option<&'static str>);
}

/// Where a search is or ends.
pub struct Iterate<P, T, const N: usize> {
    pub unknowns: SVector<T, N>,
    pub point: P,
    residual: SVector<T, N>,
    /// The largest relative residual; not finite if a number of the iterate is not.
    pub size: T,
}

/// What a search finds from `start`, and the steps it took.
///
/// Steps are halved until the residual falls. The search ends at a residual that rounding explains,
/// after one more step that removes what the last one left.
pub fn search<T: Real, C: Closures<T, N>, const N: usize>(
    closures: &C,
    start: SVector<T, N>,
) -> Result<(Iterate<C::Point, T, N>, usize), Error> {
    let enough = real::<T>(ROUNDINGS) * T::default_epsilon();
    let mut here = iterate(closures, start);
    if !here.size.is_finite() {
        return Err(Error::NotFinite { mechanism: closures.names().0, quantity: "the residual" });
    }
    let mut iterations = 0;
    while iterations < MOST_ITERATIONS {
        let arrived = here.size <= enough;
        let step = match closures.solve(&here.point, &here.residual) {
            Ok(step) => step,
            Err(_) if arrived => break,
            Err(error) => return Err(failure(closures, iterations, here.size, &error)),
        };
        let next = if arrived { iterate_at(closures, &here, step) } else { damped(closures, &here, step) };
        // Within rounding a step may help or not; what is better stays.
        let Some(next) = next.filter(|next| next.size < here.size) else { break };
        here = next;
        iterations += 1;
        if arrived {
            break;
        }
    }
    if here.size <= enough || is_rounding(closures, &here, &start) {
        Ok((here, iterations))
    } else {
        Err(stopped(closures, iterations, &here))
    }
}

/// True if what is left of Psi is what one rounding error of unknowns as large as at the start leaves, |Psi| <= epsilon
/// |J| |u|: the sine of an angle of many turns is known better than the angle.
fn is_rounding<T: Real, C: Closures<T, N>, const N: usize>(
    closures: &C,
    at: &Iterate<C::Point, T, N>,
    start: &SVector<T, N>,
) -> bool {
    let (_, sizes) = closures.residual(&at.point);
    let of_unknowns = closures.jacobian(&at.point).abs() * start.abs();
    let enough = sizes * real::<T>(ROUNDINGS);
    let bounds = of_unknowns.zip_map(&enough, |one, other| if one > other { one } else { other });
    at.residual.iter().zip(&bounds).all(|(psi, bound)| bound.is_finite() && psi.abs() <= *bound * T::default_epsilon())
}

fn iterate<T: Real, C: Closures<T, N>, const N: usize>(
    closures: &C,
    unknowns: SVector<T, N>,
) -> Iterate<C::Point, T, N> {
    let point = closures.at(&unknowns);
    let (residual, sizes) = closures.residual(&point);
    let residuals = residual.iter().zip(sizes.iter()).map(|(&psi, &size)| relative(psi, size));
    // A residual may be finite at infinite unknowns, too.
    let unknown = unknowns.iter().map(|&unknown| unknown * T::zero());
    let size = largest(residuals.chain(unknown));
    Iterate { unknowns, point, residual, size }
}

fn iterate_at<T: Real, C: Closures<T, N>, const N: usize>(
    closures: &C,
    from: &Iterate<C::Point, T, N>,
    step: SVector<T, N>,
) -> Option<Iterate<C::Point, T, N>> {
    let next = iterate(closures, from.unknowns - step);
    next.size.is_finite().then_some(next)
}

/// The longest of the steps 1, 1/2, 1/4, … that lowers the residual.
fn damped<T: Real, C: Closures<T, N>, const N: usize>(
    closures: &C,
    from: &Iterate<C::Point, T, N>,
    step: SVector<T, N>,
) -> Option<Iterate<C::Point, T, N>> {
    let mut fraction = T::one();
    for _ in 0..MOST_HALVINGS {
        let next = iterate_at(closures, from, step * fraction);
        if next.as_ref().is_some_and(|next| next.size < from.size) {
            return next;
        }
        fraction *= real::<T>(0.5);
    }
    None
}

/// A search that ends where J has no inverse.
fn failure<T: Real, C: Closures<T, N>, const N: usize>(closures: &C, iterations: usize, size: T, why: &Error) -> Error {
    let (mechanism, _) = closures.names();
    match *why {
        Error::Singular { group, regularity, .. } => {
            Error::NotConverged { mechanism, group: Some(group), iterations, residual: to_f64(size), regularity }
        }
        other => other,
    }
}

fn stopped<T: Real, C: Closures<T, N>, const N: usize>(
    closures: &C,
    iterations: usize,
    at: &Iterate<C::Point, T, N>,
) -> Error {
    let (mechanism, group) = closures.names();
    let (residual, regularity) = (to_f64(at.size), closures.regularity(&at.point));
    Error::NotConverged { mechanism, group, iterations, residual, regularity }
}
