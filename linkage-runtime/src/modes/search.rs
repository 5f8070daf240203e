//! The search for all positions of a group: the roots of the Dixon determinant, each polished on the loops.

use core::mem;

use super::circle::{Root, TrigonometricPolynomial, direction};
use super::dixon::Dixon;
use super::numbers::Numbers;
use super::{Loops, MOST, Modes, Unknown};
use crate::position::{Evaluated, polished, regularity};
use crate::scalar::{largest, to_f64};
use crate::{PositionError, Real};

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

/// The search for all positions of one group.
pub(super) struct Search<'a, T, F, G, const L: usize, const N: usize> {
    /// The names of the mechanism and of the group.
    pub names: [&'static str; 2],
    pub loops: &'a Loops<T, L, N>,
    pub are: &'a [Unknown<T>; N],
    /// The unknowns from the angles of the directions and the lengths.
    pub unknowns: F,
    /// The residuals of the group, the sums of the magnitudes of their terms, and the columns of J.
    pub evaluate: G,
}

/// The result of the search with one direction as x.
enum Outcome {
    /// Every root of the determinant is a position of its own: the list is whole.
    Whole,
    /// The determinant is zero for every x, within rounding error.
    Zero,
    /// A root is in doubt, where the regularity of the group is this.
    Doubt(f64),
}

