//! An integration: step after step, from event to event.

use core::marker::PhantomData;

use nalgebra::{ComplexField, SVector};

use super::control::{self, Controller, Tolerance, positive, within};
use super::dense::Interpolant;
use super::event::{Action, Hit, Sides};
use super::tableau::{self, Method, SLOPES, Slopes, Weights};
use super::{Outputs, System};
use crate::scalar::to_f64;
use crate::{Error, Real, real};

/// What an integration has cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Evaluations of the rate, those that failed included.
    pub evaluations: usize,
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected, the first one's included.
    pub rejected: usize,
}

/// Where the integration has arrived: at the end of a step or, within one, at an event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<T, const N: usize> {
    /// The time.
    pub t: T,
    /// The state; at an event before what it does.
    pub state: SVector<T, N>,
    /// The number of the event, if there is one.
    pub event: Option<usize>,
}

/// The last time of an event: which events it has had, and whether the motion started anew with one.
#[derive(Debug, Clone, Copy)]
struct Instant<T, const K: usize> {
    t: T,
    events: [bool; K],
    anew: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// At the start, at the end of a step, or where the motion starts anew.
    Boundary,
    /// At this part of a step.
    Within(f64),
    /// Nothing follows.
    Over,
}

/// An integration under way: an iterator over its steps and events, which ends with an error or at the end of the
/// interval. What was reached stays readable after an error.
#[derive(Debug, Clone)]
pub struct Integration<M, S, T: Real, const N: usize, const K: usize = 0> {
    method: PhantomData<M>,
    system: S,
    tolerance: Tolerance<T, N>,
    largest: f64,
    most_steps: usize,
    stiffness_every: usize,
    parts: usize,
    start: T,
    end: T,
    /// How far the integration is.
    t: T,
    state: SVector<T, N>,
    place: Place,
    /// The last step: its start, its end, its slopes, and its dense output once that was asked for.
    from: (T, SVector<T, N>),
    to: (T, SVector<T, N>),
    slopes: Slopes<T, N>,
    interpolant: Option<Interpolant<T, N>>,
    /// The last slope is that of the state.
    continues: bool,
    controller: Controller,
    counts: Counts,
    stiff: u32,
    not_stiff: u32,
    sides: Sides<K>,
    instant: Instant<T, K>,
}

impl<M: Method, S: System<T, N, K>, T: Real, const N: usize, const K: usize> Integration<M, S, T, N, K> {
    /// Of this system from state `y` at `start` to `end`, which may be the earlier.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a time is not finite, [`Error::NotFiniteAt`] if the state is not.
    pub fn new(system: S, (start, y): (T, SVector<T, N>), end: T, tolerance: Tolerance<T, N>) -> Result<Self, Error> {
        for t in [start, end] {
            within("the time", to_f64(t), f64::MIN, f64::MAX)?;
        }
        finite("the initial state", start, &y)?;
        let sides = Sides::new(system.crossings());
        Ok(Self {
            method: PhantomData,
            system,
            tolerance,
            largest: f64::INFINITY,
            most_steps: 100_000,
            stiffness_every: 1000,
            parts: 4,
            start,
            end,
            t: start,
            state: y,
            place: Place::Boundary,
            from: (start, y),
            to: (start, y),
            slopes: [SVector::zeros(); SLOPES],
            interpolant: Some(Interpolant::constant(start, y)),
            continues: false,
            controller: Controller::new(),
            counts: Counts::default(),
            stiff: 0,
            not_stiff: 0,
            sides,
            instant: Instant { t: start, events: [false; K], anew: false },
        })
    }

    /// The length of the first step, in place of an estimate that takes one evaluation.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not positive and finite.
    pub fn first_step(mut self, length: T) -> Result<Self, Error> {
        positive("the first step", to_f64(length))?;
        self.controller.length = Some(to_f64(length));
        Ok(self)
    }

    /// The largest length of a step; without it the whole interval.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not positive and finite.
    pub fn largest_step(mut self, length: T) -> Result<Self, Error> {
        positive("the largest step", to_f64(length))?;
        self.largest = to_f64(length);
        Ok(self)
    }

    /// Steps, accepted or not, after which the integration is given up; 100 000 without it.
    #[must_use]
    pub fn most_steps(mut self, steps: usize) -> Self {
        self.most_steps = steps;
        self
    }

    /// Tests after every so many accepted steps whether the equations have become stiff; 0 never does. 1000
    /// without it.
    #[must_use]
    pub fn stiffness_test(mut self, every: usize) -> Self {
        self.stiffness_every = every;
        self
    }

