//! P A = L U of a square matrix.

use core::mem;

use crate::Real;

/// P A = L U with partial pivoting. Parts of slices instead of indices, so that nothing can panic.
#[derive(Debug, Clone)]
pub(crate) struct Lu<T, const N: usize> {
    rows: [Row<T, N>; N],
    /// det P.
    sign: T,
}

/// A row of L before the diagonal, where L is 1, and of U from the diagonal on.
#[derive(Debug, Clone, Copy)]
struct Row<T, const N: usize> {
    entries: [T; N],
    /// The row of A that it comes from.
    place: usize,
}

impl<T: Real, const N: usize> Lu<T, N> {
    /// Factorises the matrix of these columns.
    pub(crate) fn of(columns: [[T; N]; N]) -> Self {
        let mut rows = [Row { entries: [T::zero(); N], place: 0 }; N];
        for (place, row) in rows.iter_mut().enumerate() {
            row.place = place;
            for (entry, column) in row.entries.iter_mut().zip(&columns) {
                *entry = part(column, place);
            }
        }
        let mut sign = T::one();
        let mut rest = rows.as_mut_slice();
        let mut k = 0;
        while let [row, below @ ..] = rest {
            let (mut most, mut largest) = (part(&row.entries, k).abs(), None);
            for (place, other) in below.iter().enumerate() {
                let size = part(&other.entries, k).abs();
                if size > most {
                    (most, largest) = (size, Some(place));
                }
            }
            if let Some(other) = largest.and_then(|place| below.get_mut(place)) {
                mem::swap(row, other);
                sign = -sign;
            }
            if let Some([pivot, entries @ ..]) = row.entries.get(k..)
                && !pivot.is_zero()
            {
                let reciprocal = T::one() / *pivot;
                for other in &mut *below {
                    let Some([factor, others @ ..]) = other.entries.get_mut(k..) else { continue };
                    *factor *= reciprocal;
                    for (other, entry) in others.iter_mut().zip(entries) {
                        *other -= *factor * *entry;
                    }
                }
            }
            rest = below;
            k += 1;
        }
        Self { rows, sign }
    }

    /// det P.
    pub(crate) fn sign(&self) -> T {
        self.sign
    }

    /// The diagonal of U.
    pub(crate) fn pivots(&self) -> impl Iterator<Item = T> {
        self.rows.iter().enumerate().map(|(k, row)| part(&row.entries, k))
    }

    /// Solves A x = `right`, where no pivot is zero.
    pub(crate) fn solve(&self, right: &[T; N]) -> [T; N] {
        let mut x = [T::zero(); N];
        for (k, row) in self.rows.iter().enumerate() {
            let Some((known, [entry, ..])) = x.split_at_mut_checked(k) else { continue };
            let factors = row.entries.iter().zip(known);
            *entry = factors.fold(part(right, row.place), |rest, (factor, x)| rest - *factor * *x);
        }
        for (k, row) in self.rows.iter().enumerate().rev() {
            let Some([pivot, factors @ ..]) = row.entries.get(k..) else { continue };
            let Some([entry, known @ ..]) = x.get_mut(k..) else { continue };
            let factors = factors.iter().zip(known).rev();
            *entry = factors.fold(*entry, |rest, (factor, x)| rest - *factor * *x) / *pivot;
        }
        x
    }
}

/// An entry; zero for an invalid index.
fn part<T: Real, const N: usize>(entries: &[T; N], place: usize) -> T {
    entries.get(place).copied().unwrap_or_else(T::zero)
}
