//! The forces of bearings that slip: t_j = c_j |r_j + sum p_jk t_k| with t_j >= 0.
//!
//! Let G_jk = c_j |p_jk|. If its spectral radius is below 1, the right side is a contraction and t is unique. Else there
//! may be several t or none, as in Painleve's paradox; then all are found: the signs of the forces of guides are
//! enumerated, which leaves linear equations; one pin is a quadratic equation, several are searched for
//! ([`search`](super::search)).

use super::budget::Budget;
use super::problem::length;
use crate::contact::tolerance::sum_tolerance;
use linkage_runtime::__shared::{contraction, solve};
use linkage_runtime::{Build, Column, Dim, Matrix, Real, real};

/// The most solutions that are stored.
const MOST_ROOTS: usize = 8;

/// The limit on iterations for a unique t. Each divides the residual by at least 1 / (spectral radius of G); Newton's
/// method mostly needs five.
const MOST_ITERATIONS: usize = 500;

/// Equations for the magnitudes t of slipping forces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slips<T: Real, C: Dim> {
    pub count: usize,
    /// c.
    pub factors: Column<T, C>,
    /// r.
    pub base: Column<[T; 2], C>,
    /// p, row by row.
    pub by: Column<Column<[T; 2], C>, C>,
}

/// The equations in homogeneous coordinates t and s.
pub(super) struct Homogeneous<T: Real, C: Dim> {
    /// The derivative by t.
    pub slope: Matrix<T, C, C>,
    /// The derivative by s.
    pub by_scale: Column<T, C>,
    pub residual: Column<T, C>,
}

/// The solutions that were found.
#[derive(Debug, Clone, Copy)]
pub(super) struct Roots<T: Real, C: Dim> {
    found: [Column<T, C>; MOST_ROOTS],
    count: usize,
    /// False if there may be others.
    pub is_complete: bool,
}

impl<T: Real, C: Dim> Roots<T, C> {
    pub(super) fn none(c: C) -> Self {
        Self { found: [c.zeros(); MOST_ROOTS], count: 0, is_complete: true }
    }

    pub(super) fn as_slice(&self) -> &[Column<T, C>] {
        &self.found[..self.count]
    }

    /// Adds a solution unless it is known, within the rounding error of a double root.
    pub(super) fn add(&mut self, root: Column<T, C>) {
        let tolerance = T::default_epsilon().sqrt();
        let is_known = self.as_slice().iter().any(|known| (*known - root).largest() <= tolerance * known.largest());
        if is_known {
            return;
        }
        match self.found.get_mut(self.count) {
            Some(place) => {
                *place = root;
                self.count += 1;
            }
            None => self.is_complete = false,
        }
    }
}

impl<T: Real, C: Dim> Slips<T, C> {
    pub(super) fn none(c: C) -> Self {
        let zero = [T::zero(); 2];
        Self { count: 0, factors: c.zeros(), base: c.repeat(zero), by: c.repeat(c.repeat(zero)) }
    }

    /// Finds all t.
    pub(super) fn solve(&self, budget: &mut Budget) -> Roots<T, C> {
        let mut roots = Roots::none(self.factors.dim());
        if self.solve_unique(&mut roots) {
            return roots;
        }
        let guides = (0..self.count).filter(|&row| self.is_guide(row)).count();
        for signs in 0..1_usize << guides {
            self.solve_with_signs(signs, guides, &mut roots, budget);
        }
        roots
    }

    /// Returns true if t is unique or its equation quadratic: then it is solved.
    fn solve_unique(&self, roots: &mut Roots<T, C>) -> bool {
        match self.count {
            0 => roots.add(self.factors.dim().zeros()),
            1 => self.quadratic(roots),
            _ => {
                let Some(weights) = self.weights() else { return false };
                match self.iterate(&weights) {
                    Some(root) => roots.add(root),
                    None => roots.is_complete = false,
                }
            }
        }
        true
    }

    fn is_guide(&self, row: usize) -> bool {
        self.base[row][1].is_zero() && self.by[row].iter().take(self.count).all(|by| by[1].is_zero())
    }

    /// G.
    fn gain(&self) -> Matrix<T, C, C> {
        self.factors.dim().matrix(self.factors.dim(), |row, column| self.factors[row] * length(self.by[row][column]))
    }

