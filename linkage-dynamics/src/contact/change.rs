//! The change of a contact at an event.

use super::Mode;
use super::state::Contacts;
use linkage_runtime::{Build, Column, Dim, Real};

/// The change of a contact at an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Change {
    /// Friction begins to stick.
    Sticks,
    /// Friction begins to slip, or reverses its direction.
    Slips,
    /// A stop is hit, with a rebound.
    Impact,
    /// s comes to rest on its stop.
    Rests,
    /// s leaves the stop on which it rested.
    LetsGo,
}

/// Returns the change of each contact from modes before an event to its state after it, in the order of the scene.
pub(crate) fn changes<T: Real, C: Dim>(before: &Column<Mode, C>, after: &Contacts<T, C>) -> Column<Option<Change>, C> {
    before.dim().column(|place| match (before[place], after.modes[place]) {
        // A hit with a rebound does not change the mode.
        (Mode::Open, Mode::Open) => after.is_hit[place].then_some(Change::Impact),
        (before, after) if before == after => None,
        (_, Mode::Stick) => Some(Change::Sticks),
        (_, Mode::SlipForward | Mode::SlipBackward) => Some(Change::Slips),
        (_, Mode::AtLower | Mode::AtUpper) => Some(Change::Rests),
        (_, Mode::Open) => Some(Change::LetsGo),
    })
}
