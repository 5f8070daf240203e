//! The guess of a position between two steps.

use super::Driven;
use super::follow::Step;
use crate::same_position::SamePosition;
use crate::scalar::arithmetic::*;
use crate::{PerInput, real};

/// Steps that are more regular than this at both ends are no near miss.
const REGULAR: f64 = 1e-2;

/// The least rate of the parameter by the arc length at which positions are interpolated by the parameter.
const LEAST_RATE: f64 = 1.0 / 8.0;

/// A guess and the position that it stands for differ by less than this part of the step.
const SLACK: f64 = 1.0 / 64.0;

/// The cubic by the parameter between two steps, through both with their tangents; none next to singular positions, where
/// it is no guess.
pub(super) fn guess<M: Driven>(
    same: &SamePosition<M>,
    [before, after]: [&Step<M>; 2],
    parameter: M::Scalar,
) -> Option<M::Coordinates> {
    let is_regular = |step: &Step<M>| {
        let rate = same.input_in_units(M::rate_parts(&step.rates).1[0]);
        step.passed.is_none() && step.regularity > real(REGULAR) && rate > real(LEAST_RATE)
    };
    if !(is_regular(before) && is_regular(after)) {
        return None;
    }
    let width = after.input() - before.input();
    let x = (parameter - before.input()) / width;
    let y = M::Scalar::one() - x;
    let [p, s] = [before, after].map(|step| M::unknowns(&step.position));
    // The derivatives by x.
    let [p_slope, s_slope] = [before, after].map(|step| {
        let (unknowns, parameter) = M::rate_parts(&step.rates);
        unknowns * (width / parameter[0])
    });
    let [three, third] = [3.0, 1.0 / 3.0].map(real::<M::Scalar>);
    let (q, r) = (p + p_slope * third, s - s_slope * third);
    let unknowns = p * (y * y * y) + q * (three * x * y * y) + r * (three * x * x * y) + s * (x * x * x);
    Some(M::coordinates(unknowns, PerInput::<M>::from([parameter])))
}

/// True if a position is on the arc between two steps of which it is a guess: another motion is farther, as both steps are
/// regular and the tangent turns little between them.
pub(super) fn is_between<M: Driven>(
    same: &SamePosition<M>,
    [before, after]: [&Step<M>; 2],
    guess: &M::Coordinates,
    position: &M::Coordinates,
) -> bool {
    same.way(guess, position) <= same.way(&before.position, &after.position) * real(SLACK)
}
