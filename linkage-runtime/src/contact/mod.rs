//! Dry friction and stops: contacts that stick or slip, are open or closed.

use nalgebra::SVector;

/// Where a friction or a stop acts: along a scalar s(q), a coordinate or an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Along<T, const U: usize, const V: usize> {
    /// s.
    pub value: T,
    /// `ds/du`, by dependent coordinate.
    pub unknowns: SVector<T, U>,
    /// `ds/dv`, by input.
    pub inputs: SVector<T, V>,
    /// s'' at q'' = 0: the quadratic terms in q'.
    pub bias: T,
}

/// A friction or a stop at a moment of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<T, const U: usize, const V: usize> {
    /// What errors call it: `friction on theta3`.
    pub name: &'static str,
    /// Where it acts.
    pub along: Along<T, U, V>,
    /// What it does there.
    pub law: ContactLaw<T>,
}

/// What a contact does.
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
