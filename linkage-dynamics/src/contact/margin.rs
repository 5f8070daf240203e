//! How far contacts that are held are from giving way.
//!
//! A motion z that they could make together, s' = c z, begins if the load does more work on it than friction takes:
//! what is left is h z + sum limit |c z|, with h a set of forces that would hold them. By the kinematic theorem of limit
//! analysis they hold if and only if no motion gains, and by linearity it is enough to look at the motions in which all
//! but one of the independent contacts stand still (W. Prager, *An Introduction to Plasticity*, 1959). Where none is
//! redundant these are the contacts one by one; K sticking joints of a linkage of one input hold while |Q| is
//! not more than the sum of |S| limit.

use super::held::{Held, nothing};
use super::reduced::ReducedEquations;
use super::{ContactLaw, Mode};
use linkage_runtime::{Column, Dim, Real};

impl<T: Real, V: Dim, C: Dim> Held<T, V, C> {
    /// By contact, the least that is left of the motions that it takes part in: it gives way where this falls through
    /// zero. A little more than nothing is left where the load is just what the limit can hold, so that rounding
    /// does not set free what stands.
    pub(super) fn margins(&self, equations: &ReducedEquations<T, V, C>, modes: &Column<Mode, C>) -> Column<T, C> {
        let (rank, count) = (self.factors.rank, self.factors.count);
        let mut margins = Column::repeat(T::one());
        let mut found = Column::<_, C>::repeat(false);
        let combinations: Column<Column<T, C>, C> =
            Column::from_fn(|place| if place < count { self.factors.combination(place) } else { Column::zeros() });
        // Along each contact in the order; what of it is rounding is nothing.
        let motion = |z: &Column<T, C>| -> Column<T, C> {
            Column::from_fn(|place| {
                let terms = combinations[place].iter().zip(z).map(|(&c, &z)| c * z);
                let (sum, size) =
                    terms.fold((T::zero(), T::zero()), |(sum, size), term| (sum + term, size + term.abs()));
                if sum.abs() <= nothing::<T>() * size { T::zero() } else { sum }
            })
        };
        let mut weigh = |z: &Column<T, C>| {
            let moved = motion(z);
            let opens = |place: usize| match modes[self.factors.order[place]] {
                Mode::AtLower => moved[place] >= T::zero(),
                Mode::AtUpper => moved[place] <= T::zero(),
                _ => true,
            };
            if !(0..count).all(opens) {
                return;
            }
            let mut left = self.forces.iter().zip(z).take(rank).fold(T::zero(), |sum, (&h, &z)| sum + h * z);
            for (&contact, &moved) in self.factors.order.iter().zip(&moved).take(count) {
                let limit = match equations.contacts[contact].law {
                    ContactLaw::Friction { limit } => limit,
                    ContactLaw::Stop { .. } => T::zero(),
                };
                left += (limit + self.rounding(contact)) * moved.abs();
            }
            for (&contact, &moved) in self.factors.order.iter().zip(&moved).take(count).filter(|(_, s)| !s.is_zero()) {
                let share = left / moved.abs();
                if !found[contact] || share < margins[contact] {
                    margins[contact] = share;
                    found[contact] = true;
                }
            }
        };
        let mut both = |z: &Column<T, C>| {
            weigh(z);
            weigh(&-*z);
        };
        if rank == count || rank == 1 {
            for place in 0..rank {
                let mut z = Column::zeros();
                z[place] = T::one();
                both(&z);
            }
        } else if rank > 1 {
            each_choice::<C>(count, rank - 1, |still| {
                if let Some(z) = across(&combinations, still, rank) {
                    both(&z);
                }
            });
        }
        for &contact in &self.factors.order.as_slice()[rank..count] {
            let (bias, size) = self.response.bias[contact];
            let (mut left, mut size) = (bias, size);
            for (&row, &force) in self.factors.order.iter().zip(&self.forces).take(rank) {
                let term = self.response.matrix[(contact, row)] * force;
                (left, size) = (left + term, size + term.abs());
            }
            // The others do not hold it: a prescribed motion takes it along.
            if left.abs() > nothing::<T>() * size {
                margins[contact] = -left.abs();
            }
        }
        margins
    }

    /// What rounding may have left in the force of a contact.
    fn rounding(&self, contact: usize) -> T {
        let inverse = self.response.matrix[(contact, contact)];
        if inverse > T::zero() { nothing::<T>() * self.response.bias[contact].1 / inverse } else { T::zero() }
    }
}

/// Every choice of `many` of the numbers below `count`.
fn each_choice<C: Dim>(count: usize, many: usize, mut visit: impl FnMut(&[usize])) {
    let mut chosen: Column<usize, C> = Column::from_fn(|place| place);
    loop {
        visit(&chosen.as_slice()[..many]);
        let Some(place) = (0..many).rev().find(|&place| chosen[place] + many < count + place) else { return };
        chosen[place] += 1;
        for later in place + 1..many {
            chosen[later] = chosen[later - 1] + 1;
        }
    }
}

/// The motion in which these contacts stand still, if they leave one only.
fn across<T: Real, C: Dim>(
    combinations: &Column<Column<T, C>, C>,
    still: &[usize],
    rank: usize,
) -> Option<Column<T, C>> {
    let (mut rows, mut pivots) = (Column::<Column<T, C>, C>::repeat(Column::zeros()), Column::<_, C>::repeat(0));
    for (row, &place) in rows.iter_mut().zip(still) {
        *row = combinations[place];
    }
    let size = |row: &Column<T, C>| row.iter().fold(T::zero(), |size, entry| size.max(entry.abs()));
    let sizes = rows.map(|row| size(&row));
    for step in 0..still.len() {
        let pivot = (0..rank).fold(0, |best, at| if rows[step][at].abs() > rows[step][best].abs() { at } else { best });
        if rows[step][pivot].abs() <= nothing::<T>() * sizes[step] {
            return None;
        }
        pivots[step] = pivot;
        let row = rows[step];
        for (_, other) in rows.iter_mut().enumerate().take(still.len()).filter(|(place, _)| *place != step) {
            let factor = other[pivot] / row[pivot];
            for (entry, &of_row) in other.iter_mut().zip(&row) {
                *entry -= factor * of_row;
            }
            other[pivot] = T::zero();
        }
    }
    let free = (0..rank).find(|at| !pivots.as_slice()[..still.len()].contains(at))?;
    let mut z = Column::zeros();
    z[free] = T::one();
    for (row, &pivot) in rows.iter().zip(&pivots).take(still.len()) {
        z[pivot] = -row[free] / row[pivot];
    }
    Some(z)
}
