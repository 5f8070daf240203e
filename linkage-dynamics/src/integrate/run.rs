//! The main loop of an integration: steps and events.

use core::marker::PhantomData;

use super::control::{self, Controller, Tolerance, positive, within};
use super::dense::Interpolant;
use super::event::EventSigns;
use super::integration::{Counts, Instant, Integration, Place, Step, StepOf, finite};
use super::search::{Found, Hit};
use super::system::{ErrorOf, IntoSystem, StateOf, System};
use super::tableau::{self, Method, SLOPES};
use super::{Outputs, step};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Build, InputError, Name, real};

/// The largest correction of a state by projection, divided by the tolerance, after which the rate computed before it
/// is still used.
const NEGLIGIBLE_CORRECTION: f64 = 0.01;

/// The most times in a row that a step is shortened to a sixteenth because its guards change too much: to 16^-5 = 1e-6
/// of the step that the tolerance allows. With 4 a guard that jumps is located with steps 16 times as long, with 6 it
/// costs one more step.
const MAX_SHORTENED: u32 = 5;

/// A step that is repeated for an event goes to so many times the time until it, so that it is within the step again.
const BEYOND_EVENT: f64 = 1.05;

/// An event this late in a step does not cut it.
const LATE_EVENT: f64 = 0.9;

/// A step whose error to an event is this part of the tolerance there has dense output within it too: the largest error of dense
/// output that was seen is 240 times that of the step.
const CERTAIN: f64 = 1e-3;

/// The parts of the way to an event at which the polynomial of a step is compared with the rate: the places of Gauss's rule.
const COMPARED: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

