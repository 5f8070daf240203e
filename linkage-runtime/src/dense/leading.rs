//! The leading equations of a system without symmetry.

use crate::{Build, Column, Dim, Matrix, Real, real};

/// A pivot below this many ulps of the largest entry of its column counts as zero.
const LEAST_PIVOT_ULPS: f64 = 64.0;

/// Solves the leading `count` equations A x = `side` by elimination with partial pivoting; None if A is singular.
#[must_use]
pub fn solve<T: Real, C: Dim>(
    mut matrix: Matrix<T, C, C>,
    mut side: Column<T, C>,
    count: usize,
) -> Option<Column<T, C>> {
    let least = real::<T>(LEAST_PIVOT_ULPS) * T::default_epsilon();
    let scales: Column<T, C> = matrix.columns().map(|column| column.largest());
    for step in 0..count {
        let best = (step + 1..count)
            .fold(step, |best, row| if matrix[(row, step)].abs() > matrix[(best, step)].abs() { row } else { best });
        let pivot = matrix[(best, step)];
        let is_regular = pivot.abs() > least * scales[step] && pivot.is_finite();
        if !is_regular {
            return None;
        }
        for column in matrix.columns_mut() {
            column.as_mut_slice().swap(step, best);
        }
        side.as_mut_slice().swap(step, best);
        eliminate(&mut matrix, &mut side, step, count);
    }
    substitute(&matrix, side, count)
}

/// Solves (I - G) x = `side` for G >= 0 if the spectral radius of G is below 1: then, and only then, all pivots
/// without exchanges are positive (A. Berman and R. J. Plemmons, *Nonnegative Matrices*, 1979, chapter 6).
#[must_use]
pub fn contraction<T: Real, C: Dim>(
    gain: &Matrix<T, C, C>,
    mut side: Column<T, C>,
    count: usize,
) -> Option<Column<T, C>> {
    let least = real::<T>(LEAST_PIVOT_ULPS) * T::default_epsilon();
    let (c, _) = gain.dims();
    let identity = c.identity::<T>();
    let mut matrix = c.matrix(c, |row, column| identity[(row, column)] - gain[(row, column)]);
    for step in 0..count {
        let pivot = matrix[(step, step)];
        let is_positive = pivot > least && pivot.is_finite();
        if !is_positive {
            return None;
        }
        eliminate(&mut matrix, &mut side, step, count);
    }
    substitute(&matrix, side, count)
}

/// Eliminates the unknown `step` from the equations below it, by the pivot on the diagonal.
fn eliminate<T: Real, C: Dim>(matrix: &mut Matrix<T, C, C>, side: &mut Column<T, C>, step: usize, count: usize) {
    let pivot = matrix[(step, step)];
    for row in step + 1..count {
        let factor = matrix[(row, step)] / pivot;
        if !factor.is_zero() {
            matrix.take_row(row, step, factor);
            side[row] = side[row] - factor * side[step];
        }
    }
}

/// Solves the triangular system that elimination leaves; None if the solution is not finite.
fn substitute<T: Real, C: Dim>(matrix: &Matrix<T, C, C>, mut side: Column<T, C>, count: usize) -> Option<Column<T, C>> {
    for step in (0..count).rev() {
        let known = (step + 1..count).fold(T::zero(), |sum, later| sum + matrix[(step, later)] * side[later]);
        side[step] = (side[step] - known) / matrix[(step, step)];
    }
    side.as_slice()[..count].iter().all(T::is_finite).then_some(side)
}
