//! The operators: each bound of a result is that of two bounds, chosen by signs, rounded outward.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Interval;
use super::rounding::{product, quotient, root, sum};

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { least: sum(self.least, other.least).down(), most: sum(self.most, other.most).up() }
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { least: -self.most, most: -self.least }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        if a.least >= 0.0 {
            let of_least = if b.least >= 0.0 { a.least } else { a.most };
            let of_most = if b.most >= 0.0 { a.most } else { a.least };
            return Self { least: product(of_least, b.least).down(), most: product(of_most, b.most).up() };
        }
        if a.most <= 0.0 {
            return -a * -b;
        }
        if b.least >= 0.0 || b.most <= 0.0 {
            return b * a;
        }
        let [across, other] = [product(a.least, b.most), product(a.most, b.least)].map(|bound| bound.down());
        let [below, above] = [product(a.least, b.least), product(a.most, b.most)].map(|bound| bound.up());
        Self { least: across.min(other), most: below.max(above) }
    }
}

impl Div for Interval {
    type Output = Self;

    /// All real numbers if the divisor contains zero.
    fn div(self, other: Self) -> Self {
        let (a, b) = (self, other);
        if b.contains(0.0) {
            return Self::ENTIRE;
        }
        if b.most < 0.0 {
            return -a / -b;
        }
        let of_least = if a.least >= 0.0 { b.most } else { b.least };
        let of_most = if a.most >= 0.0 { b.least } else { b.most };
        Self { least: quotient(a.least, of_least).down(), most: quotient(a.most, of_most).up() }
    }
}

impl Interval {
    pub(super) fn squared(self) -> Self {
        let (near, far) = (self.mignitude(), self.magnitude());
        Self { least: product(near, near).down(), most: product(far, far).up() }
    }

    /// All real numbers if there are negative ones in the interval.
    pub(super) fn root(self) -> Self {
        if self.least < 0.0 {
            return Self::ENTIRE;
        }
        Self { least: root(self.least).down(), most: root(self.most).up() }
    }
}
