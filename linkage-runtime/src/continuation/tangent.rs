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
    first: T,
    last: T,
    product: T,
}

impl<T: Real, const U: usize> Elimination<T, U> {
    /// All pivots but the last, whose place is still open.
    pub(super) fn all_but_one(unknowns: SMatrix<T, U, U>, input: SVector<T, U>) -> Self {
        let mut elimination = Self {
            unknowns,
            input,
            operator: SMatrix::identity(),
            column_of: [None; U],
            pivots: 0,
            first: T::one(),
            last: T::one(),
            product: T::one(),
        };
        while elimination.pivots + 1 < U {
            elimination.pivot();
        }
        elimination
    }

    pub(super) fn new(unknowns: SMatrix<T, U, U>, input: SVector<T, U>) -> Self {
        let mut elimination = Self::all_but_one(unknowns, input);
        elimination.complete();
        elimination
    }

    pub(super) fn complete(&mut self) {
        if self.pivots < U {
            self.pivot();
        }
    }

    /// The smallest pivot beside the largest: 0 where [J A] loses rank.
    pub(super) fn regularity(&self) -> T {
        if self.first > T::zero() { self.last / self.first } else { T::zero() }
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
        if self.pivots == 0 {
            self.first = largest;
        }
        self.last = largest;
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
    fn null(&self, free: usize) -> Vector<T, U> {
        let mut vector = Vector::unit(free);
        for (row, column) in self.column_of.iter().enumerate() {
            if let Some(column) = *column {
                vector.set(column, -self.entry(row, free));
            }
        }
        vector
    }

    fn free(&self) -> impl Iterator<Item = usize> + '_ {
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

    /// Where one pivot is open: the two directions that the others leave free, the combination of closures that is
    /// left, and its derivatives along the two.
    pub(super) fn open(&self) -> Option<Open<T, U>> {
        let row = self.column_of.iter().position(Option::is_none)?;
        let mut free = self.free();
        let (one, two) = (free.next()?, free.next()?);
        Some(Open {
            directions: [self.null(one), self.null(two)],
            combination: self.operator.row(row).transpose(),
            slopes: [self.entry(row, one), self.entry(row, two)],
        })
    }
}

/// What an elimination without its last pivot leaves open.
pub(super) struct Open<T, const U: usize> {
    pub(super) directions: [Vector<T, U>; 2],
    pub(super) combination: SVector<T, U>,
    pub(super) slopes: [T; 2],
}
