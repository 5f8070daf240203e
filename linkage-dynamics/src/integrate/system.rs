//! Systems of differential equations.

use core::marker::PhantomData;

use nalgebra::SVector;

use super::{Action, Crossing, Interpolant};
use crate::MotionError;
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::{BorrowedName, Build, Column, D, Dim, Real};

/// The value of a guard function at one state: where it falls below zero, the law of the rate changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guard<T> {
    /// Its value.
    pub value: T,
    /// Its time derivative, if known; otherwise difference quotients are used.
    pub rate: Option<T>,
}

/// The state of a system, or its rate.
pub type StateOf<S> = Column<<S as System>::Scalar, <S as System>::N>;
/// The guards of a system.
pub type GuardsOf<S> = Column<Guard<<S as System>::Scalar>, <S as System>::Guards>;
/// The error of an integration, with names of a system.
pub type ErrorOf<S> = MotionError<<S as System>::Name>;

/// A system of differential equations y' = f(t, y) with events and guards. A Rust function of (t, y) is a system
/// without events ([`IntoSystem`]).
///
/// One object provides all functions, so that they share internal state: the last position as a guess, the choice of
/// independent coordinates, the modes of contacts.
pub trait System {
    /// The scalar type of times and components.
    type Scalar: Real;
    /// The type of names in its errors: `&'static str`, or names that are borrowed.
    type Name: BorrowedName;
    /// The number of components of the state.
    type N: Dim;
    /// The number of events.
    type Events: Dim;
    /// The number of guards.
    type Guards: Dim;

    /// y' = f(t, y).
    ///
    /// # Errors
    /// If the rate does not exist at this state; a shorter step is then tried.
    fn rate(&mut self, t: Self::Scalar, y: &StateOf<Self>) -> Result<StateOf<Self>, ErrorOf<Self>>;

    /// The largest estimated error of each component of the rates returned since the last call, or None if these are
    /// exact to rounding error. It adds to the error of a step.
    fn uncertainty(&mut self) -> Option<StateOf<Self>> {
        None
    }

    /// The numbers of events and of guards. A system needs a body of it if one is not a constant.
    #[inline]
    fn counts(&self) -> (Self::Events, Self::Guards) {
        (Dim::least(), Dim::least())
    }

    /// The functions whose zeros are the events.
    ///
    /// # Errors
    /// If they cannot be computed; the integration then ends.
    fn events(
        &mut self,
        t: Self::Scalar,
        y: &StateOf<Self>,
    ) -> Result<Column<Self::Scalar, Self::Events>, ErrorOf<Self>>;

    /// The direction in which each must pass through zero.
    fn crossings(&self) -> Column<Crossing, Self::Events> {
        self.counts().0.repeat(Crossing::Either)
    }

    /// The guards: where one falls below zero the law of the rate changes. Examples: the reserve of a sticking
    /// friction, the gap of an open stop. They are numbered as events after the user's.
    ///
    /// # Errors
    /// If they cannot be computed; the integration then ends.
    fn guards(&mut self, t: Self::Scalar, y: &StateOf<Self>) -> Result<GuardsOf<Self>, ErrorOf<Self>> {
        let _ = (t, y);
        Ok(self.counts().1.repeat(Guard { value: Self::Scalar::one(), rate: Some(Self::Scalar::zero()) }))
    }

    /// A bound of the change of each guard with a known rate while each component of the state moves from its value by at most so
    /// much, in any complex direction: it bounds the guard between samples. `None`, or what is no number, where no bound is known.
    #[inline]
    fn guard_changes(
        &mut self,
        y: &StateOf<Self>,
        moves: &StateOf<Self>,
    ) -> Column<Option<Self::Scalar>, Self::Guards> {
        let _ = (y, moves);
        self.counts().1.repeat(None)
    }

    /// The action at event `event`; events at the same time are handled in the order of their numbers.
    ///
    /// # Errors
    /// Any error ends the integration.
    fn at_event(
        &mut self,
        event: usize,
        t: Self::Scalar,
        y: &StateOf<Self>,
    ) -> Result<Action<StateOf<Self>>, ErrorOf<Self>> {
        let _ = (event, t, y);
        Ok(Action::Record)
    }

    /// The end of a step from `t` that would go to `end`: nearer if the law of the rate is known to change before it, so
    /// that no step goes over the change.
    #[inline]
    fn end_of_step(&mut self, t: Self::Scalar, end: Self::Scalar) -> Self::Scalar {
        let _ = t;
        end
    }

    /// Returns the fraction of a step at which it must end because the law of the rate changes within it; the step is
    /// then repeated with this length. `step` interpolates the states and the rates at both ends.
    ///
    /// # Errors
    /// Any error ends the integration.
    #[inline]
    fn change_of_law(&mut self, step: &Interpolant<Self::Scalar, Self::N>) -> Result<Option<f64>, ErrorOf<Self>> {
        let _ = step;
        Ok(None)
    }

    /// True if the last step went over a change of the law: it is not repeated with a shorter length, where guards change as much.
    #[inline]
    fn went_over_change(&self) -> bool {
        false
    }

    /// Called before each step, after the outputs of the last one. A returned state replaces the current one: projected
    /// onto a constraint, or in other coordinates, which the rate must then use too. The step length is kept.
    ///
    /// # Errors
    /// Any error ends the integration.
    fn before_step(&mut self, t: Self::Scalar, y: &StateOf<Self>) -> Result<Option<StateOf<Self>>, ErrorOf<Self>> {
        let _ = (t, y);
        Ok(None)
    }
}

