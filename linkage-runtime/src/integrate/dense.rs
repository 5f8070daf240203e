//! Dense output: the state between the ends of a step.

use nalgebra::SVector;

use super::tableau::{self, Slopes, Tableau};
use crate::{Real, real};

/// The largest number of coefficients.
const COEFFICIENTS: usize = 8;

/// The state within a step as a polynomial in s = (t - start) / h, from 0 to 1, which takes on state and rate at both
/// ends:
///
/// y = c0 + s (c1 + (1 - s) (c2 + s (c3 + (1 - s) (c4 + ...))))
///
/// (Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. (1993), section II.6.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolant<T: Real, const N: usize> {
    start: T,
    length: T,
    coefficients: [SVector<T, N>; COEFFICIENTS],
    /// The number of coefficients that are used.
    used: usize,
}

impl<T: Real, const N: usize> Interpolant<T, N> {
    /// One state and no step.
    pub(super) fn constant(t: T, state: SVector<T, N>) -> Self {
        let mut coefficients = [SVector::zeros(); COEFFICIENTS];
        coefficients[0] = state;
        Self { start: t, length: T::zero(), coefficients, used: 1 }
    }

    /// Hermite's cubic, of order 3: it takes no evaluation.
    #[inline]
    pub(super) fn cubic(start: T, length: T, states: [&SVector<T, N>; 2], slopes: [&SVector<T, N>; 2]) -> Self {
        let difference = states[1] - states[0];
        let first = slopes[0] * length - difference;
        let mut coefficients = [SVector::zeros(); COEFFICIENTS];
        coefficients[0] = *states[0];
        coefficients[1] = difference;
        coefficients[2] = first;
        coefficients[3] = difference - slopes[1] * length - first;
        Self { start, length, coefficients, used: 4 }
    }

    /// The cubic with the coefficients that the method adds.
    pub(super) fn complete(mut self, tableau: &Tableau, slopes: &Slopes<T, N>) -> Self {
        for (coefficient, weights) in self.coefficients[self.used..].iter_mut().zip(tableau.dense) {
            *coefficient = tableau::combination(slopes, weights) * self.length;
        }
        self.used += tableau.dense.len();
        self
    }

    /// Where the step starts and where it ends.
    #[must_use]
    pub fn interval(&self) -> (T, T) {
        (self.start, self.start + self.length)
    }

    /// The state at t. Outside of the step it is extrapolated.
    #[must_use]
    pub fn at(&self, t: T) -> SVector<T, N> {
        if self.length.is_zero() { self.coefficients[0] } else { self.at_fraction((t - self.start) / self.length) }
    }

    /// The state at this part of the step.
    #[inline]
    pub(super) fn at_fraction(&self, s: T) -> SVector<T, N> {
        let rest = T::one() - s;
        let (inner, last) = self.coefficients[..self.used].split_at(self.used - 1);
        inner
            .iter()
            .enumerate()
            .rev()
            .fold(last[0], |sum, (i, coefficient)| coefficient + sum * if i % 2 == 0 { s } else { rest })
    }

    /// The time at this part of the step.
    pub(super) fn time(&self, s: f64) -> T {
        self.start + real::<T>(s) * self.length
    }
}
