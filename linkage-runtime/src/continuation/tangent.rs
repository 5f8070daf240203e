//! The tangent of the curve Psi = 0: what [J A] leaves free, by elimination with complete pivoting.
//!
//! No coordinate is preferred: the column that is left over at the end is the one that the curve turns least away
//! from, so that a dead point of the input is a point like any other (W. C. Rheinboldt and J. V. Burkardt, "A locally
//! parameterized continuation process", 1983, choose their parameter by the same thought).

use nalgebra::{SMatrix, SVector};

use super::vector::Vector;
use crate::Real;

/// [J A] after some steps of Gauss and Jordan: `operator` times [J A] is `unknowns` and `input`, with a 1 alone in the
/// column of each pivot.
#[derive(Debug, Clone)]
pub(super) struct Elimination<T, const U: usize> {
    unknowns: SMatrix<T, U, U>,
    input: SVector<T, U>,
    operator: SMatrix<T, U, U>,
    /// The column of the pivot of each row.
    column_of: [Option<usize>; U],
    pivots: usize,
    /// The magnitudes of the pivots, the largest first.
    sizes: SVector<T, U>,
    product: T,
}

impl<T: Real, const U: usize> Elimination<T, U> {
    /// All pivots but the last `open`, whose places are still open.
    pub(super) fn all_but(open: usize, unknowns: SMatrix<T, U, U>, input: SVector<T, U>) -> Self {
        let mut elimination = Self {
            unknowns,
            input,
            operator: SMatrix::identity(),
            column_of: [None; U],
            pivots: 0,
            sizes: SVector::zeros(),
            product: T::one(),
        };
        while elimination.pivots + open < U {
            elimination.pivot();
        }
        elimination
    }

    pub(super) fn new(unknowns: SMatrix<T, U, U>, input: SVector<T, U>) -> Self {
        Self::all_but(0, unknowns, input)
    }

    /// The smallest pivot relative to the largest: 0 where [J A] loses rank.
    pub(super) fn regularity(&self) -> T {
        match (self.sizes.iter().next(), self.sizes.iter().last()) {
            (Some(first), Some(last)) if *first > T::zero() => *last / *first,
            (Some(_), _) => T::zero(),
            _ => T::one(),
        }
    }

    /// The last but one pivot relative to the largest: 0 where [J A] loses rank twice.
    pub(super) fn last_but_one(&self) -> T {
        match (self.sizes.iter().next(), self.sizes.iter().rev().nth(1)) {
            (Some(first), Some(last)) if *first > T::zero() => *last / *first,
            (Some(_), Some(_)) => T::zero(),
            _ => T::one(),
        }
    }

    /// How many pivots are at most this part of the largest.
    pub(super) fn defect(&self, weak: T) -> usize {
        let least = self.sizes.amax() * weak;
        self.sizes.iter().filter(|&&size| size <= least).count()
    }

    /// How many pivots come after the widest gap between one and the next.
    pub(super) fn after_gap(&self) -> usize {
        let mut widest = (T::one(), 1);
        for next in 1..U {
            let share = self.sizes[next] / self.sizes[next - 1];
            if share < widest.0 {
                widest = (share, U - next);
            }
        }
        widest.1
    }

    fn entry(&self, row: usize, column: usize) -> T {
        self.unknowns.get((row, column)).copied().unwrap_or(self.input[row])
    }

    fn is_free(&self, column: usize) -> bool {
        !self.column_of.contains(&Some(column))
    }

