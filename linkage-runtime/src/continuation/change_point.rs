//! Change points, where [J A] loses rank and curves cross.
//!
//! Let n1 .. nk span the null space of [J A], and let the k - 1 rows of N span its left null space: the elimination of
//! [J A] leaves k - 1 rows open, that is without a pivot, and each is a left null vector. At a crossing the slopes of
//! N Psi, its derivatives along n1 .. nk, vanish (H. B. Keller, "Lectures on Numerical Methods in Bifurcation
//! Problems", 1987, section 5). If N has one row, the crossing is a saddle point of N Psi: a regular root of the
//! slopes, which Newton's method finds to rounding error even if [J A] is only nearly singular. If N has more rows,
//! there are more slopes than directions, and the Gauss-Newton method is used. At a change point N Psi is zero there;
//! where curves only come close to each other it is not. The tangents are the common zeros of the quadratic forms
//! x . (N Psi_qq) x in the null space.
//!
//! Motions can touch, too: where those of a part of a mechanism cross, as of a four-bar in line, while the rest reverses
//! this part, as a slider's link that is perpendicular to its guide, the form is a square and its saddle point degenerate.
//! The crossing of the part and the reversal of the rest are regular roots, and are found one after the other.

use super::cone::{Cone, DIMENSIONS, Form};
use super::curve::{Curve, Linear};
use super::groups::Groups;
use super::tangents::MOST_TANGENTS;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero, ulps};
use crate::jacobian::{Cholesky, EliminationOf as Elimination, VectorOf as Vector};
use crate::scalar::arithmetic::*;
use crate::scalar::largest;
use crate::{Build, Column, D, Dim, Matrix, Mechanism, PathErrorOf, PerUnknown, Real, real};

/// The most Newton steps; a search from the path takes three to five.
const MOST_ITERATIONS: usize = 12;

/// A row of [J A] belongs to the part of a mechanism whose motions cross if its weight in N is more than this fraction of the
/// largest: near a touch the weights of the others are proportional to the distance from it.
const LEAST_WEIGHT: f64 = 0.125;

/// For each equation the coordinate that is held instead, if any.
type Held<M> = Column<Option<usize>, <M as Mechanism>::U>;

/// A change point and the unit tangents of the curves that cross there; their signs are arbitrary.
pub(super) struct Crossing<M: Mechanism> {
    pub(super) q: M::Coordinates,
    tangents: [Vector<M>; MOST_TANGENTS],
    count: usize,
    /// True if `tangents` holds all of them.
    pub(super) is_complete: bool,
    /// The rank deficiency of [J A].
    pub(super) defect: usize,
    /// The groups that are singular there.
    pub(super) groups: Groups<M::Name>,
    /// The touch, if the motions touch: they have one tangent.
    pub(super) touch: Option<Touch<M>>,
}

/// Motions of a part of a mechanism that cross where the rest reverses this part: all motions of the whole have the tangent
/// of the reversal.
pub(super) struct Touch<M: Mechanism> {
    /// The groups with equations of the part.
    pub(super) groups: Groups<M::Name>,
    /// The tangents of the motions of the part.
    pub(super) tangents: [Vector<M>; 2],
}

impl<M: Mechanism> Clone for Touch<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Touch<M> {}

impl<M: Mechanism> Clone for Crossing<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Crossing<M> {}

impl<M: Mechanism> Crossing<M> {
    pub(super) fn tangents(&self) -> &[Vector<M>] {
        &self.tangents[..self.count]
    }

    /// Moves the tangent nearest to a direction to the front, with the sign of that direction.
    pub(super) fn put_first(&mut self, direction: &Vector<M>) {
        let nearness = |tangent: &Vector<M>| tangent.dot(direction).abs();
        for place in 1..self.count {
            if nearness(&self.tangents[place]) > nearness(&self.tangents[0]) {
                self.tangents.swap(0, place);
            }
        }
        if self.tangents[0].dot(direction) < M::Scalar::zero() {
            self.tangents[0] = -self.tangents[0];
        }
    }
}

