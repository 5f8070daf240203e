//! A number in a computation with rounding errors: where it is, and how far it is from the result of exact operations.

use std::cell::Cell;
use std::ops::{Add, Mul, Neg, Sub};

use linkage_interval::Interval;
use linkage_runtime::Number;

/// Rounding errors in one computation, at most.
const ERRORS: usize = 64;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

/// A value of a computation in doubles for inputs in intervals. Its difference from the value of the computation with the
/// same inputs and exact operations is the sum of `errors`, each times a number from -1 to 1: that is one number for each
/// rounding, so that an error that enters a result twice can cancel (affine arithmetic; Stolfi and de Figueiredo, 1997).
#[derive(Clone, Copy)]
pub struct Tracked {
    pub value: Interval,
    errors: [Interval; ERRORS],
    /// A constant to which this is a sum with a smaller number.
    sum_with: Option<f64>,
}

/// Half an ulp of the largest double in the interval: the largest rounding error of a result in it.
pub fn half_ulp(value: Interval) -> f64 {
    let largest = value.magnitude();
    let place = 2f64.powi(i32::try_from(largest.to_bits() >> 52).unwrap() - 1023 - 52);
    0.5 * place
}

/// From -1 to 1 times this bound.
pub fn within(bound: f64) -> Interval {
    Interval::new(-bound, bound).unwrap()
}

impl Tracked {
    /// An input without an error; begins a computation if it is the first.
    pub fn exactly(value: Interval) -> Self {
        Self { value, errors: [Interval::from(0.0); ERRORS], sum_with: None }
    }

    pub fn constant(value: f64) -> Self {
        Self::exactly(value.into())
    }

    /// Runs a computation with its own rounding errors.
    pub fn run<R>(computation: impl FnOnce() -> R) -> R {
        COUNT.set(0);
        computation()
    }

    /// An upper bound of the difference.
    pub fn error(&self) -> f64 {
        sum(self.errors.iter().map(|error| error.magnitude()))
    }

    /// An upper bound of the difference before the last operation is rounded.
    pub fn inner_error(&self) -> f64 {
        let last = self.errors.iter().rposition(|error| error.magnitude() > 0.0).unwrap_or(0);
        sum(self.errors[..last].iter().map(|error| error.magnitude()))
    }

    /// With an error that no operation before had.
    fn with_error(mut self, bound: f64) -> Self {
        if bound == 0.0 {
            return self;
        }
        let index = COUNT.replace(COUNT.get() + 1);
        self.errors[index] = bound.into();
        self
    }

    /// The exact result of an operation on computed values, and its error, before it is rounded.
    fn rounded(value: Interval, errors: impl FnMut(usize) -> Interval) -> Self {
        // An interval of one number is exact.
        let bound = if value.least() == value.most() { 0.0 } else { half_ulp(value) };
        let value = value + within(bound);
        Self { value, errors: std::array::from_fn(errors), sum_with: None }.with_error(bound)
    }

    /// True for a number of one value.
    fn is_constant(&self) -> bool {
        self.value.least() == self.value.most()
    }
}

/// Rounded upward.
fn sum(bounds: impl Iterator<Item = f64>) -> f64 {
    bounds.fold(Interval::from(0.0), |sum, bound| sum + bound.into()).most()
}

impl Neg for Tracked {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, errors: self.errors.map(Neg::neg), sum_with: None }
    }
}

impl Add for Tracked {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.value == Interval::from(0.0) {
            return other;
        }
        let sum = Self::rounded(self.value + other.value, |i| self.errors[i] + other.errors[i]);
        let constant = self.value.least();
        let is_larger = self.is_constant() && other.value.magnitude() <= constant.abs();
        Self { sum_with: is_larger.then_some(constant), ..sum }
    }
}

impl Sub for Tracked {
    type Output = Self;

    /// Exact if the first is a constant and the second the sum of that and a smaller number (Dekker, 1971).
    fn sub(self, other: Self) -> Self {
        if self.is_constant() && other.sum_with == Some(self.value.least()) {
            let errors = std::array::from_fn(|i| self.errors[i] - other.errors[i]);
            return Self { value: self.value - other.value, errors, sum_with: None };
        }
        self + -other
    }
}

impl Mul for Tracked {
    type Output = Self;

    /// Exact for a power of two. With errors d of a and e of b, a b differs from (a - d) (b - e) by a e + b d - d e.
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let value = a.value * b.value;
        let errors = |i: usize| a.value * b.errors[i] + b.value * a.errors[i];
        let is_power = |x: &Self| x.is_constant() && x.value.least().to_bits().trailing_zeros() >= 52;
        if is_power(&a) || is_power(&b) {
            return Self { value, errors: std::array::from_fn(errors), sum_with: None };
        }
        let both = Interval::from(a.error()) * Interval::from(b.error());
        Self::rounded(value, errors).with_error(both.most())
    }
}

/// Bounds for a range in parts: [least, most] in `count` equal parts.
pub fn parts(least: f64, most: f64, count: u32) -> impl Iterator<Item = Interval> {
    let end = move |index: u32| {
        let part = f64::from(index) / f64::from(count);
        least * (1.0 - part) + most * part
    };
    (0..count).map(move |index| Interval::new(end(index), end(index + 1)).unwrap())
}

/// The upper bound of |x|^n.
pub fn power(x: f64, n: usize) -> Interval {
    (0..n).fold(Interval::one(), |power, _| power * x.into())
}
