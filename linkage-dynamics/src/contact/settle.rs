//! What happens at an event: impacts, and which modes follow.

use super::bounded::bounded;
use super::held::{Held, Response, nothing, slipping};
use super::impact::{After, Struck, impact};
use super::reduced::ReducedEquations;
use super::state::{Contacts, NOTHING, is_nothing, slip_or_stick};
use super::{ContactLaw, Mode};
use crate::MotionError;
use linkage_runtime::{Column, Dim, Real, real};

/// A flight of fewer roundings of the time than these is none.
const SHORTEST_FLIGHT: f64 = 64.0;

impl<T: Real, C: Dim> Contacts<T, C> {
    /// What happens at the state where an event function has just fallen through zero: impacts, and the modes that
    /// follow. Gives the rates v' from here on. `evaluate` gives the equations at other rates.
    ///
    /// # Errors
    /// [`MotionError::NoContactForces`] if no forces hold what a prescribed motion takes along, and what `evaluate` returns.
    pub fn settle<V: Dim>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        mut evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C>, MotionError>,
    ) -> Result<Column<T, V>, MotionError> {
        let mut equations = evaluate(rates)?;
        // What has no rate, and may be held: on which side if it is a stop.
        let mut at_rest: Column<Option<Mode>, C> = Column::from_fn(|place| self.at_rest(place, &equations));
        if let Some(struck) = self.struck(&equations, &at_rest) {
            equations = self.strike(t, struck, &equations, &mut at_rest, &mut evaluate)?;
        }
        self.choose(&equations, &at_rest)?;
        // What slips on keeps its rate, however small: where s turns at a dead centre the mechanism does not stand.
        if self.modes.iter().any(|mode| mode.is_held()) {
            return Ok(Held::new(&equations, &self.modes)?.rates(&equations));
        }
        Ok(equations.rates)
    }

    /// The mode in which a contact would be held, if it has no rate.
    fn at_rest<V: Dim>(&self, place: usize, equations: &ReducedEquations<T, V, C>) -> Option<Mode> {
        let contact = &equations.contacts[place];
        let (rate, size) = contact.rate(&equations.rates);
        match (self.modes[place], contact.law) {
            (Mode::Stick | Mode::AtLower | Mode::AtUpper, _) => Some(self.modes[place]),
            (Mode::SlipForward, _) => (rate <= T::zero() || is_nothing((rate, size))).then_some(Mode::Stick),
            (Mode::SlipBackward, _) => (rate >= T::zero() || is_nothing((rate, size))).then_some(Mode::Stick),
            (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                let (side, gap, rounding) = self.nearest(place, contact, [lower, upper]);
                (gap <= rounding && is_nothing((rate, size))).then_some(side)
            }
            (Mode::Open, ContactLaw::Friction { .. }) => None,
        }
    }

    /// The stops that take part in an impact, if there is one.
    fn struck<V: Dim>(
        &self,
        equations: &ReducedEquations<T, V, C>,
        at_rest: &Column<Option<Mode>, C>,
    ) -> Option<Column<Option<Struck<T>>, C>> {
        let mut hit = false;
        let struck = Column::from_fn(|place| {
            let contact = &equations.contacts[place];
            let ContactLaw::Stop { lower, upper, restitution } = contact.law else { return None };
            if let Some(side) = at_rest[place] {
                return Some(Struck { inward: side.inward(), restitution: T::zero() });
            }
            let (side, gap, rounding) = self.nearest(place, contact, [lower, upper]);
            let approaches = contact.rate(&equations.rates).0 * side.inward() < T::zero();
            (gap <= rounding && approaches).then(|| {
                hit = true;
                Struck { inward: side.inward(), restitution }
            })
        });
        hit.then_some(struck)
    }

    /// An impact: the equations at the rates after it, and what is at rest then.
    fn strike<V: Dim>(
        &mut self,
        t: T,
        mut struck: Column<Option<Struck<T>>, C>,
        equations: &ReducedEquations<T, V, C>,
        at_rest: &mut Column<Option<Mode>, C>,
        evaluate: &mut impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C>, MotionError>,
    ) -> Result<ReducedEquations<T, V, C>, MotionError> {
        let least = T::default_epsilon().sqrt();
        for place in (0..C::COUNT).filter(|&place| at_rest[place].is_none()) {
            let Some(of) = &mut struck[place] else { continue };
            let rate = equations.contacts[place].rate(&equations.rates).0.abs();
            self.hardest[place] = self.hardest[place].max(rate);
            if of.restitution * rate <= least * self.hardest[place] {
                of.restitution = T::zero();
            }
        }
        let After { rates, .. } = impact(equations, &struck)?;
        let mut after = evaluate(&rates)?;
        // A rebound that is over within the rounding of the time is none, nor one that is no higher than one rounding of
        // the place.
        let free = Response::new(&after, &Column::zeros(), |place| struck[place].is_some())?;
        let shortest = real::<T>(SHORTEST_FLIGHT) * T::default_epsilon() * t.abs();
        let mut again = false;
        for (place, of) in struck.iter_mut().enumerate() {
            let Some(Struck { inward, restitution }) = of else { continue };
            let (rate, back) = (after.contacts[place].rate(&rates).0 * *inward, -free.bias[place].0 * *inward);
            let lost = self.resolution[place] / real(NOTHING);
            let is_over = real::<T>(2.0) * rate <= shortest * back || rate * rate <= real::<T>(2.0) * lost * back;
            if !restitution.is_zero() && back > T::zero() && is_over {
                *restitution = T::zero();
                again = true;
            }
        }
        let mut pushed = Column::zeros();
        if again || struck.iter().flatten().any(|of| of.restitution.is_zero()) {
            let After { rates, impulses } = impact(equations, &struck)?;
            after = evaluate(&rates)?;
            pushed = impulses;
        }
        for (place, contact) in after.contacts.iter().enumerate() {
            // What rounding leaves is beside the rates before and after.
            let (rate, size) = contact.rate(&after.rates);
            let none = is_nothing((rate, size + equations.contacts[place].rate(&equations.rates).1));
            match contact.law {
                ContactLaw::Friction { .. } => {
                    at_rest[place] = none.then_some(Mode::Stick);
                    self.modes[place] = slip_or_stick((rate, size));
                }
                ContactLaw::Stop { .. } => {
                    let Some(of) = struck[place] else { continue };
                    let side = if of.inward > T::zero() { Mode::AtLower } else { Mode::AtUpper };
                    let rests = of.restitution.is_zero() && (none || pushed[place] > T::zero());
                    at_rest[place] = rests.then_some(side);
                    self.modes[place] = if rests { side } else { Mode::Open };
                }
            }
        }
        if at_rest.iter().any(Option::is_some) {
            let resting = Column::from_fn(|place| at_rest[place].unwrap_or(Mode::Open));
            after.rates = Held::new(&after, &resting)?.rates(&after);
        }
        Ok(after)
    }

    /// The modes of what has no rate: those in which forces within their bounds hold it or let it go.
    fn choose<V: Dim>(
        &mut self,
        equations: &ReducedEquations<T, V, C>,
        at_rest: &Column<Option<Mode>, C>,
    ) -> Result<(), MotionError> {
        let slips = |place: usize| at_rest[place].is_none();
        let forces = Column::from_fn(|place| {
            if slips(place) { slipping(self.modes[place], &equations.contacts[place].law) } else { T::zero() }
        });
        let response = Response::new(equations, &forces, |place| !slips(place))?;
        let supposed = Self { modes: Column::from_fn(|place| at_rest[place].unwrap_or(Mode::Open)), ..*self };
        let solution = bounded(&response.matrix, &supposed.bounds(&response, equations)).map_err(|place| {
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
            // A series of bounces ends where a stop is left from rest, or rested on.
            self.hardest[place] = T::zero();
        }
        // Where the others leave nothing to move, a force at its limit holds as well.
        let acceleration = self.acceleration(equations)?;
        for (place, contact) in equations.contacts.iter().enumerate() {
            let Some(side) = at_rest[place] else { continue };
            let terms = contact.row.component_mul(&acceleration);
            let (sum, size) = (terms.sum() + contact.bias, terms.abs().sum() + contact.bias.abs());
            let goes = match self.modes[place] {
                Mode::SlipForward => sum,
                Mode::SlipBackward => -sum,
                Mode::Open => sum * side.inward(),
                _ => continue,
            };
            if goes <= nothing::<T>() * size {
                self.modes[place] = side;
            }
        }
        Ok(())
    }
}
