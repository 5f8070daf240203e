//! Subdivision of cells: all solutions of t_j = c_j |r_j + sum p_jk t_k| for several pins.
//!
//! In homogeneous coordinates t_j = c_j |r_j s + sum p_jk t_k| the range of t is bounded: the faces of a cube where s
//! or a t is 1. On each cell an enclosure of both sides excludes solutions, Krawczyk's operator excludes them or shows
//! that there is at most one, which Newton's method finds (A. Neumaier, *Interval Methods for Systems of Equations*,
//! 1990, chapter 5), or the cell is divided. Enclosures are those of real arithmetic, without directed rounding.

use super::budget::Budget;
use super::problem::length;
use super::slip::{Homogeneous, Roots, Slips};
use linkage_runtime::__shared::solve;
use linkage_runtime::{Build, Column, Dim, Matrix, Real, real};

/// A cell that is not decided at this radius, relative to the cube, is given up.
const LEAST_RADIUS: f64 = 1e-6;

/// A unit vector along w changes by less than this times the relative change of w: 2 sin(45deg).
const TURN: f64 = core::f64::consts::SQRT_2;

/// Solutions with s below this count as infinite.
const LEAST_SCALE: f64 = 1e-12;

/// The limit on Newton iterations in a cell with at most one solution.
const MOST_ITERATIONS: usize = 50;

/// A box in homogeneous coordinates: s and t, each with its radius.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<T: Real, C: Dim> {
    pub scale: [T; 2],
    pub centre: Column<T, C>,
    pub radius: Column<T, C>,
}

impl<T: Real, C: Dim> Cell<T, C> {
    /// Halves the widest side among s and the first `count` coordinates; None if the cell is too small.
    pub(super) fn halves(&self, count: usize) -> Option<[Self; 2]> {
        let widest = (0..count).fold(None, |best: Option<usize>, at| {
            let width = best.map_or(self.scale[1], |best| self.radius[best]);
            if self.radius[at] > width { Some(at) } else { best }
        });
        let radius = widest.map_or(self.scale[1], |at| self.radius[at]) * real(0.5);
        if radius <= real(LEAST_RADIUS) {
            return None;
        }
        Some([-radius, radius].map(|shift| {
            let mut half = *self;
            match widest {
                None => half.scale = [self.scale[0] + shift, radius],
                Some(at) => {
                    half.centre[at] += shift;
                    half.radius[at] = radius;
                }
            }
            half
        }))
    }

    /// The range of the length of `base` s + `by` t.
    pub(super) fn lengths(&self, base: [T; 2], by: impl Fn(usize) -> [T; 2], count: usize) -> ([T; 2], T, T) {
        let start = (base.map(|component| component * self.scale[0]), length(base) * self.scale[1]);
        let (centre, radius) = (0..count).fold(start, |([x, y], radius), at| {
            let column = by(at);
            let centre = [x + column[0] * self.centre[at], y + column[1] * self.centre[at]];
            (centre, radius + length(column) * self.radius[at])
        });
        (centre, length(centre), radius)
    }
}

/// The cells of a face of the cube: the coordinate with this index is 1, s for None.
fn face<T: Real, C: Dim>(c: C, fixed: Option<usize>) -> Cell<T, C> {
    let half = real::<T>(0.5);
    let side = |is_fixed: bool| if is_fixed { [T::one(), T::zero()] } else { [half, half] };
    let of = |at: usize| side(fixed == Some(at));
    Cell { scale: side(fixed.is_none()), centre: c.column(|at| of(at)[0]), radius: c.column(|at| of(at)[1]) }
}

impl<T: Real, C: Dim> Slips<T, C> {
    /// Adds all solutions t >= 0 of several pins.
    pub(super) fn search(&self, roots: &mut Roots<T, C>, budget: &mut Budget) {
        let loads = (0..self.count).map(|row| self.factors[row] * length(self.base[row]));
        let unit = loads.fold(T::zero(), T::max);
        if unit.is_zero() {
            roots.add(self.factors.dim().zeros());
            roots.is_complete = false;
            return;
        }
        let scaled = Self { base: self.base.map(|base| base.map(|component| component / unit)), ..*self };
        scaled.explore(&face(self.factors.dim(), None), None, unit, roots, budget);
        for fixed in 0..self.count {
            scaled.explore(&face(self.factors.dim(), Some(fixed)), Some(fixed), unit, roots, budget);
        }
    }

