//! Dry friction and stops: contacts that stick or slip, are open or closed.
//!
//! Each contact acts along a scalar s(q) with a force f whose work is f times the change of s. With M v'' = Q + S' f and
//! s'' = S v'' + `s_0` in any independent coordinates ([`ReducedEquations`]):
//!
//! - friction slips with f = -sign(s') limit, or sticks: s'' = 0 with |f| <= limit;
//! - a stop is open with f = 0, or s rests on it: s'' = 0 with f pushing back;
//! - what reaches a stop goes back with its part e of the rate: s'+ = -e s'-, by an impulse along the row of S, which what
//!   rests on other stops may share. **Impulses of friction at an impact are neglected.**
//!
//! [`Contacts`] keeps the [`Mode`] of each. At an event all that have no rate are decided together: the forces
//! within their bounds that hold what they can are the minimum of a convex function, so that v'' is unique, however many
//! joints stick at once; their forces are not, where the motion needs fewer. What holds is held a little beyond its
//! limit, by 1024 roundings, and slips at its limit, so that a block pushed exactly as hard as its friction holds stays.

mod bounded;
mod change;
mod held;
mod impact;
mod margin;
mod reduced;
mod settle;
mod state;
mod verdict;

use linkage_runtime::{Column, Dim, Real};

pub use change::Change;
pub(crate) use change::changes;
pub use reduced::{ReducedContact, ReducedEquations};
pub use state::{ContactMotion, Contacts};
pub(crate) use state::{rounding_of, within};
pub use verdict::{sound, stops};

/// Where a friction or a stop acts: along a scalar s(q), a coordinate or an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactCoordinate<T: Real, U: Dim, V: Dim> {
    /// s.
    pub value: T,
    /// `ds/du`, by dependent coordinate.
    pub unknowns: Column<T, U>,
    /// `ds/dv`, by input.
    pub inputs: Column<T, V>,
    /// s'' at q'' = 0: the quadratic terms in q'.
    pub bias: T,
}

/// A friction or a stop at a moment of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<T: Real, U: Dim, V: Dim> {
    /// What errors call it: `friction on theta3`.
    pub name: &'static str,
    /// Where it acts.
    pub along: ContactCoordinate<T, U, V>,
    /// What it does there.
    pub law: ContactLaw<T>,
}

/// The law of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactLaw<T> {
    /// Dry friction: a force up to the limit while it sticks, the limit against s' while it slips.
    Friction {
        /// The greatest force, of angles the greatest torque; not negative.
        limit: T,
    },
    /// A stop at either end of a range, which s does not leave.
    Stop {
        /// The least value of s.
        lower: T,
        /// The greatest value of s.
        upper: T,
        /// The part of the rate that an impact gives back, from 0 to 1.
        restitution: T,
    },
}

/// What a contact is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Friction holds s where it is.
    Stick,
    /// Friction while s grows.
    SlipForward,
    /// Friction while s shrinks.
    SlipBackward,
    /// s is between its stops, or leaves one.
    Open,
    /// s rests on its lower stop.
    AtLower,
    /// s rests on its upper stop.
    AtUpper,
}
