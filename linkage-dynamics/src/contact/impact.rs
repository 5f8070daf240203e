//! Impacts by Newton's law of restitution, s'+ = -e s'-.
//!
//! v'+ = v'- + M^-1 S' p, where for each stop the impulse p >= 0, S v'+ + e S v'- >= 0, and one of the two is zero; S
//! points away from the stop. Stops that are closed at that time take part with e = 0. **Impulses of friction are
//! neglected**: a sticking contact may begin to slip at an impact.

use super::bounded::{Bounds, bounded};
use super::held::Response;
use super::reduced::ReducedEquations;
use crate::MotionError;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

/// A stop that takes part in an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Struck<T> {
    /// The direction of s away from the stop: 1 at the lower, -1 at the upper stop.
    pub inward: T,
    /// The coefficient of restitution.
    pub restitution: T,
}

impl<T: Real> Struck<T> {
    /// The bounds of the force of a stop on which s rests, with `s''` and the size of its terms.
    pub fn presses(self, bias: (T, T)) -> Bounds<T> {
        let endless = real(f64::INFINITY);
        let [lower, upper] = if self.inward > T::zero() { [T::zero(), endless] } else { [-endless, T::zero()] };
        Bounds { lower, upper, bias }
    }
}

/// The result of an impact.
pub(super) struct After<T: Real, V: Dim, C: Dim> {
    /// v'.
    pub rates: Column<T, V>,
    /// The impulse of each stop.
    pub impulses: Column<T, C>,
    /// The size of what the impulses change in the rate of each stop that takes part: no term of it is larger.
    pub changes: Column<T, C>,
}

/// Computes the rates v' after the impact and the impulse of each stop.
///
/// # Errors
/// [`MotionError::NoContactForces`] if a prescribed motion drives through a stop.
pub(super) fn impact<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    equations: &ReducedEquations<T, V, C, N>,
    struck: &Column<Option<Struck<T>>, C>,
) -> Result<After<T, V, C>, MotionError<N>> {
    let response = Response::new(equations, &struck.dim().zeros(), |place| struck[place].is_some())?;
    // All rows are oriented inward.
    let inward = struck.map(|struck| struck.map_or(T::zero(), |struck| struck.inward));
    let matrix =
        struck.dim().matrix(struck.dim(), |row, column| response.matrix[(row, column)] * inward[row] * inward[column]);
    let bounds = struck.dim().column(|place| {
        let Struck { inward, restitution } = struck[place]?;
        let (rate, size) = equations.contacts[place].rate(&equations.rates);
        let factor = T::one() + restitution;
        Some(Bounds { lower: T::zero(), upper: real(f64::INFINITY), bias: (rate * inward * factor, size * factor) })
    });
    let solution = bounded(&matrix, &bounds).map_err(|place| MotionError::NoContactForces {
        scene: equations.scene,
        contact: equations.contacts[place].name,
    })?;
    let mut rates = equations.rates;
    for (place, struck) in struck.iter().enumerate() {
        if let Some(Struck { inward, .. }) = struck {
            rates += response.columns.column(place) * (solution.forces[place] * *inward);
        }
    }
    // By the inequality of Cauchy and Schwarz with the product of M: the impulse p_j changes the rate of stop k by at most
    // sqrt(R_kk) sqrt(R_jj) p_j, where R = S M^-1 S'.
    let own = struck.dim().column(|place| response.matrix[(place, place)].abs().sqrt());
    let changes = own.iter().zip(&solution.forces).fold(T::zero(), |sum, (own, force)| sum + *own * force.abs());
    Ok(After { rates, impulses: solution.forces, changes: own.map(|own| own * changes) })
}
