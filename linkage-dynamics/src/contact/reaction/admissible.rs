//! The existence of admissible forces of redundant held contacts, as in a stuck ladder or drawer.
//!
//! The forces with `s'' = 0` form a family with one parameter y for each redundant contact. On a line the bounds of each
//! force are quadratic inequalities in y: the least distance from all bounds is evaluated at all their roots and
//! between them. In more dimensions, in this order:
//!
//! 1. the path from slip backward to slip forward, where there is one motion ([`path`](super::path));
//! 2. forces for fixed limits, by the active-set method, with the limits updated until they repeat;
//! 3. lines on which all but one of the bounds that are flat are active: they decide if all bounds are flat, those of
//!    given limits, stops and guides;
//! 4. a subdivision that finds forces, or excludes them.

use super::budget::Budget;
use super::family::Family;
use super::problem::{Problem, Reaction, length};
use super::search::Cell;
use crate::contact::bounded::{Bounds, bounded};
use crate::contact::{ContactLaw, Mode};
use linkage_runtime::__shared::contraction;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

/// The limit on updates of the limits. Each divides their error by about 1 / (friction coefficient).
const MOST_UPDATES: usize = 40;

/// The most roots on a line: each contact has at most two quadratic bounds.
const ROOTS_PER_CONTACT: usize = 4;

/// The answer.
#[derive(Debug, Clone, Copy)]
pub(super) enum Existence<T: Real, C: Dim> {
    /// Forces within their bounds.
    Found(Column<T, C>),
    /// There are none.
    Excluded,
    /// None were found, and not excluded.
    Undecided,
}

/// A held motion: the contacts in their modes, and the family of forces.
pub(super) struct HeldForces<'a, T: Real, V: Dim, C: Dim, N: BorrowedName> {
    pub problem: &'a Problem<'a, T, V, C, N>,
    pub modes: &'a Column<Mode, C>,
    /// The contacts whose forces have bounds.
    pub is_bounded: Column<bool, C>,
}

