//! L D L' of some rows and columns of a symmetric matrix, as far as they are independent.

use crate::{Build, Column, Dim, Matrix, Real};

/// The L D L' factors of some rows and columns of a symmetric matrix.
pub struct Ranked<T: Real, C: Dim> {
    /// The rows in pivot order; those from `rank` on depend on the ones before.
    pub order: Column<usize, C>,
    /// The number of rows factored.
    pub count: usize,
    /// The number of independent rows.
    pub rank: usize,
    lower: Matrix<T, C, C>,
    pivots: Column<T, C>,
}

impl<T: Real, C: Dim> Ranked<T, C> {
    /// Factors with pivoting: the row with the largest remaining pivot first. A pivot counts as zero if it is no larger
    /// than `tolerance` times its diagonal entry.
    pub fn pivoted(matrix: &Matrix<T, C, C>, order: &Column<usize, C>, count: usize, tolerance: T) -> Self {
        Self::new(matrix, (order, count), tolerance, true)
    }

    /// Factors in the given order, up to the first row that depends on those before it.
    pub fn in_order(matrix: &Matrix<T, C, C>, order: &Column<usize, C>, count: usize, tolerance: T) -> Self {
        Self::new(matrix, (order, count), tolerance, false)
    }

    fn new(matrix: &Matrix<T, C, C>, (order, count): (&Column<usize, C>, usize), tolerance: T, exchange: bool) -> Self {
        let mut order = *order;
        let (c, _) = matrix.dims();
        let (mut lower, mut pivots) = (c.zero_matrix(c), c.zeros());
        // The diagonal after the elimination of the rows taken.
        let mut remaining = matrix.diagonal();
        let mut rank = 0;
        while rank < count {
            // A row of zeros counts as dependent.
            let relative_pivot = |row: usize| {
                let entry = matrix[(row, row)];
                if entry > T::zero() { remaining[row] / entry } else { T::zero() }
            };
            let mut best = rank;
            for place in rank + 1..if exchange { count } else { rank } {
                if relative_pivot(order[place]) > relative_pivot(order[best]) {
                    best = place;
                }
            }
            if relative_pivot(order[best]) <= tolerance {
                break;
            }
            order.as_mut_slice().swap(rank, best);
            let row = order[rank];
            pivots[rank] = remaining[row];
            for &other in &order.as_slice()[rank + 1..count] {
                let mut sum = matrix[(other, row)];
                for before in 0..rank {
                    sum -= lower[(other, before)] * pivots[before] * lower[(row, before)];
                }
                lower[(other, rank)] = sum / pivots[rank];
                remaining[other] -= lower[(other, rank)] * sum;
            }
            rank += 1;
        }
        Self { order, count, rank, lower, pivots }
    }

    /// Solves A x = `side` for the independent rows; both are indexed in pivot order.
    #[inline]
    pub fn solve(&self, side: impl Fn(usize) -> T) -> Column<T, C> {
        let mut x = self.pivots.dim().zeros();
        for place in 0..self.rank {
            let row = self.order[place];
            x[place] = (0..place).fold(side(row), |sum, before| sum - self.lower[(row, before)] * x[before]);
        }
        for (x, &pivot) in x.iter_mut().zip(&self.pivots).take(self.rank) {
            *x /= pivot;
        }
        self.back(x)
    }

    /// Returns the coefficients of a row as a combination of the independent rows, in pivot order.
    #[inline]
    pub fn combination(&self, place: usize) -> Column<T, C> {
        let mut x = self.pivots.dim().zeros();
        if place < self.rank {
            x[place] = T::one();
            return x;
        }
        for before in 0..self.rank {
            x[before] = self.lower[(self.order[place], before)];
        }
        self.back(x)
    }

    #[inline]
    fn back(&self, mut x: Column<T, C>) -> Column<T, C> {
        for place in (0..self.rank).rev() {
            for later in place + 1..self.rank {
                let value = x[later];
                x[place] -= self.lower[(self.order[later], place)] * value;
            }
        }
        x
    }
}
