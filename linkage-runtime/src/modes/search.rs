//! The search for all positions of a group: the roots of the Dixon determinant, each polished on the loops.

use core::{iter, mem};

use super::circle::{Root, TrigonometricPolynomial, direction};
use super::dixon::{COLUMNS, Dixon, Minors, Number, power_of_two};
use super::{Loops, MOST, Modes};
use crate::position::{Evaluated, polished, regularity};
use crate::scalar::{largest, to_f64};
use crate::{PositionError, Real, real};

/// At a root of the determinant that has a position, the residual of the loops is of the size of rounding error, relative
/// to the sum of their lengths. A root whose residual is larger than this is in doubt. From 1e-6 to 1e-2 the positions of
/// the tests are the same.
const OPEN: f64 = 1e-3;

/// A position may differ by this much from the directions of its root, in radians. From 1e-4 to 1 the positions of the
/// tests are the same.
const MOST_MOVED: f64 = 0.1;

/// Positions that differ less than this, in radians, are one: near a dead point a position is accurate to the root of
/// epsilon.
const SAME: f64 = 1e-6;

/// The least coefficient of a loop, relative to the largest: a product of six does not underflow.
const TINIEST: f64 = 1e-45;

/// The search for all positions of one group.
pub(super) struct Search<'a, T, F, G, const L: usize, const N: usize> {
    /// Of the mechanism and of the group.
    pub names: [&'static str; 2],
    pub loops: &'a Loops<T, L, N>,
    /// The unknowns from the angles of the directions.
    pub unknowns: F,
    /// The residuals of the group, the sums of the magnitudes of their terms, and the columns of J.
    pub evaluate: G,
}

/// c, each loop divided by a power of two.
type Rows<const L: usize> = [[Number; COLUMNS]; L];

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
        let rows = self.rows()?;
        match L {
            2 => self.of_rows::<6, 7>(&rows),
            _ => self.of_rows::<20, 21>(&rows),
        }
    }

    /// All positions, with a matrix of at most `SIZE` rows whose determinant has at most `TERMS` terms. If a root is in
    /// doubt with one direction as x, as where two positions share it, the next is tried.
    fn of_rows<const SIZE: usize, const TERMS: usize>(&self, rows: &Rows<L>) -> Result<Modes<T, N>, PositionError> {
        let [mechanism, group] = self.names;
        let minors = Minors::of(rows);
        let mut modes = Modes::none();
        let mut error = PositionError::Undetermined { mechanism, group };
        for kept in 1..=N {
            match self.with::<SIZE, TERMS>(rows, &Dixon::new(&minors, kept), &mut modes) {
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

    /// c.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`]; [`PositionError::Undecided`] if a length is too small beside the largest.
    fn rows(&self) -> Result<Rows<L>, PositionError> {
        let [mechanism, group] = self.names;
        let mut rows = [[Number::default(); COLUMNS]; L];
        let loops = self.loops.constants.iter().zip(&self.loops.factors);
        for (row, (constant, factors)) in rows.iter_mut().zip(loops) {
            for (to, [re, im]) in row.iter_mut().zip(iter::once(constant).chain(factors)) {
                *to = Number::new(to_f64(*re), to_f64(*im));
            }
            if !row.iter().all(|number| number.re.is_finite() && number.im.is_finite()) {
                return Err(PositionError::NotFinite { mechanism, quantity: "a length of the loops" });
            }
            let size = |number: &Number| number.re.abs().max(number.im.abs());
            let largest = row.iter().map(size).fold(0.0, f64::max);
            let scale = power_of_two(largest);
            if scale > 0.0 {
                // Not by the reciprocal, which overflows for the smallest numbers.
                row.iter_mut().for_each(|number| *number = Number::new(number.re / scale, number.im / scale));
            }
            if row.iter().any(|number| *number != Number::default() && size(number) < TINIEST) {
                return Err(PositionError::Undecided { mechanism, group, regularity: 0.0 });
            }
        }
        Ok(rows)
    }

    /// Adds the positions found with this direction as x.
    fn with<const SIZE: usize, const TERMS: usize>(
        &self,
        rows: &Rows<L>,
        dixon: &Dixon<SIZE>,
        modes: &mut Modes<T, N>,
    ) -> Outcome {
        if !dixon.is_proper() {
            return Outcome::Zero;
        }
        let determinant = TrigonometricPolynomial::<TERMS>::of(dixon.degree(), |x| dixon.determinant(x));
        let Some(determinant) = determinant else { return Outcome::Zero };
        let roots = determinant.roots();
        let Some(roots) = roots.as_slice() else { return Outcome::Zero };
        let mut outcome = Outcome::Whole;
        // Two simple roots never have the same position.
        let mut reached = [false; MOST];
        for root in roots {
            match *root {
                Root::Simple(angle) => match self.follow(rows, dixon, angle) {
                    Ok(found) => {
                        let place = modes.add(found).and_then(|place| reached.get_mut(place));
                        if place.is_none_or(|reached| mem::replace(reached, true)) {
                            outcome = Outcome::Doubt(self.regularity(found));
                        }
                    }
                    Err(regularity) => outcome = Outcome::Doubt(regularity),
                },
                Root::Cluster([low, high]) => {
                    for angle in [low, 0.5 * (low + high), high] {
                        let found = self.follow(rows, dixon, angle);
                        outcome =
                            Outcome::Doubt(found.map_or_else(|regularity| regularity, |found| self.regularity(found)));
                        found.ok().and_then(|found| modes.add(found));
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
    fn follow<const SIZE: usize>(&self, rows: &Rows<L>, dixon: &Dixon<SIZE>, angle: f64) -> Result<[T; N], f64> {
        let directions = dixon.directions(direction(angle)).ok_or(0.0)?;
        let residual = rows.iter().map(|row| {
            let terms = || row[1..=N].iter().zip(&directions).map(|(factor, direction)| factor * direction);
            let sum = row[0] + terms().sum::<Number>();
            sum.l1_norm() / (row[0].l1_norm() + terms().map(|term| term.l1_norm()).sum::<f64>())
        });
        let is_closed = residual.fold(0.0, f64::max) <= OPEN;
        let mut angles = [T::zero(); N];
        for (to, direction) in angles.iter_mut().zip(&directions) {
            *to = real::<T>(direction.im).arctangent2(real(direction.re));
        }
        let start = (self.unknowns)(angles);
        let found = if is_closed { polished(self.names, start, &self.evaluate).ok() } else { None };
        let moved = |found: &[T; N]| largest(found.iter().zip(&start).map(|(to, from)| *to - *from));
        found.filter(|found| moved(found) <= real(MOST_MOVED)).ok_or_else(|| self.regularity(start))
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

    /// Adds a position that is not there yet, with angles from -pi to pi, and returns its place; `None` if there is no
    /// room.
    fn add(&mut self, found: [T; N]) -> Option<usize> {
        let found = found.map(principal);
        let is_same = |other: &[T; N]| {
            let mut differences = found.iter().zip(other).map(|(one, other)| to_f64(principal(*one - *other)).abs());
            differences.all(|difference| difference < SAME)
        };
        let known = self.as_slice().iter().position(is_same);
        if known.is_none() {
            *self.unknowns.get_mut(self.count)? = found;
            self.count += 1;
        }
        Some(known.unwrap_or(self.count - 1))
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
