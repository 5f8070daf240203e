//! Change points: where [J A] loses rank and curves cross.
//!
//! Let n1 .. nk span the null space of [J A] and let the rows of L span what takes [J A] to zero from the left: k - 1 of
//! them. The crossing is where the slopes of L Psi along n1 .. nk vanish (H. B. Keller, "Lectures on Numerical Methods in
//! Bifurcation Problems", 1987, section 5): where one row is open that is a saddle of it, a regular root of its slopes
//! however near it is, so that Newton's method finds it to rounding; where more are open there are more slopes than
//! directions, which agree at a crossing, and the method is that of Gauss and Newton. The height of L Psi there tells a
//! change point from curves that only come near each other. The tangents are the zeros of the quadratic forms L Psi_qq.

use nalgebra::{SMatrix, SVector};

use super::cone::{Cone, DIMENSIONS, Form};
use super::curve::{Curve, Linear};
use super::groups::Groups;
use super::place::weak;
use super::tangent::Elimination;
use super::tangents::MOST_TANGENTS;
use super::vector::Vector;
use crate::{Error, Mechanism, Real, real};

/// Newton steps: from where a follower stands it takes three to five.
const MOST_ITERATIONS: usize = 12;

/// The saddle lies on the curve if its height is no more than this many roundings of the closures.
const ROUNDINGS: f64 = 16.0;

/// A crossing and its tangents, of length 1, each either way.
#[derive(Clone, Copy)]
pub(super) struct Crossing<Q, T, const U: usize> {
    pub(super) q: Q,
    tangents: [Vector<T, U>; MOST_TANGENTS],
    count: usize,
    /// True if these are all.
    pub(super) is_complete: bool,
    /// The number of pivots of [J A] that are zero.
    pub(super) defect: usize,
    /// The groups that are singular there.
    pub(super) groups: Groups,
}

impl<Q, T: Real, const U: usize> Crossing<Q, T, U> {
    pub(super) fn tangents(&self) -> &[Vector<T, U>] {
        &self.tangents[..self.count]
    }

    /// Puts the tangent nearest to a direction first, its way.
    pub(super) fn followed(&mut self, direction: &Vector<T, U>) {
        let nearness = |tangent: &Vector<T, U>| tangent.dot(direction).abs();
        for place in 1..self.count {
            if nearness(&self.tangents[place]) > nearness(&self.tangents[0]) {
                self.tangents.swap(0, place);
            }
        }
        if self.tangents[0].dot(direction) < T::zero() {
            self.tangents[0] = self.tangents[0] * -T::one();
        }
    }
}