    /// Looks at the event functions at so many equal parts of each step; 4 without it, at least 1. An event
    /// function that goes through zero and back between two of them is not seen. Between the ends of a step the
    /// functions are evaluated, but no rate.
    #[must_use]
    pub fn event_parts(mut self, parts: usize) -> Self {
        self.parts = parts.max(1);
        self
    }

    /// How far the integration is.
    #[must_use]
    pub fn t(&self) -> T {
        self.t
    }

    /// The state there; after an event what it made of it.
    #[must_use]
    pub fn state(&self) -> &SVector<T, N> {
        &self.state
    }

    /// How much of the interval is done, from 0 to 1.
    #[must_use]
    pub fn progress(&self) -> f64 {
        let (done, whole) = (to_f64(self.t - self.start), to_f64(self.end - self.start));
        if whole == 0.0 { 1.0 } else { done / whole }
    }

    /// What it has cost.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// The system, with what it has learned on the way.
    #[must_use]
    pub fn system(&self) -> &S {
        &self.system
    }

    /// Whether nothing follows: the end is reached, an event stopped the integration, or an error.
    #[must_use]
    pub fn is_over(&self) -> bool {
        match self.place {
            Place::Boundary => self.t == self.end && !self.sides.waiting.contains(&true),
            Place::Within(_) => false,
            Place::Over => true,
        }
    }

    /// The states of the last step, also before its end where an event cut it off. Made when it is first asked for,
    /// in one step at most once.
    ///
    /// # Errors
    /// What the rate returns where the method evaluates it for dense output.
    pub fn interpolant(&mut self) -> Result<Interpolant<T, N>, Error> {
        if let Some(interpolant) = self.interpolant {
            return Ok(interpolant);
        }
        let (t, y) = self.from;
        let h = self.to.0 - t;
        let table = const { &M::TABLEAU };
        let rate = counted(&mut self.system, &mut self.counts);
        tableau::evaluate(rate, table.dense_stages, table.end + 1, (t, &y), h, &mut self.slopes)?;
        let interpolant = self.cubic().complete(table, &self.slopes);
        self.interpolant = Some(interpolant);
        Ok(interpolant)
    }

