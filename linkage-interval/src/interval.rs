//! Intervals of real numbers with outward rounding.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::{Add, Div, Mul, Neg, Sub};

use linkage_runtime::{Number, Real};

/// The real numbers from `least` to `most`. A bound is a double or infinite, never NaN, and the interval is never empty.
///
/// Every operation encloses: its result contains the results for all numbers of its operands. An interval has no order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    least: f64,
    most: f64,
}

impl Interval {
    /// All real numbers.
    pub const ENTIRE: Self = Self { least: f64::NEG_INFINITY, most: f64::INFINITY };

    /// The interval between two bounds; `None` if the first is larger than the second or one is NaN.
    #[must_use]
    pub fn new(least: f64, most: f64) -> Option<Self> {
        (least <= most).then_some(Self { least, most })
    }

    /// The interval of `middle` plus and minus `radius`, rounded outward; `None` for NaN and a negative radius.
    #[must_use]
    pub fn around(middle: f64, radius: f64) -> Option<Self> {
        if radius == 0.0 {
            return Self::new(middle, middle);
        }
        Self::new((middle - radius).next_down(), (middle + radius).next_up())
    }

    /// The smallest number.
    #[must_use]
    pub fn least(self) -> f64 {
        self.least
    }

    /// The largest number.
    #[must_use]
    pub fn most(self) -> f64 {
        self.most
    }

    /// A double inside, about the middle.
    #[must_use]
    pub fn middle(self) -> f64 {
        (0.5 * self.least + 0.5 * self.most).clamp(self.least, self.most)
    }

    /// An upper bound of the difference between the bounds.
    #[must_use]
    pub fn width(self) -> f64 {
        if self.least == self.most { 0.0 } else { (self.most - self.least).next_up() }
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

    /// True if this number is inside.
    #[must_use]
    pub fn contains(self, number: f64) -> bool {
        self.least <= number && number <= self.most
    }

    /// True if all numbers are in the other interval.
    #[must_use]
    pub fn is_within(self, other: Self) -> bool {
        other.least <= self.least && self.most <= other.most
    }

    /// True if all numbers are in the other interval and none is a bound of it.
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

    /// Bounds rounded outward; all real numbers if one is NaN.
    fn outward(least: f64, most: f64) -> Self {
        if least.is_nan() || most.is_nan() {
            return Self::ENTIRE;
        }
        Self { least: least.next_down(), most: most.next_up() }
    }
}

impl From<f64> for Interval {
    /// This number alone; all real numbers for NaN and infinity.
    fn from(value: f64) -> Self {
        if value.is_finite() { Self { least: value, most: value } } else { Self::ENTIRE }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.least + other.least, self.most + other.most)
    }
}
impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.least - other.most, self.most - other.least)
    }
}
impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { least: -self.most, most: -self.least }
    }
}
impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let products =
            [self.least * other.least, self.least * other.most, self.most * other.least, self.most * other.most];
        // 0 times infinity.
        let products = products.map(|product| if product.is_nan() { 0.0 } else { product });
        let [first, others @ ..] = products;
        Self::outward(others.into_iter().fold(first, f64::min), others.into_iter().fold(first, f64::max))
    }
}
impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::ENTIRE;
        }
        self * Self::outward(1.0 / other.most, 1.0 / other.least)
    }
}

impl Number for Interval {
    fn exactly(value: f64) -> Self {
        value.into()
    }
    fn near(value: f64) -> Self {
        Self::outward(value, value)
    }
    fn unknown() -> Self {
        Self::ENTIRE
    }
    fn pi() -> Self {
        Self { least: PI, most: PI.next_up() }
    }
    fn square(self) -> Self {
        let (near, far) = (self.mignitude(), self.magnitude());
        Self { least: (near * near).next_down().max(0.0), most: (far * far).next_up() }
    }
    fn abs(self) -> Self {
        Self { least: self.mignitude(), most: self.magnitude() }
    }
    fn sqrt(self) -> Self {
        if self.least < 0.0 {
            return Self::ENTIRE;
        }
        Self { least: self.least.sqrt().next_down().max(0.0), most: self.most.sqrt().next_up() }
    }
    fn exp(self) -> Self {
        Self::ENTIRE
    }
    fn ln(self) -> Self {
        Self::ENTIRE
    }
    fn sine_cosine(self) -> (Self, Self) {
        (sine(self), sine(self + Self { least: FRAC_PI_2, most: FRAC_PI_2.next_up() }))
    }
    fn tan(self) -> Self {
        let (sine, cosine) = self.sine_cosine();
        sine / cosine
    }
    fn asin(self) -> Self {
        Self::ENTIRE
    }
    fn acos(self) -> Self {
        Self::ENTIRE
    }
    fn atan(self) -> Self {
        Self::ENTIRE
    }
    fn arctangent2(self, _: Self) -> Self {
        Self::ENTIRE
    }
    fn hypotenuse(self, y: Self) -> Self {
        (self.square() + y.square()).sqrt()
    }
}

fn sine(x: Interval) -> Interval {
    const ALL: Interval = Interval { least: -1.0, most: 1.0 };
    if !(x.width() < 6.0 && x.magnitude() < 1e5) {
        return ALL;
    }
    let (one, other) = (Real::sine(x.least), Real::sine(x.most));
    let turn = |x: f64, quarter: f64| ((x / FRAC_PI_2 - quarter) / 4.0).floor();
    let has = |quarter| turn(x.least.next_down(), quarter) != turn(x.most.next_up(), quarter);
    let most = if has(1.0) { 1.0 } else { one.max(other).next_up().next_up() };
    let least = if has(-1.0) { -1.0 } else { one.min(other).next_down().next_down() };
    Interval { least: least.max(-1.0), most: most.min(1.0) }
}
