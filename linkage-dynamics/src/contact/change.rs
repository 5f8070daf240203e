//! What a contact has done at an event.

use super::reduced::ReducedEquations;
use super::state::Contacts;
use super::{ContactLaw, Mode};
use linkage_runtime::{Column, Dim, Real};

/// What a contact has done at an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// Friction has begun to hold.
    Sticks,
    /// Friction gives way, or acts the other way round.
    Slips,
    /// A stop was hit, and goes back.
    Impact,
    /// It rests on its stop from here on.
    Rests,
    /// It leaves the stop on which it has rested.
    LetsGo,
}

/// What each contact has done between two states of the same moment, in the order of the scene.
pub(crate) fn changes<T: Real, V: Dim, C: Dim>(
    (before, of_before): (&Contacts<T, C>, &ReducedEquations<T, V, C>),
    (after, of_after): (&Contacts<T, C>, &ReducedEquations<T, V, C>),
) -> Column<Option<Change>, C> {
    Column::from_fn(|place| match (before.modes[place], after.modes[place]) {
        (Mode::Open, Mode::Open) => {
            let contact = &of_before.contacts[place];
            let ContactLaw::Stop { lower, upper, .. } = contact.law else { return None };
            let (side, gap, rounding) = before.nearest(place, contact, [lower, upper]);
            let inward = side.inward::<T>();
            let (towards, away) =
                (contact.rate(&of_before.rates).0 * inward, of_after.contacts[place].rate(&of_after.rates).0 * inward);
            let is_hit = gap <= rounding && towards < T::zero() && away > towards;
            is_hit.then_some(Change::Impact)
        }
        (before, after) if before == after => None,
        (_, Mode::Stick) => Some(Change::Sticks),
        (_, Mode::SlipForward | Mode::SlipBackward) => Some(Change::Slips),
        (_, Mode::AtLower | Mode::AtUpper) => Some(Change::Rests),
        (_, Mode::Open) => Some(Change::LetsGo),
    })
}
