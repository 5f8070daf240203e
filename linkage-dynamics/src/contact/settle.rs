//! Contact events: impacts, and the modes that follow.

use super::bounded::bounded;
use super::held::{Held, Response, slipping};
use super::impact::{After, Struck, impact};
use super::reduced::{ReducedContact, ReducedEquations};
use super::state::{Contacts, slip_or_stick};
use super::tolerance::{ZERO_ULPS, held_tolerance, is_negligible};
use super::{ContactLaw, Mode, reaction};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

/// A rebound that takes less than this many ulps of the time is treated as rest.
const SHORTEST_FLIGHT_ULPS: f64 = 64.0;

/// The most impacts that cause each other at one time without losses. A body of mass m between a wall and one of mass M, which
/// comes nearer, is in pi sqrt(M / m) impacts: in this many if M is 100 000 m.
const MOST_IMPACTS: usize = 1000;

/// The most impacts with losses: the rates fall until all rest. A body of mass m between a wall with restitution e and one of mass
/// M, which follows it without rebound, takes 1 - (1 + e) m / M of the rate with each two: it rests after this many if M is 3000 m.
const MOST_WITH_LOSSES: usize = 100_000;

/// Impacts with losses go on while the rates of the stops that are touched fall at least by this factor with each
/// [`MOST_IMPACTS`]: between walls that move they do not.
const SLOWEST_FALL: f64 = 0.99;

impl<T: Real, C: Dim> Contacts<T, C> {
    /// Applies impacts and finds the new modes at a state where an event function has just fallen through zero. Returns
    /// the rates v' after the event. `evaluate` computes the equations of this state with other rates v'.
    ///
    /// # Errors
    /// [`MotionError::NoContactForces`] if no contact forces satisfy a prescribed motion, those of `evaluate`, and
    /// [`MotionError::ContactWithoutEnd`] after 1000 impacts. With a [`Bearing`](ContactLaw::Bearing)
    /// [`MotionError::NoMotion`], [`MotionError::SeveralMotions`] or [`MotionError::UndecidedMotion`].
    pub fn settle<V: Dim, N: BorrowedName>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<Column<T, V>, MotionError<N>> {
        self.settle_by(t, rates, evaluate, false)
    }

    /// Does the same after impacts of several stops that follow each other within the rounding error of the time: all
    /// stops that s touches take part in one impact without rebound.
    ///
    /// # Errors
    /// Those of [`settle`](Self::settle).
    pub(crate) fn settle_together<V: Dim, N: BorrowedName>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<Column<T, V>, MotionError<N>> {
        self.settle_by(t, rates, evaluate, true)
    }

