//! The modes of the contacts at rest where frictions depend on reactions.
//!
//! Each friction at rest sticks or begins to slip either way, each closed stop holds or opens. All combinations are
//! solved; the motion is unique if those that satisfy every law have one acceleration. Combinations without redundant
//! contacts come first; forces of redundant contacts are searched for only where their acceleration is new.
//!
//! The force of a slipping bearing may depend on the force y of a redundant contact. Then the motions form a curve over y;
//! if the slipping forces are a contraction, there is one motion for each y. The search takes samples of y, also large
//! ones. A curve can end only where a contact at rest is at its limit and stands still. The end is also a motion of other
//! modes. So if the only motion that was found is not at a limit, there is no such curve. Closed curves between the
//! samples are not excluded.

use super::admissible::{Existence, HeldForces};
use super::budget::Budget;
use super::family::Family;
use super::modes::{Failure, in_family, samples, slipping_within};
use super::problem::Problem;
use crate::contact::tolerance::held_tolerance;
use crate::contact::{ContactLaw, Mode};
use linkage_runtime::__shared::Ranked;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

/// The most combinations that are enumerated: eight frictions at rest. With more contacts at rest one motion is
/// searched for, by the active-set method with limits that are updated until they repeat; that there is no other is not
/// shown.
const MOST_COMBINATIONS: usize = 6561;

/// The limit on updates of the limits beyond it.
const MOST_UPDATES: usize = 200;

/// A motion that satisfies every law.
#[derive(Debug, Clone, Copy)]
struct Found<T: Real, V: Dim, C: Dim> {
    modes: Column<Mode, C>,
    forces: Column<T, C>,
    acceleration: Column<T, V>,
    /// The sums of the magnitudes of its terms.
    size: Column<T, V>,
}

/// The combinations of modes.
struct Enumeration<'a, T: Real, V: Dim, C: Dim, N: BorrowedName> {
    problem: &'a Problem<'a, T, V, C, N>,
    /// The mode in which each contact at rest would be held.
    at_rest: &'a Column<Option<Mode>, C>,
    found: Option<Found<T, V, C>>,
    budget: Budget,
    /// True while combinations with redundant contacts are examined.
    is_redundant: bool,
    is_undecided: bool,
    /// True if some modes may contain curves of motions.
    has_curves: bool,
}

/// Finds the modes of the contacts at rest. `modes` has those of the others.
pub(super) fn choose<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    problem: &Problem<'_, T, V, C, N>,
    modes: &Column<Mode, C>,
    at_rest: &Column<Option<Mode>, C>,
) -> Result<Column<Mode, C>, Failure<N>> {
    let options = at_rest.iter().flatten().map(|side| options(*side).len());
    let combinations = options.fold(1_usize, usize::saturating_mul);
    if combinations > MOST_COMBINATIONS {
        return by_updates(problem, modes, at_rest).ok_or(Failure::Undecided(problem.strongest()));
    }
    let mut enumeration = Enumeration {
        problem,
        at_rest,
        found: None,
        budget: Budget::new(),
        is_redundant: false,
        is_undecided: false,
        has_curves: false,
    };
    let mut modes = *modes;
    enumeration.visit(0, &mut modes)?;
    enumeration.is_redundant = true;
    enumeration.visit(0, &mut modes)?;
    match enumeration.found {
        Some(found) if enumeration.has_curves && !enumeration.is_strict(&found) => {
            Err(Failure::Undecided(problem.strongest()))
        }
        _ if enumeration.is_undecided => Err(Failure::Undecided(problem.strongest())),
        Some(found) => Ok(found.modes),
        None => Err(Failure::NoMotion(problem.strongest())),
    }
}

/// The modes of a contact at rest.
fn options(side: Mode) -> &'static [Mode] {
    match side {
        Mode::AtLower => &[Mode::AtLower, Mode::Open],
        Mode::AtUpper => &[Mode::AtUpper, Mode::Open],
        _ => &[Mode::Stick, Mode::SlipForward, Mode::SlipBackward],
    }
}

