//! The margin of held contacts: how far they are from slipping or opening.
//!
//! Let z be the rates of the independent held contacts in a possible motion, s' = c z those of all, and h the forces of
//! the independent ones that would hold. The motion begins if the load does more work on it than friction dissipates:
//! if its margin h z + sum limit |c z| is negative. By the kinematic theorem of limit analysis the contacts hold if and
//! only if no motion has a negative margin; by linearity it suffices to test the motions in which r - 1 contacts are at
//! rest, where r is the number of independent ones (W. Prager, *An Introduction to Plasticity*, 1959). Without
//! redundancy only one contact moves in each of them; K sticking joints of a linkage with one input hold while
//! |Q| <= sum |S| limit.

use super::held::Held;
use super::reduced::ReducedEquations;
use super::tolerance::held_tolerance;
use super::{ContactLaw, Mode};
use linkage_runtime::__shared::{Ranked, reduce_rows};
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real};

impl<T: Real, V: Dim, C: Dim> Held<T, V, C> {
    /// Returns for each contact the least margin of the motions in which it moves, divided by its |s'|, so that it is a
    /// force: the contact slips or opens where it falls through zero. The tolerance of the force is added, so that a
    /// contact loaded exactly to its limit holds.
    pub(super) fn margins<N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
        modes: &Column<Mode, C>,
    ) -> Column<T, C> {
        let limits = equations.contacts.map(|contact| match contact.law {
            ContactLaw::Friction { limit } => limit,
            ContactLaw::Bearing { .. } | ContactLaw::Stop { .. } => T::zero(),
        });
        self.margins_by(modes, |_| Some(limits))
    }

    /// Returns the margins with the limits in each motion, given by s' of the contacts; a motion without limits is left
    /// out.
    pub(super) fn margins_by(
        &self,
        modes: &Column<Mode, C>,
        mut limits: impl FnMut(&Column<T, C>) -> Option<Column<T, C>>,
    ) -> Column<T, C> {
        let (rank, count, c) = (self.factors.rank, self.factors.count, modes.dim());
        let tolerances = self.force_tolerances();
        let mut margins = c.repeat(T::one());
        let mut found = c.repeat(false);
        let combinations: Column<Column<T, C>, C> =
            c.column(|place| if place < count { self.factors.combination(place) } else { c.zeros() });
        // s' of each contact in pivot order, 0 within rounding error.
        let motion = |z: &Column<T, C>| -> Column<T, C> {
            c.column(|place| {
                let terms = combinations[place].iter().zip(z).map(|(&c, &z)| c * z);
                let (sum, size) =
                    terms.fold((T::zero(), T::zero()), |(sum, size), term| (sum + term, size + term.abs()));
                if sum.abs() <= held_tolerance::<T>() * size { T::zero() } else { sum }
            })
        };
        // Takes a motion into account, unless it moves s into a stop.
        let mut include = |z: &Column<T, C>| {
            let moved = motion(z);
            let is_allowed = |place: usize| match modes[self.factors.order[place]] {
                Mode::AtLower => moved[place] >= T::zero(),
                Mode::AtUpper => moved[place] <= T::zero(),
                _ => true,
            };
            if !(0..count).all(is_allowed) {
                return;
            }
            let mut rates = c.zeros();
            for (&contact, &moved) in self.factors.order.iter().zip(&moved).take(count) {
                rates[contact] = moved;
            }
            let Some(limits) = limits(&rates) else { return };
            let mut margin = self.forces.iter().zip(z).take(rank).fold(T::zero(), |sum, (&h, &z)| sum + h * z);
            for (&contact, &moved) in self.factors.order.iter().zip(&moved).take(count) {
                margin += (limits[contact] + tolerances[contact]) * moved.abs();
            }
            for (&contact, &moved) in self.factors.order.iter().zip(&moved).take(count).filter(|(_, s)| !s.is_zero()) {
                let force = margin / moved.abs();
                if !found[contact] || force < margins[contact] {
                    margins[contact] = force;
                    found[contact] = true;
                }
            }
        };
        let mut both = |z: &Column<T, C>| {
            include(z);
            include(&-*z);
        };
        if rank == count || rank == 1 {
            for place in 0..rank {
                let mut z = c.zeros();
                z[place] = T::one();
                both(&z);
            }
        } else if rank > 1 {
            each_choice(c, count, rank - 1, |still| {
                if let Some(z) = motion_with_rest(&combinations, still, rank) {
                    both(&z);
                }
            });
        }
        for &contact in &self.factors.order.as_slice()[rank..count] {
            let (bias, size) = self.response.bias[contact];
            let (mut acceleration, mut size) = (bias, size);
            for (&row, &force) in self.factors.order.iter().zip(&self.forces).take(rank) {
                let term = self.response.matrix[(contact, row)] * force;
                (acceleration, size) = (acceleration + term, size + term.abs());
            }
            // s'' is not zero although the independent contacts are held: a prescribed motion moves this one.
            if acceleration.abs() > held_tolerance::<T>() * size {
                margins[contact] = -acceleration.abs();
            }
        }
        margins
    }

    /// The rounding error of the force of each contact, from those of `s''`: A h = -b has the error |A^-1| |d b|. The terms
    /// of `s''` include those of the held forces, as in the choice of the modes, whose tolerance is an eighth of this one:
    /// a contact that is released here is not held again.
    pub(super) fn force_tolerances(&self) -> Column<T, C> {
        let Ranked { order, rank, count, .. } = &self.factors;
        let matrix = &self.response.matrix;
        let size = |row: usize| {
            let terms = order.iter().zip(&self.forces).take(*rank);
            terms.fold(self.response.bias[row].1, |size, (&other, &force)| size + (matrix[(row, other)] * force).abs())
        };
        let mut tolerances = self.forces.dim().zeros();
        for (place, &contact) in order.iter().enumerate().take(*count) {
            let entry = matrix[(contact, contact)];
            tolerances[contact] = if place < *rank {
                let inverse = self.factors.solve(|row| if row == contact { T::one() } else { T::zero() });
                order.iter().zip(&inverse).take(*rank).fold(T::zero(), |sum, (&row, &of)| sum + of.abs() * size(row))
            } else if entry > T::zero() {
                size(contact) / entry
            } else {
                T::zero()
            };
        }
        tolerances * held_tolerance::<T>()
    }
}

