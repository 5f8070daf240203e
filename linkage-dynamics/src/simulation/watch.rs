//! User-defined events.

use super::state::State;
use crate::integrate::Crossing;
use crate::{Inputs, MotionErrorOf, Scene};
use linkage_runtime::{Column, D, Dim};

/// The action at an event of a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Then<I> {
    /// Returns the event among the states; the motion continues.
    GoOn,
    /// Ends the simulation.
    Stop,
    /// Restarts the motion with these input rates, as after an impact.
    Restart(I),
}

/// Event functions of the state of a scene, and the actions at their zeros.
pub trait Watch<S: Scene> {
    /// The number of functions.
    type Events: Dim;

    /// Computes the functions.
    ///
    /// # Errors
    /// If they cannot be computed; the simulation then ends.
    fn values(&mut self, state: &State<S>) -> Result<Column<S::Scalar, Self::Events>, MotionErrorOf<S>>;
    /// The direction in which each must pass through zero.
    fn crossings(&self) -> Column<Crossing, Self::Events>;
    /// The action at an event.
    ///
    /// # Errors
    /// Any error ends the simulation.
    fn at_event(&mut self, event: usize, state: &State<S>) -> Result<Then<Inputs<S>>, MotionErrorOf<S>>;
}

/// No events.
#[derive(Debug, Clone, Copy)]
pub struct Unwatched;

impl<S: Scene> Watch<S> for Unwatched {
    type Events = D<0>;

    fn values(&mut self, _: &State<S>) -> Result<Column<S::Scalar, D<0>>, MotionErrorOf<S>> {
        Ok(Column::from([]))
    }

    fn crossings(&self) -> Column<Crossing, D<0>> {
        Column::from([])
    }

    fn at_event(&mut self, _: usize, _: &State<S>) -> Result<Then<Inputs<S>>, MotionErrorOf<S>> {
        Ok(Then::GoOn)
    }
}

/// User functions as events. Made by [`Simulation::events`](super::Simulation::events).
#[derive(Debug, Clone)]
pub struct EventFunctions<F, A, const K: usize> {
    pub(super) crossings: [Crossing; K],
    pub(super) values: F,
    pub(super) action: A,
}

impl<S, F, A, const K: usize> Watch<S> for EventFunctions<F, A, K>
where
    S: Scene,
    F: FnMut(&State<S>) -> Result<[S::Scalar; K], MotionErrorOf<S>>,
    A: FnMut(usize, &State<S>) -> Result<Then<Inputs<S>>, MotionErrorOf<S>>,
{
    type Events = D<K>;

    fn values(&mut self, state: &State<S>) -> Result<Column<S::Scalar, D<K>>, MotionErrorOf<S>> {
        (self.values)(state).map(Column::from)
    }

    fn crossings(&self) -> Column<Crossing, D<K>> {
        Column::from(self.crossings)
    }

    fn at_event(&mut self, event: usize, state: &State<S>) -> Result<Then<Inputs<S>>, MotionErrorOf<S>> {
        (self.action)(event, state)
    }
}