    fn settle_by<V: Dim, N: BorrowedName>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        mut evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
        is_together: bool,
    ) -> Result<Column<T, V>, MotionError<N>> {
        let mut equations = evaluate(rates)?;
        // The mode in which each contact with s' = 0 would be held; None for the others.
        let mut at_rest: Column<Option<Mode>, C> = self.modes.dim().column(|place| self.at_rest(place, &equations));
        // A contact that is released from rest begins with s' = 0, without the error of the step. One that goes on
        // slipping keeps its rate, however small: s' passes zero at a dead centre while the mechanism moves.
        let mut resting = self.modes;
        self.is_hit = self.modes.dim().repeat(false);
        let (mut impacts, mut has_losses, mut fastest) = (0, false, real::<T>(f64::INFINITY));
        // Stops that are closed take part in each impact; those that an impact of this series has closed have their own turn.
        let mut closed = at_rest.map(|side| side.is_some());
        // An impact may move another s towards a stop that it touches.
        while let Some(struck) = self.struck(&equations, (&at_rest, &closed), is_together) {
            let mut hit =
                struck.iter().zip(&at_rest).filter(|(_, side)| side.is_none()).filter_map(|(of, _)| of.as_ref());
            has_losses |= hit.any(|of| of.restitution < T::one());
            let rates = if impacts % MOST_IMPACTS == 0 { self.fastest_touched(&equations) } else { fastest };
            let is_falling = impacts == 0 || has_losses && rates < real::<T>(SLOWEST_FALL) * fastest;
            if impacts % MOST_IMPACTS == 0 && !is_falling || impacts == MOST_WITH_LOSSES {
                let place = struck.iter().position(|of| of.is_some()).unwrap_or(0);
                let (scene, contact) = (equations.scene, equations.contacts[place].name);
                return Err(MotionError::ContactWithoutEnd { scene, contact, t: to_f64(t) });
            }
            fastest = rates;
            equations = self.strike(t, struck, &equations, &mut at_rest, &mut evaluate)?;
            closed.iter_mut().zip(&at_rest).for_each(|(closed, side)| *closed &= side.is_some());
            resting = self.modes.dim().repeat(Mode::Open);
            impacts += 1;
            // Without rebound nothing is approached after one impact.
            if is_together {
                break;
            }
        }
        self.choose(&equations, &at_rest)?;
        self.leave_dead_centres(&equations, &mut evaluate)?;
        for (resting, mode) in resting.iter_mut().zip(self.modes).filter(|(_, mode)| mode.is_held()) {
            *resting = mode;
        }
        if resting.iter().any(|mode| mode.is_held()) {
            return Ok(Held::new(&equations, &resting)?.rates(&equations));
        }
        Ok(equations.rates)
    }

    /// Lets a friction slip, or s leave its stop, where no force along s can hold it, since ds/dv = 0: at rest at a dead
    /// centre s moves with `s'' = 0` first, then by its quadratic term, `s = b(v'') t^4 / 8`.
    fn leave_dead_centres<V: Dim, N: BorrowedName>(
        &mut self,
        equations: &ReducedEquations<T, V, C, N>,
        evaluate: &mut impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<(), MotionError<N>> {
        let is_dead =
            |(mode, contact): (&Mode, &ReducedContact<T, V, N>)| mode.is_held() && contact.row.iter().all(T::is_zero);
        if equations.has_bearings() || !self.modes.iter().zip(&equations.contacts).any(is_dead) {
            return Ok(());
        }
        let later = evaluate(&self.acceleration(equations)?)?;
        for (place, mode) in self.modes.iter_mut().enumerate() {
            let contact = &equations.contacts[place];
            let bend = later.contacts[place].bias - contact.bias;
            if bend.is_zero() || !is_dead((mode, contact)) {
                continue;
            }
            *mode = match *mode {
                Mode::Stick if bend > T::zero() => Mode::SlipForward,
                Mode::Stick => Mode::SlipBackward,
                stop if bend * stop.inward() > T::zero() => Mode::Open,
                stop => stop,
            };
        }
        Ok(())
    }

    /// Returns the mode in which a contact would be held, if s' is zero or has just changed its sign; None if it moves.
    fn at_rest<V: Dim, N: BorrowedName>(&self, place: usize, equations: &ReducedEquations<T, V, C, N>) -> Option<Mode> {
        let contact = &equations.contacts[place];
        let (rate, size) = contact.rate(&equations.rates);
        match (self.modes[place], contact.law) {
            (Mode::Stick | Mode::AtLower | Mode::AtUpper, _) => Some(self.modes[place]),
            (Mode::SlipForward, _) => (rate <= T::zero() || is_negligible((rate, size))).then_some(Mode::Stick),
            (Mode::SlipBackward, _) => (rate >= T::zero() || is_negligible((rate, size))).then_some(Mode::Stick),
            (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                let (side, gap, tolerance) = self.nearest(place, contact, [lower, upper]);
                (gap <= tolerance && is_negligible((rate, size))).then_some(side)
            }
            (Mode::Open, ContactLaw::Friction { .. } | ContactLaw::Bearing { .. }) => None,
        }
    }

    /// The largest rate of the stops that are touched.
    fn fastest_touched<V: Dim, N: BorrowedName>(&self, equations: &ReducedEquations<T, V, C, N>) -> T {
        let rates = equations.contacts.iter().enumerate().filter_map(|(place, contact)| {
            let ContactLaw::Stop { lower, upper, .. } = contact.law else { return None };
            let (_, gap, tolerance) = self.nearest(place, contact, [lower, upper]);
            (gap <= tolerance).then(|| contact.rate(&equations.rates).0.abs())
        });
        rates.fold(T::zero(), T::max)
    }

    /// Returns the stops that take part in an impact, those on which s rests included; None if s hits no stop. If
    /// `is_together`, all that s touches, without rebound.
    ///
    /// A stop that an impact at this time has closed does not take part while another stop rebounds: it is hit by the next impact.
    /// Two bodies that have met without rebound are not one body for the wall that the first of them strikes.
    fn struck<V: Dim, N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
        (at_rest, closed): (&Column<Option<Mode>, C>, &Column<bool, C>),
        is_together: bool,
    ) -> Option<Column<Option<Struck<T>>, C>> {
        let (mut hit, mut rebounds) = (false, false);
        let mut struck = at_rest.dim().column(|place| {
            let contact = &equations.contacts[place];
            let ContactLaw::Stop { lower, upper, restitution } = contact.law else { return None };
            if let Some(side) = at_rest[place] {
                return Some(Struck { inward: side.inward(), restitution: T::zero() });
            }
            let (side, gap, tolerance) = self.nearest(place, contact, [lower, upper]);
            let approaches = contact.rate(&equations.rates).0 * side.inward() < T::zero();
            (gap <= tolerance && (approaches || is_together)).then(|| {
                hit = true;
                let restitution = if is_together { T::zero() } else { restitution };
                rebounds |= restitution > T::zero();
                Struck { inward: side.inward(), restitution }
            })
        });
        for ((of, side), closed) in struck.iter_mut().zip(at_rest).zip(closed) {
            if rebounds && side.is_some() && !closed {
                *of = None;
            }
        }
        hit.then_some(struck)
    }

    /// Applies an impact: returns the equations at the rates after it, and updates the contacts at rest and those hit.
    fn strike<V: Dim, N: BorrowedName>(
        &mut self,
        t: T,
        mut struck: Column<Option<Struck<T>>, C>,
        equations: &ReducedEquations<T, V, C, N>,
        at_rest: &mut Column<Option<Mode>, C>,
        evaluate: &mut impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>> {
        let least = T::default_epsilon().sqrt();
        let mut has_ended = false;
        for place in (0..at_rest.dim().count()).filter(|&place| at_rest[place].is_none()) {
            let Some(of) = &mut struck[place] else { continue };
            let rate = equations.contacts[place].rate(&equations.rates).0.abs();
            self.hardest[place] = self.hardest[place].max(rate);
            if !of.restitution.is_zero() && of.restitution * rate <= least * self.hardest[place] {
                of.restitution = T::zero();
                has_ended = true;
            }
        }
        if has_ended {
            self.join_touched(equations, &mut struck);
        }
        let After { rates, mut changes, .. } = impact(equations, &struck)?;
        let mut after = evaluate(&rates)?;
        // A rebound counts as rest if it is shorter than the rounding error of the time or lower than that of the gap.
        let forces = at_rest.dim().column(|place| {
            let contact = &after.contacts[place];
            slipping(slip_or_stick(contact.rate(&after.rates)), &contact.law)
        });
        let free = Response::new(&after, &forces, |place| struck[place].is_some())?;
        // With the forces of the stops that were closed, such as that of a block which presses on the one that rebounds. Where no
        // forces hold, that is found below.
        let closed = |place: usize| struck[place].filter(|_| at_rest[place].is_some());
        let bounds = at_rest.dim().column(|place| closed(place).map(|of| of.presses(free.bias[place])));
        let pressed = bounded(&free.matrix, &bounds);
        let pressed = pressed.map_or(at_rest.dim().zeros(), |pressed| pressed.forces);
        let shortest = real::<T>(SHORTEST_FLIGHT_ULPS) * T::default_epsilon() * t.abs();
        let (mut has_ended, mut too_short) = (false, at_rest.dim().repeat(false));
        for (place, of) in struck.iter_mut().enumerate() {
            let Some(Struck { inward, restitution }) = of else { continue };
            // The rebound rate, and the acceleration back to the stop, by frictions that slip too, with the forces of closed stops or
            // without: a flight takes 2 rate / back and rises by rate^2 / (2 back).
            let row = pressed.iter().enumerate().map(|(other, &force)| free.matrix[(place, other)] * force);
            let alone = free.bias[place].0 * *inward;
            let back = (-alone).max(-row.fold(alone, |sum, term| sum + term * *inward));
            let rate = after.contacts[place].rate(&rates).0 * *inward;
            let lowest = self.resolution[place] / real(ZERO_ULPS);
            let is_over = real::<T>(2.0) * rate <= shortest * back || rate * rate <= real::<T>(2.0) * lowest * back;
            too_short[place] = back > T::zero() && is_over;
            if !restitution.is_zero() && too_short[place] {
                *restitution = T::zero();
                has_ended = true;
            }
        }
        if has_ended {
            self.join_touched(equations, &mut struck);
        }
        let mut pushed = at_rest.dim().zeros();
        if has_ended || struck.iter().flatten().any(|of| of.restitution.is_zero()) {
            let last = impact(equations, &struck)?;
            after = evaluate(&last.rates)?;
            (pushed, changes) = (last.impulses, last.changes);
        }
        for (place, contact) in after.contacts.iter().enumerate() {
            // A rate is a rounding error if its terms before the impact, those after it, and its change are so much larger.
            let (rate, size) = contact.rate(&after.rates);
            let none =
                is_negligible((rate, size + equations.contacts[place].rate(&equations.rates).1 + changes[place]));
            match contact.law {
                ContactLaw::Friction { .. } | ContactLaw::Bearing { .. } => {
                    at_rest[place] = none.then_some(Mode::Stick);
                    self.modes[place] = slip_or_stick((rate, size));
                }
                ContactLaw::Stop { lower, upper, .. } => {
                    let Some(of) = struck[place] else {
                        // It was being left before the impact.
                        let (side, gap, tolerance) = self.nearest(place, contact, [lower, upper]);
                        at_rest[place] = (none && gap <= tolerance).then_some(side);
                        continue;
                    };
                    let side = if of.inward > T::zero() { Mode::AtLower } else { Mode::AtUpper };
                    // A rate towards the stop, which no impulse has ended, is a rounding error. A flight from rest may be
                    // too short as well: a body rocks between two stops until it rests on both.
                    let away = rate * of.inward;
                    let rests = away < T::zero()
                        || (of.restitution.is_zero() && (none || pushed[place] > T::zero() || too_short[place]));
                    let towards = equations.contacts[place].rate(&equations.rates).0 * of.inward;
                    self.is_hit[place] |= at_rest[place].is_none() && towards < T::zero() && away > towards;
                    at_rest[place] = rests.then_some(side);
                    self.modes[place] = if rests { side } else { Mode::Open };
                }
            }
        }
        if at_rest.iter().any(Option::is_some) {
            let resting = at_rest.dim().column(|place| at_rest[place].unwrap_or(Mode::Open));
            after.rates = Held::new(&after, &resting)?.rates(&after);
        }
        Ok(after)
    }

    /// Lets all stops that s touches take part in an impact, those that were not hit without rebound: where a series of
    /// impacts ends, a body that struck two stops in turn is pressed to both.
    fn join_touched<V: Dim, N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
        struck: &mut Column<Option<Struck<T>>, C>,
    ) {
        for (place, of) in struck.iter_mut().enumerate().filter(|(_, of)| of.is_none()) {
            let contact = &equations.contacts[place];
            let ContactLaw::Stop { lower, upper, .. } = contact.law else { continue };
            let (side, gap, tolerance) = self.nearest(place, contact, [lower, upper]);
            *of = (gap <= tolerance).then(|| Struck { inward: side.inward(), restitution: T::zero() });
        }
    }

    /// Chooses the modes of the contacts at rest: held by a force within its bounds, or released.
    fn choose<V: Dim, N: BorrowedName>(
        &mut self,
        equations: &ReducedEquations<T, V, C, N>,
        at_rest: &Column<Option<Mode>, C>,
    ) -> Result<(), MotionError<N>> {
        if equations.has_bearings() {
            self.modes = reaction::choose(equations, &self.modes, at_rest)?;
            for (hardest, _) in self.hardest.iter_mut().zip(at_rest).filter(|(_, side)| side.is_some()) {
                *hardest = T::zero();
            }
            return Ok(());
        }
        let slips = |place: usize| at_rest[place].is_none();
        let forces = at_rest.dim().column(|place| {
            if slips(place) { slipping(self.modes[place], &equations.contacts[place].law) } else { T::zero() }
        });
        let response = Response::new(equations, &forces, |place| !slips(place))?;
        let held = Self { modes: at_rest.dim().column(|place| at_rest[place].unwrap_or(Mode::Open)), ..*self };
        let solution = bounded(&response.matrix, &held.bounds(&response, equations)).map_err(|place| {
            MotionError::NoContactForces { scene: equations.scene, contact: equations.contacts[place].name }
        })?;
        for (place, side) in at_rest.iter().enumerate() {
            let Some(side) = *side else { continue };
            let slack = solution.slack[place];
            self.modes[place] = match side {
                Mode::Stick if slack > T::zero() => Mode::SlipForward,
                Mode::Stick if slack < T::zero() => Mode::SlipBackward,
                Mode::AtLower | Mode::AtUpper if slack * side.inward() > T::zero() => Mode::Open,
                held => held,
            };
            // The series of bounces has ended, either resting on the stop or leaving it from rest.
            self.hardest[place] = T::zero();
        }
        let sizes = at_rest.dim().column(|place| {
            let terms =
                solution.forces.iter().enumerate().map(|(other, &force)| response.matrix[(place, other)] * force);
            terms.fold(response.bias[place].1, |size, term| size + term.abs())
        });
        self.hold_again(equations, at_rest, &sizes)
    }

    /// Holds again the contacts that are released at their limit and do not accelerate away, to rounding error: those
    /// whose margin is positive if they are held. `sizes` are the sums of the magnitudes of the terms of `s''`. This is the
    /// test that ends the mode, so that a contact held here is not released again at the same state.
    fn hold_again<V: Dim, N: BorrowedName>(
        &mut self,
        equations: &ReducedEquations<T, V, C, N>,
        at_rest: &Column<Option<Mode>, C>,
        sizes: &Column<T, C>,
    ) -> Result<(), MotionError<N>> {
        let acceleration = self.acceleration(equations)?;
        let mut held = self.modes;
        for (place, contact) in equations.contacts.iter().enumerate() {
            let Some(side) = at_rest[place] else { continue };
            let sum = contact.row.dot(&acceleration) + contact.bias;
            let departure = match self.modes[place] {
                Mode::SlipForward => sum,
                Mode::SlipBackward => -sum,
                Mode::Open => sum * side.inward(),
                _ => continue,
            };
            if departure <= held_tolerance::<T>() * sizes[place] {
                held[place] = side;
            }
        }
        if held == self.modes {
            return Ok(());
        }
        let forces = Held::new(equations, &held)?;
        let (margins, tolerances) = (forces.margins(equations, &held), forces.force_tolerances());
        for (place, mode) in self.modes.iter_mut().enumerate() {
            // Half of the tolerance in the margin: an event is not undone by rounding errors.
            if margins[place] > tolerances[place] * real(0.5) {
                *mode = held[place];
            }
        }
        Ok(())
    }
}
