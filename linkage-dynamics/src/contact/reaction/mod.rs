//! Friction by the reaction of its joint: |f| <= c |R|, where R depends on the accelerations and on all contact forces,
//! its own friction included.
//!
//! With z'' eliminated, R = r + P f ([`problem`]). In given modes the held contacts are eliminated ([`family`]), and the
//! forces of slipping bearings are the solutions of t = c |r + P t| ([`slip`]). At rest all combinations of modes are
//! enumerated ([`choice`]). A locked mechanism with redundant contacts only needs admissible forces ([`admissible`]).
//! Where no acceleration or several satisfy every law, as in Painleve's paradox, the error names a contact.

mod admissible;
mod bearing;
mod choice;
mod family;
mod linear;
mod problem;
mod search;
mod slip;

pub(crate) use bearing::Reduction;
pub use bearing::{Bearing, ReactionRow, ReducedBearing, ReducedReaction};

use super::held::Held as HeldContacts;
use super::state::ContactMotion;
use super::{ContactLaw, Mode, ReducedEquations};
use crate::MotionError;
use admissible::{Existence, Held};
use family::Family;
use linkage_runtime::{Column, Dim, Real, real};
use problem::Problem;
use search::Budget;

/// The limit on updates of slipping forces that depend on the forces of redundant contacts.
const MOST_UPDATES: usize = 40;

