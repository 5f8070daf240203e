//! The change of a contact at an event.

use super::reduced::ReducedEquations;
use super::state::Contacts;
use super::{ContactLaw, Mode};
use linkage_runtime::{Column, Dim, Real};

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

/// Returns the change of each contact between two states at the same time, in the order of the scene.
pub(crate) fn changes<T: Real, V: Dim, C: Dim>(
    (before, of_before): (&Contacts<T, C>, &ReducedEquations<T, V, C>),
    (after, of_after): (&Contacts<T, C>, &ReducedEquations<T, V, C>),
) -> Column<Option<Change>, C> {
    Column::from_fn(|place| match (before.modes[place], after.modes[place]) {
        // A hit with a rebound does not change the mode, only the sign of the rate.
        (Mode::Open, Mode::Open) => {
            let contact = &of_before.contacts[place];
            let ContactLaw::Stop { lower, upper, .. } = contact.law else { return None };
            let (side, gap, tolerance) = before.nearest(place, contact, [lower, upper]);
            let inward = side.inward::<T>();
            let (towards, away) =
                (contact.rate(&of_before.rates).0 * inward, of_after.contacts[place].rate(&of_after.rates).0 * inward);
            let is_hit = gap <= tolerance && towards < T::zero() && away > towards;
            is_hit.then_some(Change::Impact)
        }
        (before, after) if before == after => None,
        (_, Mode::Stick) => Some(Change::Sticks),
        (_, Mode::SlipForward | Mode::SlipBackward) => Some(Change::Slips),
        (_, Mode::AtLower | Mode::AtUpper) => Some(Change::Rests),
        (_, Mode::Open) => Some(Change::LetsGo),
    })
}
