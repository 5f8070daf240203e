//! Sets of groups of unknowns.

use core::fmt;

use crate::{BorrowedName, Name};

/// Bits of a word.
const BITS: usize = 64;

/// Words of a set. A mechanism with more groups has a Jacobian of 8 MB or more, too large for the stack.
const WORDS: usize = 8;

/// A set of groups of a mechanism, in the order in which they are solved.
#[derive(Clone, Copy)]
pub struct Groups<N: BorrowedName = &'static str> {
    all: N::Groups,
    members: [u64; WORDS],
}

/// Sets are equal if they have the same groups, by number and name.
impl<N: BorrowedName> PartialEq for Groups<N> {
    fn eq(&self, other: &Self) -> bool {
        self.members == other.members && self.iter().eq(other.iter())
    }
}

impl<N: BorrowedName> Groups<N> {
    /// The most groups that a mechanism can have to be followed.
    pub(super) const MOST: usize = BITS * WORDS;

    pub(super) fn none(all: N::Groups) -> Self {
        Self { all, members: [0; WORDS] }
    }

    pub(super) fn insert(&mut self, group: usize) {
        if let Some(word) = self.members.get_mut(group / BITS) {
            *word |= 1 << (group % BITS);
        }
    }

    pub(super) fn contains(&self, group: usize) -> bool {
        self.members.get(group / BITS).is_some_and(|word| word >> (group % BITS) & 1 == 1)
    }

    /// The unknowns of each group, by name.
    pub fn iter(&self) -> impl Iterator<Item = N> + '_ {
        (0..Self::MOST).filter(|&place| self.contains(place)).map_while(|place| N::of_group(self.all, place))
    }

    /// The unknowns of the first group, by name.
    #[must_use]
    pub fn first(&self) -> N {
        self.iter().next().unwrap_or_else(|| Name::from_static(""))
    }
}

/// A set of groups is written as the sequence of their names.
#[cfg(feature = "serde")]
impl<N: BorrowedName + serde::Serialize> serde::Serialize for Groups<N> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<N: BorrowedName> fmt::Debug for Groups<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