/// The state type of user functions: nalgebra's [`SVector`] or a [`Column`].
pub trait StateVector: Copy + From<Column<Self::Scalar, Self::N>> + Into<Column<Self::Scalar, Self::N>> {
    /// The scalar type of the components.
    type Scalar: Real;
    /// The number of components.
    type N: Dim;
}

impl<T: Real, const N: usize> StateVector for SVector<T, N> {
    type Scalar = T;
    type N = D<N>;
}

impl<T: Real, N: Dim> StateVector for Column<T, N> {
    type Scalar = T;
    type N = N;
}

/// The argument of an integration: a [`System`], or a rate as a function of the time and a [`StateVector`].
///
/// `By` distinguishes the two and is always inferred.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not the rate of a motion",
    note = "write `|t, y: &SVector<_, N>| -> Result<SVector<_, N>, MotionError>`; `Ok(f(..)?)` converts other errors"
)]
pub trait IntoSystem<By> {
    /// The resulting system.
    type System: System;

    /// The resulting system.
    fn into_system(self) -> Self::System;
}

impl<S: System> IntoSystem<()> for S {
    type System = S;

    #[inline]
    fn into_system(self) -> S {
        self
    }
}

impl<F, Y: StateVector> IntoSystem<Y> for F
where
    F: FnMut(Y::Scalar, &Y) -> Result<Y, MotionError>,
{
    type System = Rate<F, Y>;

    #[inline]
    fn into_system(self) -> Rate<F, Y> {
        Rate { rate: self, state: PhantomData }
    }
}

/// A rate function as a system without events. Made by [`IntoSystem`].
#[derive(Debug, Clone)]
pub struct Rate<F, Y> {
    rate: F,
    state: PhantomData<Y>,
}

impl<F, Y: StateVector> System for Rate<F, Y>
where
    F: FnMut(Y::Scalar, &Y) -> Result<Y, MotionError>,
{
    type Scalar = Y::Scalar;
    type Name = &'static str;
    type N = Y::N;
    type Events = D<0>;
    type Guards = D<0>;

    #[inline(always)]
    fn rate(&mut self, t: Y::Scalar, y: &StateOf<Self>) -> Result<StateOf<Self>, MotionError> {
        (self.rate)(t, &Y::from(*y)).map(Y::into)
    }

    fn events(&mut self, _: Y::Scalar, _: &StateOf<Self>) -> Result<Column<Y::Scalar, D<0>>, MotionError> {
        Ok(Column::from([]))
    }
}

/// A rate function with event functions. Made by [`watched`].
#[derive(Debug, Clone)]
pub struct Watched<F, G, A, Y, const K: usize> {
    rate: F,
    crossings: [Crossing; K],
    events: G,
    action: A,
    state: PhantomData<Y>,
}

/// Builds a system from a rate, K event functions with the direction in which each must pass through zero, and an
/// action at events. The state is nalgebra's `SVector` or a [`Column`].
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
/// # Ok::<(), linkage_dynamics::MotionError>(())
/// ```
pub fn watched<F, G, A, Y: StateVector, const K: usize>(
    rate: F,
    crossings: [Crossing; K],
    events: G,
    action: A,
) -> Watched<F, G, A, Y, K>
where
    F: FnMut(Y::Scalar, &Y) -> Result<Y, MotionError>,
    G: FnMut(Y::Scalar, &Y) -> Result<[Y::Scalar; K], MotionError>,
    A: FnMut(usize, Y::Scalar, &Y) -> Result<Action<Y>, MotionError>,
{
    Watched { rate, crossings, events, action, state: PhantomData }
}

impl<F, G, A, Y: StateVector, const K: usize> System for Watched<F, G, A, Y, K>
where
    F: FnMut(Y::Scalar, &Y) -> Result<Y, MotionError>,
    G: FnMut(Y::Scalar, &Y) -> Result<[Y::Scalar; K], MotionError>,
    A: FnMut(usize, Y::Scalar, &Y) -> Result<Action<Y>, MotionError>,
{
    type Scalar = Y::Scalar;
    type Name = &'static str;
    type N = Y::N;
    type Events = D<K>;
    type Guards = D<0>;

    #[inline(always)]
    fn rate(&mut self, t: Y::Scalar, y: &StateOf<Self>) -> Result<StateOf<Self>, MotionError> {
        (self.rate)(t, &Y::from(*y)).map(Y::into)
    }

    fn events(&mut self, t: Y::Scalar, y: &StateOf<Self>) -> Result<Column<Y::Scalar, D<K>>, MotionError> {
        (self.events)(t, &Y::from(*y)).map(Column::from)
    }

    fn crossings(&self) -> Column<Crossing, D<K>> {
        Column::from(self.crossings)
    }

    fn at_event(
        &mut self,
        event: usize,
        t: Y::Scalar,
        y: &StateOf<Self>,
    ) -> Result<Action<StateOf<Self>>, MotionError> {
        Ok(match (self.action)(event, t, &Y::from(*y))? {
            Action::Record => Action::Record,
            Action::Stop => Action::Stop,
            Action::Restart(state) => Action::Restart(state.into()),
        })
    }
}
