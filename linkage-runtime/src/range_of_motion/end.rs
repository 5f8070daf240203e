//! The end of a motion.

use crate::continuation::Groups;
use crate::{BorrowedName, RangeEnd};

/// The reason why a motion ends at an input.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound(serialize = "N: serde::Serialize")))]
pub enum MotionEnd<N: BorrowedName = &'static str> {
    /// The end of the range of the input that was asked for.
    Range,
    /// A coordinate or an output is at an end of the range that the mechanism declares.
    JointRange {
        /// Its name.
        of: N,
        /// The end of its range.
        end: RangeEnd,
    },
    /// The input reverses here: there is no position beyond.
    DeadPoint {
        /// The unknowns of the group that is singular.
        group: N,
    },
    /// Other motions cross here.
    ChangePoint {
        /// The groups that are singular.
        groups: Groups<N>,
    },
    /// The motion has no end: it is at its start again.
    Closed {
        /// The turns of the input until then.
        turns: u32,
    },
    /// A coordinate went farther than [`most_turns`](super::RangeOptions::most_turns), and the motion did not close.
    Open,
}