/// The reason why no motion is chosen, with the name of a contact.
#[derive(Debug, Clone, Copy)]
enum Failure {
    NoMotion(&'static str),
    Several(&'static str),
    Undecided(&'static str),
}

impl Failure {
    fn of(self, scene: &'static str) -> MotionError {
        match self {
            Self::NoMotion(contact) => MotionError::NoMotion { scene, contact, t: None },
            Self::Several(contact) => MotionError::SeveralMotions { scene, contact, t: None },
            Self::Undecided(contact) => MotionError::UndecidedMotion { scene, contact, t: None },
        }
    }
}

/// The forces in given modes.
struct InModes<T: Real, C: Dim> {
    forces: Column<T, C>,
    /// False where other forces give the same motion.
    are_unique: bool,
    /// The forces of held contacts are within their bounds; None if each is to be compared with its own.
    are_admissible: Option<bool>,
}

/// Chooses the modes of the contacts at rest.
///
/// # Errors
/// [`MotionError::NoMotion`], [`MotionError::SeveralMotions`], [`MotionError::UndecidedMotion`]; those of the mass
/// matrix.
pub(super) fn choose<T: Real, V: Dim, C: Dim>(
    equations: &ReducedEquations<T, V, C>,
    modes: &Column<Mode, C>,
    at_rest: &Column<Option<Mode>, C>,
) -> Result<Column<Mode, C>, MotionError> {
    let problem = Problem::new(equations)?;
    choice::choose(&problem, modes, at_rest).map_err(|failure| failure.of(equations.scene))
}

/// Computes the accelerations and forces in these modes.
///
/// # Errors
/// Those of [`choose`].
pub(super) fn motion<T: Real, V: Dim, C: Dim>(
    equations: &ReducedEquations<T, V, C>,
    modes: &Column<Mode, C>,
) -> Result<ContactMotion<T, V, C>, MotionError> {
    let problem = Problem::new(equations)?;
    let InModes { forces, are_unique, .. } =
        in_modes(&problem, modes).map_err(|failure| failure.of(equations.scene))?;
    let moving = Column::from_fn(|place| if modes[place].is_held() { T::zero() } else { forces[place] });
    let acceleration = HeldContacts::with_forces(equations, modes, &moving)?.acceleration(equations);
    Ok(ContactMotion { acceleration, forces, are_unique })
}

/// The distances of the forces of held contacts from their bounds, with their rounding errors added. Where held contacts
/// are redundant: 1 if admissible forces were found, else -1.
///
/// # Errors
/// Those of [`choose`].
pub(super) fn margins<T: Real, V: Dim, C: Dim>(
    equations: &ReducedEquations<T, V, C>,
    modes: &Column<Mode, C>,
) -> Result<Column<T, C>, MotionError> {
    let problem = Problem::new(equations)?;
    let found = in_modes(&problem, modes).map_err(|failure| failure.of(equations.scene))?;
    let forces = &found.forces;
    Ok(Column::from_fn(|place| match found.are_admissible {
        _ if !modes[place].is_held() => T::one(),
        Some(are_admissible) => real(if are_admissible { 1.0 } else { -1.0 }),
        None => problem.margin(place, modes[place], forces) + problem.force_tolerance(place, forces),
    }))
}

fn in_modes<T: Real, V: Dim, C: Dim>(
    problem: &Problem<'_, T, V, C>,
    modes: &Column<Mode, C>,
) -> Result<InModes<T, C>, Failure> {
    let mut budget = Budget::new();
    let family = Family::new(problem, modes);
    let held = Held { problem, modes, is_bounded: modes.map(Mode::is_held) };
    let is_redundant = family.spares > 0;
    if is_redundant && family.is_coupled(problem) {
        if !family.is_still(problem) {
            return Err(Failure::Undecided(problem.strongest()));
        }
        let found = in_family(&held, &family, &mut budget);
        let are_admissible = Some(found.is_some() && family.is_consistent);
        return Ok(InModes { forces: found.unwrap_or(family.base), are_unique: false, are_admissible });
    }
    let roots = family.slips(problem).solve(&mut budget);
    let root = match roots.as_slice() {
        _ if !roots.is_complete => return Err(Failure::Undecided(problem.strongest())),
        [] => return Err(Failure::NoMotion(problem.strongest())),
        [root] => root,
        [root, ..] if family.is_still(problem) => root,
        _ => return Err(Failure::Several(problem.strongest())),
    };
    let are_unique = !is_redundant && roots.as_slice().len() == 1;
    let family = family.with_slips(root);
    if !is_redundant {
        return Ok(InModes { forces: family.base, are_unique, are_admissible: None });
    }
    let found = match held.admissible(&family, &mut budget) {
        Existence::Found(forces) if family.is_consistent => Some(forces),
        _ => None,
    };
    Ok(InModes { forces: found.unwrap_or(family.base), are_unique, are_admissible: Some(found.is_some()) })
}

/// The bearings that slip in these modes.
fn slipping_within<T: Real, V: Dim, C: Dim>(
    problem: &Problem<'_, T, V, C>,
    modes: &Column<Mode, C>,
) -> Column<bool, C> {
    Column::from_fn(|place| {
        let is_bearing = matches!(problem.equations.contacts[place].law, ContactLaw::Bearing { .. });
        is_bearing && matches!(modes[place], Mode::SlipForward | Mode::SlipBackward)
    })
}

/// Forces within their bounds where the slipping forces depend on those of redundant contacts: both are updated until
/// they repeat.
fn in_family<T: Real, V: Dim, C: Dim>(
    held: &Held<'_, T, V, C>,
    family: &Family<T, C>,
    budget: &mut Budget,
) -> Option<Column<T, C>> {
    let is_slipping = slipping_within(held.problem, held.modes);
    let magnitudes = |forces: &Column<T, C>| {
        let places = (0..C::COUNT).filter(|&place| is_slipping[place]);
        Column::<T, C>::from_iterator(places.map(|place| held.problem.limit(place, forces)))
    };
    let mut slips = magnitudes(&family.base);
    for _ in 0..MOST_UPDATES {
        let Existence::Found(forces) = held.admissible(&family.with_slips(&slips), budget) else { return None };
        let next = magnitudes(&forces);
        let change = (next - slips).largest();
        if change <= real::<T>(16.0) * T::default_epsilon() * next.largest() {
            return Some(forces);
        }
        slips = next;
    }
    None
}