    /// Weights w > 0 with G w < w: in their maximum norm the right side is a contraction.
    fn weights(&self) -> Option<Column<T, C>> {
        contraction(&self.gain(), self.factors.dim().repeat(T::one()), self.count)
    }

    /// True if t is unique at any r.
    pub(super) fn is_contraction(&self) -> bool {
        self.weights().is_some()
    }

    /// r + P t of one row.
    pub(super) fn reaction(&self, row: usize, t: &Column<T, C>) -> [T; 2] {
        let terms = self.by[row].iter().zip(t).take(self.count);
        terms.fold(self.base[row], |[x, y], (by, &t)| [x + by[0] * t, y + by[1] * t])
    }

    /// c |r + P t|.
    fn image(&self, t: &Column<T, C>) -> Column<T, C> {
        self.factors
            .dim()
            .column(|row| if row < self.count { self.factors[row] * length(self.reaction(row, t)) } else { T::zero() })
    }

    /// The derivative of t - c |r + P t|. That of |R| at R = 0 counts as zero.
    fn slope(&self, t: &Column<T, C>) -> Matrix<T, C, C> {
        let mut slope = self.factors.dim().identity();
        for row in 0..self.count {
            let reaction = self.reaction(row, t);
            let size = length(reaction);
            if size.is_zero() {
                continue;
            }
            let [x, y] = reaction.map(|component| component / size * self.factors[row]);
            for column in 0..self.count {
                let by = self.by[row][column];
                if let Some(entry) = slope.get_mut(row, column) {
                    *entry -= x * by[0] + y * by[1];
                }
            }
        }
        slope
    }

    /// The t of a contraction: Newton's method, with the contraction itself where a Newton step does not reduce the
    /// residual.
    fn iterate(&self, weights: &Column<T, C>) -> Option<Column<T, C>> {
        let norm = |residual: &Column<T, C>| residual.component_div(&weights.map(|w| w.max(T::one()))).largest();
        let residual = |t: &Column<T, C>| *t - self.image(t);
        let mut t = self.image(&self.factors.dim().zeros());
        let mut size = norm(&residual(&t));
        for _ in 0..MOST_ITERATIONS {
            let enough = T::default_epsilon() * norm(&t);
            if size <= enough {
                return Some(t);
            }
            let step = solve(self.slope(&t), residual(&t), self.count);
            let newton = step.map(|step| (t - step).map(|t| t.max(T::zero())));
            let better = newton.map(|t| (t, norm(&residual(&t)))).filter(|&(_, next)| next < size * real(0.9));
            let image = self.image(&t);
            let (next, next_size) = better.unwrap_or_else(|| (image, norm(&residual(&image))));
            // Only rounding error is left where neither reduces the residual.
            if next_size >= size && size <= sum_tolerance(norm(&t)) {
                return Some(t);
            }
            (t, size) = (next, next_size);
        }
        None
    }

    /// The t of one bearing: t = c |r| x with x^2 = 1 + 2 a x + (a^2 + b^2) x^2, where a and b are the components of c p
    /// along r and across it. The roots are 1 / (d - a) and -1 / (d + a) with d^2 = 1 - b^2.
    fn quadratic(&self, roots: &mut Roots<T, C>) {
        let (c, r, p) = (self.factors[0], self.base[0], self.by[0][0]);
        let load = length(r);
        if load.is_zero() || c.is_zero() {
            roots.add(self.factors.dim().zeros());
            roots.is_complete &= c * length(p) != T::one();
            return;
        }
        let [x, y] = r.map(|component| component / load);
        let (along, across) = (c * (x * p[0] + y * p[1]), c * (x * p[1] - y * p[0]));
        let square = (T::one() - across) * (T::one() + across);
        if square < T::zero() {
            return;
        }
        let root = square.sqrt();
        for divisor in [root - along, -root - along] {
            let t = c * load / divisor;
            if divisor > T::zero() && t.is_finite() {
                roots.add(self.factors.dim().column(|row| if row == 0 { t } else { T::zero() }));
            }
        }
    }

