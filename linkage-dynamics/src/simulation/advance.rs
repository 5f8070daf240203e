//! The main loop of a simulation: steps and events.

use super::motion::Parametrisation;
use super::parametrisation::{AtSingularity, STEPS_BEFORE_RETURN};
use super::run::Simulation;
use super::state::{State, Touch};
use super::watch::{Then, Watch};
use crate::contact::Change;
use crate::integrate::Method;
use crate::{MotionError, Scene, StateColumn};
use linkage_runtime::__shared::{same_signs, to_f64};
use linkage_runtime::{Column, Dim, Mechanism};

impl<S: Scene, M: Method, W: Watch<S>> Simulation<'_, S, M, W> {
    pub(super) fn proceed(&mut self) -> Result<Option<State<S>>, MotionError> {
        loop {
            let is_prepared = core::mem::take(&mut self.is_prepared);
            if self.integration.is_at_boundary() && !is_prepared {
                self.prepare()?;
            }
            if self.integration.is_at_boundary()
                && let Some(corner) = self.integration.system().corner_at(self.integration.t())
            {
                return self.cross_here(&corner).map(Some);
            }
            let start = (self.integration.is_at_boundary()).then(|| (self.integration.t(), *self.integration.state()));
            let advanced = self.integration.advance();
            let corners = &self.integration.system().corners;
            let Some(step) = advanced.map_err(|error| corners.explained(S::NAME, error))? else { return Ok(None) };
            if start.is_some() && !self.follows_laws()? {
                self.is_prepared = true;
                continue;
            }
            if let Some((t, y)) = start.filter(|_| step.event.is_none())
                && self.ends_too_near(&y, &step.state)
            {
                // Repeat it in two parts: a step over a change point must begin well before it.
                self.integration.go_back(t, y);
                self.integration.limit_next(0.5 * to_f64(step.t - t).abs());
                self.is_prepared = true;
                continue;
            }
            let motion = self.integration.system();
            let q = S::parts(&step.state).q;
            let mechanism = motion.scene.mechanism();
            if matches!(motion.parametrisation, Parametrisation::Inputs) {
                let signs = mechanism.block_determinants(&mechanism.pose_at(&q));
                if !same_signs(self.signs.as_slice(), signs.as_slice()) {
                    if self.at_singularity == AtSingularity::Stop {
                        return Err(motion.singular_error(&q));
                    }
                    // The step passed a singularity: repeat it from its start in regular coordinates.
                    self.go_back()?;
                    continue;
                }
            }
            let contacts = motion.contacts;
            let mut projected = motion.projected(step.t, &step.state)?;
            if step.event.is_none() {
                projected = match motion.on_stops(step.t, &projected, self.largest_deviation()) {
                    Ok(projected) => projected,
                    Err(MotionError::LeftStop { .. }) if self.is_repeated_shorter(start.is_some()) => continue,
                    Err(error) => return Err(error),
                };
            }
            let (kept, holds) = motion.reviewed(&contacts, step.t, &projected)?;
            let mut state =
                State { event: step.event.filter(|&event| event < W::Events::COUNT), ..motion.state(step.t, &kept)? };
            let result = match step.event {
                Some(event) if event < W::Events::COUNT => self.happens(event, &mut state, &kept),
                None if holds && let Some(corner) = self.corner(step.t) => self.cross(&corner, &mut state, &kept),
                None if holds => {
                    state.kink = self.integration.system().corners.passed;
                    if kept != step.state {
                        self.integration.correct(kept);
                    }
                    Ok(())
                }
                // Contacts settle from the projected state, where the guard is zero.
                _ => self.settle(&mut state, &projected),
            };
            // With several contact events at one time, the first settles all contacts.
            if step.event.is_some() && state.event.is_none() && result.is_ok() && state.changes().next().is_none() {
                continue;
            }
            self.failure = result.err();
            if step.event.is_some() {
                self.from = (step.t, *self.integration.state());
            }
            (self.state, self.contacts) = (state, contacts);
            return Ok(Some(self.state));
        }
    }

    /// Repeats the last step in other coordinates than the inputs.
    fn go_back(&mut self) -> Result<(), MotionError> {
        let (t, y) = self.from;
        self.integration.go_back(t, y);
        self.steps_before_return = STEPS_BEFORE_RETURN;
        self.leave_inputs()?;
        self.is_prepared = true;
        Ok(())
    }

    /// Applies the user's action at an event.
    fn happens(&mut self, event: usize, state: &mut State<S>, projected: &StateColumn<S>) -> Result<(), MotionError> {
        let motion = self.integration.system_mut();
        match motion.watch.at_event(event, state)? {
            Then::GoOn => {}
            Then::Stop => self.integration.stop(),
            Then::Restart(input_rates) => {
                let y = motion.with_input_rates(&state.q, &input_rates.into())?;
                let (after, changes) = motion.resumed(state.t, projected, &y)?;
                self.integration.restart(after)?;
                self.note(state, changes);
            }
        }
        Ok(())
    }

    /// Applies impacts and mode changes of the contacts.
    fn settle(&mut self, state: &mut State<S>, projected: &StateColumn<S>) -> Result<(), MotionError> {
        let (after, changes) = self.integration.system_mut().settled(state.t, projected)?;
        self.integration.restart(after)?;
        self.note(state, changes);
        Ok(())
    }

    /// Records the changes and the new modes of the contacts in the state.
    pub(super) fn note(&self, state: &mut State<S>, changes: Column<Option<Change>, S::Contacts>) {
        let modes = self.integration.system().contacts.modes;
        for ((touch, mode), change) in state.contacts.iter_mut().zip(modes).zip(changes) {
            *touch = Touch { mode, change, ..*touch };
        }
    }
}
