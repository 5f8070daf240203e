//! Matrices whose numbers of rows and columns are types.

use core::fmt::{self, Display};
use core::ops::{Add, AddAssign, Index, IndexMut, Mul, Neg, Sub};

use nalgebra::SMatrix;

use crate::column::{Column, in_one_line};
use crate::scalar::largest;
use crate::{D, Dim, Real};

/// A matrix of as many rows and columns as [`R`](Dim) and `C` say.
///
/// It converts to and from nalgebra's [`SMatrix`] by `into`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrix<T: Real, R: Dim, C: Dim> {
    columns: Column<Column<T, R>, C>,
    /// The number of rows, which a matrix without columns has too.
    rows: R,
}

/// The rows in one line, `[[1, 2], [3, 4]]`, each entry with the precision asked for.
impl<T: Real, R: Dim, C: Dim> Display for Matrix<T, R, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        in_one_line(f, (0..self.rows.count()).map(|row| self.row(row)))
    }
}

impl<T: Real, R: Dim + Default, C: Dim + Default> Matrix<T, R, C> {
    /// Builds the matrix whose entry at row i and column j is `entry(i, j)`.
    #[inline]
    #[must_use]
    pub fn from_fn(entry: impl FnMut(usize, usize) -> T) -> Self {
        Self::built(R::default(), C::default(), entry)
    }

    /// The zero matrix.
    #[inline]
    #[must_use]
    pub fn zeros() -> Self {
        Self::built(R::default(), C::default(), |_, _| T::zero())
    }
}

impl<T: Real, R: Dim + Default, C: Dim> Matrix<T, R, C> {
    /// Builds the matrix of these columns.
    #[inline]
    #[must_use]
    pub fn from_columns(columns: Column<Column<T, R>, C>) -> Self {
        Self::of(R::default(), columns)
    }
}

impl<T: Real, R: Dim, C: Dim> Matrix<T, R, C> {
    /// Builds the matrix of so many rows and columns whose entry at row i and column j is `entry(i, j)`.
    #[inline]
    pub(crate) fn built(rows: R, columns: C, mut entry: impl FnMut(usize, usize) -> T) -> Self {
        let column = |column| Column::of(rows.array(|row| entry(row, column)));
        Self { columns: Column::of(columns.array(column)), rows }
    }

    /// Builds the matrix of these columns, with so many rows.
    #[inline]
    pub(crate) fn of(rows: R, columns: Column<Column<T, R>, C>) -> Self {
        Self { columns, rows }
    }

    /// Builds the matrix of so many rows and columns from these columns, padded with zeros.
    ///
    /// It is several times as fast as mapping an array of columns.
    #[inline]
    fn padded(rows: R, count: C, columns: impl IntoIterator<Item = Column<T, R>>) -> Self {
        let mut matrix = Self::built(rows, count, |_, _| T::zero());
        for (own, column) in matrix.columns.iter_mut().zip(columns) {
            *own = column;
        }
        matrix
    }

    /// The numbers of rows and columns.
    #[inline]
    #[must_use]
    pub fn dims(&self) -> (R, C) {
        (self.rows, self.columns.dim())
    }

    /// The columns.
    #[inline]
    #[must_use]
    pub fn columns(&self) -> &Column<Column<T, R>, C> {
        &self.columns
    }

    /// The columns, mutable.
    #[inline]
    #[must_use]
    pub fn columns_mut(&mut self) -> &mut Column<Column<T, R>, C> {
        &mut self.columns
    }

    /// Returns an entry, or zero outside the matrix; unlike indexing it cannot panic.
    #[inline]
    #[must_use]
    pub fn part(&self, row: usize, column: usize) -> T {
        self.columns.as_slice().get(column).map_or_else(T::zero, |column| column.part(row))
    }

    /// Returns an entry, mutable, or `None` outside the matrix.
    #[inline]
    #[must_use]
    pub fn get_mut(&mut self, row: usize, column: usize) -> Option<&mut T> {
        self.columns.as_mut_slice().get_mut(column)?.as_mut_slice().get_mut(row)
    }

    /// Returns a column.
    #[inline]
    #[must_use]
    pub fn column(&self, column: usize) -> Column<T, R> {
        self.columns[column]
    }

