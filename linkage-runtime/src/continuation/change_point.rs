//! Change points: where [J A] loses rank and two curves cross.
//!
//! Let n1, n2 span what [J A] takes to zero and let psi be what takes [J A] to zero from the left. The crossing is a
//! saddle of psi' Psi along n1 and n2, at which Psi vanishes (H. B. Keller, "Lectures on Numerical Methods in
//! Bifurcation Problems", 1987, section 5): the saddle is a regular root of its slopes however near it is, so that
//! Newton's method finds it to rounding, and the height of psi' Psi there tells a change point from two curves that
//! only come near each other. The two tangents are the roots of the quadratic form psi' Psi_qq.

use nalgebra::SVector;

use super::curve::{Curve, Linear};
use super::tangent::{Elimination, Open};
use super::vector::Vector;
use crate::{Error, Mechanism, Real, real};

/// Newton steps: from where a follower stands it takes three to five.
const MOST_ITERATIONS: usize = 12;

/// The saddle lies on the curve if its height is no more than this many roundings of the closures.
const ROUNDINGS: f64 = 16.0;

/// A crossing and its two tangents, of length 1, each either way.
#[derive(Clone, Copy)]
pub(super) struct Crossing<Q, T, const U: usize> {
    pub(super) q: Q,
    pub(super) tangents: [Vector<T, U>; 2],
}

impl<M, T, const U: usize> Curve<'_, M, T, U>
where
    T: Real,
    M: Mechanism<T, U, 1>,
{
    /// The crossing within `reach` of `guess`, if there is one.
    pub(super) fn crossing(
        &self,
        guess: &M::Coordinates,
        reach: T,
    ) -> Result<Option<Crossing<M::Coordinates, T, U>>, Error> {
        let mut q = *guess;
        for _ in 0..MOST_ITERATIONS {
            let at = self.linear(&q)?;
            let elimination = Elimination::all_but_one(at.unknowns, at.input);
            let Some(open) = elimination.open() else { return Ok(None) };
            let form = self.form(&q, &at, &open);
            let part = elimination.solve(&-at.residual);
            let [one, two] = open.directions;
            // The slopes after `part`, which `step` along the two directions makes zero.
            let [slope_one, slope_two] = [
                open.slopes[0] + self.mixed(&q, &at, &open, &part, &one),
                open.slopes[1] + self.mixed(&q, &at, &open, &part, &two),
            ];
            let [h11, h12, h22] = form;
            let determinant = h11 * h22 - h12 * h12;
            let size = h11.abs() + h12.abs() + h22.abs();
            if determinant.abs() <= size * size * T::default_epsilon().sqrt() {
                return Ok(None);
            }
            let step = part
                + one * ((h12 * slope_two - h22 * slope_one) / determinant)
                + two * ((h12 * slope_one - h11 * slope_two) / determinant);
            if !step.is_finite() {
                return Ok(None);
            }
            let next = self.moved(&q, &step);
            if self.difference(&next, guess).norm() > reach {
                return Ok(None);
            }
            q = next;
            if step.norm() <= self.rounding(&q) * real(ROUNDINGS) {
                return self.tangents(q);
            }
        }
        Ok(None)
    }

    /// The crossing at a saddle, if the saddle lies on the curve.
    fn tangents(&self, q: M::Coordinates) -> Result<Option<Crossing<M::Coordinates, T, U>>, Error> {
        let at = self.linear(&q)?;
        let elimination = Elimination::all_but_one(at.unknowns, at.input);
        let Some(open) = elimination.open() else { return Ok(None) };
        let height = open.combination.dot(&at.residual).abs();
        let noise = open.combination.abs().dot(&at.noise);
        let [h11, h12, h22] = self.form(&q, &at, &open);
        let radicand = h12 * h12 - h11 * h22;
        if height > noise * real(ROUNDINGS) || radicand <= T::zero() {
            return Ok(None);
        }
        // h11 x^2 + 2 h12 x y + h22 y^2 = 0 without cancellation.
        let root = radicand.sqrt();
        let sum = if h12 < T::zero() { root - h12 } else { -(h12 + root) };
        let [one, two] = open.directions;
        let tangents = [(sum, h11), (h22, sum)].map(|(x, y)| (one * x + two * y).normalized());
        Ok(Some(Crossing { q, tangents }))
    }

    /// psi' Psi_qq along the two directions: 11, 12, 22.
    fn form(&self, q: &M::Coordinates, at: &Linear<T, U>, open: &Open<T, U>) -> [T; 3] {
        let [one, two] = open.directions;
        let pure = |x: &Vector<T, U>| open.combination.dot(&self.curvature(q, at, x));
        [pure(&one), self.mixed(q, at, open, &one, &two), pure(&two)]
    }

    /// psi' (Psi_q x)_q y from its values along x + y and x - y.
    fn mixed(&self, q: &M::Coordinates, at: &Linear<T, U>, open: &Open<T, U>, x: &Vector<T, U>, y: &Vector<T, U>) -> T {
        let along = |z: &Vector<T, U>| -> SVector<T, U> { self.curvature(q, at, z) };
        open.combination.dot(&(along(&(*x + *y)) - along(&(*x - *y)))) * real(0.25)
    }
}
