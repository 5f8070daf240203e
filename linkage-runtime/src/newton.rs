//! Damped Newton's method, u <- u - J^-1 Psi, which returns an error if it does not converge.

use crate::bounded::{exact, has_bound, lost, unknown};
use crate::jacobian::ulp::{ZERO_ULPS, ulps};
use crate::scalar::arithmetic::*;
use crate::scalar::{largest, relative, to_f64};
use crate::{Column, Dim, Matrix, Name, PositionError, Real, real};

/// The most Newton steps of a search; from a good guess it takes four or five.
const MOST_ITERATIONS: usize = 60;

/// The most halvings of one step: 2^-40 of a step no longer changes the unknowns.
const MOST_HALVINGS: usize = 40;

/// A system of constraints Psi(u) = 0.
pub trait Constraints {
    /// The type of an unknown.
    type Scalar: Real;
    /// The type of the names in errors.
    type Name: Name;
    /// The number of unknowns.
    type N: Dim;
    /// The quantities computed from values of the unknowns.
    type Point;
    /// Computes these quantities.
    fn at(&self, unknowns: &Unknowns<Self>) -> Self::Point;
    /// Psi, and the sum of the magnitudes of the terms of each constraint.
    fn residual(&self, point: &Self::Point) -> (Unknowns<Self>, Unknowns<Self>);
    /// J^-1 `right`.
    fn solve(&self, point: &Self::Point, right: &Unknowns<Self>) -> Result<Unknowns<Self>, PositionError<Self::Name>>;
    /// J, row by column.
    fn jacobian(&self, point: &Self::Point) -> Matrix<Self::Scalar, Self::N, Self::N>;
    /// The regularity of J, for error messages.
    fn regularity(&self, point: &Self::Point) -> f64;
    /// The name of the mechanism, and of the group if only one is solved.
    fn names(&self) -> (Self::Name, Option<Self::Name>);
}

/// A number for each unknown or constraint.
type Unknowns<C> = Column<<C as Constraints>::Scalar, <C as Constraints>::N>;

/// An iterate of a search.
pub struct Iterate<C: Constraints + ?Sized> {
    /// The unknowns.
    pub unknowns: Unknowns<C>,
    /// The quantities computed from them.
    pub point: C::Point,
    residual: Unknowns<C>,
    /// The largest relative residual; not finite if a number of the iterate is not.
    pub size: C::Scalar,
}

/// Searches for a solution near `start`; returns it with the number of steps taken.
///
/// Steps are halved until the residual decreases. The search ends at a residual within rounding error, after one more
/// step that reduces it further.
pub fn search<C: Constraints>(
    constraints: &C,
    start: Unknowns<C>,
) -> Result<(Iterate<C>, usize), PositionError<C::Name>> {
    let enough = ulps::<C::Scalar>(ZERO_ULPS);
    let mut here = iterate(constraints, start);
    if !here.size.is_finite() {
        return Err(PositionError::NotFinite {
            mechanism: constraints.names().0,
            quantity: Name::from_static("the residual"),
        });
    }
    let mut iterations = 0;
    while iterations < MOST_ITERATIONS {
        let arrived = here.size <= enough;
        let step = match constraints.solve(&here.point, &here.residual) {
            Ok(step) => step,
            Err(_) if arrived => break,
            Err(error) => return Err(failure(constraints, iterations, here.size, error)),
        };
        let next = if arrived { iterate_at(constraints, &here, step) } else { damped(constraints, &here, step) };
        // Within rounding error a step may not reduce the residual; the better iterate is kept.
        let Some(next) = next.filter(|next| next.size < here.size) else { break };
        here = next;
        iterations += 1;
        if arrived {
            break;
        }
    }
    if here.size <= enough || is_rounding_error(constraints, &here, &start) {
        if has_bound::<C::Scalar>() {
            here.unknowns = enclosed(constraints, here.unknowns);
        }
        Ok((here, iterations))
    } else {
        Err(stopped(constraints, iterations, &here))
    }
}

/// True if |Psi| <= epsilon |J| |u|, u at the start: the residual is that of one rounding error of the unknowns. An
/// angle of many turns is less accurate than its sine.
fn is_rounding_error<C: Constraints>(constraints: &C, at: &Iterate<C>, start: &Unknowns<C>) -> bool {
    let (_, scales) = constraints.residual(&at.point);
    let of_unknowns = constraints.jacobian(&at.point).abs() * start.abs();
    let enough = scales * real::<C::Scalar>(ZERO_ULPS);
    let bounds = of_unknowns.zip_map(&enough, |one, other| if one > other { one } else { other });
    at.residual
        .iter()
        .zip(&bounds)
        .all(|(psi, bound)| bound.is_finite() && psi.abs() <= *bound * C::Scalar::default_epsilon())
}

/// The values of a scalar with a bound, off by what the solution may be away: by the mean value theorem u - u* =
/// J^-1 Psi(u) with J between u and u*. That J is covered by the one of a box of twice the first step about u. Nothing is
/// known if J may be singular there.
fn enclosed<C: Constraints>(constraints: &C, unknowns: Unknowns<C>) -> Unknowns<C> {
    let values = unknowns.map(exact);
    let point = constraints.at(&values);
    let (residual, _) = constraints.residual(&point);
    let step_at = |point: &C::Point| constraints.solve(point, &residual);
    let twice = |value: C::Scalar, step: C::Scalar| value - lost(step + step);
    let of_box = step_at(&point).and_then(|step| step_at(&constraints.at(&values.zip_map(&step, twice))));
    match of_box {
        Ok(step) => values.zip_map(&step, |value, step| value - lost(step)),
        Err(_) => values.map(unknown),
    }
}

fn iterate<C: Constraints>(constraints: &C, unknowns: Unknowns<C>) -> Iterate<C> {
    let point = constraints.at(&unknowns);
    let (residual, scales) = constraints.residual(&point);
    let residuals = residual.iter().zip(scales.iter()).map(|(&psi, &size)| relative(psi, size));
    // A residual may be finite although an unknown is infinite.
    let unknown = unknowns.iter().map(|&unknown| unknown * C::Scalar::zero());
    let size = largest(residuals.chain(unknown));
    Iterate { unknowns, point, residual, size }
}

fn iterate_at<C: Constraints>(constraints: &C, from: &Iterate<C>, step: Unknowns<C>) -> Option<Iterate<C>> {
    let next = iterate(constraints, from.unknowns - step);
    next.size.is_finite().then_some(next)
}

/// The longest of the steps 1, 1/2, 1/4, … that reduces the residual.
fn damped<C: Constraints>(constraints: &C, from: &Iterate<C>, step: Unknowns<C>) -> Option<Iterate<C>> {
    let mut fraction = C::Scalar::one();
    for _ in 0..MOST_HALVINGS {
        let next = iterate_at(constraints, from, step * fraction);
        if next.as_ref().is_some_and(|next| next.size < from.size) {
            return next;
        }
        fraction *= real::<C::Scalar>(0.5);
    }
    None
}

/// The error of a search that ends where J is singular.
fn failure<C: Constraints>(
    constraints: &C,
    iterations: usize,
    size: C::Scalar,
    why: PositionError<C::Name>,
) -> PositionError<C::Name> {
    let (mechanism, _) = constraints.names();
    match why {
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

fn stopped<C: Constraints>(constraints: &C, iterations: usize, at: &Iterate<C>) -> PositionError<C::Name> {
    let (mechanism, group) = constraints.names();
    let (residual, regularity) = (to_f64(at.size), constraints.regularity(&at.point));
    PositionError::NotConverged { mechanism, group, iterations, residual, regularity }
}
