//! Bounded contact forces: a complementarity problem (LCP) solved by an active-set method.
//!
//! The problem is w = A f + b with w = 0 where f is between its bounds, w >= 0 at a lower and w <= 0 at an upper bound;
//! f are forces and w accelerations `s''`, or impulses and rates. These are the conditions for the minimum of
//! f . A f / 2 + b . f; w is unique, f need not be. At first all forces are at a bound. They are released one after the other, the
//! one with the greatest decrease of the function first; the released forces are solved for together, and the first
//! that meets a bound is fixed there (C. L. Lawson and R. J. Hanson, *Solving Least Squares Problems*, 1974, chapter
//! 23, here with two bounds). Each iteration decreases the function, so that no active set repeats.

use super::tolerance::held_tolerance;
use linkage_runtime::__shared::Ranked;
use linkage_runtime::{Build, Column, Dim, Matrix, Real, real};

/// A force between bounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds<T> {
    pub lower: T,
    pub upper: T,
    /// b, and the sum of the magnitudes of its terms.
    pub bias: (T, T),
}

/// The forces f and the slack w; a w within rounding error is set to 0.
pub(super) struct Solution<T: Real, C: Dim> {
    pub forces: Column<T, C>,
    pub slack: Column<T, C>,
}

/// The state of the active-set method.
struct Search<'a, T: Real, C: Dim> {
    matrix: &'a Matrix<T, C, C>,
    bounds: &'a Column<Option<Bounds<T>>, C>,
    forces: Column<T, C>,
    /// The released contacts, in the order of release.
    free: Column<usize, C>,
    count: usize,
}

/// Solves for the forces of the contacts that have bounds.
///
/// # Errors
/// The index of a contact that no force can hold; of the first contact with bounds if the search does not end.
pub(super) fn bounded<T: Real, C: Dim>(
    matrix: &Matrix<T, C, C>,
    bounds: &Column<Option<Bounds<T>>, C>,
) -> Result<Solution<T, C>, usize> {
    let c = bounds.dim();
    let start = |bounds: &Option<Bounds<T>>| match bounds {
        Some(Bounds { lower, upper, bias }) if !lower.is_finite() || (bias.0 < T::zero() && upper.is_finite()) => {
            *upper
        }
        Some(Bounds { lower, .. }) => *lower,
        None => T::zero(),
    };
    let forces = c.column(|place| start(&bounds[place]));
    let mut search = Search { matrix, bounds, forces, free: c.repeat(0), count: 0 };
    let mut stuck = c.repeat(false);
    // The limit on iterations: 2 of 2 000 000 random sets of six contacts reach it (tests/choices.rs).
    for _ in 0..32 * (c.count() + 1) {
        let slack: Column<T, C> = c.column(|place| search.slack(place));
        let Some(next) = search.next(&slack, &stuck) else {
            return Ok(Solution { forces: search.forces, slack });
        };
        let before = search.forces;
        search.release(next, slack[next])?;
        if search.forces == before {
            // No force moved: only rounding error released it. It stays fixed until another one moves.
            stuck[next] = true;
        } else {
            stuck = c.repeat(false);
        }
    }
    Err((0..c.count()).find(|&place| bounds[place].is_some()).unwrap_or(0))
}

