//! Events of the user's.

use super::state::State;
use crate::integrate::Crossing;
use linkage_runtime::{Error, Real};

/// What happens at an event of a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Then<I> {
    /// The event is given among the states, and the motion goes on.
    GoOn,
    /// The simulation ends here.
    Stop,
    /// The motion starts anew with these rates of the inputs, as after an impact.
    Restart(I),
}

/// K functions of the state whose zeros are events, and what happens there. `I` is the type of the inputs by name.
pub trait Watch<T, Q, I, const K: usize, const C: usize = 0> {
    /// The functions.
    ///
    /// # Errors
    /// If they cannot be computed, which ends the simulation.
    fn values(&mut self, state: &State<T, Q, C>) -> Result<[T; K], Error>;
    /// Which way they must pass through zero.
    fn crossings(&self) -> [Crossing; K];
    /// What happens at an event.
    ///
    /// # Errors
    /// To end the simulation with an error.
    fn at_event(&mut self, event: usize, state: &State<T, Q, C>) -> Result<Then<I>, Error>;
}

/// No events.
#[derive(Debug, Clone, Copy)]
pub struct Unwatched;

impl<T: Real, Q, I, const C: usize> Watch<T, Q, I, 0, C> for Unwatched {
    fn values(&mut self, _: &State<T, Q, C>) -> Result<[T; 0], Error> {
        Ok([])
    }

    fn crossings(&self) -> [Crossing; 0] {
        []
    }

    fn at_event(&mut self, _: usize, _: &State<T, Q, C>) -> Result<Then<I>, Error> {
        Ok(Then::GoOn)
    }
}

/// Events by closures.
#[derive(Debug, Clone)]
pub struct Watched<F, A, const K: usize> {
    pub(super) crossings: [Crossing; K],
    pub(super) values: F,
    pub(super) action: A,
}

impl<F, A, T, Q, I, const K: usize, const C: usize> Watch<T, Q, I, K, C> for Watched<F, A, K>
where
    F: FnMut(&State<T, Q, C>) -> Result<[T; K], Error>,
    A: FnMut(usize, &State<T, Q, C>) -> Result<Then<I>, Error>,
{
    fn values(&mut self, state: &State<T, Q, C>) -> Result<[T; K], Error> {
        (self.values)(state)
    }

    fn crossings(&self) -> [Crossing; K] {
        self.crossings
    }

    fn at_event(&mut self, event: usize, state: &State<T, Q, C>) -> Result<Then<I>, Error> {
        (self.action)(event, state)
    }
}
