//! The direction of an event, and the action there.

/// The direction in which an event function passes through zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Either direction.
    Either,
}

/// The action at an event, on a state `Y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action<Y> {
    /// Records the event; the motion continues.
    Record,
    /// Ends the integration.
    Stop,
    /// Restarts the motion from this state: after an impact, or where the law of the rate changes. The step length is
    /// kept.
    Restart(Y),
}
