//! The states of a simulation at given times.

use super::motion::Position;
use super::run::{Moment, Rates, Simulation};
use super::watch::Watch;
use crate::Scene;
use crate::integrate::Method;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Error, Real};

impl<S, T, const U: usize, const V: usize, const N: usize, const C: usize, M, W, const K: usize>
    Simulation<'_, S, T, U, V, N, C, M, W, K>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
    M: Method,
    W: Watch<T, Position<S, T, U, V, N, C>, Rates<S, T, U, V, N, C>, K, C>,
{
    pub(super) fn output(&mut self, t: T) -> Result<Option<Moment<S, T, U, V, N, C>>, Error> {
        let end = self.integration.end();
        let [earliest, _] = self.integration.reached();
        let is_forward = end >= earliest;
        let ahead = to_f64(if is_forward { end - t } else { t - end });
        let behind = to_f64(if is_forward { t - earliest } else { earliest - t });
        if !(ahead >= 0.0 && behind >= 0.0) {
            let [a, b] = [earliest, end].map(to_f64);
            let (least, most) = if a < b { (a, b) } else { (b, a) };
            return Err(Error::OutOfRange { quantity: "the output time", value: to_f64(t), least, most });
        }
        while if is_forward { t > self.state.t } else { t < self.state.t } {
            if self.advance()?.is_none() {
                return Ok(None);
            }
        }
        if t == self.state.t {
            return Ok(Some(self.state));
        }
        let y = self.integration.state_within(t)?;
        let motion = self.integration.system();
        let closed = motion.closed(t, &y)?;
        let (closed, _) = motion.reviewed(&self.contacts, t, &closed)?;
        let mut state = motion.state(t, &closed)?;
        for (touch, mode) in state.contacts.iter_mut().zip(self.contacts.modes) {
            touch.mode = mode;
        }
        Ok(Some(state))
    }
}

/// The states of a simulation at given times. Made by [`Simulation::at`].
///
/// It ends after the last time, where an event stops the simulation, or with an error; what came before stands. A time
/// that is not in the part of the interval that lies ahead is an [`Error::OutOfRange`].
pub struct Outputs<
    's,
    'a,
    S,
    T,
    I,
    const U: usize,
    const V: usize,
    const N: usize,
    const C: usize,
    M,
    W,
    const K: usize,
> where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    pub(super) simulation: &'s mut Simulation<'a, S, T, U, V, N, C, M, W, K>,
    pub(super) times: I,
    pub(super) failed: bool,
}

impl<S, T, I, const U: usize, const V: usize, const N: usize, const C: usize, M, W, const K: usize> Iterator
    for Outputs<'_, '_, S, T, I, U, V, N, C, M, W, K>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
    I: Iterator<Item = T>,
    M: Method,
    W: Watch<T, Position<S, T, U, V, N, C>, Rates<S, T, U, V, N, C>, K, C>,
{
    type Item = Result<Moment<S, T, U, V, N, C>, Error>;

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
