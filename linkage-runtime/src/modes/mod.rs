//! All positions of a group of two or three loops without a formula for each: its assembly modes.

mod cells;
mod circle;
mod dixon;
mod family;
mod linearized;
mod minors;
mod numbers;
mod search;
mod single;
mod solved;
mod triangle;

use search::Search;

use crate::position::Evaluated;
use crate::{PositionError, Real};

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
const MOST: usize = 20;

/// The positions of a group at given inputs, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Modes<T, const N: usize> {
    unknowns: [[T; N]; MOST],
    count: usize,
    has_family: bool,
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
    pub fn take(
        &self,
        mechanism: &'static str,
        group: &'static str,
        mode: AssemblyMode,
    ) -> Result<[T; N], PositionError> {
        let AssemblyMode::Number(number) = mode else { return Err(PositionError::NoClosedForm { mechanism, group }) };
        let found = self.as_slice().get(number).copied();
        found.ok_or(match self.has_family {
            true => PositionError::Undetermined { mechanism, group },
            false => PositionError::NoMode { mechanism, group, number, count: self.count },
        })
    }
}

/// The loops of a group: k_i + sum_j c_ij t_j = 0, where t_j is a direction cos + i sin and each number is complex,
/// [real, imaginary].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loops<T, const L: usize, const N: usize> {
    /// k_i, by loop.
    pub constants: [[T; 2]; L],
    /// c_ij, by loop and direction.
    pub factors: [[[T; 2]; N]; L],
}

/// An unknown of a group with lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unknown<T> {
    /// An angle. The direction in its place turns with this unknown, or with an integer combination of all angles.
    Angle,
    /// A length along a guide, in one loop only. The factors of its direction are zero.
    Length {
        /// The loop, from 0.
        in_loop: usize,
        /// d: the length s adds s d, or s d t_j, to the loop.
        along: [T; 2],
        /// j: the direction with which the guide turns, `None` if its direction is given.
        with: Option<usize>,
    },
}

/// The positions of one group, kept until its loops change: a list of all branches solves each group once.
#[derive(Debug, Clone, Copy)]
pub struct Memory<T, const L: usize, const N: usize> {
    last: Option<Last<T, L, N>>,
}

/// The loops of a group, its unknowns, and its positions.
type Last<T, const L: usize, const N: usize> = (Loops<T, L, N>, [Unknown<T>; N], Modes<T, N>);

impl<T, const L: usize, const N: usize> Default for Memory<T, L, N> {
    fn default() -> Self {
        Self { last: None }
    }
}

impl<T: Real, const L: usize, const N: usize> Memory<T, L, N> {
    /// All positions of a group of L loops with N = 2 L unknown angles.
    ///
    /// `unknowns` gives the unknowns from the angles of the directions; `evaluate` is that of
    /// [`newton_group`](crate::position::newton_group).
    ///
    /// # Errors
    /// [`PositionError::Undetermined`] if there are infinitely many positions and none apart from them,
    /// [`PositionError::Undecided`] if rounding error hides how many positions there are, [`PositionError::NotFinite`] if a
    /// number is not finite.
    pub fn modes(
        &mut self,
        mechanism: &'static str,
        group: &'static str,
        loops: Loops<T, L, N>,
        unknowns: impl Fn([T; N]) -> [T; N],
        evaluate: impl Fn([T; N]) -> Evaluated<T, N>,
    ) -> Result<Modes<T, N>, PositionError> {
        let unknowns_are = [Unknown::Angle; N];
        self.modes_with_lengths(mechanism, group, loops, unknowns_are, unknowns, evaluate)
    }

    /// All positions of a group with unknown lengths, as [`modes`](Self::modes). All guides that turn do so with one
    /// direction, and each loop has at most one length. `unknowns` gives the unknowns from the angles of the directions
    /// and the lengths.
    ///
    /// # Errors
    /// Those of [`modes`](Self::modes).
    pub fn modes_with_lengths(
        &mut self,
        mechanism: &'static str,
        group: &'static str,
        loops: Loops<T, L, N>,
        unknowns_are: [Unknown<T>; N],
        unknowns: impl Fn([T; N]) -> [T; N],
        evaluate: impl Fn([T; N]) -> Evaluated<T, N>,
    ) -> Result<Modes<T, N>, PositionError> {
        if let Some((of, are, modes)) = &self.last
            && *of == loops
            && *are == unknowns_are
        {
            return Ok(*modes);
        }
        let names = [mechanism, group];
        let modes = Search { names, loops: &loops, are: &unknowns_are, unknowns, evaluate }.run()?;
        self.last = Some((loops, unknowns_are, modes));
        Ok(modes)
    }
}