    fn pivot(&mut self) {
        let (mut place, mut largest) = ((0, 0), -T::one());
        for row in (0..U).filter(|&row| self.column_of[row].is_none()) {
            for column in (0..=U).filter(|&column| self.is_free(column)) {
                let size = self.entry(row, column).abs();
                if size > largest {
                    (place, largest) = ((row, column), size);
                }
            }
        }
        let (row, column) = place;
        let value = self.entry(row, column);
        self.sizes[self.pivots] = largest;
        self.product *= value;
        self.pivots += 1;
        self.column_of[row] = Some(column);
        if value.is_zero() {
            return;
        }
        let inverse = value.recip();
        self.unknowns.row_mut(row).scale_mut(inverse);
        self.operator.row_mut(row).scale_mut(inverse);
        self.input[row] *= inverse;
        for other in (0..U).filter(|&other| other != row) {
            let factor = self.entry(other, column);
            if factor.is_zero() {
                continue;
            }
            for k in 0..U {
                let (above, operator) = (self.unknowns[(row, k)], self.operator[(row, k)]);
                self.unknowns[(other, k)] -= factor * above;
                self.operator[(other, k)] -= factor * operator;
            }
            let above = self.input[row];
            self.input[other] -= factor * above;
        }
    }

    /// The vector that [J A] takes to what is left in the rows without a pivot, with a 1 at a free column.
    pub(super) fn null(&self, free: usize) -> Vector<T, U> {
        let mut vector = Vector::unit(free);
        for (row, column) in self.column_of.iter().enumerate() {
            if let Some(column) = *column {
                vector.set(column, -self.entry(row, free));
            }
        }
        vector
    }

    /// The columns without a pivot.
    pub(super) fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..=U).filter(|&column| self.is_free(column))
    }

    /// The unit tangent, either way.
    pub(super) fn tangent(&self) -> Vector<T, U> {
        self.null(self.free().next().unwrap_or(U)).normalized()
    }

    /// The determinant of [J A] with the `tangent` below it: it keeps its sign along the curve, and changes it where
    /// another curve is crossed (E. L. Allgower and K. Georg, "Numerical Continuation Methods", 1990, chapter 8).
    pub(super) fn orientation(&self, tangent: &Vector<T, U>) -> T {
        let free = self.free().next().unwrap_or(U);
        let null = self.null(free);
        // The sign of the permutation from rows to columns, the tangent's row with the free column.
        let column = |row: usize| self.column_of.get(row).copied().flatten().unwrap_or(free);
        let odd = (0..=U).flat_map(|row| (0..row).map(move |above| (above, row)));
        let is_odd = odd.filter(|&(above, row)| column(above) > column(row)).count() % 2 == 1;
        let volume = self.product * tangent.dot(&null);
        if is_odd { -volume } else { volume }
    }

    /// A solution of [J A] x = `right`, in the rows that have a pivot.
    pub(super) fn solve(&self, right: &SVector<T, U>) -> Vector<T, U> {
        let right = self.operator * right;
        let mut solution = Vector::zero();
        for (row, column) in self.column_of.iter().enumerate() {
            if let Some(column) = *column {
                solution.set(column, right[row]);
            }
        }
        solution
    }

    /// The rows without a pivot.
    pub(super) fn open_rows(&self) -> impl Iterator<Item = usize> + '_ {
        (0..U).filter(|&row| self.column_of[row].is_none())
    }

    /// A combination of loop equations reduced to the rows that have no pivot; the others are zero.
    pub(super) fn left(&self, right: &SVector<T, U>) -> SVector<T, U> {
        let reduced = self.operator * right;
        SVector::from_fn(|row, _| if self.column_of[row].is_none() { reduced[row] } else { T::zero() })
    }

    /// The same of rounding errors, whose signs are not known.
    pub(super) fn left_of_noise(&self, noise: &SVector<T, U>) -> SVector<T, U> {
        let reduced = self.operator.abs() * noise;
        SVector::from_fn(|row, _| if self.column_of[row].is_none() { reduced[row] } else { T::zero() })
    }

    /// The derivatives of what [`left`](Self::left) gives along the direction of a free column.
    pub(super) fn slope(&self, free: usize) -> SVector<T, U> {
        SVector::from_fn(|row, _| if self.column_of[row].is_none() { self.entry(row, free) } else { T::zero() })
    }
}