impl<M, T, const U: usize> Curve<'_, M, T, U>
where
    T: Real,
    M: Mechanism<T, U, 1>,
{
    /// The crossing within `reach` of `guess`, if there is one. Of a whole family of tangents that nearest to
    /// `direction` stands for all.
    pub(super) fn crossing(
        &self,
        guess: &M::Coordinates,
        reach: T,
        direction: &Vector<T, U>,
    ) -> Result<Option<Crossing<M::Coordinates, T, U>>, Error> {
        let at = self.linear(guess)?;
        let gap = Elimination::new(at.unknowns, at.input).after_gap();
        for open in [1, gap].into_iter().take(if gap == 1 { 1 } else { 2 }) {
            let Some(mut q) = self.degenerate(guess, reach, open)? else { continue };
            let at = self.linear(&q)?;
            let defect = Elimination::new(at.unknowns, at.input).defect(weak());
            if defect > open {
                // One of several open rows has led here.
                let Some(better) = self.degenerate(&q, weak(), defect)? else { continue };
                q = better;
            }
            if let Some(crossing) = self.tangents(q, defect.max(1), direction)? {
                return Ok(Some(crossing));
            }
        }
        Ok(None)
    }

    /// The place within `reach` of `guess` where the slopes of so many open rows vanish.
    fn degenerate(&self, guess: &M::Coordinates, reach: T, open: usize) -> Result<Option<M::Coordinates>, Error> {
        let mut q = *guess;
        for _ in 0..MOST_ITERATIONS {
            let at = self.linear(&q)?;
            let elimination = Elimination::all_but(open, at.unknowns, at.input);
            let part = elimination.solve(&-at.residual);
            let along = if open == 1 {
                self.saddle_step(&q, &at, &elimination, &part)
            } else {
                self.least_slopes_step(&q, &at, &elimination, &part)
            };
            let Some(step) = along.map(|along| part + along).filter(Vector::is_finite) else { return Ok(None) };
            let next = self.moved(&q, &step);
            if self.difference(&next, guess).norm() > reach {
                return Ok(None);
            }
            q = next;
            if step.norm() <= self.rounding(&q) * real(ROUNDINGS) {
                return Ok(Some(q));
            }
        }
        Ok(None)
    }

    /// The step along the two directions that one open row leaves, to where its slopes after `part` are zero.
    fn saddle_step(
        &self,
        q: &M::Coordinates,
        at: &Linear<T, U>,
        elimination: &Elimination<T, U>,
        part: &Vector<T, U>,
    ) -> Option<Vector<T, U>> {
        let mut free = elimination.free();
        let columns = [free.next()?, free.next()?];
        let [one, two] = columns.map(|column| elimination.null(column));
        // One row is open, and the others are zero.
        let form = |x: &Vector<T, U>, y: &Vector<T, U>| self.mixed(q, at, elimination, x, y).sum();
        let [h11, h12, h22] = [form(&one, &one), form(&one, &two), form(&two, &two)];
        let slope_one = elimination.slope(columns[0]).sum() + form(part, &one);
        let slope_two = elimination.slope(columns[1]).sum() + form(part, &two);
        let determinant = h11 * h22 - h12 * h12;
        let size = h11.abs() + h12.abs() + h22.abs();
        if determinant.abs() <= size * size * T::default_epsilon().sqrt() {
            return None;
        }
        Some(
            one * ((h12 * slope_two - h22 * slope_one) / determinant)
                + two * ((h12 * slope_one - h11 * slope_two) / determinant),
        )
    }

    /// The step along all directions that several open rows leave, to where the squares of their slopes after `part`
    /// are least.
    fn least_slopes_step(
        &self,
        q: &M::Coordinates,
        at: &Linear<T, U>,
        elimination: &Elimination<T, U>,
        part: &Vector<T, U>,
    ) -> Option<Vector<T, U>> {
        let count = elimination.free().count();
        if count > U {
            return None;
        }
        let mut normal =
            SMatrix::<T, U, U>::from_fn(|row, column| if row == column && row >= count { T::one() } else { T::zero() });
        let mut right = SVector::<T, U>::zeros();
        for column in elimination.free() {
            let along = elimination.null(column);
            let slopes = elimination.slope(column) + self.mixed(q, at, elimination, part, &along);
            let mut turns = SMatrix::<T, U, U>::zeros();
            for (place, other) in elimination.free().enumerate() {
                turns.set_column(place, &self.mixed(q, at, elimination, &elimination.null(other), &along));
            }
            normal += turns.tr_mul(&turns);
            right -= turns.tr_mul(&slopes);
        }
        let cholesky = normal.cholesky()?;
        let diagonal = cholesky.l_dirty().diagonal();
        let least = diagonal.rows(0, count).amax() * weak();
        if diagonal.iter().take(count).any(|&entry| entry <= least) {
            return None;
        }
        let solution = cholesky.solve(&right);
        let parts = elimination.free().zip(solution.iter());
        Some(parts.fold(Vector::zero(), |sum, (column, &part)| sum + elimination.null(column) * part))
    }

    /// The crossing at a place without slopes, if the place lies on the curve.
    fn tangents(
        &self,
        q: M::Coordinates,
        defect: usize,
        direction: &Vector<T, U>,
    ) -> Result<Option<Crossing<M::Coordinates, T, U>>, Error> {
        let at = self.linear(&q)?;
        let elimination = Elimination::all_but(defect, at.unknowns, at.input);
        let (height, noise) = (elimination.left(&at.residual), elimination.left_of_noise(&at.noise));
        let is_on_curve =
            height.iter().zip(noise.iter()).all(|(height, noise)| height.abs() <= *noise * real(ROUNDINGS));
        let is_flat = elimination.free().all(|column| elimination.slope(column).amax() <= weak());
        if !(is_on_curve && is_flat) {
            return Ok(None);
        }
        let mut tangents = [Vector::zero(); MOST_TANGENTS];
        let (mut count, mut is_complete) = (0, false);
        if defect < DIMENSIONS {
            let cone = self.cone(&q, &at, &elimination, direction);
            is_complete = cone.is_complete();
            for (tangent, line) in tangents.iter_mut().zip(cone.lines()) {
                let parts = elimination.free().zip(line.iter());
                let sum = parts.fold(Vector::zero(), |sum, (column, &part)| sum + elimination.null(column) * part);
                *tangent = sum.normalized();
                count += 1;
            }
        }
        // Of more than are told, that of the motion which is followed.
        if !is_complete && let Some(nearest) = self.nearest_tangent(&q, &at, &elimination, direction) {
            let is_told = |told: &Vector<T, U>| nearest.across(told) <= weak();
            if !tangents[..count].iter().any(is_told) {
                count = (count + 1).min(MOST_TANGENTS);
                tangents[count - 1] = nearest;
            }
        }
        if count == 0 {
            return Ok(None);
        }
        let groups = self.singular_groups(&at);
        Ok(Some(Crossing { q, tangents, count, is_complete, defect, groups }))
    }

    /// The zeros of the forms of the open rows, in the null directions.
    fn cone(
        &self,
        q: &M::Coordinates,
        at: &Linear<T, U>,
        elimination: &Elimination<T, U>,
        direction: &Vector<T, U>,
    ) -> Cone<T> {
        let mut forms = [Form::zeros(); DIMENSIONS];
        let (mut gram, mut along) = (Form::<T>::identity(), SVector::<T, DIMENSIONS>::zeros());
        let size = elimination.free().count();
        for (i, one) in elimination.free().enumerate() {
            let one = elimination.null(one);
            along[i] = one.dot(direction);
            for (j, two) in elimination.free().enumerate().take(i + 1) {
                let two = elimination.null(two);
                (gram[(i, j)], gram[(j, i)]) = (one.dot(&two), one.dot(&two));
                let values = self.mixed(q, at, elimination, &one, &two);
                for (form, row) in forms.iter_mut().zip(elimination.open_rows()) {
                    (form[(i, j)], form[(j, i)]) = (values[row], values[row]);
                }
            }
        }
        // The part of the direction along the null directions.
        let along = gram.cholesky().map_or(along, |gram| gram.solve(&along));
        Cone::of(&forms[..size - 1], size, &along)
    }

    /// The zero of the forms near to a direction, by the method of Gauss and Newton.
    fn nearest_tangent(
        &self,
        q: &M::Coordinates,
        at: &Linear<T, U>,
        elimination: &Elimination<T, U>,
        direction: &Vector<T, U>,
    ) -> Option<Vector<T, U>> {
        // Loop equations have no part of a tangent.
        let slopes = at.unknowns * direction.unknowns + at.input * direction.input;
        let mut tangent = (*direction + elimination.solve(&-slopes)).normalized();
        let count = elimination.free().count();
        if count > U || !tangent.is_finite() {
            return None;
        }
        for _ in 0..MOST_ITERATIONS {
            let values = self.mixed(q, at, elimination, &tangent, &tangent);
            if values.amax() <= T::default_epsilon() * real(ROUNDINGS) {
                break;
            }
            let mut turns = SMatrix::<T, U, U>::zeros();
            let mut along = SVector::<T, U>::zeros();
            for (place, column) in elimination.free().enumerate() {
                let null = elimination.null(column);
                along[place] = null.dot(&tangent);
                turns.set_column(place, &(self.mixed(q, at, elimination, &tangent, &null) * real::<T>(2.0)));
            }
            let mut normal = turns.tr_mul(&turns) + along * along.transpose();
            for unused in count..U {
                normal[(unused, unused)] = T::one();
            }
            let solution = normal.cholesky()?.solve(&-turns.tr_mul(&values));
            let parts = elimination.free().zip(solution.iter());
            let step = parts.fold(Vector::zero(), |sum, (column, &part)| sum + elimination.null(column) * part);
            tangent = (tangent + step).normalized();
        }
        let left = self.mixed(q, at, elimination, &tangent, &tangent).amax();
        (left <= weak() && tangent.dot(direction).abs() > direction.norm() * real(0.5)).then_some(tangent)
    }

    /// L (Psi_q x)_q y of the open rows, from the values along x + y and x - y.
    fn mixed(
        &self,
        q: &M::Coordinates,
        at: &Linear<T, U>,
        elimination: &Elimination<T, U>,
        x: &Vector<T, U>,
        y: &Vector<T, U>,
    ) -> SVector<T, U> {
        let along = |z: &Vector<T, U>| -> SVector<T, U> { self.curvature(q, at, z) };
        elimination.left(&(along(&(*x + *y)) - along(&(*x - *y)))) * real::<T>(0.25)
    }
}
