//! Gauss-Jordan elimination of a wide matrix.

use crate::{Column, Dim, Real};

/// Eliminates from all other rows the column that `pivot` chooses in each row; `None` if it chooses none.
///
/// `on_row` is told the row of the pivot, the other row, and the factor by which the first is subtracted from it.
#[inline]
pub fn reduce_rows<T: Real, V: Dim>(
    rows: &mut [Column<T, V>],
    mut pivot: impl FnMut(usize, &Column<T, V>) -> Option<usize>,
    mut on_row: impl FnMut(usize, usize, T),
) -> Option<()> {
    for place in 0..rows.len() {
        let row = rows[place];
        let pivot = pivot(place, &row)?;
        for (other, entries) in rows.iter_mut().enumerate().filter(|(other, _)| *other != place) {
            let factor = entries[pivot] / row[pivot];
            if !factor.is_zero() {
                *entries -= row * factor;
                on_row(place, other, factor);
            }
            entries[pivot] = T::zero();
        }
    }
    Some(())
}
