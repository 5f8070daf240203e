//! Impacts: what reaches a stop goes back with its part of the rate.
//!
//! Newton's law: of contacts that meet their stops s'+ = -e s'-, by impulses that push only; what rests on a stop at that
//! moment takes part and is not pushed through it: v'+ = v'- + M^-1 S' p, with p >= 0, S v'+ + e S v'- >= 0 and one of
//! the two zero for each. **Impulses of friction are neglected**: what sticks may begin to slip at an impact.

use nalgebra::SVector;

use super::bounded::{Bounds, bounded};
use super::held::Response;
use super::reduced::ReducedEquations;
use linkage_runtime::{Error, Real, real};

/// A stop that takes part in an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Struck<T> {
    /// 1 at the lower, -1 at the upper stop.
    pub inward: T,
    /// The part of its rate that is given back.
    pub restitution: T,
}

/// The rates v' after the impact, and the impulse of each stop.
///
/// # Errors
/// [`Error::NoContactForces`] if a prescribed motion drives through a stop.
pub(super) fn impact<T: Real, const V: usize, const C: usize>(
    equations: &ReducedEquations<T, V, C>,
    struck: &[Option<Struck<T>>; C],
) -> Result<(SVector<T, V>, [T; C]), Error> {
    let response = Response::new(equations, &[T::zero(); C], |place| struck[place].is_some())?;
    // Every row looks inward.
    let mut matrix = response.matrix;
    for (place, struck) in struck.iter().enumerate() {
        let inward = struck.map_or(T::zero(), |struck| struck.inward);
        matrix.row_mut(place).scale_mut(inward);
        matrix.column_mut(place).scale_mut(inward);
    }
    let bounds = core::array::from_fn(|place| {
        let Struck { inward, restitution } = struck[place]?;
        let (rate, size) = equations.contacts[place].rate(&equations.rates);
        let share = T::one() + restitution;
        Some(Bounds { lower: T::zero(), upper: real(f64::INFINITY), bias: (rate * inward * share, size * share) })
    });
    let solution = bounded(&matrix, &bounds)
        .map_err(|place| Error::NoContactForces { scene: equations.scene, contact: equations.contacts[place].name })?;
    let mut rates = equations.rates;
    for (place, struck) in struck.iter().enumerate() {
        if let Some(Struck { inward, .. }) = struck {
            rates += response.columns.column(place) * (solution.forces[place] * *inward);
        }
    }
    Ok((rates, solution.forces))
}
