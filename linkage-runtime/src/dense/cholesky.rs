//! Cholesky factorisation of normal equations.

use crate::{Build, Column, Dim, Matrix, Real};

/// The Cholesky factor L of a symmetric matrix L L'.
#[derive(Debug, Clone, Copy)]
pub struct Cholesky<T: Real, N: Dim> {
    lower: Matrix<T, N, N>,
}

impl<T: Real, N: Dim> Cholesky<T, N> {
    /// Factorises the matrix; `None` if it is not positive definite.
    #[must_use]
    pub fn new(matrix: &Matrix<T, N, N>) -> Option<Self> {
        let (n, _) = matrix.dims();
        let mut lower = n.zero_matrix(n);
        for column in 0..n.count() {
            for row in column..n.count() {
                let known = (0..column).fold(T::zero(), |sum, k| sum + lower[(row, k)] * lower[(column, k)]);
                let rest = matrix[(row, column)] - known;
                lower[(row, column)] = if row > column {
                    rest / lower[(column, column)]
                } else if rest > T::zero() {
                    rest.sqrt()
                } else {
                    return None;
                };
            }
        }
        Some(Self { lower })
    }

    /// The diagonal of L.
    #[must_use]
    pub fn diagonal(&self) -> Column<T, N> {
        self.lower.diagonal()
    }

    /// Solves L L' x = `right`.
    #[must_use]
    pub fn solve(&self, right: &Column<T, N>) -> Column<T, N> {
        let (mut x, count) = (*right, right.dim().count());
        for row in 0..count {
            let known = (0..row).fold(T::zero(), |sum, k| sum + self.lower[(row, k)] * x[k]);
            x[row] = (x[row] - known) / self.lower[(row, row)];
        }
        for row in (0..count).rev() {
            let known = (row + 1..count).fold(T::zero(), |sum, k| sum + self.lower[(k, row)] * x[k]);
            x[row] = (x[row] - known) / self.lower[(row, row)];
        }
        x
    }
}
