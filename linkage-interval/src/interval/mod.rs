//! An interval of doubles.

mod angle;
mod arithmetic;
mod decimal;
mod exponential;
mod number;
mod rounding;
mod sine;

use core::fmt;

use rounding::sum;

/// The real numbers from `least` to `most`. A bound is a double or infinite, never NaN, and the interval is never empty.
///
/// Every operation and function encloses: its result contains the results for all numbers of its operands for which it is
/// defined. If it is undefined for some, as are a quotient by an interval with zero, the root of one with negative numbers
/// and the tangent of one with a pole, the result is [`ENTIRE`](Self::ENTIRE).
///
/// ```
/// use linkage_interval::Interval;
/// use linkage_runtime::Number;
///
/// // The coupler angle's law of cosines, with lengths to a tenth.
/// let [a, b, c] = [4.0, 5.0, 6.0].map(|length| Interval::around(length, 0.1).unwrap());
/// let cosine = (a.square() + b.square() - c.square()) / (a * b * 2.0.into());
/// let angle = cosine.arccosine();
/// assert!(angle.contains((0.125_f64).acos()) && angle.width() < 0.17);
/// ```
///
/// An interval has no order, and is no scalar of code that compares:
///
/// ```compile_fail,E0369
/// use linkage_interval::Interval;
///
/// let is_below = Interval::from(1.0) < Interval::from(2.0);
/// ```
///
/// ```compile_fail,E0277
/// use linkage_interval::Interval;
/// use linkage_runtime::Real;
///
/// fn scalar<T: Real>(_: T) {}
/// scalar(Interval::from(1.0));
/// ```
///
/// # Accuracy
///
/// The result for single numbers has at most this many doubles between its bounds, in 1e6 evaluations of each against 48
/// digits. Where a magnitude is outside 2^-900 to 2^900, `*`, `/`, `square` and `sqrt` have one more.
///
/// | function                        | doubles |
/// |---------------------------------|---------|
/// | `+`, `-`, `abs`                 | 0       |
/// | `*`, `/`, `square`, `sqrt`      | 0       |
/// | `sine`, `cosine`                | 3       |
/// | `tan`                           | 9       |
/// | `atan`, `arctangent2`           | 3       |
/// | `asin`, `acos`                  | 7       |
/// | `exp`                           | 4       |
/// | `ln`                            | 3       |
/// | `hypotenuse`                    | 5       |
///
/// The bounds of `+ - * /`, `square` and `sqrt` are the nearest there are, so that parts of operands give parts of the
/// result. The bounds of the other functions for a part may be beyond those for the whole by so many doubles.
///
/// # Trust
///
/// The bounds rest on IEEE 754: + - * / and the square root are rounded to nearest. No function of a C library is called.
/// The errors of sine, cosine and arctangent are proved from that by the test `kernels`; exponential function and logarithm
/// are series of intervals. Beyond 1e5 the sine and cosine are -1 to 1 and the tangent unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    least: f64,
    most: f64,
}

impl Interval {
    /// All real numbers.
    pub const ENTIRE: Self = Self { least: f64::NEG_INFINITY, most: f64::INFINITY };

    /// The interval between two bounds, of which the first may be minus infinity and the second infinity; `None` if it
    /// contains no number: if the first is larger than the second, one is NaN, or both are the same infinity.
    #[must_use]
    pub fn new(least: f64, most: f64) -> Option<Self> {
        let has_numbers = least <= most && least < f64::INFINITY && most > f64::NEG_INFINITY;
        has_numbers.then_some(Self { least, most })
    }

    /// The interval of `middle` plus and minus `radius`, rounded outward; `None` for NaN, an infinite middle and a negative
    /// radius.
    #[must_use]
    pub fn around(middle: f64, radius: f64) -> Option<Self> {
        let has_numbers = middle.is_finite() && radius >= 0.0;
        has_numbers.then(|| Self::new(sum(middle, -radius).down(), sum(middle, radius).up())).flatten()
    }

    /// The lower bound: the smallest number, or minus infinity.
    #[must_use]
    pub fn least(self) -> f64 {
        self.least
    }

    /// The upper bound: the largest number, or infinity.
    #[must_use]
    pub fn most(self) -> f64 {
        self.most
    }

    /// A finite double inside: about the middle, or 0 of all numbers, or the largest double if one bound is infinite.
    #[must_use]
    pub fn middle(self) -> f64 {
        if self == Self::ENTIRE {
            return 0.0;
        }
        let middle = 0.5 * self.least + 0.5 * self.most;
        middle.clamp(f64::MIN, f64::MAX).clamp(self.least, self.most)
    }

    /// The difference between the bounds, rounded upward.
    #[must_use]
    pub fn width(self) -> f64 {
        sum(self.most, -self.least).up()
    }

    /// The largest magnitude.
    #[must_use]
    pub fn magnitude(self) -> f64 {
        self.least.abs().max(self.most.abs())
    }

    /// The smallest magnitude.
    #[must_use]
    pub fn mignitude(self) -> f64 {
        if self.contains(0.0) { 0.0 } else { self.least.abs().min(self.most.abs()) }
    }

    /// True if this number is inside. Infinity is none.
    #[must_use]
    pub fn contains(self, number: f64) -> bool {
        number.is_finite() && self.least <= number && number <= self.most
    }

    /// True if all numbers are in the other interval.
    #[must_use]
    pub fn is_within(self, other: Self) -> bool {
        other.least <= self.least && self.most <= other.most
    }

    /// True if all numbers are in the other interval and its bounds differ from those of it: a bound that is infinite in
    /// both does not.
    #[must_use]
    pub fn is_interior(self, other: Self) -> bool {
        other.least < self.least && self.most < other.most
    }

    /// The numbers in both; `None` if there are none.
    #[must_use]
    pub fn intersection(self, other: Self) -> Option<Self> {
        Self::new(self.least.max(other.least), self.most.min(other.most))
    }

    /// The smallest interval that contains both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self { least: self.least.min(other.least), most: self.most.max(other.most) }
    }

    /// The numbers whose relative difference from `value` is at most `errors` units of 2^-53, and zero for zero. Infinity
    /// is a result that overflowed.
    fn near_result(value: f64, errors: f64) -> Self {
        /// 2^-53, and a little more: the error is relative to the exact number, whose magnitude is at most
        /// 1 + 2^-50 times that of `value`.
        const UNIT: f64 = f64::EPSILON * 0.5 * (1.0 + 1e-12);
        if value == 0.0 {
            return Self { least: 0.0, most: 0.0 };
        }
        let finite = value.clamp(f64::MIN, f64::MAX);
        let radius = (finite.abs() * (errors * UNIT)).next_up();
        let [least, most] = [sum(finite, -radius).down(), sum(finite, radius).up()];
        let bound = |bound: f64| if value.is_infinite() { value } else { bound };
        if value > 0.0 { Self { least, most: bound(most) } } else { Self { least: bound(least), most } }
    }
}

/// Both bounds with all their digits: `[0.25, 1e300]`.
impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{:?}, {:?}]", self.least, self.most)
    }
}

impl From<f64> for Interval {
    /// This number alone; all real numbers for NaN and infinity.
    fn from(value: f64) -> Self {
        if value.is_finite() { Self { least: value, most: value } } else { Self::ENTIRE }
    }
}
