//! Gaussian elimination of [J A] with complete pivoting, which gives its rank and its null space.
//!
//! No coordinate is preferred: the columns without a pivot are the independent coordinates best aligned with the
//! motion, so that a dead point of the inputs is a position like any other (R. A. Wehage and E. J. Haug, "Generalized
//! coordinate partitioning for dimension reduction in analysis of constrained dynamic systems", J. Mech. Des. 104,
//! 1982; W. C. Rheinboldt and J. V. Burkardt, "A locally parameterized continuation process", 1983).

use core::mem;

use super::{Jacobian, Vector};
use crate::{Build, Column, D, Dim, Matrix, Real};

/// The rows and columns of the pivots of [J A], in the order of elimination. Columns from `U` on are inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Order<U: Dim> {
    /// All rows: those of the pivots, then those without one.
    rows: Column<usize, U>,
    /// The columns of the pivots; entries beyond their number are unused.
    columns: Column<usize, U>,
    pivots: usize,
}

/// The factorisation of [J A]: a unit lower triangle L times the reduced [J A], in the order of the pivots.
///
/// Where [J A] is singular, the rows left open, which have no pivot, are reduced to zero: these rows of L^-1 are the
/// left null vectors of [J A].
#[derive(Debug, Clone)]
pub struct Elimination<T: Real, U: Dim, V: Dim> {
    /// The reduced [J A].
    jacobian: Jacobian<T, U, V>,
    /// L below its diagonal, by the rows of [J A] and the numbers of the pivots.
    lower: Matrix<T, U, U>,
    order: Order<U>,
}

impl<U: Dim> Order<U> {
    fn none(u: U) -> Self {
        Self { rows: u.column(|row| row), columns: u.repeat(usize::MAX), pivots: 0 }
    }

    /// The columns of the pivots.
    pub fn dependent(&self) -> &[usize] {
        self.columns.as_slice().get(..self.pivots).unwrap_or_default()
    }

    /// The columns without a pivot, with so many inputs: the independent coordinates.
    pub fn free<V: Dim>(&self, v: V) -> impl Iterator<Item = usize> + '_ {
        (0..self.rows.dim().count() + v.count()).filter(|column| !self.dependent().contains(column))
    }

    fn open_rows(&self) -> &[usize] {
        self.rows.as_slice().get(self.pivots..).unwrap_or_default()
    }

    fn push(&mut self, row: usize, column: usize) {
        if let Some([first, others @ ..]) = self.rows.as_mut_slice().get_mut(self.pivots..)
            && let Some(other) = others.iter_mut().find(|other| **other == row)
        {
            mem::swap(first, other);
        }
        if let Some(own) = self.columns.as_mut_slice().get_mut(self.pivots) {
            *own = column;
        }
        self.pivots += 1;
    }
}

impl<T: Real, U: Dim, V: Dim> Elimination<T, U, V> {
    fn begin(jacobian: Jacobian<T, U, V>) -> Self {
        let (u, _) = jacobian.dims();
        Self { jacobian, lower: u.zero_matrix(u), order: Order::none(u) }
    }

    /// Eliminates with all pivots.
    pub fn new(jacobian: Jacobian<T, U, V>) -> Self {
        Self::all_but(0, jacobian)
    }

    /// Eliminates with all pivots but the last `open`, so that `open` rows have none.
    pub fn all_but(open: usize, jacobian: Jacobian<T, U, V>) -> Self {
        let mut elimination = Self::begin(jacobian);
        while elimination.order.pivots + open < elimination.rows() {
            elimination.eliminate_largest(&|_| true);
        }
        elimination
    }

    /// Eliminates with pivots in columns of unknowns and of inputs that are not held; held inputs stay independent.
    pub fn holding(held: &Column<bool, V>, jacobian: Jacobian<T, U, V>) -> Self {
        let mut elimination = Self::begin(jacobian);
        let rows = elimination.rows();
        while elimination.order.pivots < rows {
            elimination.eliminate_largest(&|column| column < rows || !held[column - rows]);
        }
        elimination
    }

    /// Eliminates with the pivots of an earlier elimination.
    pub fn in_order(order: &Order<U>, jacobian: Jacobian<T, U, V>) -> Self {
        Self::with_accepted_pivots(order, jacobian, |_| true)
    }

    /// Eliminates with the pivots of an earlier elimination that are larger than `tolerance`; the rows of the others
    /// stay open.
    pub fn in_order_above(tolerance: T, order: &Order<U>, jacobian: Jacobian<T, U, V>) -> Self {
        Self::with_accepted_pivots(order, jacobian, |pivot| pivot.abs() > tolerance)
    }