    fn explore(&self, cell: &Cell<T, C>, fixed: Option<usize>, unit: T, roots: &mut Roots<T, C>, budget: &mut Budget) {
        if !budget.spend() {
            roots.is_complete = false;
            return;
        }
        if self.excludes(cell) || self.is_decided(cell, fixed, unit, roots) {
            return;
        }
        match cell.halves(self.count) {
            Some(halves) => halves.iter().for_each(|half| self.explore(half, fixed, unit, roots, budget)),
            None => roots.is_complete = false,
        }
    }

    /// True if the ranges of t_j and c_j |R_j| have no number in common.
    fn excludes(&self, cell: &Cell<T, C>) -> bool {
        let slack = real::<T>(64.0) * T::default_epsilon();
        (0..self.count).any(|row| {
            let (_, size, radius) = cell.lengths(self.base[row], |at| self.by[row][at], self.count);
            let [least, most] = [-radius, radius].map(|radius| self.factors[row] * (size + radius));
            let (t, width) = (cell.centre[row], cell.radius[row]);
            let slack = slack * (T::one() + self.factors[row] * size);
            most + slack < t - width || least - slack > t + width
        })
    }

    /// Tries Krawczyk's operator on the cell, enlarged by a quarter; returns true if it contains no solution, or its
    /// only one was found.
    pub(super) fn is_decided(&self, cell: &Cell<T, C>, fixed: Option<usize>, unit: T, roots: &mut Roots<T, C>) -> bool {
        let count = self.count;
        let Homogeneous { slope, by_scale, residual } = self.homogeneous(cell.scale[0], &cell.centre);
        let square = |slope: &Matrix<T, C, C>, by_scale: &Column<T, C>| {
            let mut square = *slope;
            if let Some(fixed) = fixed {
                square.set_column(fixed, *by_scale);
            }
            square
        };
        let slope = square(&slope, &by_scale);
        let mut inverse = self.factors.dim().zero_matrix(self.factors.dim());
        for at in 0..count {
            let Some(column) = solve(slope, self.factors.dim().unit(at), count) else { return false };
            inverse.set_column(at, column);
        }
        let radius = |at: usize| if fixed == Some(at) { cell.scale[1] } else { cell.radius[at] };
        let wide = |at: usize| radius(at) * real(1.25);
        // The change of the derivative within the cell, times the radii.
        let mut change = self.factors.dim().zeros();
        for row in 0..count {
            let (_, size, spread) = cell.lengths(self.base[row], |at| self.by[row][at], count);
            let spread = spread * real(1.25);
            if spread.is_zero() {
                continue;
            }
            if spread >= size {
                return false;
            }
            change[row] = self.factors[row] * real::<T>(TURN) * spread / size * spread;
        }
        let (step, change) = (inverse * residual, inverse.abs() * change);
        if (0..count).any(|at| step[at].abs() > radius(at) + change[at]) {
            return true;
        }
        if !(0..count).all(|at| change[at] < wide(at) * real(0.99)) {
            return false;
        }
        let (mut scale, mut t) = (cell.scale[0], cell.centre);
        for _ in 0..MOST_ITERATIONS {
            let Homogeneous { slope, by_scale, residual } = self.homogeneous(scale, &t);
            let Some(step) = solve(square(&slope, &by_scale), residual, count) else { return false };
            for at in 0..count {
                let own = if fixed == Some(at) { &mut scale } else { &mut t[at] };
                *own -= step[at];
            }
            if step.largest() <= T::default_epsilon() * real(4.0) {
                break;
            }
        }
        let moved = |at: usize| if fixed == Some(at) { scale - cell.scale[0] } else { t[at] - cell.centre[at] };
        let Homogeneous { residual, .. } = self.homogeneous(scale, &t);
        let is_root = residual.largest() <= T::default_epsilon() * real(1024.0);
        if !is_root || (0..count).any(|at| moved(at).abs() > wide(at)) {
            return false;
        }
        if scale > real(LEAST_SCALE) && t.iter().take(count).all(|&t| t >= -T::default_epsilon()) {
            roots.add(
                self.factors
                    .dim()
                    .column(|at| if at < count { t[at].max(T::zero()) / scale * unit } else { T::zero() }),
            );
        }
        true
    }
}