impl<S: System, M: Method> Integration<S, M> {
    /// Starts an integration of this system from state `y` at `start` to `end`, which may be before `start`.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if a time is not finite, [`MotionError::NotFinite`] if the state is not.
    pub fn new<B>(
        system: impl IntoSystem<B, System = S>,
        (start, y): (S::Scalar, impl Into<StateOf<S>>),
        end: S::Scalar,
        tolerance: Tolerance<S::Scalar, S::N>,
    ) -> Result<Self, ErrorOf<S>> {
        let (system, y) = (system.into_system(), y.into());
        for t in [start, end] {
            within("the time", to_f64(t), f64::MIN, f64::MAX)?;
        }
        finite("the initial state", start, &y)?;
        let signs = EventSigns::new(system.crossings(), system.counts().1);
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
            slopes: [y.dim().zeros(); SLOPES],
            interpolant: Some(Interpolant::constant(start, y)),
            has_rate: false,
            controller: Controller::new(),
            counts: Counts::default(),
            stiff: 0,
            not_stiff: 0,
            signs,
            instant: Instant { t: start, has_restarted: false, has_continued: false },
            shortened: 0,
            has_crossed: false,
        })
    }

    /// Sets the length of the first step; the default estimate takes one evaluation.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if it is not positive and finite.
    pub fn first_step(mut self, length: S::Scalar) -> Result<Self, InputError<S::Name>> {
        positive("the first step", to_f64(length))?;
        self.controller.length = Some(to_f64(length));
        Ok(self)
    }

    /// Sets the largest step; the default is the whole interval.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if it is not positive and finite.
    pub fn largest_step(mut self, length: S::Scalar) -> Result<Self, InputError<S::Name>> {
        positive("the largest step", to_f64(length))?;
        self.largest = to_f64(length);
        Ok(self)
    }

    /// Sets the limit on the number of steps, rejected ones included; the default is 100 000.
    #[must_use]
    pub fn most_steps(mut self, steps: usize) -> Self {
        self.most_steps = steps;
        self
    }

    /// Tests for stiffness after every `every` accepted steps; with 0 never. The default is 1000.
    #[must_use]
    pub fn stiffness_test(mut self, every: usize) -> Self {
        self.stiffness_every = every;
        self
    }

    /// Samples the event functions at the ends of `parts` equal parts of each step; the default is 4, the least 1, and a
    /// multiple of 4 is used if the system has guards. A passage of an event function through zero and back between two
    /// samples is found if the function has one extremum in the step; with several it may need more parts ([detection of
    /// events](super)). This evaluates the functions, but no rate without a possible event.
    #[must_use]
    pub fn event_parts(mut self, parts: usize) -> Self {
        self.parts = parts.max(1);
        self
    }

    /// The time reached.
    #[must_use]
    pub fn t(&self) -> S::Scalar {
        self.t
    }

    /// The state reached; after an event, the state after its action.
    #[must_use]
    pub fn state(&self) -> &StateOf<S> {
        &self.state
    }

    /// The part of the interval that is done, from 0 to 1.
    #[must_use]
    pub fn progress(&self) -> f64 {
        let (done, whole) = (to_f64(self.t - self.start), to_f64(self.end - self.start));
        if whole == 0.0 { 1.0 } else { done / whole }
    }

    /// The cost so far.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// The system in its current state.
    #[must_use]
    pub fn system(&self) -> &S {
        &self.system
    }

    /// Returns true at the end of the interval, after an event that stopped the integration, and after an error.
    #[must_use]
    pub fn is_over(&self) -> bool {
        match self.place {
            Place::Boundary => self.t == self.end && !self.signs.has_pending(),
            Place::Within(_) => false,
            Place::Over => true,
        }
    }

    /// The dense output of the last step, up to its end even if an event ended it earlier. It is computed at the first
    /// call, at most once a step.
    ///
    /// # Errors
    /// Those of the rate if the method evaluates it for dense output, and [`MotionError::NotFinite`].
    pub fn interpolant(&mut self) -> Result<Interpolant<S::Scalar, S::N>, ErrorOf<S>> {
        if let Some(interpolant) = self.interpolant {
            return Ok(interpolant);
        }
        let (t, y) = self.from;
        let h = self.to.0 - t;
        let table = const { &M::TABLEAU };
        let rate = step::counted(&mut self.system, &mut self.counts);
        tableau::evaluate(rate, table.dense_stages, table.end + 1, (t, &y), h, &mut self.slopes)?;
        let interpolant = self.cubic().complete(table, &self.slopes);
        if !interpolant.is_finite() {
            return Err(MotionError::NotFinite { quantity: Name::from_static("the dense output"), t: to_f64(t) });
        }
        self.interpolant = Some(interpolant);
        Ok(interpolant)
    }

    /// Completes the dense output of the last step before the law of the rate changes without an event: the rates that it needs
    /// are those of the law of the step.
    ///
    /// # Errors
    /// Those of [`interpolant`](Self::interpolant).
    pub(crate) fn keep_dense_output(&mut self) -> Result<(), ErrorOf<S>> {
        self.interpolant().map(|_| ())
    }

    /// Returns the states at these times, which must be in the direction of the integration.
    pub fn at<I: IntoIterator<Item = S::Scalar>>(&mut self, times: I) -> Outputs<'_, S, M, I::IntoIter> {
        Outputs::new(self, times.into_iter())
    }

    /// Integrates to the end. `watch` receives every step and event and the progress from 0 to 1; if it returns false
    /// the integration pauses, and may be continued.
    ///
    /// # Errors
    /// Those of [`advance`](Self::advance).
    pub fn finish(&mut self, mut watch: impl FnMut(&StepOf<S>, f64) -> bool) -> Result<(), ErrorOf<S>> {
        while let Some(step) = self.advance()? {
            if !watch(&step, self.progress()) {
                break;
            }
        }
        Ok(())
    }

    /// Advances to the next event or to the end of the step; returns None at the end.
    ///
    /// # Errors
    /// Those of the system, if no shorter step avoids them; [`MotionError::NotFinite`], [`MotionError::StepTooSmall`],
    /// [`MotionError::TooManySteps`], [`MotionError::Stiff`], [`MotionError::EventsWithoutEnd`]. After an error the
    /// integration has ended, with the time and state before it.
    pub fn advance(&mut self) -> Result<Option<StepOf<S>>, ErrorOf<S>> {
        if self.is_over() {
            return Ok(None);
        }
        let result = self.proceed();
        if result.is_err() {
            self.place = Place::Over;
            // The slopes of the last step are overwritten.
            (self.from, self.to) = ((self.t, self.state), (self.t, self.state));
            self.interpolant = Some(Interpolant::constant(self.t, self.state));
        }
        result.map(Some)
    }

    fn proceed(&mut self) -> Result<StepOf<S>, ErrorOf<S>> {
        if self.signs.has_pending() {
            return self.deliver();
        }
        let mut undefined = None;
        loop {
            let (from, is_new) = match self.place {
                Place::Within(part) => (part, false),
                _ => {
                    self.step().map_err(|error| match error {
                        MotionError::StepTooSmall { .. } => undefined.unwrap_or(error),
                        error => error,
                    })?;
                    (0.0, true)
                }
            };
            let signs = self.signs;
            let found = if self.signs.each().next().is_some() { self.search(from) } else { Ok(Found::Nothing) };
            let length = to_f64(self.to.0 - self.from.0).abs();
            // An event function may be undefined between the ends of a long step.
            undefined = found.as_ref().err().copied();
            let is_too_long = matches!(found, Err(_) | Ok(Found::TooCoarse));
            if is_too_long && is_new && self.shortened < MAX_SHORTENED && !self.system.went_over_change() {
                self.shortened += 1;
                self.repeat_to(length / 16.0);
                continue;
            }
            match found? {
                Found::Hit(hit) if is_new && self.is_too_long_for(&hit) => {
                    self.signs = signs;
                    self.repeat_to(length * hit.at * BEYOND_EVENT);
                }
                Found::Hit(hit) => {
                    self.shortened = 0;
                    (self.t, self.state) = (hit.t, hit.state);
                    self.place = Place::Within(hit.at);
                    return self.deliver();
                }
                found => {
                    // Where a guard jumps, no step is short enough: do not shorten the following steps again.
                    if !matches!(found, Found::TooCoarse) {
                        self.shortened = 0;
                    }
                    (self.t, self.state) = self.to;
                    self.place = Place::Boundary;
                    return Ok(Step { t: self.t, state: self.state, event: None });
                }
            }
        }
    }

    /// True if the step to the event of a guard has an error above the tolerance there. A step is accepted by the error that is allowed at
    /// its end, which may be far beyond an event that cuts it, and only the state at its end has this error: between its ends
    /// that of dense output is the integral of the difference between the rate of its polynomial and the rate of the system.
    /// Events of the user do not change the steps.
    fn is_too_long_for(&mut self, hit: &Hit<S>) -> bool {
        let restarts = self.signs.guards().any(|guard| guard.is_pending);
        if hit.at > LATE_EVENT || !restarts || self.system.went_over_change() {
            return false;
        }
        let (y, part) = (&self.from.1, to_f64(self.to.0 - self.from.0) * hit.at);
        let of_step = control::error(const { &M::TABLEAU }, &self.tolerance, (y, &hit.state), &self.slopes, part);
        if of_step <= CERTAIN {
            return false;
        }
        let Ok(step) = self.interpolant() else { return true };
        COMPARED.into_iter().any(|at| {
            let fraction = real::<S::Scalar>(at * hit.at);
            let Ok(rate) = self.slope(step.time(at * hit.at), &step.at_fraction(fraction)) else { return true };
            let difference = (step.rate_at_fraction(fraction) - rate) * real::<S::Scalar>(part);
            self.tolerance.relative_change(&difference, &hit.state) > 1.0
        })
    }

    /// Takes the last step anew, not longer than this.
    fn repeat_to(&mut self, length: f64) {
        self.go_back(self.from.0, self.from.1);
        self.counts.accepted -= 1;
        self.counts.rejected += 1;
        self.limit_next(length);
    }

    /// Rebuilds the integration with the same start, end and settings for another method or system.
    pub(crate) fn with<S2: System<Scalar = S::Scalar, N = S::N>, M2: Method>(
        self,
        system: impl FnOnce(S) -> S2,
    ) -> Result<Integration<S2, M2>, ErrorOf<S2>> {
        let (largest, most_steps, stiffness_every, parts) =
            (self.largest, self.most_steps, self.stiffness_every, self.parts);
        let (length, safety) = (self.controller.length, self.controller.safety);
        let mut other = Integration::new(system(self.system), (self.start, self.state), self.end, self.tolerance)?;
        (other.largest, other.most_steps, other.stiffness_every, other.parts) =
            (largest, most_steps, stiffness_every, parts);
        (other.controller.length, other.controller.safety) = (length, safety);
        Ok(other)
    }

    /// Returns true if a step begins here.
    pub(crate) fn is_at_boundary(&self) -> bool {
        self.place == Place::Boundary && !self.signs.has_pending()
    }

    pub(crate) fn system_mut(&mut self) -> &mut S {
        &mut self.system
    }

    /// The length of the next trial step, without sign.
    pub(crate) fn next_length(&self) -> Option<f64> {
        self.controller.length
    }

    /// Limits the length of the next step.
    pub(crate) fn limit_next(&mut self, length: f64) {
        self.controller.length =
            Some(self.controller.length.map_or(length, |next| if next < length { next } else { length }));
    }

    /// Sets the safety factor of the step-size controller.
    pub(crate) fn set_safety(&mut self, safety: f64) {
        self.controller.safety = safety;
    }

    pub(crate) fn set_tolerance(&mut self, tolerance: Tolerance<S::Scalar, S::N>) {
        self.tolerance = tolerance;
    }

    /// Replaces the state reached: by a projected one, or by one in other coordinates.
    pub(crate) fn exchange(&mut self, state: StateOf<S>) {
        self.state = state;
        self.has_rate = false;
    }

    /// Replaces the state reached by its projection onto the constraints. If the correction is negligible relative to
    /// the tolerance, which is usual, the last slope is reused.
    pub(crate) fn correct(&mut self, state: StateOf<S>) {
        self.has_rate =
            self.has_rate && self.tolerance.relative_change(&(state - self.state), &state) <= NEGLIGIBLE_CORRECTION;
        self.state = state;
    }

    /// Returns to an earlier point; the step length is kept.
    pub(crate) fn go_back(&mut self, t: S::Scalar, state: StateOf<S>) {
        (self.from, self.to) = ((t, state), (t, state));
        self.interpolant = Some(Interpolant::constant(t, state));
        self.t = t;
        self.place = Place::Boundary;
        self.signs.drop_pending();
        self.exchange(state);
    }

    /// Restarts the motion from this state at a time just after the one reached. Outputs before it remain.
    pub(crate) fn restart_at(&mut self, t: S::Scalar, state: StateOf<S>) -> Result<(), ErrorOf<S>> {
        self.restart(state)?;
        self.t = t;
        self.has_crossed = true;
        Ok(())
    }

    /// The start and the end of the last step.
    pub(crate) fn last_step(&self) -> [(S::Scalar, StateOf<S>); 2] {
        [self.from, self.to]
    }

    /// The interval with available states: from the start of the last step to the time reached.
    pub(crate) fn reached(&self) -> [S::Scalar; 2] {
        [self.from.0, self.t]
    }

    pub(crate) fn end(&self) -> S::Scalar {
        self.end
    }

    /// The state at a time within the last step; at its ends exactly the stored states.
    pub(crate) fn state_within(&mut self, t: S::Scalar) -> Result<StateOf<S>, ErrorOf<S>> {
        if t == self.from.0 {
            return Ok(self.from.1);
        }
        if t == self.to.0 {
            return Ok(self.to.1);
        }
        let state = self.interpolant()?.at(t);
        finite("the state", t, &state)?;
        Ok(state)
    }

    /// The cubic through the last step.
    pub(crate) fn cubic(&self) -> Interpolant<S::Scalar, S::N> {
        let ((t, y), (end, next)) = (&self.from, &self.to);
        Interpolant::cubic(*t, *end - *t, [y, next], [&self.slopes[0], &self.slopes[M::TABLEAU.end]])
    }
}

impl<S: System, M: Method> Iterator for Integration<S, M> {
    type Item = Result<StepOf<S>, ErrorOf<S>>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}
