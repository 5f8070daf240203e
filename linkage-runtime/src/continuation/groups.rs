//! Sets of groups of unknowns.

use core::fmt;

use crate::Group;

/// Bits of a word.
const BITS: usize = 64;

/// Words of a set. A mechanism with more groups has a Jacobian of 8 MB or more, too large for the stack.
const WORDS: usize = 8;

/// A set of groups of a mechanism, in the order in which they are solved.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Groups {
    all: &'static [Group],
    members: [u64; WORDS],
}

impl Groups {
    /// The most groups that a mechanism can have to be followed.
    pub(super) const MOST: usize = BITS * WORDS;

    pub(super) fn none(all: &'static [Group]) -> Self {
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
    pub fn iter(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.all.iter().enumerate().filter(|&(place, _)| self.contains(place)).map(|(_, group)| group.name)
    }

    /// The unknowns of the first group, by name.
    #[must_use]
    pub fn first(&self) -> &'static str {
        self.iter().next().unwrap_or_default()
    }
}

/// A set of groups is written as the sequence of their names.
#[cfg(feature = "serde")]
impl serde::Serialize for Groups {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl fmt::Debug for Groups {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
