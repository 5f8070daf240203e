//! All positions of a group of two or three loops without a formula for each: its assembly modes.

mod cell;
mod cells;
mod circle;
mod dixon;
mod family;
mod linearized;
mod loops;
mod minors;
mod number;
mod numbered;
mod numbers;
mod search;
mod single;
mod solved;
mod triangle;

pub use loops::{Loops, Unknown};
pub use numbered::{AssemblyMode, Modes, most_modes};

use search::Search;

use crate::position::Evaluated;
use crate::{Name, PositionError, Real};

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
    pub fn modes<S: Name + Copy>(
        &mut self,
        mechanism: S,
        group: S,
        loops: Loops<T, L, N>,
        unknowns: impl Fn([T; N]) -> [T; N],
        evaluate: impl Fn([T; N]) -> Evaluated<T, N>,
    ) -> Result<Modes<T, N>, PositionError<S>> {
        let unknowns_are = [Unknown::Angle; N];
        self.modes_with_lengths(mechanism, group, loops, unknowns_are, unknowns, evaluate)
    }

    /// All positions of a group with unknown lengths, as [`modes`](Self::modes). All guides that turn do so with one
    /// direction, and each loop has at most one length. `unknowns` gives the unknowns from the angles of the directions
    /// and the lengths.
    ///
    /// # Errors
    /// Those of [`modes`](Self::modes).
    pub fn modes_with_lengths<S: Name + Copy>(
        &mut self,
        mechanism: S,
        group: S,
        loops: Loops<T, L, N>,
        unknowns_are: [Unknown<T>; N],
        unknowns: impl Fn([T; N]) -> [T; N],
        evaluate: impl Fn([T; N]) -> Evaluated<T, N>,
    ) -> Result<Modes<T, N>, PositionError<S>> {
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
