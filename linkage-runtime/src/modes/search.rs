//! The search for all positions of a group: the roots of the Dixon determinant, or else cells of angles, each polished on
//! the loops.

use core::mem;

use super::cells::{Cells, Doubt};
use super::circle::{Root, TrigonometricPolynomial, direction};
use super::dixon::Dixon;
use super::linearized::PerAngle;
use super::loops::{Loops, Unknown};
use super::numbered::{MOST, Modes, most_modes};
use super::numbers::Numbers;
use crate::position::{Evaluated, polished, regularity};
use crate::scalar::{largest, to_f64};
use crate::{Name, PositionError, Real};

/// At a root of the determinant that has a position, the residual of the loops is of the size of rounding error, relative
/// to the sum of their lengths. A root whose residual is larger than this is in doubt. At 1e-2 the lists of the tests are the
/// same; at 1e-6 a list of two loops with a length is in doubt, because the root is accurate to 1e-7.
const OPEN: f64 = 1e-3;

/// A position may differ by this much from the directions of its root, in radians. At 1 the lists of the tests are the
/// same; at 1e-4 two more of 1600 with lengths are in doubt.
const MOST_MOVED: f64 = 0.1;

/// Positions that differ less than this, in radians, are one: near a dead point a position is accurate to the root of
/// epsilon.
const SAME: f64 = 1e-6;

/// The most directions that are tried as x. Cells take the time of two to four such tries.
const MOST_TRIED: usize = 2;

/// The search for all positions of one group.
pub(super) struct Search<'a, T, S, F, G, const L: usize, const N: usize> {
    /// The names of the mechanism and of the group.
    pub names: [S; 2],
    pub loops: &'a Loops<T, L, N>,
    pub are: &'a [Unknown<T>; N],
    /// The unknowns from the angles of the directions and the lengths.
    pub unknowns: F,
    /// The residuals of the group, the sums of the magnitudes of their terms, and the columns of J.
    pub evaluate: G,
}

