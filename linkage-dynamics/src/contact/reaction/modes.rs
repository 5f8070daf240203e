//! The forces in given modes, where the slipping ones depend on those of held contacts.

use super::admissible::{Existence, HeldForces};
use super::budget::Budget;
use super::family::Family;
use super::problem::Problem;
use crate::MotionError;
use crate::contact::motion::nearer;
use crate::contact::tolerance::{is_negligible, sum_tolerance};
use crate::contact::{ContactLaw, Mode};
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

/// The limit on updates of slipping forces that depend on the forces of redundant contacts.
const MOST_UPDATES: usize = 40;

/// The forces of redundant contacts at which slipping forces are sampled, divided by their scale.
const SAMPLES: [f64; 12] = [0.0, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 2.0, 5.0, 20.0, 100.0, 1e6];

/// The reason why no motion is chosen, with the name of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) enum Failure<N> {
    NoMotion(N),
    Several(N),
    Undecided(N),
}

impl<N: BorrowedName> Failure<N> {
    pub(super) fn of(self, scene: N) -> MotionError<N> {
        match self {
            Self::NoMotion(contact) => MotionError::NoMotion { scene, contact, t: None },
            Self::Several(contact) => MotionError::SeveralMotions { scene, contact, t: None },
            Self::Undecided(contact) => MotionError::UndecidedMotion { scene, contact, t: None },
        }
    }
}

/// The forces in given modes.
pub(super) struct InModes<T: Real, C: Dim> {
    pub forces: Column<T, C>,
    /// False where other forces give the same motion.
    pub are_unique: bool,
    /// The forces of held contacts are within their bounds; None if each is to be compared with its own.
    pub are_admissible: Option<bool>,
    /// True if they are within their bounds, and slip that begins accelerates in its direction.
    is_within: bool,
}

/// The limits in the motion that begins with these rates of the held contacts; None if none begins so. `otherwise` has
/// the forces to take where they are not unique.
pub(super) fn limits_in<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    problem: &Problem<'_, T, V, C, N>,
    modes: &Column<Mode, C>,
    rates: &Column<T, C>,
    otherwise: &Column<T, C>,
) -> Option<Column<T, C>> {
    let moving = modes.dim().column(|place| match modes[place] {
        Mode::Stick if rates[place] > T::zero() => Mode::SlipForward,
        Mode::Stick if rates[place] < T::zero() => Mode::SlipBackward,
        Mode::AtLower | Mode::AtUpper if !rates[place].is_zero() => Mode::Open,
        mode => mode,
    });
    let family = Family::new(problem, &moving);
    let mut forces = *otherwise;
    if family.spares == 0 {
        let roots = family.slips(problem).solve(&mut Budget::new());
        match roots.as_slice() {
            [] if roots.is_complete => return None,
            [root] if roots.is_complete => forces = family.with_slips(root).base,
            _ => {}
        }
    }
    Some(modes.dim().column(|place| problem.limit(place, &forces)))
}

pub(super) fn in_modes<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    problem: &Problem<'_, T, V, C, N>,
    modes: &Column<Mode, C>,
) -> Result<InModes<T, C>, Failure<N>> {
    let mut budget = Budget::new();
    let family = Family::new(problem, modes);
    let held = HeldForces { problem, modes, is_bounded: modes.map(Mode::is_held) };
    let is_redundant = family.spares > 0;
    if is_redundant && family.is_coupled(problem) {
        if !family.is_still(problem) {
            return Err(Failure::Undecided(problem.strongest()));
        }
        let found = in_family(&held, &family, &mut budget);
        let are_admissible = Some(found.is_some() && family.is_consistent);
        let is_within = found.is_some();
        return Ok(InModes { forces: found.unwrap_or(family.base), are_unique: false, are_admissible, is_within });
    }
    let roots = family.slips(problem).solve(&mut budget);
    if !roots.is_complete {
        return Err(Failure::Undecided(problem.strongest()));
    }
    let is_still = family.is_still(problem);
    let mut found: Option<InModes<T, C>> = None;
    for root in roots.as_slice() {
        let family = family.with_slips(root);
        let admissible = match held.admissible(&family, &mut budget) {
            Existence::Found(forces) if family.is_consistent => Some(forces),
            _ => None,
        };
        let are_admissible = admissible.is_some();
        let is_within = are_admissible && departs(problem, modes, &family.base);
        match &found {
            // Forces that exceed a bound do not count, unless there are no others: then the event functions are negative.
            Some(known) if known.is_within || !is_within => {
                if is_within && !is_still {
                    return Err(Failure::Several(problem.strongest()));
                }
            }
            _ => {
                found = Some(InModes {
                    forces: admissible.unwrap_or(family.base),
                    are_unique: !is_redundant && roots.as_slice().len() == 1,
                    are_admissible: is_redundant.then_some(are_admissible),
                    is_within,
                });
            }
        }
    }
    found.ok_or(Failure::NoMotion(problem.strongest()))
}

