//! Dry friction and stops: contacts that stick or slip, are open or closed.
//!
//! Each contact acts along a scalar s(q) with a force f; its work is f ds. In any independent coordinates v
//! ([`ReducedEquations`]) `M v'' = Q + S' f`, where S = ds/dv and `s'' = S v'' + s_0`:
//!
//! - friction slips with `f = -sign(s') limit`, or sticks: `s'' = 0` with |f| <= limit;
//! - a stop is open with f = 0, or s rests on it: `s'' = 0` with f directed away from the stop;
//! - at an impact with a stop s'+ = -e s'-; stops that are closed at that time transmit impulses too, so that none is
//!   penetrated. If s then moves towards another stop that it touches, this one is hit at the same time. **Impulses of
//!   friction at an impact are neglected.**
//!
//! [`Contacts`] stores the [`Mode`] of each. At an event the modes of all contacts with s' = 0 follow from one
//! complementarity problem: its bounded forces minimise a convex function, so that `v''` is unique, however many joints
//! stick at once. The forces are not unique where contacts are redundant. A held contact is released only where its
//! force exceeds the limit by 1024 ulps, so that a block pushed exactly with its friction limit stays.
//!
//! The limit of [`ContactLaw::Bearing`] is a factor times the reaction of its joint, which depends on the accelerations
//! and on all contact forces. Then all combinations of modes at rest are examined: there may be one acceleration, none
//! or several ([`MotionError::NoMotion`](crate::MotionError::NoMotion),
//! [`MotionError::SeveralMotions`](crate::MotionError::SeveralMotions)). Between events a motion continues in its modes
//! while they satisfy every law.

mod bearing;
mod bounded;
mod change;
mod held;
mod impact;
mod margin;
mod motion;
mod position;
mod reaction;
mod reduced;
mod settle;
mod state;
mod tolerance;
mod validate;

use linkage_runtime::{Column, Dim, Real};

pub(crate) use bearing::Reduction;
pub use bearing::{Bearing, ReactionRow, ReducedBearing, ReducedReaction};
pub use change::Change;
pub(crate) use change::changes;
pub use motion::ContactMotion;
pub use reduced::{ReducedContact, ReducedEquations};
pub use state::{ContactReview, Contacts};
pub(crate) use tolerance::{sum_tolerance, within};
pub use validate::{validate_contacts, validate_stops};

/// The scalar s(q), a coordinate or an output, along which a friction or a stop acts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, U: Default, V: Default"
    ))
)]
pub struct ContactCoordinate<T: Real, U: Dim, V: Dim> {
    /// s.
    pub value: T,
    /// `ds/du` for each dependent coordinate.
    pub unknowns: Column<T, U>,
    /// `ds/dv` for each input.
    pub inputs: Column<T, V>,
    /// `s''` at `q'' = 0`: the quadratic terms in `q'`.
    pub bias: T,
}

/// A friction or a stop, evaluated at one state.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(serialize = "T: serde::Serialize, N: serde::Serialize"))
)]
pub struct Contact<T: Real, U: Dim, V: Dim, N = &'static str> {
    /// The name used in errors: `friction on theta3`.
    pub name: N,
    /// The scalar along which it acts.
    pub along: ContactCoordinate<T, U, V>,
    /// The law of its force.
    pub law: ContactLaw<T>,
}

/// The law of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactLaw<T> {
    /// Dry friction: |f| <= limit while it sticks, f = -sign(s') limit while it slips.
    Friction {
        /// The greatest force (for an angle, torque); not negative.
        limit: T,
    },
    /// Dry friction by the reaction R of its joint, a [`Bearing`]: |f| <= factor |R| while it sticks,
    /// f = -sign(s') factor |R| while it slips. Without load, R = 0, it slips with f = 0.
    Bearing {
        /// The limit divided by |R|: the coefficient of friction, for a pin times its radius; not negative.
        factor: T,
    },
    /// Stops at both ends of a range: lower <= s <= upper.
    Stop {
        /// The least value of s.
        lower: T,
        /// The greatest value of s.
        upper: T,
        /// The coefficient of restitution e, from 0 to 1.
        restitution: T,
    },
}

/// The state of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mode {
    /// Friction holds s: s' = 0.
    Stick,
    /// Friction slips, s' > 0.
    SlipForward,
    /// Friction slips, s' < 0.
    SlipBackward,
    /// s is between its stops, or is leaving one.
    Open,
    /// s rests on its lower stop.
    AtLower,
    /// s rests on its upper stop.
    AtUpper,
}
