//! Dense output: the state between the ends of a step.

use super::tableau::{self, Slopes, Tableau};
use linkage_runtime::{Build, Column, Dim, Real, real};

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
        let mut coefficients = [state.dim().zeros(); COEFFICIENTS];
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
        let mut coefficients = [states[0].dim().zeros(); COEFFICIENTS];
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

    /// A bound of the way of each component within the step, for a cubic.
    pub(crate) fn way(&self) -> Column<T, N> {
        let moves = self.coefficients[..self.used].iter().skip(1);
        moves.fold(self.coefficients[0].dim().zeros(), |way, coefficient| way + coefficient.map(|entry| entry.abs()))
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

    /// A bound of the move of each component from its value at the middle of a part of the step, while the fraction s moves from
    /// there by so many times half of the part in any complex direction: the sum of the magnitudes of the terms of its Taylor series.
    pub(super) fn moves(&self, [from, to]: [f64; 2], times: f64) -> Column<T, N> {
        let (middle, radius) = (0.5 * (from + to), real::<T>(0.5 * times * (to - from)));
        let (s, rest) = (real::<T>(middle), real::<T>(1.0 - middle));
        // By Horner's rule, as in `at_fraction`, with s + x in place of s.
        let mut series = [self.coefficients[0].dim().zeros(); COEFFICIENTS];
        series[0] = self.coefficients[self.used - 1];
        for (degree, i) in (0..self.used - 1).rev().enumerate() {
            let (factor, sign) = if i % 2 == 0 { (s, T::one()) } else { (rest, -T::one()) };
            for power in (0..=degree + 1).rev() {
                let lower = if power > 0 { series[power - 1] * sign } else { self.coefficients[i] };
                series[power] = series[power] * factor + lower;
            }
        }
        let terms = series[1..self.used].iter().rev();
        terms.fold(series[0].dim().zeros(), |sum, term| (sum + term.map(|entry| entry.abs())) * radius)
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

    /// The rate of the state at this fraction of the step, which must not have the length zero.
    pub(super) fn rate_at_fraction(&self, s: T) -> Column<T, N> {
        let rest = T::one() - s;
        let (inner, last) = self.coefficients[..self.used].split_at(self.used - 1);
        // The value of the inner part, and its derivative by s.
        let parts = (last[0], last[0].dim().zeros());
        let (_, by_fraction) = inner.iter().enumerate().rev().fold(parts, |(value, derivative), (i, coefficient)| {
            let (factor, sign) = if i % 2 == 0 { (s, T::one()) } else { (rest, -T::one()) };
            (*coefficient + value * factor, derivative * factor + value * sign)
        });
        by_fraction / self.length
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
