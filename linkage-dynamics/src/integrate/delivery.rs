//! Delivery of the events of a step, one after the other.

use super::bounds::Bounds;
use super::crossing::Action;
use super::integration::{Integration, Place, Step, StepOf, finite};
use super::sampled::SampledStep;
use super::search::Found;
use super::system::{ErrorOf, StateOf, System};
use super::tableau::Method;
use crate::MotionError;
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Build, real};

/// A guard may pass zero by this part of the change by errors of the state as large as the tolerance: such errors change a gap that
/// oscillates forty times in a step by a hundred tolerances and more. The error of a cubic falls with the fourth power of the
/// length of its part: a hundredth of this takes three times as many samples where a stop is touched without load.
const TOLERATED: f64 = 0.01;

impl<S: System, M: Method> Integration<S, M> {
    /// Searches the last step after the fraction `from` for the next event: first on a cubic, which requires no
    /// evaluation of the rate, then on the dense output if there may be one.
    pub(super) fn search(&mut self, from: f64) -> Result<Found<S>, ErrorOf<S>> {
        let (resolution, tolerated) = (self.resolution(), self.tolerated());
        let signs = self.signs;
        if self.interpolant.is_none() {
            let cubic = self.cubic();
            let mut course = SampledStep { system: &mut self.system, step: &cubic, resolution, tolerated };
            let found = self.signs.search(&mut course, true, (from, self.parts))?;
            if !matches!(found, Found::Perhaps) {
                return Ok(found);
            }
        }
        self.signs = signs;
        let interpolant = self.interpolant()?;
        let mut course = SampledStep { system: &mut self.system, step: &interpolant, resolution, tolerated };
        self.signs.search(&mut course, false, (from, self.parts))
    }

    /// A part of the change of each guard by errors of the state at the start of the step as large as the tolerance.
    fn tolerated(&mut self) -> Bounds<S> {
        let y = self.from.1;
        let allowed = |component| real(self.tolerance.allowed(component, to_f64(y[component]).abs()));
        let moves = y.dim().column(allowed);
        SampledStep::changes(&mut self.system, &y, &moves).map(|change| change.map(|change| TOLERATED * change))
    }

    /// The rounding error of the time, as a fraction of the last step.
    fn resolution(&self) -> f64 {
        let [start, end] = [self.from.0, self.to.0].map(to_f64);
        to_f64(S::Scalar::default_epsilon()) * (start.abs().max(end.abs()) / (end - start).abs()).max(1.0)
    }

    /// Delivers the next event at this time.
    pub(super) fn deliver(&mut self) -> Result<StepOf<S>, ErrorOf<S>> {
        let (t, state) = (self.t, self.state);
        let resolution = 4.0 * self.resolution() * to_f64(self.to.0 - self.from.0).abs();
        // Events count as simultaneous with the one before them, so that impacts cannot follow each other at ulps of the
        // time without end.
        if to_f64(t - self.instant.t).abs() > resolution {
            (self.instant.has_restarted, self.instant.has_continued) = (false, false);
            self.signs.reset_counts();
        }
        self.instant.t = t;
        let (event, again) = self.signs.take_pending();
        if again && self.instant.has_restarted {
            return Err(MotionError::EventsWithoutEnd { t: to_f64(t), event });
        }
        match self.system.at_event(event, t, &state)? {
            Action::Record => {}
            Action::Stop => self.stop(),
            Action::Restart(state) => self.restart(state)?,
        }
        Ok(Step { t, state, event: Some(event) })
    }

    /// Continues after the error for events without end, from a state that the caller then sets by
    /// [`restart`](Self::restart); false if it has done so at this time.
    pub(crate) fn continue_after_repeats(&mut self) -> bool {
        let is_first = !core::mem::replace(&mut self.instant.has_continued, true);
        if is_first {
            self.place = Place::Boundary;
            self.signs.drop_pending();
            self.signs.reset_counts();
        }
        is_first
    }

    /// Ends the integration.
    pub(crate) fn stop(&mut self) {
        self.place = Place::Over;
    }

    /// Restarts the motion here from this state.
    pub(crate) fn restart(&mut self, state: StateOf<S>) -> Result<(), ErrorOf<S>> {
        finite("the state after an event", self.t, &state)?;
        self.state = state;
        self.has_rate = false;
        self.instant.has_restarted = true;
        self.signs.forget_largest();
        if self.place != Place::Over {
            self.place = Place::Boundary;
        }
        Ok(())
    }
}
