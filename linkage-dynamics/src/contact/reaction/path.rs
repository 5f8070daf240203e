//! Sticking frictions of one motion, as all of a linkage with one input at rest: `s_i'' = a_i s''`.
//!
//! On the path f_i = -x sign(a_i) c_i |R_i(f)| from x = -1 to 1 the forces are unique and continuous if the spectral
//! radius of G_ij = c_i |dR_i/df_j| is below 1. At x = 1 they are those of slip forward, at x = -1 of slip backward. If
//! neither slips, `s''` passes zero between them, at admissible forces.
//!
//! If moreover sum_i |a_i| G_ij <= |a_j| / 2 for each j, there are none where one of them slips: let f* be the forces of
//! slip forward and d_i = sign(a_i) (f_i - f*_i) for forces f that hold. Then d_i >= -sum_j G_ij |d_j|, so that
//! sum |a_i| d_i >= 0; but forces that hold are against the motion: sum |a_i| d_i < 0.

use super::admissible::{Existence, HeldForces};
use super::problem::length;
use crate::contact::Mode;
use crate::contact::tolerance::held_tolerance;
use linkage_runtime::__shared::contraction;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

/// The limit on iterations for the forces at one point of the path, and on bisections.
const MOST_ITERATIONS: usize = 500;

/// The path of the forces of all held contacts.
struct Path<'a, T: Real, V: Dim, C: Dim, N: BorrowedName> {
    held: &'a HeldForces<'a, T, V, C, N>,
    /// The contact whose s is the motion.
    pivot: usize,
    /// a, zero for contacts that are not held.
    ratios: Column<T, C>,
    /// The forces of the other contacts.
    moving: Column<T, C>,
}

impl<T: Real, V: Dim, C: Dim, N: BorrowedName> HeldForces<'_, T, V, C, N> {
    /// Decides whether frictions of one motion hold; None if this needs a search. `start` has the forces of the other
    /// contacts.
    pub(super) fn on_path(&self, start: &Column<T, C>) -> Option<Existence<T, C>> {
        let (matrix, c) = (&self.problem.response.matrix, self.is_bounded.dim());
        let held = || (0..c.count()).filter(|&place| self.is_bounded[place]);
        let pivot = held().reduce(|a, b| if matrix[(b, b)] > matrix[(a, a)] { b } else { a })?;
        let ratio = |place: usize| matrix[(place, pivot)] / matrix[(pivot, pivot)];
        let ratios = c.column(|place| if self.is_bounded[place] { ratio(place) } else { T::zero() });
        let is_of_motion = |place: usize| {
            let (entry, ratio) = (matrix[(place, place)], ratios[place]);
            let rest = entry - ratio * ratio * matrix[(pivot, pivot)];
            self.modes[place] == Mode::Stick && entry > T::zero() && rest.abs() <= held_tolerance::<T>() * entry
        };
        if !held().all(is_of_motion) {
            return None;
        }
        let gain = c.matrix(c, |row, column| match &self.problem.reactions[row] {
            Some(reaction) if self.is_bounded[row] && self.is_bounded[column] => {
                reaction.factor * length([0, 1].map(|k| reaction.by[k][column]))
            }
            _ => T::zero(),
        });
        contraction(&gain, c.repeat(T::one()), c.count())?;
        let is_decisive = held().all(|column| {
            let share = held().fold(T::zero(), |sum, row| sum + ratios[row].abs() * gain[(row, column)]);
            share <= ratios[column].abs() * real(0.5)
        });
        let moving: Column<T, C> = c.column(|place| if self.is_bounded[place] { T::zero() } else { start[place] });
        let path = Path { held: self, pivot, ratios, moving };
        let found = path.zero()?;
        match found {
            Some(forces) => Some(Existence::Found(forces)).filter(|_| self.is_admissible(&forces)),
            None => is_decisive.then_some(Existence::Excluded),
        }
    }
}

impl<T: Real, V: Dim, C: Dim, N: BorrowedName> Path<'_, T, V, C, N> {
    /// The forces at which `s'' = 0`, or None if the contacts slip; no answer if an iteration does not end.
    fn zero(&self) -> Option<Option<Column<T, C>>> {
        let problem = self.held.problem;
        let [mut back, mut front] = [-T::one(), T::one()];
        for (end, sign) in [(front, T::one()), (back, -T::one())] {
            let forces = self.at(end, &self.moving)?;
            if problem.stands(self.pivot, &forces) {
                return Some(Some(forces));
            }
            if problem.along(self.pivot, &forces).0 * sign > T::zero() {
                return Some(None);
            }
        }
        let mut forces = self.moving;
        for _ in 0..MOST_ITERATIONS {
            let middle = (back + front) * real(0.5);
            forces = self.at(middle, &forces)?;
            if problem.stands(self.pivot, &forces) {
                return Some(Some(forces));
            }
            // The friction grows against the motion along the path: s'' falls.
            let own = if problem.along(self.pivot, &forces).0 > T::zero() { &mut back } else { &mut front };
            if *own == middle {
                return None;
            }
            *own = middle;
        }
        None
    }

    /// The forces at x.
    fn at(&self, x: T, start: &Column<T, C>) -> Option<Column<T, C>> {
        let mut forces = *start;
        for _ in 0..MOST_ITERATIONS {
            let next = self.ratios.dim().column(|place| {
                let ratio = self.ratios[place];
                if ratio.is_zero() {
                    return self.moving[place];
                }
                let limit = self.held.problem.limit(place, &forces) * x;
                if ratio > T::zero() { -limit } else { limit }
            });
            let change = (next - forces).largest();
            forces = next;
            if change <= real::<T>(4.0) * T::default_epsilon() * forces.largest() {
                return Some(forces);
            }
        }
        None
    }
}
