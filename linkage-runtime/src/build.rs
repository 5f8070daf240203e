//! Columns and matrices of a number of rows.

use core::fmt::Debug;

use crate::{Column, Dim, Matrix, Real};

/// Columns and matrices with as many rows as a number says: of [`D<N>`](crate::D) as of a number that is known while the
/// program runs.
pub trait Build: Dim {
    /// The column whose entry at index i is `entry(i)`.
    #[inline]
    fn column<X: Copy + Debug>(self, entry: impl FnMut(usize) -> X) -> Column<X, Self> {
        Column::of(self.array(entry))
    }
    /// The column of equal entries.
    #[inline]
    fn repeat<X: Copy + Debug>(self, entry: X) -> Column<X, Self> {
        self.column(|_| entry)
    }
    /// The zero vector.
    #[inline]
    fn zeros<T: Real>(self) -> Column<T, Self> {
        self.repeat(T::zero())
    }
    /// The unit vector with its 1 at this index.
    #[inline]
    fn unit<T: Real>(self, at: usize) -> Column<T, Self> {
        self.column(|place| if place == at { T::one() } else { T::zero() })
    }
    /// The column of these entries, padded with zeros.
    #[inline]
    fn padded<T: Real>(self, entries: impl IntoIterator<Item = T>) -> Column<T, Self> {
        let mut column = self.zeros();
        for (own, entry) in column.iter_mut().zip(entries) {
            *own = entry;
        }
        column
    }
    /// The matrix of these columns.
    #[inline]
    fn columns<T: Real, C: Dim>(self, columns: Column<Column<T, Self>, C>) -> Matrix<T, Self, C> {
        Matrix::of(self, columns)
    }
    /// The matrix of so many columns, with the entry `entry(i, j)` at row i and column j.
    #[inline]
    fn matrix<T: Real, C: Dim>(self, columns: C, entry: impl FnMut(usize, usize) -> T) -> Matrix<T, Self, C> {
        Matrix::built(self, columns, entry)
    }
    /// The zero matrix of so many columns.
    #[inline]
    fn zero_matrix<T: Real, C: Dim>(self, columns: C) -> Matrix<T, Self, C> {
        Matrix::of(self, columns.repeat(self.zeros()))
    }
    /// The identity matrix.
    #[inline]
    fn identity<T: Real>(self) -> Matrix<T, Self, Self> {
        Matrix::of(self, self.column(|place| self.unit(place)))
    }
}

impl<R: Dim> Build for R {}