    /// Returns a row; zeros outside the matrix.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> Column<T, C> {
        self.columns.map(|column| column.part(row))
    }

    /// Replaces a column.
    #[inline]
    pub fn set_column(&mut self, column: usize, entries: Column<T, R>) {
        self.columns[column] = entries;
    }

    /// The entries, column by column.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = &T> + Clone {
        self.columns.iter().flat_map(Column::iter)
    }

    /// Multiplies a row by a factor.
    #[inline]
    pub fn scale_row(&mut self, row: usize, factor: T) {
        for column in &mut self.columns {
            column[row] *= factor;
        }
    }

    /// Subtracts `factor` times the row `other` from a row.
    #[inline]
    pub fn take_row(&mut self, row: usize, other: usize, factor: T) {
        for column in &mut self.columns {
            let taken = factor * column.part(other);
            if let Some(entry) = column.as_mut_slice().get_mut(row) {
                *entry -= taken;
            }
        }
    }

    /// Multiplies a column by a factor.
    #[inline]
    pub fn scale_column(&mut self, column: usize, factor: T) {
        self.columns[column] *= factor;
    }

    /// Applies a function to each entry.
    #[inline]
    #[must_use]
    pub fn map(&self, mut f: impl FnMut(T) -> T) -> Self {
        Self::padded(self.rows, self.columns.dim(), self.columns.iter().map(|column| column.map(&mut f)))
    }

    /// The magnitudes of the entries.
    #[inline]
    #[must_use]
    pub fn abs(&self) -> Self {
        self.map(|entry| entry.abs())
    }

    /// The transposed matrix.
    #[inline]
    #[must_use]
    pub fn transpose(&self) -> Matrix<T, C, R> {
        Matrix::built(self.columns.dim(), self.rows, |row, column| self[(column, row)])
    }

    /// The transpose times a column.
    #[inline]
    #[must_use]
    pub fn tr_mul(&self, column: &Column<T, R>) -> Column<T, C> {
        self.columns.map(|own| own.dot(column))
    }

    /// The transpose times a matrix.
    #[inline]
    #[must_use]
    pub fn tr_mul_matrix<K: Dim>(&self, other: &Matrix<T, R, K>) -> Matrix<T, C, K> {
        Matrix::padded(self.columns.dim(), other.columns.dim(), other.columns.iter().map(|column| self.tr_mul(column)))
    }

    /// The largest magnitude; NaN if an entry is NaN.
    #[inline]
    #[must_use]
    pub fn largest(&self) -> T {
        largest(self.iter().copied())
    }

    /// True if every entry is finite.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.iter().all(T::is_finite)
    }
}

impl<T: Real, N: Dim + Default> Matrix<T, N, N> {
    /// The identity matrix.
    #[inline]
    #[must_use]
    pub fn identity() -> Self {
        Self::built(N::default(), N::default(), |row, column| if row == column { T::one() } else { T::zero() })
    }
}

impl<T: Real, N: Dim> Matrix<T, N, N> {
    /// The diagonal.
    #[inline]
    #[must_use]
    pub fn diagonal(&self) -> Column<T, N> {
        Column::of(self.rows.array(|place| self[(place, place)]))
    }
}

impl<T: Real, R: Dim, C: Dim> Index<(usize, usize)> for Matrix<T, R, C> {
    type Output = T;

    #[inline]
    fn index(&self, (row, column): (usize, usize)) -> &T {
        &self.columns[column][row]
    }
}

impl<T: Real, R: Dim, C: Dim> IndexMut<(usize, usize)> for Matrix<T, R, C> {
    #[inline]
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut T {
        &mut self.columns[column][row]
    }
}

impl<T: Real, const R: usize, const C: usize> From<SMatrix<T, R, C>> for Matrix<T, D<R>, D<C>> {
    #[inline]
    fn from(matrix: SMatrix<T, R, C>) -> Self {
        Self::from(matrix.data.0)
    }
}

impl<T: Real, const R: usize, const C: usize> From<[[T; R]; C]> for Matrix<T, D<R>, D<C>> {
    #[inline]
    fn from(columns: [[T; R]; C]) -> Self {
        Self::padded(D, D, columns.iter().map(|&column| Column::from(column)))
    }
}

impl<T: Real, const R: usize, const C: usize> From<Matrix<T, D<R>, D<C>>> for [[T; R]; C] {
    /// The columns.
    #[inline]
    fn from(matrix: Matrix<T, D<R>, D<C>>) -> Self {
        matrix.columns.into_array().map(Column::into_array)
    }
}

impl<T: Real, const R: usize, const C: usize> From<Matrix<T, D<R>, D<C>>> for SMatrix<T, R, C> {
    #[inline]
    fn from(matrix: Matrix<T, D<R>, D<C>>) -> Self {
        let mut columns = [[T::zero(); R]; C];
        for (own, &column) in columns.iter_mut().zip(&matrix.columns) {
            *own = column.into();
        }
        Self::from(columns)
    }
}

impl<T: Real, R: Dim, C: Dim> Mul<Column<T, C>> for Matrix<T, R, C> {
    type Output = Column<T, R>;

    #[inline]
    fn mul(self, factors: Column<T, C>) -> Column<T, R> {
        self.columns
            .iter()
            .zip(&factors)
            .fold(Column::of(self.rows.array(|_| T::zero())), |sum, (&column, &factor)| sum + column * factor)
    }
}

impl<T: Real, R: Dim, K: Dim, C: Dim> Mul<Matrix<T, K, C>> for Matrix<T, R, K> {
    type Output = Matrix<T, R, C>;

    #[inline]
    fn mul(self, other: Matrix<T, K, C>) -> Matrix<T, R, C> {
        Matrix::padded(self.rows, other.columns.dim(), other.columns.iter().map(|&column| self * column))
    }
}

impl<T: Real, R: Dim, C: Dim> Mul<T> for Matrix<T, R, C> {
    type Output = Self;

    #[inline]
    fn mul(self, factor: T) -> Self {
        self.map(|entry| entry * factor)
    }
}

impl<T: Real, R: Dim, C: Dim> Add for Matrix<T, R, C> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self { columns: self.columns.zip_map(&other.columns, |one, other| one + other), ..self }
    }
}

impl<T: Real, R: Dim, C: Dim> AddAssign for Matrix<T, R, C> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real, R: Dim, C: Dim> Sub for Matrix<T, R, C> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { columns: self.columns.zip_map(&other.columns, |one, other| one - other), ..self }
    }
}

impl<T: Real, R: Dim, C: Dim> Neg for Matrix<T, R, C> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.map(|entry| -entry)
    }
}
