//! L D L' of a positive definite matrix: symmetric elimination without pivoting.

use crate::{Column, Dim, Matrix, Real};

/// The triangular factors of a positive definite matrix. Nothing here can panic, even without optimisation.
#[derive(Debug, Clone, Copy)]
pub struct Definite<T: Real, N: Dim> {
    matrix: Matrix<T, N, N>,
}

impl<T: Real, N: Dim> Definite<T, N> {
    /// Factorises the matrix. Each pivot is checked before it divides, with its place and the diagonal entry of the matrix
    /// there.
    ///
    /// # Errors
    /// That of the check.
    #[inline]
    pub fn new<E>(matrix: &Matrix<T, N, N>, check: impl Fn(usize, T, T) -> Result<(), E>) -> Result<Self, E> {
        let entries = matrix;
        let (mut matrix, count) = (*entries, entries.dims().0.count());
        for k in 0..count {
            let pivot = matrix.part(k, k);
            check(k, pivot, entries.part(k, k))?;
            for i in k + 1..count {
                let factor = matrix.part(i, k) / pivot;
                for column in k + 1..count {
                    let above = matrix.part(k, column);
                    if let Some(entry) = matrix.get_mut(i, column) {
                        *entry -= factor * above;
                    }
                }
            }
        }
        Ok(Self { matrix })
    }

    /// Solves A x = `right`.
    #[inline]
    #[must_use]
    pub fn solve(&self, right: &Column<T, N>) -> Column<T, N> {
        let (matrix, mut x, count) = (&self.matrix, *right, right.dim().count());
        for k in 0..count {
            let Some([value, below @ ..]) = x.as_mut_slice().get_mut(k..) else { continue };
            for (i, entry) in (k + 1..).zip(below) {
                *entry -= matrix.part(i, k) / matrix.part(k, k) * *value;
            }
        }
        for k in (0..count).rev() {
            let Some([entry, known @ ..]) = x.as_mut_slice().get_mut(k..) else { continue };
            for (i, known) in (k + 1..).zip(known) {
                *entry -= matrix.part(k, i) * *known;
            }
            *entry /= matrix.part(k, k);
        }
        x
    }
}
