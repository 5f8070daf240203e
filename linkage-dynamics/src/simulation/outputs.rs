//! The states of a simulation at given times.

use super::data::{Gap, Simulation};
use super::state::State;
use super::watch::Watch;
use crate::integrate::Method;
use crate::scene::Loads;
use crate::{MotionErrorOf, Scene};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{InputError, Name, real};

impl<S: Scene, M: Method, W: Watch<S>> Simulation<'_, S, M, W> {
    pub(super) fn output(&mut self, t: S::Scalar) -> Result<Option<State<S>>, MotionErrorOf<S>> {
        if let Some(state) = self.output_in_gap(t) {
            return Ok(Some(state));
        }
        let end = self.integration.end();
        let [earliest, _] = self.integration.reached();
        let is_forward = end >= earliest;
        let ahead = to_f64(if is_forward { end - t } else { t - end });
        let behind = to_f64(if is_forward { t - earliest } else { earliest - t });
        if !(ahead >= 0.0 && behind >= 0.0) {
            let [a, b] = [earliest, end].map(to_f64);
            let (least, most) = if a < b { (a, b) } else { (b, a) };
            let (quantity, value) = (Name::from_static("the output time"), to_f64(t));
            return Err(InputError::OutOfRange { of: None, quantity, value, least, most }.into());
        }
        while if is_forward { t > self.state.t } else { t < self.state.t } {
            if self.advance_within()?.is_none() {
                return Ok(None);
            }
            if let Some(state) = self.output_in_gap(t) {
                return Ok(Some(state));
            }
        }
        self.output = None;
        if t == self.state.t {
            return Ok(Some(self.state));
        }
        let y = self.integration.state_within(t)?;
        let motion = self.integration.system();
        let projected = motion.projected(t, &y)?;
        // Without a limit: it holds at the ends of the step.
        let projected = motion.on_stops(&self.contacts, t, &projected, real(f64::INFINITY))?;
        let (projected, _) = motion.reviewed(&self.contacts, t, &projected)?;
        let mut state = motion.state(t, &projected)?;
        for (touch, mode) in state.contacts.iter_mut().zip(self.contacts.modes) {
            touch.mode = mode;
        }
        self.output = Some((t, projected, self.contacts));
        Ok(Some(state))
    }

    /// The state at a time between those around the last change of a law, which is that before it.
    fn output_in_gap(&mut self, t: S::Scalar) -> Option<State<S>> {
        let Gap { before, y, contacts, after } = self.gap.as_ref()?;
        if !(before.t < t && t < *after || *after < t && t < before.t) {
            return None;
        }
        self.output = Some((t, *y, *contacts));
        Some(State { t, ..*before })
    }
}

/// An iterator over the states of a simulation at given times. Made by [`Simulation::at`].
///
/// It ends after the last time, where an event stops the simulation, or with an error; earlier states remain valid. A
/// time outside the interval that remains is an [`InputError::OutOfRange`].
pub struct States<'s, 'a, S: Scene, M, W: Watch<S>, I> {
    pub(super) simulation: &'s mut Simulation<'a, S, M, W>,
    pub(super) times: I,
    pub(super) failed: bool,
}

impl<S, M, W, I> States<'_, '_, S, M, W, I>
where
    S: Scene,
    M: Method,
    W: Watch<S>,
    I: Iterator<Item = S::Scalar>,
{
    /// Returns each state with the forces there, as [`Simulation::loads`] does. Where these cannot be computed the item
    /// is the error, and the next state follows.
    pub fn with_loads(self) -> impl Iterator<Item = Result<(State<S>, Loads<S>), MotionErrorOf<S>>> {
        let mut states = self;
        core::iter::from_fn(move || {
            let state = states.next()?;
            Some(state.and_then(|state| Ok((state, states.simulation.loads()?))))
        })
    }
}

impl<S, M, W, I> Iterator for States<'_, '_, S, M, W, I>
where
    S: Scene,
    M: Method,
    W: Watch<S>,
    I: Iterator<Item = S::Scalar>,
{
    type Item = Result<State<S>, MotionErrorOf<S>>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let t = self.times.next()?;
        let state = self.simulation.output(t);
        self.failed = !matches!(state, Ok(Some(_)));
        state.transpose()
    }
}
