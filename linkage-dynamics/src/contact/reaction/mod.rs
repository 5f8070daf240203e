//! Friction by the reaction of its joint: |f| <= c |R|, where R depends on the accelerations and on all contact forces,
//! its own friction included.
//!
//! With `z''` eliminated, R = r + P f ([`problem`]). In given modes the held contacts are eliminated ([`family`]), and the
//! forces of slipping bearings are the solutions of t = c |r + P t| ([`slip`]). At rest all combinations of modes are
//! enumerated ([`choice`]). A locked mechanism with redundant contacts only needs admissible forces ([`admissible`]).
//! There may be no acceleration that satisfies every law, or several, as in Painleve's paradox: then the result is an
//! error that names a contact.

mod admissible;
mod budget;
mod choice;
mod family;
mod modes;
mod path;
mod problem;
mod search;
mod slip;
#[cfg(test)]
mod tests;

use super::held::Held;
use super::motion::ContactMotion;
use super::tolerance::held_tolerance;
use super::{Mode, ReducedEquations};
use crate::MotionError;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real};
use modes::{InModes, in_modes, limits_in};
use problem::Problem;

/// Chooses the modes of the contacts at rest.
///
/// # Errors
/// [`MotionError::NoMotion`], [`MotionError::SeveralMotions`], [`MotionError::UndecidedMotion`]; those of the mass
/// matrix.
pub(super) fn choose<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    equations: &ReducedEquations<T, V, C, N>,
    modes: &Column<Mode, C>,
    at_rest: &Column<Option<Mode>, C>,
) -> Result<Column<Mode, C>, MotionError<N>> {
    let problem = Problem::new(equations)?;
    choice::choose(&problem, modes, at_rest).map_err(|failure| failure.of(equations.scene))
}

/// Computes the accelerations and forces in these modes.
///
/// # Errors
/// Those of [`choose`].
pub(super) fn motion<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    equations: &ReducedEquations<T, V, C, N>,
    modes: &Column<Mode, C>,
) -> Result<ContactMotion<T, V, C>, MotionError<N>> {
    let problem = Problem::new(equations)?;
    let InModes { forces, are_unique, .. } =
        in_modes(&problem, modes).map_err(|failure| failure.of(equations.scene))?;
    let moving = modes.dim().column(|place| if modes[place].is_held() { T::zero() } else { forces[place] });
    let acceleration = Held::with_forces(equations, modes, &moving)?.acceleration(equations);
    Ok(ContactMotion { acceleration, forces, are_unique })
}

/// The margin of each held contact: how much its force can change before the contact slips. The rounding error is added,
/// so that a force at its bound has a margin of zero or more.
///
/// The forces of redundant held contacts are not unique. They have the margins of the motions that could begin; the limits
/// of each are those at the forces of its own slip. A margin is negative if and only if no admissible forces were found.
///
/// # Errors
/// Those of [`choose`].
pub(super) fn margins<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    equations: &ReducedEquations<T, V, C, N>,
    modes: &Column<Mode, C>,
) -> Result<Column<T, C>, MotionError<N>> {
    let problem = Problem::new(equations)?;
    let found = in_modes(&problem, modes).map_err(|failure| failure.of(equations.scene))?;
    let forces = &found.forces;
    let Some(are_admissible) = found.are_admissible else {
        return Ok(modes.dim().column(|place| {
            let mode = modes[place];
            if !mode.is_held() {
                return T::one();
            }
            problem.margin(place, mode, forces) + problem.force_tolerance(place, forces)
        }));
    };
    let moving = modes.dim().column(|place| if modes[place].is_held() { T::zero() } else { forces[place] });
    let held = Held::with_forces(equations, modes, &moving)?;
    let margins = held.margins_by(modes, |rates| limits_in(&problem, modes, rates, forces));
    let least = -held_tolerance::<T>();
    Ok(modes.dim().column(|place| match margins[place] {
        _ if !modes[place].is_held() => T::one(),
        margin if are_admissible => margin.max(T::zero()),
        margin => margin.min(least),
    }))
}
