//! One step: stages, error and length.

use nalgebra::ComplexField;

use super::control;
use super::integration::{Counts, Integration, finite};
use super::system::{ErrorOf, StateOf, System};
use super::tableau::{self, Method, Weights};
use crate::MotionError;
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Name, real};

/// A step goes to the end of the interval if it is so much longer at most: no short step is left.
const STRETCH: f64 = 1.01;

impl<S: System, M: Method> Integration<S, M> {
    /// Takes a step.
    pub(super) fn step(&mut self) -> Result<(), ErrorOf<S>> {
        let rule = const { &M::TABLEAU.control };
        let mut is_new = !self.has_rate;
        if let Some(state) = self.system.before_step(self.t, &self.state)? {
            finite("the state before a step", self.t, &state)?;
            self.state = state;
            is_new = true;
        }
        let (t, y) = (self.t, self.state);
        self.slopes[0] = if is_new { self.slope(t, &y)? } else { self.slopes[M::TABLEAU.end] };
        let span = to_f64(self.end - t);
        let direction = span.signum();
        if self.controller.length.is_none() {
            self.controller.length = Some(self.first_length(span));
        }
        let epsilon = to_f64(S::Scalar::default_epsilon());
        if self.signs.each().next().is_some() && is_new {
            let little = real::<S::Scalar>(ComplexField::sqrt(epsilon) * direction * self.length());
            let after = y + self.slopes[0] * little;
            let before = self.signs;
            self.signs.begin(&mut self.system, (t, &y), (t + little, &after))?;
            if core::mem::take(&mut self.has_crossed) {
                self.signs.keep_events(&before);
            }
        }
        let mut failure = None;
        // The length of the step before it was shortened to end at a change of the law; the next step has it.
        let mut whole = None;
        // A step that is to end at a change is not stretched over it.
        let mut stretch = STRETCH;
        loop {
            let length = self.length();
            if self.counts.accepted + self.counts.rejected >= self.most_steps {
                return Err(MotionError::TooManySteps { t: to_f64(t), steps: self.most_steps });
            }
            let last = stretch * length > span.abs();
            let end = if last { self.end } else { t + real::<S::Scalar>(direction * length) };
            // At t = 0 any normal length is allowed, however short relative to the interval.
            if 0.1 * length <= epsilon * to_f64(t).abs() || length < f64::MIN_POSITIVE || end == t {
                return Err(failure.unwrap_or(MotionError::StepTooSmall { t: to_f64(t), step: direction * length }));
            }
            let proposed = end;
            let end = self.system.end_of_step(t, proposed);
            if end == t {
                return Err(MotionError::StepTooSmall { t: to_f64(t), step: 0.0 });
            }
            if end != proposed {
                whole.get_or_insert(length);
            }
            let taken = to_f64(end - t).abs();
            match self.attempt((t, &y), end) {
                Ok((error, next)) => {
                    failure = None;
                    if self.controller.accepts(rule, error, taken) {
                        self.from = (t, y);
                        self.to = (end, next);
                        self.interpolant = None;
                        self.has_rate = true;
                        if let Some(part) = self.system.change_of_law(&self.cubic())? {
                            whole.get_or_insert(length);
                            self.controller.length = Some(part * taken);
                            stretch = 1.0;
                            self.has_rate = false;
                            self.counts.rejected += 1;
                            continue;
                        }
                        if let Some(whole) = whole {
                            self.controller.length = self.controller.length.map(|next| next.max(whole));
                        }
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

    /// Attempts a step to `end`: returns its relative error and the new state, whose slope is evaluated if the step may
    /// be accepted.
    #[inline]
    fn attempt(&mut self, (t, y): (S::Scalar, &StateOf<S>), end: S::Scalar) -> Result<(f64, StateOf<S>), ErrorOf<S>> {
        let table = const { &M::TABLEAU };
        let h = end - t;
        // Errors of other steps.
        self.system.uncertainty();
        tableau::evaluate(counted(&mut self.system, &mut self.counts), table.stages, 1, (t, y), h, &mut self.slopes)?;
        let next = *y + tableau::combination(&self.slopes, table.solution) * h;
        // Relative to an infinite state every error would be zero.
        finite("the rate or the state", end, &next)?;
        let of_end = const { uses(M::TABLEAU.errors[0], M::TABLEAU.end) };
        if of_end {
            self.slopes[table.end] = self.slope(end, &next)?;
        }
        let error = control::error(table, &self.tolerance, (y, &next), &self.slopes, to_f64(h));
        if error.is_nan() {
            return Err(MotionError::NotFinite {
                quantity: Name::from_static("the rate or the state"),
                t: to_f64(end),
            });
        }
        if !of_end && error <= 1.0 {
            self.slopes[table.end] = self.slope(end, &next)?;
        }
        let uncertain = self.system.uncertainty().map(|of_rate| self.tolerance.relative_change(&(of_rate * h), &next));
        Ok((error + uncertain.unwrap_or(0.0), next))
    }

    pub(super) fn slope(&mut self, t: S::Scalar, y: &StateOf<S>) -> Result<StateOf<S>, ErrorOf<S>> {
        self.counts.evaluations += 1;
        let slope = self.system.rate(t, y)?;
        finite("the rate", t, &slope)?;
        Ok(slope)
    }

    fn first_length(&mut self, span: f64) -> f64 {
        let (t, y, slope) = (self.t, self.state, self.slopes[0]);
        let tolerance = self.tolerance;
        control::first_length(M::TABLEAU.order, &tolerance, (&y, &slope), span.abs().min(self.largest), |h| {
            let h = real::<S::Scalar>(h * span.signum());
            self.slope(t + h, &(y + slope * h))
        })
    }

    /// The length of the next step, without sign.
    fn length(&self) -> f64 {
        let whole = to_f64(self.end - self.start).abs();
        self.controller.length.unwrap_or(whole).min(self.largest).min(whole)
    }
}

/// Returns true if this slope has a weight.
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

/// The rate with a count of its evaluations.
#[inline(always)]
pub(super) fn counted<'a, S: System>(
    system: &'a mut S,
    counts: &'a mut Counts,
) -> impl FnMut(S::Scalar, &StateOf<S>) -> Result<StateOf<S>, ErrorOf<S>> + 'a {
    move |t, y| {
        counts.evaluations += 1;
        system.rate(t, y)
    }
}
