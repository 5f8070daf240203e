//! Dense output: the state between the ends of a step.

use nalgebra::SMatrix;

use super::tableau::{self, Slopes, Tableau};
use linkage_runtime::{Column, Dim, Real, real};

/// The largest number of coefficients.
const COEFFICIENTS: usize = 9;

/// The state within a step as a polynomial in s = (t - start) / h, from 0 to 1, which interpolates state and rate at
/// both ends:
///
/// y = c0 + s (c1 + (1 - s) (c2 + s (c3 + (1 - s) (c4 + ...))))
///
/// (Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. (1993), section II.6.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolant<T: Real, N: Dim> {
    start: T,
    length: T,
    coefficients: [Column<T, N>; COEFFICIENTS],
    /// The number of coefficients in use.
    used: usize,
}

impl<T: Real, N: Dim> Interpolant<T, N> {
    /// A constant state: a step of length zero.
    pub(super) fn constant(t: T, state: Column<T, N>) -> Self {
        let mut coefficients = [Column::zeros(); COEFFICIENTS];
        coefficients[0] = state;
        Self { start: t, length: T::zero(), coefficients, used: 1 }
    }

    /// True if every coefficient is finite.
    pub(super) fn is_finite(&self) -> bool {
        self.coefficients.iter().take(self.used).flatten().all(T::is_finite)
    }

    /// The cubic Hermite interpolant of the states and slopes at both ends, of order 3: it requires no evaluation of
    /// the rate.
    #[inline]
    pub(super) fn cubic(start: T, length: T, states: [&Column<T, N>; 2], slopes: [&Column<T, N>; 2]) -> Self {
        let difference = *states[1] - *states[0];
        let first = *slopes[0] * length - difference;
        let mut coefficients = [Column::zeros(); COEFFICIENTS];
        coefficients[0] = *states[0];
        coefficients[1] = difference;
        coefficients[2] = first;
        coefficients[3] = difference - *slopes[1] * length - first;
        Self { start, length, coefficients, used: 4 }
    }

    /// Adds the higher coefficients of the method to the cubic.
    pub(super) fn complete(mut self, tableau: &Tableau, slopes: &Slopes<T, N>) -> Self {
        for (coefficient, weights) in self.coefficients[self.used..].iter_mut().zip(tableau.dense) {
            *coefficient = tableau::combination(slopes, weights) * self.length;
        }
        self.used += tableau.dense.len();
        self
    }

    /// The polynomial with the value `state` at the start and these slopes y' at the fractions `parts` of the step;
    /// None if the fractions do not determine it.
    pub(crate) fn of_slopes<const P: usize>(
        (start, state): (T, Column<T, N>),
        length: T,
        parts: &[f64; P],
        slopes: &[Column<T, N>; P],
    ) -> Option<Self> {
        // The derivative of each basis function, a column, at each fraction, a row.
        let mut by_coefficient = SMatrix::<f64, P, P>::zeros();
        for (row, &s) in parts.iter().enumerate() {
            // Value and slope of the k-th basis function, from k = 1.
            let (mut value, mut slope) = (s, 1.0);
            for column in 0..P {
                by_coefficient[(row, column)] = slope;
                let (factor, rate) = if column % 2 == 0 { (1.0 - s, -1.0) } else { (s, 1.0) };
                (value, slope) = (value * factor, slope * factor + value * rate);
            }
        }
        let inverse = by_coefficient.try_inverse()?;
        let mut coefficients = [Column::zeros(); COEFFICIENTS];
        coefficients[0] = state;
        for (row, coefficient) in coefficients[1..].iter_mut().take(P).enumerate() {
            for (column, slope) in slopes.iter().enumerate() {
                *coefficient += *slope * (real::<T>(inverse[(row, column)]) * length);
            }
        }
        Some(Self { start, length, coefficients, used: P + 1 })
    }

    /// Restricts the polynomial, of degree 8 at most, to the part of its step before `end`; None if `end` is not within
    /// the step. Eight slopes and the state at the start determine it.
    pub(crate) fn up_to(&self, end: T) -> Option<Self> {
        let length = end - self.start;
        if length.abs() >= self.length.abs() {
            return None;
        }
        let parts = [0.0, 0.14, 0.28, 0.42, 0.58, 0.72, 0.86, 1.0];
        let slopes = parts.map(|part| self.slope_at(self.start + length * real(part)));
        Self::of_slopes((self.start, self.coefficients[0]), length, &parts, &slopes)
    }

    /// The last coefficient, from which the error of the polynomial is estimated.
    pub(crate) fn last(&self) -> Column<T, N> {
        self.coefficients[self.used - 1]
    }

    /// y' at t.
    pub(crate) fn slope_at(&self, t: T) -> Column<T, N> {
        let s = (t - self.start) / self.length;
        let rest = T::one() - s;
        let (inner, last) = self.coefficients[..self.used].split_at(self.used - 1);
        let start = (last[0], Column::zeros());
        let (_, slope) = inner.iter().enumerate().rev().fold(start, |(value, slope), (i, coefficient)| {
            let (factor, rate) = if i % 2 == 0 { (s, T::one()) } else { (rest, -T::one()) };
            (*coefficient + value * factor, slope * factor + value * rate)
        });
        slope / self.length
    }

    /// The times of the start and the end of the step.
    #[must_use]
    pub fn interval(&self) -> (T, T) {
        (self.start, self.start + self.length)
    }

    /// The state at t. Outside the step it is extrapolated, and may not be finite.
    #[must_use]
    pub fn at(&self, t: T) -> Column<T, N> {
        if self.length.is_zero() { self.coefficients[0] } else { self.at_fraction((t - self.start) / self.length) }
    }

    /// The state at this fraction of the step.
    #[inline]
    pub(crate) fn at_fraction(&self, s: T) -> Column<T, N> {
        let rest = T::one() - s;
        let (inner, last) = self.coefficients[..self.used].split_at(self.used - 1);
        inner
            .iter()
            .enumerate()
            .rev()
            .fold(last[0], |sum, (i, coefficient)| *coefficient + sum * if i % 2 == 0 { s } else { rest })
    }

    /// The length of the step, negative for a step back in time.
    pub(super) fn length(&self) -> T {
        self.length
    }

    /// The time at this fraction of the step.
    pub(super) fn time(&self, s: f64) -> T {
        self.start + real::<T>(s) * self.length
    }
}
