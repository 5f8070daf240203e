//! The positions of a group in order, each with its number.

use crate::{Name, PositionError, Real};

/// The number of a position of a group among all its positions at the same inputs.
///
/// The positions are in the order of the first unknown of the group, an angle from -pi to pi or a length, then of the
/// second, and so on. The number says no more: along a motion the positions change places in this order, so that a motion
/// is followed by `assemble_near` or a [`Path`](crate::continuation::Path), not by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AssemblyMode {
    /// No number: the position near a guess.
    #[default]
    OfGuess,
    /// The number in the order, from 0.
    Number(usize),
}

impl AssemblyMode {
    /// All numbers that a position of a group of this many loops can have.
    pub fn all(loops: usize) -> impl Iterator<Item = Self> + Clone {
        (0..most_modes(loops)).map(Self::Number)
    }
}

/// The most positions of a group of this many loops: 2, 6, 20.
#[must_use]
pub const fn most_modes(loops: usize) -> usize {
    match loops {
        0 => 0,
        1 => 2,
        2 => 6,
        _ => MOST,
    }
}

/// The most positions of a group of three loops.
pub(super) const MOST: usize = 20;

/// The positions of a group at given inputs, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Modes<T, const N: usize> {
    pub(super) unknowns: [[T; N]; MOST],
    pub(super) count: usize,
    pub(super) has_family: bool,
}

impl<T: Real, const N: usize> Modes<T, N> {
    /// The unknowns of each position.
    #[must_use]
    pub fn as_slice(&self) -> &[[T; N]] {
        self.unknowns.get(..self.count).unwrap_or_default()
    }

    /// True if there are infinitely many positions besides these, which are apart from them.
    #[must_use]
    pub fn has_family(&self) -> bool {
        self.has_family
    }

    /// The unknowns of one position.
    ///
    /// # Errors
    /// [`PositionError::NoMode`] if there is no position of this number, or [`PositionError::Undetermined`] if there are
    /// infinitely many besides; [`PositionError::NoClosedForm`] for [`AssemblyMode::OfGuess`].
    pub fn take<S: Name>(&self, mechanism: S, group: S, mode: AssemblyMode) -> Result<[T; N], PositionError<S>> {
        let AssemblyMode::Number(number) = mode else { return Err(PositionError::NoClosedForm { mechanism, group }) };
        let found = self.as_slice().get(number).copied();
        found.ok_or(match self.has_family {
            true => PositionError::Undetermined { mechanism, group },
            false => PositionError::NoMode { mechanism, group, number, count: self.count },
        })
    }

    /// No position.
    pub(super) fn none() -> Self {
        Self { unknowns: [[T::zero(); N]; MOST], count: 0, has_family: false }
    }

    /// The positions in the order of the first unknown, then of the second, and so on.
    pub(super) fn sorted(mut self) -> Self {
        let count = self.count;
        if let Some(all) = self.unknowns.get_mut(..count) {
            all.sort_unstable_by(|one, other| one.partial_cmp(other).unwrap_or(core::cmp::Ordering::Equal));
        }
        self
    }
}
