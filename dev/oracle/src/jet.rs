//! A quantity with its first two derivatives in time, in 48 digits.

use std::ops::{Add, Mul, Sub};

use super::precise::{Big, big, direction};

#[derive(Debug, Clone)]
pub struct Jet {
    pub value: Big,
    pub rate: Big,
    pub second: Big,
}

/// A vector of the plane.
pub type Plane = [Jet; 2];

impl Jet {
    #[must_use]
    pub fn constant(value: Big) -> Self {
        Self { value, rate: big(0.0), second: big(0.0) }
    }

    #[must_use]
    pub fn scaled(&self, factor: &Big) -> Self {
        Self { value: &self.value * factor, rate: &self.rate * factor, second: &self.second * factor }
    }

    /// `r'' = (x'' - 2 r'^2) / (2 r)` of the root r of x.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        use dashu_float::ops::SquareRoot;
        let value = SquareRoot::sqrt(&self.value);
        let twice = &value + &value;
        let rate = &self.rate / &twice;
        let second = (&self.second - big(2.0) * &rate * &rate) / &twice;
        Self { value, rate, second }
    }

    /// The unit vector at this angle: `c'' = -s phi'' - c phi'^2`.
    #[must_use]
    pub fn direction(&self) -> Plane {
        let (cosine, sine) = direction(&self.value);
        let square = &self.rate * &self.rate;
        let part = |value: &Big, slope: &Big| Self {
            value: value.clone(),
            rate: slope * &self.rate,
            second: slope * &self.second - value * &square,
        };
        [part(&cosine, &-sine.clone()), part(&sine, &cosine)]
    }
}

impl Add for &Jet {
    type Output = Jet;

    fn add(self, other: Self) -> Jet {
        let sum = |one: &Big, other: &Big| one + other;
        Jet {
            value: sum(&self.value, &other.value),
            rate: sum(&self.rate, &other.rate),
            second: sum(&self.second, &other.second),
        }
    }
}

impl Sub for &Jet {
    type Output = Jet;

    fn sub(self, other: Self) -> Jet {
        self + &other.scaled(&big(-1.0))
    }
}

impl Mul for &Jet {
    type Output = Jet;

    /// Leibniz: `(x y)'' = x'' y + 2 x' y' + x y''`.
    fn mul(self, other: Self) -> Jet {
        let rate = &self.rate * &other.value + &self.value * &other.rate;
        let middle = big(2.0) * &self.rate * &other.rate;
        let second = &self.second * &other.value + middle + &self.value * &other.second;
        Jet { value: &self.value * &other.value, rate, second }
    }
}