impl<T: Real, V: Dim, C: Dim, N: BorrowedName> Enumeration<'_, T, V, C, N> {
    /// Visits all modes of the contacts from `place` on.
    fn visit(&mut self, place: usize, modes: &mut Column<Mode, C>) -> Result<(), Failure<N>> {
        if place == self.at_rest.dim().count() {
            return self.examine(modes);
        }
        let Some(side) = self.at_rest[place] else { return self.visit(place + 1, modes) };
        for &mode in options(side) {
            modes[place] = mode;
            self.visit(place + 1, modes)?;
        }
        Ok(())
    }

    /// Adds the motions in these modes.
    fn examine(&mut self, modes: &Column<Mode, C>) -> Result<(), Failure<N>> {
        let problem = self.problem;
        let family = Family::new(problem, modes);
        if !family.is_consistent || (family.spares > 0) != self.is_redundant || problem.is_beyond_reach(modes) {
            return Ok(());
        }
        if self.is_redundant && self.is_part_of_another(modes, &family) {
            return Ok(());
        }
        if self.is_redundant && family.is_coupled(problem) {
            return self.examine_coupled(modes, &family);
        }
        let roots = family.slips(problem).solve(&mut self.budget);
        self.is_undecided |= !roots.is_complete;
        for root in roots.as_slice() {
            let family = family.with_slips(root);
            if !self.departs(modes, &family.base) {
                continue;
            }
            let (acceleration, size) = problem.acceleration(&family.base);
            let found = Found { modes: *modes, forces: family.base, acceleration, size };
            let held = HeldForces { problem, modes, is_bounded: modes.map(Mode::is_held) };
            let known = self.found.filter(|_| self.is_known(&found)).map(|known| known.forces);
            match held.admissible_from(known.as_ref(), &family, &mut self.budget) {
                Existence::Found(forces) => self.add(Found { forces, ..found })?,
                Existence::Excluded => {}
                Existence::Undecided => self.is_undecided |= known.is_none(),
            }
        }
        Ok(())
    }

    /// Modes in which the reaction of a slipping bearing depends on the forces of redundant contacts.
    fn examine_coupled(&mut self, modes: &Column<Mode, C>, family: &Family<T, C>) -> Result<(), Failure<N>> {
        let problem = self.problem;
        let is_still = family.is_still(problem);
        let (acceleration, size) = problem.acceleration(&family.base);
        let found = Found { modes: *modes, forces: family.base, acceleration, size };
        if is_still && (self.is_known(&found) || !self.departs(modes, &family.base)) {
            return Ok(());
        }
        let is_bounded = modes.map(Mode::is_held);
        let is_slipping = slipping_within(problem, modes);
        let relaxed =
            HeldForces { problem, modes, is_bounded: modes.dim().column(|at| is_bounded[at] || is_slipping[at]) };
        if let Existence::Excluded = relaxed.admissible(&family.relaxed(), &mut self.budget) {
            return Ok(());
        }
        let held = HeldForces { problem, modes, is_bounded };
        if is_still && let Some(forces) = in_family(&held, family, &mut self.budget) {
            return self.add(Found { forces, ..found });
        }
        // The motion depends on the forces of redundant contacts: samples may show several.
        let mut is_found = false;
        for forces in samples(&held, family, &mut Budget::new()) {
            if self.departs(modes, &forces) {
                let (acceleration, size) = problem.acceleration(&forces);
                self.add(Found { modes: *modes, forces, acceleration, size })?;
                is_found = true;
            }
        }
        let is_curve = family.spares == 1 && family.slips(problem).is_contraction();
        self.has_curves |= is_curve && !is_found && !is_still;
        self.is_undecided |= is_found || !is_curve;
        Ok(())
    }

    /// True if every contact that is not held departs in the direction of its mode.
    fn departs(&self, modes: &Column<Mode, C>, forces: &Column<T, C>) -> bool {
        (0..self.at_rest.dim().count()).all(|place| match self.at_rest[place] {
            Some(side) if !modes[place].is_held() => self.problem.departs(place, (modes[place], side), forces),
            _ => true,
        })
    }

    /// True if a contact at rest that is not held cannot accelerate: the modes in which it is held include these.
    fn is_part_of_another(&self, modes: &Column<Mode, C>, family: &Family<T, C>) -> bool {
        let problem = self.problem;
        let rank = |also: Option<usize>| {
            let (mut order, mut count) = (self.at_rest.dim().repeat(0), 0);
            for place in (0..self.at_rest.dim().count()).filter(|&place| modes[place].is_held() || also == Some(place))
            {
                order[count] = place;
                count += 1;
            }
            Ranked::<T, C>::pivoted(&problem.response.matrix, &order, count, held_tolerance()).rank
        };
        let of_held = rank(None);
        let is_free = |place: usize| self.at_rest[place].is_some() && !modes[place].is_held();
        (0..self.at_rest.dim().count())
            .filter(|&place| is_free(place))
            .any(|place| rank(Some(place)) == of_held && problem.stands(place, &family.base))
    }

    /// True if no contact at rest is at its limit and stands still, and no held contact is redundant.
    fn is_strict(&self, found: &Found<T, V, C>) -> bool {
        let (problem, forces) = (self.problem, &found.forces);
        let is_clear = |place: usize| {
            let mode = found.modes[place];
            if mode.is_held() {
                let tolerance = problem.force_tolerance(place, forces);
                return problem.margin(place, mode, forces) > tolerance;
            }
            !problem.stands(place, forces)
        };
        let is_at_rest = |place: usize| self.at_rest[place].is_some();
        Family::new(problem, &found.modes).spares == 0
            && (0..self.at_rest.dim().count()).filter(|&place| is_at_rest(place)).all(is_clear)
    }

    fn is_known(&self, found: &Found<T, V, C>) -> bool {
        self.found.as_ref().is_some_and(|known| {
            let tolerance = T::default_epsilon().sqrt();
            (0..found.acceleration.dim().count()).all(|at| {
                let size = known.size[at].max(found.size[at]);
                (known.acceleration[at] - found.acceleration[at]).abs() <= tolerance * size
            })
        })
    }

    /// Adds a motion; of equal ones, that with the most held contacts stays.
    fn add(&mut self, found: Found<T, V, C>) -> Result<(), Failure<N>> {
        let held = |found: &Found<T, V, C>| found.modes.iter().filter(|mode| mode.is_held()).count();
        match &self.found {
            Some(known) if !self.is_known(&found) => {
                let differs = |&place: &usize| {
                    let is_friction = !matches!(self.problem.equations.contacts[place].law, ContactLaw::Stop { .. });
                    known.modes[place] != found.modes[place] && is_friction
                };
                let contact = (0..self.at_rest.dim().count())
                    .find(differs)
                    .map(|place| self.problem.equations.contacts[place].name);
                return Err(Failure::Several(contact.unwrap_or_else(|| self.problem.strongest())));
            }
            Some(known) if held(known) >= held(&found) => {}
            _ => self.found = Some(found),
        }
        Ok(())
    }
}

