//! Gaussian elimination of [J A] with complete pivoting, which gives its rank and its null space.
//!
//! No coordinate is preferred: the columns without a pivot are the independent coordinates best aligned with the
//! motion, so that a dead point of the inputs is a position like any other (R. A. Wehage and E. J. Haug, "Generalized
//! coordinate partitioning for dimension reduction in analysis of constrained dynamic systems", J. Mech. Des. 104,
//! 1982; W. C. Rheinboldt and J. V. Burkardt, "A locally parameterized continuation process", 1983).

use core::mem;

use super::{Jacobian, Vector};
use crate::{Column, D, Dim, Matrix, Real};

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
#[derive(Debug, Clone)]
pub struct Elimination<T: Real, U: Dim, V: Dim> {
    jacobian: Jacobian<T, U, V>,
    /// L below its diagonal, by the rows of [J A] and the numbers of the pivots.
    lower: Matrix<T, U, U>,
    order: Order<U>,
}

impl<U: Dim> Order<U> {
    fn none() -> Self {
        Self { rows: Column::from_fn(|row| row), columns: Column::repeat(usize::MAX), pivots: 0 }
    }

    /// The columns of the pivots.
    pub fn dependent(&self) -> &[usize] {
        self.columns.as_slice().get(..self.pivots).unwrap_or_default()
    }

    /// The columns without a pivot: the independent coordinates.
    pub fn free<V: Dim>(&self) -> impl Iterator<Item = usize> + '_ {
        (0..U::COUNT + V::COUNT).filter(|column| !self.dependent().contains(column))
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
    /// Eliminates with all pivots.
    pub fn new(jacobian: Jacobian<T, U, V>) -> Self {
        Self::all_but(0, jacobian)
    }

    /// Eliminates with all pivots but the last `open`; the rows without a pivot are called open.
    pub fn all_but(open: usize, jacobian: Jacobian<T, U, V>) -> Self {
        let mut elimination = Self { jacobian, lower: Matrix::zeros(), order: Order::none() };
        while elimination.order.pivots + open < U::COUNT {
            elimination.pivot_among(&|_| true);
        }
        elimination
    }

    /// Eliminates with pivots in columns of unknowns and of inputs that are not held; held inputs stay independent.
    pub fn holding(held: &Column<bool, V>, jacobian: Jacobian<T, U, V>) -> Self {
        let mut elimination = Self { jacobian, lower: Matrix::zeros(), order: Order::none() };
        while elimination.order.pivots < U::COUNT {
            elimination.pivot_among(&|column| column < U::COUNT || !held[column - U::COUNT]);
        }
        elimination
    }

    /// Eliminates with the pivots of an earlier elimination.
    pub fn in_order(order: &Order<U>, jacobian: Jacobian<T, U, V>) -> Self {
        Self::where_strong(order, jacobian, |_| true)
    }

    /// Eliminates with the pivots of an earlier elimination that are larger than `weak`; the rows of the others stay
    /// open.
    pub fn in_order_above(weak: T, order: &Order<U>, jacobian: Jacobian<T, U, V>) -> Self {
        Self::where_strong(order, jacobian, |pivot| pivot.abs() > weak)
    }

    fn where_strong(order: &Order<U>, jacobian: Jacobian<T, U, V>, is_strong: impl Fn(T) -> bool) -> Self {
        let mut elimination = Self { jacobian, lower: Matrix::zeros(), order: Order::none() };
        for (&row, &column) in order.rows.iter().zip(order.dependent()) {
            if is_strong(elimination.entry(row, column)) {
                elimination.eliminate(row, column);
            }
        }
        elimination
    }

    /// The rows and columns of the pivots.
    pub fn order(&self) -> &Order<U> {
        &self.order
    }

    /// The pivots, which decrease with complete pivoting; zero for open rows.
    pub fn pivots(&self) -> Column<T, U> {
        let places = self.order.rows.iter().zip(self.order.dependent());
        Column::from_iterator(places.map(|(&row, &column)| self.entry(row, column)))
    }

    /// The smallest pivot relative to the largest: 0 where [J A] loses rank.
    pub fn regularity(&self) -> T {
        self.share(U::COUNT.checked_sub(1))
    }

    /// The last but one pivot relative to the largest: 0 where [J A] loses rank twice.
    pub fn last_but_one(&self) -> T {
        self.share(U::COUNT.checked_sub(2))
    }

    /// A pivot relative to the first; 1 if the pivot does not exist.
    fn share(&self, step: Option<usize>) -> T {
        let Some(step) = step else { return T::one() };
        let pivots = self.pivots();
        let first = pivots[0].abs();
        if first > T::zero() { pivots[step].abs() / first } else { T::zero() }
    }

    /// The number of pivots that are at most `weak` times the largest.
    pub fn defect(&self, weak: T) -> usize {
        let pivots = self.pivots();
        let least = pivots.largest() * weak;
        pivots.iter().filter(|pivot| pivot.abs() <= least).count()
    }