/// Visits every combination of `many` of the numbers below `count`.
fn each_choice<C: Dim>(c: C, count: usize, many: usize, mut visit: impl FnMut(&[usize])) {
    let mut chosen: Column<usize, C> = c.column(|place| place);
    loop {
        visit(&chosen.as_slice()[..many]);
        let Some(place) = (0..many).rev().find(|&place| chosen[place] + many < count + place) else { return };
        chosen[place] += 1;
        for later in place + 1..many {
            chosen[later] = chosen[later - 1] + 1;
        }
    }
}

/// Returns the motion in which the contacts `still` are at rest, if it is unique up to a factor.
fn motion_with_rest<T: Real, C: Dim>(
    combinations: &Column<Column<T, C>, C>,
    still: &[usize],
    rank: usize,
) -> Option<Column<T, C>> {
    let c = combinations.dim();
    let (mut rows, mut pivots) = (c.repeat(c.zeros()), c.repeat(0));
    for (row, &place) in rows.iter_mut().zip(still) {
        *row = combinations[place];
    }
    let size = |row: &Column<T, C>| row.iter().fold(T::zero(), |size, entry| size.max(entry.abs()));
    let sizes = rows.map(|row| size(&row));
    let largest =
        |row: &Column<T, C>| (0..rank).fold(0, |best, at| if row[at].abs() > row[best].abs() { at } else { best });
    reduce_rows(
        &mut rows.as_mut_slice()[..still.len()],
        |step, row| {
            let pivot = largest(row);
            if row[pivot].abs() <= held_tolerance::<T>() * sizes[step] {
                return None;
            }
            pivots[step] = pivot;
            Some(pivot)
        },
        |_, _, _| {},
    )?;
    let free = (0..rank).find(|at| !pivots.as_slice()[..still.len()].contains(at))?;
    let mut z = c.zeros();
    z[free] = T::one();
    for (row, &pivot) in rows.iter().zip(&pivots).take(still.len()) {
        z[pivot] = -row[free] / row[pivot];
    }
    Some(z)
}
