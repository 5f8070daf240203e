//! What a simulation gives.

use crate::Mode;
use crate::contact::Change;

/// A moment of a motion: `Q` is the type of the coordinates by name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<T, Q, const C: usize = 0> {
    /// The time.
    pub t: T,
    /// All coordinates by name: radians, and the unit of the lengths.
    pub q: Q,
    /// The rates of all coordinates by name.
    pub rate: Q,
    /// The number of the event that happens here, if there is one; the rates are those before it.
    pub event: Option<usize>,
    /// The frictions and stops as they were declared, in order. Where one has changed the rates are those before that,
    /// and the modes those from here on.
    pub contacts: [Touch; C],
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

impl<T, Q, const C: usize> State<T, Q, C> {
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

/// The forces that frictions, stops and drives exert: `I` is the type of the inputs by name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loads<T, I, const C: usize> {
    /// Of the frictions and stops as they were declared, in order, along what they act on: the work of each is its
    /// force times the change of that. Where more are held than the motion needs, these are some that hold them.
    pub contacts: [T; C],
    /// Of the drives, of angles torques; zero where an input is not driven.
    pub drives: I,
    /// The power of the drives: with the power of the scene's other forces and what frictions and dampers dissipate,
    /// that is how the energy changes.
    pub drive_power: T,
}