impl<T: Real, C: Dim> Search<'_, T, C> {
    /// The released contacts.
    fn free(&self) -> &[usize] {
        &self.free.as_slice()[..self.count]
    }

    /// Returns w of a contact, 0 within rounding error.
    fn slack(&self, place: usize) -> T {
        let Some(Bounds { bias, .. }) = self.bounds[place] else { return T::zero() };
        if self.free().contains(&place) {
            return T::zero();
        }
        let terms = self.forces.iter().enumerate().map(|(other, &force)| self.matrix[(place, other)] * force);
        let (sum, size) = terms.fold(bias, |(sum, size), term| (sum + term, size + term.abs()));
        // An eighth of the tolerance at which a held contact is released.
        if sum.abs() <= held_tolerance::<T>() * size * real(0.125) { T::zero() } else { sum }
    }

    /// Returns the fixed contact whose release decreases the function most; None at the minimum.
    fn next(&self, slack: &Column<T, C>, stuck: &Column<bool, C>) -> Option<usize> {
        let mut best: Option<(usize, T)> = None;
        for place in 0..self.forces.dim().count() {
            let Some(Bounds { lower, upper, .. }) = self.bounds[place] else { continue };
            let force = self.forces[place];
            let gains = (slack[place] < T::zero() && force < upper) || (slack[place] > T::zero() && force > lower);
            if !gains || stuck[place] || self.free().contains(&place) {
                continue;
            }
            // Decrease along this force alone: w^2 / (2 A); unbounded where A = 0.
            let entry = self.matrix[(place, place)];
            let gain = slack[place] * slack[place] / entry;
            let gain = if gain.is_finite() { gain } else { real(f64::INFINITY) };
            if best.is_none_or(|(_, most)| gain > most) {
                best = Some((place, gain));
            }
        }
        best.map(|(place, _)| place)
    }

    /// Releases a force and moves all free forces to their minimum.
    fn release(&mut self, next: usize, slack: T) -> Result<(), usize> {
        self.free[self.count] = next;
        self.count += 1;
        loop {
            let factors = Ranked::in_order(self.matrix, &self.free, self.count, held_tolerance());
            let mut direction = self.forces.dim().zeros();
            // If the new row depends on the others, the forces move along the null space of A up to a bound.
            let is_endless = factors.rank < self.count;
            if is_endless {
                let combination = factors.combination(self.count - 1);
                let sign = if slack > T::zero() { -T::one() } else { T::one() };
                for (entry, &c) in direction.iter_mut().zip(&combination).take(factors.rank) {
                    *entry = -sign * c;
                }
                direction[self.count - 1] = sign;
            } else {
                direction = factors.solve(|row| -self.gradient(row));
            }
            let mut blocked: Option<(usize, T)> = None;
            for (place, &change) in direction.iter().enumerate().take(self.count) {
                let Some(Bounds { lower, upper, .. }) = self.bounds[self.free[place]] else { continue };
                let force = self.forces[self.free[place]];
                let room = if change > T::zero() {
                    upper - force
                } else if change < T::zero() {
                    lower - force
                } else {
                    continue;
                };
                let part = (room / change).max(T::zero());
                if (is_endless || part < T::one()) && blocked.is_none_or(|(_, least)| part < least) {
                    blocked = Some((place, part));
                }
            }
            let part = match blocked {
                Some((_, part)) if part.is_finite() => part,
                _ if is_endless && self.is_level(&direction) => {
                    self.count -= 1;
                    return Ok(());
                }
                _ if is_endless => return Err(next),
                _ => T::one(),
            };
            for (&contact, &change) in self.free.iter().zip(&direction).take(self.count) {
                self.forces[contact] += change * part;
            }
            let Some((place, _)) = blocked else { return Ok(()) };
            self.pin(place, direction[place] > T::zero());
            if self.count == 0 {
                return Ok(());
            }
        }
    }

    /// Returns true if the function is constant, within rounding error, along a null-space direction of the free
    /// forces.
    fn is_level(&self, direction: &Column<T, C>) -> bool {
        let terms = self.free.iter().zip(direction).take(self.count).map(|(&contact, &change)| {
            let bias = self.bounds[contact].map_or((T::zero(), T::zero()), |bounds| bounds.bias);
            (bias.0 * change, bias.1 * change.abs())
        });
        let (slope, size) = terms.fold((T::zero(), T::zero()), |(a, b), (slope, size)| (a + slope, b + size));
        slope.abs() <= held_tolerance::<T>() * size
    }

    /// b + A f.
    fn gradient(&self, row: usize) -> T {
        let bias = self.bounds[row].map_or(T::zero(), |bounds| bounds.bias.0);
        self.forces.iter().enumerate().fold(bias, |sum, (other, &force)| sum + self.matrix[(row, other)] * force)
    }

    /// Fixes a force at the bound that it has met.
    fn pin(&mut self, place: usize, at_upper: bool) {
        let contact = self.free[place];
        if let Some(Bounds { lower, upper, .. }) = self.bounds[contact] {
            self.forces[contact] = if at_upper { upper } else { lower };
        }
        self.free.as_mut_slice().copy_within(place + 1..self.count, place);
        self.count -= 1;
    }
}
