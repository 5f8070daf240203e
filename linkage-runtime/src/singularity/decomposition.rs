//! Singular value decomposition by one-sided Jacobi rotations.

use crate::{Build, Column, Dim, Matrix, Real, real};

/// The most sweeps; six or seven are needed.
const MOST_SWEEPS: usize = 40;

/// The singular values of a matrix, the largest first, and its right singular vectors.
///
/// Pairs of columns are rotated until all are orthogonal: C. G. J. Jacobi's method, one-sided (M. R. Hestenes, 1958).
/// It finds small singular values to more digits than a bidiagonalisation (J. Demmel and K. Veselić, "Jacobi's method
/// is more accurate than QR", SIAM Journal on Matrix Analysis and Applications 13, 1992), and works for a matrix of any
/// shape.
pub(super) struct Decomposition<T: Real, N: Dim> {
    pub(super) values: Column<T, N>,
    pub(super) vectors: Matrix<T, N, N>,
}

impl<T: Real, N: Dim> Decomposition<T, N> {
    /// Decomposes a matrix of finite numbers, none much larger than 1.
    pub(super) fn of<R: Dim>(matrix: Matrix<T, R, N>) -> Self {
        let (_, n) = matrix.dims();
        let (mut columns, mut vectors) = (matrix, n.identity());
        for _ in 0..MOST_SWEEPS {
            let mut is_done = true;
            for first in 0..n.count() {
                for second in first + 1..n.count() {
                    let (a, b) = (columns.column(first).norm(), columns.column(second).norm());
                    let product = columns.column(first).dot(&columns.column(second));
                    if product.abs() <= T::default_epsilon() * a * b {
                        continue;
                    }
                    is_done = false;
                    // tan of the angle: t^2 + 2 z t - 1 = 0, the smaller root.
                    let z = (b - a) * (b + a) / (real::<T>(2.0) * product);
                    let root = z.abs() + T::one().hypotenuse(z);
                    let t = if z < T::zero() { -root.recip() } else { root.recip() };
                    let cosine = T::one().hypotenuse(t).recip();
                    rotate(&mut columns, first, second, cosine, cosine * t);
                    rotate(&mut vectors, first, second, cosine, cosine * t);
                }
            }
            if is_done {
                break;
            }
        }
        let mut values = n.column(|column| columns.column(column).norm());
        for place in 0..n.count() {
            let largest =
                (place..n.count()).fold(place, |best, other| if values[other] > values[best] { other } else { best });
            values.as_mut_slice().swap(place, largest);
            vectors.columns_mut().as_mut_slice().swap(place, largest);
        }
        Self { values, vectors }
    }

    /// The smallest singular value.
    pub(super) fn least(&self) -> T {
        self.values.iter().last().copied().unwrap_or_else(T::one)
    }

    /// The number of singular values above a threshold.
    pub(super) fn rank(&self, threshold: T) -> usize {
        self.values.iter().filter(|&&value| value > threshold).count()
    }
}

fn rotate<T: Real, R: Dim, N: Dim>(matrix: &mut Matrix<T, R, N>, first: usize, second: usize, cosine: T, sine: T) {
    for row in 0..matrix.dims().0.count() {
        let (x, y) = (matrix[(row, first)], matrix[(row, second)]);
        matrix[(row, first)] = cosine * x - sine * y;
        matrix[(row, second)] = sine * x + cosine * y;
    }
}