/// True if the contacts that slip with s' = 0 accelerate in their direction, and open stops that s touches away from them.
fn departs<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    problem: &Problem<'_, T, V, C, N>,
    modes: &Column<Mode, C>,
    forces: &Column<T, C>,
) -> bool {
    let is_beginning = |place: usize| is_negligible(problem.equations.contacts[place].rate(&problem.equations.rates));
    (0..modes.dim().count()).all(|place| match modes[place] {
        mode @ (Mode::SlipForward | Mode::SlipBackward) if is_beginning(place) => {
            problem.departs(place, (mode, Mode::Stick), forces)
        }
        Mode::Open if is_beginning(place) => {
            let contact = &problem.equations.contacts[place];
            let ContactLaw::Stop { lower, upper, .. } = contact.law else { return true };
            let (side, gap) = nearer(contact, lower, upper);
            let touches = gap <= sum_tolerance(contact.value.abs() + lower.abs().max(upper.abs()));
            !touches || problem.departs(place, (Mode::Open, side), forces)
        }
        _ => true,
    })
}

/// The bearings that slip in these modes.
pub(super) fn slipping_within<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    problem: &Problem<'_, T, V, C, N>,
    modes: &Column<Mode, C>,
) -> Column<bool, C> {
    modes.dim().column(|place| {
        let is_bearing = matches!(problem.equations.contacts[place].law, ContactLaw::Bearing { .. });
        is_bearing && matches!(modes[place], Mode::SlipForward | Mode::SlipBackward)
    })
}

/// Forces within their bounds where the slipping forces depend on those of redundant contacts: both are updated until
/// they repeat, or some samples are tried.
pub(super) fn in_family<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    held: &HeldForces<'_, T, V, C, N>,
    family: &Family<T, C>,
    budget: &mut Budget,
) -> Option<Column<T, C>> {
    let is_slipping = slipping_within(held.problem, held.modes);
    let magnitudes = |forces: &Column<T, C>| {
        let places = (0..is_slipping.dim().count()).filter(|&place| is_slipping[place]);
        is_slipping.dim().padded(places.map(|place| held.problem.limit(place, forces)))
    };
    let mut slips = magnitudes(&family.base);
    for _ in 0..MOST_UPDATES {
        let Existence::Found(forces) = held.admissible(&family.with_slips(&slips), budget) else { break };
        let next = magnitudes(&forces);
        let change = (next - slips).largest();
        if change <= real::<T>(16.0) * T::default_epsilon() * next.largest() {
            return Some(forces);
        }
        slips = next;
    }
    samples(held, family, budget).next()
}

/// Forces within their bounds at some forces of the redundant contacts, each alone.
pub(super) fn samples<'a, T: Real, V: Dim, C: Dim, N: BorrowedName>(
    held: &'a HeldForces<'_, T, V, C, N>,
    family: &'a Family<T, C>,
    budget: &'a mut Budget,
) -> impl Iterator<Item = Column<T, C>> + 'a {
    let relaxed = family.relaxed();
    let shares = SAMPLES.into_iter().flat_map(|share| [-share, share]);
    let spares = (family.slips..family.slips + family.spares).flat_map(move |spare| {
        let unit = held.unit(&relaxed, spare);
        shares.clone().map(move |share| (spare, unit * real(share)))
    });
    spares.filter_map(move |(spare, change)| {
        let shifted = family.shifted(spare, change);
        let roots = shifted.slips(held.problem).solve(budget);
        let mut forces = roots.as_slice().iter().map(|root| shifted.with_slips(root).base);
        forces.find(|forces| held.is_admissible(forces))
    })
}