    /// The states at these times, which follow one another in the direction of the integration.
    pub fn at<I: IntoIterator<Item = T>>(&mut self, times: I) -> Outputs<'_, M, S, T, I::IntoIter, N, K> {
        Outputs::new(self, times.into_iter())
    }

    /// Integrates to the end. `watch` sees every step and event and how much of the interval is done; where it
    /// returns false the integration pauses, and may be continued.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn finish(&mut self, mut watch: impl FnMut(&Step<T, N>, f64) -> bool) -> Result<(), Error> {
        while let Some(step) = self.advance()? {
            if !watch(&step, self.progress()) {
                break;
            }
        }
        Ok(())
    }

    /// To the next event or, if there is none, to the end of the step; None where nothing follows.
    ///
    /// # Errors
    /// What the system returns, if no shorter step avoids it; [`Error::NotFiniteAt`], [`Error::StepTooSmall`],
    /// [`Error::TooManySteps`], [`Error::Stiff`], [`Error::EventsWithoutEnd`]. Nothing follows after an error, and time and
    /// state stay what they were before it.
    pub fn advance(&mut self) -> Result<Option<Step<T, N>>, Error> {
        if self.is_over() {
            return Ok(None);
        }
        let result = self.proceed();
        if result.is_err() {
            self.place = Place::Over;
            // The slopes of the last step are lost.
            (self.from, self.to) = ((self.t, self.state), (self.t, self.state));
            self.interpolant = Some(Interpolant::constant(self.t, self.state));
        }
        result.map(Some)
    }

    fn proceed(&mut self) -> Result<Step<T, N>, Error> {
        if K > 0 && self.sides.waiting.contains(&true) {
            return self.deliver();
        }
        let from = match self.place {
            Place::Within(part) => part,
            _ => {
                self.step()?;
                0.0
            }
        };
        if K > 0
            && let Some(hit) = self.search(from)?
        {
            (self.t, self.state) = (hit.t, hit.state);
            self.place = Place::Within(hit.at);
            return self.deliver();
        }
        (self.t, self.state) = self.to;
        self.place = Place::Boundary;
        Ok(Step { t: self.t, state: self.state, event: None })
    }

    /// Takes a step.
    fn step(&mut self) -> Result<(), Error> {
        let rule = const { &M::TABLEAU.control };
        let mut anew = !self.continues;
        if let Some(state) = self.system.before_step(self.t, &self.state)? {
            finite("the state before a step", self.t, &state)?;
            self.state = state;
            anew = true;
        }
        let (t, y) = (self.t, self.state);
        self.slopes[0] = if anew { self.slope(t, &y)? } else { self.slopes[M::TABLEAU.end] };
        let span = to_f64(self.end - t);
        let direction = span.signum();
        if self.controller.length.is_none() {
            self.controller.length = Some(self.first_length(span)?);
        }
        let epsilon = to_f64(T::default_epsilon());
        if K > 0 && anew {
            let little = real::<T>(ComplexField::sqrt(epsilon) * direction * self.length());
            let after = y + self.slopes[0] * little;
            self.sides.begin(&mut self.system, (t, &y), (t + little, &after))?;
        }
        let mut failure = None;
        loop {
            let length = self.length();
            if self.counts.accepted + self.counts.rejected >= self.most_steps {
                return Err(Error::TooManySteps { t: to_f64(t), steps: self.most_steps });
            }
            let whole = to_f64(self.end - self.start).abs();
            let least = if failure.is_some() { whole } else { whole * epsilon };
            if 0.1 * length <= epsilon * to_f64(t).abs() || length <= epsilon * least {
                return Err(failure.unwrap_or(Error::StepTooSmall { t: to_f64(t), step: direction * length }));
            }
            let last = 1.01 * length > span.abs();
            let end = if last { self.end } else { t + real::<T>(direction * length) };
            let taken = to_f64(end - t).abs();
            match self.attempt((t, &y), end) {
                Ok((error, next)) => {
                    failure = None;
                    if self.controller.accepts(rule, error, taken) {
                        self.from = (t, y);
                        self.to = (end, next);
                        self.interpolant = None;
                        self.continues = true;
                        self.counts.accepted += 1;
                        return self.test_stiffness();
                    }
                }
                Err(error) => {
                    failure = Some(error);
                    self.controller.failed(rule, taken);
                }
            }
            self.counts.rejected += 1;
        }
    }

    /// A step to `end`: its error beside what is allowed, and its end, whose slope is evaluated if it may be accepted.
    #[inline]
    fn attempt(&mut self, (t, y): (T, &SVector<T, N>), end: T) -> Result<(f64, SVector<T, N>), Error> {
        let table = const { &M::TABLEAU };
        let h = end - t;
        tableau::evaluate(counted(&mut self.system, &mut self.counts), table.stages, 1, (t, y), h, &mut self.slopes)?;
        let next = y + tableau::combination(&self.slopes, table.solution) * h;
        let of_end = const { uses(M::TABLEAU.errors[0], M::TABLEAU.end) };
        if of_end {
            self.slopes[table.end] = self.slope(end, &next)?;
        }
        let error = control::error(table, &self.tolerance, (y, &next), &self.slopes, to_f64(h));
        if !error.is_finite() {
            return Err(Error::NotFiniteAt { quantity: "the rate or the state", t: to_f64(end) });
        }
        if !of_end && error <= 1.0 {
            self.slopes[table.end] = self.slope(end, &next)?;
        }
        Ok((error, next))
    }

    fn slope(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        self.counts.evaluations += 1;
        let slope = self.system.rate(t, y)?;
        finite("the rate", t, &slope)?;
        Ok(slope)
    }

    fn first_length(&mut self, span: f64) -> Result<f64, Error> {
        let (t, y, slope) = (self.t, self.state, self.slopes[0]);
        let tolerance = self.tolerance;
        control::first_length(M::TABLEAU.order, &tolerance, (&y, &slope), span.abs().min(self.largest), |h| {
            let h = real::<T>(h * span.signum());
            self.slope(t + h, &(y + slope * h))
        })
    }

    /// The length of the next step, without sign.
    fn length(&self) -> f64 {
        let whole = to_f64(self.end - self.start).abs();
        self.controller.length.unwrap_or(whole).min(self.largest).min(whole)
    }

    /// h |lambda| from the last stage and the end of the step, which are at the same time (Hairer and Wanner,
    /// *Solving Ordinary Differential Equations II*, section IV.2): the equations are taken to be stiff if stability
    /// sets the length of 15 tested steps without 6 others in a row among them.
    fn test_stiffness(&mut self) -> Result<(), Error> {
        let every = self.stiffness_every;
        if every == 0 || (self.stiff == 0 && !self.counts.accepted.is_multiple_of(every)) {
            return Ok(());
        }
        let table = const { &M::TABLEAU };
        let (last, stages) = (table.stages.len(), table.stages);
        let h = self.to.0 - self.from.0;
        let stage = self.from.1 + tableau::combination(&self.slopes, stages[last - 1].weights) * h;
        let slopes = to_f64((self.slopes[table.end] - self.slopes[last]).norm());
        let states = to_f64((self.to.1 - stage).norm());
        if states > 0.0 && to_f64(h).abs() * slopes > table.control.stability * states {
            (self.stiff, self.not_stiff) = (self.stiff + 1, 0);
            if self.stiff == 15 {
                let product = to_f64(h).abs() * slopes / states;
                return Err(Error::Stiff { t: to_f64(self.from.0), product });
            }
        } else {
            self.not_stiff += 1;
            if self.not_stiff == 6 {
                self.stiff = 0;
            }
        }
        Ok(())
    }

    /// The interval of which the states are at hand: from the start of the last step to where the integration is.
    pub(super) fn reached(&self) -> [T; 2] {
        [self.from.0, self.t]
    }

    pub(super) fn end(&self) -> T {
        self.end
    }

    /// The state at a time that was reached in the last step; its ends as they are.
    pub(super) fn state_within(&mut self, t: T) -> Result<SVector<T, N>, Error> {
        if t == self.from.0 {
            return Ok(self.from.1);
        }
        if t == self.to.0 {
            return Ok(self.to.1);
        }
        Ok(self.interpolant()?.at(t))
    }

    fn cubic(&self) -> Interpolant<T, N> {
        let ((t, y), (end, next)) = (&self.from, &self.to);
        Interpolant::cubic(*t, *end - *t, [y, next], [&self.slopes[0], &self.slopes[M::TABLEAU.end]])
    }

    /// The next event in the last step after the part `from`: first on a cubic, which takes no evaluation of the
    /// rate, and if that has one on the dense output.
    fn search(&mut self, from: f64) -> Result<Option<Hit<T, N>>, Error> {
        let roundings = self.roundings();
        let sides = self.sides;
        if self.interpolant.is_none() {
            let cubic = self.cubic();
            if self.sides.search(&mut self.system, &cubic, (from, self.parts), roundings)?.is_none() {
                return Ok(None);
            }
        }
        self.sides = sides;
        let interpolant = self.interpolant()?;
        self.sides.search(&mut self.system, &interpolant, (from, self.parts), roundings)
    }

    /// What rounding leaves of the time, as a part of the last step.
    fn roundings(&self) -> f64 {
        let [start, end] = [self.from.0, self.to.0].map(to_f64);
        to_f64(T::default_epsilon()) * (start.abs().max(end.abs()) / (end - start).abs()).max(1.0)
    }

    /// The next of the events that have happened here.
    fn deliver(&mut self) -> Result<Step<T, N>, Error> {
        let event = self.sides.waiting.iter().position(|&waiting| waiting).unwrap_or(0);
        self.sides.waiting[event] = false;
        let (t, state) = (self.t, self.state);
        let resolution = 4.0 * self.roundings() * to_f64(self.to.0 - self.from.0).abs();
        if to_f64(t - self.instant.t).abs() > resolution {
            self.instant = Instant { t, events: [false; K], anew: false };
        } else if self.instant.events[event] && self.instant.anew {
            return Err(Error::EventsWithoutEnd { t: to_f64(t), event });
        }
        self.instant.events[event] = true;
        match self.system.at_event(event, t, &state)? {
            Action::Record => {}
            Action::Stop => self.place = Place::Over,
            Action::Restart(state) => {
                finite("the state after an event", t, &state)?;
                self.state = state;
                self.continues = false;
                self.instant.anew = true;
                if self.place != Place::Over {
                    self.place = Place::Boundary;
                }
            }
        }
        Ok(Step { t, state, event: Some(event) })
    }
}

impl<M: Method, S: System<T, N, K>, T: Real, const N: usize, const K: usize> Iterator for Integration<M, S, T, N, K> {
    type Item = Result<Step<T, N>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

/// Whether this slope takes part.
const fn uses(weights: Weights, slope: usize) -> bool {
    let mut i = 0;
    while i < weights.len() {
        if weights[i].0 == slope {
            return true;
        }
        i += 1;
    }
    false
}

/// The rate, counting.
#[inline(always)]
fn counted<'a, S: System<T, N, K>, T: Real, const N: usize, const K: usize>(
    system: &'a mut S,
    counts: &'a mut Counts,
) -> impl FnMut(T, &SVector<T, N>) -> Result<SVector<T, N>, Error> + 'a {
    move |t, y| {
        counts.evaluations += 1;
        system.rate(t, y)
    }
}

fn finite<T: Real, const N: usize>(quantity: &'static str, t: T, values: &SVector<T, N>) -> Result<(), Error> {
    if values.iter().all(T::is_finite) { Ok(()) } else { Err(Error::NotFiniteAt { quantity, t: to_f64(t) }) }
}
