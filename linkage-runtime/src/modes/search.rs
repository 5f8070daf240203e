//! The search for all positions of a group: the roots of the Dixon determinant, each polished on the loops.

use core::mem;

use super::circle::{Root, TrigonometricPolynomial, direction};
use super::dixon::{Dixon, Minors, Number, power_of_two};
use super::{Loops, MOST, Modes};
use crate::position::{Evaluated, polished};
use crate::scalar::to_f64;
use crate::{PositionError, Real, real};

/// Loops whose residual at the directions of a root is larger than this, relative to the sum of their lengths, do not
/// close: the root is that of a factor of the determinant that has no position. From 1e-6 to 1e-2 the positions found
/// are the same.
const OPEN: f64 = 1e-3;

/// A position that is polished may move its directions by this much, in radians.
const MOST_MOVED: f64 = 0.1;

/// Positions that differ less than this, in radians, are one: near a dead point a position is accurate to the root of
/// epsilon.
const SAME: f64 = 1e-6;

pub(super) struct Search<'a, T, F, G, const L: usize, const N: usize> {
    pub names: [&'static str; 2],
    pub loops: &'a Loops<T, L, N>,
    pub unknowns: F,
    pub evaluate: G,
}

/// What one choice of x found.
struct Pass {
    /// True if every root is a position or none.
    is_complete: bool,
}

impl<T, F, G, const L: usize, const N: usize> Search<'_, T, F, G, L, N>
where
    T: Real,
    F: Fn([T; N]) -> [T; N],
    G: Fn([T; N]) -> Evaluated<T, N>,
{
    /// All positions.
    pub fn run(&self) -> Result<Modes<T, N>, PositionError> {
        let [mechanism, _] = self.names;
        let rows = self.rows().ok_or(PositionError::NotFinite { mechanism, quantity: "a coefficient of the loops" })?;
        match L {
            2 => self.passes::<6, 7>(&rows),
            _ => self.passes::<20, 21>(&rows),
        }
    }

    /// All positions, with a matrix of at most `SIZE` rows and a determinant of at most `TERMS` terms.
    fn passes<const SIZE: usize, const TERMS: usize>(
        &self,
        rows: &[[Number; 7]; L],
    ) -> Result<Modes<T, N>, PositionError> {
        let [mechanism, group] = self.names;
        let minors = Minors::of(rows);
        let mut modes = Modes::none();
        let mut undecided = None;
        for kept in 1..=N {
            let Some(pass) = self.pass::<SIZE, TERMS>(rows, &Dixon::new(&minors, kept), &mut modes) else { continue };
            if pass.is_complete {
                modes.sort();
                return Ok(modes);
            }
            undecided = Some(PositionError::Undecided { mechanism, group, regularity: 0.0 });
        }
        Err(undecided.unwrap_or(PositionError::Undetermined { mechanism, group }))
    }

    /// c, each loop divided by a power of two; `None` if a coefficient is not finite.
    fn rows(&self) -> Option<[[Number; 7]; L]> {
        let mut rows = [[Number::default(); 7]; L];
        let loops = self.loops.constants.iter().zip(&self.loops.factors);
        for (row, (constant, factors)) in rows.iter_mut().zip(loops) {
            for (to, [re, im]) in row.iter_mut().zip(core::iter::once(constant).chain(factors)) {
                *to = Number::new(to_f64(*re), to_f64(*im));
            }
            let largest = row.iter().map(|number| number.re.abs().max(number.im.abs())).fold(0.0, f64::max);
            let sum: f64 = row.iter().map(|number| number.re + number.im).sum();
            if !sum.is_finite() && !row.iter().all(|number| number.re.is_finite() && number.im.is_finite()) {
                return None;
            }
            let scale = power_of_two(largest);
            if scale > 0.0 {
                for number in row {
                    *number /= scale;
                }
            }
        }
        Some(rows)
    }

    /// Adds the positions that this choice of x finds; `None` if it says nothing.
    fn pass<const SIZE: usize, const TERMS: usize>(
        &self,
        rows: &[[Number; 7]; L],
        dixon: &Dixon<SIZE>,
        modes: &mut Modes<T, N>,
    ) -> Option<Pass> {
        let polynomial = dixon
            .is_proper()
            .then(|| TrigonometricPolynomial::<TERMS>::of(dixon.degree(), |x| dixon.determinant(x)))??;
        let roots = polynomial.roots();
        let mut is_complete = true;
        // The positions of this pass: two simple roots never have the same.
        let mut reached = [false; MOST];
        for root in roots.as_slice()? {
            match *root {
                Root::Simple(angle) => {
                    let place = self.follow(rows, dixon, angle).and_then(|found| modes.add(found));
                    let is_new =
                        place.and_then(|place| reached.get_mut(place)).is_some_and(|one| !mem::replace(one, true));
                    is_complete &= is_new;
                }
                Root::Cluster([low, high]) => {
                    // Each end and the middle are tried; only a list without clusters is known to be whole.
                    for angle in [low, 0.5 * (low + high), high] {
                        self.follow(rows, dixon, angle).and_then(|found| modes.add(found));
                    }
                    is_complete = false;
                }
            }
        }
        is_complete &= modes.count.is_multiple_of(2);
        Some(Pass { is_complete })
    }

    /// The position at a root; `None` if it is not clear whether there is one.
    fn follow<const SIZE: usize>(&self, rows: &[[Number; 7]; L], dixon: &Dixon<SIZE>, angle: f64) -> Option<[T; N]> {
        let directions = dixon.directions(direction(angle))?;
        let residual = rows.iter().map(|row| {
            let terms = || row[1..=N].iter().zip(&directions).map(|(factor, direction)| factor * direction);
            let sum = row[0] + terms().sum::<Number>();
            let size = row[0].l1_norm() + terms().map(|term| term.l1_norm()).sum::<f64>();
            sum.l1_norm() / size
        });
        if residual.fold(0.0, f64::max) > OPEN {
            return None;
        }
        let mut start = [T::zero(); N];
        for (to, direction) in start.iter_mut().zip(&directions) {
            *to = real::<T>(direction.im).arctangent2(real(direction.re));
        }
        let start = (self.unknowns)(start);
        let found = polished(self.names, start, &self.evaluate).ok()?;
        let moved = found.iter().zip(&start).map(|(to, from)| to_f64(*to - *from).abs()).fold(0.0, f64::max);
        (moved < MOST_MOVED).then_some(found)
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