impl<T, S, F, G, const L: usize, const N: usize> Search<'_, T, S, F, G, L, N>
where
    T: Real,
    S: Name + Copy,
    F: Fn([T; N]) -> [T; N],
    G: Fn([T; N]) -> Evaluated<T, N>,
{
    /// All positions.
    pub fn run(&self) -> Result<Modes<T, N>, PositionError<S>> {
        let numbers = Numbers::new(self.names[0], self.loops, self.are)?;
        let found = match L {
            2 => self.by_determinant::<6, 7>(&numbers),
            _ => self.by_determinant::<20, 21>(&numbers),
        };
        found.map_or_else(|| self.by_cells(&numbers), Ok)
    }

    /// All positions, if every root of the determinant is a position of its own. The matrix has at most `SIZE` rows, and its
    /// determinant at most `TERMS` terms.
    fn by_determinant<const SIZE: usize, const TERMS: usize>(&self, numbers: &Numbers<L>) -> Option<Modes<T, N>> {
        if !numbers.has_determinant {
            return None;
        }
        let kept = numbers.turning().map_or(1..=MOST_TRIED, |turning| turning..=turning);
        kept.into_iter().find_map(|kept| {
            let mut modes = Modes::none();
            self.with::<SIZE, TERMS>(numbers, kept, &mut modes).map(|()| modes.sorted())
        })
    }

    /// All positions, by cells.
    fn by_cells(&self, numbers: &Numbers<L>) -> Result<Modes<T, N>, PositionError<S>> {
        let [mechanism, group] = self.names;
        let undecided = |at: &PerAngle| {
            let regularity = self.regularity(self.start(numbers, at));
            PositionError::Undecided { mechanism, group, regularity }
        };
        let system = numbers.system();
        let found = Cells::new(&system, most_modes(L)).search().map_err(|Doubt(at)| undecided(&at))?;
        let mut modes = Modes::none();
        modes.has_family = found.has_family;
        for at in found.as_slice() {
            let start = self.start(numbers, at);
            let found = polished(self.names, start, &self.evaluate).ok();
            let is_near = |found: &[T; N]| self.distance(numbers, found, &start) <= MOST_MOVED;
            self.push(&mut modes, found.filter(is_near).ok_or_else(|| undecided(at))?);
        }
        if modes.has_family && modes.count == 0 {
            return Err(PositionError::Undetermined { mechanism, group });
        }
        Ok(modes.sorted())
    }

    /// The unknowns at these angles of the directions.
    fn start(&self, numbers: &Numbers<L>, angles: &PerAngle) -> [T; N] {
        (self.unknowns)(numbers.values(&angles.map(direction)))
    }

    /// Adds the positions found with this direction as x. `None` if a root is in doubt, as where two positions share it, or
    /// if the determinant is zero for every x within rounding error.
    fn with<const SIZE: usize, const TERMS: usize>(
        &self,
        numbers: &Numbers<L>,
        kept: usize,
        modes: &mut Modes<T, N>,
    ) -> Option<()> {
        let dixon = Dixon::<SIZE>::new(&numbers.rows, numbers.equations(), numbers.directions, kept)?;
        let determinant = TrigonometricPolynomial::<TERMS>::of(
            dixon.degree()?,
            |x| dixon.determinant::<false>(x).0,
            |x| dixon.determinant::<true>(x),
        )?;
        let roots = determinant.roots();
        // Two simple roots never have the same position.
        let mut reached = [false; MOST];
        for root in roots.as_slice()? {
            let Root::Simple(angle) = *root else { return None };
            let found = self.follow(numbers, &dixon, angle)?;
            let place = self.add(modes, numbers, found)?;
            if mem::replace(reached.get_mut(place)?, true) {
                return None;
            }
        }
        // Positions that are not real come in pairs, and the number of all is even.
        modes.count.is_multiple_of(2).then_some(())
    }

    /// The position at a root; `None` if it is not clear whether there is one.
    fn follow<const SIZE: usize>(&self, numbers: &Numbers<L>, dixon: &Dixon<SIZE>, angle: f64) -> Option<[T; N]> {
        let directions = dixon.directions(direction(angle))?;
        let is_closed = numbers.residual(&directions) <= OPEN;
        if !is_closed {
            return None;
        }
        let start = (self.unknowns)(numbers.values(&directions));
        let found = polished(self.names, start, &self.evaluate).ok()?;
        (self.distance(numbers, &found, &start) <= MOST_MOVED).then_some(found)
    }

    /// The largest difference of the unknowns of two positions: of angles in radians, of lengths in the units of loops.
    fn distance(&self, numbers: &Numbers<L>, one: &[T; N], other: &[T; N]) -> f64 {
        let pairs = self.are.iter().zip(one.iter().zip(other)).enumerate();
        let differences = pairs.map(|(place, (unknown, (one, other)))| match unknown {
            Unknown::Angle => to_f64(principal(*one - *other)),
            Unknown::Length { .. } => to_f64(*one - *other) / numbers.unit(place),
        });
        largest(differences)
    }

    /// Adds a position that is not there yet, with angles from -pi to pi, and returns its place; `None` if there is no
    /// room.
    fn add(&self, modes: &mut Modes<T, N>, numbers: &Numbers<L>, found: [T; N]) -> Option<usize> {
        let is_same = |other: &[T; N]| self.distance(numbers, &found, other) < SAME;
        let known = modes.as_slice().iter().position(is_same);
        known.or_else(|| self.push(modes, found))
    }

    /// Adds a position, and returns its place.
    fn push(&self, modes: &mut Modes<T, N>, mut found: [T; N]) -> Option<usize> {
        for (unknown, value) in self.are.iter().zip(&mut found) {
            if matches!(unknown, Unknown::Angle) {
                *value = principal(*value);
            }
        }
        *modes.unknowns.get_mut(modes.count)? = found;
        modes.count += 1;
        Some(modes.count - 1)
    }

    fn regularity(&self, unknowns: [T; N]) -> f64 {
        let (_, _, columns) = (self.evaluate)(unknowns);
        regularity(columns)
    }
}

/// An angle from -pi to pi.
fn principal<T: Real>(angle: T) -> T {
    let turns = (angle / T::two_pi()).round();
    angle - turns * T::two_pi()
}