    fn with_accepted_pivots(order: &Order<U>, jacobian: Jacobian<T, U, V>, is_accepted: impl Fn(T) -> bool) -> Self {
        let mut elimination = Self::begin(jacobian);
        for (&row, &column) in order.rows.iter().zip(order.dependent()) {
            if is_accepted(elimination.entry(row, column)) {
                elimination.eliminate(row, column);
            }
        }
        elimination
    }

    /// The number of rows, that of the unknowns.
    fn rows(&self) -> usize {
        self.jacobian.dims().0.count()
    }

    /// The rows and columns of the pivots.
    pub fn order(&self) -> &Order<U> {
        &self.order
    }

    /// The pivots, which decrease with complete pivoting; zero for open rows.
    pub fn pivots(&self) -> Column<T, U> {
        let places = self.order.rows.iter().zip(self.order.dependent());
        self.order.rows.dim().padded(places.map(|(&row, &column)| self.entry(row, column)))
    }

    /// The last pivot divided by the first: 0 where [J A] loses rank.
    pub fn regularity(&self) -> T {
        self.relative_pivot(self.rows().checked_sub(1))
    }

    /// The last but one pivot divided by the first: 0 where the rank deficiency of [J A] is at least two.
    pub fn last_but_one(&self) -> T {
        self.relative_pivot(self.rows().checked_sub(2))
    }

    /// A pivot divided by the first; 1 if the pivot does not exist.
    fn relative_pivot(&self, step: Option<usize>) -> T {
        let Some(step) = step else { return T::one() };
        let pivots = self.pivots();
        let first = pivots[0].abs();
        if first > T::zero() { pivots[step].abs() / first } else { T::zero() }
    }

    /// The rank deficiency: the number of pivots that are at most `tolerance` times the largest.
    pub fn defect(&self, tolerance: T) -> usize {
        let pivots = self.pivots();
        let least = pivots.largest() * tolerance;
        pivots.iter().filter(|pivot| pivot.abs() <= least).count()
    }

    /// The number of pivots after the largest drop from one pivot to the next: the likely rank deficiency at a singular
    /// position nearby.
    pub fn count_after_largest_drop(&self) -> usize {
        let pivots = self.pivots();
        let mut widest = (T::one(), 1);
        for next in 1..self.rows() {
            let share = (pivots[next] / pivots[next - 1]).abs();
            if share < widest.0 {
                widest = (share, self.rows() - next);
            }
        }
        widest.1
    }

    /// The columns without a pivot.
    pub fn free(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.free(self.jacobian.dims().1)
    }