impl<T, F, G, const L: usize, const N: usize> Search<'_, T, F, G, L, N>
where
    T: Real,
    F: Fn([T; N]) -> [T; N],
    G: Fn([T; N]) -> Evaluated<T, N>,
{
    /// All positions.
    pub fn run(&self) -> Result<Modes<T, N>, PositionError> {
        let numbers = Numbers::new(self.names, self.loops, self.are)?;
        match L {
            2 => self.of_numbers::<6, 7>(&numbers),
            _ => self.of_numbers::<20, 21>(&numbers),
        }
    }

    /// All positions, with a matrix of at most `SIZE` rows whose determinant has at most `TERMS` terms. If a root is in
    /// doubt with one direction as x, as where two positions share it, the next is tried.
    fn of_numbers<const SIZE: usize, const TERMS: usize>(
        &self,
        numbers: &Numbers<L>,
    ) -> Result<Modes<T, N>, PositionError> {
        let [mechanism, group] = self.names;
        let mut modes = Modes::none();
        let mut error = PositionError::Undetermined { mechanism, group };
        let turning = numbers.turning();
        for kept in (1..=numbers.directions).filter(|kept| turning.is_none_or(|turning| turning == *kept)) {
            match self.with::<SIZE, TERMS>(numbers, kept, &mut modes) {
                Outcome::Whole => {
                    modes.sort();
                    return Ok(modes);
                }
                Outcome::Zero => {}
                Outcome::Doubt(regularity) => error = PositionError::Undecided { mechanism, group, regularity },
            }
        }
        Err(error)
    }

    /// Adds the positions found with this direction as x.
    fn with<const SIZE: usize, const TERMS: usize>(
        &self,
        numbers: &Numbers<L>,
        kept: usize,
        modes: &mut Modes<T, N>,
    ) -> Outcome {
        let dixon = Dixon::<SIZE>::new(&numbers.rows, numbers.equations(), numbers.directions, kept);
        let Some(dixon) = dixon else { return Outcome::Zero };
        let Some(degree) = dixon.degree() else { return Outcome::Zero };
        let determinant = TrigonometricPolynomial::<TERMS>::of(degree, |x| dixon.determinant(x));
        let Some(determinant) = determinant else { return Outcome::Zero };
        let roots = determinant.roots();
        let Some(roots) = roots.as_slice() else { return Outcome::Zero };
        let mut outcome = Outcome::Whole;
        // Two simple roots never have the same position.
        let mut reached = [false; MOST];
        for root in roots {
            match *root {
                Root::Simple(angle) => match self.follow(numbers, &dixon, angle) {
                    Ok(found) => {
                        let place = self.add(modes, numbers, found).and_then(|place| reached.get_mut(place));
                        if place.is_none_or(|reached| mem::replace(reached, true)) {
                            outcome = Outcome::Doubt(self.regularity(found));
                        }
                    }
                    Err(regularity) => outcome = Outcome::Doubt(regularity),
                },
                Root::Cluster([low, high]) => {
                    for angle in [low, 0.5 * (low + high), high] {
                        let found = self.follow(numbers, &dixon, angle);
                        outcome =
                            Outcome::Doubt(found.map_or_else(|regularity| regularity, |found| self.regularity(found)));
                        found.ok().and_then(|found| self.add(modes, numbers, found));
                    }
                }
            }
        }
        match outcome {
            // Positions that are not real come in pairs, and the number of all is even.
            Outcome::Whole if !modes.count.is_multiple_of(2) => Outcome::Doubt(0.0),
            outcome => outcome,
        }
    }

    /// The position at a root, or the regularity of the group there if it is not clear whether there is one.
    fn follow<const SIZE: usize>(&self, numbers: &Numbers<L>, dixon: &Dixon<SIZE>, angle: f64) -> Result<[T; N], f64> {
        let directions = dixon.directions(direction(angle)).ok_or(0.0)?;
        let start = (self.unknowns)(numbers.values(&directions));
        let is_closed = numbers.residual(&directions) <= OPEN;
        if !is_closed {
            return Err(self.regularity(start));
        }
        let found = polished(self.names, start, &self.evaluate).ok();
        let is_near = |found: &[T; N]| self.distance(numbers, found, &start) <= MOST_MOVED;
        found.filter(is_near).ok_or_else(|| self.regularity(start))
    }

    /// The largest difference of the unknowns of two positions: of angles in radians, of lengths in the units of loops.
    fn distance(&self, numbers: &Numbers<L>, one: &[T; N], other: &[T; N]) -> f64 {
        let differences = self.are.iter().zip(one.iter().zip(other)).map(|(unknown, (one, other))| match unknown {
            Unknown::Angle => to_f64(principal(*one - *other)),
            Unknown::Length { in_loop, .. } => to_f64(*one - *other) / numbers.unit(*in_loop),
        });
        largest(differences)
    }

    /// Adds a position that is not there yet, with angles from -pi to pi, and returns its place; `None` if there is no
    /// room.
    fn add(&self, modes: &mut Modes<T, N>, numbers: &Numbers<L>, mut found: [T; N]) -> Option<usize> {
        for (unknown, value) in self.are.iter().zip(&mut found) {
            if matches!(unknown, Unknown::Angle) {
                *value = principal(*value);
            }
        }
        let is_same = |other: &[T; N]| self.distance(numbers, &found, other) < SAME;
        let known = modes.as_slice().iter().position(is_same);
        if known.is_none() {
            *modes.unknowns.get_mut(modes.count)? = found;
            modes.count += 1;
        }
        Some(known.unwrap_or(modes.count - 1))
    }

    fn regularity(&self, unknowns: [T; N]) -> f64 {
        let (_, _, columns) = (self.evaluate)(unknowns);
        regularity(columns)
    }
}

impl<T: Real, const N: usize> Modes<T, N> {
    fn none() -> Self {
        Self { unknowns: [[T::zero(); N]; MOST], count: 0 }
    }

    /// Sorts the positions by the first unknown, then by the second, and so on.
    fn sort(&mut self) {
        let count = self.count;
        if let Some(all) = self.unknowns.get_mut(..count) {
            all.sort_unstable_by(|one, other| one.partial_cmp(other).unwrap_or(core::cmp::Ordering::Equal));
        }
    }
}

/// An angle from -pi to pi.
fn principal<T: Real>(angle: T) -> T {
    let turns = (angle / T::two_pi()).round();
    angle - turns * T::two_pi()
}
