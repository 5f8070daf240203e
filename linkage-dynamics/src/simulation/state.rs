//! What a simulation gives.

use crate::contact::Change;
use crate::{Coordinates, Inputs, Mode, Rates, Scene};
use linkage_runtime::Column;

/// A moment of a motion.
pub struct State<S: Scene> {
    /// The time.
    pub t: S::Scalar,
    /// All coordinates by name: radians, and the unit of the lengths.
    pub q: Coordinates<S>,
    /// The rates of all coordinates by name.
    pub rates: Rates<S>,
    /// The number of the event that happens here, if there is one; the rates are those before it.
    pub event: Option<usize>,
    /// The frictions and stops as they were declared, in order. Where one has changed the rates are those before that,
    /// and the modes those from here on.
    pub contacts: Column<Touch, S::Contacts>,
}

/// A friction or a stop at a moment of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Touch {
    /// Which: `friction on theta3`.
    pub name: &'static str,
    /// What it is doing.
    pub mode: Mode,
    /// What has happened to it here.
    pub change: Option<Change>,
}

impl<S: Scene> State<S> {
    /// What the friction or stop of this name is doing, if there is one: `friction on theta3`.
    #[must_use]
    pub fn mode(&self, name: &str) -> Option<Mode> {
        self.contacts.iter().find(|contact| contact.name == name).map(|contact| contact.mode)
    }

    /// What has happened here, with the names of the frictions and stops.
    pub fn changes(&self) -> impl Iterator<Item = (&'static str, Change)> {
        self.contacts.iter().filter_map(|contact| Some((contact.name, contact.change?)))
    }
}

linkage_runtime::__by_fields!([S: Scene] State<S> { t, q, rates, event, contacts });

/// The forces that frictions, stops and drives exert.
pub struct Loads<S: Scene> {
    /// Of the frictions and stops as they were declared, in order, along what they act on: the work of each is its
    /// force times the change of that. Where more are held than the motion needs, these are some that hold them.
    pub contacts: Column<S::Scalar, S::Contacts>,
    /// Of the drives, of angles torques; zero where an input is not driven.
    pub drives: Inputs<S>,
    /// The power of the drives: with the power of the scene's other forces and what frictions and dampers dissipate,
    /// that is how the energy changes.
    pub drive_power: S::Scalar,
}

linkage_runtime::__by_fields!([S: Scene] Loads<S> { contacts, drives, drive_power });
