//! Intervals as numbers of formulas.

use linkage_runtime::__shared::HYPOTENUSE_ERROR;
use linkage_runtime::{Number, Real};

use super::Interval;

impl Number for Interval {
    fn exactly(value: f64) -> Self {
        value.into()
    }

    /// From the double below to the double above; all real numbers for NaN, infinity and the largest doubles.
    fn near(value: f64) -> Self {
        if !value.is_finite() {
            return Self::ENTIRE;
        }
        Self { least: value.next_down(), most: value.next_up() }
    }

    fn unknown() -> Self {
        Self::ENTIRE
    }

    fn pi() -> Self {
        // The double PI is below pi.
        Self { least: std::f64::consts::PI, most: std::f64::consts::PI.next_up() }
    }

    fn square(self) -> Self {
        self.squared()
    }

    fn abs(self) -> Self {
        Self { least: self.mignitude(), most: self.magnitude() }
    }

    fn sqrt(self) -> Self {
        self.root()
    }

    fn exponential(self) -> Self {
        self.exponential()
    }

    fn logarithm(self) -> Self {
        self.logarithm()
    }

    fn sine_cosine(self) -> (Self, Self) {
        (self.sine_of(), self.cosine_of())
    }

    fn sine(self) -> Self {
        self.sine_of()
    }

    fn cosine(self) -> Self {
        self.cosine_of()
    }

    fn tangent(self) -> Self {
        self.tangent()
    }

    fn arcsine(self) -> Self {
        self.arcsine()
    }

    fn arccosine(self) -> Self {
        self.arccosine()
    }

    fn arctangent(self) -> Self {
        self.arctangent()
    }

    fn arctangent2(self, x: Self) -> Self {
        self.angle(x)
    }

    /// It grows with both magnitudes.
    fn hypotenuse(self, y: Self) -> Self {
        let of = |x: f64, y: f64| match (x, y) {
            (0.0, length) | (length, 0.0) => Self { least: length, most: length },
            _ if x.max(y).is_infinite() => Self { least: f64::MAX, most: f64::INFINITY },
            _ => Self::near_result(Real::hypotenuse(x, y), HYPOTENUSE_ERROR),
        };
        let [near, far] = [of(self.mignitude(), y.mignitude()), of(self.magnitude(), y.magnitude())];
        Self { least: near.least, most: far.most }
    }
}
