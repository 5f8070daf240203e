//! The results of a simulation.

use crate::contact::Change;
use crate::{Coordinates, Mode, NameOf, Rates, Scene};
use linkage_runtime::Column;

/// The state of a simulation at one time.
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(
        serialize = "S::Scalar: serde::Serialize, Coordinates<S>: serde::Serialize, Rates<S>: serde::Serialize, \
                     NameOf<S>: serde::Serialize"
    ))
)]
pub struct State<S: Scene> {
    /// The time.
    pub t: S::Scalar,
    /// All coordinates by name, in radians and in the unit of the lengths.
    pub q: Coordinates<S>,
    /// The rates of all coordinates by name.
    pub rates: Rates<S>,
    /// The index of the user-defined event at this time, if there is one; the rates are those before it.
    pub event: Option<usize>,
    /// The effect whose law has a kink at this time, or the driven input of a law whose kink the simulation has found;
    /// the rates are those before it.
    pub kink: Option<NameOf<S>>,
    /// The frictions and stops in the order of declaration. At a change of one, the rates are those before it and the
    /// modes those after it.
    pub contacts: Column<Touch<NameOf<S>>, S::Contacts>,
}

/// The state of a friction or a stop at one time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Touch<N = &'static str> {
    /// The name: `friction on theta3`.
    pub name: N,
    /// The mode, after any change.
    pub mode: Mode,
    /// The change at this time, if there is one.
    pub change: Option<Change>,
}

impl<S: Scene> State<S> {
    /// Returns the mode of the friction or stop with this name, such as `friction on theta3`.
    #[must_use]
    pub fn mode(&self, name: &str) -> Option<Mode> {
        self.contacts.iter().find(|contact| contact.name.as_ref() == name).map(|contact| contact.mode)
    }

    /// Returns the changes at this time, with the names of the frictions and stops.
    pub fn changes(&self) -> impl Iterator<Item = (NameOf<S>, Change)> {
        self.contacts.iter().filter_map(|contact| Some((contact.name, contact.change?)))
    }
}

linkage_runtime::__by_fields!([S: Scene] State<S> { t, q, rates, event, kink, contacts });
