//! What is integrated.

use nalgebra::SVector;

use super::{Action, Crossing};
use linkage_runtime::{Error, Real};

/// A function that ends the law of the rate where it falls below zero, at one state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guard<T> {
    /// Its value.
    pub value: T,
    /// Its change in time, if that is known. Where it is not, differences of values tell.
    pub rate: Option<T>,
}

/// A system of N differential equations y' = f(t, y) with K events and C guards. A closure is one without any.
///
/// One object has it all, so that its parts may share what they know: the last position as a guess, which coordinates
/// are the independent ones, whether a block sticks or slips.
pub trait System<T: Real, const N: usize, const K: usize, const C: usize = 0> {
    /// y' = f(t, y).
    ///
    /// # Errors
    /// If there is no rate at this state; the step is then tried shorter.
    fn rate(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error>;

    /// The functions whose zeros are the events.
    ///
    /// # Errors
    /// If they cannot be computed, which ends the integration.
    fn events(&mut self, t: T, y: &SVector<T, N>) -> Result<[T; K], Error>;

    /// Which way they must pass through zero.
    fn crossings(&self) -> [Crossing; K] {
        [Crossing::Either; K]
    }

    /// The functions that end the law of the rate where they fall below zero, beside the user's events: of what
    /// sticks how much more it holds, of what is apart how far. Guard i is event K + i.
    ///
    /// # Errors
    /// If they cannot be computed, which ends the integration.
    fn guards(&mut self, t: T, y: &SVector<T, N>) -> Result<[Guard<T>; C], Error> {
        let _ = (t, y);
        Ok([Guard { value: T::one(), rate: Some(T::zero()) }; C])
    }

    /// What happens at event `event`; of events at the same time the first comes first.
    ///
    /// # Errors
    /// To end the integration with an error.
    fn at_event(&mut self, event: usize, t: T, y: &SVector<T, N>) -> Result<Action<T, N>, Error> {
        let _ = (event, t, y);
        Ok(Action::Record)
    }

    /// Called at the start, and at the end of each step that another one follows, when the outputs of that step have
    /// been given. A state that it returns takes the place of the old one: projected onto a constraint, or in other
    /// coordinates, in which the rate then is too. The length of the steps is kept.
    ///
    /// # Errors
    /// To end the integration with an error.
    fn before_step(&mut self, t: T, y: &SVector<T, N>) -> Result<Option<SVector<T, N>>, Error> {
        let _ = (t, y);
        Ok(None)
    }
}

impl<F, T: Real, const N: usize> System<T, N, 0> for F
where
    F: FnMut(T, &SVector<T, N>) -> Result<SVector<T, N>, Error>,
{
    #[inline(always)]
    fn rate(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        self(t, y)
    }

    fn events(&mut self, _: T, _: &SVector<T, N>) -> Result<[T; 0], Error> {
        Ok([])
    }
}

/// A rate with events, each a closure. Made by [`watched`].
#[derive(Debug, Clone)]
pub struct Watched<F, G, A, const K: usize> {
    rate: F,
    crossings: [Crossing; K],
    events: G,
    action: A,
}

/// A system of closures: its rate, the K event functions with the way that each must pass through zero, and what
/// happens at an event.
///
/// ```
/// use linkage_dynamics::integrate::{Action, Crossing, Tolerance, dop853, watched};
/// use linkage_runtime::nalgebra::{SVector, vector};
///
/// // A ball falls from 1 m and keeps half of its speed at each impact.
/// let ball = watched(
///     |_t, y: &SVector<f64, 2>| Ok(vector![y[1], -9.81]),
///     [Crossing::Falling],
///     |_t, y| Ok([y[0]]),
///     |_event, _t, y| Ok(Action::Restart(vector![0.0, -0.5 * y[1]])),
/// );
/// let motion = dop853(ball, (0.0, vector![1.0, 0.0]), 1.0, Tolerance::new(1e-10, [1.0, 1.0])?)?;
/// for step in motion {
///     let step = step?;
///     if step.event.is_some() {
///         println!("bounces at {:.6} s", step.t);
///     }
/// }
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
pub fn watched<F, G, A, T: Real, const N: usize, const K: usize>(
    rate: F,
    crossings: [Crossing; K],
    events: G,
    action: A,
) -> Watched<F, G, A, K>
where
    F: FnMut(T, &SVector<T, N>) -> Result<SVector<T, N>, Error>,
    G: FnMut(T, &SVector<T, N>) -> Result<[T; K], Error>,
    A: FnMut(usize, T, &SVector<T, N>) -> Result<Action<T, N>, Error>,
{
    Watched { rate, crossings, events, action }
}

impl<F, G, A, T: Real, const N: usize, const K: usize> System<T, N, K> for Watched<F, G, A, K>
where
    F: FnMut(T, &SVector<T, N>) -> Result<SVector<T, N>, Error>,
    G: FnMut(T, &SVector<T, N>) -> Result<[T; K], Error>,
    A: FnMut(usize, T, &SVector<T, N>) -> Result<Action<T, N>, Error>,
{
    #[inline(always)]
    fn rate(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        (self.rate)(t, y)
    }

    fn events(&mut self, t: T, y: &SVector<T, N>) -> Result<[T; K], Error> {
        (self.events)(t, y)
    }

    fn crossings(&self) -> [Crossing; K] {
        self.crossings
    }

    fn at_event(&mut self, event: usize, t: T, y: &SVector<T, N>) -> Result<Action<T, N>, Error> {
        (self.action)(event, t, y)
    }
}
