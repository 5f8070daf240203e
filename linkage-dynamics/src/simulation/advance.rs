//! The main loop of a simulation: steps and events.

use super::data::{AtSingularity, Simulation};
use super::motion::{Motion, Parametrisation};
use super::parametrisation::STEPS_BEFORE_RETURN;
use super::state::{State, Touch};
use super::watch::{Then, Watch};
use crate::contact::{Change, Contacts};
use crate::integrate::{Method, Step};
use crate::{Coordinates, MotionError, MotionErrorOf, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{same_signs, to_f64};
use linkage_runtime::{Column, Dim, Mechanism, Name, real};

/// Along a step in the inputs the signs of the determinants are checked each time that a coordinate has moved so far, in
/// radians or divided by the scale of its length. Change points of one group are about pi apart.
const LONGEST_UNCHECKED: f64 = 0.5;

/// The most checks in one step.
const MOST_CHECKS: f64 = 64.0;

/// Bisections to a singularity: to the rounding error of the time.
const MOST_BISECTIONS: usize = 52;

/// The end of a step.
struct End<S: Scene> {
    /// y on the constraints.
    projected: StateColumn<S>,
    /// y with the rates that the contacts keep.
    kept: StateColumn<S>,
    /// True if the modes of the contacts hold.
    holds: bool,
    state: State<S>,
}

impl<S: Scene, M: Method, W: Watch<S>> Simulation<'_, S, M, W> {
    /// Advances to the next event or to the end of the step; None at the end. False for an event of the contacts that
    /// changes nothing, which only outputs stop at: the motion restarts there.
    pub(super) fn proceed(&mut self) -> Result<Option<bool>, MotionErrorOf<S>> {
        loop {
            let is_prepared = core::mem::take(&mut self.is_prepared);
            if self.integration.is_at_boundary() && !is_prepared {
                self.prepare()?;
            }
            let is_new = self.integration.is_at_boundary();
            if is_new && let Some(corner) = self.integration.system().corner_at(self.integration.t()) {
                return self.cross_here(&corner).map(|()| Some(true));
            }
            let step = match self.integration.advance() {
                Ok(Some(step)) => step,
                Ok(None) => return Ok(None),
                Err(error) => return self.settle_together(error),
            };
            if is_new && !self.follows_laws() {
                self.is_prepared = true;
                continue;
            }
            let motion = self.integration.system();
            let q = motion.scene.parts_of(&step.state).q;
            if matches!(motion.parametrisation, Parametrisation::Inputs)
                && let Some(times) = self.sign_change(step.t, &q)
            {
                if self.at_singularity == AtSingularity::Stop {
                    return Err(motion.singular_error(&self.singularity(times)));
                }
                // The step passed a singularity: repeat it from its start in regular coordinates.
                self.go_back()?;
                continue;
            }
            let contacts = motion.contacts;
            let is_long = is_new && self.is_long();
            let end = match self.end_of(&step, &contacts, is_long) {
                Ok(end) => end,
                // It may be too far from the constraints, from a held stop or from a change point.
                Err(_) if is_long => {
                    self.repeat_shorter();
                    continue;
                }
                Err(error) => return Err(error),
            };
            let End { projected, kept, holds, mut state } = end;
            self.count_passage(&projected);
            let corner = if holds { self.corner(step.t) } else { None };
            let motion = self.integration.system();
            state.kink = motion.corners.passed.filter(|_| step.event.is_none() && holds);
            // A friction whose limit was zero, or a stop without force, may hold beyond a kink of its law.
            let settles = state.kink.is_some() && motion.names.dim().count() > 0;
            let result = match (step.event, corner) {
                (Some(event), _) if event < self.watched_events() => self.happens(event, &mut state),
                (None, Some(corner)) => self.cross(&corner, &mut state, &kept),
                (None, None) if holds && !settles => {
                    if kept != step.state {
                        self.integration.correct(kept);
                    }
                    Ok(())
                }
                // Contacts settle from the projected state, where the guard is zero.
                _ => self.settle(&mut state, &projected),
            };
            // With several contact events at one time, the first settles all contacts.
            let has_changed =
                step.event.is_none() || state.event.is_some() || result.is_err() || state.changes().next().is_some();
            self.failure = result.err();
            if step.event.is_some() {
                self.from = (step.t, *self.integration.state());
            }
            (self.state, self.contacts) = (state, contacts);
            return Ok(Some(has_changed));
        }
    }

    /// The number of watched events.
    fn watched_events(&self) -> usize {
        self.integration.system().watch.crossings().dim().count()
    }

    /// The end of a step, or the event within it, on the constraints and on the stops that were held in the step; `is_long`
    /// if it can be repeated with a shorter length.
    fn end_of(
        &self,
        step: &Step<S::Scalar, S::State>,
        contacts: &Contacts<S::Scalar, S::Contacts>,
        is_long: bool,
    ) -> Result<End<S>, MotionErrorOf<S>> {
        let motion = self.integration.system();
        let projected = motion.projected(step.t, &step.state)?;
        let projected = match motion.on_stops(contacts, step.t, &projected, self.largest_deviation()) {
            // The event may be that of the stop.
            Err(MotionError::LeftStop { .. }) if step.event.is_some() && !is_long => projected,
            on_stops => on_stops?,
        };
        let (kept, holds) = motion.reviewed(contacts, step.t, &projected)?;
        let event = step.event.filter(|&event| event < self.watched_events());
        let state = State { event, ..motion.state(step.t, &kept)? };
        Ok(End { projected, kept, holds, state })
    }

    /// Continues after contact events without end: a body that strikes stops in turn, at intervals that shrink to the
    /// rounding error of the time, rests on all of them. Other errors, and a second one at this time, are returned in the
    /// words of a simulation: with the name of the contact or the kink, and next to a change point as that of the forces
    /// in joints.
    fn settle_together(&mut self, error: MotionErrorOf<S>) -> Result<Option<bool>, MotionErrorOf<S>> {
        let MotionError::EventsWithoutEnd { t, event } = error else {
            let motion = self.integration.system();
            return Err(motion
                .corners
                .explained(motion.scene.name(), motion.of_reactions(self.integration.state(), error)));
        };
        // Contacts are numbered after the user's events.
        let Some(place) = event.checked_sub(self.watched_events()) else { return Err(error) };
        let motion = self.integration.system();
        let contact = motion.names.as_slice().get(place).copied().unwrap_or_else(|| Name::from_static(""));
        let error = MotionError::ContactWithoutEnd { scene: motion.scene.name(), contact, t };
        if !self.integration.continue_after_repeats() {
            return Err(error);
        }
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system_mut();
        let contacts = motion.contacts;
        let projected = motion.projected(t, &y)?;
        let mut state = motion.state(t, &projected)?;
        let (after, changes) = motion.settled_together(t, &projected).map_err(|_| error)?;
        self.integration.restart(after)?;
        self.note(&mut state, changes);
        self.from = (t, after);
        (self.state, self.contacts) = (state, contacts);
        Ok(Some(state.changes().next().is_some()))
    }

    /// The times around the first change of sign of the determinants of the groups in a step in the inputs, which ends at
    /// `q`. They are compared between its ends too: a step that passes two change points has the same signs at both.
    fn sign_change(&self, t: S::Scalar, q: &Coordinates<S>) -> Option<[S::Scalar; 2]> {
        let step = self.integration.cubic();
        let (start, end) = step.interval();
        let motion = self.integration.system();
        let way = motion.scaled_norm(&Motion::<S, W>::column(&motion.scene.parts_of(&step.way()).q));
        // NaN and infinity are errors of the step itself.
        let parts = (to_f64(way) / LONGEST_UNCHECKED).clamp(0.0, MOST_CHECKS);
        let (mut part, mut last) = (1.0, start);
        while part < parts {
            let between = start + (end - start) * real(part / parts);
            let is_before = (t - between) * (end - start) > S::Scalar::zero();
            if is_before && !self.has_signs(&motion.scene.parts_of(&step.at(between)).q) {
                return Some([last, between]);
            }
            last = between;
            part += 1.0;
        }
        (!self.has_signs(q)).then_some([last, t])
    }

    /// True if the determinants of the groups have the signs of the start of the step.
    fn has_signs(&self, q: &Coordinates<S>) -> bool {
        let mechanism = self.integration.system().scene.mechanism();
        let signs = mechanism.block_determinants(&mechanism.pose_at(q));
        same_signs(self.signs.as_slice(), signs.as_slice())
    }

    /// The position between two times of the last step at which the signs of the determinants change.
    fn singularity(&self, [mut before, mut after]: [S::Scalar; 2]) -> Coordinates<S> {
        let (step, scene) = (self.integration.cubic(), &self.integration.system().scene);
        for _ in 0..MOST_BISECTIONS {
            let middle = before + (after - before) * real(0.5);
            if self.has_signs(&scene.parts_of(&step.at(middle)).q) {
                before = middle;
            } else {
                after = middle;
            }
        }
        scene.parts_of(&step.at(before)).q
    }

    /// Repeats the last step in other coordinates than the inputs.
    fn go_back(&mut self) -> Result<(), MotionErrorOf<S>> {
        let (t, y) = self.from;
        self.integration.go_back(t, y);
        self.steps_before_return = STEPS_BEFORE_RETURN;
        self.leave_inputs()?;
        self.is_prepared = true;
        Ok(())
    }

    /// Applies the user's action at an event.
    fn happens(&mut self, event: usize, state: &mut State<S>) -> Result<(), MotionErrorOf<S>> {
        let motion = self.integration.system_mut();
        match motion.watch.at_event(event, state)? {
            Then::GoOn => {}
            Then::Stop => self.integration.stop(),
            Then::Restart(input_rates) => {
                let y = motion.with_input_rates(&state.q, &input_rates.into())?;
                let (after, changes) = motion.resumed(state.t, &y)?;
                self.integration.restart(after)?;
                self.note(state, changes);
            }
        }
        Ok(())
    }

    /// Applies impacts and mode changes of the contacts.
    fn settle(&mut self, state: &mut State<S>, projected: &StateColumn<S>) -> Result<(), MotionErrorOf<S>> {
        self.integration.keep_dense_output()?;
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