    /// The t with these signs of the forces in the guides, one bit each: t = +-c R is linear.
    fn solve_with_signs(&self, signs: usize, guides: usize, roots: &mut Roots<T, C>, budget: &mut Budget) {
        let (mut order, mut place) = (self.factors.dim().repeat(0), 0);
        for row in (0..self.count).filter(|&row| self.is_guide(row)) {
            order[place] = row;
            place += 1;
        }
        for row in (0..self.count).filter(|&row| !self.is_guide(row)) {
            order[place] = row;
            place += 1;
        }
        // The guides come first: (I - E P_gg) t_g = E (r_g + P_gp t_p).
        let factor = |place: usize| {
            let factor = self.factors[order[place]];
            if signs >> place & 1 == 0 { factor } else { -factor }
        };
        let c = self.factors.dim();
        let identity = c.identity::<T>();
        let system = c.matrix(c, |row, column| {
            let by = if row < guides && column < guides { self.by[order[row]][order[column]][0] } else { T::zero() };
            let factor = if row < guides { factor(row) } else { T::zero() };
            identity[(row, column)] - factor * by
        });
        let side = |entry: &dyn Fn(usize) -> T| {
            c.column(|row| if row < guides { factor(row) * entry(row) } else { T::zero() })
        };
        let Some(base) = solve(system, side(&|row| self.base[order[row]][0]), guides) else {
            roots.is_complete = false;
            return;
        };
        let mut columns = self.factors.dim().repeat(self.factors.dim().zeros());
        for pin in guides..self.count {
            match solve(system, side(&|row| self.by[order[row]][order[pin]][0]), guides) {
                Some(column) => columns[pin] = column,
                None => roots.is_complete = false,
            }
        }
        let pins = self.without_guides((&order, guides), &base, &columns);
        for t in pins.pin_roots(budget, &mut roots.is_complete).as_slice() {
            let (mut root, mut is_root) = (self.factors.dim().zeros(), true);
            for (pin, &t) in t.iter().enumerate().take(pins.count) {
                root[order[guides + pin]] = t;
            }
            for guide in 0..guides {
                let terms = (guides..self.count).map(|pin| columns[pin][guide] * root[order[pin]]);
                let (sum, size) =
                    terms.fold((base[guide], base[guide].abs()), |(sum, size), term| (sum + term, size + term.abs()));
                is_root &= sum >= -sum_tolerance(size);
                root[order[guide]] = sum.max(T::zero());
            }
            if is_root {
                roots.add(root);
            }
        }
    }

    /// The equations of the pins, where the forces in the guides are t_g = `base` + sum `columns` t_p.
    fn without_guides(
        &self,
        (order, guides): (&Column<usize, C>, usize),
        base: &Column<T, C>,
        columns: &Column<Column<T, C>, C>,
    ) -> Self {
        let mut pins = Self::none(self.factors.dim());
        pins.count = self.count - guides;
        let through = |row: usize, start: [T; 2], along: &Column<T, C>| {
            (0..guides).fold(start, |[x, y], guide| {
                let by = self.by[row][order[guide]];
                [x + by[0] * along[guide], y + by[1] * along[guide]]
            })
        };
        for pin in 0..pins.count {
            let row = order[guides + pin];
            pins.factors[pin] = self.factors[row];
            pins.base[pin] = through(row, self.base[row], base);
            for other in 0..pins.count {
                let column = guides + other;
                pins.by[pin][other] = through(row, self.by[row][order[column]], &columns[column]);
            }
        }
        pins
    }

    fn pin_roots(&self, budget: &mut Budget, is_complete: &mut bool) -> Roots<T, C> {
        let mut roots = Roots::none(self.factors.dim());
        if !self.solve_unique(&mut roots) {
            self.search(&mut roots, budget);
        }
        *is_complete &= roots.is_complete;
        roots
    }

    /// The derivative and the residual in homogeneous coordinates: t_j = c_j |r_j s + P t|, with the number s.
    pub(super) fn homogeneous(&self, s: T, t: &Column<T, C>) -> Homogeneous<T, C> {
        let scaled = Self { base: self.base.map(|base| base.map(|component| component * s)), ..*self };
        let residual =
            self.factors.dim().column(|row| if row < self.count { t[row] } else { T::zero() }) - scaled.image(t);
        let mut by_scale = self.factors.dim().zeros();
        for row in 0..self.count {
            let reaction = scaled.reaction(row, t);
            let size = length(reaction);
            if !size.is_zero() {
                let dot = reaction[0] * self.base[row][0] + reaction[1] * self.base[row][1];
                by_scale[row] = -self.factors[row] * dot / size;
            }
        }
        Homogeneous { slope: scaled.slope(t), by_scale, residual }
    }
}
