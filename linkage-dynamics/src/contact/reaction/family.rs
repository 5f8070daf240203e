//! The contact forces in given modes: f = base + sum columns_k x_k with `s'' = 0` of the held contacts.
//!
//! The first x are the magnitudes of the forces of the slipping bearings; the others, where held contacts are
//! redundant, the forces of those that depend on the rest.

use super::problem::Problem;
use super::slip::Slips;
use crate::contact::tolerance::held_tolerance;
use crate::contact::{ContactLaw, Mode};
use linkage_runtime::__shared::Ranked;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real};

/// The contact forces in given modes, as an affine function of the x.
#[derive(Debug, Clone, Copy)]
pub(super) struct Family<T: Real, C: Dim> {
    pub base: Column<T, C>,
    pub columns: Column<Column<T, C>, C>,
    /// The bearings that slip.
    slipping: Column<usize, C>,
    pub slips: usize,
    /// False if a prescribed motion accelerates a held contact, whatever the forces.
    pub is_consistent: bool,
    /// The number of redundant held contacts.
    pub spares: usize,
}

impl<T: Real, C: Dim> Family<T, C> {
    pub(super) fn new<V: Dim, N: BorrowedName>(problem: &Problem<'_, T, V, C, N>, modes: &Column<Mode, C>) -> Self {
        let matrix = &problem.response.matrix;
        let c = modes.dim();
        let (mut order, mut count) = (c.repeat(0), 0);
        for place in (0..c.count()).filter(|&place| modes[place].is_held()) {
            order[count] = place;
            count += 1;
        }
        let factors: Ranked<T, C> = Ranked::pivoted(matrix, &order, count, held_tolerance());
        let held = |solution: &Column<T, C>, column: &mut Column<T, C>| {
            for (&contact, &force) in factors.order.iter().zip(solution).take(factors.rank) {
                column[contact] = force;
            }
        };
        let mut base = problem.given(modes);
        let given = base;
        held(&factors.solve(|row| -problem.along(row, &given).0), &mut base);
        let mut family = Self {
            base,
            columns: c.repeat(c.zeros()),
            slipping: c.repeat(0),
            slips: 0,
            is_consistent: true,
            spares: 0,
        };
        for (place, contact) in problem.equations.contacts.iter().enumerate() {
            let sign = match (contact.law, modes[place]) {
                (ContactLaw::Bearing { .. }, Mode::SlipForward) => -T::one(),
                (ContactLaw::Bearing { .. }, Mode::SlipBackward) => T::one(),
                _ => continue,
            };
            let mut column = c.zeros();
            held(&factors.solve(|row| -matrix[(row, place)] * sign), &mut column);
            column[place] = sign;
            family.columns[family.slips] = column;
            family.slipping[family.slips] = place;
            family.slips += 1;
        }
        for dependent in factors.rank..count {
            let contact = factors.order[dependent];
            let (sum, size) = problem.along(contact, &base);
            family.is_consistent &= sum.abs() <= held_tolerance::<T>() * size;
            let mut column = c.zeros();
            held(&-factors.combination(dependent), &mut column);
            column[contact] = T::one();
            family.columns[family.slips + family.spares] = column;
            family.spares += 1;
        }
        family
    }

    /// The forces at these x.
    pub(super) fn at(&self, x: &Column<T, C>) -> Column<T, C> {
        self.columns.iter().zip(x).fold(self.base, |sum, (&column, &x)| sum + column * x)
    }

    /// The family with the magnitudes of the slipping forces set.
    pub(super) fn with_slips(&self, magnitudes: &Column<T, C>) -> Self {
        let mut columns = self.base.dim().repeat(self.base.dim().zeros());
        for (own, &column) in columns.iter_mut().zip(self.columns.as_slice().iter().skip(self.slips)) {
            *own = column;
        }
        let set: Column<T, C> =
            self.base.dim().column(|place| if place < self.slips { magnitudes[place] } else { T::zero() });
        Self { base: self.at(&set), columns, slips: 0, ..*self }
    }

    /// The family with a change of one x.
    pub(super) fn shifted(&self, at: usize, change: T) -> Self {
        Self { base: self.base + self.columns[at] * change, ..*self }
    }

    /// The family in which the magnitudes of the slipping forces are free too.
    pub(super) fn relaxed(&self) -> Self {
        Self { slips: 0, spares: self.slips + self.spares, ..*self }
    }

    /// The equations for the magnitudes of the slipping forces, at zero forces of the redundant contacts.
    pub(super) fn slips<V: Dim, N: BorrowedName>(&self, problem: &Problem<'_, T, V, C, N>) -> Slips<T, C> {
        let mut slips = Slips::none(self.base.dim());
        slips.count = self.slips;
        for row in 0..self.slips {
            let Some(reaction) = &problem.reactions[self.slipping[row]] else { continue };
            slips.factors[row] = reaction.factor;
            slips.base[row] = reaction.load(&self.base);
            for column in 0..self.slips {
                slips.by[row][column] = reaction.along(&self.columns[column]);
            }
        }
        slips
    }

    /// True if the reaction of a slipping bearing depends on the forces of redundant contacts.
    pub(super) fn is_coupled<V: Dim, N: BorrowedName>(&self, problem: &Problem<'_, T, V, C, N>) -> bool {
        let spare = &self.columns.as_slice()[self.slips..self.slips + self.spares];
        self.slipping.iter().take(self.slips).filter_map(|&place| problem.reactions[place].as_ref()).any(|reaction| {
            !reaction.factor.is_zero()
                && spare.iter().any(|column| {
                    (0..2).any(|k| {
                        let terms = reaction.by[k].component_mul(column);
                        terms.sum().abs() > held_tolerance::<T>() * terms.abs().sum()
                    })
                })
        })
    }

    /// True if no x changes the accelerations.
    pub(super) fn is_still<V: Dim, N: BorrowedName>(&self, problem: &Problem<'_, T, V, C, N>) -> bool {
        self.columns.iter().take(self.slips + self.spares).all(|column| {
            (0..problem.response.acceleration.dim().count()).all(|row| {
                let terms = problem.response.columns.row(row).component_mul(column);
                terms.sum().abs() <= held_tolerance::<T>() * terms.abs().sum()
            })
        })
    }

    /// The equation that fixes a linear function `rest` + `slopes` . x at zero, solved for the x with the largest
    /// share: the family without this x. None if the function is constant.
    pub(super) fn fixed(&self, rest: T, slopes: &Column<T, C>) -> Option<Self> {
        let count = self.spares;
        let share = |at: usize| slopes[at].abs() * self.columns[at].largest().recip();
        let pivot = (1..count).fold(0, |best, at| if share(at) > share(best) { at } else { best });
        let slope = slopes[pivot];
        if count == 0 || slope.is_zero() || !slope.recip().is_finite() {
            return None;
        }
        let along = self.columns[pivot];
        let mut columns = self.base.dim().repeat(self.base.dim().zeros());
        let others = (0..count).filter(|&at| at != pivot);
        for (own, at) in columns.iter_mut().zip(others) {
            *own = self.columns[at] - along * (slopes[at] / slope);
        }
        Some(Self { base: self.base - along * (rest / slope), columns, spares: count - 1, ..*self })
    }

    /// The family with the x divided by these units.
    pub(super) fn in_units(&self, units: &Column<T, C>) -> Self {
        let mut family = *self;
        for (column, &unit) in family.columns.iter_mut().zip(units).take(self.spares) {
            *column *= unit;
        }
        family
    }
}