impl<M> Curve<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    /// Finds the change point within `reach` of `guess`, if there is one. If its tangents form a continuous family,
    /// only the one nearest to `direction` is returned.
    pub(super) fn crossing(
        &self,
        guess: &M::Coordinates,
        reach: M::Scalar,
        direction: &Vector<M>,
    ) -> Result<Option<Crossing<M>>, PathErrorOf<M>> {
        let (at, none) = (self.linear(guess)?, self.mechanism.dims().0.repeat(None));
        // A simple crossing first; then one with the rank deficiency that the pivots suggest.
        let likely = Elimination::<M>::new(at.jacobian).count_after_largest_drop();
        for open in [1, likely].into_iter().take(if likely == 1 { 1 } else { 2 }) {
            let Some(mut q) = self.stationary(guess, reach, open, &none)? else { continue };
            let at = self.linear(&q)?;
            let defect = Elimination::<M>::new(at.jacobian).defect(nearly_zero());
            if defect > open {
                // The null space is larger than assumed: the search is repeated with more open rows.
                let Some(better) = self.stationary(&q, nearly_zero(), defect, &none)? else { continue };
                q = better;
            }
            if let Some(crossing) = self.tangents(q, defect.max(1), direction)? {
                return Ok(Some(crossing));
            }
        }
        Ok(None)
    }

    /// Finds the position within `reach` of `guess` where motions touch.
    ///
    /// The motions of a part of the mechanism cross there, and the rest reverses it, so that the form of the open row is a
    /// square. The motions of the part alone cross at a saddle point, which is found with the other coordinates held: N
    /// is zero in the other equations, and the part has one coordinate more than it has equations.
    pub(super) fn touch(
        &self,
        guess: &M::Coordinates,
        reach: M::Scalar,
        direction: &Vector<M>,
    ) -> Result<Option<Crossing<M>>, PathErrorOf<M>> {
        let at = self.linear(guess)?;
        let Some(held) = self.held(guess, &Elimination::<M>::all_but(1, at.jacobian))? else { return Ok(None) };
        let Some(q) = self.stationary(guess, reach, 1, &held)? else { return Ok(None) };
        let Some(q) = self.reversal(&q, reach, &held)? else { return Ok(None) };
        if self.difference(&q, guess).norm() > reach {
            return Ok(None);
        }
        let (at, part) = (self.linear(&q)?, self.part(&q, &held)?);
        let (elimination, part) =
            (Elimination::<M>::all_but(1, at.jacobian), Elimination::<M>::all_but(1, part.jacobian));
        let mut free = elimination.free().map(|column| elimination.null_vector(column));
        let cone = self.cone(&q, &part, direction);
        let (&[one, other], Some(first), Some(second)) = (cone.lines(), free.next(), free.next()) else {
            return Ok(None);
        };
        // The null vector without a part along the motions that cross.
        let lines = [one, other].map(|line| part.in_null_space(line.iter().copied()));
        let [along, across] = lines.map(|line| [first.dot(&line), second.dot(&line)]);
        let size = |[a, b]: [M::Scalar; 2]| a.abs() + b.abs();
        let [a, b] = if size(along) > size(across) { along } else { across };
        let tangent = (first * b - second * a).normalized();
        let has_tangent = tangent.is_finite() && at.jacobian.along(&tangent).largest() <= nearly_zero();
        if !(has_tangent && at.is_on_curve() && self.is_crossing(&at, &elimination)) {
            return Ok(None);
        }
        let mut groups = Groups::none(self.mechanism.group_list());
        for (place, group) in self.mechanism.groups().enumerate() {
            if group.equations.iter().any(|&row| held[row].is_none()) {
                groups.insert(place);
            }
        }
        let mut tangents = [Vector::<M>::zero(self.dims()); MOST_TANGENTS];
        tangents[0] = tangent;
        let touch = Some(Touch { groups, tangents: lines });
        let groups = self.singular_groups(&q);
        Ok(Some(Crossing { q, tangents, count: 1, is_complete: true, defect: 1, groups, touch }))
    }

    /// The position within `reach` of `guess` at which the coordinates of a part are held where they are, and one equation of
    /// the rest has an extreme along the motion that the others leave: its slope is zero there.
    fn reversal(
        &self,
        guess: &M::Coordinates,
        reach: M::Scalar,
        held: &Held<M>,
    ) -> Result<Option<M::Coordinates>, PathErrorOf<M>> {
        let (u, ..) = self.mechanism.dims();
        let mut inner = (0..u.count() + 1).filter(|column| !held.iter().any(|held| *held == Some(*column)));
        let outside = u.column(|row| if held[row].is_none() { inner.next() } else { None });
        let Some(last) = inner.next() else { return Ok(None) };
        let mut q = *guess;
        for _ in 0..MOST_ITERATIONS {
            let Ok(mut at) = self.part(&q, &outside) else { return Ok(None) };
            at.jacobian.fix(last);
            let elimination = Elimination::<M>::all_but(1, at.jacobian);
            let Some(column) = elimination.free().find(|&column| column != last) else { return Ok(None) };
            let (part, along) = (elimination.solve(&-at.residual), elimination.null_vector(column));
            let form = |x: &Vector<M>| self.mixed(&q, &elimination, x, &along).sum();
            let slope = elimination.slope(column).sum() + form(&part);
            let step = part - along * (slope / form(&along));
            if !step.is_finite() {
                return Ok(None);
            }
            q = self.moved(&q, &step);
            if self.difference(&q, guess).norm() > reach {
                return Ok(None);
            }
            if step.norm() <= self.rounding_error(&q) * real(EQUAL_ULPS) {
                return Ok(Some(q));
            }
        }
        Ok(None)
    }

    /// For each equation outside the part that N combines, a coordinate that this part does not contain; `None` if the part
    /// is the whole, or its equations do not leave one coordinate free.
    fn held(&self, q: &M::Coordinates, elimination: &Elimination<M>) -> Result<Option<Held<M>>, PathErrorOf<M>> {
        let (u, v, _) = self.mechanism.dims();
        let weights = u.column(|row| elimination.left_null_product(&u.unit(row)).sum().abs());
        let mut rows = weights.map(|weight| weight > weights.largest() * real(LEAST_WEIGHT));
        // At an irregular position nearby no entry is zero by chance.
        let apart = |place: usize| real::<M::Scalar>(Real::sine(1.0 + place as f64));
        let aside = Vector::<M> { unknowns: u.column(apart), inputs: v.column(|_| apart(u.count())) };
        // Some equations have no value there.
        let Ok(at) = self.linear(&self.moved(q, &aside)) else { return Ok(None) };
        let contains = |row: usize, column: usize| !at.jacobian.entry(row, column).is_zero();
        let columns = 0..u.count() + 1;
        let in_part =
            |rows: &Column<bool, M::U>, column: usize| (0..u.count()).any(|row| rows[row] && contains(row, column));
        // Equations without other coordinates belong to it, too.
        let found = rows;
        for row in 0..u.count() {
            rows[row] |= columns.clone().all(|column| !contains(row, column) || in_part(&found, column));
        }
        let count = rows.iter().filter(|&&is_part| is_part).count();
        if count == u.count() || columns.clone().filter(|&column| in_part(&rows, column)).count() != count + 1 {
            return Ok(None);
        }
        let mut others = columns.filter(|&column| !in_part(&rows, column));
        Ok(Some(u.column(|row| if rows[row] { None } else { others.next() })))
    }

    /// Psi and [J A] of a part of the mechanism: the coordinates of the other equations are held.
    fn part(&self, q: &M::Coordinates, held: &Held<M>) -> Result<Linear<M>, PathErrorOf<M>> {
        let mut at = self.linear(q)?;
        for (row, column) in held.iter().enumerate() {
            if let Some(column) = *column {
                at.residual[row] = M::Scalar::zero();
                at.jacobian.hold(row, column);
            }
        }
        Ok(at)
    }

    /// Finds the position within `reach` of `guess` where, with the coordinates of some equations held, Psi = 0 in the rows
    /// with a pivot and the slopes of the `open` other rows vanish.
    fn stationary(
        &self,
        guess: &M::Coordinates,
        reach: M::Scalar,
        open: usize,
        held: &Held<M>,
    ) -> Result<Option<M::Coordinates>, PathErrorOf<M>> {
        let mut q = *guess;
        for _ in 0..MOST_ITERATIONS {
            let at = self.part(&q, held)?;
            let elimination = Elimination::<M>::all_but(open, at.jacobian);
            let part = elimination.solve(&-at.residual);
            let along = if open == 1 {
                self.saddle_step(&q, &elimination, &part)
            } else {
                self.least_slopes_step(&q, &elimination, &part)
            };
            let Some(step) = along.map(|along| part + along).filter(Vector::<M>::is_finite) else { return Ok(None) };
            let next = self.moved(&q, &step);
            if self.difference(&next, guess).norm() > reach {
                return Ok(None);
            }
            q = next;
            if step.norm() <= self.rounding_error(&q) * real(EQUAL_ULPS) {
                return Ok(Some(q));
            }
        }
        Ok(None)
    }

    /// The Newton step in the two-dimensional null space of one open row, to the zero of its slopes; `part` is the step
    /// outside the null space, taken first.
    fn saddle_step(&self, q: &M::Coordinates, elimination: &Elimination<M>, part: &Vector<M>) -> Option<Vector<M>> {
        let mut free = elimination.free();
        let columns = [free.next()?, free.next()?];
        let [one, two] = columns.map(|column| elimination.null_vector(column));
        // Only the open row is not zero.
        let form = |x: &Vector<M>, y: &Vector<M>| self.mixed(q, elimination, x, y).sum();
        let [h11, h12, h22] = [form(&one, &one), form(&one, &two), form(&two, &two)];
        let slope_one = elimination.slope(columns[0]).sum() + form(part, &one);
        let slope_two = elimination.slope(columns[1]).sum() + form(part, &two);
        let determinant = h11 * h22 - h12 * h12;
        let size = h11.abs() + h12.abs() + h22.abs();
        if determinant.abs() <= size * size * M::Scalar::default_epsilon().sqrt() {
            return None;
        }
        Some(
            one * ((h12 * slope_two - h22 * slope_one) / determinant)
                + two * ((h12 * slope_one - h11 * slope_two) / determinant),
        )
    }

    /// The Gauss-Newton step in the null space of several open rows: it minimises the sum of the squares of their
    /// slopes after the step `part` outside the null space.
    fn least_slopes_step(
        &self,
        q: &M::Coordinates,
        elimination: &Elimination<M>,
        part: &Vector<M>,
    ) -> Option<Vector<M>> {
        let count = elimination.free().count();
        let (u, ..) = self.mechanism.dims();
        if count > u.count() {
            return None;
        }
        let mut normal = with_units_from::<M>(count, u.zero_matrix(u));
        let mut right = u.zeros();
        for column in elimination.free() {
            let along = elimination.null_vector(column);
            let slopes = elimination.slope(column) + self.mixed(q, elimination, part, &along);
            let mut turns = u.zero_matrix(u);
            for (place, other) in elimination.free().enumerate() {
                turns.set_column(place, self.mixed(q, elimination, &elimination.null_vector(other), &along));
            }
            normal += turns.tr_mul_matrix(&turns);
            right -= turns.tr_mul(&slopes);
        }
        let cholesky = Cholesky::new(&normal)?;
        let diagonal = cholesky.diagonal();
        let least = largest(diagonal.iter().copied().take(count)) * nearly_zero();
        if diagonal.iter().take(count).any(|&entry| entry <= least) {
            return None;
        }
        let solution = cholesky.solve(&right);
        let parts = elimination.free().zip(solution.iter());
        Some(
            parts.fold(Vector::<M>::zero(self.dims()), |sum, (column, &part)| {
                sum + elimination.null_vector(column) * part
            }),
        )
    }

    /// True if N Psi and its slopes are zero.
    fn is_crossing(&self, at: &Linear<M>, elimination: &Elimination<M>) -> bool {
        let (height, noise) = (elimination.left_null_product(&at.residual), elimination.left_null_error(&at.noise));
        let is_on_curve =
            height.iter().zip(noise.iter()).all(|(height, noise)| height.abs() <= *noise * real(EQUAL_ULPS));
        is_on_curve && elimination.free().all(|column| elimination.slope(column).largest() <= nearly_zero())
    }

    /// Computes the crossing at a position where the slopes vanish, if Psi = 0 there.
    fn tangents(
        &self,
        q: M::Coordinates,
        defect: usize,
        direction: &Vector<M>,
    ) -> Result<Option<Crossing<M>>, PathErrorOf<M>> {
        let at = self.linear(&q)?;
        let elimination = Elimination::<M>::all_but(defect, at.jacobian);
        if !self.is_crossing(&at, &elimination) {
            return Ok(None);
        }
        let mut tangents = [Vector::<M>::zero(self.dims()); MOST_TANGENTS];
        let (mut count, mut is_complete) = (0, false);
        if defect < DIMENSIONS {
            let cone = self.cone(&q, &elimination, direction);
            is_complete = cone.is_complete();
            for (tangent, line) in tangents.iter_mut().zip(cone.lines()) {
                *tangent = elimination.in_null_space(line.iter().copied());
                count += 1;
            }
        }
        // If not all tangents are found, that of the followed motion is added.
        if !is_complete && let Some(nearest) = self.nearest_tangent(&q, &at, &elimination, direction) {
            let is_known = |known: &Vector<M>| nearest.across(known) <= nearly_zero();
            if !tangents[..count].iter().any(is_known) {
                count = (count + 1).min(MOST_TANGENTS);
                tangents[count - 1] = nearest;
            }
        }
        if count == 0 {
            return Ok(None);
        }
        let groups = self.singular_groups(&q);
        Ok(Some(Crossing { q, tangents, count, is_complete, defect, groups, touch: None }))
    }

    /// The lines on which the quadratic forms of all open rows are zero, in coordinates of the null space.
    fn cone(&self, q: &M::Coordinates, elimination: &Elimination<M>, direction: &Vector<M>) -> Cone<M::Scalar> {
        let mut forms = [Form::zeros(); DIMENSIONS];
        let (mut gram, mut along) = (Form::<M::Scalar>::identity(), Column::<M::Scalar, D<DIMENSIONS>>::zeros());
        let size = elimination.free().count();
        for (i, one) in elimination.free().enumerate() {
            let one = elimination.null_vector(one);
            along[i] = one.dot(direction);
            for (j, two) in elimination.free().enumerate().take(i + 1) {
                let two = elimination.null_vector(two);
                (gram[(i, j)], gram[(j, i)]) = (one.dot(&two), one.dot(&two));
                let values = self.mixed(q, elimination, &one, &two);
                for (form, row) in forms.iter_mut().zip(elimination.open_rows()) {
                    (form[(i, j)], form[(j, i)]) = (values[row], values[row]);
                }
            }
        }
        // The projection of the direction on the null space.
        let along = Cholesky::new(&gram).map_or(along, |gram| gram.solve(&along));
        Cone::of(&forms[..size - 1], size, &along)
    }

    /// The tangent nearest to a direction: a common zero of the forms, by the Gauss-Newton method.
    fn nearest_tangent(
        &self,
        q: &M::Coordinates,
        at: &Linear<M>,
        elimination: &Elimination<M>,
        direction: &Vector<M>,
    ) -> Option<Vector<M>> {
        // Removes the part of the direction that is not in the null space.
        let slopes = at.jacobian.along(direction);
        let mut tangent = (*direction + elimination.solve(&-slopes)).normalized();
        let count = elimination.free().count();
        let (u, ..) = self.mechanism.dims();
        if count > u.count() || !tangent.is_finite() {
            return None;
        }
        for _ in 0..MOST_ITERATIONS {
            let values = self.mixed(q, elimination, &tangent, &tangent);
            if values.largest() <= ulps(EQUAL_ULPS) {
                break;
            }
            let mut turns = u.zero_matrix(u);
            let mut along = u.zeros();
            for (place, column) in elimination.free().enumerate() {
                let null = elimination.null_vector(column);
                along[place] = null.dot(&tangent);
                turns.set_column(place, self.mixed(q, elimination, &tangent, &null) * real(2.0));
            }
            let products = u.matrix(u, |row, column| along[row] * along[column]);
            let normal = with_units_from::<M>(count, turns.tr_mul_matrix(&turns) + products);
            let solution = Cholesky::new(&normal)?.solve(&-turns.tr_mul(&values));
            let parts = elimination.free().zip(solution.iter());
            let step = parts.fold(Vector::<M>::zero(self.dims()), |sum, (column, &part)| {
                sum + elimination.null_vector(column) * part
            });
            tangent = (tangent + step).normalized();
        }
        let left = self.mixed(q, elimination, &tangent, &tangent).largest();
        (left <= nearly_zero() && tangent.dot(direction).abs() > direction.norm() * real(0.5)).then_some(tangent)
    }

    /// N (Psi_q x)_q y in the open rows, from the second derivatives along x + y and x - y: (Psi_q z)_q z is a
    /// quadratic form in z.
    fn mixed(&self, q: &M::Coordinates, elimination: &Elimination<M>, x: &Vector<M>, y: &Vector<M>) -> PerUnknown<M> {
        let along = |z: &Vector<M>| -> PerUnknown<M> { self.curvature(q, z) };
        elimination.left_null_product(&(along(&(*x + *y)) - along(&(*x - *y)))) * real::<M::Scalar>(0.25)
    }
}

/// Pads normal equations of `count` coordinates with ones on the diagonal.
fn with_units_from<M: Mechanism>(
    count: usize,
    mut normal: Matrix<M::Scalar, M::U, M::U>,
) -> Matrix<M::Scalar, M::U, M::U> {
    for unused in count..normal.dims().0.count() {
        normal[(unused, unused)] = M::Scalar::one();
    }
    normal
}