/// One motion, by the active-set method with limits that are updated until they repeat.
fn by_updates<T: Real, V: Dim, C: Dim, N: BorrowedName>(
    problem: &Problem<'_, T, V, C, N>,
    modes: &Column<Mode, C>,
    at_rest: &Column<Option<Mode>, C>,
) -> Option<Column<Mode, C>> {
    let held = at_rest.dim().column(|place| at_rest[place].unwrap_or(modes[place]));
    let search = HeldForces { problem, modes: &held, is_bounded: at_rest.map(|side| side.is_some()) };
    let sign = |place: usize| if modes[place] == Mode::SlipForward { -T::one() } else { T::one() };
    let is_slipping = slipping_within(problem, modes);
    let mut forces = problem.given(&held);
    for _ in 0..MOST_UPDATES {
        let moving: Column<T, C> = at_rest.dim().column(|place| match at_rest[place] {
            Some(_) => T::zero(),
            None if is_slipping[place] => sign(place) * problem.limit(place, &forces),
            None => forces[place],
        });
        let next = search.within_limits(&moving, &forces)?;
        let change = (next - forces).largest();
        forces = next;
        if change <= real::<T>(4.0) * T::default_epsilon() * forces.largest() {
            break;
        }
    }
    let mut chosen = held;
    for (place, side) in at_rest.iter().enumerate() {
        let Some(side) = *side else { continue };
        let (sum, size) = problem.along(place, &forces);
        let stands = sum.abs() <= held_tolerance::<T>() * size;
        chosen[place] = match side {
            _ if stands => side,
            Mode::Stick if sum > T::zero() => Mode::SlipForward,
            Mode::Stick => Mode::SlipBackward,
            _ => Mode::Open,
        };
        let tolerance = problem.force_tolerance(place, &forces);
        let fits = match chosen[place] {
            Mode::Open => problem.departs(place, (Mode::Open, side), &forces) && forces[place].abs() <= tolerance,
            Mode::SlipForward => (forces[place] + problem.limit(place, &forces)).abs() <= tolerance,
            Mode::SlipBackward => (forces[place] - problem.limit(place, &forces)).abs() <= tolerance,
            mode => problem.is_within(place, mode, &forces),
        };
        if !fits {
            return None;
        }
    }
    Some(chosen)
}
