//! Newton's method: u <- u - J^-1 Psi, damped, with honest failure.

use crate::jacobian::rounding::{CLOSED, roundings};
use crate::scalar::arithmetic::*;
use crate::scalar::{largest, relative, to_f64};
use crate::{Column, Dim, Matrix, PositionError, Real, real};

/// Newton steps before the search is given up; from a fair guess it takes four or five.
const MOST_ITERATIONS: usize = 60;

/// Halvings of one step before it is given up: a step 2^-40 of its length no longer moves anything.
const MOST_HALVINGS: usize = 40;

/// Closures in some unknowns.
pub trait Closures {
    /// The number that an unknown is.
    type Scalar: Real;
    /// The number of unknowns.
    type N: Dim;
    /// All that follows from values of the unknowns.
    type Point;
    /// What follows from these values.
    fn at(&self, unknowns: &Unknowns<Self>) -> Self::Point;
    /// Psi, and the sum of the magnitudes of the terms of each closure.
    fn residual(&self, point: &Self::Point) -> (Unknowns<Self>, Unknowns<Self>);
    /// J^-1 `right`.
    fn solve(&self, point: &Self::Point, right: &Unknowns<Self>) -> Result<Unknowns<Self>, PositionError>;
    /// J, row by column.
    fn jacobian(&self, point: &Self::Point) -> Matrix<Self::Scalar, Self::N, Self::N>;
    /// How regular J is, without a verdict.
    fn regularity(&self, point: &Self::Point) -> f64;
    /// The mechanism, and the group if it is one alone.
    fn names(&self) -> (&'static str, Option<&'static str>);
}

/// A number for each unknown or closure.
type Unknowns<C> = Column<<C as Closures>::Scalar, <C as Closures>::N>;

/// Where a search is or ends.
pub struct Iterate<C: Closures + ?Sized> {
    /// The unknowns.
    pub unknowns: Unknowns<C>,
    /// All that follows from them.
    pub point: C::Point,
    residual: Unknowns<C>,
    /// The largest relative residual; not finite if a number of the iterate is not.
    pub size: C::Scalar,
}

/// What a search finds from `start`, and the steps it took.
///
/// Steps are halved until the residual falls. The search ends at a residual that rounding explains,
/// after one more step that removes what the last one left.
pub fn search<C: Closures>(closures: &C, start: Unknowns<C>) -> Result<(Iterate<C>, usize), PositionError> {
    let enough = roundings::<C::Scalar>(CLOSED);
    let mut here = iterate(closures, start);
    if !here.size.is_finite() {
        return Err(PositionError::NotFinite { mechanism: closures.names().0, quantity: "the residual" });
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
fn is_rounding<C: Closures>(closures: &C, at: &Iterate<C>, start: &Unknowns<C>) -> bool {
    let (_, sizes) = closures.residual(&at.point);
    let of_unknowns = closures.jacobian(&at.point).abs() * start.abs();
    let enough = sizes * real::<C::Scalar>(CLOSED);
    let bounds = of_unknowns.zip_map(&enough, |one, other| if one > other { one } else { other });
    at.residual
        .iter()
        .zip(&bounds)
        .all(|(psi, bound)| bound.is_finite() && psi.abs() <= *bound * C::Scalar::default_epsilon())
}

fn iterate<C: Closures>(closures: &C, unknowns: Unknowns<C>) -> Iterate<C> {
    let point = closures.at(&unknowns);
    let (residual, sizes) = closures.residual(&point);
    let residuals = residual.iter().zip(sizes.iter()).map(|(&psi, &size)| relative(psi, size));
    // A residual may be finite at infinite unknowns, too.
    let unknown = unknowns.iter().map(|&unknown| unknown * C::Scalar::zero());
    let size = largest(residuals.chain(unknown));
    Iterate { unknowns, point, residual, size }
}

fn iterate_at<C: Closures>(closures: &C, from: &Iterate<C>, step: Unknowns<C>) -> Option<Iterate<C>> {
    let next = iterate(closures, from.unknowns - step);
    next.size.is_finite().then_some(next)
}

/// The longest of the steps 1, 1/2, 1/4, … that lowers the residual.
fn damped<C: Closures>(closures: &C, from: &Iterate<C>, step: Unknowns<C>) -> Option<Iterate<C>> {
    let mut fraction = C::Scalar::one();
    for _ in 0..MOST_HALVINGS {
        let next = iterate_at(closures, from, step * fraction);
        if next.as_ref().is_some_and(|next| next.size < from.size) {
            return next;
        }
        fraction *= real::<C::Scalar>(0.5);
    }
    None
}

/// A search that ends where J has no inverse.
fn failure<C: Closures>(closures: &C, iterations: usize, size: C::Scalar, why: &PositionError) -> PositionError {
    let (mechanism, _) = closures.names();
    match *why {
        PositionError::Singular { group, regularity, .. } => PositionError::NotConverged {
            mechanism,
            group: Some(group),
            iterations,
            residual: to_f64(size),
            regularity,
        },
        other => other,
    }
}

fn stopped<C: Closures>(closures: &C, iterations: usize, at: &Iterate<C>) -> PositionError {
    let (mechanism, group) = closures.names();
    let (residual, regularity) = (to_f64(at.size), closures.regularity(&at.point));
    PositionError::NotConverged { mechanism, group, iterations, residual, regularity }
}
