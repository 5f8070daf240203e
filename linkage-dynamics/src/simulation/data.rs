//! A simulation: what it stores from step to step.

use super::motion::Motion;
use super::state::State;
use super::watch::{Unwatched, Watch};
use crate::contact::Contacts;
use crate::integrate::{Dop853, Integration};
use crate::{MotionErrorOf, Scene, StateColumn};
use linkage_runtime::{Column, Mechanism};

/// The determinants of the groups of a scene; their signs distinguish branches.
pub(super) type Signs<S> = Column<<S as Scene>::Scalar, <<S as Scene>::Mechanism as Mechanism>::G>;

/// The contacts of a scene.
type ContactsOf<S> = Contacts<<S as Scene>::Scalar, <S as Scene>::Contacts>;

/// An iterator over the [states](State) of a simulation at the ends of its steps and at its events. It ends with an
/// error or at the end of the interval; the last state remains readable after an error.
pub struct Simulation<'a, S: Scene, M = Dop853, W: Watch<S> = Unwatched> {
    pub(super) integration: Integration<Motion<'a, S, W>, M>,
    pub(super) relative: f64,
    /// The scale of rates divided by that of coordinates.
    pub(super) frequency: S::Scalar,
    pub(super) at_singularity: AtSingularity,
    pub(super) state: State<S>,
    /// The contacts during the step before the state.
    pub(super) contacts: ContactsOf<S>,
    /// The time and the projected y that [`at`](Self::at) returned within the last step, with the contacts in it, if that was the
    /// last call.
    pub(super) output: Option<(S::Scalar, StateColumn<S>, ContactsOf<S>)>,
    /// The times around the last change of a law of time.
    pub(super) gap: Option<Gap<S>>,
    /// The start of the step, projected, and the determinants there.
    pub(super) from: (S::Scalar, StateColumn<S>),
    pub(super) signs: Signs<S>,
    pub(super) passages: Passages,
    /// True if the motion has passed the change point of the sheet on which it goes.
    pub(super) is_beyond: bool,
    /// The remaining steps before the simulation may return to the inputs, if it does not pass the expected singularity
    /// sooner.
    pub(super) steps_before_return: u32,
    pub(super) is_over: bool,
    /// The error that ends the simulation after the current state.
    pub(super) failure: Option<MotionErrorOf<S>>,
    /// True if the coordinates of the next step are chosen.
    pub(super) is_prepared: bool,
}

/// The times between two neighbouring ones around a change of a law, in which no step is.
pub(super) struct Gap<S: Scene> {
    /// The state at the last time before the change, as it is shown and projected, and the contacts until then.
    pub(super) before: State<S>,
    pub(super) y: StateColumn<S>,
    pub(super) contacts: ContactsOf<S>,
    /// The first time after it.
    pub(super) after: S::Scalar,
}

/// The behaviour of a simulation at a singularity of the inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AtSingularity {
    /// Continue: in other coordinates at a dead point, straight on at a change point.
    #[default]
    Pass,
    /// End with [`PositionError::Singular`](linkage_runtime::PositionError::Singular).
    Stop,
}

/// The singularities passed by a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Passages {
    /// Changes of the independent coordinates, returns to the inputs included.
    pub exchanges: usize,
    /// Change points passed between the ends of steps: not those that one step passes there and back.
    pub change_points: usize,
}
