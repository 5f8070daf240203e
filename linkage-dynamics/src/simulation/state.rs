//! The results of a simulation.

use crate::contact::Change;
use crate::{Coordinates, Inputs, Mode, MotionError, Rates, Scene};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, PerInput};

/// The state of a simulation at one time.
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(
        serialize = "S::Scalar: serde::Serialize, Coordinates<S>: serde::Serialize, Rates<S>: serde::Serialize"
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
    /// The frictions and stops in the order of declaration. At a change of one, the rates are those before it and the
    /// modes those after it.
    pub contacts: Column<Touch, S::Contacts>,
}

/// The state of a friction or a stop at one time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Touch {
    /// The name: `friction on theta3`.
    pub name: &'static str,
    /// The mode, after any change.
    pub mode: Mode,
    /// The change at this time, if there is one.
    pub change: Option<Change>,
}

impl<S: Scene> State<S> {
    /// Returns the mode of the friction or stop with this name, such as `friction on theta3`.
    #[must_use]
    pub fn mode(&self, name: &str) -> Option<Mode> {
        self.contacts.iter().find(|contact| contact.name == name).map(|contact| contact.mode)
    }

    /// Returns the changes at this time, with the names of the frictions and stops.
    pub fn changes(&self) -> impl Iterator<Item = (&'static str, Change)> {
        self.contacts.iter().filter_map(|contact| Some((contact.name, contact.change?)))
    }
}

linkage_runtime::__by_fields!([S: Scene] State<S> { t, q, rates, event, contacts });

/// The forces of frictions, stops, drives and joints.
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "S::Scalar: serde::Serialize, Inputs<S>: serde::Serialize, S::Reactions: serde::Serialize",
        deserialize = "S::Scalar: serde::Deserialize<'de>, Inputs<S>: serde::Deserialize<'de>, \
                       S::Reactions: serde::Deserialize<'de>"
    ))
)]
pub struct Loads<S: Scene> {
    /// The force of each friction and stop along its scalar s, in the order of declaration: its work is f ds. With
    /// redundant contacts the forces are not unique; this is one solution.
    pub contacts: Column<S::Scalar, S::Contacts>,
    /// False if other forces of the contacts give the same motion.
    pub are_unique: bool,
    /// The force (for an angle, torque) of each drive; zero for inputs without a drive.
    pub drives: Inputs<S>,
    /// The power of the drives. dE/dt = this + the power of the scene's other forces - the dissipation of frictions and
    /// dampers.
    pub drive_power: S::Scalar,
    /// The forces in the joints that `reaction` statements of the scene name.
    pub joints: S::Reactions,
}

impl<S: Scene> Loads<S> {
    /// Checks that all forces are finite; those in the joints are already checked.
    pub(crate) fn finite(self, t: S::Scalar) -> Result<Self, MotionError> {
        let drives: PerInput<S::Mechanism> = self.drives.into();
        if !self.contacts.iter().chain(drives.iter()).chain([&self.drive_power]).all(S::Scalar::is_finite) {
            return Err(MotionError::NotFinite { quantity: "the loads", t: to_f64(t) });
        }
        Ok(self)
    }
}

linkage_runtime::__by_fields!([S: Scene] Loads<S> { contacts, are_unique, drives, drive_power, joints });