    /// The number of pivots after the largest ratio between consecutive pivots.
    pub fn after_gap(&self) -> usize {
        let pivots = self.pivots();
        let mut widest = (T::one(), 1);
        for next in 1..U::COUNT {
            let share = (pivots[next] / pivots[next - 1]).abs();
            if share < widest.0 {
                widest = (share, U::COUNT - next);
            }
        }
        widest.1
    }

    /// The columns without a pivot.
    pub fn free(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.free::<V>()
    }

    /// The rows without a pivot, in the order of [J A].
    pub fn open_rows(&self) -> impl Iterator<Item = usize> + '_ {
        (0..U::COUNT).filter(|row| self.order.open_rows().contains(row))
    }

    /// The vector with a 1 at a free column that the rows of [J A] with a pivot take to zero.
    pub fn null(&self, free: usize) -> Vector<T, U, V> {
        self.above(Vector::unit(free), |row| -self.entry(row, free))
    }

    /// Solves [J A] x = `right` in the rows with a pivot, with x zero in the free columns.
    pub fn solve(&self, right: &Column<T, U>) -> Vector<T, U, V> {
        let reduced = self.reduced(right);
        self.above(Vector::zero(), |row| reduced[row])
    }

    /// L^-1 `right` in the open rows; zero in the others.
    pub fn left(&self, right: &Column<T, U>) -> Column<T, U> {
        let reduced = self.reduced(right);
        self.in_open_rows(|row| reduced[row])
    }

    /// The rounding error of [`left`](Self::left), for errors of unknown sign.
    pub fn left_of_noise(&self, noise: &Column<T, U>) -> Column<T, U> {
        self.in_open_rows(|row| {
            // The row of the inverse of L.
            let mut inverse = Column::<T, U>::unit(row);
            for step in (0..self.order.pivots).rev() {
                let below = self.order.rows.iter().skip(step + 1);
                let sum = below.fold(T::zero(), |sum, &below| sum + inverse[below] * self.lower[(below, step)]);
                inverse[self.order.rows[step]] -= sum;
            }
            inverse.abs().dot(noise)
        })
    }

    /// The derivatives of [`left`](Self::left) of Psi along the null vector of a free column.
    pub fn slope(&self, free: usize) -> Column<T, U> {
        self.in_open_rows(|row| self.entry(row, free))
    }

    fn in_open_rows(&self, value: impl Fn(usize) -> T) -> Column<T, U> {
        let open = self.order.open_rows();
        Column::from_fn(|row| if open.contains(&row) { value(row) } else { T::zero() })
    }

    fn entry(&self, row: usize, column: usize) -> T {
        if column < U::COUNT {
            self.jacobian.unknowns.part(row, column)
        } else {
            self.jacobian.inputs.part(row, column - U::COUNT)
        }
    }

    fn pivot(&self, step: usize) -> T {
        self.entry(self.order.rows[step], self.order.columns[step])
    }

    /// Eliminates with the largest entry that is open as the next pivot.
    fn pivot_among(&mut self, is_open: &impl Fn(usize) -> bool) {
        let mut best = None;
        for row in self.open_rows() {
            for column in self.free().filter(|&column| is_open(column)) {
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
    fn reduced(&self, right: &Column<T, U>) -> Column<T, U> {
        let mut reduced = *right;
        for step in 0..self.order.pivots {
            let value = reduced[self.order.rows[step]];
            for &below in self.order.rows.iter().skip(step + 1) {
                reduced[below] -= self.lower[(below, step)] * value;
            }
        }
        reduced
    }

    /// Back substitution: the coordinates of the pivots from the values of their rows; zero at a pivot that is zero.
    fn above(&self, mut vector: Vector<T, U, V>, right: impl Fn(usize) -> T) -> Vector<T, U, V> {
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
        self.null(self.first_free()).normalized()
    }

    /// det [J A; `tangent`']. It keeps its sign along the curve, and changes it where another curve is crossed (E. L.
    /// Allgower and K. Georg, "Numerical Continuation Methods", 1990, chapter 8).
    pub fn orientation(&self, tangent: &Vector<T, U, D<1>>) -> T {
        let free = self.first_free();
        // The sign of the permutation from rows to columns, the tangent's row with the free column.
        let mut columns = Column::<usize, U>::repeat(free);
        for (&row, &column) in self.order.rows.iter().zip(self.order.dependent()) {
            columns[row] = column;
        }
        let column = |row: usize| columns.as_slice().get(row).copied().unwrap_or(free);
        let odd = (0..=U::COUNT).flat_map(|row| (0..row).map(move |above| (above, row)));
        let is_odd = odd.filter(|&(above, row)| column(above) > column(row)).count() % 2 == 1;
        let volume = self.pivots().iter().fold(tangent.dot(&self.null(free)), |volume, &pivot| volume * pivot);
        if is_odd { -volume } else { volume }
    }

    fn first_free(&self) -> usize {
        self.free().next().unwrap_or(U::COUNT)
    }
}
