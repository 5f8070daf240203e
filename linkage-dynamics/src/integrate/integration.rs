//! An integration: what it stores from step to step.

use core::marker::PhantomData;

use super::Dop853;
use super::control::{Controller, Tolerance};
use super::dense::Interpolant;
use super::event::EventSigns;
use super::system::{StateOf, System};
use super::tableau::Slopes;
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, Dim, Name, Real};

/// The cost of an integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Counts {
    /// Evaluations of the rate, failed ones included.
    pub evaluations: usize,
    /// Accepted steps.
    pub accepted: usize,
    /// Rejected steps, attempts at the first step included.
    pub rejected: usize,
}

/// A point of an integration: the end of a step, or an event within one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(serialize = "T: serde::Serialize", deserialize = "T: serde::Deserialize<'de>, N: Default"))
)]
pub struct Step<T: Real, N: Dim> {
    /// The time.
    pub t: T,
    /// The state; at an event, before its action.
    pub state: Column<T, N>,
    /// The index of the event, if there is one.
    pub event: Option<usize>,
}

/// The [`Step`] of a system.
pub(super) type StepOf<S> = Step<<S as System>::Scalar, <S as System>::N>;

/// The last event time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Instant<T> {
    pub(super) t: T,
    /// True if the motion restarted there, or at an event just before it.
    pub(super) has_restarted: bool,
    /// True if the motion was continued there after events without end.
    pub(super) has_continued: bool,
}

/// The place reached by an integration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Place {
    /// At the start, at the end of a step, or at a restart.
    Boundary,
    /// At this fraction of a step.
    Within(f64),
    /// The integration has ended.
    Over,
}

/// An iterator over the steps and events of an integration. It ends with an error or at the end of the interval; the
/// last state remains readable after an error.
#[derive(Debug, Clone)]
pub struct Integration<S: System, M = Dop853> {
    pub(super) method: PhantomData<M>,
    pub(super) system: S,
    pub(super) tolerance: Tolerance<S::Scalar, S::N>,
    pub(super) largest: f64,
    pub(super) most_steps: usize,
    pub(super) stiffness_every: usize,
    pub(super) parts: usize,
    pub(super) start: S::Scalar,
    pub(super) end: S::Scalar,
    /// The time and state reached.
    pub(super) t: S::Scalar,
    pub(super) state: StateOf<S>,
    pub(super) place: Place,
    /// The last step: its start, its end, its slopes, and its dense output once requested.
    pub(super) from: (S::Scalar, StateOf<S>),
    pub(super) to: (S::Scalar, StateOf<S>),
    pub(super) slopes: Slopes<S::Scalar, S::N>,
    pub(super) interpolant: Option<Interpolant<S::Scalar, S::N>>,
    /// True if the last slope is the rate at the current state, so that the next step reuses it.
    pub(super) has_rate: bool,
    pub(super) controller: Controller,
    pub(super) counts: Counts,
    pub(super) stiff: u32,
    pub(super) not_stiff: u32,
    pub(super) signs: EventSigns<S::Events, S::Guards>,
    pub(super) instant: Instant<S::Scalar>,
    /// The number of times in a row that the step was shortened for its guards.
    pub(super) shortened: u32,
    /// True after a change of the law, at a time between two of the motion.
    pub(super) has_crossed: bool,
}

pub(super) fn finite<T: Real, N: Dim, S: Name>(
    quantity: &'static str,
    t: T,
    values: &Column<T, N>,
) -> Result<(), MotionError<S>> {
    if values.is_finite() {
        return Ok(());
    }
    Err(MotionError::NotFinite { quantity: S::from_static(quantity), t: to_f64(t) })
}