    /// The rows without a pivot, in the order of [J A].
    pub fn open_rows(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.rows()).filter(|row| self.order.open_rows().contains(row))
    }

    fn zero(&self) -> Vector<T, U, V> {
        Vector::zero(self.jacobian.dims())
    }

    /// The unit vector with these parts along the null vectors of the free columns.
    pub fn in_null_space(&self, parts: impl Iterator<Item = T>) -> Vector<T, U, V> {
        let sum = self.free().zip(parts).fold(self.zero(), |sum, (column, part)| sum + self.null_vector(column) * part);
        sum.normalized()
    }

    /// The vector x that is 1 at this free column and 0 at the others, with [J A] x = 0 in the rows with a pivot.
    pub fn null_vector(&self, free: usize) -> Vector<T, U, V> {
        self.back_substituted(Vector::unit(self.jacobian.dims(), free), |row| -self.entry(row, free))
    }

    /// Solves [J A] x = `right` in the rows with a pivot, with x zero in the free columns.
    pub fn solve(&self, right: &Column<T, U>) -> Vector<T, U, V> {
        let reduced = self.forward_substituted(right);
        self.back_substituted(self.zero(), |row| reduced[row])
    }

    /// The products of the left null vectors and `right`, L^-1 `right`, in the open rows; zero in the others.
    pub fn left_null_product(&self, right: &Column<T, U>) -> Column<T, U> {
        let reduced = self.forward_substituted(right);
        self.in_open_rows(|row| reduced.part(row))
    }

    /// The largest error of [`left_null_product`](Self::left_null_product) if the components of its argument have
    /// errors up to `noise`, of any sign.
    pub fn left_null_error(&self, noise: &Column<T, U>) -> Column<T, U> {
        self.in_open_rows(|row| {
            // The row of the inverse of L.
            let mut inverse = noise.dim().unit(row);
            for (step, &row) in self.order.rows.iter().take(self.order.pivots).enumerate().rev() {
                let below = self.order.rows.iter().skip(step + 1);
                let sum = below.fold(T::zero(), |sum, &below| sum + inverse.part(below) * self.lower.part(below, step));
                if let Some(entry) = inverse.as_mut_slice().get_mut(row) {
                    *entry -= sum;
                }
            }
            inverse.abs().dot(noise)
        })
    }

    /// The derivatives of [`left_null_product`](Self::left_null_product) of Psi along the null vector of a free column:
    /// the reduced entries of that column in the open rows.
    pub fn slope(&self, free: usize) -> Column<T, U> {
        self.in_open_rows(|row| self.entry(row, free))
    }

    fn in_open_rows(&self, value: impl Fn(usize) -> T) -> Column<T, U> {
        let open = self.order.open_rows();
        self.order.rows.dim().column(|row| if open.contains(&row) { value(row) } else { T::zero() })
    }

    fn entry(&self, row: usize, column: usize) -> T {
        match column.checked_sub(self.rows()) {
            None => self.jacobian.unknowns.part(row, column),
            Some(input) => self.jacobian.inputs.part(row, input),
        }
    }

    fn pivot(&self, step: usize) -> T {
        self.entry(self.order.rows[step], self.order.columns[step])
    }

    /// Eliminates with the largest entry in the open rows and the allowed free columns as the next pivot.
    fn eliminate_largest(&mut self, is_allowed: &impl Fn(usize) -> bool) {
        let mut best = None;
        for row in self.open_rows() {
            for column in self.free().filter(|&column| is_allowed(column)) {
                let size = self.entry(row, column).abs();
                if best.is_none_or(|(largest, _)| size > largest) {
                    best = Some((size, (row, column)));
                }
            }
        }
        if let Some((_, (row, column))) = best {
            self.eliminate(row, column);
        }
    }

    fn eliminate(&mut self, row: usize, column: usize) {
        let step = self.order.pivots;
        self.order.push(row, column);
        let pivot = self.entry(row, column);
        let order = self.order;
        for &other in order.open_rows() {
            let entry = self.entry(other, column);
            if entry.is_zero() || pivot.is_zero() {
                continue;
            }
            let factor = entry / pivot;
            if let Some(entry) = self.lower.get_mut(other, step) {
                *entry = factor;
            }
            self.jacobian.unknowns.take_row(other, row, factor);
            self.jacobian.inputs.take_row(other, row, factor);
        }
    }

    /// L^-1 `right`, by rows of [J A].
    fn forward_substituted(&self, right: &Column<T, U>) -> Column<T, U> {
        let mut reduced = *right;
        for (step, &row) in self.order.rows.iter().take(self.order.pivots).enumerate() {
            let value = reduced.part(row);
            for &below in self.order.rows.iter().skip(step + 1) {
                if let Some(entry) = reduced.as_mut_slice().get_mut(below) {
                    *entry -= self.lower.part(below, step) * value;
                }
            }
        }
        reduced
    }

    /// Back substitution: the coordinates of the pivots from the values of their rows; zero at a pivot that is zero.
    fn back_substituted(&self, mut vector: Vector<T, U, V>, right: impl Fn(usize) -> T) -> Vector<T, U, V> {
        for step in (0..self.order.pivots).rev() {
            let (row, pivot) = (self.order.rows[step], self.pivot(step));
            let later = self.order.dependent().iter().skip(step + 1);
            let rest = later.fold(right(row), |rest, &later| rest - self.entry(row, later) * vector.get(later));
            vector.set(self.order.columns[step], if pivot.is_zero() { T::zero() } else { rest / pivot });
        }
        vector
    }
}

impl<T: Real, U: Dim> Elimination<T, U, D<1>> {
    /// The unit tangent of the curve Psi = 0, in either direction.
    pub fn tangent(&self) -> Vector<T, U, D<1>> {
        self.null_vector(self.first_free()).normalized()
    }

    /// det [J A; `tangent`']. It keeps its sign along the curve, and changes it where another curve is crossed (E. L.
    /// Allgower and K. Georg, "Numerical Continuation Methods", 1990, chapter 8).
    pub fn orientation(&self, tangent: &Vector<T, U, D<1>>) -> T {
        let free = self.first_free();
        // The sign of the permutation from rows to columns, the tangent's row with the free column.
        let mut columns = self.order.rows.dim().repeat(free);
        for (&row, &column) in self.order.rows.iter().zip(self.order.dependent()) {
            columns[row] = column;
        }
        let column = |row: usize| columns.as_slice().get(row).copied().unwrap_or(free);
        let odd = (0..=self.rows()).flat_map(|row| (0..row).map(move |above| (above, row)));
        let is_odd = odd.filter(|&(above, row)| column(above) > column(row)).count() % 2 == 1;
        let volume = self.pivots().iter().fold(tangent.dot(&self.null_vector(free)), |volume, &pivot| volume * pivot);
        if is_odd { -volume } else { volume }
    }

    fn first_free(&self) -> usize {
        self.free().next().unwrap_or(self.rows())
    }
}