impl<T: Real, V: Dim, C: Dim, N: BorrowedName> HeldForces<'_, T, V, C, N> {
    /// Searches a family for forces within all bounds.
    pub(super) fn admissible(&self, family: &Family<T, C>, budget: &mut Budget) -> Existence<T, C> {
        if self.is_admissible(&family.base) {
            return Existence::Found(family.base);
        }
        match family.spares {
            0 => return Existence::Excluded,
            1 => return self.on_line(family).map_or(Existence::Excluded, Existence::Found),
            _ => {}
        }
        if let Some(existence) = self.on_path(&family.base) {
            return existence;
        }
        if let Some(forces) = self.by_updates(&family.base) {
            return Existence::Found(forces);
        }
        if let Some(forces) = self.on_edges(family) {
            return Existence::Found(forces);
        }
        if self.bounded().all(|place| self.is_flat(place)) {
            return Existence::Excluded;
        }
        self.by_subdivision(family, budget)
    }

    /// Does the same as [`admissible`](Self::admissible), and tries the forces of this motion in other modes first.
    pub(super) fn admissible_from(
        &self,
        known: Option<&Column<T, C>>,
        family: &Family<T, C>,
        budget: &mut Budget,
    ) -> Existence<T, C> {
        let holds = |forces: &&Column<T, C>| {
            self.is_admissible(forces) && self.bounded().all(|place| self.problem.stands(place, forces))
        };
        match known.filter(|_| family.spares > 0).filter(holds) {
            Some(forces) => Existence::Found(*forces),
            None => self.admissible(family, budget),
        }
    }

    fn bounded(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_bounded.dim().count()).filter(|&place| self.is_bounded[place])
    }

    pub(super) fn is_admissible(&self, forces: &Column<T, C>) -> bool {
        forces.is_finite() && self.bounded().all(|place| self.problem.is_within(place, self.modes[place], forces))
    }

    /// True if the bounds of a force are linear in all forces.
    fn is_flat(&self, place: usize) -> bool {
        self.problem.reactions[place]
            .as_ref()
            .is_none_or(|reaction| reaction.base[1].is_zero() && reaction.by[1].iter().all(T::is_zero))
    }

    /// Forces on a line, those with the least relative excess; None if they exceed a bound.
    fn on_line(&self, family: &Family<T, C>) -> Option<Column<T, C>> {
        let mut places = [self.is_bounded.dim().zeros(); ROOTS_PER_CONTACT];
        let mut known = [self.is_bounded.dim().repeat(false); ROOTS_PER_CONTACT];
        let along = family.columns[0];
        for place in self.bounded() {
            let roots = self.bounds_on_line(place, family);
            for (k, root) in roots.into_iter().enumerate() {
                let Some(root) = root.filter(T::is_finite) else { continue };
                (places[k][place], known[k][place]) = (root, true);
            }
        }
        let of = |y: T| family.base + along * y;
        let all = || {
            let of_rank = |k: usize| {
                (0..self.is_bounded.dim().count()).filter(move |&at| known[k][at]).map(move |at| places[k][at])
            };
            (0..ROOTS_PER_CONTACT).flat_map(of_rank)
        };
        for y in all() {
            if self.is_admissible(&of(y)) {
                return Some(of(y));
            }
            // Between this root and the next, and beyond the last.
            let next = all().filter(|&other| other > y).reduce(T::min);
            let beyond = y + y.abs().max(self.unit(family, 0));
            let middle = next.map_or(beyond, |next| (y + next) * real(0.5));
            if self.is_admissible(&of(middle)) {
                return Some(of(middle));
            }
        }
        let first = all().reduce(T::min)?;
        let before = first - first.abs().max(self.unit(family, 0));
        Some(of(before)).filter(|forces| self.is_admissible(forces))
    }

    /// The y at which a force meets its bounds.
    fn bounds_on_line(&self, place: usize, family: &Family<T, C>) -> [Option<T>; ROOTS_PER_CONTACT] {
        let (base, slope) = (family.base[place], family.columns[0][place]);
        let flat = |level: T| (!slope.is_zero()).then(|| (level - base) / slope);
        match (self.problem.equations.contacts[place].law, &self.problem.reactions[place]) {
            (ContactLaw::Friction { limit }, _) => [flat(limit), flat(-limit), None, None],
            (ContactLaw::Bearing { factor }, Some(reaction)) => {
                let (at, by) = (reaction.at(&family.base), reaction.along(&family.columns[0]));
                let [first, second] = quadratic([base, slope], at.map(|r| factor * r), by.map(|r| factor * r));
                [first, second, flat(T::zero()), None]
            }
            _ => [flat(T::zero()), None, None, None],
        }
    }

    /// The scale of a parameter.
    pub(super) fn unit(&self, family: &Family<T, C>, at: usize) -> T {
        let column = &family.columns[at];
        let units = self.bounded().filter(|&place| !column[place].is_zero());
        let units = units.map(|place| self.problem.force_scale(place, &family.base) / column[place].abs());
        let unit = units.fold(T::zero(), T::max);
        if unit > T::zero() { unit } else { T::one() }
    }

    /// Forces within limits that are updated until they repeat. `start` has the forces of the other contacts.
    fn by_updates(&self, start: &Column<T, C>) -> Option<Column<T, C>> {
        let moving: Column<T, C> =
            self.is_bounded.dim().column(|place| if self.is_bounded[place] { T::zero() } else { start[place] });
        let mut forces = *start;
        for _ in 0..MOST_UPDATES {
            let next = self.within_limits(&moving, &forces)?;
            if self.bounded().all(|place| self.problem.stands(place, &next)) && self.is_admissible(&next) {
                return Some(next);
            }
            let change = (next - forces).largest();
            forces = next;
            let is_settled = change <= T::default_epsilon() * forces.largest();
            if is_settled || !change.is_finite() {
                return None;
            }
        }
        None
    }

    /// The bounded forces that the active-set method finds for the limits at `forces`, added to those of the moving
    /// contacts.
    pub(super) fn within_limits(&self, moving: &Column<T, C>, forces: &Column<T, C>) -> Option<Column<T, C>> {
        let endless = real::<T>(f64::INFINITY);
        let bounds = self.is_bounded.dim().column(|place| {
            if !self.is_bounded[place] {
                return None;
            }
            let limit = self.problem.limit(place, forces);
            let [lower, upper] = match self.modes[place] {
                Mode::AtLower => [T::zero(), endless],
                Mode::AtUpper => [-endless, T::zero()],
                Mode::SlipForward => [-limit, T::zero()],
                Mode::SlipBackward => [T::zero(), limit],
                _ => [-limit, limit],
            };
            Some(Bounds { lower, upper, bias: self.problem.along(place, moving) })
        });
        let solution = bounded(&self.problem.response.matrix, &bounds).ok()?;
        Some(*moving + solution.forces)
    }

    /// Forces where flat bounds are active.
    pub(super) fn on_edges(&self, family: &Family<T, C>) -> Option<Column<T, C>> {
        if self.is_admissible(&family.base) {
            return Some(family.base);
        }
        if family.spares == 1 {
            return self.on_line(family);
        }
        self.bounded().filter(|&place| self.is_flat(place)).find_map(|place| {
            let slopes: Column<T, C> = family.columns.map(|column| column[place]);
            let on = |rest: T, slopes: &Column<T, C>| self.on_edges(&family.fixed(rest, slopes)?);
            let force = family.base[place];
            match (self.problem.equations.contacts[place].law, &self.problem.reactions[place]) {
                (ContactLaw::Friction { limit }, _) => {
                    [limit, -limit].into_iter().find_map(|limit| on(force - limit, &slopes))
                }
                (ContactLaw::Bearing { factor }, Some(reaction)) => [factor, -factor].into_iter().find_map(|factor| {
                    let [at, _] = reaction.at(&family.base);
                    let by: Column<T, C> = family.columns.map(|column| reaction.along(&column)[0] * factor);
                    on(force - at * factor, &(slopes - by))
                }),
                _ => on(force, &slopes),
            }
        })
    }

    fn by_subdivision(&self, family: &Family<T, C>, budget: &mut Budget) -> Existence<T, C> {
        let count = family.spares;
        let (zero, one, half) = (T::zero(), T::one(), real::<T>(0.5));
        let ones: Column<T, C> = self.is_bounded.dim().column(|at| if at < count { one } else { zero });
        if let Some(radius) = self.greatest(family).and_then(|most| self.radius(family, &most)) {
            // Each force is below a bound: the parameters, forces of contacts, fill one cell.
            let cell = Cell { scale: [one, zero], centre: self.is_bounded.dim().zeros(), radius: ones };
            return self.explore(&family.in_units(&radius), &cell, budget);
        }
        let units: Column<T, C> =
            self.is_bounded.dim().column(|at| if at < count { self.unit(family, at) } else { zero });
        let family = family.in_units(&units);
        // The face where s is 1, and those where a parameter is 1 or -1.
        let sides = (0..count).flat_map(|at| [Some((at, one)), Some((at, -one))]);
        let mut answer = Existence::Excluded;
        for fixed in core::iter::once(None).chain(sides) {
            let side = |place: usize| fixed.filter(|&(at, _)| at == place).map(|(_, sign)| sign);
            let cell = Cell {
                scale: if fixed.is_none() { [one, zero] } else { [half, half] },
                centre: self.is_bounded.dim().column(|place| side(place).unwrap_or(zero)),
                radius: self.is_bounded.dim().column(|place| if side(place).is_some() { zero } else { ones[place] }),
            };
            match self.explore(&family, &cell, budget) {
                Existence::Excluded => {}
                Existence::Undecided => answer = Existence::Undecided,
                found @ Existence::Found(_) => return found,
            }
        }
        answer
    }

    /// The greatest magnitudes of the bounded forces: u <= c |r| + G u where the spectral radius of G is below 1.
    fn greatest(&self, family: &Family<T, C>) -> Option<Column<T, C>> {
        let mut gain = self.is_bounded.dim().zero_matrix(self.is_bounded.dim());
        let mut side = self.is_bounded.dim().zeros();
        for place in self.bounded() {
            match (self.problem.equations.contacts[place].law, &self.problem.reactions[place]) {
                (ContactLaw::Friction { limit }, _) => side[place] = limit,
                (ContactLaw::Bearing { .. }, Some(Reaction { factor, by, .. })) => {
                    let moving: Column<T, C> = self
                        .is_bounded
                        .dim()
                        .column(|at| if self.is_bounded[at] { T::zero() } else { family.base[at] });
                    side[place] = *factor * length(self.problem.reactions[place].as_ref()?.at(&moving));
                    for other in self.bounded() {
                        *gain.get_mut(place, other)? = *factor * length([by[0][other], by[1][other]]);
                    }
                }
                _ => return None,
            }
        }
        contraction(&gain, side, self.is_bounded.dim().count())
    }

    /// The range of each parameter: that of a force that only this parameter changes by 1.
    fn radius(&self, family: &Family<T, C>, most: &Column<T, C>) -> Option<Column<T, C>> {
        let mut radius = self.is_bounded.dim().zeros();
        for at in 0..family.spares {
            let only = |place: usize| {
                let mut others = (0..family.spares).filter(|&other| other != at);
                self.is_bounded[place]
                    && family.columns[at][place].abs() == T::one()
                    && family.base[place].is_zero()
                    && others.all(|other| family.columns[other][place].is_zero())
            };
            radius[at] = most[(0..self.is_bounded.dim().count()).find(|&place| only(place))?] * real(1.0 + 1e-9);
        }
        Some(radius)
    }

    fn explore(&self, family: &Family<T, C>, cell: &Cell<T, C>, budget: &mut Budget) -> Existence<T, C> {
        if !budget.spend() {
            return Existence::Undecided;
        }
        let scale = cell.scale[0];
        if scale > T::zero() {
            let forces = family.at(&self
                .is_bounded
                .dim()
                .column(|at| if at < family.spares { cell.centre[at] / scale } else { T::zero() }));
            if self.is_admissible(&forces) {
                return Existence::Found(forces);
            }
        }
        if self.bounded().any(|place| self.exceeds(place, family, cell)) {
            return Existence::Excluded;
        }
        let Some(halves) = cell.halves(family.spares) else { return Existence::Undecided };
        let mut answer = Existence::Excluded;
        for half in halves {
            match self.explore(family, &half, budget) {
                Existence::Excluded => {}
                Existence::Undecided => answer = Existence::Undecided,
                found @ Existence::Found(_) => return found,
            }
        }
        answer
    }

    /// True if a force exceeds its bounds in the whole cell.
    fn exceeds(&self, place: usize, family: &Family<T, C>, cell: &Cell<T, C>) -> bool {
        let own = |at: usize| [family.columns[at][place], T::zero()];
        let ([force, _], size, radius) = cell.lengths([family.base[place], T::zero()], own, family.spares);
        let tolerance = self.problem.force_tolerance(place, &family.base) * cell.scale[0];
        let most = match (self.problem.equations.contacts[place].law, &self.problem.reactions[place]) {
            (ContactLaw::Friction { limit }, _) => limit * (cell.scale[0] + cell.scale[1]),
            (ContactLaw::Bearing { factor }, Some(reaction)) => {
                let by = |at: usize| reaction.along(&family.columns[at]);
                let (_, size, radius) = cell.lengths(reaction.at(&family.base), by, family.spares);
                factor * (size + radius)
            }
            _ => T::zero(),
        };
        let is_pulled = match self.modes[place] {
            Mode::AtLower | Mode::SlipBackward => force + radius < -tolerance,
            Mode::AtUpper | Mode::SlipForward => force - radius > tolerance,
            _ => false,
        };
        let has_limit = !matches!(self.modes[place], Mode::AtLower | Mode::AtUpper);
        is_pulled || (has_limit && size - radius > most + tolerance)
    }
}

/// The roots of |f_0 + f_1 y|^2 = |r_0 + r_1 y|^2.
pub(super) fn quadratic<T: Real>([f, by]: [T; 2], r: [T; 2], slope: [T; 2]) -> [Option<T>; 2] {
    if r[1].is_zero() && slope[1].is_zero() {
        // Two linear equations, without the loss of digits of a square.
        let root = |sign: T| {
            let slope = by - slope[0] * sign;
            (!slope.is_zero()).then(|| (r[0] * sign - f) / slope)
        };
        return [root(T::one()), root(-T::one())];
    }
    let square = slope[0] * slope[0] + slope[1] * slope[1] - by * by;
    let half = r[0] * slope[0] + r[1] * slope[1] - f * by;
    let rest = r[0] * r[0] + r[1] * r[1] - f * f;
    let discriminant = half * half - square * rest;
    if discriminant < T::zero() {
        // A rounding error can make the discriminant of a double root negative. The double root is the vertex.
        return [(!square.is_zero()).then(|| -half / square), None];
    }
    let root = discriminant.sqrt();
    let sum = if half >= T::zero() { -half - root } else { root - half };
    [(!square.is_zero()).then(|| sum / square), (!sum.is_zero()).then(|| rest / sum)]
}
